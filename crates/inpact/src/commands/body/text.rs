//! Conductances and capacities as readable tables.

use super::Found;
use crate::text::{aligned, number_text};
use inpact_body::{Conductances, Lumped};

pub(super) fn text(found: &Found<'_>) -> String {
    let mut text = String::new();
    let names: Vec<&str> = found.body.terminals().iter().map(|terminal| terminal.name.written()).collect();
    for lumped in &found.lumped {
        let at = found.temperature.map_or(String::new(), |temperature| format!(" at {}", number_text(temperature)));
        text += &format!("{} conductances{at}, each terminal at one {}\n", lumped.field, value_of(lumped));
        text += &table(&matrix(&names, &lumped.isothermal));
        text += "\nwhat a terminal conducts to all others\n";
        text += &table(&terminals(lumped));
        text += &remarks(&names, lumped);
        text += "\nbodies\n";
        text += &table(&bodies(&names, lumped));
        text.push('\n');
    }
    text.truncate(text.trim_end().len());
    text + "\n"
}

fn value_of(lumped: &Lumped) -> &'static str {
    match lumped.field {
        inpact_body::BodyField::Thermal => "temperature",
        inpact_body::BodyField::Electrical => "potential",
    }
}

/// Seven digits, as printed by solvers, without trailing zeros.
pub(super) fn short(value: f64) -> String {
    format!("{value:.6e}").parse().map_or_else(|_| value.to_string(), number_text)
}

fn percent(share: f64) -> String {
    if share == 0.0 { "0 %".to_owned() } else { format!("{:.2} %", 100.0 * share) }
}

fn matrix(names: &[&str], conductances: &Conductances) -> Vec<Vec<String>> {
    let header = std::iter::once(String::new()).chain(names.iter().map(|name| (*name).to_owned()));
    let row = |a: usize| {
        let cell = |b: usize| if a == b { "-".to_owned() } else { short(conductances.between(a, b)) };
        std::iter::once(names[a].to_owned()).chain((0..names.len()).map(cell)).collect()
    };
    std::iter::once(header.collect()).chain((0..names.len()).map(row)).collect()
}

fn terminals(lumped: &Lumped) -> Vec<Vec<String>> {
    let of_value = value_of(lumped);
    let one = format!("at one {of_value}");
    let header = ["terminal", "nodes", "area", &one, "even flow", "apart", "range", "capacity"];
    let mut rows = vec![header.map(str::to_owned).to_vec()];
    for (at, terminal) in lumped.terminals.iter().enumerate() {
        let capacity = lumped.capacities[at].map_or("-".to_owned(), short);
        rows.push(vec![
            terminal.name.written().to_owned(),
            terminal.nodes.to_string(),
            terminal.area.map_or("-".to_owned(), short),
            short(terminal.upper),
            short(terminal.lower),
            percent(terminal.relative()),
            percent(terminal.range),
            capacity,
        ]);
    }
    rows
}

fn bodies(names: &[&str], lumped: &Lumped) -> Vec<Vec<String>> {
    let mut rows = vec![["nodes", "elements", "volume", "capacity", "apart", "terminals"].map(str::to_owned).to_vec()];
    for body in &lumped.bodies {
        let terminals: Vec<&str> = body.terminals.iter().map(|at| names[*at]).collect();
        rows.push(vec![
            body.nodes.to_string(),
            body.elements.to_string(),
            short(body.volume),
            body.capacity.map_or("-".to_owned(), short),
            percent(body.relative),
            terminals.join(", "),
        ]);
    }
    rows
}

/// The effect of the mesh on the maximum principle.
fn remarks(names: &[&str], lumped: &Lumped) -> String {
    let mut text = String::new();
    let largest = lumped.isothermal.largest();
    for (a, b, conductance) in lumped.isothermal.negative() {
        let share = percent(-conductance / largest);
        text += &format!(
            "the conductance of `{}` and `{}` is below zero, by {share} of the largest: the mesh is too coarse between them\n",
            names[a], names[b]
        );
    }
    let [lowest, highest] = lumped.potentials;
    let beyond = (-lowest).max(highest - 1.0);
    if 1e-9 < beyond {
        text += &format!(
            "inside of the bodies, {} leave those of the terminals by {} of their difference, which a finer mesh would not\n",
            match value_of(lumped) {
                "temperature" => "temperatures",
                _ => "potentials",
            },
            percent(beyond)
        );
    }
    text
}

/// The first column has names; all others are right-aligned.
fn table(rows: &[Vec<String>]) -> String {
    aligned(rows, "  ", |column| column == 0)
}
