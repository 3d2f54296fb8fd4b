//! A conductance over the rows of a part: rows are gathered by table, each table is evaluated over columns, and the values are scattered back to their rows.

mod both;

use super::{Branch, ConductanceTables, ContactPoint, SlopeAlong, value_without_table};
use crate::accuracy::Wanted;
use crate::evaluator::{Evaluator, SeenError, TableValues};
use crate::law::contact::{Clearance, ContactPressure, ContactState};
use crate::nodes::{Cells, Column};
use crate::numbers::mean;
use crate::plan::{MassFlow, Source, TablePlan};
use crate::results::{Along, Output, ResultBatch};
use crate::rows::{Binder, Part, Row, mean_mass_flow_of};
use crate::table::{PiecewiseTable, Sides};
use std::borrow::Cow;
use std::ops::Range;

/// The two branches of a conductance with the columns they read.
#[derive(Clone, Debug)]
pub(crate) struct BranchColumns {
    pub(crate) tables: ConductanceTables,
    /// The evaluators of the tables: against clearance, against contact pressure.
    forms: [Option<Evaluator>; 2],
    needs: [Needs; 2],
    /// The variables after clearance or contact pressure.
    pub(crate) variables: Vec<Option<Variable>>,
}

/// The numbers of a row that a table needs.
#[derive(Debug, Clone, Default)]
pub(crate) struct Needs {
    /// Its first variable, clearance or contact pressure.
    pub(crate) abscissa: bool,
    /// Others, by their index among the variables.
    pub(crate) variables: Vec<usize>,
}

/// Sources of a variable of a table.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Variable {
    /// The mean of both sides.
    Mean(Source<usize>),
    /// The mean of the magnitudes of the mass flow rates of both sides (K-32).
    MassFlow(MassFlow<usize>),
}

/// A slope of a conductance that is a result.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WantedSlope {
    pub(crate) slot: usize,
    pub(crate) along: SlopeAlong,
}

/// A conductance, row by row.
#[derive(Debug, Default)]
pub(crate) struct ConductanceColumn {
    pub(crate) values: Vec<f64>,
    /// The rounding errors; empty or NaN where unknown.
    pub(crate) rests: Vec<f64>,
    /// Where each row lies outside its table; empty where all of them lie within.
    pub(crate) sides: Vec<Sides>,
    /// Which rows have all inputs of their table; empty where all of them do.
    known: Vec<bool>,
}

/// The rows that read a table, and their coordinates.
#[derive(Debug, Default)]
pub(crate) struct Gathered<'a> {
    /// `None` where all rows read it.
    pub(crate) rows: Option<Vec<u32>>,
    pub(crate) count: usize,
    /// One column per axis of the table; empty where it is not read.
    pub(crate) columns: Vec<Cow<'a, [f64]>>,
}

/// Which table a row reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Reads {
    Branch(Branch),
    /// The row lacks a number.
    Nothing,
}

impl Needs {
    /// The variables that a table depends on.
    pub(crate) fn of(table: &PiecewiseTable) -> Self {
        let axes = table.axes();
        let matters = |axis: usize| axes[axis].matters();
        Self {
            abscissa: !axes.is_empty() && matters(0),
            variables: (1..axes.len()).filter(|axis| matters(*axis)).map(|axis| axis - 1).collect(),
        }
    }
}

impl Variable {
    /// The variable in all rows of a part.
    pub(crate) fn cells<'a>(&self, part: &'a Part<'_>) -> Cells<'a> {
        match self {
            Self::Mean(source) => Cells::of_source(part.batch(), source, mean),
            Self::MassFlow(of) => {
                let found: Vec<Option<f64>> = (0..part.rows()).map(|row| mean_mass_flow_of(*of, part, row)).collect();
                Cells {
                    values: found.iter().map(|found| found.unwrap_or(f64::NAN)).collect(),
                    present: Some(found.iter().map(Option::is_some).collect()),
                }
            }
        }
    }

    /// The variable in a row.
    #[inline]
    pub(crate) fn in_row(&self, row: Row<'_, '_>) -> Option<f64> {
        match self {
            Self::Mean(source) => row.fetch(source, mean),
            Self::MassFlow(of) => mean_mass_flow_of(*of, row.part, row.index),
        }
    }
}

