//! The sub-options of an interaction by kind, and the meaning of those of heat and friction.
//!
//! An interaction keeps *GAP CONDUCTANCE, *GAP RADIATION and *FRICTION as written, each with its parameters and in the order of the deck, since a deck may give them several times.
//! [`Interaction::gap_conductance`], [`Interaction::gap_radiation`] and [`Interaction::friction`] interpret them.

use super::{Interaction, SubOption, Table, TableKind};
use crate::expression::Parameters;
use crate::span::Span;

/// The sub-options of an interaction that inpact interprets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum OptionKind {
    /// *GAP ELECTRICAL CONDUCTANCE (2.2).
    GapElectricalConductance,
    /// *CONTACT PERMEABILITY (2.3).
    ContactPermeability,
    /// *GAP CONDUCTANCE (2.4).
    GapConductance,
    /// *GAP HEAT GENERATION (2.5).
    GapHeatGeneration,
    /// *GAP RADIATION (2.6).
    GapRadiation,
    /// *FRICTION.
    Friction,
    /// *SURFACE BEHAVIOR.
    SurfaceBehavior,
    /// Any other.
    Other,
}

impl OptionKind {
    /// The kind of the option of a keyword, given in full and in upper case.
    ///
    /// ```
    /// use inpact_parser::model::OptionKind;
    ///
    /// assert_eq!(OptionKind::of("GAP RADIATION"), OptionKind::GapRadiation);
    /// assert_eq!(OptionKind::of("CONTACT DAMPING"), OptionKind::Other);
    /// ```
    pub fn of(keyword: &str) -> Self {
        let known = [
            Self::GapElectricalConductance,
            Self::ContactPermeability,
            Self::GapConductance,
            Self::GapHeatGeneration,
            Self::GapRadiation,
            Self::Friction,
            Self::SurfaceBehavior,
        ];
        known.into_iter().find(|kind| kind.keyword() == keyword).unwrap_or(Self::Other)
    }

    /// The keyword in full; empty for [`Other`](Self::Other).
    pub const fn keyword(self) -> &'static str {
        match self {
            Self::GapElectricalConductance => "GAP ELECTRICAL CONDUCTANCE",
            Self::ContactPermeability => "CONTACT PERMEABILITY",
            Self::GapConductance => "GAP CONDUCTANCE",
            Self::GapHeatGeneration => "GAP HEAT GENERATION",
            Self::GapRadiation => "GAP RADIATION",
            Self::Friction => "FRICTION",
            Self::SurfaceBehavior => "SURFACE BEHAVIOR",
            Self::Other => "",
        }
    }
}

/// *GAP CONDUCTANCE: both branches, or a user subroutine (2.4), in every option of an interaction.
#[derive(Debug, Clone)]
pub struct GapConductance<'model> {
    /// The keyword lines, in the order of the deck.
    pub spans: Vec<Span>,
    /// The keyword lines that have USER: the conductance is that of GAPCON.
    pub users: Vec<Span>,
    /// The tables, in the order of the deck; M T⁻³ θ⁻¹ against clearance (L) or contact pressure (M L⁻¹ T⁻²).
    pub tables: Vec<&'model Table>,
}

impl<'model> GapConductance<'model> {
    /// The table against clearance in force: the last of several (Q-9).
    pub fn clearance(&self) -> Option<&'model Table> {
        self.last_of(TableKind::ThermalClearance)
    }

    /// The table against contact pressure in force: the last of several (Q-9).
    pub fn pressure(&self) -> Option<&'model Table> {
        self.last_of(TableKind::ThermalPressure)
    }

    fn last_of(&self, kind: TableKind) -> Option<&'model Table> {
        let of = |table: &&&Table| TableKind::of(OptionKind::GapConductance.keyword(), table) == kind;
        self.tables.iter().rfind(of).copied()
    }
}

/// *GAP RADIATION: emissivities, then view factors against clearance (2.6); the last of several options is in force.
#[derive(Debug, Clone)]
pub struct GapRadiation<'model> {
    /// The keyword lines, in the order of the deck.
    pub spans: Vec<Span>,
    governing: &'model SubOption,
}

impl GapRadiation<'_> {
    /// The rows as numbers: emissivities of slave and master, then a view factor and a clearance (L) each; `None` without a row.
    ///
    /// A missing item is zero (S-32), and one that is not a number is NaN.
    pub fn rows(&self, parameters: &Parameters) -> Option<([f64; 2], Vec<[f64; 2]>)> {
        let item = |row: &[f64], column: usize| row.get(column).copied().unwrap_or(0.0);
        let rows = self.governing.numbers(parameters);
        let mut pairs = rows.iter().map(|row| [item(row, 0), item(row, 1)]);
        let emissivities = pairs.next()?;
        Some((emissivities, pairs.collect()))
    }
}

/// *FRICTION: an interaction with it dissipates energy where it slips.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Friction {
    /// The keyword lines, in the order of the deck.
    pub spans: Vec<Span>,
}

impl SubOption {
    /// Its kind.
    pub fn kind(&self) -> OptionKind {
        OptionKind::of(&self.keyword)
    }
}

impl Interaction {
    /// Its *GAP CONDUCTANCE; `None` without one.
    ///
    /// ```
    /// use inpact_parser::deck::scan;
    /// use inpact_parser::grammar::Grammar;
    /// use inpact_parser::model::{self, Name};
    ///
    /// let grammar = Grammar::builtin();
    /// let text = "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n10., 0.\n20., 1.\n*FRICTION\n0.1,\n";
    /// let (model, _) = model::read(&scan("a.inp", text.as_bytes(), grammar), grammar);
    /// let interaction = &model.interactions[&Name::new("A")];
    /// let conductance = interaction.gap_conductance().expect("there is one");
    /// let rows = conductance.pressure().expect("a table").row_values().map(|row| [row[0], row[1]]);
    /// assert_eq!(rows.collect::<Vec<_>>(), [[10.0, 0.0], [20.0, 1.0]]);
    /// assert!(conductance.clearance().is_none() && conductance.users.is_empty());
    /// assert!(interaction.friction().is_some() && interaction.gap_radiation().is_none());
    /// ```
    pub fn gap_conductance(&self) -> Option<GapConductance<'_>> {
        let options = || self.options_of(OptionKind::GapConductance);
        let spans: Vec<Span> = options().map(|option| option.span).collect();
        let users = options().filter(|option| option.parameter("USER").is_some()).map(|option| option.span);
        let tables = options().filter_map(|option| option.table.as_deref());
        (!spans.is_empty()).then(|| GapConductance { users: users.collect(), tables: tables.collect(), spans })
    }

    /// Its *GAP RADIATION; `None` without one.
    pub fn gap_radiation(&self) -> Option<GapRadiation<'_>> {
        let options = || self.options_of(OptionKind::GapRadiation);
        let governing = options().last()?;
        Some(GapRadiation { spans: options().map(|option| option.span).collect(), governing })
    }

    /// Its *FRICTION; `None` without one.
    pub fn friction(&self) -> Option<Friction> {
        let spans: Vec<Span> = self.options_of(OptionKind::Friction).map(|option| option.span).collect();
        (!spans.is_empty()).then_some(Friction { spans })
    }

    fn options_of(&self, kind: OptionKind) -> impl Iterator<Item = &SubOption> {
        self.other.iter().filter(move |option| option.kind() == kind)
    }
}
