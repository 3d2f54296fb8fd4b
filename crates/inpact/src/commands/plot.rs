//! `inpact plot`: decks in, the curves of their laws out.

use super::choice::{Choice, one_of};
use super::drawing::DrawingFormat;
use super::evaluable::{Evaluable, EvaluableArguments};
use super::findings::Messages;
use super::laws::LawArguments;
use super::node_sample::{Gathered, gather};
use crate::chart::panel::Scales;
use crate::chart::scale::ScaleKind;
use crate::chart::{sheet, terminal};
use crate::curves::{self, Detail, Figure, LawKind, Probing, Request, Units};
use crate::failure::{Failure, Outcome, say};
use crate::files;
use crate::input::ReadDeck;
use crate::report;
use crate::settings::{DeckArguments, Settings};
use crate::text::in_backticks;
use clap::Args;
use inpact_parser::deck::Keep;
use inpact_parser::model::{Model, Name};
use inpact_validation::Diagnostic;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct PlotArguments {
    /// Decks or fragments; several stand side by side with the same axes. `-` reads standard input.
    #[arg(required = true, value_name = "DECK")]
    decks: Vec<PathBuf>,
    #[command(flatten)]
    drawing: DrawingArguments,
    /// Where to draw: FILE ends in .svg, .png or .html; without it a plot in letters goes to standard output.
    #[arg(short, long, value_name = "FILE", value_parser = picture)]
    output: Option<Picture>,
    /// Which axes are logarithmic; that of the values where none is named.
    #[arg(long, value_parser = one_of(&LOGARITHMIC_AXES), value_name = "AXES", num_args = 0..=1, require_equals = true, default_missing_value = "y")]
    log: Option<Scales>,
    /// Draw the rows of a node table on the curves, with their histograms and the share that is beyond the tables.
    #[arg(long, value_name = "TABLE")]
    nodes: Option<PathBuf>,
    /// Mark what a check of the deck finds in the rows that are drawn.
    #[arg(long)]
    findings: bool,
    #[command(flatten)]
    laws: LawArguments,
    #[command(flatten)]
    reading: DeckArguments,
}

/// Options of drawings of decks.
#[derive(Debug, Args)]
pub(crate) struct DrawingArguments {
    /// Draw this interaction only; may be given several times.
    #[arg(long, value_name = "NAME")]
    interaction: Vec<String>,
    /// Draw these laws only.
    #[arg(long, value_enum, value_name = "LAWS", value_delimiter = ',')]
    law: Vec<LawKind>,
    /// Hold variables at values instead of drawing a curve or a panel for each: temp=150,fv1=2.
    #[arg(long, value_name = "NAME=VALUE", value_delimiter = ',', value_parser = held)]
    at: Vec<(String, f64)>,
    /// Your names of units, by base quantity or by column: L=mm,M=t,T=s,theta=K or pressure=MPa.
    #[arg(long, value_name = "UNITS", default_value = "", hide_default_value = true)]
    units: Units,
}

const LOGARITHMIC_AXES: [Choice<Scales>; 3] = [
    ("y", Scales { x: ScaleKind::Linear, y: ScaleKind::Logarithmic }, "That of the values"),
    ("x", Scales { x: ScaleKind::Logarithmic, y: ScaleKind::Linear }, "Those of clearance and contact pressure"),
    ("xy", Scales { x: ScaleKind::Logarithmic, y: ScaleKind::Logarithmic }, "All"),
];

#[derive(Debug, Clone)]
struct Picture {
    path: PathBuf,
    kind: PictureKind,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PictureKind {
    Drawing(DrawingFormat),
    Page,
}

const MAX_PANELS: usize = 40;

/// The maximum number of changes between two decks that are listed.
const MAX_CHANGES: usize = 20;

/// The number of values of a curve on logarithmic axes, where it is not straight between its rows.
const ON_LOGARITHMIC: usize = 160;

impl DrawingArguments {
    /// The parts to be drawn.
    pub(crate) fn request(&self, detail: Detail, most_panels: usize, probing: Probing) -> Request {
        Request {
            held_places: Vec::new(),
            interactions: self.interaction.iter().map(|name| Name::new(name)).collect(),
            laws: self.law.clone(),
            at: self.at.clone(),
            units: self.units.clone(),
            detail,
            most_panels,
            probing,
        }
    }

