//! Steady state or transient: by the procedures of the deck, unless chosen otherwise (section 9.2, A-43).

use inpact_parser::model::{Model, Procedure, Regime};
use std::fmt;

/// The regime a law is evaluated in, and why.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RegimeInForce {
    /// Steady state or transient.
    pub regime: Regime,
    /// Why.
    pub reason: RegimeReason,
}

/// The decision between steady state and transient, and its reason.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum RegimeReason {
    /// The user.
    Chosen,
    /// The last procedure of the deck that solves the law's field.
    Procedure {
        /// Its step, from 1; 0 outside a step.
        step: usize,
        /// Its keyword.
        keyword: String,
        /// How many procedures before it solve the same field in the other regime.
        others: usize,
    },
    /// No procedure of the deck solves the law's field: steady state.
    NoProcedure,
}

impl RegimeInForce {
    /// Whether the deck has procedures of both kinds, of which the last decided for all rows.
    pub fn is_disputed(&self) -> bool {
        matches!(self.reason, RegimeReason::Procedure { others, .. } if others > 0)
    }
}

/// The regime of a law whose field the procedures with `solves` solve.
pub(crate) fn regime(model: &Model, chosen: Option<Regime>, solves: impl Fn(&Procedure) -> bool) -> RegimeInForce {
    if let Some(regime) = chosen {
        return RegimeInForce { regime, reason: RegimeReason::Chosen };
    }
    let found = model.procedures.iter().filter(|procedure| solves(procedure));
    let found: Vec<(&Procedure, Regime)> =
        found.filter_map(|procedure| Some((procedure, procedure.regime()?))).collect();
    let Some((last, regime)) = found.last() else {
        return RegimeInForce { regime: Regime::SteadyState, reason: RegimeReason::NoProcedure };
    };
    let others = found.iter().filter(|(_, other)| other != regime).count();
    let reason = RegimeReason::Procedure { step: last.step, keyword: last.option.keyword.to_string(), others };
    RegimeInForce { regime: *regime, reason }
}

impl fmt::Display for RegimeInForce {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self.regime {
            Regime::SteadyState => "steady state",
            Regime::Transient => "transient",
        })?;
        match &self.reason {
            RegimeReason::Chosen => formatter.write_str(" as chosen"),
            RegimeReason::NoProcedure => formatter.write_str(": no procedure of the deck solves its field"),
            RegimeReason::Procedure { step, keyword, others } => {
                write!(formatter, " by *{keyword}")?;
                if *step > 0 {
                    write!(formatter, " of step {step}")?;
                }
                match others {
                    0 => Ok(()),
                    1 => formatter
                        .write_str(", the last that solves its field; 1 procedure before it is of the other kind"),
                    _ => write!(
                        formatter,
                        ", the last that solves its field; {others} procedures before it are of the other kind"
                    ),
                }
            }
        }
    }
}
