//! From a plan to laws that can be evaluated: tables compiled, columns turned into places of a batch.

mod interface;
mod user;

pub use interface::{ElectricalSource, FlowOf, FrictionSource, InterfaceLaws};
pub(crate) use user::CompiledUser;

use crate::accuracy::Wanted;
use crate::evaluate::summed;
use crate::evaluator::Evaluator;
use crate::history::{ClosingHeat, HistoryStart};
use crate::law::conductance::ConductanceTables;
use crate::law::contact::ContactState;
use crate::law::heat::HeatGeneration;
use crate::law::pore::{Permeability, PoreLaw};
use crate::nodes::{Column, Part};
use crate::plan::{
    Bulk, CharacteristicLength, Choices, ContactPlaces, ElectricalPlan, History, InteractionPlan, InteractionTables,
    Plan, PorePlan, Rate, Source, TablePlan,
};
use crate::results::{Along, Output};
use crate::table::PiecewiseTable;
use inpact_parser::model::{Model, Regime};

/// The laws of a plan.
#[derive(Debug, Clone)]
pub struct Laws {
    /// The laws of each interaction of the model; `None` for those that govern no row.
    pub(crate) interactions: Vec<Option<InteractionLaws>>,
    /// How many columns of numbers the results have.
    pub(crate) result_columns: usize,
    /// The outputs that are added up over an interface, with their places among the results; none where the times of the rows are not known.
    pub(crate) summed: Vec<(Output, usize)>,
    /// Where a batch has the texts of column `node`.
    pub(crate) node: Option<usize>,
    /// Where a batch has the texts of column `interaction`.
    pub(crate) interaction: Option<usize>,
    /// Where a batch has the numbers of column `time`.
    pub(crate) time: Option<usize>,
    /// Where the histories of nodes start.
    pub(crate) history_start: HistoryStart,
    /// What the heat of an increment takes that closes a circuit.
    pub(crate) closing_heat: ClosingHeat,
}

/// The laws of one interaction, and where its rows have what they need.
#[derive(Debug, Clone)]
pub(crate) struct InteractionLaws {
    pub(crate) contact: ContactPlaces,
    pub(crate) electrical: Option<CompiledElectrical>,
    pub(crate) thermal: Option<CompiledThermal>,
    pub(crate) pore: Option<CompiledPore>,
}

/// The electrical law with its places.
#[derive(Debug, Clone)]
pub(crate) struct CompiledElectrical {
    pub(crate) conductance: ConductanceSource,
    pub(crate) heat_generation: HeatGeneration,
    pub(crate) accuracy: Wanted,
    pub(crate) regime: Regime,
    pub(crate) jump: Option<Source<usize>>,
    pub(crate) area: Option<usize>,
    pub(crate) history: History,
    pub(crate) slots: ElectricalSlots,
    pub(crate) slopes: Vec<(usize, Along)>,
}

/// What gives the electrical conductance.
#[derive(Debug, Clone)]
pub(crate) enum ConductanceSource {
    /// Tables of the deck.
    Tables(Box<CompiledTables>),
    /// A routine of the user's.
    User(Box<CompiledUser>),
}

/// The tables of the electrical conductance with their places.
#[derive(Debug, Clone)]
pub(crate) struct CompiledTables {
    pub(crate) tables: ConductanceTables,
    /// The table against clearance as it is evaluated.
    pub(crate) clearance_form: Option<Evaluator>,
    /// The table against contact pressure as it is evaluated.
    pub(crate) pressure_form: Option<Evaluator>,
    /// What the table against clearance needs.
    clearance: Needs,
    /// What the table against contact pressure needs.
    pressure: Needs,
    pub(crate) variables: Vec<Option<Source<usize>>>,
}

/// The pore fluid law with its places.
#[derive(Debug, Clone)]
pub(crate) struct CompiledPore {
    pub(crate) law: PoreLaw,
    /// The table of permeabilities as it is evaluated.
    pub(crate) form: Option<Evaluator>,
    pub(crate) regime: Regime,
    /// What the permeability needs; variable 0 is the mean pore pressure, which is always there.
    pub(crate) needs: Needs,
    /// The mean temperature, then the field variables.
    pub(crate) variables: Vec<Option<Source<usize>>>,
    /// The pore pressures of slave and master.
    pub(crate) pressures: Option<(usize, usize)>,
    pub(crate) jump: Option<usize>,
    /// The flow across where the permeability is infinite.
    pub(crate) across: Option<usize>,
    pub(crate) bulk: Option<(usize, usize)>,
    pub(crate) rate: Option<usize>,
    pub(crate) characteristic_length: Length,
    pub(crate) area: Option<usize>,
    pub(crate) history: History,
    pub(crate) slots: PoreSlots,
    pub(crate) slopes: Vec<(usize, Along)>,
}

/// Where the characteristic element length comes from.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Length {
    Place(usize),
    Given(f64),
    Unknown,
}

