//! The electrical law over the rows of a part: conductances by column, and current and heat too where there is no history and no extreme number.

use super::{Dissipation, ElectricalFlow, ExactFlow, flow};
use crate::accuracy::Wanted;
use crate::evaluator::SeenError;
use crate::history::{ElectricalHistory, ElectricalIncrement};
use crate::kernel::InstructionSet;
use crate::kernel::electrical::{ElectricalInputs, ElectricalOutputs, electrical_outputs};
use crate::kernel::scan::are_moderate;
use crate::law::conductance::Branch;
use crate::law::conductance::columns::{BranchColumns, ConductanceColumn, WantedSlope, write_slopes};
use crate::law::contact::PotentialJump;
use crate::law::heat::{GeneratedHeat, HeatAmounts, HeatGeneration};
use crate::law::user::columns::UserColumns;
use crate::nodes::Cells;
use crate::numbers::{Amount, is_moderate};
use crate::plan::{Choices, ElectricalPlan, History, InteractionTables, Source};
use crate::results::{Along, Output, ResultBatch, Status};
use crate::rows::{Binder, InteractionTally, Outcome, Part, Row, contact_status};
use crate::table::Sides;
use inpact_parser::model::Regime;
use std::ops::Range;

mod alone;
pub(crate) mod increments;

/// Below this fraction of the potentials their difference has lost its digits (cancellation).
const LOST_DIGITS: f64 = 1e-8;

/// The chunk size in rows for which inputs are checked before the kernel runs.
const CHUNK: usize = 256;

/// The electrical law with the columns it reads and fills.
#[derive(Debug, Clone)]
pub(crate) struct ElectricalColumns {
    conductance: ConductanceSource,
    heat_generation: HeatGeneration,
    accuracy: Wanted,
    regime: Regime,
    jump: Option<Source<usize>>,
    area: Option<usize>,
    pub(crate) history: History,
    slots: Slots,
    slopes: Vec<WantedSlope>,
    set: InstructionSet,
}

/// Sources of the electrical conductance.
#[derive(Debug, Clone)]
enum ConductanceSource {
    /// Tables of the deck.
    Tables(Box<BranchColumns>),
    /// A routine of the user's.
    User(Box<UserColumns>),
}

/// Indices of the results.
#[derive(Debug, Clone, Copy)]
struct Slots {
    ecd: Option<usize>,
    ecda: Option<usize>,
    ecdt: Option<usize>,
    ecdta: Option<usize>,
    sjd: Option<usize>,
    sjda: Option<usize>,
    sjdt: Option<usize>,
    sjdta: Option<usize>,
    weight: Option<usize>,
    conductance: Option<usize>,
    heat_slave: Option<usize>,
    heat_master: Option<usize>,
}

/// The input columns of current and heat of some rows.
#[derive(Debug, Clone, Copy)]
struct FlowInputs<'a> {
    conductance: &'a [f64],
    jump: Option<&'a [f64]>,
    /// Where the start of an increment differs from its end.
    jump_at_start: Option<&'a [f64]>,
    area: Option<&'a [f64]>,
}

/// Current and heat of at most [`CHUNK`] rows by plain arithmetic.
#[derive(Debug)]
struct FlowColumns {
    current_density: [f64; CHUNK],
    current: [f64; CHUNK],
    heat: [f64; CHUNK],
    heat_of_area: [f64; CHUNK],
    heat_slave: [f64; CHUNK],
    heat_master: [f64; CHUNK],
}

impl Default for FlowColumns {
    fn default() -> Self {
        let column = [0.0; CHUNK];
        Self {
            current_density: column,
            current: column,
            heat: column,
            heat_of_area: column,
            heat_slave: column,
            heat_master: column,
        }
    }
}

impl FlowColumns {
    /// Current and heat of row number `at`.
    fn row(&self, at: usize) -> ElectricalFlow {
        let heat = GeneratedHeat { total: self.heat[at], slave: self.heat_slave[at], master: self.heat_master[at] };
        ElectricalFlow { current_density: self.current_density[at], heat }
    }
}

