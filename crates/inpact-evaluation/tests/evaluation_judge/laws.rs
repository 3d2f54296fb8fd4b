//! What a scene gives, row by row, by the semantics: sections 3 to 6 and the decisions, in exact rationals.

use super::scene::{Interaction, Pore, Regime, Row, Scene};
use crate::table_judge::{Rows, exact};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;
use std::ops::{Add, Mul, Neg};

/// An exact number, and the sum of the magnitudes it was put together from: what its rounding is measured by.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Number {
    pub value: BigRational,
    pub scale: BigRational,
}

impl Number {
    fn new(value: BigRational) -> Self {
        Self { scale: value.abs(), value }
    }

    fn of(value: f64) -> Self {
        Self::new(exact(value))
    }

    fn zero() -> Self {
        Self::new(BigRational::zero())
    }
}

impl Add for Number {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, scale: self.scale + other.scale }
    }
}

impl Mul for Number {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self { value: self.value * other.value, scale: self.scale * other.scale }
    }
}

impl Neg for Number {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, scale: self.scale }
    }
}

/// The results of a row: what is not among them has no number.
pub(crate) type Results = BTreeMap<&'static str, Number>;

/// What follows the last row of a group.
#[derive(Clone, Copy, PartialEq)]
enum Tail {
    Constant,
    Zero,
}

/// A table of value, x and y by T-04 to T-06, Q-1, Q-38: linear along x in each group of one y, then linear along y, constant outside but for the tail of x.
fn value_of(rows: &Rows, x: f64, y: f64, tail: Tail) -> BigRational {
    let along_x = |group: &[Vec<f64>]| {
        let (first, last) = (&group[0], &group[group.len() - 1]);
        if x <= first[1] {
            return exact(first[0]);
        }
        if last[1] < x {
            return if tail == Tail::Zero { BigRational::zero() } else { exact(last[0]) };
        }
        let right = group.iter().position(|row| x <= row[1]).expect("it is not beyond the last");
        between(x, (group[right - 1][1], exact(group[right - 1][0])), (group[right][1], exact(group[right][0])))
    };
    let groups: Vec<&[Vec<f64>]> = rows.chunk_by(|a, b| a[2] == b[2]).collect();
    let of = |group: usize| (groups[group][0][2], along_x(groups[group]));
    let last = groups.len() - 1;
    match groups.iter().position(|group| y < group[0][2]) {
        _ if last == 0 => of(0).1,
        Some(0) => of(0).1,
        Some(right) => between(y, of(right - 1), of(right)),
        None => of(last).1,
    }
}

fn between(x: f64, (x0, y0): (f64, BigRational), (x1, y1): (f64, BigRational)) -> BigRational {
    let part = (exact(x) - exact(x0)) / (exact(x1) - exact(x0));
    &y0 + part * (&y1 - &y0)
}

fn depends_on_y(rows: &Rows) -> bool {
    rows.iter().any(|row| row[2] != rows[0][2])
}

fn depends_on_x(rows: &Rows, tail: Tail) -> bool {
    tail == Tail::Zero || rows.windows(2).any(|pair| pair[0][2] == pair[1][2])
}

/// Closed and open (T-22); `None` where it cannot be told.
fn is_closed(row: &Row) -> Option<bool> {
    let cell = |name: &str| row.cells.get(name).copied();
    match (cell("closed"), cell("clearance"), cell("pressure").unwrap_or(0.0)) {
        (Some(closed), ..) => Some(closed != 0.0),
        (None, Some(clearance), pressure) => Some(clearance <= 0.0 || pressure != 0.0),
        (None, None, pressure) => (pressure != 0.0).then_some(true),
    }
}

/// An integral over the rows of a node, and over its area for as long as that is known.
#[derive(Clone)]
struct Integral {
    per_area: Number,
    whole: Option<Number>,
}

impl Integral {
    fn new() -> Self {
        Self { per_area: Number::zero(), whole: Some(Number::zero()) }
    }

    fn add(&mut self, step: Option<Number>, area: Option<f64>) {
        let step = step.unwrap_or_else(Number::zero);
        self.whole = self.whole.take().zip(area).map(|(sum, area)| sum + step.clone() * Number::of(area));
        self.per_area = self.per_area.clone() + step;
    }
}

/// What the rows of a node leave to the next.
#[derive(Clone)]
struct History {
    current: Option<(f64, f64)>,
    ecdt: Integral,
    sjdt: Integral,
    heat: Option<f64>,
    htl: Integral,
    rubbed: Option<f64>,
    sfdrt: Integral,
    gap: Option<(f64, f64)>,
    ptl: Option<Integral>,
}

