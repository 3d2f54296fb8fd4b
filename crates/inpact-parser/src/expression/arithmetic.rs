//! The operators of Python 2 on integers, real numbers and texts (S-60).
//!
//! Integers are computed in 128 bits and must come out within 64; real numbers must come out finite.

use super::division::Division;
use super::value::Value;
use super::{Complaint, MAX_TEXT};

/// An operator between two operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
    FloorDivide,
    Remainder,
    Power,
}

impl Operator {
    /// Its sign in an expression.
    fn symbol(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::FloorDivide => "//",
            Self::Remainder => "%",
            Self::Power => "**",
        }
    }
}

/// `left operator right`.
pub(super) fn binary(left: Value, operator: Operator, right: &Value, division: Division) -> Result<Value, Complaint> {
    match (left, right) {
        (Value::Integer(left), Value::Integer(right)) if operator == Operator::Divide && division == Division::True => {
            true_division(left, *right)
        }
        (Value::Integer(left), Value::Integer(right)) => integers(left, operator, *right),
        (Value::Text(left), Value::Text(right)) if operator == Operator::Add => concatenate(left, right),
        (left, right) => match (left.as_number(), right.as_number()) {
            (Some(left), Some(right)) => reals(left, operator, right),
            _ => Err(mismatch(&left, operator, right)),
        },
    }
}

/// `-operand`.
pub(super) fn negate(operand: &Value) -> Result<Value, Complaint> {
    match operand {
        Value::Integer(value) => integer(-i128::from(*value)),
        Value::Real(value) => Ok(Value::Real(-value)),
        Value::Text(_) => Err(sign_of_text()),
    }
}

/// `+operand`.
pub(super) fn unsigned(operand: Value) -> Result<Value, Complaint> {
    match operand {
        Value::Text(_) => Err(sign_of_text()),
        number => Ok(number),
    }
}

fn sign_of_text() -> Complaint {
    Complaint::new("a text has no sign")
}

/// An integer, if it fits.
pub(super) fn integer(value: i128) -> Result<Value, Complaint> {
    i64::try_from(value).map(Value::Integer).map_err(|_| integer_too_large(&format!("the integer {value}")))
}

/// The complaint about an integer that does not fit.
pub(super) fn integer_too_large(which: &str) -> Complaint {
    Complaint::new(format!("{which} is beyond 64 bits")).help("give one number a decimal point, to compute with reals")
}

/// The complaint about a real number that does not fit.
pub(super) fn real_too_large(which: &str) -> Complaint {
    Complaint::new(format!("{which} is beyond the largest real number, 1.797E308"))
}

/// A text, if it is not too long.
pub(super) fn text(text: String) -> Result<Value, Complaint> {
    if text.len() > MAX_TEXT {
        return Err(text_too_long(text.len()));
    }
    Ok(Value::Text(text))
}

/// The complaint about a text of that many bytes.
pub(super) fn text_too_long(bytes: usize) -> Complaint {
    Complaint::new(format!("a text of {bytes} bytes is longer than the {MAX_TEXT} allowed"))
        .help("write it in several parameters, each with a part of it")
}

fn concatenate(mut left: String, right: &str) -> Result<Value, Complaint> {
    left.push_str(right);
    text(left)
}

fn mismatch(left: &Value, operator: Operator, right: &Value) -> Complaint {
    let complaint =
        Complaint::new(format!("`{}` does not work between {} and {}", operator.symbol(), left.kind(), right.kind()));
    match operator {
        Operator::Add => {
            complaint.help("turn the number into a text with `str(…)`, or the text into a number with `float(…)`")
        }
        _ => complaint.help("texts can be joined with `+`, nothing else"),
    }
}

fn integers(left: i64, operator: Operator, right: i64) -> Result<Value, Complaint> {
    let (wide_left, wide_right) = (i128::from(left), i128::from(right));
    match operator {
        Operator::Add => integer(wide_left + wide_right),
        Operator::Subtract => integer(wide_left - wide_right),
        Operator::Multiply => integer(wide_left * wide_right),
        Operator::Divide | Operator::FloorDivide => integer(floor_division(wide_left, wide_right)?.0),
        Operator::Remainder => integer(floor_division(wide_left, wide_right)?.1),
        Operator::Power if right < 0 => real_power(left as f64, right as f64),
        Operator::Power => integer_power(left, right),
    }
}

