//! Conductances and capacities as JSON.
//!
//! The format is a contract; its JSON Schema is committed (`schema/body.schema.json`).

use super::Found;
use inpact_body::{BodyField, BodySummary, Conductances, JouleHeat, Lumped, Solution, SolutionMethod};
use serde::Serialize;

/// What the bodies of a deck conduct and hold between terminals, as `inpact body --format json` gives it.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Bodies of inpact body"))]
struct Document<'a> {
    /// `inpact/body/1`.
    schema: &'static str,
    /// The deck.
    source: &'a str,
    /// The temperature at which properties are taken that depend on it; null where none was given.
    temperature: Option<f64>,
    /// The names of the terminals, in the order they were asked for.
    terminals: Vec<&'a str>,
    /// What was found, by what is conducted.
    fields: Fields<'a>,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Fields<'a> {
    /// Currents by potentials.
    #[serde(skip_serializing_if = "Option::is_none")]
    electrical: Option<OfField<'a>>,
    /// Heat by temperatures.
    #[serde(skip_serializing_if = "Option::is_none")]
    thermal: Option<OfField<'a>>,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct OfField<'a> {
    /// Conductances where each terminal has one temperature or potential, each pair once.
    isothermal: Vec<Pair<'a>>,
    /// The same where the flow of each terminal is spread evenly over it.
    even: Vec<Pair<'a>>,
    /// The terminals: their size, and how far from one value each is.
    terminals: Vec<Terminal<'a>>,
    /// The bodies that have a terminal.
    bodies: Vec<OfBody<'a>>,
    /// The lowest and the highest value of a potential that is 1 at one terminal and 0 at the others.
    potentials: [f64; 2],
    /// How the equations were solved.
    solutions: Solutions,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Pair<'a> {
    terminals: [&'a str; 2],
    /// The conductance between them; 0 where no body has both.
    conductance: f64,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Terminal<'a> {
    name: &'a str,
    /// The number of its nodes.
    nodes: usize,
    /// Its area; null of a node set that is not made of whole faces.
    area: Option<f64>,
    /// Its body, a position in `bodies`.
    body: Option<usize>,
    /// What it conducts to all others with one value: no joint has more.
    upper: f64,
    /// What it conducts to all others with even flows: no joint with an even flow has less.
    lower: f64,
    /// The difference of both, relative to the larger.
    relative: f64,
    /// With even flows: its highest less its lowest value, where its mean is 1 and those of all others are 0.
    range: f64,
    /// What it holds; null of a current, and where a material has no density or specific heat.
    capacity: Option<f64>,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct OfBody<'a> {
    /// The names of its terminals.
    terminals: Vec<&'a str>,
    /// The number of its nodes.
    nodes: usize,
    /// The number of its elements.
    elements: usize,
    /// Its volume.
    volume: f64,
    /// What it holds; null as of terminals.
    capacity: Option<f64>,
    /// The share of the energy dissipated by its current that becomes heat; null where its materials give none, or none that is one share from 0 to 1.
    joule_heat_fraction: Option<f64>,
    /// With even flows it conducts at most by this share less than with one value a terminal, whatever these values are.
    relative: f64,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Solutions {
    /// With one value for each terminal.
    isothermal: Solved,
    /// With even flows.
    even: Solved,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Solved {
    /// The number of nodes whose value was not known.
    unknowns: usize,
    /// The number of entries of the matrix below its diagonal.
    matrix_entries: usize,
    /// The largest imbalance of a node, relative to the largest flow through one.
    imbalance: f64,
    /// The entries of the Cholesky factor, where there was one.
    #[serde(skip_serializing_if = "Option::is_none")]
    factor_entries: Option<usize>,
    /// The iterations of conjugate gradients, where there was no factor.
    #[serde(skip_serializing_if = "Option::is_none")]
    iterations: Option<usize>,
}

/// All results, as text.
pub(super) fn written(found: &Found<'_>) -> String {
    // A document of strings and numbers cannot fail.
    serde_json::to_string_pretty(&document(found)).unwrap_or_default() + "\n"
}

fn document<'a>(found: &'a Found<'_>) -> Document<'a> {
    let names: Vec<&str> = found.body.terminals().iter().map(|terminal| terminal.name.written()).collect();
    let of = |field: BodyField| found.lumped.iter().find(|lumped| lumped.field == field).map(|of| of_field(&names, of));
    Document {
        schema: "inpact/body/1",
        source: found.deck,
        temperature: found.temperature,
        fields: Fields { electrical: of(BodyField::Electrical), thermal: of(BodyField::Thermal) },
        terminals: names,
    }
}

fn of_field<'a>(names: &[&'a str], lumped: &'a Lumped) -> OfField<'a> {
    let terminals = lumped.terminals.iter().enumerate().map(|(at, terminal)| Terminal {
        name: terminal.name.written(),
        nodes: terminal.nodes,
        area: terminal.area,
        body: terminal.body,
        upper: terminal.upper,
        lower: terminal.lower,
        relative: terminal.relative(),
        range: terminal.range,
        capacity: lumped.capacities[at],
    });
    let body = |body: &BodySummary| OfBody {
        terminals: body.terminals.iter().map(|at| names[*at]).collect(),
        nodes: body.nodes,
        elements: body.elements,
        volume: body.volume,
        capacity: body.capacity,
        joule_heat_fraction: if let JouleHeat::Share(share) = body.joule_heat { Some(share) } else { None },
        relative: body.relative,
    };
    let [isothermal, even] = &lumped.solutions;
    OfField {
        isothermal: pairs(names, &lumped.isothermal),
        even: pairs(names, &lumped.even),
        terminals: terminals.collect(),
        bodies: lumped.bodies.iter().map(body).collect(),
        potentials: lumped.potentials,
        solutions: Solutions { isothermal: solved(isothermal), even: solved(even) },
    }
}

fn pairs<'a>(names: &[&'a str], conductances: &Conductances) -> Vec<Pair<'a>> {
    let pair = |(a, b, conductance): (usize, usize, f64)| Pair { terminals: [names[a], names[b]], conductance };
    conductances.pairs().map(pair).collect()
}

fn solved(solution: &Solution) -> Solved {
    let (factor_entries, iterations) = match solution.method {
        SolutionMethod::Factor(entries) => (Some(entries), None),
        SolutionMethod::Iterations(iterations) => (None, Some(iterations)),
    };
    Solved {
        unknowns: solution.unknowns,
        matrix_entries: solution.entries,
        imbalance: solution.imbalance,
        factor_entries,
        iterations,
    }
}

#[cfg(test)]
#[path = "../../../../../tests/support/schema.rs"]
mod schema;

#[cfg(test)]
mod tests {
    use super::Document;
    use schemars::JsonSchema;
    use schemars::generate::SchemaSettings;

    #[test]
    fn the_committed_schema_is_that_of_the_document() {
        assert_eq!(Document::schema_name(), "Bodies of inpact body");
        super::schema::check::<Document<'_>>("body.schema.json", SchemaSettings::draft2020_12().for_serialize());
    }
}
