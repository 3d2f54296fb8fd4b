//! Evaluates the laws of a deck on record batches, and a conductance by itself.
//!
//! `cargo run -p inpact --example evaluate`

use inpact::arrow::array::{AsArray, Float64Array, RecordBatch, StringArray};
use inpact::arrow::datatypes::Float64Type;
use inpact::{Deck, EvaluateOptions, ReadOptions};
use std::error::Error;
use std::sync::Arc;

const JOINT: &str = "\
*SURFACE INTERACTION, NAME=JOINT
*GAP ELECTRICAL CONDUCTANCE
4000., 0.
0., 2.E-5
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
4000., 0.
9000., 5.E6
";

fn main() -> Result<(), Box<dyn Error>> {
    for (node, current) in currents()? {
        println(&format!("node {node}: {current} A/m²"));
    }
    Ok(())
}

/// The current density at three nodes: apart, touching, pressed.
fn currents() -> Result<Vec<(String, f64)>, Box<dyn Error>> {
    let deck = Deck::parse("joint.inp", JOINT, &ReadOptions::new().isolated())?;
    let numbers = |values: [f64; 3]| Arc::new(Float64Array::from(values.to_vec())) as _;
    let rows = RecordBatch::try_from_iter([
        ("node", Arc::new(StringArray::from(vec!["1", "2", "3"])) as _),
        ("clearance", numbers([1e-5, 0.0, 0.0])),
        ("pressure", numbers([0.0, 0.0, 2e6])),
        ("epot_s", numbers([1.5, 1.5, 1.5])),
        ("epot_m", numbers([0.5, 0.5, 0.5])),
    ])?;
    let result = deck.evaluate(rows.schema(), [Ok(rows)], &EvaluateOptions::new().outputs(["ECD"]))?;
    let batch = &result.batches()[0];
    let column = |name| batch.column_by_name(name).ok_or("the result lacks a column");
    let (nodes, currents) = (column("node")?.as_string::<i32>(), column("ECD")?.as_primitive::<Float64Type>());
    let gap = deck.electrical_conductance("JOINT")?.ok_or("the joint has no conductance")?;
    // The jump of potential is 1 V: the current density is the conductance.
    assert_eq!(currents.value(2), gap.at(Some(0.0), Some(2e6), &[]));
    Ok(nodes.iter().flatten().map(str::to_owned).zip(currents.values().iter().copied()).collect())
}

fn println(line: &str) {
    use std::io::Write;
    // Whoever reads the output may stop reading.
    let _ = writeln!(std::io::stdout(), "{line}");
}

#[cfg(test)]
mod tests {
    #[test]
    fn currents_follow_the_tables() {
        let currents: Vec<f64> =
            super::currents().expect("they are found").into_iter().map(|(_, current)| current).collect();
        assert_eq!(currents, [2000.0, 4000.0, 6000.0]);
    }
}
