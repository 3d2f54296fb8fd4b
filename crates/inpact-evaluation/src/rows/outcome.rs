//! The outcome of a law in a row.

use super::UserFaultInRow;
use crate::law::contact::ContactState;
use crate::results::Status;

/// Results of a law in a row.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Outcome {
    /// The row lacks a number that the law needs.
    Incomplete,
    /// It was evaluated, with this status.
    Evaluated(Option<Status>),
    /// A user's routine gave an invalid conductance, with a message in the first rows.
    Faulty(Option<Box<UserFaultInRow>>),
}

/// The status of a row by contact; `None` where it is undetermined.
pub(crate) fn contact_status(state: ContactState) -> Option<Status> {
    match state {
        ContactState::Closed => Some(Status::Closed),
        ContactState::Open => Some(Status::Open),
        ContactState::Undetermined => None,
    }
}
