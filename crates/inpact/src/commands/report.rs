//! `inpact report`: a deck in, a page about its interfaces out.

use super::eval::summary_lines;
use super::evaluable::{Evaluable, EvaluableArguments};
use super::findings::Messages;
use super::job_results::RESULTS_HELP;
use super::laws::LawArguments;
use super::node_sample::{Gathered, gather};
use super::plot::DrawingArguments;
use super::tradeoff;
use crate::curves::{self, Detail, Probing};
use crate::deck::Deck;
use crate::failure::{Failure, Outcome, say};
use crate::files;
use crate::report::{Evaluation, Input, Report, Tradeoff, VALUES};
use crate::settings::DeckArguments;
use crate::text::counted;
use clap::Args;
use inpact_diagnostics::Severity;
use inpact_evaluation::HistoryStart;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct ReportArguments {
    /// The deck or fragment; `-` reads standard input.
    #[arg(value_name = "DECK")]
    deck: PathBuf,
    /// A node table: its rows on the curves, and what the deck gives on them.
    #[arg(long, value_name = "TABLE", conflicts_with = "results")]
    nodes: Option<PathBuf>,
    #[arg(long, value_name = "FILE", help = RESULTS_HELP)]
    results: Vec<PathBuf>,
    /// Evaluate on the rows that the deck's own mesh gives, as `inpact nodes` makes them, and show its interfaces in space.
    #[arg(long, conflicts_with_all = ["nodes", "results"])]
    mesh: bool,
    /// Measure what accuracy costs on these rows as well, and draw it: error against time, as `inpact tradeoff` does. Times are of the day, and so are the bytes of the page.
    #[arg(long)]
    tradeoff: bool,
    /// Where to write the page, instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    drawing: DrawingArguments,
    #[command(flatten)]
    laws: LawArguments,
    #[command(flatten)]
    reading: DeckArguments,
}

const MAX_PANELS: usize = 250;

pub(crate) fn run(arguments: &ReportArguments) -> Result<Outcome, Failure> {
    files::name_as_inputs(std::slice::from_ref(&arguments.deck));
    files::name_as_inputs(&arguments.nodes.iter().chain(&arguments.results).collect::<Vec<_>>());
    files::check_targets(&[arguments.output.as_deref()])?;
    let deck = Deck::read(&arguments.deck, &arguments.reading.options()).map_err(crate::error::Error::into_failure)?;
    arguments.drawing.refuse_unknown(&[deck.model()])?;
    let findings = deck.check();
    let choices = arguments.laws.choices(deck.model(), deck.grammar().dialect(), None)?;
    let mut request = arguments.drawing.request(Detail::Even(VALUES), MAX_PANELS, Probing::On);
    let has_rows = arguments.mesh || arguments.nodes.is_some() || !arguments.results.is_empty();
    if arguments.tradeoff && !has_rows {
        let message = "`--tradeoff` measures on rows: give `--nodes TABLE`, `--results FILE` or `--mesh`";
        return Err(Failure::Usage(message.to_owned()));
    }
    let mut evaluated = if has_rows {
        let Some(evaluated) = evaluated(arguments)? else { return Ok(Outcome::HasErrors) };
        Some(evaluated)
    } else {
        None
    };
    if let Some(Evaluated { prepared, gathered: Some(gathered), .. }) = &evaluated {
        request.held_places = gathered.held_places(prepared);
    }
    let mut figure = curves::figure((deck.name(), deck.model()), deck.grammar(), &choices, &request);
    curves::mark_findings(&mut figure, deck.model(), &findings);
    if let Some(Evaluated { prepared, gathered: Some(gathered), .. }) = &evaluated {
        gathered.place(&mut figure, prepared);
    }
    let evaluation = evaluated.as_mut().map(Evaluated::in_words);
    // The included files are known now.
    files::check_targets(&[arguments.output.as_deref()])?;
    let inputs = inputs(arguments, &deck)?;
    let report =
        Report { deck: &deck, findings: &findings, figure: &figure, evaluation, inputs, command: command(arguments) };
    files::write_result(arguments.output.as_deref(), report.html().as_bytes())?;
    if deck.model().interactions.is_empty() {
        say(&format!("note: `{}` defines no *SURFACE INTERACTION: the page has its findings alone", deck.name()));
    }
    let errors = findings.iter().filter(|found| found.severity == Severity::Error).count();
    if 0 < errors {
        let errors = counted(errors, "error");
        say(&format!("{errors} in the deck: see the page, or `inpact check {}`", deck.name()));
    }
    let is_sound = errors == 0 && evaluated.is_none_or(|evaluated| evaluated.is_sound());
    Ok(if is_sound { Outcome::Clean } else { Outcome::HasErrors })
}

