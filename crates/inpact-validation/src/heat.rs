//! The rows of *GAP HEAT GENERATION, for the rules on them.

use crate::constants::constants;
use crate::rule::Context;

use inpact_parser::model::{HeatGeneration, Model, OptionKind, SetAsideItem};
use inpact_parser::span::Span;

/// Every *GAP HEAT GENERATION that the reader accepted as a sub-option of an interaction, including misplaced ones.
fn all(model: &Model) -> impl Iterator<Item = &HeatGeneration> {
    let placed = model.all_interactions().filter_map(|interaction| interaction.gap_heat_generation.as_deref());
    let aside = model.set_aside.iter().filter_map(|aside| match &aside.item {
        SetAsideItem::HeatGeneration(heat) => Some(&**heat),
        _ => None,
    });
    placed.chain(aside)
}

/// An item of every row that is read, with its place; where there is no row, its default at the keyword line.
///
/// Abaqus reads one row; CalculiX checks every row, though only the last applies (CX-10).
pub(crate) fn items(context: &Context<'_>, index: usize) -> Vec<(Span, f64)> {
    if context.is_for_calculix() {
        let options = context.defined_blocks().filter(|block| block.kind() == OptionKind::GapHeatGeneration);
        return options.flat_map(|block| constants(context, block, index)).collect();
    }
    let of = |heat: &HeatGeneration| (item(context, heat, index), [heat.fraction, heat.slave_weight][index]);
    all(context.model).map(of).collect()
}

/// The span of an item of its row; the row where the item is not written, the keyword line where there is no row.
fn item(context: &Context<'_>, heat: &HeatGeneration, index: usize) -> Span {
    let Some(row) = heat.row else { return heat.span };
    let item = context.deck.data_lines_in(row).next().and_then(|line| line.items().nth(index));
    item.unwrap_or(row)
}
