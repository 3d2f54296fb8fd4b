//! Tables of one axis and at most 16 knots, held in AVX-512 registers.
//!
//! The segment is found by binary search, each step a permutation that fetches the knot to compare with; another fetches the start of its right half,
//! which gives the nearer end (see [`super::pieces`]), and the last four fetch that end, the value there and the slope.

use std::arch::x86_64::{__m512d, __m512i, _CMP_GE_OQ, _CMP_GT_OQ, _CMP_UNORD_Q};

use pulp::bytemuck::cast;
use pulp::x86::V4;

use super::pieces::last_of_left_half;
use crate::table::{PiecewiseTable, Sides, Tail};

/// The maximum number of knots: two registers for each number of a knot.
const MAX_KNOTS: usize = 16;

type Lanes = [f64; 8];

/// Vectors that are evaluated together to hide latency (instruction-level parallelism), and their rows.
const VECTORS: usize = 4;
const ROWS: usize = 8 * VECTORS;

/// A small table in the form of the registers' contents.
#[derive(Clone, Debug)]
pub(super) struct RegisterKernel {
    pub(super) axis: usize,
    first: f64,
    last: f64,
    tail: Tail,
    /// The number of binary search steps, 0 to 4.
    halvings: u32,
    /// The abscissae of each binary search step, at the index found so far.
    halving_knots: [[Lanes; 2]; 4],
    /// Where the right half of each segment begins.
    right_halves: [Lanes; 2],
    /// The knots with the sign turned, and their values.
    negated_knots: [Lanes; 2],
    values: [Lanes; 2],
    /// The slope of each segment in two parts.
    high: [Lanes; 2],
    low: [Lanes; 2],
}

impl RegisterKernel {
    /// The kernel of a table, if it has one axis and few knots, two at least.
    ///
    /// A value −0 would lose its sign where it is interpolated from itself; such a table is left to the other kernel.
    pub(super) fn new(table: &PiecewiseTable) -> Option<Self> {
        let [level] = table.levels() else { return None };
        let knots = &level.knots;
        let is_negative_zero = |value: &f64| *value == 0.0 && value.is_sign_negative();
        if knots.len() < 2 || MAX_KNOTS < knots.len() || table.values().iter().any(is_negative_zero) {
            return None;
        }
        let segments = knots.len() - 1;
        let halvings = segments.next_power_of_two().trailing_zeros();
        let mut halving_knots = [[f64::NAN; MAX_KNOTS]; 4];
        for (done, at) in halving_knots.iter_mut().enumerate().take(halvings as usize) {
            let step = 1 << (halvings as usize - 1 - done);
            for index in (0..MAX_KNOTS).step_by(2 * step) {
                // The comparison with a missing knot, or with the last one, fails.
                at[index] = if index + step < segments { knots[index + step] } else { f64::NAN };
            }
        }
        let of_segments = |number: &dyn Fn(usize) -> f64| {
            let mut numbers = [f64::NAN; MAX_KNOTS];
            (0..segments).for_each(|segment| numbers[segment] = number(segment));
            cast(numbers)
        };
        let of_knots = |number: &dyn Fn(usize) -> f64| {
            let mut numbers = [f64::NAN; MAX_KNOTS];
            (0..knots.len()).for_each(|knot| numbers[knot] = number(knot));
            cast(numbers)
        };
        Some(Self {
            axis: level.axis,
            first: knots[0],
            last: knots[segments],
            tail: if level.drops { Tail::Zero } else { Tail::Constant },
            halvings,
            halving_knots: halving_knots.map(cast),
            right_halves: of_segments(&|segment| last_of_left_half(knots[segment], knots[segment + 1]).next_up()),
            negated_knots: of_knots(&|knot| -knots[knot]),
            values: of_knots(&|knot| table.values()[knot]),
            high: of_segments(&|segment| table.slopes()[segment].parts().0),
            low: of_segments(&|segment| table.slopes()[segment].parts().1),
        })
    }

