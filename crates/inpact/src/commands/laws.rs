//! Options of laws, for every command that evaluates them.

use super::choice::{Choice, one_of};
use crate::failure::{Failure, say};
use crate::files;
use crate::text::above_zero;
use crate::user_library;
use clap::Args;
use inpact_evaluation::law::{CutoffBoundary, UserLaw};
use inpact_evaluation::plan::Choices;
use inpact_evaluation::table::Tail;
use inpact_parser::grammar::Dialect;
use inpact_parser::model::{Model, Regime};
use std::path::PathBuf;

#[derive(Debug, Default, Args)]
pub(crate) struct LawArguments {
    /// What follows the last point of conductance against clearance: the manual's text or its figure.
    #[arg(long, value_parser = one_of(&TAILS), default_value = "constant")]
    clearance_tail: Tail,
    /// The characteristic element length of all rows, the default of both cutoffs of pore fluid flow.
    #[arg(long, value_name = "X", value_parser = |text: &str| above_zero(text, "a length"))]
    char_length: Option<f64>,
    /// Whether pore fluid flows at the very cutoff.
    #[arg(long, value_parser = one_of(&BOUNDARIES), default_value = "inclusive")]
    cutoff_boundary: CutoffBoundary,
    /// A shared library with the user subroutine GAPELECTR, compiled with
    /// `gfortran -shared -fPIC -o gapelectr.so gapelectr.f`, for *GAP ELECTRICAL CONDUCTANCE, USER.
    ///
    /// It is loaded and run only when it is named here, and when an interaction of the deck has such a conductance.
    /// `INCLUDE 'ABA_PARAM.INC'` reads a file beside the source with one line, `      IMPLICIT REAL*8 (A-H,O-Z)`.
    /// It is native code: inpact cannot stop it from harm, and a crash in it ends the program.
    /// What it writes to unit 6 comes out on standard output: write the result to a file with `-o`.
    #[arg(long, value_name = "FILE")]
    user_library: Option<PathBuf>,
}

const TAILS: [Choice<Tail>; 2] = [
    ("constant", Tail::Constant, "The last value, as the text of the manual has it"),
    ("zero", Tail::Zero, "Zero, as its figure has it"),
];

const BOUNDARIES: [Choice<CutoffBoundary>; 2] = [
    ("inclusive", CutoffBoundary::Inclusive, "It does, as the user's guide has it"),
    ("exclusive", CutoffBoundary::Exclusive, "It does not, as the theory guide has it"),
];

impl LawArguments {
    /// The choices for the laws of a deck.
    ///
    /// # Errors
    /// A user library that cannot be used.
    pub(crate) fn choices(&self, model: &Model, dialect: Dialect, regime: Option<Regime>) -> Result<Choices, Failure> {
        Ok(Choices {
            regime,
            clearance_tail: self.clearance_tail,
            characteristic_length: self.char_length,
            cutoff_boundary: self.cutoff_boundary,
            dialect,
            user_conductance: self.user_conductance(model)?,
            ..Choices::default()
        })
    }

    /// The routine of `--user-library`, loaded only if an interaction of the deck needs one.
    fn user_conductance(&self, model: &Model) -> Result<Option<UserLaw>, Failure> {
        let Some(path) = &self.user_library else { return Ok(None) };
        files::name_as_input(path);
        let electrical = model.interactions.values().filter_map(|of| of.gap_electrical_conductance.as_ref());
        if electrical.filter(|option| option.user.is_some()).count() == 0 {
            let path = path.display();
            say(&format!("warning: no *GAP ELECTRICAL CONDUCTANCE of the deck has USER; `{path}` is not loaded"));
            return Ok(None);
        }
        user_library::load(path).map(Some)
    }
}
