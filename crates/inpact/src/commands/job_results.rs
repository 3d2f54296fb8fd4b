//! Result files of a deck's own job, joined with its mesh.

use super::findings::Messages;
use super::meshed::MeshedDeck;
use crate::failure::Failure;
use crate::files;
use inpact_contact::{FileSummary, Join, Joined, ResultNote, State};
use inpact_diagnostics::visible::visible_line;
use inpact_results::{Incomplete, Results};
use serde_json::json;
use std::io::Read;
use std::path::{Path, PathBuf};

/// More notes than these of one run nobody reads.
const MOST_NOTES: usize = 100;

/// The help of `--results`.
pub(crate) const RESULTS_HELP: &str = "What the deck's own job wrote: .frd or .dat of CalculiX, .fil (ASCII) or .rpt of Abaqus, .vtu; may be given several times: files are joined by their times, and where two say something of a node, the one named first counts";

/// States of a mesh at the times of result files, or at the beginning where there are none.
pub(crate) struct States {
    pub(crate) states: Vec<State>,
    pub(crate) files: Vec<FileSummary>,
}

/// Reads result files and joins them with the mesh, after saying what could not be used.
pub(crate) fn states(results: &[PathBuf], meshed: &MeshedDeck, messages: Messages<'_>) -> Result<States, Failure> {
    let (states, notes) = join(results, meshed)?;
    say_notes(&notes, messages);
    Ok(states)
}

/// Reads result files and joins them with the mesh; gives what could not be used as well.
pub(crate) fn join(results: &[PathBuf], meshed: &MeshedDeck) -> Result<(States, Vec<ResultNote>), Failure> {
    if results.is_empty() || meshed.mesh.pairs.is_empty() {
        return Ok((States { states: vec![State::initial(&meshed.mesh)], files: Vec::new() }, Vec::new()));
    }
    let mut join = Join::new(&meshed.mesh, &meshed.read.model);
    let failed = |error: inpact_contact::Error| Failure::Data(error.to_string());
    for path in results {
        join.add(&path.display().to_string(), &read(path)?).map_err(failed)?;
    }
    let joined = join.finish();
    let Joined { states, files, notes } = joined.map_err(failed)?;
    Ok((States { states, files }, notes))
}

fn read(path: &Path) -> Result<Results, Failure> {
    let mut bytes = Vec::new();
    files::open(path)?.read_to_end(&mut bytes).map_err(|error| Failure::read(path, error))?;
    inpact_results::read(&bytes).map_err(|incomplete| unsound(path, &incomplete))
}

/// Reports where a file breaks off, and the part before.
fn unsound(path: &Path, incomplete: &Incomplete) -> Failure {
    let Incomplete { problem, read } = incomplete;
    let before = match read.as_deref() {
        None => String::new(),
        Some(results) => {
            let time = results.frames.iter().rev().find_map(|frame| frame.total_time.or(frame.step_time));
            let to = time.map_or_else(String::new, |time| format!(" up to time {time:?}"));
            match results.frames.len() {
                0 => "; no state is before it".to_owned(),
                1 => format!("; 1 state{to} is before it, which may not be whole"),
                frames => format!("; {frames} states{to} are before it, the last of which may not be whole"),
            }
        }
    };
    Failure::Data(format!("{}:{}: {} ({}){before}", path.display(), problem.place.line, problem.message, problem.help))
}

fn say_notes(notes: &[ResultNote], messages: Messages<'_>) {
    for ResultNote { file, message } in notes.iter().take(MOST_NOTES) {
        messages.tell(
            || vec![visible_line(&format!("{file}: note: {message}")).into_owned()],
            || json!({ "severity": "note", "file": &**file, "message": message }).to_string(),
        );
    }
    let more = notes.len().saturating_sub(MOST_NOTES);
    if 0 < more {
        messages.remark(|| format!("note: {more} more notes on results"));
    }
}
