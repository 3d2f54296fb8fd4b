//! A scene as TOML, with a head comment that names its sources.

use super::network_field;
use super::terminals::Terminal;
use crate::commands::joule_heat::{JOULE_HEAT_FRACTION, JouleHeats};
use crate::report::Input;
use crate::terminals::{Film, Stated, StepTime};
use crate::text::toml_text;
use inpact_body::{BodyField, Lumped};
use inpact_contact::Interfaces;
use inpact_evaluation::nodes::{Column, Part};
use inpact_network::scene::{Course, Field};
use inpact_parser::model::{Procedure, Regime};
use inpact_parser::number::read_float;
use std::collections::BTreeSet;

/// Conductances below this fraction of the largest may be rounding.
const ROUNDING: f64 = 1e-12;

/// The sources of a scene.
pub(super) struct Head {
    pub(super) inputs: Vec<Input>,
    pub(super) command: String,
}

/// The scene without its head.
pub(super) struct SceneText {
    pub(super) written: String,
    regime: Regime,
    /// Films of terminals: the node, and the film.
    films: Vec<(String, Film)>,
}

impl Head {
    pub(super) fn written(&self, not_taken: &[String], missing: &[String], lumping: &[String]) -> String {
        let mut text = format!(
            "# A scene made from a deck by inpact {}: {}\n#\n",
            env!("CARGO_PKG_VERSION"),
            comment(&self.command)
        );
        for input in &self.inputs {
            let hash =
                input.hash.as_ref().map_or_else(|| "read from a stream".to_owned(), |hash| format!("sha256 {hash}"));
            text += &format!("# {}: {hash}\n", comment(&input.name));
        }
        for (title, lines) in [
            ("Not taken over", not_taken),
            ("Missing, because the deck does not say it", missing),
            ("Lumping", lumping),
        ] {
            if !lines.is_empty() {
                text += &format!("#\n# {title}:\n");
                for line in lines {
                    text += &format!("#   {}\n", comment(line));
                }
            }
        }
        text + "\n"
    }
}

impl SceneText {
    pub(super) fn new(deck: &str, regime: Regime, time: StepTime, procedure: Option<&Procedure>) -> Self {
        let mut written = format!("deck = {}\n", toml_text(deck));
        if regime == Regime::Transient {
            written += &format!("procedure = \"transient\"\n\n[time]\nend = {:?}\n", time.period);
            // Fixed increments are in the deck, automatic ones are chosen by the solver.
            if let Some(step) = procedure.and_then(given_increment) {
                written += &format!("step = {step:?}\n");
            }
        }
        Self { written, regime, films: Vec::new() }
    }

    /// The nodes, with their conditions and capacities.
    pub(super) fn nodes(&mut self, terminals: &[Terminal], stated: &[Stated], lumped: &[Lumped]) {
        let thermal = lumped.iter().find(|lumped| lumped.field == BodyField::Thermal);
        let capacity_of = |at: usize| thermal.and_then(|lumped| lumped.capacities[at]);
        let regime = self.regime;
        for (at, (terminal, stated)) in terminals.iter().zip(stated).enumerate() {
            let name = terminal.name.written();
            self.node(name, |field| {
                let index = field.index();
                let is_fixed = stated.fixed[index].is_some();
                let mut keys = Vec::new();
                if let Some(fixed) = &stated.fixed[index] {
                    keys.push(format!("fixed = {}", course(fixed)));
                } else if let Some(source) = &stated.source[index] {
                    keys.push(format!("source = {}", course(source)));
                }
                if regime == Regime::Transient && !is_fixed {
                    let capacity = capacity_of(at).filter(|_| field == Field::Temperature);
                    keys.extend(capacity.map(|capacity| format!("capacity = {capacity:?}")));
                    keys.extend(stated.initial[index].map(|initial| format!("initial = {initial:?}")));
                }
                keys
            });
            self.films.extend(stated.films.iter().map(|film| (name.to_owned(), film.clone())));
        }
        for (number, (node, film)) in (1..).zip(std::mem::take(&mut self.films)) {
            let sink = format!("{node} film {number}");
            self.node(&sink, |field| match field {
                Field::Temperature => vec![format!("fixed = {}", course(&film.sink))],
                _ => Vec::new(),
            });
            self.link(&node, &sink, &[format!("thermal = {:?}", film.conductance)]);
        }
    }

