//! Bucket search: which piece of its group an abscissa lies in, without a loop and without a branch that could be mispredicted.
//!
//! The range of a group is divided into buckets, numbered by a key that increases with x: x itself, scaled, or for abscissae over many decades the order-preserving bits of the f64.
//! A bucket stores the piece at its left end; as it holds few breaks (one, if there is room), as many comparisons give the rest.
//! The keys of the breaks are computed by the same expression as those of the queries, so that its rounding cannot matter: it is monotone.

use super::lanes::Lanes;
use super::pieces::{Bucket, ordered};

/// The method by which a kernel finds the segments of rows in a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Search {
    /// No search: the table is constant.
    Constant,
    /// The table is in vector registers and searched there.
    Registers,
    /// Buckets of equal width.
    LinearBuckets,
    /// Buckets of equal count of f64 numbers, for abscissae over many decades.
    BitBuckets,
    /// Binary search, where there would be too many buckets.
    Bisection,
}

/// The search over all groups of one axis. Pieces are numbered across all groups.
#[derive(Clone, Debug)]
pub(super) struct GroupSearch {
    kind: Search,
    /// The maximum number of breaks in a bucket.
    steps: usize,
    groups: Vec<Group>,
    buckets: Vec<Bucket>,
    /// For each piece where it ends, NaN for the last of a group.
    ends: Vec<f64>,
}

/// One group: the starts of its pieces and buckets, and the parameters of its keys.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group {
    /// The least abscissa, and the order of its bits.
    least: f64,
    order: i64,
    /// Buckets per unit of x.
    scale: f64,
    /// The right shift from ordered bits to a bucket.
    shift: u32,
    first_bucket: u32,
    last_key: u32,
    first_piece: u32,
    piece_count: u32,
}

/// A group to be searched: the range of its queries and the rising breaks between its pieces.
pub(super) struct Breaks {
    pub(super) least: f64,
    pub(super) greatest: f64,
    pub(super) at: Vec<f64>,
}

/// 2⁵²: a number below 2³² added to it has its nearest integer in the low bits.
const INTEGER_BITS: f64 = 4_503_599_627_370_496.0;

/// The maximum number of buckets, beyond which they are not worth their memory.
const MAX_BUCKETS: usize = 1 << 22;

impl GroupSearch {
    pub(super) fn new(groups: &[Breaks]) -> Self {
        for steps in [1, 2, 4] {
            for kind in [Search::LinearBuckets, Search::BitBuckets] {
                if let Some(search) = Self::with_buckets(groups, kind, steps) {
                    return search;
                }
            }
        }
        let mut search = Self::empty(Search::Bisection, 0);
        for breaks in groups {
            let mut group = Group::new(breaks);
            search.push_pieces(&mut group, &breaks.at);
        }
        search
    }

    pub(super) fn kind(&self) -> Search {
        self.kind
    }

    pub(super) fn steps(&self) -> usize {
        self.steps
    }

    /// Finds the piece that holds each `x`, which is within the range of its group or NaN.
    ///
    /// `group_of` gives the group of a row. The vectorisable part is a separate loop, before the loads that depend on it.
    #[inline(always)]
    pub(super) fn find<const KIND: u8, const STEPS: usize, L: Lanes>(
        &self,
        lanes: L,
        x: &[f64],
        group_of: impl Fn(usize) -> Group,
        pieces: &mut [u32],
    ) {
        if KIND == BISECTION {
            for (row, (&x, piece)) in x.iter().zip(pieces).enumerate() {
                *piece = self.by_halves(&group_of(row), x);
            }
            return;
        }
        for (row, (&x, bucket)) in x.iter().zip(&mut *pieces).enumerate() {
            let group = group_of(row);
            *bucket = group.first_bucket + group.key::<KIND>(x);
        }
        self.pieces_of_buckets::<STEPS, L>(lanes, x, pieces);
    }

    /// [`Self::find`] where there is one group, with the clamping of `x` in the same loop as the keys.
    /// The binary search advances all rows step by step, so that they are independent.
    #[inline(always)]
    pub(super) fn find_in_one<const KIND: u8, const STEPS: usize, L: Lanes>(
        &self,
        lanes: L,
        x: &[f64],
        clamp: impl Fn(f64) -> f64,
        clamped: &mut [f64],
        pieces: &mut [u32],
    ) {
        let group = self.groups[0];
        for ((&x, clamped), bucket) in x.iter().zip(&mut *clamped).zip(&mut *pieces) {
            *clamped = clamp(x);
            *bucket = if KIND == BISECTION { 0 } else { group.key::<KIND>(*clamped) };
        }
        if KIND != BISECTION {
            return self.pieces_of_buckets::<STEPS, L>(lanes, clamped, pieces);
        }
        let mut count = group.piece_count;
        while count > 1 {
            let half = count / 2;
            let ends = &self.ends[half as usize - 1..];
            for (&x, piece) in clamped.iter().zip(&mut *pieces) {
                *piece = std::hint::select_unpredictable(x >= ends[*piece as usize], *piece + half, *piece);
            }
            count -= half;
        }
    }