impl ElectricalColumns {
    /// The law of a plan; `None` where the plan has no table that holds.
    pub(crate) fn bind(
        binder: Binder<'_>,
        plan: &ElectricalPlan,
        tables: &InteractionTables,
        choices: &Choices,
    ) -> Option<Self> {
        let conductance = match (&plan.user, &choices.user_conductance) {
            (Some(user), Some(law)) => ConductanceSource::User(Box::new(UserColumns::bind(binder, user, law)?)),
            _ => {
                let variables = binder.means(&plan.variables);
                let conductance = tables.electrical.conductance()?;
                let columns = BranchColumns::new(conductance, &plan.tables, choices.accuracy, variables);
                ConductanceSource::Tables(Box::new(columns))
            }
        };
        let slot = |output| binder.slot(output);
        let of_conductance = |output| match output {
            Output::ConductanceSlope(along) => Some(along),
            _ => None,
        };
        let variables = match &conductance {
            ConductanceSource::Tables(tables) => tables.variables.len(),
            // A routine gives the slope along the temperature.
            ConductanceSource::User(_) => 1,
        };
        let slopes = binder.slopes_of_conductance(of_conductance, variables, |along| match along {
            Along::Temperature => Some(0),
            Along::FieldVariable(number) => Some(number as usize),
            _ => None,
        });
        Some(Self {
            conductance,
            heat_generation: plan.heat.unwrap_or(HeatGeneration { fraction: 0.0, slave_weight: 0.0 }),
            accuracy: choices.accuracy,
            regime: plan.regime.regime,
            jump: binder.source(plan.jump),
            area: plan.area.and_then(|column| binder.place(column)),
            history: plan.history,
            slots: Slots {
                ecd: slot(Output::Ecd),
                ecda: slot(Output::Ecda),
                ecdt: slot(Output::Ecdt),
                ecdta: slot(Output::Ecdta),
                sjd: slot(Output::Sjd),
                sjda: slot(Output::Sjda),
                sjdt: slot(Output::Sjdt),
                sjdta: slot(Output::Sjdta),
                weight: slot(Output::Weight),
                conductance: slot(Output::Conductance),
                heat_slave: slot(Output::HeatSlave),
                heat_master: slot(Output::HeatMaster),
            },
            slopes,
            set: InstructionSet::best(),
        })
    }

    /// The tables of the conductance, where tables give it.
    pub(crate) fn tables(&self) -> Option<&BranchColumns> {
        match &self.conductance {
            ConductanceSource::Tables(tables) => Some(tables),
            ConductanceSource::User(_) => None,
        }
    }

    /// The conductances of a part by tables; none for a user's routine, which is called row by row.
    pub(crate) fn conductances(&self, part: &Part<'_>, seen: Option<&mut SeenError>) -> Option<ConductanceColumn> {
        Some(self.tables()?.evaluate(part, seen))
    }

    /// The law in a row; returns its status and the heat of the current, where the row has a jump of potential.
    pub(crate) fn row(
        &self,
        row: Row<'_, '_>,
        conductances: Option<&ConductanceColumn>,
        history: Option<&mut ElectricalHistory>,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) -> (Outcome, Option<HeatAmounts>) {
        let index = row.index;
        let (value, rest, sides) = match (&self.conductance, conductances) {
            (ConductanceSource::Tables(_), Some(found)) if found.is_known(index) => {
                (found.values[index], found.rest(index).unwrap_or(0.0), found.sides_of(index))
            }
            (ConductanceSource::User(routine), _) => match routine.conductance(row, tally) {
                Some(Ok(value)) => {
                    // The plan requests no other slope.
                    for wanted in &self.slopes {
                        results.set(Some(wanted.slot), row.to, Some(value.slope_along_mean_temperature()));
                    }
                    (value.conductance, 0.0, Sides::default())
                }
                Some(Err(fault)) => {
                    let is_shown = tally.count_fault();
                    let shown = is_shown.then(|| Box::new(routine.fault_in_row(row, &fault)));
                    return (Outcome::Faulty(shown), None);
                }
                None => return (Outcome::Incomplete, None),
            },
            _ => return (Outcome::Incomplete, None),
        };
        results.set(self.slots.conductance, row.to, Some(value));
        results.set(self.slots.weight, row.to, Some(self.heat_generation.slave_weight));
        self.set_slopes(row, results);
        let heat = self.flow_of_row(row, (value, rest), history, results, tally);
        (Outcome::Evaluated(self.status(row, sides, tally)), heat)
    }

