//! Floating-point building blocks of the laws: interpolation, products, means and sums that keep their accuracy at the extremes.
//!
//! Everything here is a function of plain `f64`, independent of tables, laws and files.
//! Four guarantees hold for all finite inputs, subnormal numbers and values near the overflow limit included:
//!
//! - interpolation between two values of one sign is within 1.5 ulp of the exact value, exact at both ends and never outside them ([`interpolate`], [`between`]);
//! - a product or a dissipation whose exact value is finite is finite, even where intermediate results would overflow or underflow ([`product`]);
//! - a sum keeps the digits lost to rounding ([`CompensatedSum`]), and partial sums over a history or an interface may exceed the range ([`UnboundedSum`]);
//! - a value that is rounded for output is used further unrounded where it could exceed the range of f64 ([`Amount`]).
//!
//! Ordinary exponents take a fast path of plain arithmetic; all others go through [`Scaled`], a number of 106 bits whose exponent cannot overflow.

mod amount;
mod double_double;
mod float;
mod product;
mod scaled;
mod segment;
mod sum;

pub use amount::Amount;
pub use double_double::DoubleDouble;
pub(crate) use float::{LEAST_ORDINARY, ORDINARY_LIMIT, is_moderate, is_ordinary, is_zero_or_ordinary};
pub use float::{exponent_of, scale_by_power, two_difference, two_product, two_sum, ulp};
pub use product::{mean, product, ratio, scaled_difference_product};
pub use scaled::Scaled;
pub use segment::{KernelSlope, between, interpolate, slope};
pub(crate) use sum::compensated_sum;
pub use sum::{CompensatedSum, UnboundedSum};
