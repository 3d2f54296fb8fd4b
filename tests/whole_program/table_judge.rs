//! Random numbers and tables as the judges of the laws have them.

#[allow(dead_code, unreachable_pub, reason = "other tests use the rest")]
#[path = "../../crates/inpact-evaluation/tests/table_judge/random.rs"]
mod random;

pub(crate) use random::Random;

/// Rows of a table.
pub(crate) type Rows = Vec<Vec<f64>>;
