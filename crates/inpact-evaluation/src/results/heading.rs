//! The columns of a written table after its key columns.

use super::batch::{ResultBatch, Status};
use super::output::Output;
use crate::nodes::{Column, NumberColumn};
use std::fmt;

/// A column after the key columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Heading {
    /// Numbers of a node table.
    Given(Column),
    /// A result.
    Result(Output),
}

impl Heading {
    pub(super) fn all(outputs: &[Output]) -> Vec<Self> {
        outputs.iter().copied().map(Self::Result).collect()
    }

    /// Whether its cells are numbers: the others are statuses.
    pub(super) fn is_number(self) -> bool {
        match self {
            Self::Given(_) => true,
            Self::Result(output) => output.is_number(),
        }
    }
}

impl fmt::Display for Heading {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Given(column) => column.fmt(formatter),
            Self::Result(output) => output.fmt(formatter),
        }
    }
}

/// Values of some rows besides their keys.
#[derive(Clone, Copy)]
pub(super) struct Values<'b> {
    pub(super) numbers: &'b [NumberColumn],
    /// `None` for rows of a node table, which has no statuses.
    pub(super) results: Option<&'b ResultBatch>,
}

impl<'b> Values<'b> {
    /// The statuses of a column of them.
    pub(super) fn statuses(self, heading: Heading) -> Option<&'b [Option<Status>]> {
        match heading {
            Heading::Given(_) => None,
            Heading::Result(output) => self.results?.statuses(output),
        }
    }
}
