//! Statements: one definition each, several on a line with `;` between them.

use super::division::IntegerDivision;
use super::evaluate::{Evaluator, Remainder, Stop, is_reserved, stop};
use super::lexer::Token;
use super::logical_line::{LogicalLine, StatementLine, next_logical_line};
use super::parameters::{Definition, Parameters};
use super::value::Value;
use super::{Complaint, ExpressionProblem, MAX_TEXT_IN_ALL, quoted};
use std::ops::Range;

/// Executes the data lines of one *PARAMETER block (S-60, S-61).
///
/// A statement with a problem gives its names no value, and execution goes on with the next statement.
/// Statements that use such a name have no value either, but are not reported again.
pub fn define<'deck>(
    lines: impl IntoIterator<Item = StatementLine<'deck>>,
    parameters: &mut Parameters,
    problems: &mut Vec<ExpressionProblem>,
) {
    let mut lines = lines.into_iter().peekable();
    while let Some(line) = next_logical_line(&mut lines) {
        let mut from = 0;
        while let Some(statement) = execute(&line.text, from, parameters) {
            from = statement.end;
            record(statement, &line, parameters, problems);
        }
    }
}

/// A statement that has been executed.
struct Statement {
    /// The names it defines.
    names: Vec<Range<usize>>,
    /// The expression, as far as it could be read.
    expression: Range<usize>,
    outcome: Result<Value, Stop>,
    divisions: Vec<Remainder>,
    /// The start of the next statement.
    end: usize,
}

/// The statement at `text[from..]`; `None` when nothing is left.
fn execute(text: &[u8], from: usize, parameters: &Parameters) -> Option<Statement> {
    let mut evaluator = Evaluator::new(text, from, parameters);
    if evaluator.token == Token::End {
        return None;
    }
    let mut names = Vec::new();
    let mut expression = None;
    let outcome = definition(&mut evaluator, &mut names, &mut expression);
    // The part left unread after a problem.
    while !matches!(evaluator.token, Token::Semicolon | Token::End) {
        evaluator.advance();
    }
    let expression = expression.unwrap_or(evaluator.end_of_last)..evaluator.end_of_last;
    let divisions = std::mem::take(&mut evaluator.divisions);
    Some(Statement { names, expression, outcome, divisions, end: evaluator.range.end })
}

/// `name = expression`; name and start of the expression are returned even when there is a problem.
fn definition(
    evaluator: &mut Evaluator<'_>,
    names: &mut Vec<Range<usize>>,
    expression: &mut Option<usize>,
) -> Result<Value, Stop> {
    if evaluator.token != Token::Name {
        return Err(evaluator.unexpected("the name of a parameter"));
    }
    let range = evaluator.advance();
    let name = &evaluator.text[range.clone()];
    if is_reserved(name) {
        return reserved_word(evaluator, range);
    }
    names.push(range.clone());
    match evaluator.token {
        Token::Assign => {}
        Token::Comma => return several_names(evaluator, names, expression),
        _ => return no_assignment(evaluator, range),
    }
    evaluator.advance();
    *expression = Some(evaluator.range.start);
    let value = evaluator.expression()?;
    match evaluator.token {
        Token::End | Token::Semicolon => Ok(value),
        Token::Comma => stop(
            evaluator.range.clone(),
            Complaint::new("a list of values is not understood")
                .help("give a parameter one value; a point, not a comma, is the decimal mark"),
        ),
        Token::Assign => stop(
            evaluator.range.clone(),
            Complaint::new("a second `=` is not understood").help("define one parameter in a statement"),
        ),
        _ => Err(evaluator.unexpected("an operator")),
    }
}

fn reserved_word(evaluator: &Evaluator<'_>, word: Range<usize>) -> Result<Value, Stop> {
    let shown = quoted(&evaluator.text[word.clone()]);
    if evaluator.token == Token::Assign {
        let complaint = Complaint::new(format!("{shown} is a reserved word of Python and cannot be a parameter"));
        return stop(word, complaint.help("choose another name"));
    }
    stop(
        word,
        Complaint::new(format!("the statement {shown} of Python is not understood")).help("only definitions are"),
    )
}