impl History {
    fn new() -> Self {
        let integral = Integral::new;
        Self {
            current: None,
            ecdt: integral(),
            sjdt: integral(),
            heat: None,
            htl: integral(),
            rubbed: None,
            sfdrt: integral(),
            gap: None,
            ptl: Some(integral()),
        }
    }
}

/// The results of every row of a scene.
pub(crate) fn judge(scene: &Scene) -> Vec<Results> {
    let mut histories: BTreeMap<(usize, usize), History> = BTreeMap::new();
    let of_row = |row: &Row| {
        let judge = Judge::new(scene, row.interaction);
        let history = histories.entry((row.interaction, row.node)).or_insert_with(History::new);
        let has_history = scene.has_nodes && row.cells.contains_key("time");
        let mut results = Results::new();
        if let Some(closed) = is_closed(row) {
            let of = RowJudge { judge: &judge, row, closed };
            of.laws(has_history.then_some(history), &mut results);
        }
        results
    };
    scene.rows.iter().map(of_row).collect()
}

/// What is known of all rows of an interaction.
struct Judge<'a> {
    scene: &'a Scene,
    of: &'a Interaction,
    number: usize,
    never_open: bool,
    never_closed: bool,
}

impl<'a> Judge<'a> {
    fn new(scene: &'a Scene, number: usize) -> Self {
        let rows = || scene.rows.iter().filter(|row| row.interaction == number).map(is_closed);
        let never = |closed| rows().all(|state| state == Some(closed));
        Self { scene, of: &scene.interactions[number], number, never_open: never(true), never_closed: never(false) }
    }

    /// Whether a column has a number in any of the rows.
    fn has(&self, name: &str) -> bool {
        self.scene.rows.iter().any(|row| row.interaction == self.number && row.cells.contains_key(name))
    }

    /// Whether the tables of a conductance that rows reach have their columns.
    fn can_conduct(&self, tables: &[Option<Rows>; 2], tail: Tail) -> bool {
        let [clearance, pressure] = tables;
        let clearance = clearance.as_ref().filter(|_| !(pressure.is_some() && self.never_open));
        let pressure = pressure.as_ref().filter(|_| !self.never_closed);
        let lacks_clearance = |rows: &Rows| depends_on_x(rows, tail) && !self.never_open && !self.has("clearance");
        let lacks_pressure = |rows: &Rows| depends_on_x(rows, Tail::Constant) && !self.has("pressure");
        let has_mean = self.has("temp") || (self.has("temp_s") && self.has("temp_m"));
        let lacks_mean = clearance.into_iter().chain(pressure).any(depends_on_y) && !has_mean;
        !(clearance.is_some_and(lacks_clearance) || pressure.is_some_and(lacks_pressure) || lacks_mean)
    }
}

/// One row of an interaction.
struct RowJudge<'a> {
    judge: &'a Judge<'a>,
    row: &'a Row,
    closed: bool,
}

