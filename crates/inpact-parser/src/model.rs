//! The typed model of a deck: its interactions, their properties, and where they are used.
//!
//! Built by [`read`] from the blocks of a [`Deck`](crate::deck::Deck); independent of how lines are split,
//! and without validation: a table that does not ascend is still a table.
//! Options that cannot be placed, or are replaced by a later definition, are in [`Model::set_aside`], so that they can be checked too.

mod interactions;
mod name;
mod options;
mod places;
mod print;
mod read;
mod row_places;
mod rows;
mod table;
mod text;

pub use interactions::Interactions;
pub use name::Name;
pub use options::{Friction, GapConductance, GapRadiation, OptionKind};
pub(crate) use print::named_in;
pub use print::print;
pub use read::{MAX_FIELD_VARIABLES, read, read_watched};
pub use row_places::RowPlaces;
pub use table::{CellText, Table};
pub use text::{SharedText, TextRows};

use crate::expression::Parameters;
use crate::span::Span;

/// The contact interfaces of a deck and their uses.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Model {
    /// The definitions of *PARAMETER and their values (S-61).
    pub parameters: Parameters,
    /// The interactions by name, in the order of the deck.
    pub interactions: Interactions,
    /// The *CONTACT PAIR options (C-02).
    pub contact_pairs: Vec<ContactPair>,
    /// The lines of *CONTACT PROPERTY ASSIGNMENT (C-05); the last that fits wins.
    pub property_assignments: Vec<PropertyAssignment>,
    /// The *SURFACE definitions (C-01).
    pub surfaces: Vec<Surface>,
    /// The procedures of the steps (section 9.2).
    pub procedures: Vec<Procedure>,
    /// Values of *PHYSICAL CONSTANTS (2.6); not part of the JSON view.
    pub constants: PhysicalConstants,
    /// Set aside: misplaced sub-options and definitions that a later one replaced.
    pub set_aside: Vec<SetAside>,
}

/// The constants that radiation needs, in the units of the deck; neither has a default (T-42).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PhysicalConstants {
    /// ABSOLUTE ZERO, dimension θ.
    pub absolute_zero: Option<f64>,
    /// STEFAN BOLTZMANN, dimension M T⁻³ θ⁻⁴.
    pub stefan_boltzmann: Option<f64>,
}

/// A *SURFACE INTERACTION with its sub-options (2.1).
#[derive(Debug, Clone, PartialEq)]
pub struct Interaction {
    /// NAME.
    pub name: Name,
    /// The keyword line.
    pub span: Span,
    /// Out-of-plane thickness, or area per node of a node-based surface; 1 unless given (K-01).
    pub thickness: f64,
    /// The parameters besides NAME: USER, DEPVAR, PROPERTIES, UNSYMM, PAD THICKNESS, TRACKING THICKNESS.
    pub parameters: Box<[GivenParameter]>,
    /// The constants of USER, PROPERTIES=n (K-02).
    pub properties: Box<[f64]>,
    /// *GAP ELECTRICAL CONDUCTANCE (2.2).
    pub gap_electrical_conductance: Option<Box<ElectricalConductance>>,
    /// *CONTACT PERMEABILITY (2.3).
    pub contact_permeability: Option<Box<ContactPermeability>>,
    /// *GAP HEAT GENERATION (2.5).
    pub gap_heat_generation: Option<Box<HeatGeneration>>,
    /// Every other sub-option.
    pub other: Vec<SubOption>,
}

/// *GAP ELECTRICAL CONDUCTANCE: both branches, or a user subroutine (2.2).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ElectricalConductance {
    /// The keyword line that has USER.
    pub user: Option<Span>,
    /// Conductance against clearance: without PRESSURE.
    pub clearance: Option<Box<Table>>,
    /// Conductance against contact pressure: with PRESSURE.
    pub pressure: Option<Box<Table>>,
    /// TYPE, kept as written and not interpreted.
    pub kind: Option<Box<str>>,
}

/// *CONTACT PERMEABILITY (2.3).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ContactPermeability {
    /// The keyword line.
    pub span: Span,
    /// Permeability against contact pressure; `None` is an infinite permeability (K-20).
    pub table: Option<Table>,
    /// CUTOFF FLOW ACROSS, dimension L: no flow across above this clearance.
    pub cutoff_flow_across: Option<f64>,
    /// CUTOFF GAP FILL, dimension L: a change of the gap draws no fluid above this clearance.
    pub cutoff_gap_fill: Option<f64>,
    /// CONSTRAINT METHOD.
    pub constraint_method: Option<ConstraintMethod>,
}

