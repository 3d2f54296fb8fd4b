//! Computes an expression while it is read: recursive descent over Python's grammar, no tree in between.

use super::arithmetic::{Operator, binary, integer_too_large, negate, real_too_large, text, text_too_long, unsigned};
use super::functions::{Function, function, names};
use super::lexer::{Lexer, Token};
use super::parameters::Parameters;
use super::value::Value;
use super::{Complaint, MAX_NESTING, MAX_TEXT, quoted};
use std::ops::Range;

/// Words that Python keeps for itself; none of them can be the name of a parameter.
const RESERVED: [&str; 32] = [
    "and", "as", "assert", "break", "class", "continue", "def", "del", "elif", "else", "except", "exec", "finally",
    "for", "from", "global", "if", "import", "in", "is", "lambda", "not", "or", "pass", "print", "raise", "return",
    "try", "while", "with", "yield", "None",
];

/// Why there is no value.
#[derive(Debug)]
pub(super) enum Stop {
    /// Something is wrong here.
    Complaint {
        /// With this part of the text.
        at: Range<usize>,
        complaint: Complaint,
    },
    /// A parameter is used whose own statement has a problem, which has been reported.
    NoValue,
}

/// A value and the part of the text that gave it.
type Computed = Result<(Value, Range<usize>), Stop>;

/// Reads the tokens of a logical line one at a time.
pub(super) struct Evaluator<'a> {
    pub(super) text: &'a [u8],
    lexer: Lexer<'a>,
    parameters: &'a Parameters,
    /// The token that comes next, and where it stands.
    pub(super) token: Token,
    pub(super) range: Range<usize>,
    /// Where the token before it ends.
    pub(super) end_of_last: usize,
    depth: usize,
}

/// A complaint about a part of the text.
pub(super) fn stop<T>(at: Range<usize>, complaint: Complaint) -> Result<T, Stop> {
    Err(Stop::Complaint { at, complaint })
}

/// Whether Python keeps the word for itself.
pub(super) fn is_reserved(name: &[u8]) -> bool {
    RESERVED.iter().any(|word| word.as_bytes() == name)
}

impl<'a> Evaluator<'a> {
    /// Begins at `text[from..]`.
    pub(super) fn new(text: &'a [u8], from: usize, parameters: &'a Parameters) -> Self {
        let mut lexer = Lexer::new(text, from);
        let (token, range) = lexer.next_token();
        Self { text, lexer, parameters, token, range, end_of_last: from, depth: 0 }
    }

    /// Goes on to the next token and gives the range of the one passed.
    pub(super) fn advance(&mut self) -> Range<usize> {
        let (token, range) = self.lexer.next_token();
        self.token = token;
        self.end_of_last = self.range.end;
        std::mem::replace(&mut self.range, range)
    }

    /// An expression: terms added and subtracted.
    pub(super) fn expression(&mut self) -> Computed {
        let operators = |operator| matches!(operator, Operator::Add | Operator::Subtract);
        self.chain(operators, Self::term)
    }

    fn term(&mut self) -> Computed {
        use Operator::{Divide, FloorDivide, Multiply, Remainder};
        let operators = |operator| matches!(operator, Multiply | Divide | FloorDivide | Remainder);
        self.chain(operators, Self::factor)
    }

    /// Operands joined from left to right.
    fn chain(&mut self, accepts: fn(Operator) -> bool, operand: fn(&mut Self) -> Computed) -> Computed {
        let (mut value, mut range) = operand(self)?;
        while let Token::Operator(operator) = self.token
            && accepts(operator)
        {
            self.advance();
            let (right, right_range) = operand(self)?;
            range.end = right_range.end;
            value = binary(value, operator, &right).or_else(|complaint| stop(range.clone(), complaint))?;
        }
        Ok((value, range))
    }

    /// A power with any number of signs in front. Every nesting passes through here.
    fn factor(&mut self) -> Computed {
        if self.depth == MAX_NESTING {
            return stop(
                self.range.clone(),
                Complaint::new(format!("the expression is nested more than {MAX_NESTING} deep"))
                    .help("compute parts of it in parameters of their own"),
            );
        }
        self.depth += 1;
        let computed = match self.token {
            Token::Operator(sign @ (Operator::Add | Operator::Subtract)) => self.signed(sign),
            _ => self.power(),
        };
        self.depth -= 1;
        computed
    }

