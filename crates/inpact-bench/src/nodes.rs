//! Generated node tables for the interfaces of a generated deck.
//!
//! The rows reach every part of a law: open and closed, between knots, exactly at them, beyond the
//! last one.
//! A table with fewer nodes than rows is a history: increment by increment, all nodes in each, as
//! an output database is read.
//! Units are SI; columns are those of the node table contract.

use std::io::{self, Write};

use crate::interface::{FIRST_TEMPERATURE, Interface};
use crate::random::Random;
use crate::size::Counted;

/// Increments of a history in one second.
const INCREMENTS_A_SECOND: f64 = 100.0;

/// A node table to generate. Equal requests give equal bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NodesRequest {
    /// Number of rows.
    pub rows: u64,
    /// Number of nodes, one at least; with fewer nodes than rows each has a history.
    pub nodes: u64,
    /// The seed of the deck, which is also that of the rows.
    pub seed: u64,
}

/// Writes the node table for `interfaces`, one at least, and returns its size in bytes.
///
/// # Errors
/// Those of the writer.
///
/// # Panics
/// There is no interface or no node.
pub fn write(request: &NodesRequest, interfaces: &[Interface], out: impl Write) -> io::Result<u64> {
    assert!(!interfaces.is_empty() && request.nodes > 0, "a row needs an interface and a node");
    let mut out = Counted::new(out);
    let increments = request.rows.div_ceil(request.nodes);
    let history = increments > 1;
    write!(out, "node,interaction,{}clearance,pressure,", if history { "time," } else { "" })?;
    writeln!(out, "temp_s,temp_m,epot_s,epot_m,por_s,por_m,area,char_length,perm_s,perm_m")?;
    for row in 0..request.rows {
        let (node, increment) = (row % request.nodes, row / request.nodes);
        let which = usize::try_from(node % interfaces.len() as u64).expect("less than a length");
        let interface = &interfaces[which];
        write!(out, "{},{},", node + 1, interface.name)?;
        if history {
            write!(out, "{},", increment as f64 / INCREMENTS_A_SECOND)?;
        }
        let progress = if history { increment as f64 / (increments - 1) as f64 } else { 0.5 };
        let state = state(interface, request.seed, node, row, progress);
        writeln!(out, "{state}")?;
    }
    out.flush()?;
    Ok(out.bytes())
}

/// The state of a node in one row, as the end of the row's text.
///
/// A node begins open, closes, and opens again as `progress` goes from 0 to 1; how far depends on the
/// node, so that a node without a history may be anywhere.
fn state(interface: &Interface, seed: u64, node: u64, row: u64, progress: f64) -> String {
    let mut of_node = Random::of_item(seed.wrapping_add(1), node);
    let mut of_row = Random::of_item(seed.wrapping_add(2), row);

    let opening = of_node.between(0.0, 1.6);
    let closing = 4.0 * progress * (1.0 - progress) * (1.0 + opening) - opening;
    let closing = if of_node.whole(0, 3) == 0 { -opening } else { closing };
    let reach = of_node.between(0.2, 1.5) * closing;
    let snap = of_row.whole(0, 7) == 0;
    let clearance = along(&interface.clearances, -reach, snap, 1e9);
    let pressure = along(&interface.pressures, reach, snap, 1.0);

    let heated = 600.0 * progress + 300.0 * closing.max(0.0);
    let temp_s = quotient(FIRST_TEMPERATURE + heated + of_row.between(0.0, 20.0), 1e2);
    let temp_m = quotient(FIRST_TEMPERATURE + heated + of_row.between(0.0, 20.0), 1e2);
    let epot_s = quotient(1.0 + of_row.between(0.0, 0.5), 1e6);
    let epot_m = quotient(1.0 - of_row.between(0.0, 0.5), 1e6);
    let por_s = quotient(of_row.between(1e4, 1e5), 1e1);
    let por_m = quotient(of_row.between(1e4, 1e5), 1e1);
    let area = quotient(of_node.between(0.5e-6, 1e-6), 1e9);
    format!("{clearance},{pressure},{temp_s},{temp_m},{epot_s},{epot_m},{por_s},{por_m},{area},0.001,1e-12,3e-12")
}