/// CONSTRAINT METHOD of *CONTACT PERMEABILITY.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ConstraintMethod {
    /// Enforced directly.
    Direct,
    /// Approximated by a large permeability.
    Penalty,
}

/// *GAP HEAT GENERATION (2.5).
#[derive(Debug, Clone, PartialEq)]
pub struct HeatGeneration {
    /// The keyword line.
    pub span: Span,
    /// The row, when there is one.
    pub row: Option<Span>,
    /// η, the fraction of dissipated energy that becomes heat.
    pub fraction: f64,
    /// f, the fraction of that heat that goes into the slave surface.
    pub slave_weight: f64,
    /// The relative speed of the surfaces, dimension L T⁻¹, in a row of CalculiX (K-38): computed where it is negative.
    pub slip_rate: Option<f64>,
    /// The text of the items that are not written as a number, as in [`Table::texts`]: 0 is the fraction, 1 the weight, 2 the speed.
    pub texts: Vec<CellText>,
}

impl HeatGeneration {
    /// The relative speed of the surfaces that the deck gives, dimension L T⁻¹; `None` where the solver computes it (K-38).
    pub fn given_slip_rate(&self) -> Option<f64> {
        self.slip_rate.filter(|speed| 0.0 <= *speed)
    }
}

/// A keyword with its parameters and rows, not interpreted further.
#[derive(Debug, Clone, PartialEq)]
pub struct SubOption {
    /// The keyword, in full and in upper case.
    pub keyword: SharedText,
    /// The keyword line.
    pub span: Span,
    /// Its parameters.
    pub parameters: Box<[GivenParameter]>,
    /// Its rows as numbers, where they form a table by the grammar.
    pub table: Option<Box<Table>>,
    /// Its rows as texts otherwise: the items of every line.
    pub rows: TextRows,
}

/// A parameter as given.
#[derive(Debug, Clone, PartialEq)]
pub struct GivenParameter {
    /// Its name: in full and in upper case when the keyword has it, otherwise as written.
    pub name: SharedText,
    /// Its value as written, without blanks around it; a parameter in it, `<name>`, stays a name.
    pub value: Option<Box<str>>,
    /// Its place.
    pub span: Span,
}

/// A *CONTACT PAIR (C-02).
#[derive(Debug, Clone, PartialEq)]
pub struct ContactPair {
    /// The keyword line.
    pub span: Span,
    /// INTERACTION.
    pub interaction: Option<Reference>,
    /// The other parameters.
    pub parameters: Box<[GivenParameter]>,
    /// The lines: slave and master; a single surface means self-contact.
    pub pairs: Box<[SurfacePair]>,
}

/// A slave surface and its master.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfacePair {
    /// The slave (secondary) surface.
    pub slave: Reference,
    /// The master (main) surface; `None` for self-contact.
    pub master: Option<Reference>,
}

/// A line of *CONTACT PROPERTY ASSIGNMENT (C-05).
#[derive(Debug, Clone, PartialEq)]
pub struct PropertyAssignment {
    /// The line.
    pub span: Span,
    /// The first surface; blank is the whole domain.
    pub first: Option<Reference>,
    /// The second surface; blank is the same as the first.
    pub second: Option<Reference>,
    /// The interaction; blank is the unnamed default.
    pub interaction: Option<Reference>,
}

/// A name that refers to something defined elsewhere, and its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// The name.
    pub name: Name,
    /// Its place.
    pub span: Span,
}

/// A *SURFACE definition (C-01).
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// The keyword line.
    pub span: Span,
    /// NAME.
    pub name: Reference,
}

/// The procedure of a step (section 9.2).
#[derive(Debug, Clone, PartialEq)]
pub struct Procedure {
    /// The step it belongs to, from 1; 0 when no *STEP is open.
    pub step: usize,
    /// The keyword, parameters and rows.
    pub option: SubOption,
}

/// Steady state or transient.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Regime {
    /// No storage, no gap filling: q_gap = 0 (C-24).
    SteadyState,
    /// Heat by the average over the increment (H-08), gap filling (P-42).
    Transient,
}