    /// The law in all rows of a part without histories; returns the outcomes, and the heat of the current where the thermal law `takes_heat`.
    pub(crate) fn rows(
        &self,
        part: &Part<'_>,
        found: Option<&ConductanceColumn>,
        takes_heat: bool,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) -> (Vec<Outcome>, Vec<Option<HeatAmounts>>) {
        let count = part.rows();
        let jump = self.jump.map(|source| {
            Cells::of_source(part.batch(), &source, |slave, master| PotentialJump::between(slave, master).0)
        });
        let area = self.area.map(|place| Cells::at(part.batch(), place));
        let is_full = found.is_some_and(ConductanceColumn::is_full)
            && part.tells_contact()
            && jump.as_ref().is_none_or(Cells::is_full)
            && area.as_ref().is_none_or(Cells::is_full);
        let (mut outcomes, mut heats, mut flows) = (Vec::with_capacity(count), Vec::new(), FlowColumns::default());
        if takes_heat {
            heats.reserve(count);
        }
        let mut slopes: Option<Vec<Vec<f64>>> = None;
        let mut first = 0;
        while first < count {
            let rows = first..count.min(first + CHUNK);
            first = rows.end;
            let plain =
                found.filter(|found| is_full && self.are_plain(found, jump.as_ref(), area.as_ref(), rows.clone()));
            let Some(found) = plain else {
                for index in rows {
                    let (outcome, heat) = match part.row(index, index) {
                        Some(row) => self.row(row, found, None, results, tally),
                        // Where contact is undetermined no law is evaluated.
                        None => (Outcome::Incomplete, None),
                    };
                    outcomes.push(outcome);
                    heats.extend(takes_heat.then_some(heat));
                }
                continue;
            };
            let inputs = FlowInputs {
                conductance: &found.values[rows.clone()],
                jump: jump.as_ref().map(|jump| &jump.values[rows.clone()]),
                jump_at_start: None,
                area: area.as_ref().map(|area| &area.values[rows.clone()]),
            };
            self.plain_flows(inputs, rows.clone(), results, &mut flows);
            if takes_heat {
                let heat = |at| jump.is_some().then(|| HeatAmounts::from(flows.row(at).heat));
                heats.extend((0..rows.len()).map(heat));
            }
            if let (Some(jump), Some(source)) = (&jump, &self.jump) {
                tally.lost_digits += lost_digits(source, part, rows.clone().map(|row| (row, jump.values[row])));
            }
            if let Some(tables) = self.tables() {
                let slopes = slopes.get_or_insert_with(|| tables.slopes(part, &self.slopes));
                write_slopes(&self.slopes, slopes, &rows, results);
            }
            for index in rows {
                let sides = found.sides_of(index);
                if sides.is_within() {
                    outcomes.push(Outcome::Evaluated(part.states[index].and_then(contact_status)));
                    continue;
                }
                let Some(row) = part.row(index, index) else { continue };
                outcomes.push(Outcome::Evaluated(self.status(row, sides, tally)));
            }
        }
        if is_full {
            let columns = [self.slots.conductance, self.slots.weight].into_iter().chain(self.slots.of_flow());
            let is_given =
                |slot: &usize| jump.is_some() || [self.slots.conductance, self.slots.weight].contains(&Some(*slot));
            for slot in columns.flatten().filter(is_given) {
                results.numbers[slot].set_all_present();
            }
        }
        (outcomes, heats)
    }

    /// Whether rows can be evaluated by plain arithmetic: no number is missing or extreme, and double-double is not requested.
    fn are_plain(
        &self,
        found: &ConductanceColumn,
        jump: Option<&Cells<'_>>,
        area: Option<&Cells<'_>>,
        rows: Range<usize>,
    ) -> bool {
        !self.accuracy.is_reference()
            && is_moderate(self.heat_generation.fraction)
            && are_moderate(&found.values[rows.clone()])
            && jump.is_none_or(|jump| are_moderate(&jump.values[rows.clone()]))
            && area.is_none_or(|area| are_moderate(&area.values[rows]))
    }