/// A node table that was evaluated; a deck that is wrong where the table needs it gives a plan alone.
struct Evaluated {
    prepared: Evaluable,
    gathered: Option<Gathered>,
    tradeoff: Option<Tradeoff>,
    /// Whether the node table has errors, which were said.
    rows_have_errors: bool,
}

/// Evaluates the node table; `None` after reporting its faults.
fn evaluated(arguments: &ReportArguments) -> Result<Option<Evaluated>, Failure> {
    let deck = arguments.deck.clone();
    let evaluable = match &arguments.nodes {
        Some(nodes) => EvaluableArguments::of_nodes(deck, nodes.clone()),
        None => EvaluableArguments::of_results(deck, arguments.results.clone(), HistoryStart::FirstRow),
    };
    let messages = Messages::LINES;
    let Some(mut prepared) = evaluable.prepare(&arguments.laws, &arguments.reading, messages)? else { return Ok(None) };
    if prepared.deck_has_errors {
        return Ok(Some(Evaluated { prepared, gathered: None, tradeoff: None, rows_have_errors: false }));
    }
    let again = if arguments.tradeoff { Some(prepared.rows_again(&evaluable)?) } else { None };
    let gathered = gather(&evaluable, &mut prepared)?;
    let rows_have_errors = messages.data(gathered.findings.list().to_vec(), &prepared.settings);
    let tradeoff = match again {
        Some(rows) => {
            prepared.rows = rows;
            let (chart, text) = tradeoff::diagram(&mut prepared, evaluable.nodes_path())?;
            Some(Tradeoff { svg: chart.svg(), text })
        }
        None => None,
    };
    Ok(Some(Evaluated { prepared, gathered: Some(gathered), tradeoff, rows_have_errors }))
}

impl Evaluated {
    /// Whether everything was evaluated, on rows without errors.
    fn is_sound(&self) -> bool {
        self.gathered.is_some() && !self.rows_have_errors
    }

    fn in_words(&mut self) -> Evaluation {
        let (nodes, plan) = (self.prepared.nodes_name.clone(), self.prepared.plan.to_string());
        match &mut self.gathered {
            Some(gathered) => Evaluation {
                nodes,
                plan,
                summary: summary_lines(&gathered.tally, &self.prepared.plan),
                histories: std::mem::take(&mut gathered.histories),
                surfaces: std::mem::take(&mut gathered.surfaces),
                tradeoff: self.tradeoff.take(),
            },
            None => {
                let nothing = "The deck is wrong where the node table needs it: nothing was evaluated.";
                Evaluation { nodes, plan, summary: vec![nothing.to_owned()], ..Evaluation::default() }
            }
        }
    }
}

/// The input files of the page.
fn inputs(arguments: &ReportArguments, deck: &Deck) -> Result<Vec<Input>, Failure> {
    let is_stream = arguments.deck.as_os_str() == files::STANDARD_STREAM;
    let mut inputs = vec![Input::of(&arguments.deck)?];
    // By their names in the deck, so that paths are not disclosed.
    let names = deck.syntax().sources().iter().map(inpact_parser::deck::Source::name);
    let included = deck
        .files()
        .iter()
        .zip(names)
        .skip(1)
        .map(|(path, name)| Ok(Input { name: name.to_owned(), ..Input::of(path)? }));
    inputs.extend(if is_stream { Vec::new() } else { included.collect::<Result<Vec<_>, Failure>>()? });
    for path in arguments.nodes.iter().chain(&arguments.results) {
        inputs.push(Input::of(path)?);
    }
    Ok(inputs)
}

/// The arguments as given, without the folder of the program.
fn command(arguments: &ReportArguments) -> String {
    let output = arguments.output.as_ref().map(|path| path.as_os_str());
    let is_word =
        |text: &str| text.chars().all(|character| character.is_ascii_alphanumeric() || "-_./=,:".contains(character));
    let quoted = |text: &str| {
        if !text.is_empty() && is_word(text) { text.to_owned() } else { format!("'{}'", text.replace('\'', "'\\''")) }
    };
    let given = std::env::args_os().skip(1);
    let given = given.map(|argument| {
        // Reports of the same inputs are equal, wherever they are written.
        if Some(argument.as_os_str()) == output {
            "report.html".to_owned()
        } else {
            quoted(&argument.to_string_lossy())
        }
    });
    std::iter::once("inpact".to_owned()).chain(given).collect::<Vec<_>>().join(" ")
}
