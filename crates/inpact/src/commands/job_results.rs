//! Result files of a deck's own job, joined with its mesh.

use super::findings::Messages;
use super::meshed::MeshedDeck;
use crate::failure::Failure;
use crate::files;
use inpact_contact::{Join, Joined, ResultFile, ResultNote, State};
use inpact_diagnostics::visible::visible_line;
use inpact_results::{ErrorKind, Frame, Problem, Results, read_frames};
use serde_json::json;
use std::io::Read;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// The maximum number of notes of one run.
const MAX_NOTES: usize = 100;

pub(crate) const RESULTS_HELP: &str = "What the deck's own job wrote: .frd or .dat of CalculiX, .fil (ASCII) or .rpt of Abaqus, .vtu; may be given several times: files are joined by their times, and where two say something of a node, the one named first counts";

/// Reads result files and joins them with the mesh, after reporting unusable parts.
pub(crate) fn states(results: &[PathBuf], meshed: &MeshedDeck, messages: Messages<'_>) -> Result<Joined, Failure> {
    let joined = join(results, meshed)?;
    say_notes(&joined.notes, messages);
    Ok(joined)
}

/// The states of a mesh at the times of result files, or the initial state without any.
pub(crate) fn join(results: &[PathBuf], meshed: &MeshedDeck) -> Result<Joined, Failure> {
    if results.is_empty() || meshed.mesh.pairs.is_empty() {
        return Ok(Joined { states: vec![State::initial(&meshed.mesh)], files: Vec::new(), notes: Vec::new() });
    }
    let mut join = Join::new(&meshed.mesh, &meshed.read.model);
    for path in results {
        join.add(&path.display().to_string(), &FileOnDisk::open(path)?)?;
    }
    Ok(join.finish()?)
}

/// A result file on disk.
struct FileOnDisk<'a> {
    path: &'a Path,
    /// The bytes of a stream, which cannot be read a second time.
    spooled: Option<Vec<u8>>,
}

impl<'a> FileOnDisk<'a> {
    fn open(path: &'a Path) -> Result<Self, Failure> {
        let mut spooled = None;
        if files::is_stream(path) {
            let bytes = spooled.insert(Vec::new());
            files::open(path)?.read_to_end(bytes).map_err(|error| Failure::read(path, error))?;
        }
        Ok(Self { path, spooled })
    }
}

impl ResultFile for FileOnDisk<'_> {
    type Error = Failure;

    fn frames(&self, take: &mut dyn FnMut(&Results, &Frame) -> ControlFlow<()>) -> Result<Results, Failure> {
        let mut source: Box<dyn Read + '_> = match &self.spooled {
            Some(bytes) => Box::new(bytes.as_slice()),
            None => files::open(self.path)?,
        };
        let (mut states, mut time) = (0, None);
        let read = read_frames(&mut source, &mut |head, frame| {
            states += 1;
            time = frame.total_time.or(frame.step_time).or(time);
            take(head, &frame)
        });
        read.map_err(|error| match error.into_kind() {
            ErrorKind::Source(error) => Failure::read(self.path, error),
            ErrorKind::Unsound(problem) => unsound(self.path, &problem, &before(states, time)),
            ErrorKind::Foreign(problem) => unsound(self.path, &problem, ""),
            other => Failure::Data(format!("{}: {}", self.path.display(), inpact_results::Error::from(other))),
        })
    }
}

/// Reports where a file is truncated, and the part before that.
fn unsound(path: &Path, problem: &Problem, before: &str) -> Failure {
    Failure::Data(format!("{}:{}: {} ({}){before}", path.display(), problem.place.line, problem.message, problem.help))
}

/// The states before the truncation of a file.
fn before(states: usize, time: Option<f64>) -> String {
    let to = time.map_or_else(String::new, |time| format!(" up to time {time:?}"));
    match states {
        0 => "; no state is before it".to_owned(),
        1 => format!("; 1 state{to} is before it, which may not be whole"),
        states => format!("; {states} states{to} are before it, the last of which may not be whole"),
    }
}

fn say_notes(notes: &[ResultNote], messages: Messages<'_>) {
    for ResultNote { file, message } in notes.iter().take(MAX_NOTES) {
        messages.tell(
            || vec![visible_line(&format!("{file}: note: {message}")).into_owned()],
            || json!({ "severity": "note", "file": &**file, "message": message }).to_string(),
        );
    }
    let more = notes.len().saturating_sub(MAX_NOTES);
    if 0 < more {
        messages.remark(|| format!("note: {more} more notes on results"));
    }
}
