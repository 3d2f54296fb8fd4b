//! Any bytes end in values or problems, and arithmetic agrees with a reference that works on the tree.

use inpact_parser::expression::{Parameters, StatementLine, Value, define, references, substitute};
use inpact_parser::grammar::Release;
use inpact_parser::span::{SourceId, Span};
use proptest::prelude::*;

/// An expression as a tree: what the text is printed from, and what the reference computes.
#[derive(Debug, Clone)]
enum Tree {
    Integer(i64),
    Real(f64),
    Sign(char, Box<Tree>),
    Binary(&'static str, Box<Tree>, Box<Tree>),
    Parentheses(Box<Tree>),
}

/// A number of the reference.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Number {
    Integer(i128),
    Real(f64),
}

fn tree() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![
        3 => (0_i64..13).prop_map(Tree::Integer),
        1 => any::<i64>().prop_map(|value| Tree::Integer(value.max(0))),
        2 => (0_u32..4000).prop_map(|value| Tree::Real(f64::from(value) / 8.0)),
        1 => any::<f64>().prop_map(|value| Tree::Real(if value.is_finite() { value.abs() } else { 0.5 })),
    ];
    leaf.prop_recursive(6, 40, 2, |inner| {
        let operator = prop::sample::select(vec!["+", "-", "*", "/", "//", "%", "**", "+", "-", "*"]);
        prop_oneof![
            5 => (operator, inner.clone(), inner.clone())
                .prop_map(|(operator, left, right)| Tree::Binary(operator, Box::new(left), Box::new(right))),
            1 => (prop::sample::select(vec!['+', '-']), inner.clone())
                .prop_map(|(sign, operand)| Tree::Sign(sign, Box::new(operand))),
            1 => inner.prop_map(|operand| Tree::Parentheses(Box::new(operand))),
        ]
    })
}

/// The precedence of the outermost operator: sum, product, sign, power, atom.
fn level(tree: &Tree) -> u8 {
    match tree {
        Tree::Binary("+" | "-", ..) => 1,
        Tree::Binary("**", ..) => 4,
        Tree::Binary(..) => 2,
        Tree::Sign(..) => 3,
        Tree::Integer(_) | Tree::Real(_) | Tree::Parentheses(_) => 5,
    }
}

/// The text of a tree with no parentheses but those it needs where `least` is the loosest operator that may occur.
fn print(tree: &Tree, least: u8, gap: &str) -> String {
    let bare = match tree {
        Tree::Integer(value) => value.to_string(),
        Tree::Real(value) => format!("{value:?}"),
        Tree::Parentheses(inner) => format!("({})", print(inner, 1, gap)),
        Tree::Sign(sign, operand) => format!("{sign}{}", print(operand, 3, gap)),
        Tree::Binary(operator, left, right) => {
            let (left_least, right_least) = match *operator {
                "+" | "-" => (1, 2),
                "**" => (5, 3),
                _ => (2, 3),
            };
            format!("{}{gap}{operator}{gap}{}", print(left, left_least, gap), print(right, right_least, gap))
        }
    };
    if level(tree) < least { format!("({bare})") } else { bare }
}

/// The value in Python 2, or `None` where it fails, leaves 64 bits or is not finite.
fn reference(tree: &Tree) -> Option<Number> {
    match tree {
        Tree::Integer(value) => Some(Number::Integer(i128::from(*value))),
        Tree::Real(value) => Some(Number::Real(*value)),
        Tree::Parentheses(inner) => reference(inner),
        Tree::Sign(sign, operand) => match (sign, reference(operand)?) {
            ('-', Number::Integer(value)) => fitting(-value),
            ('-', Number::Real(value)) => Some(Number::Real(-value)),
            (_, number) => Some(number),
        },
        Tree::Binary(operator, left, right) => match (reference(left)?, reference(right)?) {
            (Number::Integer(left), Number::Integer(right)) => reference_integer(left, operator, right),
            (left, right) => reference_real(real(left), operator, real(right)),
        },
    }
}

fn real(number: Number) -> f64 {
    match number {
        Number::Integer(value) => value as f64,
        Number::Real(value) => value,
    }
}

fn fitting(value: i128) -> Option<Number> {
    i64::try_from(value).ok().map(|value| Number::Integer(i128::from(value)))
}

fn reference_integer(left: i128, operator: &str, right: i128) -> Option<Number> {
    // Towards minus infinity: Euclid's division does so for a positive divisor.
    let floor = || if right > 0 { left.div_euclid(right) } else { (-left).div_euclid(-right) };
    match operator {
        "+" => fitting(left + right),
        "-" => fitting(left - right),
        "*" => fitting(left * right),
        "**" if right < 0 => reference_real(left as f64, operator, right as f64),
        "**" => {
            let mut power = 1;
            // Beyond 64 doublings every base but -1, 0 and 1 has left 64 bits; those repeat with every second step.
            let steps = if right > 64 { 64 + right % 2 } else { right };
            for _ in 0..steps {
                power *= left;
                if power.abs() > 1 << 63 {
                    return None;
                }
            }
            fitting(power)
        }
        _ if right == 0 => None,
        "%" => fitting(left - right * floor()),
        _ => fitting(floor()),
    }
}

