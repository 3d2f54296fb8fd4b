//! `inpact body`: a deck with a mesh in; conductances and capacities of its bodies between surfaces and node sets out.

mod scene;
mod text;
mod value;

use super::choice::{Choice, one_of};
use super::findings::{Messages, with_messages};
use super::joule_heat::JouleHeats;
use super::meshed::MeshedDeck;
use crate::failure::{Failure, Outcome};
use crate::files;
use crate::render::Format;
use crate::settings::{DeckArguments, Settings};
use crate::text::counted;
use clap::{Args, ValueEnum};
use inpact_body::{BESIDE_BODIES, Body, BodyField, Lumped, NEGATIVE_CONDUCTANCE, SolutionMethod};
use inpact_diagnostics::Diagnostic;
use inpact_diagnostics::visible::{visible, visible_json, visible_line};
use inpact_parser::mesh::MeshNote;
use inpact_parser::model::Name;
use serde_json::json;
use std::path::PathBuf;
use std::time::Instant;

#[derive(Debug, Args)]
pub(crate) struct BodyArguments {
    /// The deck, with its mesh and materials; `-` reads standard input.
    #[arg(value_name = "DECK")]
    deck: PathBuf,
    /// Where bodies end: surfaces and node sets of the deck, in the assembly or after the name of an instance and a dot, or numbers of nodes; no two of them share a node.
    #[arg(long, value_name = "NAME", value_delimiter = ',', required = true)]
    terminals: Vec<String>,
    /// The temperature at which properties are taken that depend on it.
    #[arg(long, value_name = "NUMBER", allow_negative_numbers = true)]
    temperature: Option<f64>,
    /// What is conducted; unless given, all that a material of the bodies has a conductivity for.
    #[arg(long, value_parser = one_of(&FIELDS))]
    field: Option<&'static [BodyField]>,
    #[command(flatten)]
    reading: DeckArguments,
    /// How to print the conductances.
    #[arg(long, value_enum, default_value_t = BodyFormat::Text)]
    format: BodyFormat,
    /// How to print notes and findings on standard error, instead of a line each, or of JSON with `--format json`.
    #[arg(long, value_enum)]
    findings: Option<Format>,
    /// Where to write, instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

const FIELDS: [Choice<&[BodyField]>; 3] = [
    ("thermal", &[BodyField::Thermal], "Heat, by *CONDUCTIVITY"),
    ("electrical", &[BodyField::Electrical], "Current, by *ELECTRICAL CONDUCTIVITY"),
    ("both", &[BodyField::Electrical, BodyField::Thermal], "Both"),
];

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum BodyFormat {
    /// Tables for a person.
    Text,
    /// A JSON object.
    Json,
    /// A table of links beside a scene, as comma-separated values.
    Links,
    /// Nodes and links of a scene, as TOML.
    Scene,
}

/// The bodies found in a deck.
struct Found<'a> {
    deck: &'a str,
    body: &'a Body,
    temperature: Option<f64>,
    lumped: Vec<Lumped>,
    heats: JouleHeats,
}

pub(crate) fn run(arguments: &BodyArguments) -> Result<Outcome, Failure> {
    let format = arguments.findings.unwrap_or(match arguments.format {
        BodyFormat::Json => Format::Json,
        _ => Format::Concise,
    });
    with_messages(format, |messages| make(arguments, messages))
}

