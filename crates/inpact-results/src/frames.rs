//! Streaming state by state: only the current state and data outside of states are in memory.

use crate::error::{Error, Read};
use crate::format::Format;
use crate::lines::LineStream;
use crate::recognise::{HEAD, recognise};
use crate::results::Results;
use crate::taker::{ReadFrames, TakeFrame};
use crate::{dat, fil, frd, rpt, vtu};
use std::io::{self, Read as _};

/// Reads a result file of any supported format, state by state.
///
/// Each state is passed to `take` as soon as it is complete, with the coordinates and surfaces read before it.
/// Returns the data that belong to no state, as [`Results`] without frames; if `take` stopped, those read until then.
/// Memory does not grow with the number of states, except for `.rpt` and `.vtu`, which are read as a whole.
///
/// ```
/// use std::ops::ControlFlow;
///
/// let text = " relative contact displacement (slave node,normal,tang1,tang2) for all contact elements and time 0.5\n\n    \
///             65 -1.0E-04  0.0E+00  0.0E+00\n";
/// let mut times = Vec::new();
/// inpact_results::read_frames(&mut text.as_bytes(), &mut |_, frame| {
///     times.push(frame.total_time);
///     ControlFlow::Continue(())
/// })?;
/// assert_eq!(times, [Some(0.5)]);
/// # Ok::<(), inpact_results::Error>(())
/// ```
///
/// # Errors
/// The source fails, or holds a file of unknown kind, binary or in another encoding, or one that cannot be read to its end.
pub fn read_frames(source: &mut dyn io::Read, take: &mut TakeFrame<'_>) -> Result<Results, Error> {
    let mut head = Vec::new();
    io::Read::take(&mut *source, HEAD as u64).read_to_end(&mut head)?;
    let format = recognise(&head).map_err(Error::foreign)?;
    let mut source = io::Read::chain(head.as_slice(), source);
    let read: ReadFrames = match format {
        Format::Fil => fil::frames,
        Format::Frd => frd::frames,
        Format::Dat => dat::frames,
        Format::Rpt => return of_whole(&mut source, rpt::read_rpt, take),
        Format::Vtu => return of_whole(&mut source, vtu::read_vtu, take),
    };
    let mut lines = LineStream::new(&mut source);
    let (results, outcome) = read(&mut lines, take);
    // A failed source looks like a truncated file.
    if let Some(failure) = lines.take_failure() {
        return Err(failure.into());
    }
    outcome.map(|()| results).map_err(|problem| Error::unsound(problem, None))
}

/// Reads a source to its end, then passes on the states.
fn of_whole(source: &mut dyn io::Read, read: fn(&[u8]) -> Read, take: &mut TakeFrame<'_>) -> Result<Results, Error> {
    let mut bytes = Vec::new();
    source.read_to_end(&mut bytes)?;
    let (results, failed) = match read(&bytes) {
        Ok(results) => (Some(results), None),
        Err(error) => {
            let (kind, read) = error.into_parts();
            (read, Some(kind))
        }
    };
    drop(bytes);
    let mut results = results.unwrap_or_else(|| Results::new(Format::Rpt));
    for frame in std::mem::take(&mut results.frames) {
        if take(&results, frame).is_break() {
            return Ok(results);
        }
    }
    failed.map_or(Ok(results), |kind| Err(kind.into()))
}
