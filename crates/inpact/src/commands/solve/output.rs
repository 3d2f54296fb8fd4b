//! The results of solving, streamed to their files.

use super::super::findings::Messages;
use super::summary::balances;
use super::{SolveArguments, interfaces};
use crate::commands::evaluable::kept_rows;
use crate::commands::solvable::SolvableScene;
use crate::failure::Failure;
use crate::files::{ResultFile, STANDARD_STREAM};
use crate::render::Format;
use clap::ValueEnum;
use inpact_evaluation::nodes::KeptRows;
use inpact_network::scene::Field;
use inpact_network::tables::{InterfaceTable, Times, link_header, link_rows, state_header, state_rows};
use inpact_network::{Problem, State};
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum StateFormat {
    /// Comma-separated values.
    Csv,
    /// One JSON document.
    Json,
}

impl StateFormat {
    pub(super) fn of_findings(self) -> Format {
        match self {
            Self::Csv => Format::Concise,
            Self::Json => Format::Json,
        }
    }
}

pub(super) struct Outputs<'a> {
    prepared: &'a SolvableScene,
    problem: &'a Problem<'a>,
    format: StateFormat,
    times: Times,
    states: ResultFile,
    /// The flows of links that are written after the states.
    appended_links: Option<Vec<u8>>,
    link_file: Option<ResultFile>,
    interfaces: Option<Interfaces<'a>>,
    /// The states as JSON.
    documents: Vec<Value>,
    /// A state has been taken: before that nothing is written.
    has_begun: bool,
}

/// The rows of the interfaces, and where their results go.
struct Interfaces<'a> {
    target: PathBuf,
    table: InterfaceTable<'a>,
    rows: KeptRows,
    taken: u64,
}

impl<'a> Outputs<'a> {
    pub(super) fn create(
        arguments: &SolveArguments,
        prepared: &'a SolvableScene,
        problem: &'a Problem<'a>,
    ) -> Result<Self, Failure> {
        let times = Times::of(problem);
        let links = arguments.links.as_deref();
        let is_appended = |links: &Path| links.as_os_str() == STANDARD_STREAM;
        Ok(Self {
            prepared,
            problem,
            format: arguments.format,
            times,
            states: ResultFile::create(arguments.output.as_deref())?,
            appended_links: links.filter(|links| is_appended(links)).map(|_| Vec::new()),
            link_file: links
                .filter(|links| !is_appended(links))
                .map(|target| ResultFile::create(Some(target)))
                .transpose()?,
            interfaces: arguments.interfaces.clone().map(|target| {
                let table = InterfaceTable::new(problem, &prepared.model);
                let mut rows = kept_rows();
                rows.begin(table.selection());
                Interfaces { target, table, rows, taken: 0 }
            }),
            documents: Vec::new(),
            has_begun: false,
        })
    }

    /// Writes the head above all states.
    fn begin(&mut self) -> Result<(), Failure> {
        if self.format == StateFormat::Csv {
            self.states.put(state_header(self.times).as_bytes())?;
        }
        if let Some(links) = &mut self.link_file {
            links.put(link_header(self.times).as_bytes())?;
        }
        Ok(())
    }

    /// Adds the next state.
    pub(super) fn take(&mut self, state: &State) -> Result<(), Failure> {
        let (problem, times) = (self.problem, self.times);
        if !std::mem::replace(&mut self.has_begun, true) {
            self.begin()?;
        }
        let mut text = Vec::new();
        match self.format {
            StateFormat::Csv => {
                state_rows(problem, state, times, &mut text);
                self.states.put(&text)?;
            }
            StateFormat::Json => self.documents.push(document(problem, state, self.appended_links.is_some())),
        }
        if let (Some(links), StateFormat::Csv) = (&mut self.appended_links, self.format) {
            link_rows(problem, state, times, links);
        }
        if let Some(file) = &mut self.link_file {
            text.clear();
            link_rows(problem, state, times, &mut text);
            file.put(&text)?;
        }
        if let Some(Interfaces { table, rows, taken, target }) = &mut self.interfaces {
            let batch = table.rows(state, *taken);
            *taken += batch.rows as u64;
            rows.push(batch).map_err(|error| Failure::write(target, error))?;
        }
        Ok(())
    }

    /// Writes the rest, and renames the files to their targets.
    pub(super) fn finish(mut self, last: &State, messages: Messages<'_>) -> Result<(), Failure> {
        match self.format {
            StateFormat::Csv => {
                if let Some(links) = &self.appended_links {
                    self.states.put(format!("\n{}", link_header(self.times)).as_bytes())?;
                    self.states.put(links)?;
                }
            }
            StateFormat::Json => {
                let whole = self.whole(last);
                self.states.put(format!("{whole:#}\n").as_bytes())?;
            }
        }
        // The solution does not depend on whether its interfaces can be evaluated.
        self.states.finish()?;
        if let Some(file) = self.link_file {
            file.finish()?;
        }
        if let Some(Interfaces { target, table, rows, .. }) = self.interfaces {
            interfaces::write(self.prepared, table.selection(), rows, &target, messages)?;
        }
        Ok(())
    }

    /// The JSON document: the last state first, then all of them where there are several.
    fn whole(&mut self, last: &State) -> Value {
        let fields: Vec<&str> = self.problem.solved_fields().iter().map(|field| field.key()).collect();
        let mut whole = Map::new();
        whole.insert("schema".to_owned(), json!("inpact/state/1"));
        whole.insert("scene".to_owned(), json!(self.prepared.name));
        whole.insert("deck".to_owned(), json!(self.prepared.deck_name));
        let procedure = if self.times == Times::Many { "transient" } else { "steady" };
        whole.insert("procedure".to_owned(), json!(procedure));
        whole.insert("fields".to_owned(), json!(fields));
        whole.insert("left_out".to_owned(), json!(self.problem.left_out));
        if let Some(Value::Object(state)) = self.documents.last().cloned() {
            whole.extend(state);
        }
        whole.insert("balance".to_owned(), balances(self.problem, last));
        if self.times == Times::Many {
            whole.insert("states".to_owned(), Value::Array(std::mem::take(&mut self.documents)));
        }
        Value::Object(whole)
    }
}

fn document(problem: &Problem<'_>, state: &State, with_links: bool) -> Value {
    let scene = problem.scene();
    let nodes = (0..).zip(&scene.nodes).map(|(number, name)| {
        let mut node = Map::from_iter([("node".to_owned(), json!(name))]);
        for field in Field::ALL {
            node.insert(field.key().to_owned(), json!(state.value(problem, field, number)));
        }
        Value::Object(node)
    });
    let mut document = Map::from_iter([("time".to_owned(), json!(state.time))]);
    document.insert("nodes".to_owned(), nodes.collect());
    if with_links {
        let links = (0..).zip(&scene.links).map(|(number, link)| {
            let names = link.nodes.map(|node| &scene.nodes[node as usize]);
            let mut of_link = Map::from_iter([("nodes".to_owned(), json!(names))]);
            for field in Field::ALL {
                of_link.insert(field.flow_name().to_owned(), json!(state.link_flow(problem, field, number)));
            }
            Value::Object(of_link)
        });
        document.insert("links".to_owned(), links.collect());
    }
    Value::Object(document)
}
