//! Which segment of a group a coordinate lies in, with one comparison.
//!
//! A coordinate's *key* is a whole number that never falls as the coordinate rises, however it is rounded. Buckets are so narrow that no two knots of a group share a key;
//! so a coordinate's key tells its segment but for one knot, and one comparison decides that.
//! Two keys are tried, one linear in the coordinate and one by the bits of its exponent and significand, which follows knots spread over decades; where neither separates the knots
//! in a table of reasonable size, the search is by bisection.

use super::number::Number;

/// A group of knots that can be searched.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group<T> {
    /// Index of the first knot in its level.
    pub(super) first: usize,
    /// Index of the last knot in its level.
    pub(super) last: usize,
    pub(super) least: T,
    pub(super) greatest: T,
    key: Key<T>,
    /// Where the group's buckets begin.
    buckets: usize,
    last_bucket: usize,
}

#[derive(Clone, Copy, Debug)]
enum Key<T> {
    /// (x − least) × scale.
    Linear(T),
    /// (rank of x − rank of least) >> shift.
    Rank { base: u64, shift: u32 },
    /// No key separates the knots.
    Bisect,
}

/// Buckets of one group: 64 a knot, but not more than this.
const MOST_BUCKETS: usize = 1 << 14;

impl<T: Number> Group<T> {
    /// The group of the knots `first..=last` of `knots`, which rise; its buckets are added to `buckets`.
    pub(super) fn new(knots: &[T], first: usize, last: usize, buckets: &mut Vec<u32>) -> Self {
        let group = &knots[first..=last];
        let (least, greatest) = (knots[first], knots[last]);
        let mut made = Self { first, last, least, greatest, key: Key::Bisect, buckets: buckets.len(), last_bucket: 0 };
        let mut count = group.len().next_power_of_two();
        while count <= (64 * group.len()).min(MOST_BUCKETS) {
            let scale = T::nearest((count as f64) / (greatest.exact() - least.exact()));
            let linear = if scale.exact().is_finite() { Key::Linear(scale) } else { Key::Linear(T::ZERO) };
            let base = least.rank();
            let steps = (greatest.rank() - base) / count as u64;
            let by_rank = Key::Rank { base, shift: u64::BITS - steps.leading_zeros() };
            for key in [linear, by_rank] {
                made.key = key;
                made.last_bucket = usize::MAX;
                if group.windows(2).all(|pair| made.key_of(pair[0]) < made.key_of(pair[1])) {
                    made.last_bucket = made.key_of(greatest);
                    let mut knot = 0;
                    for bucket in 0..=made.last_bucket {
                        while made.key_of(group[knot]) < bucket {
                            knot += 1;
                        }
                        buckets.push(u32::try_from(first + knot).unwrap_or(u32::MAX));
                    }
                    return made;
                }
            }
            count *= 2;
        }
        made.key = Key::Bisect;
        made
    }

    #[inline(always)]
    fn key_of(&self, x: T) -> usize {
        let key = match self.key {
            Key::Linear(scale) => ((x - self.least) * scale).whole(),
            #[expect(
                clippy::cast_possible_truncation,
                reason = "a rank within the group, shifted, is at most the number of buckets"
            )]
            Key::Rank { base, shift } => (x.rank().saturating_sub(base) >> shift) as usize,
            Key::Bisect => 0,
        };
        key.min(self.last_bucket)
    }

    /// The last knot of the group not above `x`, which must lie between `least` and `greatest`; some knot of the group for NaN.
    #[inline(always)]
    pub(super) fn find(&self, knots: impl Fn(usize) -> T, buckets: &[u32], x: T) -> usize {
        if let Key::Bisect = self.key {
            return self.bisect(knots, x);
        }
        let knot = buckets[self.buckets + self.key_of(x)] as usize;
        knot - usize::from(knots(knot) > x)
    }

    #[inline(always)]
    fn bisect(&self, knots: impl Fn(usize) -> T, x: T) -> usize {
        let (mut low, mut count) = (self.first, self.last + 1 - self.first);
        while count > 1 {
            let half = count / 2;
            low = std::hint::select_unpredictable(knots(low + half) <= x, low + half, low);
            count -= half;
        }
        low
    }
}
