//! From a model to its panels: laws, the variable that distinguishes curves, and fixed values of the others.

use super::law::Law;
use super::probe::probe;
use super::request::{Extents, Probing, Request, extents};
use super::rows::LawRows;
use super::sample::{self, sort_and_dedup, spread, thinned, thinned_together};
use super::{Branch, Curve, Figure, Half, Held, Knot, LawKind, Panel, Quantity, Reach, Sample, Side, number};
use inpact_evaluation::law::{FlowOf, InterfaceLaws};
use inpact_evaluation::plan::{Choices, Reason};
use inpact_parser::grammar::Grammar;
use inpact_parser::model::{Interaction, Model};
use std::collections::HashMap;

const MAX_CURVES: usize = 24;

/// The maximum number of panels of one law.
const MAX_MULTIPLES: usize = 6;

/// The maximum number of lines about parts not drawn.
const MAX_NOTES: usize = 20;

/// The maximum number of abscissae of a side common to all curves of a panel, for reading all of them on hover.
const MAX_SHARED: usize = 400;

/// The maximum number of values from which these are chosen.
const MAX_CHOSEN_FROM: usize = 200_000;

/// The panels of one deck.
pub fn figure(deck: (&str, &Model), grammar: &Grammar, choices: &Choices, request: &Request) -> Figure {
    figures(&[deck], grammar, choices, request).pop().unwrap_or_default()
}

/// The panels of several decks: those of one law have the same axes in all of them.
pub fn figures(decks: &[(&str, &Model)], grammar: &Grammar, choices: &Choices, request: &Request) -> Vec<Figure> {
    let extents = extents(decks, choices, request);
    let builder = Builder { grammar, choices, request, extents: &extents };
    decks.iter().map(|(name, model)| builder.figure(name, model)).collect()
}

struct Builder<'a> {
    grammar: &'a Grammar,
    choices: &'a Choices,
    request: &'a Request,
    extents: &'a HashMap<(String, LawKind), Extents>,
}

/// A law of one interaction, with the data shared by its panels.
struct Subject<'a> {
    interaction: &'a Interaction,
    kind: LawKind,
    rows: &'a LawRows<'a>,
    law: Option<Law<'a>>,
    sides: [sample::Side<'a>; 2],
    /// The variables after the abscissa, each with its values.
    variables: Vec<Variable>,
    fault: Option<String>,
}

struct Variable {
    quantity: Quantity,
    values: Vec<f64>,
    /// The value that the user chose.
    chosen: Option<f64>,
}