    /// Conductance, current and heat of some rows by plain arithmetic; `flows` are of no meaning where there is no jump.
    fn plain_flows(
        &self,
        inputs: FlowInputs<'_>,
        rows: Range<usize>,
        results: &mut ResultBatch,
        flows: &mut FlowColumns,
    ) {
        let FlowInputs { conductance, jump, jump_at_start, area } = inputs;
        let generation = self.heat_generation;
        if let Some(slot) = self.slots.conductance {
            results.numbers[slot].values_mut()[rows.clone()].copy_from_slice(conductance);
        }
        if let Some(slot) = self.slots.weight {
            results.numbers[slot].values_mut()[rows.clone()].fill(generation.slave_weight);
        }
        let Some(jump) = jump else { return };
        let count = rows.len();
        let inputs = ElectricalInputs {
            jump,
            // Without a history an increment starts as it ends (C-25).
            jump_at_start: (self.regime == Regime::Transient).then(|| jump_at_start.unwrap_or(jump)),
            area,
        };
        let mut outputs = ElectricalOutputs {
            current_density: Some(&mut flows.current_density[..count]),
            current: area.map(|_| &mut flows.current[..count]),
            heat: Some(&mut flows.heat[..count]),
            heat_of_area: area.map(|_| &mut flows.heat_of_area[..count]),
            heat_slave: Some(&mut flows.heat_slave[..count]),
            heat_master: Some(&mut flows.heat_master[..count]),
        };
        electrical_outputs(self.set, generation, conductance, &inputs, &mut outputs);
        let slots = &self.slots;
        let area_of = |slot: Option<usize>| slot.filter(|_| area.is_some());
        let written = [
            (slots.ecd, &flows.current_density),
            (area_of(slots.ecda), &flows.current),
            (slots.sjd, &flows.heat),
            (area_of(slots.sjda), &flows.heat_of_area),
            (slots.heat_slave, &flows.heat_slave),
            (slots.heat_master, &flows.heat_master),
        ];
        for (slot, values) in written {
            results.set_flows(slot, rows.clone(), values.iter().copied());
        }
    }

    /// The slopes of the conductance by tables in a row.
    fn set_slopes(&self, row: Row<'_, '_>, results: &mut ResultBatch) {
        if let Some(tables) = self.tables() {
            tables.set_slopes(row, &self.slopes, results);
        }
    }

    /// Current and heat, where the row has a jump of potential, for a conductance and its rounding error.
    fn flow_of_row(
        &self,
        row: Row<'_, '_>,
        (value, rest): (f64, f64),
        history: Option<&mut ElectricalHistory>,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) -> Option<HeatAmounts> {
        let source = self.jump.as_ref()?;
        let Some(jump) = row.fetch(source, |slave, master| PotentialJump::between(slave, master).0) else {
            tally.incomplete_flows += 1;
            return None;
        };
        tally.lost_digits += u64::from(has_lost_digits(source, row, jump));
        let jump = PotentialJump(jump);
        let mut history = history.zip(row.time);
        let increment: Option<ElectricalIncrement> =
            history.as_mut().map(|(history, time)| history.begin(*time, jump, value));
        let history = history.map(|(history, _)| history).zip(increment);
        Some(self.flow_of_increment(row, (value, rest), jump, history, results, tally))
    }

    /// Sets the integrals of a node in a row of results; zero current is +0, not −0.
    fn set_integrals(&self, history: &ElectricalHistory, to: usize, results: &mut ResultBatch) {
        let slots = &self.slots;
        let integrals = [
            (slots.ecdt, Some(history.current())),
            (slots.ecdta, history.current_of_area()),
            (slots.sjdt, Some(history.heat())),
            (slots.sjdta, history.heat_of_area()),
        ];
        for (slot, value) in integrals {
            results.set(slot, to, value.map(|value| value + 0.0));
        }
    }

