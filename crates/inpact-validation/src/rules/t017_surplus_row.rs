//! T017: rows after the only one that an option has.

use crate::problems::{first_of_each_block, has_no_place};
use crate::quantity::and_more;
use crate::rule::{Context, Report, declare_rule};

declare_rule! {
    /// A row follows the first, in an option that has only one.
    ///
    /// *GAP HEAT GENERATION has one row; so has *SURFACE INTERACTION without `USER`.
    ///
    /// ## Why
    /// Abaqus does not read the row, or refuses the deck.
    /// inpact reads the first row only.
    /// In a deck for CalculiX the last row of *GAP HEAT GENERATION counts, and that is the one that is read.
    ///
    /// ## What to do
    /// Take the row out, or put the keyword in front of it that it belongs to.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=BRAKE
    /// 1.,
    /// *FRICTION
    /// 0.3,
    /// *GAP HEAT GENERATION
    /// 1., 0.5
    /// 0.9, 0.3
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=BRAKE
    /// 1.,
    /// *FRICTION
    /// 0.3,
    /// *GAP HEAT GENERATION
    /// 1., 0.5
    /// ```
    ///
    /// ```inp,expect,calculix
    /// *SURFACE INTERACTION, NAME=BRAKE
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
    /// *GAP CONDUCTANCE
    /// 100., 0., 293.
    /// *FRICTION
    /// 0.3, 1.E7
    /// *GAP HEAT GENERATION
    /// 0.8, 0.5, 3.
    /// 0.9, 0.3, 3.
    /// ```
    "T017", "surplus-row", Warning, fix: None, source: "S-38, K-01, CX-10"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for first in first_of_each_block(context, has_no_place) {
        let name = first.block.map_or("the option", |block| block.name);
        let more = and_more(first.more, "row is too much", "rows are too much");
        let found = report.at(context.trimmed(first.problem.span), format!("`*{name}` has only one row, and here are more"));
        found.label("not read").also(context.trimmed(first.problem.keyword), "the option");
        found.note(if context.is_for_calculix() {
            format!("for CalculiX the last row counts{more}")
        } else {
            format!("inpact reads the first row only{more}")
        });
        found.help("take the row out, or put its keyword in front of it");
    }
}
