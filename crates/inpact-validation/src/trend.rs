//! How the value of a conductance table goes along its first independent variable, for P005 and P006.

use crate::rule::Context;
use crate::tables::{Arranged, is_against_clearance, is_written, sound_tables, starts_as_it_must};
use inpact_parser::model::{TableKind, TableOf};

/// Where a table first goes the way it should not.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Trend {
    /// The row before.
    pub(crate) before: usize,
    /// The row that goes the wrong way.
    pub(crate) row: usize,
    /// How many steps go the wrong way.
    pub(crate) wrong: usize,
    /// How many steps there are.
    pub(crate) total: usize,
}

/// The tables of a kind in which some step inside a group `is_wrong`, with the first such step.
///
/// Negative values and empty ones have findings of their own and are passed over.
pub(crate) fn against<'a, 'deck>(
    context: &'a Context<'deck>,
    is_meant: impl Fn(TableKind) -> bool,
    is_wrong: impl Fn(f64, f64) -> bool,
) -> impl Iterator<Item = (&'a TableOf<'deck>, Trend)> {
    sound_tables(context).filter(move |of| is_meant(of.kind)).filter_map(move |of| {
        let arranged = Arranged::in_order(of.table)?;
        let mut trend = None;
        let (mut wrong, mut total) = (0, 0);
        // A group that starts where it must not may be one of the other kind (T004): it is judged by its values no further.
        let groups = arranged
            .complete_groups()
            .filter(|places| !is_against_clearance(of) || starts_as_it_must(of, arranged.row(places.start)[1]));
        for places in groups {
            for place in places.skip(1) {
                let (before, row) = (arranged.row(place - 1), arranged.row(place));
                if row[1] == before[1] || row[0] < 0.0 || before[0] < 0.0 {
                    continue;
                }
                total += 1;
                let written = |place: usize| is_written(context, of, arranged.index(place), 0);
                if is_wrong(before[0], row[0]) && written(place) && written(place - 1) {
                    wrong += 1;
                    trend.get_or_insert((arranged.index(place - 1), arranged.index(place)));
                }
            }
        }
        let (before, row) = trend?;
        Some((of, Trend { before, row, wrong, total }))
    })
}