    /// Current and heat of a row that ends an increment, if it has a history.
    fn flow_of_increment(
        &self,
        row: Row<'_, '_>,
        (value, rest): (f64, f64),
        jump: PotentialJump,
        history: Option<(&mut ElectricalHistory, ElectricalIncrement)>,
        results: &mut ResultBatch,
        tally: &mut InteractionTally,
    ) -> HeatAmounts {
        let area = self.area.and_then(|place| row.number(place));
        let increment = history.as_ref().map(|(_, increment)| *increment);
        let jump_at_start = increment.as_ref().map_or(jump, |increment| increment.jump_at_start);
        let dissipation = match self.regime {
            Regime::SteadyState => Dissipation::Steady,
            Regime::Transient => Dissipation::Transient { jump_at_start },
        };
        let generation = self.heat_generation;
        if let Some(increment) = &increment {
            self.count_closing(row, increment, jump, tally);
        }
        let duration = increment.as_ref().and_then(|increment| increment.duration);
        let needs_care = self.accuracy.is_reference() || {
            let inputs =
                [value, jump.0, jump_at_start.0, generation.fraction, area.unwrap_or(0.0), duration.unwrap_or(0.0)];
            !inputs.into_iter().all(is_moderate)
        };
        let exact = if needs_care { ExactFlow::new((value, rest), jump, dissipation, generation) } else { None };
        let flow = match exact {
            Some(exact) => exact.rounded(),
            None => flow(value, jump, dissipation, generation),
        };
        let current_density = exact.map_or_else(|| Amount::new(flow.current_density), |exact| exact.current_density);
        let heat = exact.map_or_else(|| HeatAmounts::from(flow.heat), |exact| exact.heat);
        // A flow beyond the range of f64 may be within it when multiplied by a small area.
        let of_area = |amount: Amount| area.map(|area| amount.times(area));
        let slots = &self.slots;
        // Zero current is +0, not −0.
        let mut set = |slot, value: Option<f64>| results.set(slot, row.to, value.map(|value| value + 0.0));
        set(slots.ecd, Some(flow.current_density));
        set(slots.ecda, of_area(current_density));
        set(slots.sjd, Some(flow.heat.total));
        set(slots.sjda, of_area(heat.total));
        set(slots.heat_slave, Some(flow.heat.slave));
        set(slots.heat_master, Some(flow.heat.master));
        if let Some((history, increment)) = history {
            match &exact {
                Some(exact) => history.finish_exactly(&increment, exact, area),
                None => history.finish(&increment, &flow, value.mul_add(jump.0, -flow.current_density), area),
            }
            self.set_integrals(history, row.to, results);
        }
        heat
    }

    /// Counts a row that includes the jump of an open circuit in the heat of the increment that closes it (D022).
    fn count_closing(
        &self,
        row: Row<'_, '_>,
        increment: &ElectricalIncrement,
        jump: PotentialJump,
        tally: &mut InteractionTally,
    ) {
        if self.regime == Regime::Transient && increment.closes_circuit && self.heat_generation.fraction != 0.0 {
            tally.closing.count(row, || {
                let (start, end) = (increment.jump_at_start.0, jump.0);
                format!("the first has a jump of {end:?}, and its increment starts open with {start:?}")
            });
        }
    }

    /// The status of a row that lies outside its table on these sides.
    #[inline]
    fn status(&self, row: Row<'_, '_>, sides: Sides, tally: &mut InteractionTally) -> Option<Status> {
        if sides.is_within() {
            return contact_status(row.state);
        }
        let branch = self.tables().map(|tables| tables.tables.branch_of(row.state));
        tally.count_sides(usize::from(branch == Some(Branch::Pressure)), sides);
        Some(Status::BeyondTable)
    }
}

impl Slots {
    /// Those of current and heat at one time.
    fn of_flow(&self) -> [Option<usize>; 6] {
        [self.ecd, self.ecda, self.sjd, self.sjda, self.heat_slave, self.heat_master]
    }
}

/// The number of rows whose jump has lost its digits ([`has_lost_digits`]).
fn lost_digits(source: &Source<usize>, part: &Part<'_>, rows: impl Iterator<Item = (usize, f64)>) -> u64 {
    match *source {
        Source::Cell(_) => 0,
        Source::Sides(slave, master) => {
            let values = |place: usize| part.batch().numbers[place].values();
            let (slave, master) = (values(slave), values(master));
            // A number that is missing is NaN, which is never the larger one.
            rows.map(|(row, jump)| u64::from(jump.abs() < LOST_DIGITS * slave[row].abs().max(master[row].abs()))).sum()
        }
        Source::CellOrSides(..) => {
            let rows = rows.filter_map(|(row, jump)| Some((part.row(row, row)?, jump)));
            rows.map(|(row, jump)| u64::from(has_lost_digits(source, row, jump))).sum()
        }
    }
}

/// Whether the jump is the difference of much larger potentials, so that few of its digits are left.
#[inline]
fn has_lost_digits(source: &Source<usize>, row: Row<'_, '_>, jump: f64) -> bool {
    let (slave, master) = match *source {
        Source::Sides(slave, master) => (slave, master),
        Source::CellOrSides(cell, slave, master) if row.number(cell).is_none() => (slave, master),
        _ => return false,
    };
    let magnitude = |place| row.number(place).map_or(0.0, f64::abs);
    jump.abs() < LOST_DIGITS * magnitude(slave).max(magnitude(master))
}
