//! Row blocks of a fixed size, shared among threads.

use std::ops::Range;

use rayon::prelude::*;

/// Rows of a block: some ten columns of it stay in a core's second cache.
pub const ROWS: usize = 4096;

/// Cuts a column that is written into blocks and runs `block` on each, with the threads of the current rayon pool.
///
/// `block` gets the rows' numbers and their part of `column`. Where the blocks begin depends on nothing but [`ROWS`],
/// so that results which depend on the rows of a block alone are the same for any number of threads.
pub fn for_each_block<T: Send>(column: &mut [T], block: impl Fn(Range<usize>, &mut [T]) + Sync) {
    column.par_chunks_mut(ROWS).enumerate().for_each(|(index, part)| {
        let first = index * ROWS;
        block(first..first + part.len(), part);
    });
}

/// Runs `block` on each block of `rows` rows and gives what it makes of them, in the order of the blocks.
pub fn map_blocks<R: Send>(rows: usize, block: impl Fn(Range<usize>) -> R + Sync) -> Vec<R> {
    (0..rows.div_ceil(ROWS)).into_par_iter().map(|index| block(index * ROWS..rows.min((index + 1) * ROWS))).collect()
}
