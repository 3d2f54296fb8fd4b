//! Evaluates an expression while it is parsed, with an explicit stack (shunting-yard).
//!
//! No recursion, so that no text, however deeply nested, can overflow the call stack.

use super::arithmetic::{Operator, binary, negate, unsigned, with_remainder};
use super::functions::{Function, function, names};
use super::lexer::{Lexer, Token};
use super::literal::{integer_literal, malformed_number, real_literal, text_literal};
use super::parameters::Parameters;
use super::value::Value;
use super::{Complaint, MAX_NESTING, quoted};
use std::ops::Range;

/// Reserved words of Python; none of them can be the name of a parameter.
const RESERVED: [&str; 32] = [
    "and", "as", "assert", "break", "class", "continue", "def", "del", "elif", "else", "except", "exec", "finally",
    "for", "from", "global", "if", "import", "in", "is", "lambda", "not", "or", "pass", "print", "raise", "return",
    "try", "while", "with", "yield", "None",
];

/// Reasons why there is no value.
#[derive(Debug)]
pub(super) enum Stop {
    /// A problem.
    Complaint {
        /// The part of the text.
        at: Range<usize>,
        complaint: Complaint,
    },
    /// A parameter is used whose own statement has a problem, which has been reported.
    NoValue,
}

/// A value and the part of the text that gave it.
struct Operand {
    value: Value,
    range: Range<usize>,
}

/// An operator or a call pending its right operand.
enum Pending {
    /// `+` or `-` in front, and its place.
    Sign(Operator, usize),
    /// An operator with its left operand.
    Binary(Operand, Operator),
    /// `(`
    Parenthesis(Range<usize>),
    /// A function with the arguments it has so far, where its name begins, and its `(`.
    Call { function: &'static Function, arguments: Vec<Value>, start: usize, open: Range<usize> },
}

impl Pending {
    /// Its binding power: an operator on the right takes the operand if it binds tighter.
    fn binding(&self) -> u8 {
        match self {
            Self::Parenthesis(_) | Self::Call { .. } => 0,
            Self::Binary(_, operator) => binding(*operator),
            Self::Sign(..) => 3,
        }
    }

    /// Whether it is one more level of nesting; sums and products are not.
    fn nests(&self) -> bool {
        !matches!(self, Self::Binary(_, operator) if *operator != Operator::Power)
    }
}

fn binding(operator: Operator) -> u8 {
    match operator {
        Operator::Add | Operator::Subtract => 1,
        Operator::Multiply | Operator::Divide | Operator::FloorDivide | Operator::Remainder => 2,
        Operator::Power => 4,
    }
}

/// Reads the tokens of a logical line one at a time.
pub(super) struct Evaluator<'a> {
    pub(super) text: &'a [u8],
    lexer: Lexer<'a>,
    parameters: &'a Parameters,
    /// The token that comes next, and its place.
    pub(super) token: Token,
    pub(super) range: Range<usize>,
    /// The end of the token before it.
    pub(super) end_of_last: usize,
    pending: Vec<Pending>,
    depth: usize,
    /// The divisions of integers with a remainder so far.
    pub(super) divisions: Vec<Remainder>,
}

/// A division of integers with a remainder, as ranges in the text.
pub(super) struct Remainder {
    pub(super) dividend: Range<usize>,
    pub(super) divisor: Range<usize>,
    pub(super) floor: Value,
    pub(super) quotient: Value,
}

/// A complaint about a part of the text.
pub(super) fn stop<T>(at: Range<usize>, complaint: Complaint) -> Result<T, Stop> {
    Err(Stop::Complaint { at, complaint })
}

/// Whether it is a reserved word of Python.
pub(super) fn is_reserved(name: &[u8]) -> bool {
    RESERVED.iter().any(|word| word.as_bytes() == name)
}

impl<'a> Evaluator<'a> {
    /// Begins at `text[from..]`.
    pub(super) fn new(text: &'a [u8], from: usize, parameters: &'a Parameters) -> Self {
        let mut lexer = Lexer::new(text, from);
        let (token, range) = lexer.next_token();
        Self {
            text,
            lexer,
            parameters,
            token,
            range,
            end_of_last: from,
            pending: Vec::new(),
            depth: 0,
            divisions: Vec::new(),
        }
    }

    /// Advances to the next token and returns the range of the previous one.
    pub(super) fn advance(&mut self) -> Range<usize> {
        let (token, range) = self.lexer.next_token();
        self.token = token;
        self.end_of_last = self.range.end;
        std::mem::replace(&mut self.range, range)
    }

