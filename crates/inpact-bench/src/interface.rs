//! One generated contact interface: the abscissae and values of its tables.
//!
//! The deck writer prints it and the node writer samples rows around it, so that a node table reaches every part of a
//! law: between knots, exactly at them, beyond the last one.
//! Tables follow the spec: first variable fastest and ascending (semantics T-01, T-02; Analysis User's Guide 1.2.1),
//! a clearance and a pressure table start at zero in every group (T-24; 37.3.1), conductance falls with clearance to
//! zero at the last point and rises with pressure.
//! Units are SI: metres, pascals, kelvins, siemens per square metre.

use crate::random::Random;

/// The temperature of the first group of every table, K.
pub const FIRST_TEMPERATURE: f64 = 300.0;
/// The distance between the groups of a table, K.
pub const TEMPERATURE_STEP: f64 = 100.0;
/// No table has more groups than this, so that temperatures stay below the melting point of steel.
const MAX_GROUPS: usize = 10;

/// A contact interface whose two conductance tables share their temperatures.
///
/// Knots are integers in nanometres and kilopascals, scaled with one rounding, so that the text of
/// a deck and the text of a node table read as the same f64.
#[derive(Debug, Clone)]
pub struct Interface {
    /// The name of its *SURFACE INTERACTION.
    pub name: String,
    /// Clearances of the open branch, m: 0 first, strictly ascending.
    pub clearances: Vec<f64>,
    /// Contact pressures of the closed branch, Pa: 0 first, strictly ascending.
    pub pressures: Vec<f64>,
    /// Temperatures of the groups of both tables, K.
    pub temperatures: Vec<f64>,
    /// Conductances of the open branch, S/m², a row of the table each: all clearances of the first temperature, then
    /// those of the next.
    pub open: Vec<f64>,
    /// Conductances of the closed branch, S/m², in the same order.
    pub closed: Vec<f64>,
    /// Contact permeabilities, m/(Pa·s), one for each pressure.
    pub permeabilities: Vec<f64>,
    /// Clearance above which no fluid flows across, m.
    pub cutoff_flow_across: f64,
    /// Clearance above which a change of the gap draws no fluid, m.
    pub cutoff_gap_fill: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Fraction of the heat that goes to the slave surface.
    pub slave_weight: f64,
}

impl Interface {
    /// The interface of the given number, counted from 0, whose two conductance tables have `rows` rows each.
    ///
    /// A table needs two rows at least (semantics T-11, Q-10): fewer are taken as two.
    pub fn new(seed: u64, number: usize, rows: usize) -> Self {
        let mut random = Random::of_item(seed, number as u64);
        let rows = rows.max(2);
        let groups = groups(rows);
        let points = rows / groups;

        let nanometres = knots(&mut random, points, 200, 2_000);
        let clearances: Vec<f64> = nanometres.map(|knot| knot as f64 / 1e9).collect();
        let kilopascals = knots(&mut random, points, 1_000, 20_000);
        let pressures: Vec<f64> = kilopascals.map(|knot| knot as f64 * 1e3).collect();
        let temperatures: Vec<f64> = (0..groups).map(temperature).collect();

        let touching = random.between(1e7, 1e8);
        let mut open = Vec::with_capacity(rows);
        let mut closed = Vec::with_capacity(rows);
        for group in 0..groups {
            // Hot metal is soft: its asperities flatten and more of the surface conducts.
            let scale = touching * (1.0 + 0.2 * group as f64);
            open.extend((0..points).map(|point| match points - 1 - point {
                0 => 0.0,
                left => scale * (left as f64 + 0.5 * random.unit()) / points as f64,
            }));
            closed.extend((0..points).map(|point| scale * (1.0 + point as f64 + 0.5 * random.unit())));
        }
        let permeable = random.between(1e-9, 1e-8);
        let permeabilities = (0..points).map(|point| permeable / (1.0 + point as f64 + 0.5 * random.unit())).collect();
        let widest = *clearances.last().unwrap_or(&0.0);
        Self {
            name: format!("IntProp-{}", number + 1),
            clearances,
            pressures,
            temperatures,
            open,
            closed,
            permeabilities,
            cutoff_flow_across: 2.0 * widest,
            cutoff_gap_fill: 5.0 * widest,
            friction: random.whole(10, 40) as f64 / 100.0,
            slave_weight: random.whole(30, 70) as f64 / 100.0,
        }
    }
}

/// The temperature of a group, K.
fn temperature(group: usize) -> f64 {
    FIRST_TEMPERATURE + TEMPERATURE_STEP * group as f64
}

/// The number of equal groups of ten or more points in `rows` rows: the most that leave no remainder.
///
/// Equal groups keep the tables regular, so that a check of the deck has nothing to note (rule T015).
fn groups(rows: usize) -> usize {
    (1..=(rows / 10).clamp(1, MAX_GROUPS)).rev().find(|groups| rows.is_multiple_of(*groups)).unwrap_or(1)
}

/// `count` whole numbers, ascending from 0 by steps between `low` and `high`.
fn knots(random: &mut Random, count: usize, low: u64, high: u64) -> impl Iterator<Item = u64> {
    let mut sum = 0;
    (0..count).map(move |point| {
        if point > 0 {
            sum += random.whole(low, high);
        }
        sum
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ascending(values: &[f64]) -> bool {
        values.windows(2).all(|pair| pair[0] < pair[1])
    }

    #[test]
    fn tables_are_regular_and_start_at_zero() {
        for (rows, expected) in [(2, 1), (9, 1), (20, 2), (25, 1), (30, 3), (100, 10), (1000, 10)] {
            let interface = Interface::new(1, 4, rows);
            assert_eq!(interface.temperatures.len(), expected, "{rows} rows");
            assert_eq!(interface.open.len(), rows);
            assert_eq!(interface.closed.len(), rows);
            assert_eq!(interface.clearances.len() * expected, rows);
            for abscissae in [&interface.clearances, &interface.pressures, &interface.temperatures] {
                assert!(ascending(abscissae), "{abscissae:?}");
            }
            assert_eq!(interface.clearances[0], 0.0);
            assert_eq!(interface.pressures[0], 0.0);
        }
    }

    #[test]
    fn conductance_falls_with_clearance_to_zero_and_rises_with_pressure() {
        for number in 0..50 {
            let interface = Interface::new(3, number, 40);
            let points = interface.clearances.len();
            for (open, closed) in interface.open.chunks(points).zip(interface.closed.chunks(points)) {
                assert!(open.windows(2).all(|pair| pair[0] > pair[1]), "{open:?}");
                assert_eq!(open[points - 1], 0.0);
                assert!(ascending(closed), "{closed:?}");
                // Rule P007 notes a jump over ten times where the surfaces touch.
                let jump = closed[0] / open[0];
                assert!((0.1..10.0).contains(&jump), "{jump}");
            }
        }
    }

    #[test]
    fn knots_survive_being_printed() {
        let interface = Interface::new(9, 0, 100);
        for knot in interface.clearances.iter().chain(&interface.pressures) {
            let in_deck: f64 = format!("{knot:.12e}").parse().expect("a number");
            let in_node_table: f64 = format!("{knot}").parse().expect("a number");
            assert_eq!(in_deck.to_bits(), knot.to_bits());
            assert_eq!(in_node_table.to_bits(), knot.to_bits());
        }
    }
}