/// The point at the fraction `reach` of the last knot, or the knot at or below it where it `snap`s;
/// 0 elsewhere.
fn along(knots: &[f64], reach: f64, snap: bool, per_unit: f64) -> f64 {
    let last = knots[knots.len() - 1];
    let point = quotient(last * reach.max(0.0), per_unit);
    if snap { knots.iter().copied().rfind(|knot| *knot <= point).unwrap_or(0.0) } else { point }
}

/// The value as an integer over `per_unit`, which prints in few digits.
fn quotient(value: f64, per_unit: f64) -> f64 {
    (value * per_unit).round() / per_unit
}

#[cfg(test)]
mod tests {
    use super::*;

    fn interfaces() -> Vec<Interface> {
        (0..3).map(|number| Interface::new(1, number, 20)).collect()
    }

    fn table(rows: u64, nodes: u64, seed: u64) -> (String, Vec<Vec<String>>) {
        let mut text = Vec::new();
        let request = NodesRequest { rows, nodes, seed };
        let bytes = write(&request, &interfaces(), &mut text).expect("a vector takes all");
        assert_eq!(bytes, text.len() as u64);
        let text = String::from_utf8(text).expect("ASCII");
        let mut lines = text.lines().map(str::to_owned);
        let header = lines.next().expect("a header");
        (header, lines.map(|line| line.split(',').map(str::to_owned).collect()).collect())
    }

    #[test]
    fn a_table_has_its_rows_and_every_row_its_columns() {
        for (rows, nodes) in [(300, 300), (300, 30), (301, 30), (10, 20)] {
            let (header, table) = table(rows, nodes, 1);
            assert_eq!(table.len() as u64, rows);
            let columns = header.split(',').count();
            assert!(table.iter().all(|row| row.len() == columns));
            assert_eq!(header.contains("time"), nodes < rows);
        }
    }

    #[test]
    fn a_node_keeps_its_interaction_and_its_time_rises() {
        let (_, table) = table(300, 20, 1);
        for node in 1..=20 {
            let label = node.to_string();
            let history: Vec<_> = table.iter().filter(|row| row[0] == label).collect();
            assert_eq!(history.len(), 15);
            assert!(history.iter().all(|row| row[1] == history[0][1]));
            let times: Vec<f64> = history.iter().map(|row| row[2].parse().expect("a time")).collect();
            assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "{times:?}");
        }
    }

    #[test]
    fn rows_reach_every_part_of_a_law() {
        let interfaces = interfaces();
        let (_, table) = table(2_000, 50, 1);
        let mut counts = [0_u32; 6];
        for row in &table {
            let interface = interfaces.iter().find(|known| known.name == row[1]).expect("a known name");
            let clearance: f64 = row[3].parse().expect("a clearance");
            let pressure: f64 = row[4].parse().expect("a pressure");
            let widest = interface.clearances[interface.clearances.len() - 1];
            let highest = interface.pressures[interface.pressures.len() - 1];
            let met = [
                clearance > 0.0 && clearance < widest,
                clearance > widest,
                pressure > 0.0 && pressure < highest,
                pressure > highest,
                clearance > 0.0 && interface.clearances.contains(&clearance),
                pressure > 0.0 && interface.pressures.contains(&pressure),
            ];
            for (count, met) in counts.iter_mut().zip(met) {
                *count += u32::from(met);
            }
            assert!(clearance == 0.0 || pressure == 0.0, "{row:?}");
        }
        assert!(counts.iter().all(|count| *count > 20), "{counts:?}");
    }

    #[test]
    fn a_seed_gives_one_table_and_another_seed_another() {
        assert_eq!(table(100, 10, 1), table(100, 10, 1));
        assert_ne!(table(100, 10, 1), table(100, 10, 2));
    }
}
