//! P005: conductances that grow as the gap opens.

use crate::quantity::and_more;
use crate::rule::{Context, Report, declare_rule};
use crate::trend::against;
use inpact_parser::model::TableKind;

declare_rule! {
    /// A conductance rises from one clearance to the next larger one.
    ///
    /// ## Why
    /// A wider gap conducts worse, not better.
    /// A table that rises is most often one against contact pressure that lacks `PRESSURE`, or has its columns swapped.
    ///
    /// ## What to do
    /// If the second column holds contact pressures, give `PRESSURE` on the keyword line.
    /// Otherwise check the values.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP CONDUCTANCE
    /// 50., 0.
    /// 65., 100.
    /// 70., 250.
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP CONDUCTANCE, PRESSURE
    /// 50., 0.
    /// 65., 100.
    /// 70., 250.
    /// ```
    "P005", "grows-with-clearance", Warning, fix: None, source: "4.2, T-21"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for (of, trend) in against(context, TableKind::is_conductance_against_clearance, |before, value| value > before) {
        let more = and_more(trend.wrong - 1, "step of this table rises", "steps of this table rise");
        let found = trend.report(context, report, of, ["rises", "the clearance grows"]);
        found.label("higher than at the smaller clearance");
        found.also(context.cell(of, trend.before, 0), "the value at the smaller clearance");
        found.note(format!("a wider gap conducts worse{more}"));
        found.help(trend.help("give `PRESSURE` if the second column holds contact pressures"));
    }
}