impl RowJudge<'_> {
    fn cell(&self, name: &str) -> Option<f64> {
        self.row.cells.get(name).copied()
    }

    /// A cell of both sides together, otherwise what `of` makes of the two sides.
    fn cell_or_sides(&self, names: [&str; 3], of: impl Fn(f64, f64) -> f64) -> Option<f64> {
        self.cell(names[0]).or_else(|| Some(of(self.cell(names[1])?, self.cell(names[2])?)))
    }

    /// A difference of both sides, exactly.
    fn difference(&self, [jump, slave, master]: [&str; 3]) -> Option<Number> {
        let sides = || Some(Number::new(exact(self.cell(slave)?) - exact(self.cell(master)?)));
        self.cell(jump).map(Number::of).or_else(sides)
    }

    /// A conductance by its tables (section 4.2, Q-36); `None` where the row lacks a coordinate.
    fn conductance(&self, [clearance, pressure]: &[Option<Rows>; 2], tail: Tail) -> Option<Number> {
        let (rows, x, tail) = match (clearance, pressure, self.closed) {
            (_, Some(rows), true) => (rows, self.cell("pressure"), Tail::Constant),
            (Some(rows), None, true) => (rows, Some(0.0), tail),
            (Some(rows), _, false) => (rows, self.cell("clearance").map(|d| d.max(0.0)), tail),
            _ => return Some(Number::zero()),
        };
        let mean = self.cell_or_sides(["temp", "temp_s", "temp_m"], f64::midpoint);
        let x = if depends_on_x(rows, tail) { x? } else { x.unwrap_or(0.0) };
        let y = if depends_on_y(rows) { mean? } else { 0.0 };
        Some(Number::new(value_of(rows, x, y, tail)))
    }

    fn laws(&self, mut history: Option<&mut History>, results: &mut Results) {
        let current = self.electrical(history.as_deref_mut(), results);
        self.thermal(current, history.as_deref_mut(), results);
        self.pore(history, results);
    }

    /// The flow `name`, times the area, and both over time.
    fn give(&self, names: [&'static str; 4], flow: &Number, integral: Option<&Integral>, results: &mut Results) {
        let area = self.cell("area");
        results.insert(names[0], flow.clone());
        results.extend(area.map(|area| (names[1], flow.clone() * Number::of(area))));
        if let Some(integral) = integral {
            results.insert(names[2], integral.per_area.clone());
            results.extend(integral.whole.clone().map(|whole| (names[3], whole)));
        }
    }

    /// η and f.
    fn heat(&self) -> [f64; 2] {
        self.judge.of.heat.unwrap_or([1.0, 0.5])
    }

    /// The electrical law; gives the heat of the current (H-01 to H-08).
    fn electrical(&self, history: Option<&mut History>, results: &mut Results) -> Option<Number> {
        let of = self.judge.of;
        if of.electrical == [None, None] || !self.judge.can_conduct(&of.electrical, Tail::Constant) {
            return None;
        }
        let conductance = self.conductance(&of.electrical, Tail::Constant)?;
        results.insert("conductance", conductance.clone());
        let jump = self.difference(["epot_jump", "epot_s", "epot_m"])?;
        // A potential difference is one f64 wherever it goes on.
        let rounded = self.cell_or_sides(["epot_jump", "epot_s", "epot_m"], |slave, master| slave - master)?;
        let current = conductance.clone() * jump;
        let before = history.as_ref().and_then(|history| history.current);
        let start = match (self.judge.scene.electrical, before) {
            (Some(Regime::Transient), Some((_, start))) => start,
            _ => rounded,
        };
        let (end, start) = (Number::of(rounded), Number::of(start));
        let third = Number::new(BigRational::new(One::one(), 3.into()));
        let square = end.clone() * end.clone() + end.clone() * start.clone() + start.clone() * start;
        let heat = Number::of(self.heat()[0]) * conductance * square * third;
        let integrals = history.map(|history| {
            let time = self.row.cells["time"];
            let duration = before.map(|(before, _)| Number::of(time - before));
            let step = |flow: &Number| duration.clone().map(|duration| flow.clone() * duration);
            history.ecdt.add(step(&current), self.cell("area"));
            history.sjdt.add(step(&heat), self.cell("area"));
            history.current = Some((time, rounded));
            &*history
        });
        self.give(["ECD", "ECDA", "ECDT", "ECDTA"], &current, integrals.map(|of| &of.ecdt), results);
        self.give(["SJD", "SJDA", "SJDT", "SJDTA"], &heat, integrals.map(|of| &of.sjdt), results);
        let weight = Number::of(self.heat()[1]);
        results.insert("heat_s", weight.clone() * heat.clone());
        results.insert("heat_m", (Number::of(1.0) + -weight) * heat.clone());
        Some(heat)
    }

    /// The thermal law, given the heat of the current (H-02 to H-06).
    fn thermal(&self, of_current: Option<Number>, history: Option<&mut History>, results: &mut Results) {
        let (judge, of) = (self.judge, self.judge.of);
        let has_conduction = of.thermal != [None, None];
        let conducts = has_conduction && judge.can_conduct(&of.thermal, Tail::Zero);
        let has_sides = judge.has("temp_s") && judge.has("temp_m");
        let is_told_closed = (judge.has("pressure") || judge.has("closed")) && judge.never_open;
        let radiates = of.radiation.is_some() && has_sides && (is_told_closed || judge.has("clearance"));
        let tells_of_friction = of.has_friction || of.heat.is_some() || has_conduction || of.radiation.is_some();
        let rubs = tells_of_friction && judge.has("shear") && judge.has("slip_rate");
        if !(conducts || radiates || rubs) {
            return;
        }
        let mut known = has_conduction == conducts && of.radiation.is_some() == radiates;
        known &= !conducts || has_sides || judge.has("temp_jump");
        let difference = self.difference(["temp_jump", "temp_s", "temp_m"]);
        let conduction = if conducts { self.conduction(difference.as_ref(), results) } else { Some(Number::zero()) };
        let radiation = if radiates { self.radiation(difference.as_ref(), results) } else { Some(Number::zero()) };
        let friction = if rubs { self.friction() } else { Some(Number::zero()) };
        let current = match self.has_current() {
            Some(true) => of_current,
            Some(false) => Some(Number::zero()),
            None => {
                known = false;
                None
            }
        };
        let mut history = history;
        if let (true, Some(rubbed)) = (rubs, &friction) {
            let integral = history.as_deref_mut().map(|history| {
                let before = history.rubbed.replace(self.row.cells["time"]);
                history.sfdrt.add(self.step(before, rubbed), self.cell("area"));
                &history.sfdrt
            });
            self.give(["SFDR", "SFDRA", "SFDRT", "SFDRTA"], rubbed, integral, results);
        }
        let parts = (|| Some((conduction?, radiation?, friction? + current?)))();
        let Some((conduction, radiation, generated)) = parts.filter(|_| known) else { return };
        let weight = Number::of(self.heat()[1]);
        let leaving = conduction.clone() + radiation.clone() + -(weight.clone() * generated.clone());
        results.insert("total_heat_s", -leaving.clone());
        results.insert("total_heat_m", conduction + radiation + (Number::of(1.0) + -weight) * generated);
        let integral = history.map(|history| {
            let before = history.heat.replace(self.row.cells["time"]);
            history.htl.add(self.step(before, &leaving), self.cell("area"));
            &history.htl
        });
        self.give(["HFL", "HFLA", "HTL", "HTLA"], &leaving, integral, results);
    }

    /// A flow over the increment since `before`.
    fn step(&self, before: Option<f64>, flow: &Number) -> Option<Number> {
        before.map(|before| flow.clone() * Number::of(self.row.cells["time"] - before))
    }

    fn conduction(&self, difference: Option<&Number>, results: &mut Results) -> Option<Number> {
        let conductance = self.conductance(&self.judge.of.thermal, Tail::Zero)?;
        results.insert("thermal_conductance", conductance.clone());
        let heat = conductance * difference?.clone();
        results.insert("heat_conduction", heat.clone());
        Some(heat)
    }

    fn radiation(&self, difference: Option<&Number>, results: &mut Results) -> Option<Number> {
        let rows: Rows = self.judge.of.radiation.iter().flatten().map(|row| vec![row[0], row[1], 0.0]).collect();
        let clearance = if self.closed { 0.0 } else { self.cell("clearance")?.max(0.0) };
        let view_factor = Number::new(value_of(&rows, clearance, 0.0, Tail::Zero));
        let zero = self.judge.scene.absolute_zero;
        let absolute = |name| Some(Number::new(exact(self.cell(name)?) - exact(zero)));
        let (a, b) = (absolute("temp_s")?, absolute("temp_m")?);
        let powers = (a.clone() * a.clone() + b.clone() * b.clone()) * (a + b) * difference?.clone();
        let heat = Number::of(self.judge.scene.stefan_boltzmann) * view_factor * powers;
        results.insert("heat_radiation", heat.clone());
        Some(heat)
    }

    /// The heat of friction; surfaces that are apart do not rub.
    fn friction(&self) -> Option<Number> {
        if !self.closed {
            return Some(Number::zero());
        }
        Some(Number::of(self.heat()[0]) * Number::of(self.cell("shear")?) * Number::of(self.cell("slip_rate")?))
    }

    /// Whether current generates heat; `None` where it may and nobody knows how much.
    fn has_current(&self) -> Option<bool> {
        let (judge, of) = (self.judge, self.judge.of);
        if of.electrical == [None, None] {
            return Some(false);
        }
        let has_jump = judge.has("epot_jump") || (judge.has("epot_s") && judge.has("epot_m"));
        if judge.can_conduct(&of.electrical, Tail::Constant) && has_jump {
            return Some(true);
        }
        // Procedures of which none solves for a current.
        (judge.scene.electrical.is_none() && judge.scene.pore.is_some()).then_some(false)
    }

    /// The pore fluid law (section 3, Q-37).
    fn pore(&self, history: Option<&mut History>, results: &mut Results) {
        let (judge, of) = (self.judge, self.judge.of);
        let without = Pore::default();
        let law = match (&of.pore, judge.scene.pore) {
            (Some(law), _) => law,
            (None, Some(_)) => &without,
            (None, None) => return,
        };
        let depends = law.table.as_ref().is_some_and(|rows| depends_on_x(rows, Tail::Constant));
        let lacks_pressure = depends && !judge.never_closed && !judge.has("pressure");
        if !(judge.has("por_s") && judge.has("por_m") && judge.has("clearance")) || lacks_pressure {
            return;
        }
        let (Some(slave), Some(master), Some(d)) = (self.cell("por_s"), self.cell("por_m"), self.cell("clearance"))
        else {
            return;
        };
        let pressure = if self.closed { self.cell("pressure") } else { Some(0.0) };
        if depends && pressure.is_none() {
            return;
        }
        let within = |cutoff: Option<f64>| match cutoff.or_else(|| self.cell("char_length")) {
            Some(cutoff) => Some(d <= cutoff),
            None => (d <= 0.0).then_some(true),
        };
        let across = match (within(law.cutoff_across), &law.table) {
            (Some(false), _) => Some((Some(Number::zero()), Number::zero())),
            (Some(true), Some(rows)) => {
                let k =
                    Number::new(value_of(rows, pressure.unwrap_or(0.0), f64::midpoint(slave, master), Tail::Constant));
                Some((Some(k.clone()), k * Number::new(exact(master) - exact(slave))))
            }
            (Some(true), None) => self.cell("q_across").map(|flow| (None, Number::of(flow))),
            (None, _) => None,
        };
        if let Some((permeability, _)) = &across {
            results.extend(permeability.clone().filter(|_| law.table.is_some()).map(|k| ("permeability", k)));
        }
        let across = across.map(|(_, flow)| flow);
        let before = history.as_ref().and_then(|history| history.gap);
        let half = Number::of(0.5);
        let filled = self.filling(law, d, before).map(|(rate, change)| (half.clone() * -rate, half * -change));
        results.extend(across.clone().map(|flow| ("q_across", flow)));
        results.extend(filled.iter().flat_map(|(flow, _)| ["q_gap_s", "q_gap_m"].map(|name| (name, flow.clone()))));
        let both = across.zip(filled);
        let leaving = both.as_ref().map(|(across, (gap, _))| -(across.clone() + gap.clone()));
        if let Some((across, (gap, _))) = &both {
            results.insert("q_s", across.clone() + gap.clone());
            results.insert("q_m", gap.clone() + -across.clone());
        }
        let area = self.cell("area");
        let integral = history.and_then(|history| {
            let time = self.row.cells["time"];
            history.gap = Some((time, d));
            let step = match (before, &both) {
                (None, _) => Some(None),
                (Some((before, _)), Some((across, (_, change)))) => {
                    Some(Some(-(across.clone() * Number::of(time - before)) + -change.clone()))
                }
                (Some(_), None) => None,
            };
            match step {
                Some(step) => history.ptl.iter_mut().for_each(|ptl| ptl.add(step.clone(), area)),
                None => history.ptl = None,
            }
            history.ptl.as_ref()
        });
        if let Some(leaving) = &leaving {
            results.insert("PFL", leaving.clone());
            results.extend(area.map(|area| ("PFLA", leaving.clone() * Number::of(area))));
        }
        if let Some(integral) = integral {
            results.insert("PTL", integral.per_area.clone());
            results.extend(integral.whole.clone().map(|whole| ("PTLA", whole)));
        }
    }

    /// The rate of the filled gap and its change over the increment that began at a time and a clearance; `None` where a cutoff decides that is not known.
    fn filling(&self, law: &Pore, d: f64, before: Option<(f64, f64)>) -> Option<(Number, Number)> {
        let cutoff = law.cutoff_fill.or_else(|| self.cell("char_length"));
        let duration = before.map(|(before, _)| Number::of(self.row.cells["time"] - before));
        let nothing = (Number::zero(), Number::zero());
        if self.judge.scene.pore != Some(Regime::Transient) {
            return Some(nothing);
        }
        if let Some(rate) = self.cell("clearance_rate") {
            let counts = match cutoff {
                _ if rate == 0.0 => false,
                None if 0.0 < d => return None,
                Some(cutoff) if cutoff < d => false,
                _ => 0.0 < d || (d == 0.0 && 0.0 < rate),
            };
            let rate = Number::of(if counts { rate } else { 0.0 });
            let change = duration.map_or_else(Number::zero, |duration| rate.clone() * duration);
            return Some((rate, change));
        }
        let Some(((_, before), duration)) = before.zip(duration) else { return Some(nothing) };
        let (start, end) = (before.max(0.0), d.max(0.0));
        let change = match cutoff {
            _ if start == end => Number::zero(),
            Some(cutoff) => Number::new(exact(end.min(cutoff)) - exact(start.min(cutoff))),
            None => return None,
        };
        let per_time = Number { value: duration.value.recip(), scale: duration.scale.recip() };
        Some((change.clone() * per_time, change))
    }
}
