//! Drawings of a deck's laws: curves of conductance, permeability and view factor against clearance and contact pressure.
//!
//! A [`Panel`] is one law of one interaction as in figure 37.3.1-1 of the Analysis User's Guide (6.14): clearance to the left of contact, pressure to the right.
//! Every value is computed by the law as in an evaluation; nothing is interpolated here.
//! Rows that form no table have no values, and are shown unchanged.
//!
//! Independent of pixels and files: pictures, text plots and pages are made from it.

mod build;
mod changes;
mod law;
mod marks;
mod node_rows;
mod probe;
mod request;
mod rows;
mod sample;
mod units;

pub use build::{figure, figures};
pub use changes::changes;
pub use law::LawKind;
pub use marks::{Mark, mark_findings};
pub use node_rows::{NodeRows, NodeSample};
pub use probe::{Probe, ProbeAxis, ProbeBranch};
pub use request::{Detail, HeldPlace, Probing, Request};
pub use units::Units;

use crate::text::counted;

/// The drawing of one deck.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Figure {
    /// The name of the deck.
    pub deck: String,
    /// The laws, interaction by interaction; small multiples of one law are adjacent.
    pub panels: Vec<Panel>,
    /// The parts that are not drawn, with the reason, one line each.
    pub notes: Vec<String>,
}

/// One law of one interaction, at one value of all variables but those of its axes and its curves.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// The name of the interaction as written in the deck.
    pub interaction: String,
    /// Its law.
    pub law: LawKind,
    /// The value of the law.
    pub value: Quantity,
    /// The quantity that distinguishes the curves; `None` for a single curve.
    pub family: Option<Quantity>,
    /// The variables that are fixed here although the rows have several values.
    pub held: Vec<Held>,
    /// To the left of contact.
    pub open: Half,
    /// To the right of contact.
    pub closed: Half,
    /// The curves, by ascending value of the family.
    pub curves: Vec<Curve>,
    /// The number of all curves: more than are drawn where there are too many to distinguish.
    pub all_curves: usize,
    /// The reason why the rows cannot be evaluated, where they cannot: the curves are then the rows as written.
    pub fault: Option<String>,
    /// The law at other values of its variables, where requested; only in the first of small multiples.
    pub probe: Option<Probe>,
    /// Findings with a place on the curves.
    pub marks: Vec<Mark>,
    /// Rows of a node table on the curves.
    pub nodes: Option<NodeRows>,
    /// Remarks on the panel, one line each.
    pub notes: Vec<String>,
}

/// A quantity with its unit.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Quantity {
    /// The name of the column in tables and node tables, such as `temp`.
    pub column: String,
    /// The name in a sentence, such as `temperature`.
    pub name: String,
    /// Its unit, or its dimension where no units are given; empty for a plain number or where nothing is known.
    pub unit: String,
}

/// A variable that is held at one of its values.
#[derive(Debug, Clone, PartialEq)]
pub struct Held {
    /// The quantity.
    pub quantity: Quantity,
    /// Its value.
    pub at: f64,
    /// The number of its values in the rows.
    pub of: usize,
    /// The number of these that no panel shows.
    pub left_out: usize,
}

/// One side of contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Half {
    /// Clearance or contact pressure.
    pub quantity: Quantity,
    /// The smallest abscissa: 0 unless the rows begin below.
    pub start: f64,
    /// The largest abscissa, beyond the last row.
    pub end: f64,
    /// Whether the law varies along the side: without rows or a cutoff it is constant.
    pub has_scale: bool,
    /// The number of rows of its table; `None` without a table.
    pub rows: Option<usize>,
}

/// A curve on both sides of contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The value of the family.
    pub at: Option<f64>,
    /// While open, against clearance.
    pub open: Branch,
    /// While closed, against contact pressure.
    pub closed: Branch,
}

/// A curve on one side of contact.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Branch {
    /// The rows of the table that lie on it, in their order.
    pub knots: Vec<Knot>,
    /// The number of rows on it; more than `knots` where there are too many to distinguish.
    pub knot_count: usize,
    /// The law's values, by ascending abscissa; for rows that form no table the rows unchanged.
    pub samples: Vec<Sample>,
}

/// A row of a table on its curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Knot {
    /// Clearance or contact pressure.
    pub x: f64,
    /// The value of the row.
    pub y: f64,
    /// The row of the table, from 0.
    pub row: usize,
}

/// A value of the law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Clearance or contact pressure.
    pub x: f64,
    /// The value there.
    pub y: f64,
    /// Whether it is within the abscissae of the rows or continued beyond them.
    pub reach: Reach,
}