/// What a table needs of a row.
#[derive(Debug, Clone, Default)]
pub(crate) struct Needs {
    /// Its first variable, clearance or contact pressure.
    pub(crate) abscissa: bool,
    /// Others, by their place among the variables.
    pub(crate) variables: Vec<usize>,
}

/// Declares a set of places in the results, one for each output that has a number there.
macro_rules! slots {
    ($(#[doc = $line:literal])+ $name:ident { $($field:ident: $output:ident),+ $(,)? }) => {
        $(#[doc = $line])+
        #[derive(Debug, Clone, Copy, Default)]
        pub(crate) struct $name {
            $(pub(crate) $field: Option<usize>,)+
        }

        impl $name {
            fn new(place: impl Fn(Output) -> Option<usize>) -> Self {
                Self { $($field: place(Output::$output),)+ }
            }
        }
    };
}

slots! {
    /// Where the results of the electrical law go.
    ElectricalSlots {
        ecd: Ecd, ecda: Ecda, ecdt: Ecdt, ecdta: Ecdta, sjd: Sjd, sjda: Sjda, sjdt: Sjdt, sjdta: Sjdta,
        weight: Weight, conductance: Conductance, heat_slave: HeatSlave, heat_master: HeatMaster,
    }
}

slots! {
    /// Where the results of the pore fluid law go.
    PoreSlots {
        pfl: Pfl, pfla: Pfla, ptl: Ptl, ptla: Ptla, permeability: Permeability, q_across: QAcross,
        q_gap_slave: QGapSlave, q_gap_master: QGapMaster, q_slave: QSlave, q_master: QMaster,
    }
}

mod thermal;

pub(crate) use thermal::{CompiledConduction, CompiledFriction, CompiledRadiation, CompiledThermal, MASS_FLOW, Speed};

/// Compiles the laws of a plan that was made from this model and these choices.
pub fn compile(model: &Model, plan: &Plan, choices: &Choices) -> Laws {
    let mut interactions: Vec<Option<InteractionLaws>> = Vec::new();
    interactions.resize_with(model.interactions.len(), || None);
    for planned in &plan.interactions {
        let tables = &planned.tables.flow;
        let compiler = Compiler { plan, of: planned };
        interactions[planned.index] = Some(InteractionLaws {
            contact: compiler.contact(),
            electrical: planned.electrical.as_ref().and_then(|law| compiler.electrical(law, tables, choices)),
            thermal: planned
                .thermal
                .as_ref()
                .map(|law| compiler.thermal(law, &planned.tables.thermal, choices.accuracy)),
            pore: planned.pore.as_ref().map(|law| compiler.pore(law, tables, choices)),
        });
    }
    Laws {
        interactions,
        result_columns: numbers(plan).count(),
        summed: if has_known_times(plan) { summed(numbers(plan)) } else { Vec::new() },
        node: plan.selection.label(Column::Node),
        interaction: plan.selection.label(Column::Interaction),
        time: plan.selection.number(Column::Time),
        history_start: choices.history_start,
        closing_heat: choices.closing_heat,
    }
}

/// Whether the times of the rows are read, or there are none.
fn has_known_times(plan: &Plan) -> bool {
    let is_there = plan.columns.iter().any(|column| column.column == Some(Column::Time));
    !is_there || plan.selection.number(Column::Time).is_some()
}

/// The outputs that are numbers.
fn numbers(plan: &Plan) -> impl Iterator<Item = Output> {
    plan.outputs.iter().copied().filter(|output| output.is_number())
}

/// Compiles the laws of one interaction.
#[derive(Clone, Copy)]
struct Compiler<'a> {
    plan: &'a Plan,
    of: &'a InteractionPlan,
}

impl Compiler<'_> {
    fn contact(self) -> ContactPlaces {
        let place = |column: Option<Column>| self.plan.selection.number(column?);
        let columns = self.of.contact;
        ContactPlaces {
            clearance: place(columns.clearance),
            pressure: place(columns.pressure),
            closed: place(columns.closed),
            state: columns.state,
        }
    }

    fn place(self, column: Column) -> Option<usize> {
        self.plan.selection.number(column)
    }

    /// Where an output goes, if this interaction gives it.
    fn slot(self, output: Output) -> Option<usize> {
        let is_given = self.of.outputs.contains(&output);
        numbers(self.plan).position(|planned| planned == output).filter(|_| is_given)
    }

    fn source(self, source: Option<Source<Column>>) -> Option<Source<usize>> {
        // The plan reads every column it names.
        source.map(|source| source.map(|column| self.place(column).unwrap_or_default()))
    }

    fn sources(self, sources: &[Option<Source<Column>>]) -> Vec<Option<Source<usize>>> {
        sources.iter().map(|source| self.source(*source)).collect()
    }

    fn electrical(
        self,
        plan: &ElectricalPlan,
        tables: &InteractionTables,
        choices: &Choices,
    ) -> Option<CompiledElectrical> {
        let conductance = match (&plan.user, &choices.user_conductance) {
            (Some(user), Some(law)) => {
                ConductanceSource::User(Box::new(CompiledUser::new(user, &self.plan.selection, law)?))
            }
            _ => ConductanceSource::Tables(Box::new(self.electrical_tables(plan, tables, choices)?)),
        };
        let slopes = self.of.outputs.iter().filter_map(|output| match output {
            Output::ConductanceSlope(along) => Some((self.slot(*output)?, *along)),
            _ => None,
        });
        Some(CompiledElectrical {
            conductance,
            heat_generation: plan.heat.unwrap_or(HeatGeneration { fraction: 0.0, slave_weight: 0.0 }),
            accuracy: choices.accuracy,
            regime: plan.regime.regime,
            jump: self.source(plan.jump),
            area: plan.area.and_then(|column| self.place(column)),
            history: plan.history,
            slots: ElectricalSlots::new(|output| self.slot(output)),
            slopes: slopes.collect(),
        })
    }

    fn electrical_tables(
        self,
        plan: &ElectricalPlan,
        tables: &InteractionTables,
        choices: &Choices,
    ) -> Option<CompiledTables> {
        let table = |against| {
            let (_, table) = tables.electrical().find(|(first, _)| *first == against)?;
            let planned = plan.tables.iter().find(|planned| planned.against == against);
            // A table that no row reaches stays as it is: it says what kind of conductance this is.
            let evaluator = planned.and_then(TablePlan::evaluator).cloned();
            Some(evaluator.unwrap_or_else(|| Evaluator::new(table, choices.accuracy)))
        };
        let [clearance_form, pressure_form] = [table(Along::Clearance), table(Along::Pressure)];
        let [clearance, pressure] = [&clearance_form, &pressure_form].map(|form| Some(form.as_ref()?.table().clone()));
        let needs = [&clearance, &pressure].map(|table| table.as_ref().map(Needs::of).unwrap_or_default());
        let [clearance_needs, pressure_needs] = needs;
        Some(CompiledTables {
            tables: ConductanceTables::of(clearance, pressure)?,
            clearance_form,
            pressure_form,
            clearance: clearance_needs,
            pressure: pressure_needs,
            variables: self.sources(&plan.variables),
        })
    }

    fn pore(self, plan: &PorePlan, tables: &InteractionTables, choices: &Choices) -> CompiledPore {
        let table = tables.permeability().zip(plan.table.as_ref());
        let form = table.map(|(table, planned)| {
            planned.evaluator().cloned().unwrap_or_else(|| Evaluator::new(table, choices.accuracy))
        });
        let table = form.as_ref().map(|form| form.table().clone());
        let needs = table.as_ref().map(Needs::of).unwrap_or_default();
        let permeability = table.map_or(Permeability::Infinite, Permeability::Finite);
        let slopes = self.of.outputs.iter().filter_map(|output| match output {
            Output::PermeabilitySlope(along) => Some((self.slot(*output)?, *along)),
            _ => None,
        });
        let sides = |of: fn(Part) -> Column| Some((self.place(of(Part::Slave))?, self.place(of(Part::Master))?));
        let length = self.place(Column::CharacteristicLength);
        CompiledPore {
            form,
            law: PoreLaw { permeability, cutoffs: plan.cutoffs, boundary: choices.cutoff_boundary },
            regime: plan.regime.regime,
            needs,
            variables: self.sources(&plan.variables),
            pressures: sides(Column::PorePressure).filter(|_| plan.pressures.is_some()),
            jump: self.place(Column::PorePressure(Part::Both)),
            across: self.place(Column::FlowAcross),
            bulk: sides(Column::BulkPermeability).filter(|_| plan.bulk == Bulk::Columns),
            rate: self.place(Column::ClearanceRate).filter(|_| plan.rate == Rate::Column),
            characteristic_length: match (plan.characteristic_length, length) {
                (CharacteristicLength::Given(length), _) => Length::Given(length),
                (CharacteristicLength::Column, Some(place)) => Length::Place(place),
                _ => Length::Unknown,
            },
            area: plan.area.and_then(|column| self.place(column)),
            history: plan.history,
            slots: PoreSlots::new(|output| self.slot(output)),
            slopes: slopes.collect(),
        }
    }
}

impl Needs {
    fn of(table: &PiecewiseTable) -> Self {
        let axes = table.axes();
        let matters = |axis: usize| axes[axis].matters();
        Self {
            abscissa: !axes.is_empty() && matters(0),
            variables: (1..axes.len()).filter(|axis| matters(*axis)).map(|axis| axis - 1).collect(),
        }
    }
}

impl CompiledTables {
    /// What a row in this state needs; `None` where no table is in force.
    #[inline]
    pub(crate) fn needs(&self, state: ContactState) -> Option<(Along, &Needs)> {
        match (&self.tables, state) {
            (ConductanceTables::Clearance(_), _) | (ConductanceTables::Both { .. }, ContactState::Open) => {
                Some((Along::Clearance, &self.clearance))
            }
            (ConductanceTables::Pressure(_) | ConductanceTables::Both { .. }, ContactState::Closed) => {
                Some((Along::Pressure, &self.pressure))
            }
            _ => None,
        }
    }
}
