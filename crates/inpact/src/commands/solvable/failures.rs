//! Findings of a scene that was not solved.

use crate::text::in_backticks;
use inpact_diagnostics::{Diagnostic, Findings, Place};
use inpact_evaluation::nodes::USER_FAULT;
use inpact_network::scene::{
    CONTRADICTORY_VALUES, FLOATING_BODY, Field, MISSING_QUANTITY, NOT_CONVERGED, Scene, UNUSABLE_NUMBER,
};
use inpact_network::{Error, ErrorKind, RowFault};

const MAX_NAMED: usize = 8;

/// The findings of a failure in a scene of this name, in the increment after a time where there was one.
pub(super) fn findings(failure: &Error, scene: &Scene, (name, after): (&str, Option<f64>)) -> Vec<Diagnostic> {
    let mut findings = Findings::new(name);
    let when = after.map_or(String::new(), |time| format!(" in the increment after time {time:?}"));
    let place = |node: u32| Place { line: scene.node_lines.get(&node).copied(), ..Place::default() };
    let node = |number: u32| format!("`{}`", scene.nodes[number as usize]);
    let field = failure.field().map_or_else(|| "the fields".to_owned(), |field| field.to_string());
    match failure.kind() {
        ErrorKind::Floating { components } => {
            for component in components {
                let at = component.first().map_or_else(Place::default, |&first| place(first));
                let message = format!("nothing holds the {field} of {}{when}", names(scene, component));
                findings.report(&FLOATING_BODY, at, message, floating_help(failure.field(), &field, scene));
            }
        }
        ErrorKind::Contradiction { nodes, values } => {
            let message = format!(
                "the {field} of {} is fixed at {:?} and that of {} at {:?}, and infinite conductances make them one{when}",
                node(nodes[0]),
                values[0],
                node(nodes[1]),
                values[1]
            );
            findings.report(&CONTRADICTORY_VALUES, place(nodes[1]), message, "fix one of the two, or both alike");
        }
        ErrorKind::Row { row, fault } => {
            let of = &scene.interfaces[*row as usize];
            let label = format!("the interface of {} and {}", node(of.slave), node(of.master));
            let (rule, message, help) = match fault {
                RowFault::User(fault) => {
                    (&USER_FAULT, format!("user subroutine GAPELECTR {fault} at {label}{when}"), "")
                }
                RowFault::NeedsLength => {
                    let message = format!(
                        "{label} is open{when}, and a cutoff of its pore fluid is left to the characteristic element length"
                    );
                    (&MISSING_QUANTITY, message, "give `char_length` or `--char-length`")
                }
                RowFault::TooLarge { conductance, area } => {
                    let message = format!(
                        "the conductance of {label}, {conductance:?}, times its area of {area:?} is beyond the range of numbers{when}"
                    );
                    (&UNUSABLE_NUMBER, message, "look at `area` and at the table")
                }
                RowFault::NoConductance(value) => {
                    let message = format!("a conductance of {label} is {value:?}{when}");
                    let help = "look at its table and at the row's clearance, pressure and field variables";
                    (&UNUSABLE_NUMBER, message, help)
                }
                other => (&UNUSABLE_NUMBER, format!("{label}: {other}{when}"), ""),
            };
            let (at, message) = of.located(message);
            findings.report(rule, at, message, help);
        }
        ErrorKind::NotSolved { tried } => {
            let tried: Vec<String> = tried.iter().map(|(method, why)| format!("{method}: {why}")).collect();
            let message = format!("the equations of {field} were not solved{when} ({})", tried.join("; "));
            let help = "see whether conductances, sources and values are of the magnitudes that are meant; \
                        otherwise try `--solver direct`, or a larger `--tolerance`";
            findings.report(&NOT_CONVERGED, Place::default(), message, help);
        }
        ErrorKind::BelowAbsoluteZero { node: number, value, zero } => {
            let message = format!(
                "the temperature of {} would be {value:?}{when}, below absolute zero at {zero:?}",
                node(*number)
            );
            let help =
                "more heat is drawn from it than can reach it: look at sources, at radiation and at ABSOLUTE ZERO";
            findings.report(&NOT_CONVERGED, place(*number), message, help);
        }
        ErrorKind::NotConverged { steps, inconsistency: Some(inconsistency), .. } => {
            let message = format!(
                "the balances are met{when} after {steps} steps, and the conductances are those of the state only to {inconsistency:.1e}"
            );
            let help = "a table falls so steeply that the last digits of a value decide: look for rows that are nearly at one value";
            findings.report(&NOT_CONVERGED, Place::default(), message, help);
        }
        ErrorKind::NotConverged { steps, worst, inconsistency: None } => {
            for (field, share, number) in worst {
                let (at, named) = number.map_or_else(
                    || (Place::default(), String::new()),
                    |number| (place(number), format!(", worst at {}", node(number))),
                );
                let message = format!(
                    "the equations of {field} are not met{when} after {steps} steps: {share:.1e} of the largest flow is missing{named}"
                );
                let help = "the scene may have no solution (heat that grows faster than it is led away), or several: \
                            try a transient, or other initial values";
                findings.report(&NOT_CONVERGED, at, message, help);
            }
        }
        _ => findings.report(&NOT_CONVERGED, Place::default(), format!("{failure}{when}"), ""),
    }
    findings.into_list()
}

fn floating_help(of: Option<Field>, field: &str, scene: &Scene) -> String {
    // Currents are quasi-static: there is no capacity for potentials.
    let capacity = if scene.is_transient() && of != Some(Field::Potential) { ", a capacity" } else { "" };
    format!(
        "give one of these nodes a fixed {field}{capacity}, or a conductance to a body that has one; an open gap of zero conductance is no path"
    )
}

fn names(scene: &Scene, nodes: &[u32]) -> String {
    let named = in_backticks(nodes.iter().take(MAX_NAMED).map(|&node| &scene.nodes[node as usize]));
    let others = nodes.len().saturating_sub(MAX_NAMED);
    if others == 0 { named } else { format!("{named} and {others} more nodes") }
}
