//! Result files of solvers: bytes to columns, and pictures for ParaView.
//!
//! Nothing here knows a deck or a law, and no file is opened: bytes come in, values go out.
//! Values are in the units of the file, which are those of its deck: lengths (L), times (T), temperatures (θ), potentials (φ).
//!
//! | file | of | how it is requested | read by |
//! |---|---|---|---|
//! | `.fil` in ASCII | Abaqus | `*FILE FORMAT, ASCII`, `*CONTACT FILE`, `*NODE FILE` | [`read_fil`] |
//! | `.rpt` | Abaqus/Viewer | Report, Field Output or XY | [`read_rpt`] |
//! | `.frd` in ASCII | CalculiX | `*NODE FILE`, `*CONTACT FILE` | [`read_frd`] |
//! | `.dat` | CalculiX | `*NODE PRINT`, `*CONTACT PRINT` | [`read_dat`] |
//! | `.vtu` | inpact, ParaView | | [`read_vtu`], [`vtu::read_grid`] |
//!
//! [`read`] detects the format from the bytes, [`read_frames`] streams a source of any length state by state.
//! A truncated or damaged file is an [`Error`]: the problem with its place and what to do, and the part before it.
//!
//! ```
//! let text = "\n relative contact displacement (slave node,normal,tang1,tang2) for all contact elements and time 0.5\n\n    \
//!             65 -1.0E-04  0.0E+00  0.0E+00\n";
//! let results = inpact_results::read(text.as_bytes())?;
//! let frame = &results.frames[0];
//! assert_eq!(frame.total_time, Some(0.5));
//! let (field, opening) = frame.column("COPEN").expect("there");
//! assert_eq!(field.rows.nodes(), Some(&[65][..]));
//! assert_eq!(opening.values, [-1.0e-4]);
//! # Ok::<(), inpact_results::Error>(())
//! ```

mod collect;
mod error;
mod format;
mod frames;
mod lines;
mod number;

mod problem;
mod recognise;
mod results;
mod taker;

mod dat;
mod fil;
mod frd;
mod rpt;
pub mod vtu;

pub use dat::read_dat;
pub use error::{Error, ErrorKind, Read};
pub use fil::read_fil;
pub use format::Format;
pub use frames::read_frames;
pub use frd::read_frd;
pub use problem::{Place, Problem};
pub use results::{Column, Field, Frame, Name, NotRead, Region, Results, Rows, Surface, SurfaceFace};
pub use rpt::read_rpt;
pub use taker::TakeFrame;
pub use vtu::read_vtu;

/// Reads a result file of any supported format, which is detected from its content.
///
/// # Errors
/// A file of unknown kind, binary or in another encoding, or one that cannot be read to its end.
pub fn read(bytes: &[u8]) -> Read {
    match recognise::recognise(bytes).map_err(Error::foreign)? {
        Format::Fil => read_fil(bytes),
        Format::Rpt => read_rpt(bytes),
        Format::Frd => read_frd(bytes),
        Format::Dat => read_dat(bytes),
        Format::Vtu => read_vtu(bytes),
    }
}