    /// The value of the expression here; stops before the first token that cannot belong to it.
    pub(super) fn expression(&mut self) -> Result<Value, Stop> {
        loop {
            let mut operand = self.operand()?;
            loop {
                if let Token::Operator(operator) = self.token {
                    // A power is right-associative, so the power on its left stays pending.
                    let at_least = if operator == Operator::Power { binding(operator) + 1 } else { binding(operator) };
                    let left = self.apply_pending(operand, at_least)?;
                    self.push(Pending::Binary(left, operator))?;
                    self.advance();
                    break;
                }
                operand = self.apply_pending(operand, 1)?;
                let Some(opened) = self.pop() else { return Ok(operand.value) };
                match (opened, self.token) {
                    (Pending::Parenthesis(open), Token::Close) => operand.range = open.start..self.advance().end,
                    (Pending::Parenthesis(open), Token::Comma) => {
                        let complaint = Complaint::new("a list of values in parentheses is not understood");
                        return stop(open.start..self.range.end, complaint.help("give a parameter one value"));
                    }
                    (Pending::Call { function, mut arguments, start, open }, Token::Comma | Token::Close) => {
                        arguments.push(operand.value);
                        if self.token == Token::Comma {
                            self.advance();
                        }
                        if self.token != Token::Close {
                            self.argument_follows(function, arguments, start, open)?;
                            break;
                        }
                        operand = self.call(function, &arguments, start)?;
                    }
                    (Pending::Parenthesis(open) | Pending::Call { open, .. }, _) => return Err(self.unclosed(open)),
                    (Pending::Sign(..) | Pending::Binary(..), _) => unreachable!("operators have been applied"),
                }
            }
        }
    }

    fn push(&mut self, pending: Pending) -> Result<(), Stop> {
        if pending.nests() {
            if self.depth == MAX_NESTING {
                let complaint = Complaint::new(format!("the expression is nested more than {MAX_NESTING} deep"));
                return stop(self.range.clone(), complaint.help("compute parts of it in parameters of their own"));
            }
            self.depth += 1;
        }
        self.pending.push(pending);
        Ok(())
    }

    fn pop(&mut self) -> Option<Pending> {
        let pending = self.pending.pop()?;
        self.depth -= usize::from(pending.nests());
        Some(pending)
    }

    /// Applies the pending signs and operators that bind at least this tightly.
    fn apply_pending(&mut self, mut operand: Operand, at_least: u8) -> Result<Operand, Stop> {
        while self.pending.last().is_some_and(|pending| pending.binding() >= at_least) {
            let (range, value) = match self.pop() {
                Some(Pending::Sign(Operator::Subtract, start)) => (start..operand.range.end, negate(&operand.value)),
                Some(Pending::Sign(_, start)) => (start..operand.range.end, unsigned(operand.value)),
                Some(Pending::Binary(left, operator)) => {
                    let range = left.range.start..operand.range.end;
                    if operator == Operator::Divide
                        && let Some((floor, quotient)) = with_remainder(&left.value, &operand.value)
                    {
                        let (dividend, divisor) = (left.range, operand.range.clone());
                        self.divisions.push(Remainder { dividend, divisor, floor, quotient });
                    }
                    (range, binary(left.value, operator, &operand.value, self.parameters.division()))
                }
                _ => unreachable!("only signs and operators bind"),
            };
            match value {
                Ok(value) => operand = Operand { value, range },
                Err(complaint) => return stop(range, complaint),
            }
        }
        Ok(operand)
    }

    /// The next number, text, parameter or call without arguments; anything opened before it becomes pending.
    fn operand(&mut self) -> Result<Operand, Stop> {
        loop {
            let word = &self.text[self.range.clone()];
            let value = match self.token {
                Token::Operator(sign @ (Operator::Add | Operator::Subtract)) => {
                    self.push(Pending::Sign(sign, self.range.start))?;
                    self.advance();
                    continue;
                }
                Token::Open => {
                    self.push(Pending::Parenthesis(self.range.clone()))?;
                    self.advance();
                    continue;
                }
                Token::Name if !is_reserved(word) => match self.name(word)? {
                    Some(operand) => return Ok(operand),
                    None => continue,
                },
                Token::Integer => integer_literal(word),
                Token::Real => real_literal(word),
                Token::Text => text_literal(word),
                _ => return Err(self.unexpected("a value")),
            };
            let range = self.advance();
            return match value {
                Ok(value) => Ok(Operand { value, range }),
                Err(complaint) => stop(range, complaint),
            };
        }
    }

