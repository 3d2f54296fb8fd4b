//! Limits of the values of scenes, shared by the scene file and its tables.

use super::Field;
use super::rules::{MALFORMED_SCENE, UNUSABLE_NUMBER};
use inpact_diagnostics::Rule;

/// A rejection: the rule, the message and the help.
pub(super) struct Refusal {
    pub(super) rule: &'static Rule,
    /// The header of the column, where it is about one cell of a table.
    pub(super) column: Option<String>,
    pub(super) message: String,
    pub(super) help: String,
}

impl Refusal {
    pub(super) fn new(rule: &'static Rule, message: String, help: impl Into<String>) -> Self {
        Self { rule, column: None, message, help: help.into() }
    }

    /// About the cell of that column.
    pub(super) fn at(self, column: &str) -> Self {
        Self { column: Some(column.to_owned()), ..self }
    }

    pub(super) fn with_help(self, help: &str) -> Self {
        Self { help: help.to_owned(), ..self }
    }
}

/// Limits of a number.
#[derive(Debug, Clone, Copy)]
enum Must {
    BeFinite,
    NotBeNegative,
    ExceedZero,
    Conduct,
    BeShare,
}

impl Must {
    /// The limits of a key of the scene file; columns of tables mean one of those.
    fn of(key: &str) -> Self {
        match key {
            "area" => Self::ExceedZero,
            "capacity" | "char_length" | "perm_s" | "perm_m" => Self::NotBeNegative,
            "electrical" | "thermal" | "hydraulic" => Self::Conduct,
            "joule_heat_fraction" => Self::BeShare,
            _ => Self::BeFinite,
        }
    }

    fn allows(self, value: f64) -> bool {
        match self {
            Self::BeFinite => value.is_finite(),
            Self::NotBeNegative => value >= 0.0 && value.is_finite(),
            Self::ExceedZero => value > 0.0 && value.is_finite(),
            Self::Conduct => value >= 0.0,
            Self::BeShare => (0.0..=1.0).contains(&value),
        }
    }

    /// The help of a rejection.
    fn help(self) -> &'static str {
        match self {
            Self::BeFinite => "give a finite number",
            Self::NotBeNegative => "give a finite number of zero or above",
            Self::ExceedZero => "give a finite number above zero",
            Self::Conduct => "give a conductance of zero or above; `inf` makes both nodes one",
            Self::BeShare => "give a share of the energy dissipated, from 0 to 1",
        }
    }
}

/// Checks the number of a key; `written` is its text, `what` its name in messages.
pub(super) fn number(key: &str, value: f64, written: &str, what: impl FnOnce() -> String) -> Result<(), Refusal> {
    let must = Must::of(key);
    if let Some(lost) = lost(value, written) {
        let message = format!("{} is {written}, {lost} the range of numbers", what());
        return Err(Refusal::new(&UNUSABLE_NUMBER, message, must.help()));
    }
    if must.allows(value) {
        return Ok(());
    }
    Err(Refusal::new(&UNUSABLE_NUMBER, format!("{} is {written}", what()), must.help()))
}

/// Overflow or underflow from text to f64: such digits mean neither infinity nor zero.
pub(super) fn lost(value: f64, written: &str) -> Option<&'static str> {
    let mantissa = written.split(['e', 'E']).next().unwrap_or_default();
    let has_digit = mantissa.bytes().any(|byte| matches!(byte, b'1'..=b'9'));
    match value {
        _ if !has_digit => None,
        _ if value.is_infinite() => Some("beyond"),
        _ if value == 0.0 => Some("below"),
        _ => None,
    }
}

/// Whether a name is valid for a node.
pub(super) fn node_name(name: &str, what: impl FnOnce() -> String) -> Result<(), Refusal> {
    if name.is_empty() {
        return Err(Refusal::new(&MALFORMED_SCENE, format!("{} is empty", what()), "give the name of a node"));
    }
    Ok(())
}

/// The given keys of a condition.
#[derive(Clone, Copy)]
pub(super) struct Given {
    pub(super) fixed: bool,
    pub(super) source: bool,
    pub(super) capacity: bool,
    pub(super) initial: bool,
}

/// Checks that the given keys of a field at a node agree.
pub(super) fn condition(field: Field, given: Given, node: &str) -> Result<(), Refusal> {
    if given.fixed && (given.source || given.capacity) {
        let other = if given.source { "source" } else { "capacity" };
        let message = format!("the {field} of `{node}` has `fixed` and `{other}`");
        let help = "what is held takes up whatever flows there: leave one of the two out";
        return Err(Refusal::new(&MALFORMED_SCENE, message, help));
    }
    if field == Field::Potential && (given.capacity || given.initial) {
        let message = format!("the potential of `{node}` cannot have a capacity or an initial value");
        let help = "currents are steady at every instant (direct current), as in Abaqus";
        return Err(Refusal::new(&MALFORMED_SCENE, message, help));
    }
    Ok(())
}

/// Whether a link or an interface joins two nodes.
pub(super) fn joined(nodes: [&str; 2], what: &str) -> Result<(), Refusal> {
    if nodes[0] == nodes[1] {
        let message = format!("{what} joins `{}` to itself", nodes[0]);
        return Err(Refusal::new(&MALFORMED_SCENE, message, "name two nodes"));
    }
    Ok(())
}

/// Checks that a link has a conductance, zero included.
pub(super) fn conducting(has_conductance: bool, what: &str) -> Result<(), Refusal> {
    if !has_conductance {
        let help = "give `electrical`, `thermal` or `hydraulic`";
        return Err(Refusal::new(&MALFORMED_SCENE, format!("{what} conducts nothing"), help));
    }
    Ok(())
}
