//! Hostile *PARAMETER blocks end in a problem; time and memory follow the length of the block.

use inpact_parser::expression::{
    ExpressionProblem, MAX_NESTING, MAX_TEXT, MAX_TEXT_IN_ALL, Parameters, StatementLine, SubstitutionError, Value,
    define, references, substitute,
};
use inpact_parser::span::{SourceId, Span};
use std::time::{Duration, Instant};

/// Quadratic cost takes many minutes at this size, linear cost a second.
const MANY: usize = 1 << 18;

/// A quarter of it, as a value.
const QUARTER: i64 = 1 << 16;

fn run(lines: &[&[u8]]) -> (Parameters, Vec<ExpressionProblem>) {
    let started = Instant::now();
    let (mut parameters, mut problems) = (Parameters::new(), Vec::new());
    let lines = lines.iter().map(|text| StatementLine { span: Span::new(SourceId::ROOT, 0, text.len() as u64), text });
    define(lines, &mut parameters, &mut problems);
    assert!(started.elapsed() < Duration::from_secs(60), "took {:?}", started.elapsed());
    (parameters, problems)
}

fn message(statement: &str) -> String {
    let (_, mut problems) = run(&[statement.as_bytes()]);
    assert_eq!(problems.len(), 1, "{problems:?}");
    problems.remove(0).message
}

fn value(statement: &str) -> Option<Value> {
    let (parameters, problems) = run(&[statement.as_bytes()]);
    assert_eq!(problems, []);
    parameters.value("a").cloned()
}

#[test]
fn nesting_is_limited_and_needs_little_stack() {
    let nested = |open: &str, close: &str, depth: usize| format!("a = {}1{}", open.repeat(depth), close.repeat(depth));
    let check = move || {
        let deepest = MAX_NESTING;
        for (open, close) in
            [("(", ")"), ("abs(", ")"), ("+", ""), ("-", ""), ("1**", ""), ("max(0,", ")"), ("-(", ")")]
        {
            let steps = if open == "-(" { deepest / 2 } else { deepest };
            let number = value(&nested(open, close, steps)).and_then(|value| value.as_number());
            assert_eq!(number.map(f64::abs), Some(1.0), "{open}");
            for depth in [deepest + 1, MANY] {
                let message = message(&nested(open, close, depth));
                assert_eq!(message, format!("the expression is nested more than {MAX_NESTING} deep"), "{open}");
            }
        }
    };
    // Far less than any thread has.
    std::thread::Builder::new().stack_size(64 << 10).spawn(check).unwrap().join().unwrap();
}

#[test]
fn long_chains_are_no_nesting() {
    assert_eq!(value(&format!("a = 1{}", " + 1".repeat(MANY / 4))), Some(Value::Integer(1 + QUARTER)));
    assert_eq!(value(&format!("a = 0{}", " + (-1)*1".repeat(MANY / 4))), Some(Value::Integer(-QUARTER)));
}

#[test]
fn huge_integers_and_powers() {
    assert!(message(&format!("a = {}", "9".repeat(MANY))).ends_with("is beyond 64 bits"));
    assert!(message("a = 9**9**9**9**9**9").ends_with("is beyond 64 bits"));
    assert!(message("a = 10**1000000000").ends_with("is beyond 64 bits"));
    assert!(message("a = 1e308**1e308").ends_with("is beyond the largest real number, 1.797E308"));
    assert_eq!(value(&format!("a = 0.{}1", "0".repeat(MANY))), Some(Value::Real(0.0)));
}

#[test]
fn long_texts() {
    let too_long = |bytes: usize| format!("a text of {bytes} bytes is longer than the {MAX_TEXT} allowed");
    assert_eq!(value(&format!("a = '{}'", "x".repeat(MAX_TEXT))), Some(Value::Text("x".repeat(MAX_TEXT))));
    assert_eq!(value(&format!("a = '{}'", "\\'".repeat(MAX_TEXT))), Some(Value::Text("'".repeat(MAX_TEXT))));
    assert_eq!(message(&format!("a = '{}'", "x".repeat(MAX_TEXT + 1))), too_long(MAX_TEXT + 1));
    assert_eq!(message(&format!("a = '{}'", "x".repeat(MANY))), too_long(MANY));
    assert_eq!(message(&format!("a = {}''", "'xxxxxxxx' + ".repeat(MANY / 8))), too_long(MAX_TEXT + 8));

    let mut doubling: Vec<&[u8]> = vec![b"a = 'xxxx'"];
    doubling.extend(std::iter::repeat_n(&b"a = a + a"[..], 100));
    let (_, problems) = run(&doubling);
    assert_eq!(problems.len(), 1);
    assert_eq!(problems[0].message, too_long(2 * MAX_TEXT));
}

