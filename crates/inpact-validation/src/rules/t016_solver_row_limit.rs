//! T016: more rows than CalculiX has room for.

use crate::rule::{Context, Report, declare_rule};

/// The rows a temperature that `springforc_f2f_th.f` has room for.
const ROWS: usize = 20;

declare_rule! {
    /// A table of *GAP CONDUCTANCE has more than 20 rows for one temperature, in the `calculix` dialect.
    ///
    /// ## Why
    /// CalculiX ccx 2.20 copies the rows of one temperature into an array of 20 for face-to-face contact, without a check.
    /// Tables of 33 rows and more were seen to give conductances many times too large, without a message.
    ///
    /// ## What to do
    /// Keep 20 rows a temperature or fewer.
    ///
    /// ```inp,expect,calculix
    /// *SURFACE INTERACTION, NAME=A
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
    /// *GAP CONDUCTANCE
    /// 1., 0.
    /// 2., 1.
    /// 3., 2.
    /// 4., 3.
    /// 5., 4.
    /// 6., 5.
    /// 7., 6.
    /// 8., 7.
    /// 9., 8.
    /// 10., 9.
    /// 11., 10.
    /// 12., 11.
    /// 13., 12.
    /// 14., 13.
    /// 15., 14.
    /// 16., 15.
    /// 17., 16.
    /// 18., 17.
    /// 19., 18.
    /// 20., 19.
    /// 21., 20.
    /// ```
    ///
    /// ```inp,calculix
    /// *SURFACE INTERACTION, NAME=A
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
    /// *GAP CONDUCTANCE
    /// 1., 0.
    /// 2., 1.
    /// ```
    "T016", "solver-row-limit", Warning, fix: None, source: "measured with CalculiX ccx 2.20"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    if !context.is_for_calculix() {
        return;
    }
    for of in context.tables().filter(|of| of.kind.is_thermal_conductance()) {
        for group in of.table.groups().filter(|group| group.len() > ROWS) {
            let first_too_many = of.table.row_span(group.start + ROWS);
            report
                .at(first_too_many, format!("{} rows for one temperature: CalculiX has room for {ROWS}", group.len()))
                .label("the first row too many")
                .also(of.table.row_span(group.start), "the first row of this temperature")
                .note("ccx 2.20 writes past the end of its array and goes on with wrong conductances, without a message")
                .help(format!("keep {ROWS} rows a temperature or fewer"));
        }
    }
}
