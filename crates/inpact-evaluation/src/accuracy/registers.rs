//! Tables of one axis whose knots, values and slopes fit into two AVX-512 registers each: searched by permutation, 16 knots in f64 and 32 in f32.
//!
//! The same operations as in [`super::flat`], hence the same bits.

#[cfg(target_arch = "x86_64")]
use kernels::{Columns, Double, Single, SingleOfDouble, rounded_down};
#[cfg(target_arch = "x86_64")]
use pulp::x86::V4;

use super::flat::Flat;
use super::number::Number;

/// A table of one axis with at most `N` knots, filled up with knots that nothing reaches.
#[derive(Clone, Debug)]
#[cfg_attr(not(target_arch = "x86_64"), expect(dead_code, reason = "only x86-64 has these registers"))]
pub(super) struct Registers<T, const N: usize> {
    knots: [T; N],
    values: [T; N],
    slopes: [T; N],
    least: T,
    greatest: T,
    zero_beyond: f64,
    /// The first power of two to try in the search.
    widest_step: usize,
}

impl<T: Number, const N: usize> Registers<T, N> {
    /// The table of one axis in registers, if it fits.
    pub(super) fn new(flat: &Flat<T>) -> Option<Self> {
        let [level] = &flat.levels[..] else { return None };
        let last = *level.knots.last()?;
        if level.knots.len() > N {
            return None;
        }
        let fill = |of: fn(super::flat::Knot<T>) -> T, beyond: T| {
            let mut filled = [beyond; N];
            for (place, &knot) in filled.iter_mut().zip(&level.knots) {
                *place = of(knot);
            }
            filled
        };
        Some(Self {
            knots: fill(|knot| knot.at, T::nearest(f64::INFINITY)),
            values: fill(|knot| knot.value, last.value),
            slopes: fill(|knot| knot.rate, T::ZERO),
            least: level.knots[0].at,
            greatest: last.at,
            zero_beyond: flat.zero_beyond[0],
            widest_step: level.knots.len().next_power_of_two() / 2,
        })
    }
}

#[cfg(target_arch = "x86_64")]
impl Registers<f64, 16> {
    /// The values at `xs`, or false where the processor lacks AVX-512.
    pub(super) fn values(&self, xs: &[f64], values: &mut [f64]) -> bool {
        let Some(simd) = V4::try_new() else { return false };
        simd.vectorize(Columns { lanes: Double { simd, table: self }, xs, values });
        true
    }
}

#[cfg(target_arch = "x86_64")]
impl Registers<f32, 32> {
    /// The values at f32 coordinates, or false where the processor lacks AVX-512.
    pub(super) fn values_single(&self, xs: &[f32], values: &mut [f32]) -> bool {
        let Some(simd) = V4::try_new() else { return false };
        let zero_beyond = rounded_down(self.zero_beyond);
        simd.vectorize(Columns { lanes: Single { simd, table: self, zero_beyond }, xs, values });
        true
    }

    /// The values at f64 coordinates, each rounded to f32 on the way in; or false where the processor lacks AVX-512.
    pub(super) fn values(&self, xs: &[f64], values: &mut [f64]) -> bool {
        let Some(simd) = V4::try_new() else { return false };
        simd.vectorize(Columns { lanes: SingleOfDouble { simd, table: self }, xs, values });
        true
    }
}

#[cfg(not(target_arch = "x86_64"))]
impl Registers<f64, 16> {
    pub(super) fn values(&self, _: &[f64], _: &mut [f64]) -> bool {
        false
    }
}

#[cfg(not(target_arch = "x86_64"))]
impl Registers<f32, 32> {
    pub(super) fn values_single(&self, _: &[f32], _: &mut [f32]) -> bool {
        false
    }

    pub(super) fn values(&self, _: &[f64], _: &mut [f64]) -> bool {
        false
    }
}

/// The kernels, for x86-64 alone.
#[cfg(target_arch = "x86_64")]
mod kernels {
    use std::arch::x86_64::{__m256, __m512, __m512d, __m512i, _CMP_GT_OQ};

    use pulp::NullaryFnOnce;
    use pulp::x86::V4;

    use super::Registers;

    /// A function of `N` numbers at once.
    pub(super) trait Lanes<T, const N: usize> {
        fn values(&self, xs: [T; N]) -> [T; N];
    }