    fn signed(&mut self, sign: Operator) -> Computed {
        let sign_range = self.advance();
        let (value, range) = self.factor()?;
        let range = sign_range.start..range.end;
        let value = if sign == Operator::Subtract { negate(&value) } else { unsigned(value) };
        value.map(|value| (value, range.clone())).or_else(|complaint| stop(range, complaint))
    }

    /// `atom ** factor`: binds to the right, and a sign may stand behind the `**`.
    fn power(&mut self) -> Computed {
        let (base, range) = self.atom()?;
        if self.token != Token::Operator(Operator::Power) {
            return Ok((base, range));
        }
        self.advance();
        let (exponent, exponent_range) = self.factor()?;
        let range = range.start..exponent_range.end;
        let value = binary(base, Operator::Power, &exponent).or_else(|complaint| stop(range.clone(), complaint))?;
        Ok((value, range))
    }

    fn atom(&mut self) -> Computed {
        let read = match self.token {
            Token::Integer => self.integer(),
            Token::Real => self.real(),
            Token::Text => self.text_literal(),
            Token::Name => return self.name(),
            Token::Open => return self.parenthesised(),
            _ => return Err(self.unexpected("a value")),
        };
        let range = self.advance();
        read.map(|value| (value, range.clone())).or_else(|complaint| stop(range, complaint))
    }

