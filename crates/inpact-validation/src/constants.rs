//! The constants of *SURFACE BEHAVIOR and *FRICTION in decks for CalculiX, as ccx reads them.

use crate::parameter::given_as;
use crate::rule::{Context, DefinedBlock};
use inpact_parser::number::{FortranNumber, read_fortran};
use inpact_parser::span::Span;

/// The law of a *SURFACE BEHAVIOR; the last of several applies.
pub(crate) fn behavior<'a>(context: &Context<'_>, block: DefinedBlock<'a>) -> Option<&'a str> {
    let given = given_as(block, "PRESSURE-OVERCLOSURE")?;
    given.definition.choice_named(&given.text(context)?)
}

/// The number that CalculiX reads from an item; `None` where it reads none (S006, S008).
pub(crate) fn fortran_value(text: &[u8]) -> Option<f64> {
    match read_fortran(text).ok()? {
        FortranNumber::Whole(value) | FortranNumber::Cut { value, .. } => Some(value),
        FortranNumber::CutToNothing => None,
    }
}

/// Item `index` of the rows of a block, with its place: 0 for an empty item.
pub(crate) fn constants(context: &Context<'_>, block: DefinedBlock<'_>, index: usize) -> Vec<(Span, f64)> {
    let lines = context.rows(block);
    let constant = lines.filter_map(|line| {
        let place = line.items().nth(index).filter(|item| !item.is_empty());
        let value = place.map_or(Some(0.0), |item| fortran_value(context.deck.text(item)));
        Some((place.unwrap_or(line.span), value?))
    });
    constant.collect()
}
