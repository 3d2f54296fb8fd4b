//! Sources of the plan of an interaction, and the decisions that its laws share.

use super::choices::{Choices, Derivatives};
use super::law_columns::columns_of;
use super::reason::{LeftOut, Missing, Reason};
use super::source::{Presence, Source};
use super::surveyed::{InteractionSurvey, Survey};
use super::table_plan::{ContactColumns, History};
use super::tables::matters;
use crate::law::heat::HeatGeneration;
use crate::nodes::Column;
use crate::results::{Along, Output};
use crate::table::PiecewiseTable;
use inpact_parser::model::{Interaction, Model};
use std::collections::BTreeSet;

/// Sources of the plan of one interaction.
#[derive(Clone, Copy)]
pub(crate) struct Planner<'a> {
    pub(crate) model: &'a Model,
    pub(crate) interaction: &'a Interaction,
    pub(crate) index: usize,
    pub(crate) of: &'a InteractionSurvey,
    pub(crate) survey: &'a Survey,
    pub(crate) choices: &'a Choices,
}

/// Parts left out while a law is planned, by reason.
#[derive(Debug, Default)]
pub(crate) struct LeftOuts(pub(crate) Vec<LeftOut>);

impl LeftOuts {
    /// Leaves out a part that is named on its own.
    pub(crate) fn push(&mut self, what: impl Into<String>, reason: Reason) {
        self.0.push(LeftOut { what: what.into(), outputs: Vec::new(), reason });
    }

    /// Leaves outputs out; those left out for one reason are grouped.
    pub(crate) fn push_outputs(&mut self, outputs: &[Output], reason: Reason) {
        let names: Vec<String> = outputs.iter().map(|output| format!("`{output}`")).collect();
        self.0.push(LeftOut { what: names.join(", "), outputs: outputs.to_vec(), reason });
    }

    /// The plan of a law or of a part of it; where there is none, says why.
    pub(crate) fn planned<T>(&mut self, what: &str, planned: Result<Option<T>, Reason>) -> Option<T> {
        planned.unwrap_or_else(|reason| {
            self.push(what, reason);
            None
        })
    }
}