impl Builder<'_> {
    fn figure(&self, name: &str, model: &Model) -> Figure {
        let mut figure = Figure { deck: name.to_owned(), ..Figure::default() };
        let mut left = 0_usize;
        let mut silent = 0_usize;
        for interaction in self.request.interactions_of(model) {
            let rows = self.request.kinds().map(|kind| (kind, LawRows::of(model, interaction, kind)));
            let rows: Vec<_> = rows.collect();
            if self.request.most_panels <= figure.panels.len() {
                left += rows.iter().filter(|(_, rows)| !rows.is_empty()).count();
                continue;
            }
            let laws = InterfaceLaws::of(model, interaction, self.choices);
            for (kind, rows) in &rows {
                match self.subject(interaction, *kind, rows, &laws) {
                    Ok(subject) => figure.panels.extend(self.panels(&subject)),
                    Err(None) => {}
                    Err(Some(_)) if MAX_NOTES <= figure.notes.len() => silent += 1,
                    Err(Some(why)) => {
                        figure.notes.push(format!("{} of `{}`: {why}", kind.name(), interaction.name));
                    }
                }
            }
        }
        if 0 < silent {
            figure.notes.push(format!("{silent} more laws are not drawn for such reasons"));
        }
        if 0 < left {
            let drawn = self.request.most_panels;
            figure.notes.push(format!(
                "{drawn} panels are drawn and {left} laws are not: choose some with `--interaction` and `--law`"
            ));
        }
        let mut tables = Vec::new();
        if !self.request.at.is_empty() {
            tables.extend(model.interactions.values().flat_map(Interaction::tables));
        }
        let is_known = |column: &str| tables.iter().any(|of| of.table.column(column).is_some());
        for (column, _) in self.request.at.iter().filter(|(column, _)| !is_known(column)) {
            figure.notes.push(format!("no table of the deck depends on `{column}`"));
        }
        figure
    }

    /// A law with something to draw; otherwise the reason, if any.
    fn subject<'a>(
        &self,
        interaction: &'a Interaction,
        kind: LawKind,
        rows: &'a LawRows<'a>,
        laws: &'a InterfaceLaws,
    ) -> Result<Subject<'a>, Option<String>> {
        let law = Law::of(laws, kind, self.choices.characteristic_length);
        let reason = why_not(interaction, kind, laws);
        if rows.is_empty() || (rows.closed.is_none() && rows.open.as_ref().is_some_and(|rows| rows.count() == 0)) {
            return Err(reason);
        }
        if law.is_none() && !matches!(&reason, Some(reason) if reason.contains("its rows form")) {
            return Err(reason);
        }
        let variables = rows.variables().iter().map(|column| Variable {
            quantity: self.request.units.quantity(self.grammar, kind.keyword(), column),
            values: rows.distinct(column),
            chosen: self.request.at.iter().rfind(|(named, _)| named == column).map(|(_, at)| *at),
        });
        Ok(Subject {
            interaction,
            kind,
            rows,
            law,
            sides: Side::BOTH.map(|side| sample::Side::of(rows.side(side))),
            variables: variables.collect(),
            fault: if law.is_some() { None } else { reason },
        })
    }

    fn panels(&self, subject: &Subject<'_>) -> Vec<Panel> {
        let is_free = |variable: &Variable| variable.chosen.is_none() && 1 < variable.values.len();
        let all = &subject.variables;
        let free: Vec<usize> = (0..all.len()).filter(|index| is_free(&all[*index])).collect();
        let is_temperature = |index: &&usize| all[**index].quantity.column == "temp";
        let family = free.iter().find(is_temperature).or(free.first()).copied();
        let multiple = free.iter().copied().find(|index| Some(*index) != family);
        let places = multiple.map_or_else(
            || vec![None],
            |multiple| spread(&all[multiple].values, MAX_MULTIPLES).into_iter().map(Some).collect(),
        );
        let mut panels = Vec::new();
        for place in places {
            let at = |(index, variable): (usize, &Variable)| {
                let place = place.filter(|_| Some(index) == multiple);
                variable.chosen.or(place).or(variable.values.first().copied()).unwrap_or(0.0)
            };
            let variables: Vec<f64> = all.iter().enumerate().map(at).collect();
            let is_held =
                |index: usize| Some(index) != family && (1 < all[index].values.len() || all[index].chosen.is_some());
            let held = (0..all.len()).filter(|index| is_held(*index)).map(|index| {
                let of = all[index].values.len();
                let drawn = if Some(index) == multiple { MAX_MULTIPLES } else { 1 };
                let (quantity, left_out) = (all[index].quantity.clone(), of.saturating_sub(drawn));
                Held { quantity, at: variables[index], of, left_out }
            });
            let family = family.map(|index| (index, &all[index]));
            panels.push(self.panel(subject, &variables, family, held.collect()));
        }
        if let (Some(law), Some(first), Probing::On) = (subject.law, panels.first_mut(), self.request.probing) {
            let movable = free.iter().map(|index| (*index, &all[*index].quantity, all[*index].values.as_slice()));
            let movable: Vec<_> = movable.collect();
            let variables: Vec<f64> =
                all.iter().map(|of| of.chosen.or(of.values.first().copied()).unwrap_or(0.0)).collect();
            let halves = [first.open.clone(), first.closed.clone()];
            first.probe = probe(law, &subject.sides, &halves, &variables, &movable);
            let branches = first.probe.iter().flat_map(|probe| &probe.branches);
            let counts = branches.map(|of| Shared { kept: of.abscissae.len(), all: of.all_abscissae });
            let most = counts.max_by_key(|of| of.all - of.kept).unwrap_or_default();
            first.notes.extend(most.note().map(|note| format!("sliders: {note}")));
        }
        panels
    }

    fn panel(
        &self,
        subject: &Subject<'_>,
        variables: &[f64],
        family: Option<(usize, &Variable)>,
        held: Vec<Held>,
    ) -> Panel {
        let halves = Side::BOTH.map(|side| self.half(subject, side));
        let first = subject.rows.open.as_ref().or(subject.rows.closed.as_ref());
        let column = first.and_then(|rows| rows.columns.first()).map_or("", String::as_str);
        let mut value = self.request.units.quantity(self.grammar, subject.kind.keyword(), column);
        subject.kind.name().clone_into(&mut value.name);
        let mut shared = Shared::default();
        let (curves, all_curves) = if subject.law.is_some() {
            let places =
                family.map_or_else(|| vec![None], |(_, family)| family.values.iter().copied().map(Some).collect());
            let places_drawn = spread(&places, MAX_CURVES);
            let variables_at = |at: &Option<f64>| {
                let mut variables = variables.to_vec();
                if let (Some(at), Some((index, _))) = (at, family) {
                    variables[index] = *at;
                }
                variables
            };
            let variables: Vec<Vec<f64>> = places_drawn.iter().map(variables_at).collect();
            let [open, closed] = [0, 1].map(|side| {
                let abscissae =
                    variables.iter().map(|variables| self.abscissae(subject, side, &halves[side], variables));
                match self.request.probing {
                    Probing::On => {
                        shared_branches(subject, side, abscissae.flatten().collect(), &variables, &mut shared)
                    }
                    Probing::Off => {
                        let each = abscissae.zip(&variables);
                        each.map(|(abscissae, variables)| branch(subject, side, abscissae, variables)).collect()
                    }
                }
            });
            let curves = places_drawn.iter().zip(open.into_iter().zip(closed));
            let curves = curves.map(|(at, (open, closed))| Curve { at: *at, open, closed });
            (curves.collect::<Vec<_>>(), places.len())
        } else {
            as_written(subject)
        };
        let [open, closed] = halves;
        let mut panel = Panel {
            interaction: subject.interaction.name.written().to_owned(),
            law: subject.kind,
            value,
            family: family.map(|(_, family)| family.quantity.clone()),
            held,
            open,
            closed,
            curves,
            all_curves,
            fault: subject.fault.clone(),
            probe: None,
            marks: Vec::new(),
            nodes: None,
            notes: Vec::new(),
        };
        panel.notes = notes(subject, &panel);
        panel.notes.extend(shared.note());
        panel
    }

    fn half(&self, subject: &Subject<'_>, side: Side) -> Half {
        let key = (subject.interaction.name.canonical().to_owned(), subject.kind);
        let extents = self.extents.get(&key).copied().unwrap_or_default();
        let column = match side {
            Side::Open => "clearance",
            Side::Closed => "pressure",
        };
        let keyword = match subject.kind {
            // *CONTACT PERMEABILITY depends on the clearance only by its cutoffs.
            LawKind::Permeability | LawKind::ViewFactor => LawKind::Thermal.keyword(),
            kind => kind.keyword(),
        };
        let ends = match side {
            Side::Open => extents.open.map(|end| (0.0, end)),
            Side::Closed => extents.closed,
        };
        let (start, end) = ends.unwrap_or((0.0, 1.0));
        Half {
            quantity: self.request.units.quantity(self.grammar, keyword, column),
            start,
            end,
            has_scale: ends.is_some(),
            rows: subject.rows.side(side).map(super::rows::Rows::count),
        }
    }

    /// Where a curve is evaluated.
    fn abscissae(&self, subject: &Subject<'_>, side: usize, half: &Half, variables: &[f64]) -> Vec<f64> {
        let is_open = Side::BOTH[side] == Side::Open;
        let jumps: Vec<f64> = subject.law.and_then(Law::cutoff).filter(|_| is_open).into_iter().collect();
        subject.sides[side].abscissae(variables, (half.start, half.end), &jumps, self.request.detail)
    }
}