    /// The values of all rows, and whether some are NaN. Without AVX-512 all are.
    pub(super) fn values(&self, column: &[f64], values: &mut [f64]) -> bool {
        let Some(simd) = V4::try_new() else {
            values.fill(f64::NAN);
            return true;
        };
        match (self.halvings, self.tail) {
            (0, Tail::Constant) => simd.vectorize(Run::<0, false> { kernel: self, simd, column, values }),
            (1, Tail::Constant) => simd.vectorize(Run::<1, false> { kernel: self, simd, column, values }),
            (2, Tail::Constant) => simd.vectorize(Run::<2, false> { kernel: self, simd, column, values }),
            (3, Tail::Constant) => simd.vectorize(Run::<3, false> { kernel: self, simd, column, values }),
            (_, Tail::Constant) => simd.vectorize(Run::<4, false> { kernel: self, simd, column, values }),
            (0, Tail::Zero) => simd.vectorize(Run::<0, true> { kernel: self, simd, column, values }),
            (1, Tail::Zero) => simd.vectorize(Run::<1, true> { kernel: self, simd, column, values }),
            (2, Tail::Zero) => simd.vectorize(Run::<2, true> { kernel: self, simd, column, values }),
            (3, Tail::Zero) => simd.vectorize(Run::<3, true> { kernel: self, simd, column, values }),
            (_, Tail::Zero) => simd.vectorize(Run::<4, true> { kernel: self, simd, column, values }),
        }
    }

    /// Records on which side of the table each row lies.
    pub(super) fn sides(&self, column: &[f64], sides: &mut [Sides]) {
        for (&x, sides) in column.iter().zip(sides) {
            if x < self.first {
                sides.mark_below(self.axis);
            }
            if x > self.last {
                sides.mark_above(self.axis);
            }
        }
    }
}

/// One evaluation, compiled for each number of search steps and each tail.
struct Run<'a, const HALVINGS: u32, const DROPS: bool> {
    kernel: &'a RegisterKernel,
    simd: V4,
    column: &'a [f64],
    values: &'a mut [f64],
}

impl<const HALVINGS: u32, const DROPS: bool> pulp::NullaryFnOnce for Run<'_, HALVINGS, DROPS> {
    type Output = bool;

    #[inline(always)]
    fn call(self) -> bool {
        let Self { kernel, simd, column, values } = self;
        let registers = Registers::<HALVINGS, DROPS>::load(kernel, simd);
        let mut has_nan = 0;
        let (blocks, rest) = column.as_chunks::<ROWS>();
        let (value_blocks, value_rest) = values.as_chunks_mut::<ROWS>();
        for (x, value) in blocks.iter().zip(value_blocks) {
            // All are read before the first is written, to avoid 4K aliasing: a load that matches a preceding store modulo 4096 would wait for it.
            let x: [Lanes; VECTORS] = cast(*x);
            let x: [__m512d; VECTORS] = [cast(x[0]), cast(x[1]), cast(x[2]), cast(x[3])];
            let results =
                [registers.values(x[0]), registers.values(x[1]), registers.values(x[2]), registers.values(x[3])];
            for (result, value) in results.iter().zip(value.as_chunks_mut::<8>().0) {
                *value = cast(result.0);
                has_nan |= result.1;
            }
        }
        for (x, value) in rest.chunks(8).zip(value_rest.chunks_mut(8)) {
            let mut lanes = [kernel.first; 8];
            lanes[..x.len()].copy_from_slice(x);
            let (result, nan) = registers.values(cast(lanes));
            let result: Lanes = cast(result);
            value.copy_from_slice(&result[..x.len()]);
            has_nan |= nan;
        }
        has_nan != 0
    }
}

/// The table in registers.
#[derive(Clone, Copy)]
struct Registers<const HALVINGS: u32, const DROPS: bool> {
    simd: V4,
    first: __m512d,
    last: __m512d,
    halving_knots: [[__m512d; 2]; 4],
    right_halves: [__m512d; 2],
    negated_knots: [__m512d; 2],
    values: [__m512d; 2],
    high: [__m512d; 2],
    low: [__m512d; 2],
}

