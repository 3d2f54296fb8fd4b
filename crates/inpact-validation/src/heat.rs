//! The rows of *GAP HEAT GENERATION, for the rules on them.

use crate::rule::Context;
use inpact_parser::model::{HeatGeneration, Model, SetAsideItem};
use inpact_parser::span::Span;

/// Every *GAP HEAT GENERATION that the reader took for a sub-option of an interaction, misplaced ones too.
pub(crate) fn all(model: &Model) -> impl Iterator<Item = &HeatGeneration> {
    let placed = model.all_interactions().filter_map(|interaction| interaction.gap_heat_generation.as_ref());
    let aside = model.set_aside.iter().filter_map(|aside| match &aside.item {
        SetAsideItem::HeatGeneration(heat) => Some(heat),
        _ => None,
    });
    placed.chain(aside)
}

/// The span of an item of its row; the row where the item is not written, the keyword line where there is no row.
pub(crate) fn item(context: &Context<'_>, heat: &HeatGeneration, index: usize) -> Span {
    let Some(row) = heat.row else { return heat.span };
    let item = context.deck.data_lines_in(row).next().and_then(|line| line.items().nth(index));
    item.unwrap_or(row)
}
