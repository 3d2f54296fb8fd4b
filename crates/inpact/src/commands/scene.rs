//! `inpact scene`: a deck with a mesh in; a scene out, of its contact pairs, its bodies between terminals, and its conditions.
//!
//! Nothing is invented: values that the deck does not define are missing in the scene, and options that cannot be converted are listed with their lines.

mod lumping;
mod terminals;
mod text;
mod unread;

use self::lumping::Lumping;
use self::terminals::{Terminal, restrict, terminals};
use self::text::{Head, SceneText};
use super::findings::{Messages, with_messages};
use super::interfaces::lumped_lines;
use super::job_results::{RESULTS_HELP, states};
use super::joule_heat::JouleHeats;
use super::mesh_rows::node_rows;
use super::meshed::MeshedDeck;
use super::solvable::{choices_of, steps_of};
use crate::failure::{Failure, Outcome};
use crate::files::{self, STANDARD_STREAM};
use crate::render::Format;
use crate::report::Input;
use crate::settings::{DeckArguments, Settings};
use crate::terminals::{Stated, StepTime, Taker, procedure};
use crate::text::counted;
use clap::Args;
use inpact_body::{Body, BodyFault, BodyField, Lumped};
use inpact_contact::{Interfaces, PairInterfaces};
use inpact_diagnostics::Findings;
use inpact_diagnostics::visible::visible_line;
use inpact_evaluation::plan::Choices;
use inpact_network::Problem;
use inpact_network::scene::{self, Field, SceneFiles};
use inpact_parser::mesh::{self, MeshNote};
use inpact_parser::model::{Name, Procedure, Regime};
use inpact_parser::span::Span;
use serde_json::json;
use std::collections::{BTreeSet, HashSet};
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct SceneArguments {
    /// The deck, with its mesh; `-` reads standard input.
    #[arg(value_name = "DECK")]
    deck: PathBuf,
    /// The step whose conditions and procedure the scene has, from 1; not needed where the deck has one.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    step: Option<u32>,
    /// The temperature at which properties of materials are taken that depend on it.
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    temperature: Option<f64>,
    #[arg(long, value_name = "FILE", help = RESULTS_HELP, long_help = format!("{RESULTS_HELP}.\n\nThe joints are those of the last state."))]
    results: Vec<PathBuf>,
    /// Where to write the scene, instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    reading: DeckArguments,
    /// How to print what there is to say on standard error.
    #[arg(long, value_enum, default_value_t = Format::Concise)]
    format: Format,
}

/// A list of what is said of a scene, each with its place in the deck.
type Lines = Vec<String>;

pub(crate) fn run(arguments: &SceneArguments) -> Result<Outcome, Failure> {
    with_messages(arguments.format, |messages| write(arguments, messages))
}

fn write(arguments: &SceneArguments, messages: Messages<'_>) -> Result<Outcome, Failure> {
    files::name_as_inputs(&[&arguments.deck]);
    files::name_as_inputs(&arguments.results);
    files::check_targets(&[arguments.output.as_deref()])?;
    let settings = arguments.reading.settings(&arguments.deck)?;
    let mut steps = 0;
    let (meshed, _) = MeshedDeck::read_parts(&arguments.deck, &settings, |read| {
        steps = steps_of(read, settings.grammar);
        Some((Vec::new(), arguments.step.map_or(steps.min(1), |step| step as usize)))
    })?;
    // The included files are known now.
    files::check_targets(&[arguments.output.as_deref()])?;
    refuse_step(arguments, steps)?;
    let made = make(arguments, &settings, &meshed, messages)?;
    files::write_result(arguments.output.as_deref(), made.whole.as_bytes())?;
    let lines = || made.lines().iter().map(|line| visible_line(line).into_owned()).collect();
    let summary = || {
        let summary = json!({
            "nodes": made.nodes,
            "not_taken_over": made.not_taken,
            "missing": made.missing,
            "lumping": made.lumping,
        });
        json!({ "summary": summary }).to_string()
    };
    messages.tell(lines, summary);
    Ok(Outcome::Clean)
}

fn refuse_step(arguments: &SceneArguments, steps: usize) -> Result<(), Failure> {
    match arguments.step {
        Some(step) if steps < step as usize => {
            Err(Failure::Usage(format!("`--step {step}`: the deck has {}", counted(steps, "step"))))
        }
        None if 1 < steps => Err(Failure::Usage(format!(
            "the deck has {steps} steps: name the one whose conditions the scene has, `--step 1`"
        ))),
        _ => Ok(()),
    }
}