/// A curve on one side of contact.
fn branch(subject: &Subject<'_>, side: usize, abscissae: Vec<f64>, variables: &[f64]) -> Branch {
    let samples = abscissae.into_iter().filter_map(|x| sample(subject, side, x, variables));
    with_knots(subject, side, thinned(samples.collect()), variables)
}

fn sample(subject: &Subject<'_>, side: usize, x: f64, variables: &[f64]) -> Option<Sample> {
    let value = subject.law?.value(Side::BOTH[side], x, variables)?;
    Some(Sample { x, y: value.y, reach: value.reach })
}

fn with_knots(subject: &Subject<'_>, side: usize, samples: Vec<Sample>, variables: &[f64]) -> Branch {
    let of = &subject.sides[side];
    let (knots, knot_count) = of.knots(of.group(variables));
    Branch { knots, knot_count, samples }
}

/// The number of abscissae of a panel's curves that are kept.
#[derive(Default)]
struct Shared {
    kept: usize,
    all: usize,
}

impl Shared {
    fn note(&self) -> Option<String> {
        let Self { kept, all } = self;
        (kept < all).then(|| format!("{kept} of {all} abscissae, those where a curve bends most among them"))
    }
}

/// All curves on one side of contact at the same abscissae.
fn shared_branches(
    subject: &Subject<'_>,
    side: usize,
    mut abscissae: Vec<f64>,
    variables: &[Vec<f64>],
    shared: &mut Shared,
) -> Vec<Branch> {
    sort_and_dedup(&mut abscissae);
    shared.all += abscissae.len();
    let abscissae = spread(&abscissae, MAX_CHOSEN_FROM / variables.len().max(1));
    let samples = variables.iter().map(|of| abscissae.iter().map(|x| sample(subject, side, *x, of)).collect());
    let samples: Vec<Vec<Option<Sample>>> = samples.collect();
    let values = samples.iter().map(|of| of.iter().map(|sample| sample.map(|sample| sample.y)).collect());
    let kept = thinned_together(&abscissae, &values.collect::<Vec<_>>(), MAX_SHARED);
    shared.kept += kept.len();
    let branches = samples.iter().zip(variables).map(|(samples, variables)| {
        let samples = kept.iter().filter_map(|index| samples[*index]);
        with_knots(subject, side, samples.collect(), variables)
    });
    branches.collect()
}