    fn node(&mut self, name: &str, keys: impl Fn(Field) -> Vec<String>) {
        let mut text = format!("\n[[node]]\nname = {}\n", toml_text(name));
        for field in Field::ALL {
            let keys = keys(field);
            if !keys.is_empty() {
                text += &format!("{} = {{ {} }}\n", field.key(), keys.join(", "));
            }
        }
        self.written += &text;
    }

    /// The conductances of the bodies; negative ones, which a network rejects, are reported.
    pub(super) fn links(
        &mut self,
        terminals: &[Terminal],
        lumped: &[Lumped],
        heats: &JouleHeats,
        unplaced: &mut Vec<String>,
    ) {
        let roundings: Vec<f64> = lumped.iter().map(|of| ROUNDING * of.isothermal.largest()).collect();
        let within = |of: &Lumped| of.isothermal.within_bodies().map(|(a, b, _)| (a, b)).collect::<Vec<_>>();
        // A body may be left out in one field only.
        let pairs: BTreeSet<(usize, usize)> = lumped.iter().flat_map(within).collect();
        for (a, b) in pairs {
            let (first, second) = (&terminals[a].name, &terminals[b].name);
            let mut keys = Vec::new();
            for (of, &rounding) in lumped.iter().zip(&roundings) {
                let (conductance, key) = (of.isothermal.between(a, b), network_field(of.field).conductance_key());
                if conductance < -rounding {
                    unplaced.push(format!(
                        "the {key} conductance between `{first}` and `{second}`, {conductance:?}: a network has none below zero"
                    ));
                } else if rounding < conductance {
                    keys.push(format!("{key} = {conductance:?}"));
                }
            }
            let electrical = Field::Potential.conductance_key();
            if let Some(share) = heats.share(a).filter(|_| keys.iter().any(|key| key.starts_with(electrical))) {
                keys.push(format!("{JOULE_HEAT_FRACTION} = {share:?}"));
            }
            if !keys.is_empty() {
                self.link(first.written(), second.written(), &keys);
            }
        }
    }

    fn link(&mut self, first: &str, second: &str, keys: &[String]) {
        let names = [first, second].map(toml_text).join(", ");
        self.written += &format!("\n[[link]]\nnodes = [{names}]\n{}\n", keys.join("\n"));
    }

    /// The contact pairs, one interface each, with its area.
    pub(super) fn interfaces(&mut self, interfaces: &Interfaces, areas: &[Option<f64>]) {
        for (pair, area) in interfaces.pairs.iter().zip(areas) {
            let Some((lumped, area)) = interfaces.lumped(pair).zip(*area) else { continue };
            let [interaction, slave, master] =
                [&pair.interaction, &pair.slave, &pair.master].map(|name| toml_text(name.written()));
            let mut text = format!(
                "\n[[interface]]\ninteraction = {interaction}\nslave = {slave}\nmaster = {master}\narea = {area:?}\n"
            );
            let mut fields: Vec<(u32, f64)> = Vec::new();
            for (quantity, mean) in interfaces.quantities.iter().zip(&lumped.means) {
                let Some(mean) = mean else { continue };
                match *quantity {
                    Column::FieldVariable(number, Part::Both) => fields.push((number, mean.mean)),
                    // Nodes have temperatures of their own.
                    Column::Temperature(_) => {}
                    quantity => text += &format!("{quantity} = {:?}\n", mean.mean),
                }
            }
            fields.sort_by_key(|(number, _)| *number);
            if fields.iter().zip(1..).all(|((number, _), place)| *number == place) && !fields.is_empty() {
                let values: Vec<String> = fields.iter().map(|(_, value)| format!("{value:?}")).collect();
                text += &format!("fv = [{}]\n", values.join(", "));
            }
            self.written += &text;
        }
    }
}

/// The length of every increment, where the deck says one: DIRECT.
fn given_increment(procedure: &Procedure) -> Option<f64> {
    procedure.option.parameter("DIRECT")?;
    let first = procedure.option.rows.iter().next()?.into_iter().next()?;
    read_float(first.trim().as_bytes()).ok().filter(|step| 0.0 < *step)
}

fn course(course: &Course) -> String {
    match course.points() {
        [[_, value]] => format!("{value:?}"),
        points => {
            let points: Vec<String> = points.iter().map(|[time, value]| format!("[{time:?}, {value:?}]")).collect();
            format!("[{}]", points.join(", "))
        }
    }
}

/// A text in a comment, which ends with its line and has no control characters.
fn comment(text: &str) -> String {
    text.chars().map(|character| if character.is_control() { '\u{FFFD}' } else { character }).collect()
}