impl<'a> Gathered<'a> {
    /// The columns of some rows: `abscissa` and the variables that a table needs, in the order of its axes.
    pub(crate) fn new(
        rows: Option<Vec<u32>>,
        all: usize,
        needs: &Needs,
        abscissa: Option<Cow<'a, [f64]>>,
        variables: &[Option<Cells<'a>>],
    ) -> Self {
        let mut columns = vec![Cow::Borrowed(&[][..]); variables.len() + 1];
        let count = rows.as_ref().map_or(all, Vec::len);
        let chosen = |column: Cow<'a, [f64]>| match &rows {
            None => column,
            Some(rows) => rows.iter().map(|row| column[*row as usize]).collect(),
        };
        if count > 0 {
            if let Some(abscissa) = abscissa {
                columns[0] = chosen(abscissa);
            }
            for place in &needs.variables {
                if let Some(cells) = variables.get(*place).and_then(Option::as_ref) {
                    columns[place + 1] = chosen(cells.values.clone());
                }
            }
        }
        Self { rows, count, columns }
    }

    /// Its columns as an evaluator takes them.
    pub(crate) fn slices(&self) -> Vec<&[f64]> {
        self.columns.iter().map(|column| &**column).collect()
    }
}

impl BranchColumns {
    /// The branches of the existing tables; those in use as folded by the plan.
    pub(crate) fn new(
        tables: ConductanceTables,
        planned: &[TablePlan],
        accuracy: Wanted,
        variables: Vec<Option<Variable>>,
    ) -> Self {
        let evaluator = |branch| {
            let against = if branch == Branch::Pressure { Along::Pressure } else { Along::Clearance };
            planned.iter().find(|planned| planned.against == against).and_then(TablePlan::evaluator)
        };
        let tables = tables.map(|branch, table| evaluator(branch).map_or(table, |evaluator| evaluator.table().clone()));
        let branches = [Branch::Clearance, Branch::Pressure];
        // A table that no row reaches stays unfolded: it determines the kind of conductance.
        let forms = branches.map(|branch| {
            let table = tables.table(branch)?;
            Some(evaluator(branch).cloned().unwrap_or_else(|| Evaluator::new(table, accuracy)))
        });
        let needs = branches.map(|branch| tables.table(branch).map(Needs::of).unwrap_or_default());
        Self { tables, forms, needs, variables }
    }

    /// The evaluator of the table of a branch.
    pub(crate) fn form(&self, branch: Branch) -> Option<&Evaluator> {
        self.forms[place(branch)].as_ref()
    }