fn reference_real(left: f64, operator: &str, right: f64) -> Option<Number> {
    if matches!(operator, "/" | "//" | "%") && right == 0.0 {
        return None;
    }
    let result = match operator {
        "+" => left + right,
        "-" => left - right,
        "*" => left * right,
        "/" => left / right,
        "**" => left.powf(right),
        // CPython's float_divmod, 2.7 and later.
        _ => {
            let mut remainder = left % right;
            let mut quotient = (left - remainder) / right;
            if remainder == 0.0 {
                remainder = f64::copysign(0.0, right);
            } else if (right < 0.0) != (remainder < 0.0) {
                remainder += right;
                quotient -= 1.0;
            }
            let mut floor = quotient.floor();
            if quotient == 0.0 {
                floor = f64::copysign(0.0, left / right);
            } else if quotient - floor > 0.5 {
                floor += 1.0;
            }
            if operator == "%" { remainder } else { floor }
        }
    };
    result.is_finite().then_some(Number::Real(result))
}

fn evaluate(expression: &str) -> Option<Number> {
    let (mut parameters, mut problems) = (Parameters::of_release(Release::R2022), Vec::new());
    let statement = format!("x = {expression}");
    let span = Span::new(SourceId::ROOT, 0, statement.len() as u64);
    define([StatementLine { span, text: statement.as_bytes() }], &mut parameters, &mut problems);
    assert_eq!(problems.is_empty(), parameters.value("x").is_some(), "{statement}: {problems:?}");
    match parameters.value("x")? {
        Value::Integer(value) => Some(Number::Integer(i128::from(*value))),
        Value::Real(value) => Some(Number::Real(*value)),
        Value::Text(text) => panic!("{statement} gives the text {text}"),
    }
}

/// Bytes that look like statements often enough to reach every branch.
fn statement_bytes() -> impl Strategy<Value = Vec<u8>> {
    let tokens = [
        "a",
        "b",
        "pi",
        "str",
        "max",
        "log",
        "lambda",
        "1",
        "2.5",
        "1.d0",
        "9223372036854775807",
        "1e308",
        "'",
        "\"",
        "'t'",
        "=",
        "==",
        "+=",
        "+",
        "-",
        "*",
        "**",
        "/",
        "//",
        "%",
        "(",
        ")",
        ",",
        ";",
        "#",
        "\\",
        "\n",
        "\\\n",
        " ",
        "\t",
        "<",
        "a = ",
        "\na = ",
    ];
    let token = prop::sample::select(tokens.to_vec()).prop_map(|token| token.as_bytes().to_vec());
    let piece = prop_oneof![12 => token, 1 => prop::collection::vec(any::<u8>(), 0..4)];
    prop::collection::vec(piece, 0..60).prop_map(|pieces| pieces.concat())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn arithmetic_agrees_with_the_reference(tree in tree(), gap in prop::sample::select(vec!["", " ", "\t "])) {
        let text = print(&tree, 1, gap);
        let bits = |number: Number| match number {
            Number::Integer(value) => ("integer", value),
            // Bits, so that the sign of zero counts.
            Number::Real(value) => ("real", i128::from(value.to_bits())),
        };
        prop_assert_eq!(evaluate(&text).map(bits), reference(&tree).map(bits), "{}", text);
    }

    #[test]
    fn any_bytes_end_in_values_or_problems(bytes in statement_bytes()) {
        let mut start = 0;
        let lines: Vec<StatementLine<'_>> = bytes
            .split(|byte| *byte == b'\n')
            .map(|text| {
                let span = Span::new(SourceId::ROOT, start, start + text.len() as u64);
                start = span.end() + 1;
                StatementLine { span, text }
            })
            .collect();
        let (mut parameters, mut problems) = (Parameters::of_release(Release::R2022), Vec::new());
        define(lines, &mut parameters, &mut problems);
        let of_problems = problems.iter().map(|problem| problem.span);
        let of_definitions = parameters.definitions().iter().map(|definition| definition.span);
        for span in of_problems.chain(of_definitions) {
            prop_assert!(span.start() <= span.end() && span.end() <= bytes.len() as u64, "{:?}", span);
        }
        for definition in parameters.definitions() {
            let is_finite = definition.value.as_ref().and_then(Value::as_number).is_none_or(f64::is_finite);
            prop_assert!(is_finite, "{:?}", definition);
            prop_assert_eq!(&parameters.definition(&definition.name).unwrap().name, &definition.name);
        }
        if problems.is_empty() {
            prop_assert!(parameters.definitions().iter().all(|definition| definition.value.is_some()));
        }
    }

    #[test]
    fn real_values_read_back(value in any::<f64>().prop_filter("finite", |value| value.is_finite())) {
        let shown = Value::Real(value).to_string();
        let read = inpact_parser::number::read_float(shown.as_bytes());
        prop_assert_eq!(read.map(f64::to_bits), Ok(value.to_bits()));
    }

    #[test]
    fn references_are_found_in_any_text(text in "[<>ab_1 ,é]{0,40}") {
        let found: Vec<_> = references(text.as_bytes()).collect();
        for reference in &found {
            let written = &text[reference.range.clone()];
            prop_assert_eq!(written.trim_matches(['<', '>', ' ']), reference.name);
        }
        // Every `<` up to the next `>` is one candidate; the reference takes what a name is by its definition.
        let candidates = text.match_indices('>').filter(|(end, _)| {
            let bracket = text[..*end].rfind(['<', '>']);
            let Some(open) = bracket.filter(|open| text[*open..].starts_with('<')) else { return false };
            let name = text[open + 1..*end].trim_matches(' ');
            let mut characters = name.chars();
            characters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == '_')
                && characters.all(|character| character.is_ascii_alphanumeric() || character == '_')
        });
        prop_assert_eq!(candidates.count(), found.len());
        prop_assert_eq!(substitute(&text, &Parameters::new()).is_ok(), found.is_empty());
    }
}