    /// A parameter's value or a call without arguments; `None` for a call whose first argument follows.
    fn name(&mut self, name: &[u8]) -> Result<Option<Operand>, Stop> {
        let range = self.advance();
        let definition = self.parameters.definition(&String::from_utf8_lossy(name));
        if self.token == Token::Open {
            if definition.is_some() {
                let what = format!("{} is called, but it is a parameter, no function", quoted(name));
                return stop(range, Complaint::new(what));
            }
            let Some(function) = function(name) else {
                let complaint = Complaint::new(format!("the function {} is not understood", quoted(name)));
                return stop(range, complaint.help(format!("the functions are {}", names())));
            };
            let open = self.advance();
            if self.token == Token::Close {
                return self.call(function, &[], range.start).map(Some);
            }
            return self.argument_follows(function, Vec::new(), range.start, open).map(|()| None);
        }
        match definition.map(|definition| definition.value.clone()) {
            Some(Some(value)) => Ok(Some(Operand { value, range })),
            Some(None) => Err(Stop::NoValue),
            None if name == b"pi" => Ok(Some(Operand { value: Value::Real(std::f64::consts::PI), range })),
            None => stop(range, self.undefined(name)),
        }
    }

    fn undefined(&self, name: &[u8]) -> Complaint {
        let text = String::from_utf8_lossy(name);
        let mut complaint = Complaint::new(format!("{} is used before it is defined", quoted(name)));
        complaint.undefined = Some(text.clone().into_owned());
        match self.parameters.name_in_other_case(&text) {
            Some(other) => {
                complaint.help(format!("{} is defined; upper and lower case differ in names", quoted(other.as_bytes())))
            }
            None if function(name).is_some() => {
                complaint.help(format!("call the function with its arguments: `{text}(…)`"))
            }
            None => complaint.help("define it further up: statements are executed in their order"),
        }
    }

    /// Makes a call pending for one more argument, if it takes one.
    fn argument_follows(
        &mut self,
        function: &'static Function,
        arguments: Vec<Value>,
        start: usize,
        open: Range<usize>,
    ) -> Result<(), Stop> {
        if arguments.len() == *function.arguments.end() {
            return stop(start..self.range.start, wrong_count(function, "more"));
        }
        self.push(Pending::Call { function, arguments, start, open })
    }

    /// Consumes the `)` of a call and evaluates it.
    fn call(&mut self, function: &Function, arguments: &[Value], start: usize) -> Result<Operand, Stop> {
        let range = start..self.advance().end;
        if !function.arguments.contains(&arguments.len()) {
            return stop(range, wrong_count(function, &arguments.len().to_string()));
        }
        match (function.compute)(arguments) {
            Ok(value) => Ok(Operand { value, range }),
            Err(complaint) => stop(range, complaint),
        }
    }

    fn unclosed(&self, open: Range<usize>) -> Stop {
        match self.token {
            Token::End | Token::Semicolon => {
                Stop::Complaint { at: open, complaint: Complaint::new("the parenthesis is not closed").help("add `)`") }
            }
            _ => self.unexpected("an operator or `)`"),
        }
    }

    /// The complaint about an unexpected token.
    pub(super) fn unexpected(&self, expected: &str) -> Stop {
        let word = &self.text[self.range.clone()];
        let shown = quoted(word);
        let complaint = match self.token {
            Token::MalformedNumber => malformed_number(word),
            Token::UnterminatedText => {
                Complaint::new(format!("the text {shown} is not closed")).help("add the quote at its end")
            }
            Token::End => Complaint::new(format!("expected {expected}, found the end of the statement")),
            Token::Name if is_reserved(word) => {
                Complaint::new(format!("the word {shown} of Python is not understood")).help("only arithmetic is")
            }
            Token::Unknown => unknown(word),
            _ => Complaint::new(format!("expected {expected}, found {shown}")),
        };
        Stop::Complaint { at: self.range.clone(), complaint }
    }
}

fn wrong_count(function: &Function, given: &str) -> Complaint {
    let (least, most) = (*function.arguments.start(), *function.arguments.end());
    let takes = match most {
        _ if least == most => least.to_string(),
        2 => format!("{least} or {most}"),
        _ => format!("{least} to {most}"),
    };
    let noun = if takes == "1" { "argument" } else { "arguments" };
    Complaint::new(format!("`{}` takes {takes} {noun}, {given} given", function.name))
}

fn unknown(word: &[u8]) -> Complaint {
    let complaint = Complaint::new(format!("the character {} is not understood in an expression", quoted(word)));
    match word {
        b"<" | b">" => complaint.help("a parameter is used by its bare name here, without `<` and `>`"),
        b"^" => complaint.help("a power is written `**`"),
        b"[" | b"{" => complaint.help("a parameter has one value, no list"),
        _ => complaint,
    }
}