impl Planner<'_> {
    /// Whether tables may be folded: slopes along every axis are those of the original table, and a folded table has one more rounding than the reference allows.
    pub(crate) fn may_fold(self, is_slope: impl Fn(&Output) -> bool) -> bool {
        if !self.choices.accuracy.allows_folding() {
            return false;
        }
        let requested = self.choices.outputs.as_ref();
        self.choices.derivatives == Derivatives::LeftOut
            || requested.is_some_and(|requested| !requested.iter().any(is_slope))
    }

    pub(crate) fn presence(self, column: Column) -> Presence {
        self.survey.presence(self.index, column)
    }

    /// Whether a column has numbers in the rows of the interaction, or may have: one that no law could use was not read.
    pub(crate) fn may_have(self, column: Column) -> bool {
        let was_read = self.survey.columns.contains(&column);
        if was_read { self.presence(column).has_numbers() } else { self.survey.header.has(column) }
    }

    /// The columns of contact that have numbers.
    pub(crate) fn contact(self) -> ContactColumns {
        let found = |column| Some(column).filter(|column| self.presence(*column).has_numbers());
        ContactColumns {
            clearance: found(Column::Clearance),
            pressure: found(Column::Pressure),
            closed: found(Column::Closed),
            state: None,
        }
    }

    /// The source of a quantity that has a column of its own.
    pub(crate) fn cell(self, column: Column) -> Result<Column, Missing> {
        self.all_of([column]).map(|_| column)
    }

    /// Columns that must all have numbers.
    pub(crate) fn all_of<const N: usize>(self, columns: [Column; N]) -> Result<[Column; N], Missing> {
        let lacking: Vec<Column> = columns.into_iter().filter(|column| !self.presence(*column).has_numbers()).collect();
        let is_absent = |column: &Column| self.presence(*column) == Presence::Absent;
        match lacking.as_slice() {
            [] => Ok(columns),
            _ if lacking.iter().any(is_absent) => Err(Missing::absent(lacking)),
            _ => Err(Missing::empty(lacking)),
        }
    }

    /// The source of a quantity in one column or in those of the two sides; the single column takes precedence.
    pub(crate) fn whole_or_sides(self, [whole, slave, master]: [Column; 3]) -> Result<Source<Column>, Missing> {
        match (self.presence(whole), self.all_of([slave, master])) {
            (Presence::Full, _) | (Presence::Partial, Err(_)) => Ok(Source::Cell(whole)),
            (Presence::Partial, Ok(_)) => Ok(Source::CellOrSides(whole, slave, master)),
            (Presence::Empty | Presence::Absent, Ok(_)) => Ok(Source::Sides(slave, master)),
            (Presence::Empty | Presence::Absent, Err(missing)) => Err(missing.or(whole)),
        }
    }

    /// The sources of the variables of tables from axis `first` on; `None` where no table depends on one.
    pub(crate) fn sources(
        self,
        tables: &[&PiecewiseTable],
        first: usize,
        along: impl Fn(usize) -> Along,
    ) -> Result<Vec<Option<Source<Column>>>, Missing> {
        let count = tables.iter().map(|table| table.axis_count()).max().unwrap_or(first);
        let sources = (first..count).map(|axis| {
            let is_needed = tables.iter().any(|table| matters(table, axis));
            let columns = columns_of(along(axis)).filter(|_| is_needed);
            columns.map(|columns| self.whole_or_sides(columns)).transpose()
        });
        sources.collect()
    }

    /// Refuses rows that nothing tells the contact of.
    pub(crate) fn check_contact(self) -> Result<(), Missing> {
        if self.contact() == ContactColumns::default() { self.cell(Column::Clearance).map(drop) } else { Ok(()) }
    }

    /// Plans flows, each with its product with the area, its integral over time, and the integral's product; gives `area`, where it has numbers, and whether the rows of a node are a history.
    pub(crate) fn flows(
        self,
        groups: &[[Output; 4]],
        outputs: &mut BTreeSet<Output>,
        left_out: &mut LeftOuts,
    ) -> (Option<Column>, History) {
        let (area, history) = (self.cell(Column::Area), self.history());
        let mut without_area = Vec::new();
        let mut without_history = Vec::new();
        for &[flow, of_area, integral, integral_of_area] in groups {
            outputs.insert(flow);
            if area.is_ok() {
                outputs.insert(of_area);
            } else {
                without_area.extend([of_area, integral_of_area]);
            }
            match (history.is_ok(), area.is_ok()) {
                (true, true) => outputs.extend([integral, integral_of_area]),
                (true, false) => outputs.extend([integral]),
                (false, true) => without_history.extend([integral, integral_of_area]),
                (false, false) => without_history.push(integral),
            }
        }
        let found = (area.as_ref().ok().copied(), if history.is_ok() { History::ByTime } else { History::None });
        if let Err(missing) = area {
            left_out.push_outputs(&without_area, Reason::Missing(missing));
        }
        if let Err(missing) = history {
            left_out.push_outputs(&without_history, Reason::Missing(missing));
        }
        found
    }

    /// Whether the rows of a node are a history: `node` and `time` are present.
    pub(crate) fn history(self) -> Result<(), Missing> {
        let header = &self.survey.header;
        let columns: Vec<Column> =
            [Column::Node, Column::Time].into_iter().filter(|column| !header.has(*column)).collect();
        if !columns.is_empty() {
            return Err(Missing::absent(columns));
        }
        self.cell(Column::Time).map(drop)
    }

    /// Rejects a table whose first variable is needed by some row and present in none: a closed row needs no clearance.
    pub(crate) fn check_abscissa(self, against: Along, table: &PiecewiseTable) -> Result<(), Missing> {
        let is_clearance = against == Along::Clearance;
        if !matters(table, 0) || (is_clearance && self.never(self.of.open)) {
            return Ok(());
        }
        let column = if is_clearance { Column::Clearance } else { Column::Pressure };
        self.cell(column).map(drop)
    }

    /// The reason why no row uses the table against clearance or pressure, one of `count` tables of a conductance.
    pub(crate) fn unreached(self, against: Along, count: usize) -> Option<Reason> {
        match against {
            Along::Pressure if self.never(self.of.closed) => Some(Reason::NoRowClosed),
            // The table against clearance applies to closed rows too when it is the only one (section 4.2).
            Along::Clearance if count == 2 && self.never(self.of.open) => Some(Reason::NoRowOpen),
            _ => None,
        }
    }

    /// Conversion of dissipated energy into heat; `None` where it is switched off (K-05).
    pub(crate) fn heat_generation(self) -> Option<HeatGeneration> {
        generation_of(self.interaction)
    }

    /// Whether no row is closed, or none open; unknown for a table without rows.
    pub(crate) fn never(self, count: u64) -> bool {
        self.survey.rows > 0 && count == 0 && self.of.closed + self.of.open == self.of.rows
    }
}

/// Conversion of the energy dissipated in an interaction into heat; `None` where a user subroutine switches that off (K-05).
pub(crate) fn generation_of(interaction: &Interaction) -> Option<HeatGeneration> {
    if interaction.has_parameter("USER") {
        return None;
    }
    let given = interaction.gap_heat_generation.as_ref();
    Some(given.map_or_else(HeatGeneration::default, |given| HeatGeneration {
        fraction: given.fraction,
        slave_weight: given.slave_weight,
    }))
}
