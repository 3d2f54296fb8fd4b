//! The error type of this crate.

use crate::linear::{Method, MethodFailure, NoSolution};
use crate::scene::Field;
use inpact_evaluation::law::UserFault;
use std::error;
use std::fmt;

/// A scene or a linear network without a solution.
///
/// Nodes and rows are given by index, from zero: in the network that was solved, or in the scene.
/// A fault of the scene itself is a finding, not an error.
///
/// ```
/// use inpact_network::ErrorKind;
/// use inpact_network::linear::{LAST_DIGIT, LinearNetwork, Link, Method, Solver};
///
/// // Two nodes, joined and held by nothing.
/// let mut network = LinearNetwork::of_nodes(2);
/// network.links.push(Link { nodes: [0, 1], conductance: 1.0 });
/// let error = Solver::new(Method::Direct, LAST_DIGIT).solve(&network).unwrap_err();
/// assert_eq!(error.kind(), &ErrorKind::Floating { components: vec![vec![0, 1]] });
/// assert_eq!(error.to_string(), "no path to a known value from node 0 and the node connected with it");
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Error {
    field: Option<Field>,
    kind: ErrorKind,
}

/// Reasons why there is no solution.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum ErrorKind {
    /// Connected components without a path to a held value or a store; a path needs conductances above zero.
    Floating {
        /// The nodes of each, in ascending order.
        components: Vec<Vec<u32>>,
    },
    /// Two nodes that are held at different values have one value, by infinite conductances between them.
    Contradiction {
        /// The nodes.
        nodes: [u32; 2],
        /// The held values of the two.
        values: [f64; 2],
    },
    /// A law of a row cannot be evaluated to a solvable value.
    Row {
        /// The row, in the order of the scene.
        row: u32,
        /// The fault.
        fault: RowFault,
    },
    /// No linear solver came within the tolerance.
    NotSolved {
        /// The methods tried, each with the reason of its failure.
        tried: Vec<(Method, MethodFailure)>,
    },
    /// A factorisation or a solve with its factor failed.
    NotFactored(NoSolution),
    /// A temperature would be below absolute zero.
    BelowAbsoluteZero {
        /// The node.
        node: u32,
        /// Its temperature, θ.
        value: f64,
        /// Absolute zero, θ.
        zero: f64,
    },
    /// Newton's iteration did not converge.
    NotConverged {
        /// The number of steps.
        steps: usize,
        /// For each field the largest residual, relative to its largest flow, and its node.
        worst: Vec<(Field, f64, Option<u32>)>,
        /// The relative distance of the conductances from those of the state, where its balances are met.
        inconsistency: Option<f64>,
    },
}

/// Reasons why a row cannot be solved.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum RowFault {
    /// A user routine gives an invalid conductance.
    User(UserFault),
    /// The flow of fluid depends on the characteristic element length, which is not known (Q-5).
    NeedsLength,
    /// A conductance is negative, NaN or infinite.
    NoConductance(f64),
    /// A conductance times the area of the row is beyond the range of f64.
    TooLarge {
        /// The conductance per area.
        conductance: f64,
        /// The area, L².
        area: f64,
    },
}

impl Error {
    /// The reason.
    pub fn kind(&self) -> &ErrorKind {
        &self.kind
    }

    /// The field whose equations have no solution; `None` for a standalone linear network, and where fields are solved together.
    pub fn field(&self) -> Option<Field> {
        self.field
    }

    /// The same of the equations of a field, whose nodes have these numbers in the scene.
    pub(crate) fn in_field(self, field: Field, nodes: &[u32]) -> Self {
        let node = |place: u32| nodes[place as usize];
        let kind = match self.kind {
            ErrorKind::Floating { mut components } => {
                components.iter_mut().flatten().for_each(|place| *place = node(*place));
                ErrorKind::Floating { components }
            }
            ErrorKind::Contradiction { nodes, values } => ErrorKind::Contradiction { nodes: nodes.map(node), values },
            kind => kind,
        };
        Self { field: Some(field), kind }
    }

    /// The same of a field, where the numbers are those of the scene.
    pub(crate) fn of_field(self, field: Field) -> Self {
        Self { field: Some(field), ..self }
    }

    pub(crate) fn not_solved(tried: Vec<(Method, MethodFailure)>) -> Self {
        ErrorKind::NotSolved { tried }.into()
    }

    /// Whether a shorter increment may succeed.
    pub(crate) fn may_be_of_length(&self) -> bool {
        matches!(self.kind, ErrorKind::NotConverged { .. } | ErrorKind::BelowAbsoluteZero { .. })
    }
}

impl From<ErrorKind> for Error {
    fn from(kind: ErrorKind) -> Self {
        Self { field: None, kind }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(field) = self.field {
            write!(formatter, "{field}: ")?;
        }
        match &self.kind {
            ErrorKind::Floating { components } => {
                formatter.write_str("no path to a known value from ")?;
                for (place, component) in components.iter().enumerate() {
                    let (first, others) = (component.first().copied().unwrap_or_default(), component.len() - 1);
                    let comma = if place == 0 { "" } else { ", nor from " };
                    write!(formatter, "{comma}node {first}")?;
                    match others {
                        0 => Ok(()),
                        1 => formatter.write_str(" and the node connected with it"),
                        _ => write!(formatter, " and the {others} nodes connected with it"),
                    }?;
                }
                Ok(())
            }
            ErrorKind::Contradiction { nodes: [a, b], values: [x, y] } => {
                write!(formatter, "infinite conductances join node {a}, held at {x:?}, and node {b}, held at {y:?}")
            }
            ErrorKind::Row { row, fault } => write!(formatter, "row {row}: {fault}"),
            ErrorKind::NotSolved { tried } => {
                formatter.write_str("no method solved the network")?;
                tried.iter().try_for_each(|(method, why)| write!(formatter, "; {method}: {why}"))
            }
            ErrorKind::NotFactored(reason) => reason.fmt(formatter),
            ErrorKind::BelowAbsoluteZero { node, value, zero } => {
                write!(formatter, "node {node} would be at {value:?}, below absolute zero at {zero:?}")
            }
            ErrorKind::NotConverged { steps, inconsistency: Some(inconsistency), .. } => write!(
                formatter,
                "the balances are met after {steps} steps, and the conductances are those of the state only to {inconsistency:.1e}"
            ),
            ErrorKind::NotConverged { steps, worst, inconsistency: None } => {
                write!(formatter, "the equations are not met after {steps} steps")?;
                worst.iter().try_for_each(|(field, share, node)| {
                    write!(formatter, "; {field}: {share:.1e} of the largest flow is missing")?;
                    node.map_or(Ok(()), |node| write!(formatter, ", worst at node {node}"))
                })
            }
        }
    }
}

impl fmt::Display for RowFault {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::User(fault) => write!(formatter, "user subroutine GAPELECTR {fault}"),
            Self::NeedsLength => formatter
                .write_str("it is open, and a cutoff of its pore fluid is left to the characteristic element length"),
            Self::NoConductance(value) => {
                write!(formatter, "expected a finite conductance of at least 0, found {value:?}")
            }
            Self::TooLarge { conductance, area } => {
                write!(formatter, "the conductance {conductance:?} times the area {area:?} is beyond the range of f64")
            }
        }
    }
}

impl error::Error for Error {}
