//! Which segment of a group a coordinate lies in, with one comparison.
//!
//! A coordinate's *key* is a whole number that never falls as the coordinate rises, however it is rounded. Buckets are so narrow that no two knots of a group share a key;
//! so a coordinate's key tells its segment but for one knot, and one comparison decides that.
//! Two keys are tried, one linear in the coordinate and one by the bits of its exponent and significand, which follows knots spread over decades; where neither separates the knots
//! in a table of reasonable size, the search is by bisection.

use super::number::Number;

/// What a coordinate's key is computed from; one for all groups of an axis, so that a search knows its way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Key {
    /// (x − least) × scale.
    Linear,
    /// (rank of x − rank of least) >> shift.
    Rank,
    /// No key separates the knots.
    Bisect,
}

/// A group of knots that can be searched.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group<T> {
    /// Index of the first knot in its level.
    pub(super) first: usize,
    /// Index of the last knot in its level.
    pub(super) last: usize,
    pub(super) least: T,
    pub(super) greatest: T,
    scale: T,
    base: u64,
    shift: u32,
    last_bucket: u32,
    /// Where the group's buckets begin.
    buckets: usize,
}

/// Buckets of one group: 64 a knot, but not more than this.
const MOST_BUCKETS: usize = 1 << 14;

/// The groups of an axis, whose knots are `knots[first..=last]` for each of `ranges`, with the key and the buckets they are searched by.
pub(super) fn index<T: Number>(knots: &[T], ranges: &[(usize, usize)]) -> (Key, Vec<Group<T>>, Vec<u32>) {
    for key in [Key::Linear, Key::Rank] {
        let mut buckets = Vec::new();
        let groups: Option<Vec<Group<T>>> =
            ranges.iter().map(|&range| Group::with_key(knots, range, key, &mut buckets)).collect();
        if let Some(groups) = groups {
            return (key, groups, buckets);
        }
    }
    (Key::Bisect, ranges.iter().map(|&range| Group::plain(knots, range)).collect(), Vec::new())
}

impl<T: Number> Group<T> {
    /// A group without buckets.
    fn plain(knots: &[T], (first, last): (usize, usize)) -> Self {
        let (least, greatest) = (knots[first], knots[last]);
        Self {
            first,
            last,
            least,
            greatest,
            scale: T::ZERO,
            base: least.rank(),
            shift: 0,
            last_bucket: u32::MAX,
            buckets: 0,
        }
    }

    /// A group with buckets that hold one knot at most, which are added to `buckets`; none if that takes too many.
    fn with_key(knots: &[T], range: (usize, usize), key: Key, buckets: &mut Vec<u32>) -> Option<Self> {
        let mut made = Self::plain(knots, range);
        let group = &knots[range.0..=range.1];
        made.buckets = buckets.len();
        let mut count = group.len().next_power_of_two();
        while count <= (64 * group.len()).min(MOST_BUCKETS) {
            let width = made.greatest.exact() - made.least.exact();
            made.scale = if width > 0.0 { T::nearest(count as f64 / width) } else { T::ZERO };
            let step = (made.greatest.rank() - made.base) / count as u64;
            made.shift = u64::BITS - step.leading_zeros();
            made.last_bucket = u32::MAX;
            let is_usable = made.scale.exact().is_finite() && made.shift < u64::BITS;
            if is_usable && group.windows(2).all(|pair| made.bucket_of(key, pair[0]) < made.bucket_of(key, pair[1])) {
                let last = made.bucket_of(key, made.greatest);
                made.last_bucket = u32::try_from(last).ok()?;
                let mut knot = 0;
                for bucket in 0..=last {
                    while made.bucket_of(key, group[knot]) < bucket {
                        knot += 1;
                    }
                    buckets.push(u32::try_from(range.0 + knot).ok()?);
                }
                return Some(made);
            }
            count *= 2;
        }
        None
    }

    #[inline(always)]
    fn bucket_of(&self, key: Key, x: T) -> usize {
        let bucket = match key {
            Key::Linear => ((x - self.least) * self.scale).whole(),
            #[expect(
                clippy::cast_possible_truncation,
                reason = "a rank within the group, shifted, is a number of a bucket"
            )]
            Key::Rank => (x.rank().saturating_sub(self.base) >> self.shift) as usize,
            Key::Bisect => 0,
        };
        bucket.min(self.last_bucket as usize)
    }

    /// The last knot of the group not above `x`, which must lie between `least` and `greatest`; some knot of the group for NaN.
    #[inline(always)]
    pub(super) fn find(&self, key: Key, knots: impl Fn(usize) -> T, buckets: &[u32], x: T) -> usize {
        if key == Key::Bisect {
            return self.bisect(knots, x);
        }
        let knot = buckets[self.buckets + self.bucket_of(key, x)] as usize;
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