/// An option of the deck that has no effect.
#[derive(Debug, Clone, PartialEq)]
pub struct SetAside {
    /// Why.
    pub reason: SetAsideReason,
    /// The item.
    pub item: SetAsideItem,
}

/// Reasons why an option was set aside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SetAsideReason {
    /// It is outside a *SURFACE INTERACTION, or at a level where it may not occur.
    Misplaced,
    /// A later definition of the same name or kind replaced it; the span is that of the later one.
    ReplacedBy(Span),
    /// An earlier definition of the same name applies, as in CalculiX (CX-11).
    Shadowed {
        /// The definition in force.
        first: Span,
    },
}

/// Options set aside.
#[derive(Debug, Clone, PartialEq)]
pub enum SetAsideItem {
    /// An interaction whose name is defined again.
    Interaction(Box<Interaction>),
    /// A table of a kind the interaction has again, or of a misplaced option.
    Table(Table),
    /// A *CONTACT PERMEABILITY that occurs twice or is misplaced.
    ContactPermeability(Box<ContactPermeability>),
    /// A *GAP HEAT GENERATION that occurs twice or is misplaced.
    HeatGeneration(Box<HeatGeneration>),
    /// Another sub-option that is misplaced.
    SubOption(SubOption),
}

/// Whose law a table is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum TableKind {
    /// *GAP ELECTRICAL CONDUCTANCE against clearance.
    ElectricalClearance,
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE.
    ElectricalPressure,
    /// *GAP CONDUCTANCE against clearance.
    ThermalClearance,
    /// *GAP CONDUCTANCE, PRESSURE.
    ThermalPressure,
    /// *CONTACT PERMEABILITY.
    Permeability,
    /// View factors of *GAP RADIATION against clearance.
    ViewFactor,
    /// Any other option with a table, *GAP DIFFUSIVITY among them.
    Other,
}

impl TableKind {
    /// The kind of the tables of a keyword, given the table's columns.
    pub fn of(keyword: &str, table: &Table) -> Self {
        let against_pressure = table.columns.get(1).is_some_and(|column| column == "pressure");
        match (OptionKind::of(keyword), against_pressure) {
            (OptionKind::GapElectricalConductance, false) => Self::ElectricalClearance,
            (OptionKind::GapElectricalConductance, true) => Self::ElectricalPressure,
            (OptionKind::GapConductance, false) => Self::ThermalClearance,
            (OptionKind::GapConductance, true) => Self::ThermalPressure,
            (OptionKind::ContactPermeability, _) => Self::Permeability,
            (OptionKind::GapRadiation, _) => Self::ViewFactor,
            _ => Self::Other,
        }
    }

    /// Whether it is a conductance against clearance.
    pub fn is_conductance_against_clearance(self) -> bool {
        matches!(self, Self::ElectricalClearance | Self::ThermalClearance)
    }

    /// Whether the abscissa is the clearance, which must start at zero (T-24).
    pub fn is_against_clearance(self) -> bool {
        self.is_conductance_against_clearance() || self == Self::ViewFactor
    }

    /// Whether it is of *GAP CONDUCTANCE.
    pub fn is_thermal_conductance(self) -> bool {
        matches!(self, Self::ThermalClearance | Self::ThermalPressure)
    }

    /// Whether it is a conductance against contact pressure, which must start at zero or below.
    pub fn is_conductance_against_pressure(self) -> bool {
        matches!(self, Self::ElectricalPressure | Self::ThermalPressure)
    }
}

/// A table of the model with its context.
#[derive(Debug, Clone, Copy)]
pub struct TableOf<'model> {
    /// Whose law it is.
    pub kind: TableKind,
    /// The keyword in full.
    pub keyword: &'model str,
    /// The interaction; `None` for a misplaced one.
    pub interaction: Option<&'model Interaction>,
    /// The table.
    pub table: &'model Table,
}

impl Model {
    /// Every interaction of the deck, with those replaced by a later one of the same name last.
    pub fn all_interactions(&self) -> impl Iterator<Item = &Interaction> {
        let replaced = self.set_aside.iter().filter_map(|aside| match &aside.item {
            SetAsideItem::Interaction(interaction) => Some(&**interaction),
            _ => None,
        });
        self.interactions.values().chain(replaced)
    }

