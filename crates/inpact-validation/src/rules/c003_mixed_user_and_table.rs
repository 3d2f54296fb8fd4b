//! C003: laws that are given by a user subroutine and by a table.

use crate::rule::{Context, Report, declare_rule};
use inpact_parser::model::{Interaction, OptionKind};
use inpact_parser::span::Span;

declare_rule! {
    /// An interaction has the same conductance by a user subroutine and by a table.
    ///
    /// ## Why
    /// The subroutine gives the whole law, for open and for closed gaps.
    /// No manual says what a table beside it means.
    ///
    /// ## What to do
    /// Take one of the two out.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=WELD
    /// *GAP ELECTRICAL CONDUCTANCE, USER
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// 2.E6, 1.E6
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=WELD
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 1.E6, 0.
    /// 0., 1.E-5
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// 2.E6, 1.E6
    /// ```
    "C003", "mixed-user-and-table", Error, fix: None, source: "K-08"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for interaction in context.model.all_interactions() {
        if let Some(law) = &interaction.gap_electrical_conductance
            && let Some(user) = law.user
            && let Some(table) = law.clearance.as_ref().or(law.pressure.as_ref())
        {
            say(context, report, OptionKind::GapElectricalConductance.keyword(), user, table.keyword);
        }
        if let Some((user, table)) = thermal(interaction) {
            say(context, report, OptionKind::GapConductance.keyword(), user, table);
        }
    }
}

/// The keyword lines of the thermal conductance with USER and with a table.
fn thermal(interaction: &Interaction) -> Option<(Span, Span)> {
    let thermal = interaction.gap_conductance()?;
    Some((*thermal.users.first()?, thermal.tables.first()?.keyword))
}

fn say(context: &Context<'_>, report: &mut Report<'_>, keyword: &str, user: Span, table: Span) {
    report
        .at(user, format!("`*{keyword}` has a table and a user subroutine"))
        .label("the subroutine gives the whole law")
        .also(context.trimmed(table), "a table of the same law")
        .note("no manual says what a table beside a user subroutine means")
        .help("take one of the two out");
}