/// The reason why a law of the interaction has no values.
fn why_not(interaction: &Interaction, kind: LawKind, laws: &InterfaceLaws) -> Option<String> {
    let flow = match kind {
        LawKind::Electrical => FlowOf::Charge,
        LawKind::Thermal | LawKind::ViewFactor => FlowOf::Heat,
        LawKind::Permeability => FlowOf::PoreFluid,
    };
    if kind == LawKind::Permeability
        && interaction.contact_permeability.as_ref().is_some_and(|option| option.table.is_none())
    {
        return Some(Reason::InfinitePermeability.to_string());
    }
    let is_of_radiation = |what: &str| what.contains("radiation");
    let mut reasons = laws.left_out.iter().filter(|(of, left_out)| {
        *of == flow && (flow != FlowOf::Heat || is_of_radiation(&left_out.what) == (kind == LawKind::ViewFactor))
    });
    reasons.next().map(|(_, left_out)| left_out.reason.to_string())
}

fn notes(subject: &Subject<'_>, panel: &Panel) -> Vec<String> {
    let mut notes = Vec::new();
    if panel.curves.len() < panel.all_curves {
        notes.push(format!("{} of {} curves", panel.curves.len(), panel.all_curves));
    }
    for held in panel.held.iter().filter(|held| 0 < held.left_out) {
        let (column, of) = (&held.quantity.column, held.of);
        notes.push(format!("{column} = {} is one of {of} values: `--at {column}=…`", number(held.at)));
    }
    if subject.law.is_some_and(Law::needs_characteristic_length) {
        notes.push(
            "while open it has the value at pressure 0, up to the characteristic element length: `--char-length`"
                .to_owned(),
        );
    }
    let branches = panel.curves.iter().flat_map(|curve| [&curve.open, &curve.closed]);
    let unmarked: usize = branches.filter(|of| of.knots.is_empty()).map(|of| of.knot_count).sum();
    if 0 < unmarked {
        notes.push(format!("{unmarked} rows are not marked: too many to tell apart"));
    }
    notes
}

/// The rows of a law that cannot be evaluated, group by group in the order of the deck.
fn as_written(subject: &Subject<'_>) -> (Vec<Curve>, usize) {
    let mut curves = Vec::new();
    let mut count = 0;
    for (side, of) in Side::BOTH.into_iter().zip(&subject.sides) {
        for group in of.groups() {
            count += 1;
            if MAX_CURVES <= curves.len() {
                continue;
            }
            let Some(rows) = of.rows else { continue };
            let (knots, knot_count) = of.knots(Some(group.clone()));
            let points: Vec<Knot> = if knots.is_empty() {
                let knot = |row: usize| Knot { x: rows.row(row)[1], y: rows.row(row)[0], row };
                spread(&group.clone().collect::<Vec<_>>(), MAX_CURVES * 100).into_iter().map(knot).collect()
            } else {
                knots.clone()
            };
            let is_finite = |knot: &&Knot| knot.x.is_finite() && knot.y.is_finite();
            let samples =
                points.iter().filter(is_finite).map(|knot| Sample { x: knot.x, y: knot.y, reach: Reach::Within });
            let branch = Branch { knots, knot_count, samples: samples.collect() };
            let at = rows.row(group.start).get(2).copied().filter(|_| 1 < of.groups().len());
            curves.push(match side {
                Side::Open => Curve { at, open: branch, closed: Branch::default() },
                Side::Closed => Curve { at, open: Branch::default(), closed: branch },
            });
        }
    }
    (curves, count)
}