    fn word(&self) -> &'a [u8] {
        &self.text[self.range.clone()]
    }

    fn integer(&self) -> Result<Value, Complaint> {
        let digits = self.word();
        if digits.len() > 1 && digits[0] == b'0' && digits.iter().any(|digit| *digit != b'0') {
            return Err(Complaint::new(format!(
                "the integer {} begins with 0, which Python takes for octal",
                quoted(digits)
            ))
            .help("leave out the leading zeros"));
        }
        let value = str::from_utf8(digits).ok().and_then(|digits| digits.parse().ok());
        value.map(Value::Integer).ok_or_else(|| integer_too_large(&quoted(digits)))
    }

    fn real(&self) -> Result<Value, Complaint> {
        let digits = self.word();
        let value = str::from_utf8(digits).ok().and_then(|digits| digits.parse().ok());
        let finite = value.filter(|value: &f64| value.is_finite());
        finite.map(Value::Real).ok_or_else(|| real_too_large(&quoted(digits)))
    }

    /// A text without its quotes, with Python's escapes for backslash and quotes; a backslash before anything that is no
    /// escape stands for itself.
    fn text_literal(&self) -> Result<Value, Complaint> {
        let word = self.word();
        let inner = &word[1..word.len() - 1];
        // An escape takes two bytes for one.
        if inner.len() > 2 * MAX_TEXT {
            return Err(text_too_long(inner.len()));
        }
        let mut content = Vec::with_capacity(inner.len());
        let mut bytes = inner.iter().copied().peekable();
        while let Some(byte) = bytes.next() {
            match (byte, bytes.peek().copied()) {
                (b'\\', Some(escaped @ (b'\\' | b'\'' | b'"'))) => {
                    content.push(escaped);
                    bytes.next();
                }
                (b'\\', Some(escaped @ (b'a' | b'b' | b'f' | b'n' | b'r' | b't' | b'v' | b'x' | b'0'..=b'7'))) => {
                    let escape = char::from(escaped);
                    return Err(Complaint::new(format!(
                        "the text holds the escape `\\{escape}`, a control character in Python"
                    ))
                    .help(format!("write `\\\\{escape}` for a backslash before `{escape}`")));
                }
                _ => content.push(byte),
            }
        }
        let content =
            String::from_utf8(content).map_err(|_| Complaint::new("the text holds bytes that are not UTF-8"))?;
        text(content)
    }

    fn parenthesised(&mut self) -> Computed {
        let open = self.advance();
        let (value, _) = self.expression()?;
        match self.token {
            Token::Close => Ok((value, open.start..self.advance().end)),
            Token::Comma => stop(
                open.start..self.range.end,
                Complaint::new("a list of values in parentheses is not understood").help("give a parameter one value"),
            ),
            _ => Err(self.unclosed(open)),
        }
    }

    fn unclosed(&self, open: Range<usize>) -> Stop {
        match self.token {
            Token::End | Token::Semicolon => {
                let complaint = Complaint::new("the parenthesis is not closed").help("add `)`");
                Stop::Complaint { at: open, complaint }
            }
            _ => self.unexpected("an operator or `)`"),
        }
    }

    fn name(&mut self) -> Computed {
        let name = self.word();
        if is_reserved(name) {
            return Err(self.unexpected("a value"));
        }
        let range = self.advance();
        let text = String::from_utf8_lossy(name);
        let definition = self.parameters.definition(&text);
        if self.token == Token::Open {
            return match function(name) {
                Some(function) if definition.is_none() => self.call(function, range.start),
                Some(_) => {
                    stop(range, Complaint::new(format!("{} is called, but it is a parameter here", quoted(name))))
                }
                None => stop(
                    range,
                    Complaint::new(format!("the function {} is not understood", quoted(name)))
                        .help(format!("the functions are {}", names())),
                ),
            };
        }
        match definition {
            Some(definition) => match &definition.value {
                Some(value) => Ok((value.clone(), range)),
                None => Err(Stop::NoValue),
            },
            None if name == b"pi" => Ok((Value::Real(std::f64::consts::PI), range)),
            None => stop(range, self.undefined(name)),
        }
    }

    fn undefined(&self, name: &[u8]) -> Complaint {
        let text = String::from_utf8_lossy(name);
        let complaint = Complaint::new(format!("{} is used before it is defined", quoted(name)));
        match self.parameters.name_in_other_case(&text) {
            Some(other) => {
                complaint.help(format!("{} is defined; upper and lower case differ in names", quoted(other.as_bytes())))
            }
            None if function(name).is_some() => complaint.help(format!("call the function: `{text}(…)`")),
            None => complaint.help("define it further up: every statement is executed where it stands"),
        }
    }

    /// The arguments of a function, and what it gives.
    fn call(&mut self, function: &Function, start: usize) -> Computed {
        let open = self.advance();
        let mut arguments = Vec::new();
        while self.token != Token::Close {
            if arguments.len() == *function.arguments.end() {
                return stop(start..self.range.start, wrong_count(function, "more"));
            }
            arguments.push(self.expression()?.0);
            match self.token {
                Token::Comma => _ = self.advance(),
                Token::Close => {}
                _ => return Err(self.unclosed(open)),
            }
        }
        let range = start..self.advance().end;
        if !function.arguments.contains(&arguments.len()) {
            return stop(range, wrong_count(function, &arguments.len().to_string()));
        }
        match (function.compute)(&arguments) {
            Ok(value) => Ok((value, range)),
            Err(complaint) => stop(range, complaint),
        }
    }

    /// The complaint about the next token, which is not what it should be.
    pub(super) fn unexpected(&self, expected: &str) -> Stop {
        let word = self.word();
        let shown = quoted(word);
        let complaint = match self.token {
            Token::MalformedNumber => malformed_number(word),
            Token::UnterminatedText => {
                Complaint::new(format!("the text {shown} is not closed")).help("add the quote at its end")
            }
            Token::End => Complaint::new(format!("the statement ends where {expected} should stand")),
            Token::Name if is_reserved(word) => {
                Complaint::new(format!("the word {shown} of Python is not understood")).help("only arithmetic is")
            }
            Token::Unknown => unknown(word),
            _ => Complaint::new(format!("{shown} stands where {expected} should stand")),
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

fn malformed_number(word: &[u8]) -> Complaint {
    let letters = |byte: &u8| byte.is_ascii_alphabetic();
    let d_exponent = word.iter().position(letters).filter(|at| matches!(word[*at], b'd' | b'D'));
    match d_exponent {
        Some(at) if word[at + 1..].iter().any(u8::is_ascii_digit) && !word[at + 1..].iter().any(letters) => {
            let mut with_e = word.to_vec();
            with_e[at] = b'E';
            Complaint::new(format!("the number {} has a D exponent, which *PARAMETER does not know", quoted(word)))
                .help(format!("write {}", quoted(&with_e)))
        }
        _ => Complaint::new(format!("{} is neither a number nor a name", quoted(word))),
    }
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
