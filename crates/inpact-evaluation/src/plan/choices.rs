//! Choices of a user for an evaluation, where deck and manuals leave them open.

use crate::accuracy::Wanted;
use crate::history::{ClosingHeat, HistoryStart};
use crate::law::pore::CutoffBoundary;
use crate::law::user::UserLaw;
use crate::results::Output;
use crate::table::Tail;
use inpact_parser::grammar::Dialect;
use inpact_parser::model::{Name, Regime};

/// The choices of an evaluation; the default is what deck and semantics say.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Choices {
    /// The interaction that governs every row, instead of the one that column `interaction` names.
    pub interaction: Option<Name>,
    /// Steady state or transient, instead of what the deck's procedures say.
    pub regime: Option<Regime>,
    /// The continuation of a table of electrical conductance beyond its last clearance.
    pub clearance_tail: Tail,
    /// The characteristic element length of all rows, L (P-20, Q-5).
    pub characteristic_length: Option<f64>,
    /// Whether pore fluid flows at the very cutoff.
    pub cutoff_boundary: CutoffBoundary,
    /// Whose meaning the keywords have: *GAP CONDUCTANCE and the heat of friction differ in CalculiX.
    pub dialect: Dialect,
    /// Whether slopes come out as well.
    pub derivatives: Derivatives,
    /// The conductance of interactions with *GAP ELECTRICAL CONDUCTANCE, USER; without it they have no electrical law (U-3).
    pub user_conductance: Option<UserLaw>,
    /// How exactly values are found.
    pub accuracy: Wanted,
    /// The outputs that are asked for by name; `None` for all there are.
    pub outputs: Option<Vec<Output>>,
    /// Where the histories of nodes start (C-25).
    pub history_start: HistoryStart,
    /// The jump in the heat of an increment that closes a circuit.
    pub closing_heat: ClosingHeat,
    /// Whether a current may flow where the rows do not tell of one.
    pub currents: Currents,
}

impl Choices {
    /// Whether one of these outputs is asked for, by name or because all are.
    pub(crate) fn asks_for(&self, outputs: &[Output]) -> bool {
        self.asks_where(|output| outputs.contains(output))
    }

    /// Whether an output that fulfils a condition is asked for, by name or because all are.
    pub(crate) fn asks_where(&self, is_meant: impl Fn(&Output) -> bool) -> bool {
        self.outputs.as_ref().is_none_or(|requested| requested.iter().any(is_meant))
    }
}

/// Whether a current may flow, and generate heat, where the rows have no potentials.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Currents {
    /// Yes, unless the deck has procedures of which none solves for one.
    #[default]
    OfTheDeck,
    /// No: the rows are those of a solution that has no potentials.
    None,
}

/// Whether the slopes of conductance and permeability come out (semantics 4.4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Derivatives {
    /// No.
    #[default]
    LeftOut,
    /// Along every variable the tables depend on.
    Given,
}