/// The problem of a name without `=` after it.
fn no_assignment(evaluator: &Evaluator<'_>, name: Range<usize>) -> Result<Value, Stop> {
    let found = evaluator.range.clone();
    match evaluator.token {
        Token::AssignWithOperator => {
            let complaint = Complaint::new(format!("{} is not understood", quoted(&evaluator.text[found.clone()])));
            stop(found, complaint.help("write it in full, as in `a = a + 1`"))
        }
        Token::Equal => stop(found, Complaint::new("`==` compares and defines nothing").help("write one `=`")),
        Token::Unknown | Token::MalformedNumber | Token::UnterminatedText => Err(evaluator.unexpected("`=`")),
        _ => {
            let complaint = Complaint::new(format!("expected `=` after {}", quoted(&evaluator.text[name.clone()])));
            stop(name, complaint.help("write `name = expression`"))
        }
    }
}

/// `a, b = …`
fn several_names(
    evaluator: &mut Evaluator<'_>,
    names: &mut Vec<Range<usize>>,
    expression: &mut Option<usize>,
) -> Result<Value, Stop> {
    while evaluator.token == Token::Comma {
        evaluator.advance();
        if evaluator.token == Token::Name {
            names.push(evaluator.advance());
        }
    }
    let all = names[0].start..evaluator.end_of_last;
    if evaluator.token != Token::Assign {
        let shown = quoted(&evaluator.text[all.clone()]);
        names.clear();
        return stop(all, Complaint::new(format!("{shown} is no definition")).help("write `name = expression`"));
    }
    evaluator.advance();
    // One by one they would take quadratic time.
    *expression = Some(evaluator.text.len());
    stop(
        all,
        Complaint::new("several names before one `=` are not understood").help("define one parameter in a statement"),
    )
}

/// Stores the result of a statement.
fn record(
    statement: Statement,
    line: &LogicalLine<'_>,
    parameters: &mut Parameters,
    problems: &mut Vec<ExpressionProblem>,
) {
    for Remainder { dividend, divisor, floor, quotient } in statement.divisions {
        let place = |range: &Range<usize>| line.place(range);
        let span = place(&(dividend.start..divisor.end));
        let (dividend, divisor) = (place(&dividend), place(&divisor));
        parameters.integer_divisions.push(IntegerDivision { span, dividend, divisor, floor, quotient });
    }
    let value = match statement.outcome {
        Ok(value) => {
            within_budget(value, parameters).or_else(|complaint| stop(statement.expression.clone(), complaint))
        }
        Err(reason) => Err(reason),
    };
    let value = match value {
        Ok(value) => Some(value),
        Err(Stop::NoValue) => None,
        Err(Stop::Complaint { at, complaint: Complaint { message, help, undefined } }) => {
            problems.push(ExpressionProblem { span: line.place(&at), message, help, undefined });
            None
        }
    };
    let text = |range: &Range<usize>| {
        String::from_utf8_lossy(&line.text[range.start..range.end.max(range.start)]).into_owned()
    };
    for name in &statement.names {
        let span = line.place(&(name.start..statement.expression.end.max(name.end)));
        parameters.push(Definition {
            name: text(name),
            expression: text(&statement.expression),
            span,
            value: value.clone(),
        });
    }
}

/// The value, unless the texts of the deck exceed the limit with it.
fn within_budget(value: Value, parameters: &Parameters) -> Result<Value, Complaint> {
    match &value {
        Value::Text(text) if parameters.text_bytes + text.len() > MAX_TEXT_IN_ALL => {
            let complaint = format!("the texts of all parameters are longer than the {MAX_TEXT_IN_ALL} bytes allowed");
            Err(Complaint::new(complaint).help("leave out texts that nothing uses, or write them where they are used"))
        }
        _ => Ok(value),
    }
}