    /// Rejects names of interactions that none of the decks has.
    pub(crate) fn refuse_unknown(&self, models: &[&Model]) -> Result<(), Failure> {
        for name in &self.interaction {
            let wanted = Name::new(name);
            if !models.iter().any(|model| model.interactions.contains_key(&wanted)) {
                let known = in_backticks(models.iter().flat_map(|model| model.interactions.keys()).take(8));
                let message = format!("there is no interaction `{name}`; there are {known}");
                return Err(Failure::Usage(message));
            }
        }
        Ok(())
    }
}

struct DrawnDeck {
    name: String,
    settings: Settings,
    model: Model,
    findings: Vec<Diagnostic>,
}

pub(crate) fn run(arguments: &PlotArguments) -> Result<Outcome, Failure> {
    files::refuse_second_stream(&arguments.decks)?;
    files::name_as_inputs(&arguments.decks);
    let target = arguments.output.as_ref().map(|picture| picture.path.as_path());
    let scales = arguments.log.unwrap_or(Scales::LINEAR);
    files::check_targets(&[target])?;
    if arguments.nodes.is_some() && 1 < arguments.decks.len() {
        return Err(Failure::Usage("`--nodes` is for one deck".to_owned()));
    }
    let decks = arguments.decks.iter().map(|path| read(path, arguments)).collect::<Result<Vec<_>, _>>()?;
    let models: Vec<&Model> = decks.iter().map(|deck| &deck.model).collect();
    arguments.drawing.refuse_unknown(&models)?;
    let nodes = match &arguments.nodes {
        None => None,
        Some(nodes) => match gathered(arguments, nodes)? {
            None => return Ok(Outcome::HasErrors),
            gathered => gathered,
        },
    };
    let figures = figures(arguments, &decks, nodes.as_ref())?;
    if figures.iter().all(|figure| figure.panels.is_empty()) {
        return Err(nothing_to_draw(&figures));
    }
    // The included files are known now.
    files::check_targets(&[target])?;
    match &arguments.output {
        None => {
            let text = terminal::text(&figures, scales);
            files::write_result(None, text.as_bytes())?;
        }
        Some(picture) => {
            figures.iter().flat_map(|figure| &figure.notes).for_each(|note| say(&format!("note: {note}")));
            let bytes = match picture.kind {
                PictureKind::Page => report::page_of_curves(&figures).into_bytes(),
                PictureKind::Drawing(format) => format.bytes(sheet::svg(&figures, scales))?,
            };
            files::write_result(Some(&picture.path), &bytes)?;
        }
    }
    Ok(Outcome::Clean)
}

/// Evaluates the node table; `None` after reporting its faults or those of the deck.
fn gathered(arguments: &PlotArguments, nodes: &Path) -> Result<Option<(Gathered, Evaluable)>, Failure> {
    let evaluable = EvaluableArguments::of_nodes(arguments.decks[0].clone(), nodes.to_owned());
    files::name_as_inputs(&evaluable.inputs());
    let messages = Messages::LINES;
    let prepared = evaluable.prepare(&arguments.laws, &arguments.reading, messages)?;
    let Some(mut prepared) = prepared.filter(|prepared| !prepared.deck_has_errors) else { return Ok(None) };
    let gathered = gather(&evaluable, &mut prepared)?;
    messages.data(gathered.findings.list().to_vec(), &prepared.settings);
    Ok(Some((gathered, prepared)))
}

fn read(path: &Path, arguments: &PlotArguments) -> Result<DrawnDeck, Failure> {
    let settings = arguments.reading.settings(path)?;
    let read = ReadDeck::read(path, Keep::Interpreted, &settings)?;
    let findings = if arguments.findings { read.check(&settings) } else { Vec::new() };
    Ok(DrawnDeck { name: path.display().to_string(), settings, model: read.model, findings })
}

fn figures(
    arguments: &PlotArguments,
    decks: &[DrawnDeck],
    nodes: Option<&(Gathered, Evaluable)>,
) -> Result<Vec<Figure>, Failure> {
    let scales = arguments.log.unwrap_or(Scales::LINEAR);
    let detail = match scales {
        Scales { x: ScaleKind::Linear, y: ScaleKind::Linear } => Detail::Rows,
        Scales { x: ScaleKind::Linear, .. } => Detail::Even(ON_LOGARITHMIC),
        _ => Detail::Geometric(ON_LOGARITHMIC),
    };
    let is_page = arguments.output.as_ref().is_some_and(|picture| picture.kind == PictureKind::Page);
    let mut request = if is_page {
        arguments.drawing.request(Detail::Even(report::VALUES), MAX_PANELS, Probing::On)
    } else {
        arguments.drawing.request(detail, MAX_PANELS, Probing::Off)
    };
    if let Some((gathered, evaluable)) = nodes {
        request.held_places = gathered.held_places(evaluable);
    }
    let Some(first) = decks.first() else { return Ok(Vec::new()) };
    let grammar = first.settings.grammar;
    let choices = arguments.laws.choices(&first.model, grammar.dialect(), None)?;
    let named: Vec<(&str, &Model)> = decks.iter().map(|deck| (deck.name.as_str(), &deck.model)).collect();
    let mut figures = curves::figures(&named, grammar, &choices, &request);
    if let (Some((gathered, evaluable)), Some(figure)) = (nodes, figures.first_mut()) {
        gathered.place(figure, evaluable);
    }
    for (figure, deck) in figures.iter_mut().zip(decks) {
        curves::mark_findings(figure, &deck.model, &deck.findings);
        if !std::ptr::eq(deck, first) {
            let changed = curves::changes(&first.model, &deck.model, &request.laws);
            let more = changed.len().saturating_sub(MAX_CHANGES);
            if changed.is_empty() {
                figure.notes.push(format!("the same as {}", first.name));
            }
            let since = |line: String| format!("changed since {}: {line}", first.name);
            figure.notes.extend(changed.into_iter().take(MAX_CHANGES).map(since));
            figure.notes.extend((0 < more).then(|| format!("{more} more changes")));
        }
    }
    Ok(figures)
}

/// The reason why there is no curve at all.
fn nothing_to_draw(figures: &[Figure]) -> Failure {
    let decks = in_backticks(figures.iter().map(|figure| &figure.deck));
    let notes: Vec<&str> = figures.iter().flat_map(|figure| &figure.notes).map(String::as_str).collect();
    let reasons = if notes.is_empty() { String::new() } else { format!(" ({})", notes.join("; ")) };
    Failure::Data(format!("there is no table of conductance, permeability or view factor to draw in {decks}{reasons}"))
}

fn picture(text: &str) -> Result<Picture, String> {
    let path = Path::new(text);
    let is_page = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("html"));
    let kind = match DrawingFormat::of_name(path) {
        Some(format) => PictureKind::Drawing(format),
        None if is_page => PictureKind::Page,
        None => return Err("the name of a picture must end in .svg, .png or .html".to_owned()),
    };
    Ok(Picture { path: path.to_owned(), kind })
}

/// `fv1=2`.
fn held(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text.split_once('=').ok_or("expected NAME=VALUE, such as temp=150 or fv1=2")?;
    match value.trim().parse::<f64>() {
        Ok(value) if value.is_finite() => Ok((name.trim().to_ascii_lowercase(), value)),
        _ => Err(format!("expected a number after `{}=`, found `{}`", name.trim(), value.trim())),
    }
}