/// The quotient as a real number, correctly rounded where both integers have no more than 53 bits.
fn true_division(left: i64, right: i64) -> Result<Value, Complaint> {
    if right == 0 {
        return Err(division_by_zero(left));
    }
    Ok(Value::Real(left as f64 / right as f64))
}

/// Both results of a division of integers, where there is a remainder.
pub(super) fn with_remainder(left: &Value, right: &Value) -> Option<(Value, Value)> {
    let (Value::Integer(left), Value::Integer(right)) = (left, right) else { return None };
    let (floor, remainder) = floor_division(i128::from(*left), i128::from(*right)).ok()?;
    if remainder == 0 {
        return None;
    }
    Some((integer(floor).ok()?, true_division(*left, *right).ok()?))
}

/// Quotient towards minus infinity, and the remainder, which has the divisor's sign.
fn floor_division(left: i128, right: i128) -> Result<(i128, i128), Complaint> {
    if right == 0 {
        return Err(division_by_zero(left));
    }
    let (quotient, remainder) = (left / right, left % right);
    let rounded_up = remainder != 0 && (remainder < 0) != (right < 0);
    Ok(if rounded_up { (quotient - 1, remainder + right) } else { (quotient, remainder) })
}

fn division_by_zero(dividend: impl std::fmt::Display) -> Complaint {
    Complaint::new(format!("{dividend} is divided by zero"))
}

fn integer_power(base: i64, exponent: i64) -> Result<Value, Complaint> {
    // Exponents at which only these bases stay in range.
    let exponent = match base {
        0 | 1 => exponent.min(1),
        -1 => exponent % 2,
        _ => exponent,
    };
    let power = u32::try_from(exponent).ok().and_then(|exponent| base.checked_pow(exponent));
    power.map(Value::Integer).ok_or_else(|| integer_too_large(&format!("{base}**{exponent}")))
}

fn reals(left: f64, operator: Operator, right: f64) -> Result<Value, Complaint> {
    let divides = matches!(operator, Operator::Divide | Operator::FloorDivide | Operator::Remainder);
    if divides && right == 0.0 {
        return Err(division_by_zero(Value::Real(left)));
    }
    let result = match operator {
        Operator::Add => left + right,
        Operator::Subtract => left - right,
        Operator::Multiply => left * right,
        Operator::Divide => left / right,
        Operator::FloorDivide => real_floor_division(left, right),
        Operator::Remainder => real_remainder(left, right),
        Operator::Power => return real_power(left, right),
    };
    if result.is_finite() {
        return Ok(Value::Real(result));
    }
    Err(real_too_large(&format!("{} {} {}", Value::Real(left), operator.symbol(), Value::Real(right))))
}

/// The remainder with the divisor's sign, as in Python.
fn real_remainder(left: f64, right: f64) -> f64 {
    let remainder = left % right;
    if remainder == 0.0 {
        return 0.0_f64.copysign(right);
    }
    if (remainder < 0.0) == (right < 0.0) { remainder } else { remainder + right }
}

/// The quotient towards minus infinity, by Python's algorithm: exact even where `left / right` would round up to the
/// next integer.
fn real_floor_division(left: f64, right: f64) -> f64 {
    let remainder = left % right;
    let mut quotient = (left - remainder) / right;
    if remainder != 0.0 && (remainder < 0.0) != (right < 0.0) {
        quotient -= 1.0;
    }
    if quotient == 0.0 {
        return 0.0_f64.copysign(left / right);
    }
    let floor = quotient.floor();
    if quotient - floor > 0.5 { floor + 1.0 } else { floor }
}

/// `base**exponent` in real numbers.
pub(super) fn real_power(base: f64, exponent: f64) -> Result<Value, Complaint> {
    let which = || format!("{}**{}", Value::Real(base), Value::Real(exponent));
    if base == 0.0 && exponent < 0.0 {
        return Err(Complaint::new(format!("{} is a division by zero", which())));
    }
    let power = base.powf(exponent);
    if power.is_nan() {
        return Err(Complaint::new(format!("{} is no real number: its base is negative", which())));
    }
    if power.is_infinite() {
        return Err(real_too_large(&which()));
    }
    Ok(Value::Real(power))
}