fn make(arguments: &BodyArguments, messages: Messages<'_>) -> Result<Outcome, Failure> {
    let start = Instant::now();
    if let Some(temperature) = arguments.temperature.filter(|temperature| !temperature.is_finite()) {
        return Err(Failure::Usage(format!("expected a finite number as `--temperature`, found `{temperature}`")));
    }
    files::name_as_inputs(&[&arguments.deck]);
    files::check_targets(&[arguments.output.as_deref()])?;
    let settings = arguments.reading.settings(&arguments.deck)?;
    let names: Vec<Name> = arguments.terminals.iter().map(|name| Name::new(name)).collect();
    let (meshed, body) = MeshedDeck::read_body(&arguments.deck, &settings, &names)?;
    // The included files are known now.
    files::check_targets(&[arguments.output.as_deref()])?;
    let body = match body {
        Ok(body) => body,
        Err(error) => return refused(&meshed, &error, (messages, &settings)),
    };
    if meshed.say_findings(&BESIDE_BODIES, body.left_out(), (messages, &settings))? {
        return Ok(Outcome::HasErrors);
    }
    let mut fields = arguments.field.map_or_else(|| body.fields(), <[_]>::to_vec);
    if fields.is_empty() {
        // The reason for missing heat is reported for every material.
        fields.push(BodyField::Thermal);
    }
    let mut lumped: Vec<Lumped> = Vec::new();
    for field in fields {
        match body.lumped(field, arguments.temperature) {
            Ok(of_field) => lumped.push(of_field),
            Err(error) => return refused(&meshed, &error, (messages, &settings)),
        }
    }
    let left_out: Vec<MeshNote> = lumped.iter().flat_map(|lumped| lumped.left_out.clone()).collect();
    if meshed.say_findings(&BESIDE_BODIES, &left_out, (messages, &settings))? {
        return Ok(Outcome::HasErrors);
    }
    let terminals: Vec<&Name> = body.terminals().iter().map(|terminal| &terminal.name).collect();
    let heats = JouleHeats::of(&terminals, &lumped);
    let found = Found { deck: &meshed.name, body: &body, temperature: arguments.temperature, lumped, heats };
    if matches!(arguments.format, BodyFormat::Links | BodyFormat::Scene) {
        let negative: Vec<Diagnostic> = scene::negative(&found)
            .iter()
            .map(|message| meshed.finding(&NEGATIVE_CONDUCTANCE, None, message))
            .collect::<Result<_, _>>()?;
        if messages.of_deck(negative, &meshed.read.deck, &settings) {
            return Ok(Outcome::HasErrors);
        }
        let unsaid: Vec<MeshNote> = found.heats.missing.iter().chain(&found.heats.refused).cloned().collect();
        if meshed.say_findings(&BESIDE_BODIES, &unsaid, (messages, &settings))? {
            return Ok(Outcome::HasErrors);
        }
    }
    let text = match arguments.format {
        BodyFormat::Text => visible(&text::text(&found)).into_owned().into_bytes(),
        BodyFormat::Json => visible_json(&value::written(&found)).into_owned().into_bytes(),
        BodyFormat::Links => scene::links(&found),
        BodyFormat::Scene => scene::rows(&found).into_bytes(),
    };
    files::write_result(arguments.output.as_deref(), &text)?;
    say_summary(&found, start.elapsed().as_secs_f64(), messages);
    Ok(Outcome::Clean)
}

/// Reports every fault with its place.
fn refused(
    meshed: &MeshedDeck,
    error: &inpact_body::Error,
    (messages, settings): (Messages<'_>, &Settings),
) -> Result<Outcome, Failure> {
    let found = error.faults().iter().map(|fault| meshed.finding(fault.rule, fault.span, &fault.message));
    messages.of_deck(found.collect::<Result<_, _>>()?, &meshed.read.deck, settings);
    Ok(Outcome::HasErrors)
}

fn say_summary(found: &Found<'_>, seconds: f64, messages: Messages<'_>) {
    let bodies = found.lumped[0].bodies.len() as u64;
    let lines = || {
        let terminals = counted(found.body.terminals().len(), "terminal");
        let bodies = if bodies == 1 { "1 body".to_owned() } else { format!("{bodies} bodies") };
        let head = format!("{}: {terminals} of {bodies}, {seconds:.3} s", found.deck);
        let mut lines = vec![visible_line(&head).into_owned()];
        for lumped in &found.lumped {
            let [isothermal, even] = lumped.solutions;
            let unknowns = counted(isothermal.unknowns, "unknown");
            let how = match (isothermal.method, even.method) {
                (SolutionMethod::Factor(first), SolutionMethod::Factor(second)) => {
                    format!("factors of {first} and {second} entries")
                }
                (SolutionMethod::Iterations(first), SolutionMethod::Iterations(second)) => {
                    format!("{first} and {second} iterations of conjugate gradients")
                }
                (SolutionMethod::Factor(entries), SolutionMethod::Iterations(iterations))
                | (SolutionMethod::Iterations(iterations), SolutionMethod::Factor(entries)) => {
                    format!("a factor of {entries} entries, {iterations} iterations of conjugate gradients")
                }
            };
            let balanced = isothermal.imbalance.max(even.imbalance);
            lines.push(format!("  {}: {unknowns}, {how}; balanced to {balanced:.1e}", lumped.field));
        }
        lines
    };
    let json = || {
        let summary =
            json!({ "summary": { "terminals": found.body.terminals().len(), "bodies": bodies, "seconds": seconds } });
        summary.to_string()
    };
    messages.tell(lines, json);
}
