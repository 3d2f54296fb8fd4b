//! Random decks and node tables, as texts for the program and as plain values for the judge.

use crate::table_judge::{Random, Rows};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Columns of numbers a scene may have; `node` and `interaction` are texts.
pub(crate) const COLUMNS: [&str; 19] = [
    "time",
    "clearance",
    "pressure",
    "closed",
    "temp_s",
    "temp_m",
    "temp",
    "temp_jump",
    "epot_s",
    "epot_m",
    "epot_jump",
    "por_s",
    "por_m",
    "q_across",
    "area",
    "clearance_rate",
    "char_length",
    "shear",
    "slip_rate",
];

/// Which of two regimes the procedures of a deck ask for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Regime {
    Steady,
    Transient,
}

/// What a deck says of one interaction: tables as rows of value, clearance or pressure, mean temperature (mean pore pressure for fluid).
#[derive(Clone, Debug, Default)]
pub(crate) struct Interaction {
    pub name: String,
    pub electrical: [Option<Rows>; 2],
    pub thermal: [Option<Rows>; 2],
    /// Rows of view factor and clearance, between black surfaces.
    pub radiation: Option<Rows>,
    /// η and f.
    pub heat: Option<[f64; 2]>,
    pub has_friction: bool,
    pub pore: Option<Pore>,
}

/// *CONTACT PERMEABILITY.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pore {
    pub table: Option<Rows>,
    pub cutoff_across: Option<f64>,
    pub cutoff_fill: Option<f64>,
}

/// A row of a node table; a column that is missing or empty is not in the map.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub node: usize,
    pub interaction: usize,
    pub cells: BTreeMap<&'static str, f64>,
}

/// A deck and a node table.
#[derive(Clone, Debug)]
pub(crate) struct Scene {
    pub interactions: Vec<Interaction>,
    /// The regime of current, where a procedure solves for it, and that of pore fluid.
    pub electrical: Option<Regime>,
    pub pore: Option<Regime>,
    pub stefan_boltzmann: f64,
    pub absolute_zero: f64,
    pub has_nodes: bool,
    pub columns: Vec<&'static str>,
    pub rows: Vec<Row>,
}

/// A number that a deck writes in few digits.
fn short(random: &mut Random, limit: usize) -> f64 {
    random.below(64 * limit) as f64 / 64.0
}

/// Rows against clearance or pressure, and in half of the tables a second variable.
fn table(random: &mut Random, second: [f64; 3]) -> Rows {
    let groups = if random.below(2) == 0 { 1 } else { 2 + random.below(2) };
    let mut rows = Rows::new();
    for outer in &second[..groups] {
        let mut x = 0.0;
        for _ in 0..=random.below(4) {
            let outer = if groups == 1 { 0.0 } else { *outer };
            rows.push(vec![short(random, 50), x, outer]);
            x += (1 + random.below(64)) as f64 / 64.0;
        }
    }
    rows
}

fn maybe<T>(random: &mut Random, of: impl FnOnce(&mut Random) -> T) -> Option<T> {
    (random.below(2) == 0).then(|| of(random))
}

/// One or both tables of a conductance.
fn conductance(random: &mut Random) -> [Option<Rows>; 2] {
    const TEMPERATURES: [f64; 3] = [250.0, 300.0, 400.0];
    let which = 1 + random.below(3);
    let mut of = |bit| (which & bit != 0).then(|| table(random, TEMPERATURES));
    [of(1), of(2)]
}

fn interaction(random: &mut Random, name: String) -> Interaction {
    let with = |random: &mut Random| random.below(3) != 0;
    Interaction {
        name,
        electrical: if with(random) { conductance(random) } else { [None, None] },
        thermal: if with(random) { conductance(random) } else { [None, None] },
        radiation: maybe(random, |random| {
            let mut rows = table(random, [0.0; 3]);
            // One group only, of factors from 0 to 1.
            rows.truncate(rows.windows(2).position(|pair| pair[1][1] <= pair[0][1]).map_or(rows.len(), |at| at + 1));
            rows.into_iter().map(|row| vec![row[0] / 64.0, row[1]]).collect()
        }),
        heat: maybe(random, |random| [short(random, 2), short(random, 1)]),
        has_friction: random.below(3) == 0,
        pore: with(random).then(|| Pore {
            table: (random.below(4) != 0).then(|| table(random, [-1.0, 0.0, 2.0])),
            cutoff_across: maybe(random, |random| short(random, 2)),
            cutoff_fill: maybe(random, |random| short(random, 2)),
        }),
    }
}

