//! The Pareto front: points that no other dominates.

/// For each pair of a time and an error, whether it is on the front: no other is as fast and as accurate, and better in one of the two.
pub(super) fn front(places: &[(f64, f64)]) -> Vec<bool> {
    let is_beaten = |(time, error): &(f64, f64)| {
        let beats = |(other_time, other_error): &(f64, f64)| {
            other_time <= time && other_error <= error && (other_time < time || other_error < error)
        };
        places.iter().any(beats)
    };
    places.iter().map(|place| !is_beaten(place)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_slower_and_no_more_exact_is_beaten() {
        assert_eq!(
            front(&[(1.0, 1e-3), (2.0, 1e-9), (3.0, 1e-6), (4.0, 0.0), (5.0, 0.0)]),
            [true, true, false, true, false]
        );
    }

    #[test]
    fn equals_do_not_beat_each_other() {
        assert_eq!(front(&[(1.0, 0.5), (1.0, 0.5), (1.0, 0.6), (2.0, 0.5)]), [true, true, false, false]);
    }

    #[test]
    fn one_or_none_is_not_beaten() {
        assert_eq!(front(&[(1.0, f64::INFINITY)]), [true]);
        assert!(front(&[]).is_empty());
    }
}