/// A scene and what is said of it.
struct Made {
    whole: String,
    nodes: usize,
    not_taken: Lines,
    missing: Lines,
    lumping: Lines,
}

impl Made {
    fn lines(&self) -> Lines {
        let mut all = vec![format!("{} nodes", self.nodes)];
        for (title, lines) in [
            ("not taken over:", &self.not_taken),
            ("missing, because the deck does not say it:", &self.missing),
            ("lumping:", &self.lumping),
        ] {
            all.extend((!lines.is_empty()).then(|| title.to_owned()));
            all.extend(lines.iter().map(|line| format!("  {line}")));
        }
        all
    }
}

fn make(
    arguments: &SceneArguments,
    settings: &Settings,
    meshed: &MeshedDeck,
    messages: Messages<'_>,
) -> Result<Made, Failure> {
    let model = &meshed.read.model;
    let step = meshed.conditions.step;
    let procedure = procedure(model, step);
    let regime = procedure.and_then(Procedure::regime).unwrap_or(Regime::SteadyState);
    let joined = states(&arguments.results, meshed, messages)?;
    let mut rows = node_rows(meshed, &joined.states, messages)?;
    let Some(state) = joined.states.last() else {
        return Err(Failure::Data("the result files have no state".to_owned()));
    };
    let interfaces = rows.interfaces(state)?;
    let mut notes: Vec<MeshNote> = meshed.conditions.not_taken.clone();
    let terminals = terminals(meshed, &interfaces, &mut notes);
    let time = StepTime::of(model, step, regime);
    let mut taker = Taker::new(&meshed.mesh, &meshed.conditions, time);
    let stated: Vec<Stated> = terminals.iter().map(|terminal| taker.take(&terminal.nodes)).collect();
    for (terminal, stated) in terminals.iter().zip(&stated) {
        for (field, span, why) in &stated.faults {
            let message = format!("the {field} of `{}`: {why}", terminal.name);
            notes.push(MeshNote { span: *span, message });
        }
    }
    notes.extend(taker.left_out().into_iter().map(|(span, message)| MeshNote { span, message }));
    let mut unplaced = Vec::new();
    let lumped = lumped(arguments, settings, meshed, &terminals, (procedure, regime), (&mut notes, &mut unplaced))?;
    let names: Vec<&Name> = terminals.iter().map(|terminal| &terminal.name).collect();
    let heats = JouleHeats::of(&names, &lumped);
    notes.extend(heats.refused.iter().cloned());
    notes.extend(unread::unread(&meshed.read.deck, settings.grammar, step));
    let mut text = SceneText::new(&deck_from(arguments), regime, time, procedure);
    text.nodes(&terminals, &stated, &lumped);
    text.links(&terminals, &lumped, &heats, &mut unplaced);
    let areas: Vec<Option<f64>> =
        interfaces.pairs.iter().map(|pair| joint_area(arguments, &terminals, &interfaces, pair)).collect();
    text.interfaces(&interfaces, &areas);
    let choices = Choices { dialect: settings.grammar.dialect(), ..Choices::default() };
    let mut lumping = Lumping::new((&terminals, &interfaces), (model, choices), (&lumped, &heats));
    for (pair, area) in interfaces.pairs.iter().zip(areas) {
        let Some((of, area)) = interfaces.lumped(pair).zip(area) else {
            let message = format!(
                "`{}` on `{}`: no slave node has the master across from it, so that there is no joint (with the surfaces exchanged there may be one)",
                pair.slave, pair.master
            );
            notes.push(MeshNote { span: pair.span, message });
            continue;
        };
        lumping.joint(pair, &of, area);
        let title = format!("`{}` on `{}`:", pair.slave, pair.master);
        lumping.lines.extend(std::iter::once(title).chain(lumped_lines(&interfaces, &of)));
        if !pair.beside.is_empty() {
            let count = pair.beside.len();
            lumping.lines.push(format!("    {count} slave nodes hang over the edge of the master and count nowhere"));
        }
    }
    let not_taken = placed(meshed, notes, unplaced)?;
    let mut missing = missing(&text.written, meshed, settings);
    missing.extend(heats.missing.into_iter().map(|note| note.message));
    let lumping = lumping.finish();
    let head = Head { inputs: inputs(arguments, meshed)?, command: command(arguments) };
    let whole = head.written(&not_taken, &missing, &lumping) + &text.written;
    Ok(Made { whole, nodes: terminals.len(), not_taken, missing, lumping })
}