impl Scene {
    /// A random scene; `extreme` draws the numbers of its rows from all decades.
    pub(crate) fn random(random: &mut Random, extreme: bool) -> Self {
        let count = 1 + random.below(3);
        let interactions: Vec<_> = (0..count).map(|number| interaction(random, format!("I{number}"))).collect();
        let regime = |random: &mut Random| if random.below(3) == 0 { Regime::Steady } else { Regime::Transient };
        let columns: Vec<&'static str> =
            COLUMNS.into_iter().filter(|name| random.below(if *name == "clearance" { 12 } else { 4 }) != 0).collect();
        let nodes = 1 + random.below(4);
        let mut times = vec![0.0; nodes * count];
        let rows = (0..=random.below(14)).map(|_| {
            let (node, interaction) = (random.below(nodes), random.below(count));
            let time = &mut times[node * count + interaction];
            *time += random.positive(-3, 3);
            let lacks = random.below(3) == 0;
            let mut cells = BTreeMap::new();
            for name in &columns {
                let value = if *name == "time" { *time } else { number(random, name, extreme) };
                // A time is never missing: then a row is no part of a history.
                if *name == "time" || !(lacks && random.below(4) == 0) {
                    cells.insert(*name, value);
                }
            }
            Row { node, interaction, cells }
        });
        Self {
            rows: rows.collect(),
            electrical: maybe(random, regime),
            pore: maybe(random, regime),
            stefan_boltzmann: [5.67e-8, 1.0, 0.25][random.below(3)],
            absolute_zero: [0.0, -273.15][random.below(2)],
            has_nodes: random.below(4) != 0,
            interactions,
            columns,
        }
    }

    /// The deck.
    pub(crate) fn deck(&self) -> String {
        let mut deck = format!(
            "*PHYSICAL CONSTANTS, ABSOLUTE ZERO={:?}, STEFAN BOLTZMANN={:e}\n",
            self.absolute_zero, self.stefan_boltzmann
        );
        for of in &self.interactions {
            let _ = writeln!(deck, "*SURFACE INTERACTION, NAME={}", of.name);
            for (keyword, tables) in [("GAP ELECTRICAL CONDUCTANCE", &of.electrical), ("GAP CONDUCTANCE", &of.thermal)]
            {
                for (parameter, rows) in ["", ", PRESSURE"].iter().zip(tables) {
                    if let Some(rows) = rows {
                        let _ = writeln!(deck, "*{keyword}{parameter}");
                        write_rows(&mut deck, rows);
                    }
                }
            }
            if let Some(rows) = &of.radiation {
                deck += "*GAP RADIATION\n1., 1.\n";
                write_rows(&mut deck, rows);
            }
            if let Some([fraction, weight]) = of.heat {
                let _ = writeln!(deck, "*GAP HEAT GENERATION\n{fraction:?}, {weight:?}");
            }
            if of.has_friction {
                deck += "*FRICTION\n0.3,\n";
            }
            if let Some(pore) = &of.pore {
                deck += "*CONTACT PERMEABILITY";
                for (name, cutoff) in [("FLOW ACROSS", pore.cutoff_across), ("GAP FILL", pore.cutoff_fill)] {
                    if let Some(cutoff) = cutoff {
                        let _ = write!(deck, ", CUTOFF {name}={cutoff:?}");
                    }
                }
                deck.push('\n');
                write_rows(&mut deck, pore.table.iter().flatten());
            }
        }
        for (keyword, steady, transient, regime) in [
            ("COUPLED THERMAL-ELECTRICAL", ", STEADY STATE", "", self.electrical),
            ("SOILS", "", ", CONSOLIDATION", self.pore),
        ] {
            if let Some(regime) = regime {
                let parameter = if regime == Regime::Steady { steady } else { transient };
                let _ = writeln!(deck, "*STEP\n*{keyword}{parameter}\n1., 1.\n*END STEP");
            }
        }
        deck
    }

    /// The node table.
    pub(crate) fn nodes(&self) -> String {
        let texts = if self.has_nodes { "node,interaction" } else { "interaction" };
        let mut csv = [&[texts], self.columns.as_slice()].concat().join(",");
        for row in &self.rows {
            csv.push('\n');
            if self.has_nodes {
                let _ = write!(csv, "{},", row.node);
            }
            csv += &self.interactions[row.interaction].name;
            for name in &self.columns {
                let cell = row.cells.get(name).map_or_else(String::new, |value| format!("{value:?}"));
                let _ = write!(csv, ",{cell}");
            }
        }
        csv + "\n"
    }
}

fn write_rows<'a>(deck: &mut String, rows: impl IntoIterator<Item = &'a Vec<f64>>) {
    for row in rows {
        let cells: Vec<String> = row.iter().map(|cell| format!("{cell:?}")).collect();
        let _ = writeln!(deck, "{}", cells.join(", "));
    }
}

/// A number of a column.
fn number(random: &mut Random, name: &str, extreme: bool) -> f64 {
    let signed = |random: &mut Random, size: f64| (random.unit() - 0.5) * size;
    match name {
        "clearance" => [0.0, 0.5, short(random, 2), random.unit() * 2.0, -random.unit()][random.below(5)],
        "pressure" => [0.0, 0.0, short(random, 3), random.unit() * 4.0][random.below(4)],
        "closed" => random.below(2) as f64,
        "area" if extreme => random.of_any_decade(),
        "area" => random.unit() * 4.0,
        "char_length" => random.unit(),
        "temp_s" | "temp_m" | "temp" if extreme => random.positive(-200, 300),
        "temp_s" | "temp_m" | "temp" => 200.0 + random.unit() * 300.0,
        "epot_s" | "epot_m" | "epot_jump" | "shear" | "slip_rate" | "por_s" | "por_m" | "clearance_rate" if extreme => {
            0.25 * random.signed()
        }
        "temp_jump" if extreme => random.positive(-400, 300),
        _ => signed(random, 8.0),
    }
}
