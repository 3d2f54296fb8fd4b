//! Colours of curves: an ordered, colour-blind-safe ramp that is also distinguishable by lightness alone.

/// From dark blue over purple to orange.
const RAMP: [(f64, f64, f64); 7] = [
    (13.0, 8.0, 135.0),
    (70.0, 3.0, 159.0),
    (114.0, 1.0, 168.0),
    (156.0, 23.0, 158.0),
    (189.0, 55.0, 134.0),
    (216.0, 87.0, 107.0),
    (237.0, 121.0, 83.0),
];

/// The colour of curve `index` of `count`, as `#rrggbb`.
pub(crate) fn of_curve(index: usize, count: usize) -> String {
    if count < 2 {
        return "#0b4f8a".to_owned();
    }
    of_part(index as f64 / (count - 1) as f64)
}

/// The colour at a fraction of the ramp.
pub(crate) fn of_part(part: f64) -> String {
    let place = part.clamp(0.0, 1.0) * (RAMP.len() - 1) as f64;
    let index = super::whole(place.floor()).min(RAMP.len() - 2);
    let (from, to, share) = (RAMP[index], RAMP[index + 1], place - index as f64);
    let mix = |from: f64, to: f64| super::whole(from + share * (to - from));
    format!("#{:02x}{:02x}{:02x}", mix(from.0, to.0), mix(from.1, to.1), mix(from.2, to.2))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Perceived brightness, of 255.
    fn luma(colour: &str) -> f64 {
        let part = |from: usize| f64::from(u8::from_str_radix(&colour[from..from + 2], 16).unwrap());
        0.299 * part(1) + 0.587 * part(3) + 0.114 * part(5)
    }

    #[test]
    fn the_ramp_grows_lighter_all_along() {
        let lumas: Vec<f64> = (0..24).map(|index| luma(&of_curve(index, 24))).collect();
        assert!(lumas.windows(2).all(|pair| pair[0] < pair[1]), "{lumas:?}");
        assert!(lumas.last().is_some_and(|last| *last < 170.0), "too light for white paper: {lumas:?}");
    }
}