/// The area of a joint: that of the part of its slave surface opposite the master, and with result files that of the slave nodes; `None` where it is unknown.
fn joint_area(
    arguments: &SceneArguments,
    terminals: &[Terminal],
    interfaces: &Interfaces,
    pair: &PairInterfaces,
) -> Option<f64> {
    let of_nodes = interfaces.lumped(pair)?.area;
    let slave = terminals.iter().find(|terminal| terminal.name == pair.slave);
    let across = slave.filter(|_| arguments.results.is_empty()).and_then(Terminal::area);
    // Equal up to rounding: that of the nodes.
    Some(across.filter(|area| SAME_AREA < (area - of_nodes).abs() / area).unwrap_or(of_nodes))
}

/// Areas that differ by less are equal up to rounding.
const SAME_AREA: f64 = 1e-9;

/// The fields of a procedure; heat by default.
fn fields_of(procedure: Option<&Procedure>) -> Vec<BodyField> {
    let is_of_fluid = procedure.is_some_and(Procedure::solves_pore_pressure);
    let is_electrical = procedure.is_some_and(Procedure::solves_electrical);
    let thermal = (!is_of_fluid).then_some(BodyField::Thermal);
    thermal.into_iter().chain(is_electrical.then_some(BodyField::Electrical)).collect()
}

/// The bodies between their terminals, by field; reasons why they cannot be lumped go to the notes.
fn lumped(
    arguments: &SceneArguments,
    settings: &Settings,
    meshed: &MeshedDeck,
    terminals: &[Terminal],
    (procedure, regime): (Option<&Procedure>, Regime),
    (notes, unplaced): (&mut Vec<MeshNote>, &mut Lines),
) -> Result<Vec<Lumped>, Failure> {
    let names: Vec<Name> = terminals.iter().map(|terminal| terminal.name.clone()).collect();
    let deck = &meshed.read.deck;
    let read = meshed.with_rows(|rows| mesh::read_bodies(deck, settings.grammar, &names, rows));
    let mut bodies = read.map_err(|error| Failure::read(&arguments.deck, error))?;
    restrict(&mut bodies, &meshed.mesh, terminals);
    let (body, faults) = match Body::sound(bodies, &names) {
        Ok(sound) => sound,
        Err(error) => {
            take_faults(error.faults(), "bodies are left out", notes, unplaced);
            return Ok(Vec::new());
        }
    };
    take_faults(&faults, "its body is left out", notes, unplaced);
    notes.extend(body.left_out().iter().cloned());
    let has_fault: HashSet<u32> = faults.iter().flat_map(|fault| fault.bodies.iter().copied()).collect();
    let alone =
        (0_u32..).zip(body.parts()).filter(|(number, part)| part.terminals.is_empty() && !has_fault.contains(number));
    for (_, part) in alone {
        let node = body.mesh().node(part.first);
        let elements = part.elements;
        unplaced
            .push(format!("the body of node {node}, {elements} elements: it has no contact surface and no condition"));
    }
    let mut found = Vec::new();
    let fields = fields_of(procedure);
    if fields.is_empty() {
        unplaced.push("what bodies conduct of pore fluid: give `hydraulic` links".to_owned());
    }
    for field in fields {
        // The same body may be valid in another field.
        let mut reduced: Option<Body> = None;
        loop {
            match reduced.as_ref().unwrap_or(&body).lumped(field, arguments.temperature) {
                Ok(lumped) => {
                    // Missing data for capacities matter only in a transient.
                    if regime == Regime::Transient {
                        notes.extend(lumped.left_out.iter().cloned());
                    }
                    found.push(lumped);
                    break;
                }
                // The links of the other bodies are kept.
                Err(error) if error.faults().iter().all(|fault| !fault.bodies.is_empty()) => {
                    take_faults(
                        error.faults(),
                        &format!("the {field} links of its body are left out"),
                        notes,
                        unplaced,
                    );
                    let sound = reduced.get_or_insert_with(|| body.clone());
                    for fault in error.faults() {
                        sound.leave_out(&fault.bodies);
                    }
                }
                Err(error) => {
                    take_faults(error.faults(), &format!("the {field} links are left out"), notes, unplaced);
                    break;
                }
            }
        }
    }
    Ok(found)
}

