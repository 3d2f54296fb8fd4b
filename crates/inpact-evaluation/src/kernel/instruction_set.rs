//! The instruction set of a kernel, detected at run time.

use std::fmt;

use super::pieces::Piece;

#[cfg(target_arch = "x86_64")]
use pulp::bytemuck::cast;
#[cfg(target_arch = "x86_64")]
use pulp::x86::{V3, V4};
#[cfg(target_arch = "x86_64")]
use std::arch::x86_64::{__m256d, _CMP_EQ_OQ};

/// A set of vector instructions. The results of a kernel are the same with each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum InstructionSet {
    /// The instructions that every processor of the architecture has.
    Scalar,
    /// x86-64 with AVX2 and fused multiply-add.
    Avx2,
    /// x86-64 with AVX-512 (F, BW, CD, DQ, VL).
    Avx512,
    /// 64-bit Arm, where NEON is always there.
    Neon,
}

impl InstructionSet {
    /// The sets that this machine supports, the fastest last.
    pub fn available() -> Vec<Self> {
        let mut sets = vec![Self::Scalar];
        #[cfg(target_arch = "x86_64")]
        {
            sets.extend(V3::try_new().map(|_| Self::Avx2));
            sets.extend(V4::try_new().map(|_| Self::Avx512));
        }
        #[cfg(target_arch = "aarch64")]
        sets.push(Self::Neon);
        sets
    }

    /// The fastest set that this machine supports.
    pub fn best() -> Self {
        #[cfg(target_arch = "x86_64")]
        return match (V4::try_new(), V3::try_new()) {
            (Some(_), _) => Self::Avx512,
            (None, Some(_)) => Self::Avx2,
            (None, None) => Self::Scalar,
        };
        #[cfg(not(target_arch = "x86_64"))]
        return if cfg!(target_arch = "aarch64") { Self::Neon } else { Self::Scalar };
    }

    /// Runs `operation`, all of which must be inlined, compiled for this set; with scalar instructions where the machine lacks it.
    #[inline]
    pub(crate) fn run<O: Operation>(self, operation: O) -> O::Output {
        match self {
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => match V4::try_new() {
                Some(simd) => simd.vectorize(Call { operation, lanes: *simd }),
                None => operation.call(Plain),
            },
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => match V3::try_new() {
                Some(simd) => simd.vectorize(Call { operation, lanes: simd }),
                None => operation.call(Plain),
            },
            _ => operation.call(Plain),
        }
    }
}

/// An operation that is compiled for each instruction set.
pub(crate) trait Operation {
    /// Its result.
    type Output;

    /// Runs it; all functions that it calls must be inlined.
    fn call<L: Lanes>(self, lanes: L) -> Self::Output;
}

/// Explicit vector operations of an instruction set, in addition to auto-vectorised loops.
pub(crate) trait Lanes: Copy {
    /// The values at `x` on the pieces of `places`, row by row: [`Piece::value`].
    fn interpolate(self, pieces: &[Piece], x: &[f64], places: &[u32], values: &mut [f64]);
}

/// No explicit vector instructions.
#[derive(Clone, Copy)]
struct Plain;

impl Lanes for Plain {
    #[inline(always)]
    fn interpolate(self, pieces: &[Piece], x: &[f64], places: &[u32], values: &mut [f64]) {
        for ((&x, &place), value) in x.iter().zip(places).zip(values) {
            *value = pieces[place as usize].value(x);
        }
    }
}

/// Four pieces are loaded as vectors and transposed: a gather would take one load per number.
#[cfg(target_arch = "x86_64")]
impl Lanes for V3 {
    #[inline(always)]
    fn interpolate(self, pieces: &[Piece], x: &[f64], places: &[u32], values: &mut [f64]) {
        let rows = values.len();
        let (x, places) = (&x[..rows], &places[..rows]);
        let (fours, rest) = values.as_chunks_mut::<4>();
        let done = 4 * fours.len();
        for ((value, x), place) in fours.iter_mut().zip(x.as_chunks::<4>().0).zip(places.as_chunks::<4>().0) {
            *value = cast(interpolate_four(self, place.map(|place| cast(pieces[place as usize].0)), cast(*x)));
        }
        Plain.interpolate(pieces, &x[done..], &places[done..], rest);
    }
}

/// [`Piece::value`] on four pieces, operation by operation.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
fn interpolate_four(simd: V3, [a, b, c, d]: [__m256d; 4], x: __m256d) -> __m256d {
    let avx = simd.avx;
    let (near_high, base_low) = (avx._mm256_unpacklo_pd(a, b), avx._mm256_unpackhi_pd(a, b));
    let (near_high_2, base_low_2) = (avx._mm256_unpacklo_pd(c, d), avx._mm256_unpackhi_pd(c, d));
    let near = avx._mm256_permute2f128_pd::<0x20>(near_high, near_high_2);
    let base = avx._mm256_permute2f128_pd::<0x20>(base_low, base_low_2);
    let high = avx._mm256_permute2f128_pd::<0x31>(near_high, near_high_2);
    let low = avx._mm256_permute2f128_pd::<0x31>(base_low, base_low_2);
    // `two_difference(x, near)`
    let negated_near = avx._mm256_xor_pd(near, cast([-0.0_f64; 4]));
    let offset = avx._mm256_add_pd(x, negated_near);
    let near_part = avx._mm256_sub_pd(offset, x);
    let x_part = avx._mm256_sub_pd(offset, near_part);
    let x_error = avx._mm256_sub_pd(x, x_part);
    let near_error = avx._mm256_sub_pd(negated_near, near_part);
    let offset_error = avx._mm256_add_pd(x_error, near_error);
    let value = simd.fma._mm256_fmadd_pd(offset, high, base);
    let correction = avx._mm256_add_pd(avx._mm256_mul_pd(offset, low), avx._mm256_mul_pd(offset_error, high));
    let value = avx._mm256_add_pd(value, correction);
    avx._mm256_blendv_pd(value, base, avx._mm256_cmp_pd::<_CMP_EQ_OQ>(x, near))
}

#[cfg(target_arch = "x86_64")]
struct Call<O, L> {
    operation: O,
    lanes: L,
}

#[cfg(target_arch = "x86_64")]
impl<O: Operation, L: Lanes> pulp::NullaryFnOnce for Call<O, L> {
    type Output = O::Output;

    #[inline(always)]
    fn call(self) -> O::Output {
        self.operation.call(self.lanes)
    }
}

impl fmt::Display for InstructionSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Scalar => "scalar",
            Self::Avx2 => "AVX2",
            Self::Avx512 => "AVX-512",
            Self::Neon => "NEON",
        })
    }
}
