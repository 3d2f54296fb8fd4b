//! Parts of a deck to be drawn, and the ranges of their axes.

use super::law::Law;
use super::rows::{LawRows, Rows};
use super::{LawKind, Side, Units};
use inpact_evaluation::law::InterfaceLaws;
use inpact_evaluation::plan::Choices;
use inpact_parser::model::{Interaction, Model, Name};
use std::collections::HashMap;

/// The end of an axis, as a multiple of the last abscissa.
const BEYOND: f64 = 1.15;

/// The parts to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// The interactions; all where there is none.
    pub interactions: Vec<Name>,
    /// The laws; all where there is none.
    pub laws: Vec<LawKind>,
    /// Variables by the names of their columns, fixed at these values.
    pub at: Vec<(String, f64)>,
    /// The names of units.
    pub units: Units,
    /// Points that the axes of a law must include besides its rows.
    pub held_places: Vec<HeldPlace>,
    /// The number of values of a curve.
    pub detail: Detail,
    /// The maximum number of panels of a deck.
    pub most_panels: usize,
    /// Whether values at other temperatures and field variables are computed as well.
    pub probing: Probing,
}

impl Default for Request {
    /// All laws of all interactions, at the abscissae of their rows.
    fn default() -> Self {
        Self {
            interactions: Vec::new(),
            laws: Vec::new(),
            at: Vec::new(),
            units: Units::default(),
            held_places: Vec::new(),
            detail: Detail::Rows,
            most_panels: 40,
            probing: Probing::Off,
        }
    }
}

/// A point that the axes of a law must include.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldPlace {
    /// The interaction.
    pub interaction: Name,
    /// Its law.
    pub law: LawKind,
    /// On which side of contact.
    pub side: Side,
    /// Clearance or contact pressure.
    pub x: f64,
}

/// Values of panels for sliders.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Probing {
    /// They have none.
    Off,
    /// They have.
    On,
}

/// The number of points at which curves are evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Detail {
    /// At the abscissae of the rows: enough for linear axes.
    Rows,
    /// At least at this number of points, evenly between the rows.
    Even(usize),
    /// The same, evenly on a logarithmic axis.
    Geometric(usize),
}

/// The ends of the axes of a law.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Extents {
    pub(super) open: Option<f64>,
    pub(super) closed: Option<(f64, f64)>,
}

/// The ends of the axes of each law by the name of its interaction, which are the same in all decks.
pub(super) fn extents(
    decks: &[(&str, &Model)],
    choices: &Choices,
    request: &Request,
) -> HashMap<(String, LawKind), Extents> {
    let mut extents: HashMap<(String, LawKind), Extents> = HashMap::new();
    for (_, model) in decks {
        for interaction in request.interactions_of(model).take(request.most_panels) {
            let laws = InterfaceLaws::of(model, interaction, choices);
            for kind in request.kinds() {
                let rows = LawRows::of(model, interaction, kind);
                let of = extents.entry((interaction.name.canonical().to_owned(), kind)).or_default();
                of.widen(&rows, Law::of(&laws, kind, choices.characteristic_length));
            }
        }
    }
    for place in &request.held_places {
        let key = (place.interaction.canonical().to_owned(), place.law);
        match (place.side, extents.get_mut(&key)) {
            (Side::Open, Some(Extents { open: Some(end), .. }))
            | (Side::Closed, Some(Extents { closed: Some((_, end)), .. }))
                if *end < place.x =>
            {
                *end = place.x;
            }
            (Side::Closed, Some(Extents { closed: Some((start, _)), .. })) if place.x < *start => *start = place.x,
            _ => {}
        }
    }
    extents
}

impl Request {
    pub(super) fn kinds(&self) -> impl Iterator<Item = LawKind> {
        LawKind::ALL.into_iter().filter(|kind| self.laws.is_empty() || self.laws.contains(kind))
    }

    pub(super) fn interactions_of<'m>(&'m self, model: &'m Model) -> impl Iterator<Item = &'m Interaction> {
        let is_meant =
            |interaction: &&Interaction| self.interactions.is_empty() || self.interactions.contains(&interaction.name);
        model.interactions.values().filter(is_meant)
    }
}

impl Extents {
    fn widen(&mut self, rows: &LawRows<'_>, law: Option<Law<'_>>) {
        let greater = |a: f64, b: f64| if a < b { b } else { a };
        let beyond = |greatest: f64| {
            let end = greatest * BEYOND;
            if 0.0 < end { greater(greatest, end.min(f64::MAX)) } else { 1.0 }
        };
        let of_rows = rows.open.as_ref().and_then(Rows::range).map(|(_, greatest)| beyond(greatest));
        let of_cutoff = law.and_then(Law::cutoff).map(|cutoff| if 0.0 < cutoff { 1.5 * cutoff } else { 1.0 });
        for end in of_rows.into_iter().chain(of_cutoff) {
            self.open = Some(self.open.map_or(end, |known| greater(known, end)));
        }
        if let Some((least, greatest)) = rows.closed.as_ref().and_then(Rows::range) {
            let (start, end) = (least.min(0.0), beyond(greatest));
            let known = self.closed.unwrap_or((start, end));
            self.closed = Some((known.0.min(start), greater(known.1, end)));
        }
    }
}