    /// The reads of a part: for each branch the rows and their coordinates.
    fn gather<'a>(&self, part: &'a Part<'_>) -> (Vec<Reads>, [Gathered<'a>; 2]) {
        let is_needed = |variable: usize| self.needs.iter().any(|needs| needs.variables.contains(&variable));
        let variables = self.variables.iter().enumerate();
        let variables: Vec<Option<Cells<'a>>> =
            variables.map(|(index, variable)| variable.filter(|_| is_needed(index)).map(|of| of.cells(part))).collect();
        let reads = self.reads(part, &variables);
        let gathered = [Branch::Clearance, Branch::Pressure].map(|branch| {
            let is_read = |read: &Reads| *read == Reads::Branch(branch);
            let rows = if reads.iter().all(is_read) { None } else { Some(places_where(&reads, is_read)) };
            let needs = &self.needs[place(branch)];
            let abscissa = needs.abscissa.then(|| abscissae(branch, part));
            Gathered::new(rows, part.rows(), needs, abscissa, &variables)
        });
        (reads, gathered)
    }

    /// The points at which the tables are evaluated, for measurements.
    pub(crate) fn points<'a>(&self, part: &'a Part<'_>) -> [(Branch, Gathered<'a>); 2] {
        let [clearance, pressure] = self.gather(part).1;
        [(Branch::Clearance, clearance), (Branch::Pressure, pressure)]
    }

    /// The table that each row reads.
    fn reads(&self, part: &Part<'_>, variables: &[Option<Cells<'_>>]) -> Vec<Reads> {
        let is_plain = [Branch::Clearance, Branch::Pressure].into_iter().all(|branch| {
            let needs = &self.needs[place(branch)];
            // A table that no row reaches may depend on variables without a column in the plan.
            let cells = |variable: &usize| variables.get(*variable)?.as_ref();
            let is_full = |variable: &usize| cells(variable).is_some_and(|cells| cells.present.is_none());
            (!needs.abscissa || part.has_all_abscissae(branch)) && needs.variables.iter().all(is_full)
        });
        if !is_plain {
            return (0..part.rows()).map(|row| self.read_by(part, row, variables)).collect();
        }
        // No row lacks a number: its state decides.
        let [closed, open, undetermined] = [ContactState::Closed, ContactState::Open, ContactState::Undetermined]
            .map(|state| Reads::Branch(self.tables.branch_of(state)));
        let read = |state: &Option<ContactState>| match state {
            Some(ContactState::Closed) => closed,
            Some(ContactState::Open) => open,
            Some(ContactState::Undetermined) => undetermined,
            None => Reads::Nothing,
        };
        part.states.iter().map(read).collect()
    }

    #[inline]
    fn read_by(&self, part: &Part<'_>, row: usize, variables: &[Option<Cells<'_>>]) -> Reads {
        let Some(state) = part.states[row] else { return Reads::Nothing };
        let branch = self.tables.branch_of(state);
        if branch == Branch::Neither {
            return Reads::Branch(branch);
        }
        let needs = &self.needs[place(branch)];
        if needs.abscissa && !part.has_abscissa(branch, state, row) {
            return Reads::Nothing;
        }
        let has = |variable: &usize| variables[*variable].as_ref().is_some_and(|cells| cells.has(row));
        if needs.variables.iter().all(has) { Reads::Branch(branch) } else { Reads::Nothing }
    }

    /// The conductance of every row; a sample of the values is compared with the reference on request.
    pub(crate) fn evaluate(&self, part: &Part<'_>, mut seen: Option<&mut SeenError>) -> ConductanceColumn {
        if let Some(column) = self.evaluate_both(part, seen.as_deref_mut()) {
            return column;
        }
        let (reads, gathered) = self.gather(part);
        let mut column = ConductanceColumn::default();
        let mut found = TableValues::default();
        for (gathered, form) in gathered.iter().zip(&self.forms) {
            let Some(form) = form.as_ref().filter(|_| gathered.count > 0) else { continue };
            let slices = gathered.slices();
            form.evaluate(&slices, gathered.count, &mut found);
            if let Some(seen) = seen.as_deref_mut() {
                form.compare(&slices, &found.values, seen);
            }
            let Some(rows) = &gathered.rows else {
                let TableValues { values, rests, sides } = found;
                return ConductanceColumn { values, rests, sides, known: Vec::new() };
            };
            column.values.resize(reads.len(), f64::NAN);
            if !found.sides.is_empty() {
                column.sides.resize(reads.len(), Sides::default());
                rows.iter().zip(&found.sides).for_each(|(row, sides)| column.sides[*row as usize] = *sides);
            }
            for (place, row) in rows.iter().enumerate() {
                let row = *row as usize;
                column.values[row] = found.values[place];
                if let Some(rest) = found.rests.get(place) {
                    column.rests.resize(reads.len(), f64::NAN);
                    column.rests[row] = *rest;
                }
            }
        }
        column.values.resize(reads.len(), f64::NAN);
        if gathered.iter().map(|gathered| gathered.count).sum::<usize>() == reads.len() {
            return column;
        }
        for (row, read) in reads.iter().enumerate() {
            match (read, part.states[row]) {
                (Reads::Branch(Branch::Neither), Some(state)) => column.values[row] = value_without_table(state),
                (Reads::Nothing, _) | (_, None) => {
                    column.known.resize(reads.len(), true);
                    column.known[row] = false;
                }
                _ => {}
            }
        }
        column
    }
}

impl BranchColumns {
    /// Slopes in every row, one column for each requested slope: bitwise equal to [`ConductanceTables::slopes`] where a row has all inputs of its table.
    pub(crate) fn slopes(&self, part: &Part<'_>, wanted: &[WantedSlope]) -> Vec<Vec<f64>> {
        if wanted.is_empty() {
            return Vec::new();
        }
        let (reads, gathered) = self.gather(part);
        let clearances = part.clearances();
        let slopes_along = |along: SlopeAlong| {
            let without = reads.iter().zip(&part.states).map(|(read, state)| match (read, state) {
                (Reads::Branch(Branch::Neither), Some(state)) => value_without_table(*state),
                _ => f64::NAN,
            });
            let mut slopes: Vec<f64> = without.collect();
            for (branch, gathered) in [Branch::Clearance, Branch::Pressure].into_iter().zip(&gathered) {
                let Some(table) = self.tables.table(branch).filter(|_| gathered.count > 0) else { continue };
                let row = |place: usize| gathered.rows.as_ref().map_or(place, |rows| rows[place] as usize);
                let axes = (0..gathered.count).map(|place| {
                    let row = row(place);
                    along.axis_of(branch, part.states[row]?, clearances[row])
                });
                table.slopes_in_columns(&gathered.slices(), axes, |place, slope| slopes[row(place)] = slope);
            }
            slopes
        };
        wanted.iter().map(|wanted| slopes_along(wanted.along)).collect()
    }

    /// The slopes in one row, which has all inputs of its table.
    pub(crate) fn set_slopes(&self, row: Row<'_, '_>, wanted: &[WantedSlope], results: &mut ResultBatch) {
        if wanted.is_empty() {
            return;
        }
        let variables = in_row(&self.variables, row);
        let point = ContactPoint::of_row(row, &variables);
        for wanted in wanted {
            results.set(Some(wanted.slot), row.to, Some(self.tables.slope(wanted.along, &point)));
        }
    }
}

