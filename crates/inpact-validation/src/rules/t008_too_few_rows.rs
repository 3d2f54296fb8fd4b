//! T008: tables with fewer rows than their option needs.

use inpact_diagnostics::Severity;
use crate::order::has_clear_groups;
use crate::quantity::{and_more, column_name, values_of_row};
use crate::rule::{Context, Report, declare_rule};
use crate::tables::sound_tables;
use inpact_parser::model::{TableKind, TableOf};

declare_rule! {
    /// A table has one row where its option needs two.
    ///
    /// An error for *GAP CONDUCTANCE and for the view factors of *GAP RADIATION.
    /// A warning for *GAP ELECTRICAL CONDUCTANCE against clearance.
    /// One row is fine for *GAP ELECTRICAL CONDUCTANCE, PRESSURE and for *CONTACT PERMEABILITY: it is a constant.
    ///
    /// ## Why
    /// The keyword page of *GAP CONDUCTANCE requires at least two rows, and Abaqus/CAE two in every table against clearance.
    /// One row does not show where the conductance ends.
    ///
    /// ## What to do
    /// Add the clearance or the pressure up to which the value holds.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP CONDUCTANCE, PRESSURE
    /// 500., 0.
    /// ```
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP CONDUCTANCE, PRESSURE
    /// 500., 0.
    /// 500., 1.E8
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6,
    /// ```
    /// Each temperature and field variable has a table of its own, and each needs its two rows:
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP CONDUCTANCE
    /// 30., 0., 20.
    /// 25., 0., 400.
    /// ```
    "T008", "too-few-rows", Error, fix: None, source: "Q-10, Q-38, K-10, K-30, T-27"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for of in sound_tables(context).filter(|of| of.table.row_count() == 1) {
        let id = context.grammar.id_of(of.keyword);
        let definition = id.and_then(|id| context.grammar.keyword(id).definition());
        let severity = match definition {
            Some(definition) if definition.data.minimum_rows > 1 => Severity::Error,
            _ if of.kind == TableKind::ElectricalClearance => Severity::Warning,
            _ => continue,
        };
        let axis = column_name(&of.table.columns[1]);
        let found = report.at(of.table.row_span(0), format!("`*{}` has one row against {axis}", of.keyword));
        found.severity(severity).label("the only row").also(context.trimmed(of.table.keyword), "the option");
        if severity == Severity::Error {
            found.note("the option needs at least two rows");
        } else {
            found.note("Abaqus/CAE asks for two rows; the manual leaves open what one row means beyond its clearance");
        }
        found.help(format!("add a row with the {axis} up to which the value holds"));
    }
    for of in sound_tables(context).filter(|of| of.table.row_count() > 1 && is_thermal_clearance(*of)) {
        // Out of order the second row may occur elsewhere (T003), and a cell without a number may be in it (S006).
        if !has_clear_groups(of.table) {
            continue;
        }
        let mut alone = of.table.groups().filter(|group| group.len() == 1).map(|group| group.start);
        let Some(row) = alone.next() else { continue };
        let more = and_more(alone.count(), "group has one row", "groups have one row");
        report
            .at(of.table.row_span(row), format!("one row against clearance for {}", values_of_row(of.table, row, 2)))
            .label("the only row of its group")
            .also(context.trimmed(of.table.keyword), "the option")
            .note(format!("each combination of temperature, mass flow and field variables needs two rows or more{more}"))
            .help("add a row with the clearance up to which the value holds");
    }
}

/// Whether every group of the table needs two rows (Q-38).
pub(crate) fn is_thermal_clearance(of: TableOf<'_>) -> bool {
    of.kind == TableKind::ThermalClearance
}