impl<const HALVINGS: u32, const DROPS: bool> Registers<HALVINGS, DROPS> {
    #[inline(always)]
    fn load(kernel: &RegisterKernel, simd: V4) -> Self {
        let both = |lanes: &[Lanes; 2]| [cast(lanes[0]), cast(lanes[1])];
        Self {
            simd,
            first: cast([kernel.first; 8]),
            last: cast([kernel.last; 8]),
            halving_knots: [
                both(&kernel.halving_knots[0]),
                both(&kernel.halving_knots[1]),
                both(&kernel.halving_knots[2]),
                both(&kernel.halving_knots[3]),
            ],
            right_halves: both(&kernel.right_halves),
            negated_knots: both(&kernel.negated_knots),
            values: both(&kernel.values),
            high: both(&kernel.high),
            low: both(&kernel.low),
        }
    }

    /// The values at eight abscissae, and which of them are NaN.
    #[inline(always)]
    fn values(&self, x: __m512d) -> (__m512d, u8) {
        let avx = self.simd.avx512f;
        let unclamped = x;
        // With x as the second operand NaN stays NaN.
        let x = avx._mm512_min_pd(self.last, avx._mm512_max_pd(self.first, x));
        let mut index: __m512i = cast([0_u64; 8]);
        for done in 0..HALVINGS {
            let knots = if done == 0 {
                let knot: Lanes = cast(self.halving_knots[0][0]);
                cast([knot[0]; 8])
            } else {
                self.fetch(index, &self.halving_knots[done as usize])
            };
            let right = avx._mm512_cmp_pd_mask::<_CMP_GE_OQ>(x, knots);
            index = avx._mm512_mask_or_epi64(index, right, index, cast([1_u64 << (HALVINGS - 1 - done); 8]));
        }
        let in_right_half = avx._mm512_cmp_pd_mask::<_CMP_GE_OQ>(x, self.fetch(index, &self.right_halves));
        let end = avx._mm512_mask_add_epi64(index, in_right_half, index, cast([1_u64; 8]));
        let (high, low) = (self.fetch(index, &self.high), self.fetch(index, &self.low));
        let negated_near = self.fetch_knot(end, &self.negated_knots);
        let base = self.fetch_knot(end, &self.values);
        // From here on the expression of `numbers::interpolate`, with `two_sum(x, -near)`.
        let offset = avx._mm512_add_pd(x, negated_near);
        let near_part = avx._mm512_sub_pd(offset, x);
        let x_part = avx._mm512_sub_pd(offset, near_part);
        let x_error = avx._mm512_sub_pd(x, x_part);
        let near_error = avx._mm512_sub_pd(negated_near, near_part);
        let offset_error = avx._mm512_add_pd(x_error, near_error);
        let value = avx._mm512_fmadd_pd(offset, high, base);
        let correction = avx._mm512_add_pd(avx._mm512_mul_pd(offset, low), avx._mm512_mul_pd(offset_error, high));
        let mut value = avx._mm512_add_pd(value, correction);
        if DROPS {
            let beyond = avx._mm512_cmp_pd_mask::<_CMP_GT_OQ>(unclamped, self.last);
            value = avx._mm512_mask_mov_pd(value, beyond, cast([0.0_f64; 8]));
        }
        (value, avx._mm512_cmp_pd_mask::<_CMP_UNORD_Q>(value, value))
    }

    /// The numbers of segments `index`: in one register up to 8 segments, in two beyond.
    #[inline(always)]
    fn fetch(&self, index: __m512i, numbers: &[__m512d; 2]) -> __m512d {
        let avx = self.simd.avx512f;
        if HALVINGS <= 3 {
            avx._mm512_permutexvar_pd(index, numbers[0])
        } else {
            avx._mm512_permutex2var_pd(numbers[0], index, numbers[1])
        }
    }

    /// The numbers of knots `index`: one more than segments.
    #[inline(always)]
    fn fetch_knot(&self, index: __m512i, numbers: &[__m512d; 2]) -> __m512d {
        let avx = self.simd.avx512f;
        if HALVINGS <= 2 {
            avx._mm512_permutexvar_pd(index, numbers[0])
        } else {
            avx._mm512_permutex2var_pd(numbers[0], index, numbers[1])
        }
    }
}
