//! The instruction set of a kernel, detected at run time.

use std::fmt;

use super::lanes::{Lanes, Plain};

#[cfg(target_arch = "x86_64")]
use pulp::x86::{V3, V4};

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
