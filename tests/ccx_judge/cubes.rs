//! Two unit cubes, one pressed upon the other: a deck in which pressure, temperatures and area of the contact are known exactly.
//!
//! All displacements are prescribed, and all temperatures or those of the outer faces, so the heat that flows is that of the contact,
//! alone or in series with two conductors.

use std::collections::HashSet;
use std::fmt::Write;

/// The conductance of each cube from its outer face to the contact.
pub(crate) const CONDUCTANCE: f64 = 50.0;

/// The modulus of the cubes' material, from which ccx derives default stiffnesses.
const MODULUS: f64 = 2.1e11;

/// A keyword line with its rows.
#[derive(Debug, Clone)]
pub(crate) struct Card {
    /// The keyword in full, by which a change finds the card.
    pub(crate) of: &'static str,
    pub(crate) line: String,
    pub(crate) rows: Vec<String>,
}

impl Card {
    pub(crate) fn new(of: &'static str, parameters: &str, rows: &[&str]) -> Self {
        let line = if parameters.is_empty() { format!("*{of}") } else { format!("*{of}, {parameters}") };
        Self { of, line, rows: rows.iter().map(|row| (*row).to_owned()).collect() }
    }

    /// The card as lines of a deck.
    pub(crate) fn text(&self) -> String {
        std::iter::once(&self.line).chain(&self.rows).fold(String::new(), |text, line| text + line + "\n")
    }
}

/// Laws of pressure against overclosure.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Closure {
    /// In proportion.
    Linear(f64),
    /// p₀ exp(β · overclosure).
    Exponential {
        /// β.
        rate: f64,
        /// The pressure where the surfaces just touch.
        at_zero: f64,
    },
    /// In proportion up to an overclosure, constant after it.
    Table {
        /// The slope.
        stiffness: f64,
        /// The last overclosure of the table.
        last: f64,
    },
}

impl Closure {
    /// The default stiffness of ccx.
    pub(crate) const DEFAULT: Self = Self::Linear(50.0 * MODULUS);

    fn pressure(self, overclosure: f64) -> f64 {
        match self {
            Self::Linear(stiffness) => stiffness * overclosure,
            Self::Exponential { rate, at_zero } => at_zero * (rate * overclosure).exp(),
            Self::Table { stiffness, last } => stiffness * overclosure.min(last),
        }
    }
}

/// A deck in the making.
#[derive(Debug, Clone)]
pub(crate) struct Cubes {
    /// The cards before the interaction.
    pub(crate) before: Vec<Card>,
    /// The interaction and its sub-options.
    pub(crate) cards: Vec<Card>,
    /// The contact pair.
    pub(crate) pair: Card,
    /// The cards after the pair.
    pub(crate) after: Vec<Card>,
    /// The cards inside the step.
    pub(crate) in_step: Vec<Card>,
    /// Whether the pair stands before the interaction.
    pub(crate) pair_first: bool,
    /// The names of the two surfaces as they are defined: lower, upper.
    pub(crate) surfaces: [String; 2],
    /// Included files.
    pub(crate) files: Vec<(String, String)>,
    pub(crate) overclosure: f64,
    pub(crate) closure: Closure,
    /// The temperatures of the lower and the upper cube.
    pub(crate) temperatures: [f64; 2],
    /// The coefficient of friction.
    pub(crate) friction: Option<f64>,
    /// The upper cube is the slave, unless they are exchanged.
    pub(crate) slave_is_upper: bool,
    /// The interaction in the node table.
    pub(crate) interaction: String,
}

impl Cubes {
    /// Whether the conductance changes with temperature while the temperatures of the faces are sought.
    ///
    /// ccx ends its iteration where it is near enough, not where all the digits that it prints stand still.
    pub(crate) fn is_iterated(&self) -> bool {
        let cards = self.cards.iter().chain(&self.after).chain(&self.in_step);
        let rows = cards.filter(|card| card.of == "GAP CONDUCTANCE").flat_map(|card| &card.rows).map(String::as_str);
        let included = self.files.iter().flat_map(|(_, text)| text.lines());
        let temperatures: HashSet<&str> = rows.chain(included).filter_map(|row| row.split(',').nth(2)).collect();
        self.friction.is_some() && 1 < temperatures.len()
    }