/// Whether a value is from a table or its continuation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reach {
    /// Between the first and the last row.
    Within,
    /// Before the first or beyond the last row, or without any table: constant or zero.
    Continued,
}

/// One side of contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Apart, with a clearance.
    Open,
    /// In contact, with a pressure.
    Closed,
}

impl Side {
    /// Both, from left to right.
    pub const BOTH: [Self; 2] = [Self::Open, Self::Closed];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Open => "open",
            Self::Closed => "closed",
        }
    }
}

impl Panel {
    /// The half on one side of contact.
    pub fn half(&self, side: Side) -> &Half {
        match side {
            Side::Open => &self.open,
            Side::Closed => &self.closed,
        }
    }

    /// Whether there is a value anywhere on one side of contact.
    pub fn has(&self, side: Side) -> bool {
        self.curves.iter().any(|curve| !curve.branch(side).samples.is_empty())
    }

    /// The title in one line: `LAP: electrical conductance, fv1 = 2`.
    pub fn title(&self) -> String {
        let held = self.held.iter().map(|held| format!(", {} = {}", held.quantity.column, number(held.at)));
        format!("{}: {}{}", self.interaction, self.law.name(), held.collect::<String>())
    }

    /// The number of decades of the positive values; `None` without any.
    pub fn decades(&self) -> Option<f64> {
        let values = self.values().filter(|value| 0.0 < *value && value.is_finite());
        range(values).map(|(least, greatest)| greatest.log10() - least.log10())
    }

    /// All values that are shown, including continuations and nodes.
    pub fn values(&self) -> impl Iterator<Item = f64> {
        let branches = self.curves.iter().flat_map(|curve| Side::BOTH.map(|side| curve.branch(side)));
        let of_curves = branches.flat_map(|branch| {
            branch.samples.iter().map(|sample| sample.y).chain(branch.knots.iter().map(|knot| knot.y))
        });
        let nodes = self.nodes.iter().flat_map(|nodes| nodes.sample.iter().map(|node| node.y));
        of_curves.chain(nodes)
    }
}

impl Curve {
    /// The curve on one side of contact.
    pub fn branch(&self, side: Side) -> &Branch {
        match side {
            Side::Open => &self.open,
            Side::Closed => &self.closed,
        }
    }
}

impl Quantity {
    /// The title of an axis: `contact pressure (M L⁻¹ T⁻²)`.
    pub fn title(&self) -> String {
        if self.unit.is_empty() { self.name.clone() } else { format!("{} ({})", self.name, self.unit) }
    }
}

/// Minimum and maximum of some numbers, none of which is NaN; `None` where there is none.
pub(crate) fn range(numbers: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    numbers.fold(None, |range, x| {
        let (least, greatest) = range.unwrap_or((x, x));
        Some((if x < least { x } else { least }, if greatest < x { x } else { greatest }))
    })
}

/// A number for a label: the shortest digits that round-trip, with an exponent where they would be mostly zeros.
pub fn number(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude == 0.0 || (1e-3..1e5).contains(&magnitude) || !magnitude.is_finite() {
        format!("{}", value + 0.0)
    } else {
        format!("{value:e}")
    }
}

impl Panel {
    /// The alternative text of the panel.
    pub fn description(&self) -> String {
        let of_half = |side: Side| {
            let half = self.half(side);
            let rows = half.rows?;
            let side_name = match side {
                Side::Open => "against clearance",
                Side::Closed => "against contact pressure",
            };
            let knots = self.curves.iter().flat_map(|curve| &curve.branch(side).samples);
            let within = knots.filter(|sample| sample.reach == Reach::Within).map(|sample| sample.y);
            let range =
                range(within).map(|(least, greatest)| format!(", from {} to {}", number(least), number(greatest)));
            Some(format!("{side_name} {}{}", counted(rows, "row"), range.unwrap_or_default()))
        };
        let mut parts: Vec<String> = Side::BOTH.into_iter().filter_map(of_half).collect();
        if let (Some(family), true) = (&self.family, 1 < self.curves.len()) {
            let ends = [self.curves.first(), self.curves.last()].map(|curve| curve.and_then(|curve| curve.at));
            if let [Some(first), Some(last)] = ends {
                let (count, name) = (self.curves.len(), &family.name);
                parts.push(format!("{count} curves by {name}, {} to {}", number(first), number(last)));
            }
        }
        parts.extend(self.fault.clone());
        parts.extend(self.nodes.as_ref().map(NodeRows::summary));
        parts.extend(self.marks.iter().map(|mark| format!("{} at line {}", mark.code, mark.line)));
        format!("{}, {}", self.title(), parts.join(", "))
    }
}