    /// Applies a function to whole columns.
    pub(super) struct Columns<'a, L, T> {
        pub(super) lanes: L,
        pub(super) xs: &'a [T],
        pub(super) values: &'a mut [T],
    }

    macro_rules! columns {
        ($lanes:ident, $real:ident, $count:literal) => {
            impl NullaryFnOnce for Columns<'_, $lanes<'_>, $real> {
                type Output = ();

                #[inline(always)]
                fn call(self) {
                    let (chunks, rest) = self.xs.as_chunks::<$count>();
                    let (targets, last) = self.values.as_chunks_mut::<$count>();
                    for (target, &chunk) in targets.iter_mut().zip(chunks) {
                        *target = self.lanes.values(chunk);
                    }
                    let mut padded = [0.0; $count];
                    padded[..rest.len()].copy_from_slice(rest);
                    last.copy_from_slice(&self.lanes.values(padded)[..last.len()]);
                }
            }
        };
    }

    columns!(Double, f64, 8);
    columns!(Single, f32, 16);
    columns!(SingleOfDouble, f64, 16);

    /// Eight values in f64.
    pub(super) struct Double<'a> {
        pub(super) simd: V4,
        pub(super) table: &'a Registers<f64, 16>,
    }

    impl Lanes<f64, 8> for Double<'_> {
        #[inline(always)]
        fn values(&self, xs: [f64; 8]) -> [f64; 8] {
            let Self { simd, table } = *self;
            let f = simd.avx512f;
            let halves: [[__m512d; 2]; 3] =
                [pulp::cast(table.knots), pulp::cast(table.values), pulp::cast(table.slopes)];
            let [knots, heights, slopes] = halves;
            let given: __m512d = pulp::cast(xs);
            let (least, greatest) = (pulp::cast([table.least; 8]), pulp::cast([table.greatest; 8]));
            // Of two operands, one NaN, the second is the result.
            let x = f._mm512_min_pd(greatest, f._mm512_max_pd(least, given));
            let mut index: __m512i = pulp::cast([0_u64; 8]);
            let mut step = table.widest_step as u64;
            while step > 0 {
                let next = f._mm512_add_epi64(index, pulp::cast([step; 8]));
                let knot = f._mm512_permutex2var_pd(knots[0], next, knots[1]);
                let reached = f._mm512_cmple_pd_mask(knot, x);
                index = f._mm512_mask_mov_epi64(index, reached, next);
                step /= 2;
            }
            let near = f._mm512_permutex2var_pd(knots[0], index, knots[1]);
            let slope = f._mm512_permutex2var_pd(slopes[0], index, slopes[1]);
            let height = f._mm512_permutex2var_pd(heights[0], index, heights[1]);
            let value = f._mm512_fmadd_pd(f._mm512_sub_pd(x, near), slope, height);
            let beyond = pulp::cast([table.zero_beyond; 8]);
            let is_beyond = f._mm512_cmp_pd_mask::<_CMP_GT_OQ>(given, beyond);
            pulp::cast(f._mm512_mask_blend_pd(is_beyond, value, pulp::cast([0.0_f64; 8])))
        }
    }

    /// Sixteen values in f32, whatever lies beyond the last knot.
    #[inline(always)]
    fn sixteen(simd: V4, table: &Registers<f32, 32>, given: __m512) -> __m512 {
        let f = simd.avx512f;
        let halves: [[__m512; 2]; 3] = [pulp::cast(table.knots), pulp::cast(table.values), pulp::cast(table.slopes)];
        let [knots, heights, slopes] = halves;
        let (least, greatest) = (pulp::cast([table.least; 16]), pulp::cast([table.greatest; 16]));
        let x = f._mm512_min_ps(greatest, f._mm512_max_ps(least, given));
        let mut index: __m512i = pulp::cast([0_u32; 16]);
        #[expect(clippy::cast_possible_truncation, reason = "16 at most")]
        let mut step = table.widest_step as u32;
        while step > 0 {
            let next = f._mm512_add_epi32(index, pulp::cast([step; 16]));
            let knot = f._mm512_permutex2var_ps(knots[0], next, knots[1]);
            let reached = f._mm512_cmple_ps_mask(knot, x);
            index = f._mm512_mask_mov_epi32(index, reached, next);
            step /= 2;
        }
        let near = f._mm512_permutex2var_ps(knots[0], index, knots[1]);
        let slope = f._mm512_permutex2var_ps(slopes[0], index, slopes[1]);
        let height = f._mm512_permutex2var_ps(heights[0], index, heights[1]);
        f._mm512_fmadd_ps(f._mm512_sub_ps(x, near), slope, height)
    }

    /// Sixteen values in f32 of coordinates in f32.
    pub(super) struct Single<'a> {
        pub(super) simd: V4,
        pub(super) table: &'a Registers<f32, 32>,
        /// The largest f32 that is not beyond the last knot.
        pub(super) zero_beyond: f32,
    }

    impl Lanes<f32, 16> for Single<'_> {
        #[inline(always)]
        fn values(&self, xs: [f32; 16]) -> [f32; 16] {
            let f = self.simd.avx512f;
            let given: __m512 = pulp::cast(xs);
            let value = sixteen(self.simd, self.table, given);
            let is_beyond = f._mm512_cmp_ps_mask::<_CMP_GT_OQ>(given, pulp::cast([self.zero_beyond; 16]));
            pulp::cast(f._mm512_mask_blend_ps(is_beyond, value, pulp::cast([0.0_f32; 16])))
        }
    }

    /// Sixteen values in f32 of coordinates in f64, which are compared with the last knot before they are rounded.
    pub(super) struct SingleOfDouble<'a> {
        pub(super) simd: V4,
        pub(super) table: &'a Registers<f32, 32>,
    }

    impl Lanes<f64, 16> for SingleOfDouble<'_> {
        #[inline(always)]
        fn values(&self, xs: [f64; 16]) -> [f64; 16] {
            let f = self.simd.avx512f;
            let halves: [__m512d; 2] = pulp::cast(xs);
            let singles = [f._mm512_cvtpd_ps(halves[0]), f._mm512_cvtpd_ps(halves[1])];
            let values: [__m256; 2] = pulp::cast(sixteen(self.simd, self.table, pulp::cast(singles)));
            let values = [f._mm512_cvtps_pd(values[0]), f._mm512_cvtps_pd(values[1])];
            let (beyond, zero) = (pulp::cast([self.table.zero_beyond; 8]), pulp::cast([0.0_f64; 8]));
            let are_beyond = [
                f._mm512_cmp_pd_mask::<_CMP_GT_OQ>(halves[0], beyond),
                f._mm512_cmp_pd_mask::<_CMP_GT_OQ>(halves[1], beyond),
            ];
            pulp::cast([
                f._mm512_mask_blend_pd(are_beyond[0], values[0], zero),
                f._mm512_mask_blend_pd(are_beyond[1], values[1], zero),
            ])
        }
    }

    /// The largest f32 not above `value`.
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what is asked for")]
    pub(super) fn rounded_down(value: f64) -> f32 {
        let nearest = value as f32;
        if f64::from(nearest) > value { nearest.next_down() } else { nearest }
    }
}
