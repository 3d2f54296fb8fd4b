//! The work–precision diagram: error of the nodes' values against time, and the Pareto front.

use super::measure::{Entry, Measured};
use super::report::{how, name, what};
use crate::chart::{Chart, Point};
use crate::commands::solvable::SolvableScene;
use crate::commands::tradeoff::LEAST_ERROR;
use crate::commands::tradeoff::cells::file_name;

/// The diagram of all solvers.
pub(super) fn chart(measured: &Measured, prepared: &SolvableScene) -> Chart {
    // Points of the front are drawn last, so that they are not hidden.
    let (front, others): (Vec<&Entry>, Vec<&Entry>) = measured.entries.iter().partition(|entry| entry.on_front);
    let points = others.into_iter().chain(front).map(|entry| {
        let (name, methods) = (name(entry.subject), &entry.found.methods);
        let fallback = methods.iter().skip(1).map(|method| format!(", then {method}"));
        Point {
            x: 1e3 * entry.time,
            y: entry.distance.values.clamp(LEAST_ERROR, f64::MAX),
            bar_to: None,
            label: format!("{name}{}", fallback.collect::<String>()),
            on_front: entry.on_front,
        }
    });
    Chart {
        title: format!("Work and precision of the solvers on {}", file_name(&prepared.name)),
        subtitle: format!("{}; with {}", what(measured, prepared), file_name(&prepared.deck_name)),
        x_title: "time of a solution, ms".to_owned(),
        y_title: "largest error of a node / range of its field".to_owned(),
        points: points.collect(),
        vertical: Vec::new(),
        horizontal: vec![(f64::EPSILON / 2.0, "½ ulp of the range".to_owned())],
        footnote: format!("{}; reference: {}", how(measured), measured.reference.subject.method),
    }
}
