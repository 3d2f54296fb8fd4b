//! The plan of a conductance from a user's routine: the arguments of its calls (semantics 7.1, U-1 to U-3).
//!
//! The routine is opaque: which arguments it uses is unknown, so all of them are read.
//! Without clearance or temperature there is no law; coordinates, times and counters that the node table lacks have defaults, and the plan says so.

use crate::law::user::{NAME_LENGTH, UserName, UserNames};
use crate::nodes::{Column, Header, Part, coordinates};
use crate::plan::law_columns::columns_of;
use crate::plan::planner::Planner;
use crate::plan::reason::Missing;
use crate::plan::source::Source;
use crate::results::Along;
use inpact_parser::model::{Model, Name, Reference};
use std::collections::BTreeSet;

/// Arguments of the routine of an interaction.
#[derive(Debug, Clone, PartialEq)]
pub struct UserPlan {
    /// The names of the interaction and its surfaces.
    pub names: UserNames,
    /// Sources of the temperatures of the two sides.
    pub temperatures: Source<Column>,
    /// Sources of field variables, from number 1 on; NPRED is their number.
    pub field_variables: Vec<Source<Column>>,
    /// Coordinates, times, step and increment, as far as they have numbers.
    pub others: Vec<Column>,
}

impl UserPlan {
    /// The columns it reads, besides those of contact.
    pub(crate) fn columns(&self) -> impl Iterator<Item = Column> {
        let sources = std::iter::once(&self.temperatures).chain(&self.field_variables);
        sources.flat_map(Source::cells).chain(self.others.iter().copied()).chain([Column::Clearance])
    }
}

/// Columns that have a default.
fn with_default() -> impl Iterator<Item = Column> {
    let coordinates = [Part::Slave, Part::Master].into_iter().flat_map(coordinates);
    coordinates.chain([Column::Step, Column::Increment, Column::StepTime, Column::Time])
}

/// Columns that a routine could be called with, in a table with this header.
pub(crate) fn want_user(header: &Header, wanted: &mut BTreeSet<Column>) {
    wanted.extend(columns_of(Along::Temperature).into_iter().flatten());
    let fields = header.cells.iter().filter_map(|cell| cell.column);
    wanted.extend(fields.filter(|column| matches!(column, Column::FieldVariable(..))));
    wanted.extend(with_default());
}

/// Plans the calls of an interaction's routine.
pub(crate) fn plan_user(planner: Planner<'_>, notes: &mut Vec<String>) -> Result<UserPlan, Missing> {
    planner.cell(Column::Clearance)?;
    let pair = |along| {
        let columns = columns_of(along).unwrap_or([Column::Clearance; 3]);
        sides_or_whole(columns, planner)
    };
    let temperatures = pair(Along::Temperature)?;
    let field_variables: Vec<Source<Column>> =
        (1..).map_while(|number| pair(Along::FieldVariable(number)).ok()).collect();
    note_fields_after_a_gap(planner, field_variables.len(), notes);
    let (others, lacking): (Vec<Column>, Vec<Column>) =
        with_default().partition(|column| planner.presence(*column).has_numbers());
    note_defaults(planner, &lacking, notes);
    let names = user_names(planner.model, &planner.interaction.name, notes);
    Ok(UserPlan { names, temperatures, field_variables, others })
}

/// The two sides of a quantity; where a row lacks one of them, the column of both sides.
fn sides_or_whole(columns: [Column; 3], planner: Planner<'_>) -> Result<Source<Column>, Missing> {
    let [whole, slave, master] = columns;
    match planner.whole_or_sides(columns)? {
        Source::Cell(_) if planner.all_of([slave, master]).is_ok() => Ok(Source::CellOrSides(whole, slave, master)),
        source => Ok(source),
    }
}

/// Field variables are numbered without gaps: those after a gap are not passed.
fn note_fields_after_a_gap(planner: Planner<'_>, count: usize, notes: &mut Vec<String>) {
    let is_after_gap =
        |column: &Column| matches!(column, Column::FieldVariable(number, _) if *number as usize > count + 1);
    let after_gap: Vec<String> =
        planner.survey.columns.iter().filter(|column| is_after_gap(column)).copied().map(quoted).collect();
    if !after_gap.is_empty() {
        notes.push(format!(
            "GAPELECTR is called with NPRED = {count}: field variable {} has no numbers, so {} cannot be handed over",
            count + 1,
            after_gap.join(", ")
        ));
    }
}

/// Arguments of the routine in place of missing columns.
fn note_defaults(planner: Planner<'_>, lacking: &[Column], notes: &mut Vec<String>) {
    let lacks = |column: &Column| lacking.contains(column);
    let mut defaults = Vec::new();
    let missing: Vec<Column> =
        [Part::Slave, Part::Master].into_iter().flat_map(coordinates).filter(|column| lacks(column)).collect();
    if !missing.is_empty() {
        let names: Vec<String> = missing.iter().copied().map(quoted).collect();
        defaults.push(format!("COORDS 0 for {}", names.join(", ")));
    }
    if !planner.survey.header.has(Column::Node) {
        defaults.push("NODE 0 for `node`".to_owned());
    }
    let others = [
        (Column::Step, "KSTEP 1 for `step`"),
        (Column::Increment, "KINC 1 for `increment`"),
        (Column::Time, "TIME(2) 0 for `time`"),
        (Column::StepTime, "TIME(1) the total time for `step_time`"),
    ];
    defaults.extend(others.into_iter().filter(|(column, _)| lacks(column)).map(|(_, text)| text.to_owned()));
    if !defaults.is_empty() {
        notes.push(format!("GAPELECTR is given defaults for columns that have no numbers: {}", defaults.join("; ")));
    }
}

fn quoted(column: Column) -> String {
    format!("`{column}`")
}

/// The names, in the case passed to user subroutines (S-43): upper case, except quoted parts.
pub(crate) fn user_names(model: &Model, interaction: &Name, notes: &mut Vec<String>) -> UserNames {
    let of_this = model.contact_pairs.iter().filter(|pair| {
        let governed_by = pair.interaction.as_ref();
        governed_by.is_some_and(|reference| reference.name == *interaction)
    });
    let mut pairs = of_this.flat_map(|pair| &pair.pairs);
    let (slave, master) = match (pairs.next(), pairs.next()) {
        // A single surface means self-contact.
        (Some(pair), None) => (Some(&pair.slave), Some(pair.master.as_ref().unwrap_or(&pair.slave))),
        (first, _) => {
            let why = if first.is_some() { "more than one contact pair names" } else { "no contact pair names" };
            notes.push(format!("GAPELECTR is called with blank SLNAME and MSNAME: {why} `{interaction}`"));
            (None, None)
        }
    };
    let mut name = |name: &Name| {
        let text = name.canonical();
        if text.len() > NAME_LENGTH {
            notes.push(format!("GAPELECTR sees the first {NAME_LENGTH} characters of `{name}`"));
        }
        UserName::new(text)
    };
    let mut surface = |surface: Option<&Reference>| surface.map_or_else(UserName::blank, |surface| name(&surface.name));
    let (slave, master) = (surface(slave), surface(master));
    UserNames { interaction: name(interaction), slave, master }
}
