//! Sets of node or element numbers as ranges: a set of a million consecutive numbers is one range.

/// Numbers, added in any order and looked up once complete.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Labels {
    /// First and last of each range; ascending and apart once sorted.
    ranges: Vec<(u32, u32)>,
    /// First, last and step of strided ranges: a row of GENERATE can mean billions.
    stepped: Vec<(u32, u32, u32)>,
    sorted: bool,
}

impl Labels {
    pub(super) fn add(&mut self, label: u32) {
        self.sorted = false;
        if let Some((_, last)) = self.ranges.last_mut()
            && last.checked_add(1) == Some(label)
        {
            *last = label;
            return;
        }
        self.ranges.push((label, label));
    }

    /// first, first + step, … up to last.
    pub(super) fn add_steps(&mut self, first: u32, last: u32, step: u32) {
        if last < first {
            return;
        }
        if step <= 1 {
            self.sorted = false;
            self.ranges.push((first, last));
        } else {
            self.stepped.push((first, last, step));
        }
    }

    pub(super) fn add_all(&mut self, other: &Self) {
        self.sorted = false;
        self.ranges.extend_from_slice(&other.ranges);
        self.stepped.extend_from_slice(&other.stepped);
    }

    pub(super) fn is_empty(&self) -> bool {
        self.ranges.is_empty() && self.stepped.is_empty()
    }

    /// The number, if there is only one.
    pub(super) fn single(&self) -> Option<u32> {
        match self.ranges[..] {
            [(first, last)] if first == last && self.stepped.is_empty() => Some(first),
            _ => None,
        }
    }

    pub(super) fn sort(&mut self) {
        if self.sorted {
            return;
        }
        self.ranges.sort_unstable();
        let mut merged: Vec<(u32, u32)> = Vec::new();
        for (first, last) in self.ranges.drain(..) {
            match merged.last_mut() {
                Some((_, end)) if first <= end.saturating_add(1) => *end = last.max(*end),
                _ => merged.push((first, last)),
            }
        }
        merged.shrink_to_fit();
        self.ranges = merged;
        self.stepped.sort_unstable();
        self.stepped.dedup();
        self.sorted = true;
    }

    /// Whether it has the number; sorted before.
    pub(super) fn contains(&self, label: u32) -> bool {
        debug_assert!(self.sorted || self.ranges.is_empty());
        let after = self.ranges.partition_point(|(first, _)| *first <= label);
        let stepped = |(first, last, step): &(u32, u32, u32)| {
            (*first..=*last).contains(&label) && (label - first).is_multiple_of(*step)
        };
        (0 < after && label <= self.ranges[after - 1].1) || self.stepped.iter().any(stepped)
    }
}

#[cfg(test)]
mod tests {
    use super::Labels;

    #[test]
    fn numbers_in_any_order_are_ranges_in_order() {
        let mut labels = Labels::default();
        for label in [7, 8, 9, 3, 20] {
            labels.add(label);
        }
        labels.add_steps(1, 2, 1);
        labels.add_steps(12, 20, 4);
        labels.add(u32::MAX);
        labels.sort();
        assert_eq!(labels.ranges, [(1, 3), (7, 9), (20, 20), (u32::MAX, u32::MAX)]);
        let inside: Vec<u32> = (0..30).filter(|label| labels.contains(*label)).collect();
        assert_eq!(inside, [1, 2, 3, 7, 8, 9, 12, 16, 20]);
        assert!(labels.contains(u32::MAX));
        assert!(!Labels::default().contains(0));
        // Two billion numbers are one entry; backwards there are none.
        let mut odd = Labels::default();
        odd.add_steps(1, u32::MAX, 2);
        odd.add_steps(9, 3, 1);
        odd.sort();
        assert_eq!(
            [0, 1, 2, 4_000_000_001, u32::MAX].map(|label| odd.contains(label)),
            [false, true, false, true, true]
        );
    }
}
