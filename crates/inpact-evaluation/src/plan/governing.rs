//! Which interaction governs a row.

use crate::nodes::{Batch, Column, Findings, Header, MISSING_COLUMN, Place, UNKNOWN_INTERACTION};
use inpact_parser::grammar::Dialect;
use inpact_parser::model::{Model, Name};
use std::collections::HashMap;

/// Sources of the interaction that governs a row; numbers are indices in the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GovernedBy {
    /// The user: one interaction for all rows.
    Chosen(usize),
    /// The deck, which has one only.
    TheOnlyOne(usize),
    /// Column `interaction`.
    Column,
}

impl GovernedBy {
    /// Decides by the user's choice, the header and the deck; `None` after reporting that none of them does (D001, D004).
    pub(crate) fn decide(
        model: &Model,
        header: &Header,
        chosen: Option<&Name>,
        findings: &mut Findings,
    ) -> Option<Self> {
        if let Some(name) = chosen {
            let found = find_interaction(model, name.written());
            if let Err(fault) = found {
                let message = match fault {
                    NameFault::Unknown => format!("the deck does not define the chosen interaction `{name}`"),
                    NameFault::Ambiguous => format!("the chosen interaction `{name}` may be one of several"),
                };
                findings.report(&UNKNOWN_INTERACTION, Place::default(), message, fault.help(model));
            }
            return found.ok().map(Self::Chosen);
        }
        if header.has(Column::Interaction) {
            return Some(Self::Column);
        }
        if model.interactions.len() > 1 {
            let count = model.interactions.len();
            let message = format!("column `interaction` is missing, and the deck has {count} interactions");
            let help = format!("add the column or choose an interaction for all rows; {}", names_help(model));
            findings.report(&MISSING_COLUMN, Place::default(), message, help);
            return None;
        }
        (!model.interactions.is_empty()).then_some(Self::TheOnlyOne(0))
    }
}

/// Finds the interaction of each row.
#[derive(Debug)]
pub struct RowInteractions<'a> {
    model: &'a Model,
    governed_by: GovernedBy,
    /// The index of column `interaction` among the labels.
    label: Option<usize>,
    /// The spellings so far; a table has few, however many rows.
    known: HashMap<Box<[u8]>, usize>,
    last: Option<(Vec<u8>, usize)>,
}

impl<'a> RowInteractions<'a> {
    /// Interactions of `model` for batches whose label column number `label` is `interaction`.
    pub fn new(model: &'a Model, governed_by: GovernedBy, label: Option<usize>) -> Self {
        Self { model, governed_by, label, known: HashMap::new(), last: None }
    }

    /// The index in the model of the interaction that governs a row; `None` where the row names none of the deck.
    #[inline]
    pub fn of_row(&mut self, batch: &Batch, row: usize) -> Option<usize> {
        let label = match self.governed_by {
            GovernedBy::Chosen(index) | GovernedBy::TheOnlyOne(index) => return Some(index),
            GovernedBy::Column => batch.labels[self.label?].get(row),
        };
        match &self.last {
            Some((text, index)) if text == label => Some(*index),
            _ => self.look_up(label),
        }
    }

    /// The end of the run of rows with the text of `first` in column `interaction`, and so its interaction.
    pub(crate) fn end_of_run(&self, batch: &Batch, first: usize) -> usize {
        let Some(label) = self.label.filter(|_| self.governed_by == GovernedBy::Column) else { return batch.rows };
        let label = &batch.labels[label];
        let text = label.get(first);
        (first + 1..batch.rows).find(|row| label.get(*row) != text).unwrap_or(batch.rows)
    }

    /// The cell of a row in column `interaction`; empty where there is none.
    pub(crate) fn label_of<'b>(&self, batch: &'b Batch, row: usize) -> &'b [u8] {
        self.label.map_or(&[], |label| batch.labels[label].get(row))
    }

    fn look_up(&mut self, label: &[u8]) -> Option<usize> {
        let known = self.known.get(label).copied();
        let index = known.or_else(|| self.index_of_new(label))?;
        if known.is_none() {
            self.known.insert(label.into(), index);
        }
        self.last = Some((label.to_vec(), index));
        Some(index)
    }

    fn index_of_new(&self, label: &[u8]) -> Option<usize> {
        let is_blank = label.trim_ascii().is_empty();
        if is_blank {
            // Nothing to choose between.
            return (self.model.interactions.len() == 1).then_some(0);
        }
        find_interaction(self.model, std::str::from_utf8(label).ok()?).ok()
    }
}

/// Reasons why a text names no interaction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum NameFault {
    /// The deck has none of that name.
    Unknown,
    /// Quoted names of the deck differ from it, and from each other, only by case and blanks.
    Ambiguous,
}

/// The index in the model of the interaction that a text names.
///
/// A match as in a deck (S-40, S-41) takes precedence. The quotes of a cell belong to the table and not to the name, so the text of a quoted name
/// matches too, and, if it is unique, so does a text that differs only by case and blanks.
///
/// # Errors
/// No match, or an ambiguous one.
pub(crate) fn find_interaction(model: &Model, text: &str) -> Result<usize, NameFault> {
    // In a deck of CalculiX quotes are part of the name (CX-02); no name of Abaqus has any, so one lookup serves both.
    if let Some(index) = model.interactions.get_index_of(&Name::in_dialect(text, Dialect::Calculix)) {
        return Ok(index);
    }
    let name = Name::new(text);
    let exact = || model.interactions.keys().position(|known| known.is_quoted() && known.canonical() == text.trim());
    if let Some(index) = model.interactions.get_index_of(&name).or_else(exact) {
        return Ok(index);
    }
    let is_near = |known: &Name| !name.is_quoted() && known.differs_by_quotes_only(&name);
    let mut near = model.interactions.keys().enumerate().filter(|(_, known)| is_near(known));
    match (near.next(), near.next()) {
        (Some((index, _)), None) => Ok(index),
        (None, _) => Err(NameFault::Unknown),
        (Some(_), Some(_)) => Err(NameFault::Ambiguous),
    }
}

impl NameFault {
    /// The help.
    pub fn help(self, model: &Model) -> String {
        match self {
            Self::Unknown => names_help(model),
            Self::Ambiguous => format!("write it as the deck does, case and blanks included; {}", names_help(model)),
        }
    }
}

/// The names that could be meant.
fn names_help(model: &Model) -> String {
    const MOST: usize = 8;
    let mut names: Vec<String> = model.interactions.keys().take(MOST).map(|name| format!("`{name}`")).collect();
    if model.interactions.len() > MOST {
        names.push("…".to_owned());
    }
    match names.len() {
        0 => "it has no *SURFACE INTERACTION".to_owned(),
        _ => format!("its interactions are {}", names.join(", ")),
    }
}
