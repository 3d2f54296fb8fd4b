//! Totals of columns: the same bits for any number of threads and with any instruction set.
//!
//! A column is cut into blocks of [`BLOCK`] rows. Within a block, `LANES` compensated sums run side by side, row r in lane r mod `LANES`;
//! the lanes are merged in their order and the blocks in theirs.
//! Both numbers are fixed, so that nothing but the column decides the order in which its rows are added.

use rayon::prelude::*;

use super::InstructionSet;
use crate::numbers::{CompensatedSum, two_sum};

/// Rows that are added up together before their sum is merged.
pub const BLOCK: usize = 4096;

/// Sums that run side by side in a block.
const LANES: usize = 32;

/// The total of a column, with the threads of the current rayon pool.
///
/// Its error is that of [`CompensatedSum`]; a term that is infinite or NaN makes the total so.
pub fn total(column: &[f64]) -> CompensatedSum {
    let set = InstructionSet::best();
    let sums: Vec<CompensatedSum> = column.par_chunks(BLOCK).map(|block| block_total(set, block)).collect();
    merged(&sums)
}

/// [`total`] without other threads and with the instructions of `set`.
pub fn total_with(set: InstructionSet, column: &[f64]) -> CompensatedSum {
    let mut sum = CompensatedSum::default();
    for block in column.chunks(BLOCK) {
        sum.merge(&block_total(set, block));
    }
    sum
}

/// The total of one block, for those who go through a column block by block: merged in order, the blocks give [`total`].
///
/// `block` has [`BLOCK`] rows, or fewer at the end of the column.
pub fn block_total(set: InstructionSet, block: &[f64]) -> CompensatedSum {
    set.run(BlockTotal { block })
}

/// The blocks' sums in one.
fn merged(sums: &[CompensatedSum]) -> CompensatedSum {
    let mut all = CompensatedSum::default();
    for sum in sums {
        all.merge(sum);
    }
    all
}

struct BlockTotal<'a> {
    block: &'a [f64],
}

impl super::instruction_set::Operation for BlockTotal<'_> {
    type Output = CompensatedSum;

    #[inline(always)]
    fn call<L: super::instruction_set::Lanes>(self, _: L) -> CompensatedSum {
        let mut sums = [0.0; LANES];
        let mut compensations = [0.0; LANES];
        let (rows, rest) = self.block.as_chunks::<LANES>();
        for row in rows {
            add_row(&mut sums, &mut compensations, row);
        }
        for (lane, &term) in rest.iter().enumerate() {
            let (sum, error) = two_sum(sums[lane], term);
            sums[lane] = sum;
            compensations[lane] += error;
        }
        let mut all = CompensatedSum::default();
        for (&sum, &compensation) in sums.iter().zip(&compensations) {
            all.merge(&CompensatedSum::from_parts(sum, compensation));
        }
        all
    }
}

/// Adds one term to each lane.
#[inline(always)]
fn add_row(sums: &mut [f64; LANES], compensations: &mut [f64; LANES], terms: &[f64; LANES]) {
    for lane in 0..LANES {
        let (sum, error) = two_sum(sums[lane], terms[lane]);
        sums[lane] = sum;
        compensations[lane] += error;
    }
}
