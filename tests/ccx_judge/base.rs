//! A deck that is right, drawn at random: table, temperatures, overclosure, friction.

use crate::cubes::{Card, Closure, Cubes};
use crate::random::Random;

const STIFFNESS: f64 = 1e7;

/// A deck that ccx runs as it is meant.
pub(crate) fn draw(random: &mut Random) -> Cubes {
    let low = 280.0 + 5.0 * random.below(20) as f64;
    let high = low + random.of(&[40.0, 100.0, 63.0]);
    let has_friction = random.once_in(2);
    let friction = has_friction.then(|| random.of(&[0.1, 0.25, 0.5]));
    let mut cards = vec![
        Card::new("SURFACE INTERACTION", "NAME=SI", &[]),
        Card::new("SURFACE BEHAVIOR", "PRESSURE-OVERCLOSURE=LINEAR", &["1e+07, 0., 0.001"]),
        Card { rows: table(random), ..Card::new("GAP CONDUCTANCE", "", &[]) },
    ];
    if let Some(friction) = friction {
        cards.push(Card { rows: vec![format!("{friction}, 1.E7")], ..Card::new("FRICTION", "", &[]) });
        let (fraction, weight) = (random.of(&["0.8", "1.", "0.25"]), random.of(&["0.25", "0.5", "1.", "0."]));
        let speed = random.of(&["3.0", "0.5", "12."]);
        let row = format!("{fraction}, {weight}, {speed}");
        cards.push(Card { rows: vec![row], ..Card::new("GAP HEAT GENERATION", "", &[]) });
    }
    Cubes {
        before: Vec::new(),
        cards,
        pair: Card::new("CONTACT PAIR", "INTERACTION=SI, TYPE=SURFACE TO SURFACE", &["SSLAV, SMAST"]),
        after: Vec::new(),
        in_step: Vec::new(),
        pair_first: false,
        surfaces: ["SMAST".to_owned(), "SSLAV".to_owned()],
        files: Vec::new(),
        overclosure: random.of(&[1e-7, 2.5e-5, 7.5e-5, 1e-4, 2.2e-4, 6e-4]),
        closure: Closure::Linear(STIFFNESS),
        temperatures: [low, high],
        friction,
        slave_is_upper: true,
        interaction: "SI".to_owned(),
    }
}

/// One to three curves of one to six rows; all begin at zero, so that any two share pressures.
fn table(random: &mut Random) -> Vec<String> {
    let mut rows = Vec::new();
    for curve in 0..random.of(&[1, 1, 2, 3]) {
        let temperature = 261.5 + 77.0 * f64::from(curve);
        let mut pressure = 0.0;
        for row in 0..=random.below(6) {
            let conductance = 40 + random.below(100) + 90 * row;
            rows.push(format!("{conductance}., {pressure}, {temperature}"));
            pressure += random.of(&[250.0, 333.3, 500.0, 2000.0]);
        }
    }
    rows
}
