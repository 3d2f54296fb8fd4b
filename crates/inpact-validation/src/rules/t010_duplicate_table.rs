//! T010: the same kind of law twice in one interaction.

use crate::rule::{Context, Report, declare_rule};
use crate::tables::has_unclear_parameters;
use inpact_parser::grammar::RowShape;
use inpact_parser::model::{Interaction, SetAsideItem, SetAsideReason, TableKind, OptionKind};
use inpact_parser::span::{SourceId, Span};

declare_rule! {
    /// An interaction has the same option twice, for the same kind of table.
    ///
    /// A table against clearance and one with `PRESSURE` are two kinds: together they are how a law is given for open and closed gaps.
    ///
    /// ## Why
    /// Both cannot govern, and no manual says which one Abaqus takes.
    /// inpact evaluates the last one.
    ///
    /// ## What to do
    /// Take one of them out.
    /// If the tables are for different temperatures, put their rows into one table.
    /// If one of them is against contact pressure, it lacks `PRESSURE`.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 2.E6, 0.
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 1.E6, 0.
    /// 0.,   1.E-5
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// 2.E6, 1.E6
    /// ```
    "T010", "duplicate-table", Error, fix: None, source: "Q-9, K-07"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let mut duplicates = Vec::new();
    for aside in &context.model.set_aside {
        let SetAsideReason::ReplacedBy(later) = aside.reason else { continue };
        let (keyword, earlier) = match &aside.item {
            SetAsideItem::Table(table) => (OptionKind::GapElectricalConductance.keyword(), table.keyword),
            SetAsideItem::ContactPermeability(option) => (OptionKind::ContactPermeability.keyword(), option.span),
            SetAsideItem::HeatGeneration(option) => (OptionKind::GapHeatGeneration.keyword(), option.span),
            SetAsideItem::SubOption(_) | SetAsideItem::Interaction(_) => continue,
        };
        duplicates.push((keyword, later, earlier));
    }
    for interaction in context.model.all_interactions() {
        find_among_others(interaction, &mut duplicates);
    }
    if duplicates.is_empty() {
        return;
    }
    let doubtful = doubtful_lines(context);
    let is_doubtful = |later: Span, earlier: Span| {
        let after = doubtful.partition_point(|line| *line < (earlier.source(), earlier.start()));
        doubtful.get(after).is_some_and(|line| *line <= (later.source(), later.start()))
    };
    for (keyword, later, earlier) in duplicates {
        if !is_doubtful(later, earlier) {
            say(context, report, keyword, later, earlier);
        }
    }
}

/// The starts of lines that a duplicate may come from, in ascending order: unknown keywords, since one may begin
/// another interaction (K001), and parameters that nobody knows, since one may be PRESSURE (K004).
fn doubtful_lines(context: &Context<'_>) -> Vec<(SourceId, u64)> {
    let unknown = context.keyword_lines().filter(|keyword| keyword.id().is_none());
    let unclear = context
        .defined_blocks()
        .filter(|block| matches!(block.definition.rows(), RowShape::Table) && has_unclear_parameters(block.keyword));
    let lines = unknown.chain(unclear.map(|block| block.keyword));
    let mut lines: Vec<_> = lines.map(|keyword| (keyword.span.source(), keyword.span.start())).collect();
    lines.sort_unstable();
    lines
}

/// Finds duplicates among the options that the model keeps in one list: keyword, the later one, the earlier one.
fn find_among_others<'a>(interaction: &'a Interaction, duplicates: &mut Vec<(&'a str, Span, Span)>) {
    let mut seen: Vec<(&str, TableKind, Span)> = Vec::new();
    for option in &interaction.other {
        let kind = match &option.table {
            Some(table) => TableKind::of(&option.keyword, table),
            None if option.kind() == OptionKind::GapRadiation => TableKind::ViewFactor,
            None => continue,
        };
        match seen.iter_mut().find(|(keyword, of_kind, _)| option.keyword == *keyword && *of_kind == kind) {
            Some((_, _, earlier)) => {
                duplicates.push((&option.keyword, option.span, *earlier));
                *earlier = option.span;
            }
            None => seen.push((&option.keyword, kind, option.span)),
        }
    }
}

fn say(context: &Context<'_>, report: &mut Report<'_>, keyword: &str, later: Span, earlier: Span) {
    report
        .at(later, format!("duplicate `*{keyword}` in one interaction, for the same kind of table"))
        .label("the second one")
        .also(context.trimmed(earlier), "the first one")
        .note("both cannot govern; inpact evaluates the last")
        .help("take one of them out, or put their rows into one table");
}