    /// Every table of the deck, including those without effect: all tables are checked.
    pub fn tables(&self) -> impl Iterator<Item = TableOf<'_>> {
        let of_interactions = self.all_interactions().flat_map(Interaction::tables);
        let set_aside = self.set_aside.iter().filter_map(|aside| {
            let (keyword, table) = match &aside.item {
                SetAsideItem::Table(table) => (OptionKind::GapElectricalConductance.keyword(), Some(table)),
                SetAsideItem::ContactPermeability(option) => {
                    (OptionKind::ContactPermeability.keyword(), option.table.as_ref())
                }
                SetAsideItem::SubOption(option) => (&*option.keyword, option.table.as_deref()),
                SetAsideItem::Interaction(_) | SetAsideItem::HeatGeneration(_) => return None,
            };
            let table = table?;
            Some(TableOf { kind: TableKind::of(keyword, table), keyword, interaction: None, table })
        });
        of_interactions.chain(set_aside)
    }
}

impl Interaction {
    /// An interaction of that name with nothing in it: thickness 1, no property (K-01).
    pub fn new(name: Name, span: Span) -> Self {
        Self {
            name,
            span,
            thickness: 1.0,
            parameters: Box::default(),
            properties: Box::default(),
            gap_electrical_conductance: None,
            contact_permeability: None,
            gap_heat_generation: None,
            other: Vec::new(),
        }
    }

    /// Whether the parameter is given.
    pub fn has_parameter(&self, name: &str) -> bool {
        self.parameters.iter().any(|parameter| parameter.name == name)
    }

    /// The tables of its sub-options, in no particular order.
    pub fn tables(&self) -> Vec<TableOf<'_>> {
        let electrical = self.gap_electrical_conductance.iter();
        let electrical =
            electrical.flat_map(|option| [&option.clearance, &option.pressure]).flatten().map(|table| &**table);
        let permeability = self.contact_permeability.iter().filter_map(|option| option.table.as_ref());
        let other = self.other.iter().filter_map(|option| Some((&*option.keyword, option.table.as_deref()?)));
        let named = electrical.map(|table| (OptionKind::GapElectricalConductance.keyword(), table));
        let permeability = permeability.map(|table| (OptionKind::ContactPermeability.keyword(), table));
        let named = named.chain(permeability).chain(other);
        let of =
            |(keyword, table)| TableOf { kind: TableKind::of(keyword, table), keyword, interaction: Some(self), table };
        named.map(of).collect()
    }
}

impl SubOption {
    /// The parameter of that name, when it is given.
    pub fn parameter(&self, name: &str) -> Option<&GivenParameter> {
        self.parameters.iter().find(|parameter| parameter.name == name)
    }
}

impl Procedure {
    /// Steady state or transient, for the procedures of section 9.2; `None` for those without the distinction.
    ///
    /// *SOILS is steady unless CONSOLIDATION is given; the coupled procedures are transient unless STEADY STATE is (C-20).
    pub fn regime(&self) -> Option<Regime> {
        let flagged = |name| self.option.parameter(name).is_some();
        let steady_if = |steady| Some(if steady { Regime::SteadyState } else { Regime::Transient });
        match &*self.option.keyword {
            "COUPLED THERMAL-ELECTRICAL" | "COUPLED TEMPERATURE-DISPLACEMENT" | "HEAT TRANSFER" => {
                steady_if(flagged("STEADY STATE"))
            }
            "SOILS" => steady_if(!flagged("CONSOLIDATION")),
            "GEOSTATIC" => Some(Regime::SteadyState),
            _ => None,
        }
    }

    /// Whether the procedure conducts electric current across interfaces (section 9.2).
    pub fn solves_electrical(&self) -> bool {
        match &*self.option.keyword {
            "COUPLED THERMAL-ELECTRICAL" => true,
            "COUPLED TEMPERATURE-DISPLACEMENT" => self.option.parameter("ELECTRICAL").is_some(),
            _ => false,
        }
    }

    /// Whether the procedure solves pore pressure (section 9.2).
    pub fn solves_pore_pressure(&self) -> bool {
        matches!(&*self.option.keyword, "SOILS" | "GEOSTATIC")
    }
}
