//! Table lookups row by row, whose loads depend on each row's segment; the compiler does not vectorise them.

use super::pieces::{Bucket, Piece};

/// The block size in rows: small enough that the intermediate results of a block and the table fit in the L1 cache together.
pub(super) const BLOCK: usize = 128;

/// Explicit vector operations of an instruction set, in addition to auto-vectorised loops.
pub(crate) trait Lanes: Copy {
    /// Replaces each row's bucket by the piece that contains its `x`: [`Bucket::piece_at`].
    fn pieces_of_buckets(self, buckets: &[Bucket], x: &[f64], places: &mut [u32]);

    /// The four numbers of the pieces of `places`, row by row.
    fn fetch(self, pieces: &[Piece], places: &[u32], numbers: &mut [[f64; BLOCK]; 4]);

    /// The values at `x` on the pieces of `places`, row by row: [`Piece::value`].
    fn interpolate(self, pieces: &[Piece], x: &[f64], places: &[u32], values: &mut [f64]);

    /// [`Self::interpolate`] in two groups that have the same abscissae.
    fn interpolate_both(self, pieces: &[Piece], x: &[f64], places: [&[u32]; 2], values: [&mut [f64]; 2]);

    /// Prefetches numbers that are needed soon.
    fn prefetch(self, numbers: &[f64]);
}

/// No explicit vector instructions.
#[derive(Clone, Copy)]
pub(super) struct Plain;

impl Lanes for Plain {
    #[inline(always)]
    fn pieces_of_buckets(self, buckets: &[Bucket], x: &[f64], places: &mut [u32]) {
        for (&x, place) in x.iter().zip(places) {
            *place = buckets[*place as usize].piece_at(x);
        }
    }

    #[inline(always)]
    fn fetch(self, pieces: &[Piece], places: &[u32], numbers: &mut [[f64; BLOCK]; 4]) {
        fetch_from(0, pieces, places, numbers);
    }

    #[inline(always)]
    fn interpolate(self, pieces: &[Piece], x: &[f64], places: &[u32], values: &mut [f64]) {
        for ((&x, &place), value) in x.iter().zip(places).zip(values) {
            *value = pieces[place as usize].value(x);
        }
    }

    #[inline(always)]
    fn interpolate_both(self, pieces: &[Piece], x: &[f64], places: [&[u32]; 2], values: [&mut [f64]; 2]) {
        for (places, values) in places.into_iter().zip(values) {
            self.interpolate(pieces, x, places, values);
        }
    }

    #[inline(always)]
    fn prefetch(self, _: &[f64]) {}
}

/// [`Lanes::fetch`] from row `first` on, row by row.
#[inline(always)]
pub(super) fn fetch_from(first: usize, pieces: &[Piece], places: &[u32], numbers: &mut [[f64; BLOCK]; 4]) {
    let [a, b, c, d] = numbers;
    for (row, &place) in places.iter().enumerate().skip(first) {
        [a[row], b[row], c[row], d[row]] = pieces[place as usize].0;
    }
}
