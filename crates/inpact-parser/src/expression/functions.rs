//! The functions of S-60, and `min` and `max`.

use super::arithmetic::{integer, integer_too_large, real_power, real_too_large, text};
use super::value::{Value, python_text};
use super::{Complaint, MAX_ARGUMENTS, quoted};
use crate::number::{NumberError, read_float};
use std::cmp::Ordering;
use std::ops::RangeInclusive;

/// A function and its arguments.
pub(super) struct Function {
    pub(super) name: &'static str,
    /// The range of its number of arguments.
    pub(super) arguments: RangeInclusive<usize>,
    /// Computes it; the number of arguments has been checked.
    pub(super) compute: fn(&[Value]) -> Result<Value, Complaint>,
}

/// All functions, in the order in which messages list them.
pub(super) const FUNCTIONS: [Function; 16] = [
    Function { name: "abs", arguments: 1..=1, compute: abs },
    Function { name: "acos", arguments: 1..=1, compute: |values| real("acos", values, f64::acos) },
    Function { name: "asin", arguments: 1..=1, compute: |values| real("asin", values, f64::asin) },
    Function { name: "atan", arguments: 1..=1, compute: |values| real("atan", values, f64::atan) },
    Function { name: "cos", arguments: 1..=1, compute: |values| real("cos", values, f64::cos) },
    Function { name: "log", arguments: 1..=2, compute: log },
    Function { name: "log10", arguments: 1..=1, compute: |values| real("log10", values, f64::log10) },
    Function { name: "pow", arguments: 2..=2, compute: pow },
    Function { name: "sin", arguments: 1..=1, compute: |values| real("sin", values, f64::sin) },
    Function { name: "sqrt", arguments: 1..=1, compute: |values| real("sqrt", values, f64::sqrt) },
    Function { name: "tan", arguments: 1..=1, compute: |values| real("tan", values, f64::tan) },
    Function { name: "int", arguments: 1..=1, compute: int },
    Function { name: "float", arguments: 1..=1, compute: float },
    Function { name: "str", arguments: 1..=1, compute: str },
    Function { name: "min", arguments: 2..=MAX_ARGUMENTS, compute: |values| extreme("min", values, Ordering::Less) },
    Function { name: "max", arguments: 2..=MAX_ARGUMENTS, compute: |values| extreme("max", values, Ordering::Greater) },
];

/// The function of that name.
pub(super) fn function(name: &[u8]) -> Option<&'static Function> {
    FUNCTIONS.iter().find(|function| function.name.as_bytes() == name)
}

/// The names of all functions, for messages.
pub(super) fn names() -> String {
    FUNCTIONS.each_ref().map(|function| function.name).join(", ")
}

fn number(function: &str, value: &Value) -> Result<f64, Complaint> {
    value.as_number().ok_or_else(|| {
        Complaint::new(format!("`{function}` takes a number, not {}", value.kind()))
            .help("turn the text into a number with `float(…)`")
    })
}

fn real(name: &str, values: &[Value], compute: fn(f64) -> f64) -> Result<Value, Complaint> {
    let argument = number(name, &values[0])?;
    let result = compute(argument);
    // All of these are finite within their domain, so a non-finite result means outside of it: sqrt(-1), log(0).
    if result.is_finite() { Ok(Value::Real(result)) } else { Err(outside_domain(name, argument)) }
}

fn outside_domain(name: &str, argument: f64) -> Complaint {
    Complaint::new(format!("`{name}` has no value at {}", Value::Real(argument)))
}

fn abs(values: &[Value]) -> Result<Value, Complaint> {
    match &values[0] {
        Value::Integer(value) => integer(i128::from(*value).abs()),
        other => Ok(Value::Real(number("abs", other)?.abs())),
    }
}

/// `log(x)`, or `log(x, base)` as a quotient of logarithms, as in Python.
fn log(values: &[Value]) -> Result<Value, Complaint> {
    let logarithm = |value: &Value| {
        let argument = number("log", value)?;
        if argument > 0.0 { Ok(argument.ln()) } else { Err(outside_domain("log", argument)) }
    };
    let result = logarithm(&values[0])?;
    let Some(base) = values.get(1) else { return Ok(Value::Real(result)) };
    match logarithm(base)? {
        0.0 => Err(Complaint::new("`log` has no value for the base 1")),
        of_base => Ok(Value::Real(result / of_base)),
    }
}

fn pow(values: &[Value]) -> Result<Value, Complaint> {
    real_power(number("pow", &values[0])?, number("pow", &values[1])?)
}

fn int(values: &[Value]) -> Result<Value, Complaint> {
    // The bounds of i64 as reals; the upper one is the first real above i64::MAX.
    const BOUND: f64 = 9_223_372_036_854_775_808.0;
    match &values[0] {
        Value::Integer(value) => Ok(Value::Integer(*value)),
        Value::Real(value) if (-BOUND..BOUND).contains(&value.trunc()) => {
            #[allow(clippy::cast_possible_truncation)] // Meant: towards zero, and within the bounds.
            Ok(Value::Integer(*value as i64))
        }
        Value::Real(value) => Err(integer_too_large(&Value::Real(*value).to_string())),
        Value::Text(text) => {
            let digits = text.trim_ascii();
            let unsigned = digits.strip_prefix(['+', '-']).unwrap_or(digits);
            if unsigned.is_empty() || !unsigned.bytes().all(|byte| byte.is_ascii_digit()) {
                return Err(Complaint::new(format!("the text {} is no integer", quoted(text.as_bytes()))));
            }
            digits.parse().map(Value::Integer).map_err(|_| integer_too_large(&quoted(text.as_bytes())))
        }
    }
}

fn float(values: &[Value]) -> Result<Value, Complaint> {
    let Value::Text(text) = &values[0] else { return Ok(Value::Real(number("float", &values[0])?)) };
    let digits = text.trim_ascii().as_bytes();
    let has_d_exponent = digits.iter().any(|byte| matches!(byte, b'd' | b'D'));
    match read_float(digits) {
        Ok(value) if !has_d_exponent => Ok(Value::Real(value)),
        Err(NumberError::TooLarge) if !has_d_exponent => Err(real_too_large(&quoted(digits))),
        _ => Err(Complaint::new(format!("the text {} is no number", quoted(digits)))),
    }
}

fn str(values: &[Value]) -> Result<Value, Complaint> {
    text(match &values[0] {
        Value::Integer(value) => value.to_string(),
        Value::Real(value) => python_text(*value),
        Value::Text(text) => text.clone(),
    })
}

/// The first of the values that no other is less, or greater, than; it keeps its type.
fn extreme(name: &str, values: &[Value], better: Ordering) -> Result<Value, Complaint> {
    let mut best = (&values[0], number(name, &values[0])?);
    for value in &values[1..] {
        let candidate = number(name, value)?;
        let order = match (value, best.0) {
            // As reals 2**53 and 2**53 + 1 would be equal.
            (Value::Integer(candidate), Value::Integer(best)) => candidate.cmp(best),
            _ => candidate.partial_cmp(&best.1).unwrap_or(Ordering::Equal),
        };
        if order == better {
            best = (value, candidate);
        }
    }
    Ok(best.0.clone())
}