    /// Replaces each row's bucket by the piece that contains its `x`.
    #[inline(always)]
    fn pieces_of_buckets<const STEPS: usize, L: Lanes>(&self, lanes: L, x: &[f64], pieces: &mut [u32]) {
        lanes.pieces_of_buckets(&self.buckets, x, pieces);
        let ends = &self.ends[..];
        if STEPS > 1 {
            for (&x, piece) in x.iter().zip(pieces) {
                for _ in 1..STEPS {
                    *piece += u32::from(x >= ends[*piece as usize]);
                }
            }
        }
    }

    #[inline(always)]
    fn by_halves(&self, group: &Group, x: f64) -> u32 {
        let mut piece = group.first_piece;
        let mut count = group.piece_count;
        while count > 1 {
            let half = count / 2;
            let right = x >= self.ends[(piece + half - 1) as usize];
            piece = std::hint::select_unpredictable(right, piece + half, piece);
            count -= half;
        }
        piece
    }

    #[inline(always)]
    pub(super) fn group(&self, group: usize) -> Group {
        self.groups[group]
    }

    fn with_buckets(groups: &[Breaks], kind: Search, steps: usize) -> Option<Self> {
        let mut search = Self::empty(kind, steps);
        for breaks in groups {
            let mut group = Group::new(breaks);
            group.choose_buckets(breaks, kind, steps)?;
            if search.buckets.len() + group.last_key as usize >= MAX_BUCKETS {
                return None;
            }
            group.first_bucket = u32::try_from(search.buckets.len()).ok()?;
            search.push_pieces(&mut group, &breaks.at);
            let mut passed = 0;
            for key in 0..=group.last_key {
                while breaks.at.get(passed as usize).is_some_and(|&x| group.key_of(kind, x) < key) {
                    passed += 1;
                }
                let piece = group.first_piece + passed;
                search.buckets.push(Bucket::new(search.ends[piece as usize], piece));
            }
        }
        Some(search)
    }

    fn empty(kind: Search, steps: usize) -> Self {
        Self { kind, steps, groups: Vec::new(), buckets: Vec::new(), ends: Vec::new() }
    }

    fn push_pieces(&mut self, group: &mut Group, breaks: &[f64]) {
        let count = |count: usize| u32::try_from(count).expect("a table has fewer than 2^31 rows");
        group.first_piece = count(self.ends.len());
        group.piece_count = count(breaks.len() + 1);
        self.ends.extend_from_slice(breaks);
        self.ends.push(f64::NAN);
        self.groups.push(*group);
    }
}

/// [`Search`] as a constant, so that the search is compiled once for each kind.
pub(super) const LINEAR: u8 = 0;
pub(super) const BITS: u8 = 1;
pub(super) const BISECTION: u8 = 2;

impl Group {
    fn new(breaks: &Breaks) -> Self {
        Self {
            least: breaks.least,
            order: ordered(breaks.least + 0.0),
            scale: 0.0,
            shift: 63,
            first_bucket: 0,
            last_key: 0,
            first_piece: 0,
            piece_count: 0,
        }
    }

    /// The bucket of `x`, counted from the group's first one. Rises with x.
    #[inline(always)]
    fn key<const KIND: u8>(&self, x: f64) -> u32 {
        let key = if KIND == LINEAR {
            ((x - self.least) * self.scale + INTEGER_BITS).to_bits()
        } else {
            // Adding 0 turns −0 into 0.
            ordered(x + 0.0).wrapping_sub(self.order).cast_unsigned() >> self.shift
        };
        #[expect(clippy::cast_possible_truncation, reason = "the low bits are the number")]
        let key = key as u32;
        key.min(self.last_key)
    }

    fn key_of(&self, kind: Search, x: f64) -> u32 {
        if kind == Search::LinearBuckets { self.key::<LINEAR>(x) } else { self.key::<BITS>(x) }
    }

    /// The smallest number of buckets with at most `steps` breaks each; `None` where there would be too many.
    fn choose_buckets(&mut self, breaks: &Breaks, kind: Search, steps: usize) -> Option<()> {
        let Breaks { least, greatest, at: breaks } = breaks;
        let most = 64 + 16 * breaks.len();
        let mut count = (breaks.len() / steps + 1).next_power_of_two();
        if breaks.is_empty() {
            return Some(());
        }
        while count <= most {
            self.last_key = u32::try_from(count - 1).ok()?;
            let fits = match kind {
                Search::LinearBuckets => {
                    self.scale = f64::from(self.last_key) / (greatest - least);
                    self.scale.is_finite() && self.scale > 0.0
                }
                _ => {
                    let span = ordered(greatest + 0.0).wrapping_sub(self.order).cast_unsigned();
                    self.shift = (64 - span.leading_zeros()).saturating_sub(count.trailing_zeros());
                    self.shift < 64
                }
            };
            if fits && breaks.windows(steps + 1).all(|some| self.key_of(kind, some[0]) < self.key_of(kind, some[steps]))
            {
                return Some(());
            }
            count *= 2;
        }
        None
    }
}