#[test]
fn many_texts() {
    let first = format!("a = '{}'", "x".repeat(MAX_TEXT));
    let mut copies: Vec<&[u8]> = vec![first.as_bytes()];
    copies.extend(std::iter::repeat_n(&b"b=a"[..], MANY / 4));
    let (parameters, problems) = run(&copies);
    let kept = parameters.definitions().iter().filter(|definition| definition.value.is_some()).count();
    assert_eq!(kept, MAX_TEXT_IN_ALL / MAX_TEXT);
    assert_eq!(problems.len(), MANY / 4 + 1 - kept);
}

#[test]
fn many_statements_on_one_line() {
    let (parameters, problems) = run(&["a=1;".repeat(MANY / 4).as_bytes()]);
    assert_eq!((parameters.definitions().len(), problems.len()), (MANY / 4, 0));
    let (_, problems) = run(&["a=;".repeat(MANY / 4).as_bytes()]);
    assert_eq!(problems.len(), MANY / 4);
    let (_, problems) = run(&[";".repeat(MANY / 4).as_bytes()]);
    assert_eq!(problems.len(), MANY / 4);
}

#[test]
fn many_lines_of_one_statement() {
    let continued = vec![&b"1 + \\"[..]; MANY / 4];
    let mut sum: Vec<&[u8]> = vec![b"a = \\"];
    sum.extend(&continued);
    sum.push(b"1");
    let (parameters, _) = run(&sum);
    assert_eq!(parameters.value("a"), Some(&Value::Integer(1 + QUARTER)));

    let mut open: Vec<&[u8]> = vec![b"a = ("];
    open.extend(vec![&b"1 +"[..]; MANY / 4]);
    assert_eq!(run(&open).1.len(), 1);
    let mut quoted: Vec<&[u8]> = vec![b"a = '\\"];
    quoted.extend(vec![&b"x\\"[..]; MANY / 4]);
    assert_eq!(run(&quoted).1.len(), 1);
    let (_, problems) = run(&vec![&b"a = (("[..]; MANY / 16]);
    assert_eq!(problems.len(), MANY / 16);
}

#[test]
fn many_names_and_arguments() {
    let names = "a, ".repeat(MANY / 4) + "b = 1";
    let (parameters, problems) = run(&[names.as_bytes()]);
    assert_eq!((parameters.definitions().len(), problems.len()), (MANY / 4 + 1, 1));
    assert_eq!(message(&format!("a = max({})", "1,".repeat(MANY / 4))), "`max` takes 2 to 255 arguments, more given");
    assert_eq!(value(&format!("a = max({})", "1,".repeat(255))), Some(Value::Integer(1)));
    assert_eq!(
        message(&format!("a = {}", "b".repeat(MANY))),
        format!("`{}…` is used before it is defined", "b".repeat(40))
    );
}

#[test]
fn long_runs_of_anything() {
    for piece in [
        "a", "1", "'", "\"", "\\", "\\ ", " ", "(", ")", "=", "#", "é", "\u{0}", "1.", "e", "1e", "<", ",", "*", "a=(",
        "'\\", "a(", "1d1",
    ] {
        let text = piece.repeat(MANY / piece.len());
        run(&[text.as_bytes()]);
        run(&[format!("a = {text}").as_bytes()]);
        assert!(references(text.as_bytes()).next().is_none());
    }
}

#[test]
fn substitution_does_not_explode() {
    let text = format!("a = '{}'", "x".repeat(MAX_TEXT));
    let (parameters, _) = run(&[text.as_bytes(), b"n = -1./3"]);
    assert_eq!(substitute(&"<a>".repeat(64), &parameters).unwrap().len(), 64 * MAX_TEXT);
    let row = "<a>".repeat(MANY / 4);
    assert_eq!(
        substitute(&row, &parameters),
        Err(SubstitutionError::TooLong { bytes: row.len(), most: 16 * row.len() + 65_536 })
    );
    // A quarter of a million numbers on a line are long, but no explosion.
    assert_eq!(substitute(&"<n>,".repeat(MANY), &parameters).unwrap(), "-0.3333333333333333,".repeat(MANY));
    assert_eq!(references("<<a>".repeat(MANY / 4).as_bytes()).count(), MANY / 4);
    assert_eq!(references("<a".repeat(MANY / 2).as_bytes()).count(), 0);
}