impl ContactPoint<'_> {
    /// The inputs of a conductance in a row.
    pub(crate) fn of_row<'v>(row: Row<'_, '_>, variables: &'v [f64]) -> ContactPoint<'v> {
        ContactPoint {
            clearance: Clearance(row.clearance.unwrap_or(f64::NAN)),
            pressure: ContactPressure(row.pressure.unwrap_or(f64::NAN)),
            state: row.state,
            variables,
        }
    }
}

/// Writes some rows of columns of slopes.
pub(crate) fn write_slopes(
    wanted: &[WantedSlope],
    slopes: &[Vec<f64>],
    rows: &Range<usize>,
    results: &mut ResultBatch,
) {
    for (wanted, column) in wanted.iter().zip(slopes) {
        let column = &column[rows.clone()];
        results.set_rows(Some(wanted.slot), rows, |row| column[row]);
    }
}

/// The variables of a row, NaN where there is none.
pub(crate) fn in_row(variables: &[Option<Variable>], row: Row<'_, '_>) -> Vec<f64> {
    variables.iter().map(|of| of.and_then(|of| of.in_row(row)).unwrap_or(f64::NAN)).collect()
}

impl ConductanceColumn {
    /// Where a row lies outside its table.
    #[inline]
    pub(crate) fn sides_of(&self, row: usize) -> Sides {
        self.sides.get(row).copied().unwrap_or_default()
    }

    /// A conductance row by row; `None` for a row that lacks a number.
    pub(crate) fn of_rows(found: impl Iterator<Item = Option<(f64, Sides)>>) -> Self {
        let mut column = Self::default();
        for found in found {
            let (value, sides) = found.unwrap_or((f64::NAN, Sides::default()));
            column.values.push(value);
            column.sides.push(sides);
            column.known.push(found.is_some());
        }
        column
    }

    /// Whether a row has all inputs of its table.
    #[inline]
    pub(crate) fn is_known(&self, row: usize) -> bool {
        self.known.is_empty() || self.known[row]
    }

    /// Whether every row has.
    pub(crate) fn is_full(&self) -> bool {
        self.known.iter().all(|known| *known)
    }

    /// The rounding error in a row, where known.
    #[inline]
    pub(crate) fn rest(&self, row: usize) -> Option<f64> {
        self.rests.get(row).copied().filter(|rest| !rest.is_nan())
    }
}

impl Binder<'_> {
    /// The indices of the mean temperature and the field variables of a conductance in a batch.
    pub(crate) fn means(self, sources: &[Option<Source<Column>>]) -> Vec<Option<Variable>> {
        sources.iter().map(|source| self.source(*source).map(Variable::Mean)).collect()
    }

    /// The slopes of a conductance that are results; `along` says which output is one, and `variable` the place of what it is along among `count` variables.
    pub(crate) fn slopes_of_conductance(
        self,
        along: impl Fn(Output) -> Option<Along>,
        count: usize,
        variable: impl Fn(Along) -> Option<usize>,
    ) -> Vec<WantedSlope> {
        let wanted = self.slopes(along).into_iter().filter_map(|(slot, along)| {
            let along = match along {
                Along::Clearance => SlopeAlong::Contact(Branch::Clearance),
                Along::Pressure => SlopeAlong::Contact(Branch::Pressure),
                along => SlopeAlong::Variable(variable(along).filter(|place| *place < count)?),
            };
            Some(WantedSlope { slot, along })
        });
        wanted.collect()
    }
}

/// The indices of some items, found without a branch: whether rows are closed or open is unpredictable.
fn places_where<T>(items: &[T], is_one: impl Fn(&T) -> bool) -> Vec<u32> {
    let mut places = vec![0; items.len()];
    let mut count = 0;
    for (place, item) in (0_u32..).zip(items) {
        places[count] = place;
        count += usize::from(is_one(item));
    }
    places.truncate(count);
    places
}

/// The index of a branch among the two.
fn place(branch: Branch) -> usize {
    usize::from(branch == Branch::Pressure)
}

/// The first coordinates of a branch's table; NaN where a row has none.
fn abscissae<'a>(branch: Branch, part: &'a Part<'_>) -> Cow<'a, [f64]> {
    if branch == Branch::Pressure {
        return part.pressures();
    }
    let clearances = part.clearances();
    let states = part.states.iter().zip(&*clearances);
    let read = states.map(|(state, clearance)| match state {
        Some(ContactState::Closed) => 0.0,
        Some(state) => state.table_clearance(Some(*clearance)).unwrap_or(f64::NAN),
        None => f64::NAN,
    });
    read.collect()
}