    /// The contact pressure.
    pub(crate) fn pressure(&self) -> f64 {
        self.closure.pressure(self.overclosure)
    }

    /// The sets of nodes whose temperatures are prescribed, of the lower and the upper cube.
    ///
    /// All nodes, but where friction heats the faces: ccx does not count what friction gives to a node that is held.
    pub(crate) fn held(&self) -> [&'static str; 2] {
        if self.friction.is_some() { ["NBOT", "NTOP"] } else { ["NLOW", "NUP"] }
    }

    /// The deck.
    pub(crate) fn deck(&self) -> String {
        let mut deck = MESH.to_owned();
        let [lower, upper] = &self.surfaces;
        let _ = write!(deck, "*SURFACE, NAME={lower}\nELOW, S2\n*SURFACE, NAME={upper}\nEUP, S1\n");
        let all = |cards: &[Card]| cards.iter().map(Card::text).collect::<String>();
        deck += &all(&self.before);
        if self.pair_first {
            deck += &self.pair.text();
        }
        deck += &all(&self.cards);
        if !self.pair_first {
            deck += &self.pair.text();
        }
        deck += &all(&self.after);
        let [low, high] = self.temperatures;
        let [lower, upper] = self.held();
        let _ = write!(
            deck,
            "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNLOW, {low}\nNUP, {high}\n\
             *STEP, INC=100\n*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE\n1., 1.\n\
             *BOUNDARY\nNLOW, 1, 3, 0.\nNUP, 2, 2, 0.\nNUP, 1, 1, {shift}\nNUP, 3, 3, -{overclosure}\n\
             {lower}, 11, 11, {low}\n{upper}, 11, 11, {high}\n",
            shift = if self.friction.is_some() { "1.E-2" } else { "0." },
            overclosure = self.overclosure,
        );
        deck += &all(&self.in_step);
        let print = |set: &str| format!("*NODE PRINT, NSET={set}, TOTALS=ONLY\nRFL\n");
        deck + &print(upper) + &print(lower) + "*END STEP\n"
    }

    /// The node table with which the contact is evaluated at temperatures of the lower and the upper face.
    pub(crate) fn nodes(&self, [low, high]: [f64; 2]) -> String {
        let pressure = self.pressure();
        let is_read = |card: &Card| card.line.replace([' ', '\t'], "").to_ascii_uppercase().starts_with("*FRICTION");
        let mut cards = self.cards.iter().chain(&self.after).chain(&self.in_step);
        let friction = self.friction.filter(|_| cards.any(is_read));
        let shear = friction.map_or(0.0, |friction| friction * pressure);
        let (slave, master) = if self.slave_is_upper { (high, low) } else { (low, high) };
        let name = self.interaction.replace('"', "\"\"");
        format!(
            "interaction,area,clearance,pressure,temp_s,temp_m,shear,slip_rate\n\
             \"{name}\",1,0,{pressure:e},{slave},{master},{shear:e},0\n"
        )
    }
}

const MESH: &str = "\
*HEADING
two cubes
*NODE, NSET=NALL
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
9, 0, 0, 1
10, 1, 0, 1
11, 1, 1, 1
12, 0, 1, 1
13, 0, 0, 2
14, 1, 0, 2
15, 1, 1, 2
16, 0, 1, 2
*ELEMENT, TYPE=C3D8, ELSET=ELOW
1, 1,2,3,4,5,6,7,8
*ELEMENT, TYPE=C3D8, ELSET=EUP
2, 9,10,11,12,13,14,15,16
*NSET, NSET=NLOW
1,2,3,4,5,6,7,8
*NSET, NSET=NUP
9,10,11,12,13,14,15,16
*NSET, NSET=NBOT
1,2,3,4
*NSET, NSET=NTOP
13,14,15,16
*MATERIAL, NAME=M
*ELASTIC
2.1E11, 0.
*EXPANSION
0.
*CONDUCTIVITY
50
*DENSITY
7800.
*SPECIFIC HEAT
460.
*SOLID SECTION, ELSET=ELOW, MATERIAL=M
*SOLID SECTION, ELSET=EUP, MATERIAL=M
";
