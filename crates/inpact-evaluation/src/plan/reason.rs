//! Reasons why something is left out of an evaluation.

use crate::error::Error;
use crate::nodes::Column;
use crate::results::{Output, number_text};
use std::fmt;

/// A part that an evaluation leaves out.
#[derive(Debug, Clone, PartialEq)]
pub struct LeftOut {
    /// Its name: a law, a table, outputs.
    pub what: String,
    /// The outputs concerned, where it is outputs.
    pub outputs: Vec<Output>,
    /// Why.
    pub reason: Reason,
}

impl LeftOut {
    /// A law, or another named part.
    pub(crate) fn law(what: &str, reason: Reason) -> Self {
        Self { what: what.to_owned(), outputs: Vec::new(), reason }
    }
}

/// Why something is left out.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Reason {
    /// Columns of the node table are missing or empty.
    Missing(Missing),
    /// The law is that of a user subroutine (U-3).
    NeedsUserSubroutine(&'static str),
    /// The deck has no such keyword in the interaction.
    NoKeyword(&'static str),
    /// The keyword has no rows (K-11).
    NoRows(&'static str),
    /// The rows of a table do not form one.
    BrokenTable(Error),
    /// The curves of CalculiX do not form a conductance.
    BrokenCurves(Error),
    /// *PHYSICAL CONSTANTS does not give a constant that radiation needs (T-42).
    NoConstant(&'static str),
    /// *GAP RADIATION does not have two emissivities from 0 to 1.
    BadEmissivities,
    /// CalculiX has no such keyword, or requires another beside it.
    NotInCalculix(&'static str),
    /// Pore pressure on one side only: the interface is impermeable (P-01).
    OneSided {
        /// The side that has none.
        missing: Column,
    },
    /// No *CONTACT PERMEABILITY, and no procedure of the deck solves pore pressure (P-03).
    NoPoreAnalysis,
    /// No row is closed.
    NoRowClosed,
    /// No row is open.
    NoRowOpen,
    /// An infinite permeability is not a number (P-30).
    InfinitePermeability,
    /// USER of *SURFACE INTERACTION switches heat generation off (K-05).
    HeatSwitchedOff,
    /// Current generates heat of unknown amount.
    CurrentUnknown(Box<Reason>),
    /// The program has no such law.
    NotEvaluated,
    /// The contract has no column of that name.
    UnknownColumn,
    /// An option of the command line overrides it.
    Option(&'static str),
    /// A column of both sides together has the number in every row.
    GivenBy(Column),
    /// No table in use depends on it: every table has one value of it.
    NoTableDepends,
    /// Nothing that is evaluated needs it.
    NotNeeded,
    /// Steady state does not use it (C-24).
    SteadyState,
    /// It has no number in any row that could use it.
    Empty,
    /// Other outputs were requested by name.
    NotRequested,
    /// It has the same value in every row, and the tables are folded along it.
    Folded(f64),
}

/// Columns of the node table without numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Missing {
    /// The columns.
    pub columns: Vec<Column>,
    /// A column that could replace all of them.
    pub or: Option<Column>,
    /// Whether they are present, but empty in the rows of the interaction.
    pub how: Lack,
}

/// In what way a column has no numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lack {
    /// It is absent.
    Absent,
    /// It is empty in all rows of the interaction.
    Empty,
}

impl From<Missing> for Reason {
    fn from(missing: Missing) -> Self {
        Self::Missing(missing)
    }
}

impl Missing {
    pub(crate) fn absent(columns: Vec<Column>) -> Self {
        Self { columns, or: None, how: Lack::Absent }
    }

    pub(crate) fn empty(columns: Vec<Column>) -> Self {
        Self { columns, or: None, how: Lack::Empty }
    }

    pub(crate) fn or(self, column: Column) -> Self {
        Self { or: Some(column), ..self }
    }
}

impl fmt::Display for Missing {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let columns: Vec<String> = self.columns.iter().map(|column| format!("`{column}`")).collect();
        let are = if columns.len() == 1 { "is" } else { "are" };
        write!(formatter, "{}", columns.join(" and "))?;
        if let Some(or) = self.or {
            write!(formatter, " (or `{or}`)")?;
        }
        match self.how {
            Lack::Absent => write!(formatter, " {are} missing"),
            Lack::Empty => write!(formatter, " {are} empty in all its rows"),
        }
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing(missing) => missing.fmt(formatter),
            Self::NeedsUserSubroutine("GAPELECTR") => {
                formatter.write_str("needs user subroutine GAPELECTR; give it with `--user-library FILE`")
            }
            Self::NeedsUserSubroutine(name) => {
                write!(formatter, "needs user subroutine {name}, which is not evaluated")
            }
            Self::NoKeyword(keyword) => write!(formatter, "the interaction has no *{keyword}"),
            Self::NoRows(keyword) => write!(formatter, "*{keyword} has no rows"),
            Self::BrokenTable(error) => write!(formatter, "its rows form no table: {error}"),
            Self::BrokenCurves(error) => write!(formatter, "its rows form no conductance: {error}"),
            Self::NoConstant(name) => write!(formatter, "*PHYSICAL CONSTANTS does not give {name}"),
            Self::BadEmissivities => formatter.write_str("*GAP RADIATION has no two emissivities from 0 to 1"),
            Self::NotInCalculix(why) => write!(formatter, "CalculiX {why}"),
            Self::OneSided { missing } => {
                write!(
                    formatter,
                    "`{missing}` has no numbers: pore pressure on one side only, the interface is impermeable"
                )
            }
            Self::NoPoreAnalysis => formatter.write_str(
                "the interaction has no *CONTACT PERMEABILITY, and no procedure of the deck solves pore pressure",
            ),
            Self::NoRowClosed => formatter.write_str("no row is closed"),
            Self::NoRowOpen => formatter.write_str("no row is open"),
            Self::InfinitePermeability => formatter.write_str("the permeability is infinite, which is no number"),
            Self::HeatSwitchedOff => formatter.write_str("USER of *SURFACE INTERACTION switches heat generation off"),
            Self::CurrentUnknown(reason) => {
                write!(formatter, "the heat of the current is part of it and is not known: {reason}")
            }
            Self::NotEvaluated => formatter.write_str("no law of this program"),
            Self::UnknownColumn => formatter.write_str("a node table has no column of that name"),
            Self::Option(option) => write!(formatter, "`{option}` has the say"),
            Self::GivenBy(column) => write!(formatter, "`{column}` is given in every row"),
            Self::NoTableDepends => formatter.write_str("no table in use depends on it"),
            Self::NotNeeded => formatter.write_str("nothing that is evaluated needs it"),
            Self::SteadyState => formatter.write_str("steady state does not need it"),
            Self::NotRequested => formatter.write_str("not asked for"),
            Self::Folded(value) => {
                write!(formatter, "{} in every row, for which the tables are folded", number_text(*value))
            }
            Self::Empty => formatter.write_str("it has no number in the rows that could use it"),
        }
    }
}
