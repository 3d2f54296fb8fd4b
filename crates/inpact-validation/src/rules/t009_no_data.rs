//! T009: options that need rows and have none.

use inpact_parser::deck::RowsKept;
use inpact_parser::model::OptionKind;
use crate::constants::behavior;
use inpact_diagnostics::Severity;
use crate::parameter::given_as;
use crate::rule::{Context, DefinedBlock, Report, declare_rule};
use crate::tables::columns_are_unclear;

declare_rule! {
    /// An option that needs rows has none.
    ///
    /// An error where the option means nothing without rows.
    /// A warning for *GAP HEAT GENERATION, which then means its defaults: all the energy becomes heat, half of it on each side.
    ///
    /// ## Why
    /// A conductance without values is no law.
    /// Only *CONTACT PERMEABILITY may occur without rows: the pore pressures of both sides are then equal.
    ///
    /// ## What to do
    /// Give the rows, or `USER` where a user subroutine gives the law.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// ** to be measured
    /// ```
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=BRAKE
    /// *FRICTION
    /// 0.3,
    /// *GAP HEAT GENERATION
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.01, CUTOFF GAP FILL=0.01
    /// ```
    "T009", "no-data", Error, fix: None, source: "K-11, K-36, Q-15"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    // Asked once: the answer looks at every *INCLUDE.
    let has_unread_files = context.has_unread_files();
    let mut blocks = context.defined_blocks().peekable();
    while let Some(block) = blocks.next() {
        // Rows may occur in a file that is included here (S-51).
        let goes_on = blocks.peek().is_some_and(|next| next.name == "INCLUDE" && has_unread_files);
        if !goes_on && needs_rows(context, block) && !has_rows(context, block) {
            say(context, report, block);
        }
    }
}

fn needs_rows(context: &Context<'_>, block: DefinedBlock<'_>) -> bool {
    let data = &block.definition.data;
    let is_given = |name: &String| given_as(block, name).is_some();
    // Only options of numbers: what other options need is no question of tables.
    ((data.required && data.shape.is_numbers()) || block.kind() == OptionKind::GapHeatGeneration || is_behavior_with_rows(context, block))
        && !data.ignored_with.iter().any(is_given)
        && !columns_are_unclear(context, block)
}

fn has_rows(context: &Context<'_>, block: DefinedBlock<'_>) -> bool {
    let mut kept = context.deck.data_lines(block.block);
    block.block.rows_kept != RowsKept::All || kept.any(|line| !line.is_blank())
}

fn say(context: &Context<'_>, report: &mut Report<'_>, block: DefinedBlock<'_>) {
    let found = report.at(context.trimmed(block.keyword.span), format!("`*{}` has no rows", block.name));
    found.label("rows should follow");
    if block.kind() == OptionKind::GapHeatGeneration && !block.definition.data.required {
        found.severity(Severity::Warning);
        found.note("without a row all the energy becomes heat, half of it on each side");
        found.help("write `1., 0.5` if that is meant");
    } else if block.definition.parameter("USER").is_some() {
        found.note("without values there is no law");
        found.help("give the rows, or `USER` if a user subroutine gives the law");
    } else {
        found.note("without values there is no law").help("give the rows");
    }
}

/// Whether it is a *SURFACE BEHAVIOR of a law that CalculiX has no default for.
fn is_behavior_with_rows(context: &Context<'_>, block: DefinedBlock<'_>) -> bool {
    context.is_for_calculix()
        && block.name == "SURFACE BEHAVIOR"
        && matches!(behavior(context, block), Some("EXPONENTIAL" | "TABULAR"))
}