fn take_faults(faults: &[BodyFault], ending: &str, notes: &mut Vec<MeshNote>, unplaced: &mut Lines) {
    for fault in faults {
        let message = format!("{}: {ending}", fault.message);
        match fault.span {
            Some(span) => notes.push(MeshNote { span, message }),
            None => unplaced.push(message),
        }
    }
}

/// Notes as lines, each with its place, in the order of the deck; only the first of several about one keyword line.
fn placed(meshed: &MeshedDeck, mut notes: Vec<MeshNote>, unplaced: Lines) -> Result<Lines, Failure> {
    let mut met: BTreeSet<(Span, String)> = BTreeSet::new();
    let mut spans: BTreeSet<Span> = BTreeSet::new();
    let plain = |note: &MeshNote| note.message.ends_with(" is not taken over");
    // More specific messages come first.
    notes.sort_by_key(|note| (note.span, plain(note)));
    notes.retain(|note| {
        let is_first = spans.insert(note.span);
        (is_first || !plain(note)) && met.insert((note.span, note.message.clone()))
    });
    let mut lines = Vec::new();
    for note in &notes {
        lines.push(format!("{}: {}", meshed.place_of(note.span)?, note.message));
    }
    lines.extend(unplaced);
    Ok(lines)
}

/// No table is beside a scene that is made here.
struct NoFiles;

impl SceneFiles for NoFiles {
    fn read(&mut self, _: &str) -> Option<Vec<u8>> {
        None
    }
}

/// The findings of `solve` on missing data: the scene is read back and checked.
fn missing(text: &str, meshed: &MeshedDeck, settings: &Settings) -> Lines {
    let (scene, found) = scene::read_as_far_as_it_goes(text, "scene", &mut NoFiles);
    let mut messages: Lines = found.iter().map(said).collect();
    if let Some(scene) = scene {
        let model = &meshed.read.model;
        let laws = Choices { dialect: settings.grammar.dialect(), ..Choices::default() };
        let choices = choices_of(&scene, laws);
        let mut findings = Findings::new("scene");
        drop(Problem::new(&scene, model, &choices, &mut findings));
        messages.extend(findings.into_list().iter().map(said));
    }
    messages
}

fn said(found: &inpact_diagnostics::Diagnostic) -> String {
    let help = found.help.as_ref().map_or_else(String::new, |help| format!(" ({help})"));
    format!("[{}] {}{help}", found.code, found.message)
}

/// The input files of the scene, the deck first.
fn inputs(arguments: &SceneArguments, meshed: &MeshedDeck) -> Result<Vec<Input>, Failure> {
    let mut inputs = vec![Input::of(&arguments.deck)?];
    for source in meshed.read.deck.sources().iter().skip(1) {
        inputs.push(Input::of(Path::new(source.name()))?);
    }
    for file in &arguments.results {
        inputs.push(Input::of(file)?);
    }
    Ok(inputs)
}

/// The command, without the output options.
fn command(arguments: &SceneArguments) -> String {
    let mut command = format!("inpact scene {}", arguments.deck.display());
    if let Some(step) = arguments.step {
        command += &format!(" --step {step}");
    }
    if let Some(temperature) = arguments.temperature {
        command += &format!(" --temperature {temperature:?}");
    }
    for file in &arguments.results {
        command += &format!(" --results {}", file.display());
    }
    command
}

/// The name of the deck in the scene: relative to the folder of the scene where it lies below that.
fn deck_from(arguments: &SceneArguments) -> String {
    let deck = &arguments.deck;
    let target = arguments.output.as_deref().filter(|target| target.as_os_str() != STANDARD_STREAM);
    let Some(target) = target else { return deck.display().to_string() };
    let folder = files::folder_of(target).canonicalize();
    let (Ok(folder), Ok(whole)) = (folder, deck.canonicalize()) else { return deck.display().to_string() };
    whole.strip_prefix(&folder).unwrap_or(&whole).display().to_string()
}

pub(super) fn network_field(field: BodyField) -> Field {
    match field {
        BodyField::Thermal => Field::Temperature,
        BodyField::Electrical => Field::Potential,
    }
}
