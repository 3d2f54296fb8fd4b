//! Charts of a report: a static drawing for print and for browsers without scripts, and the data for the page's script.

use super::History;
use super::page::Page;
use crate::chart::sheet;
use crate::chart::surface::Surface;
use crate::curves::{Curve, Panel, Reach, Side, number};
use serde_json::{Value, json};
use std::collections::HashMap;

/// The panels of one law, the first of which shows values on hover.
pub(super) fn law(page: &mut Page, id: &str, panels: &[&Panel]) {
    for (number, panel) in panels.iter().enumerate() {
        let is_live = number == 0 && panel.fault.is_none();
        let caption = [vec![panel.description()], panel.notes.clone()].concat().join("; ");
        let id = format!("{id}-{}", number + 1);
        let mut attributes = vec![("class", "law"), ("id", id.as_str())];
        if is_live {
            attributes.push(("data-live", ""));
        }
        page.open("figure", &attributes);
        page.open("div", &[("class", "static")]);
        page.drawing(&sheet::svg_of_panel(panel));
        page.close("div");
        if is_live {
            page.element("div", &[("class", "chart")], "");
            page.data(&data(panel).to_string());
        }
        page.element("figcaption", &[("class", "quiet")], &caption);
        page.close("figure");
    }
}

fn data(panel: &Panel) -> Value {
    let abscissae = Side::BOTH.map(|side| abscissae(panel, side));
    let halves: Vec<Value> = Side::BOTH
        .into_iter()
        .zip(&abscissae)
        .map(|(side, x)| {
            let half = panel.half(side);
            json!({
                "title": half.quantity.title(),
                "column": half.quantity.column,
                "scaled": half.has_scale,
                "start": half.start,
                "end": half.end,
                "x": x,
                "rows": panel.curves.iter().flat_map(|curve| &curve.branch(side).knots).map(|knot| knot.x).collect::<Vec<_>>(),
            })
        })
        .collect();
    let curves: Vec<Value> = panel
        .curves
        .iter()
        .map(|curve| {
            let sides: Vec<Value> =
                Side::BOTH.into_iter().zip(&abscissae).map(|(side, x)| values(curve, side, x)).collect();
            json!({"at": curve.at, "sides": sides})
        })
        .collect();
    let probe = panel.probe.as_ref().map(|probe| {
        let axes = probe
            .axes
            .iter()
            .map(|axis| json!({"title": axis.quantity.title(), "column": axis.quantity.column, "stops": axis.stops}));
        let branches = probe.branches.iter().map(|branch| json!({"x": branch.abscissae, "y": branch.values}));
        json!({"axes": axes.collect::<Vec<_>>(), "branches": branches.collect::<Vec<_>>()})
    });
    let marks = panel.marks.iter().map(|mark| {
        json!({
            "side": mark.side as usize,
            "x": mark.x,
            "y": mark.y,
            "code": mark.code,
            "severity": mark.severity.name(),
        })
    });
    let nodes = panel.nodes.as_ref().map(|nodes| {
        Side::BOTH.map(|side| {
            let (x, y): (Vec<f64>, Vec<f64>) =
                nodes.sample.iter().filter(|node| node.side == side).map(|node| (node.x, node.y)).unzip();
            json!({"x": x, "y": y})
        })
    });
    json!({
        "column": panel.value.column,
        "value": panel.value.title(),
        "family": panel.family.as_ref().map(crate::curves::Quantity::title),
        "family_column": panel.family.as_ref().map(|family| family.column.as_str()),
        "halves": halves,
        "curves": curves,
        "probe": probe,
        "marks": marks.collect::<Vec<_>>(),
        "nodes": nodes,
    })
}

/// The distinct abscissae of all curves, ascending.
fn abscissae(panel: &Panel, side: Side) -> Vec<f64> {
    let samples = panel.curves.iter().flat_map(|curve| &curve.branch(side).samples);
    let mut abscissae: Vec<f64> = samples.map(|sample| sample.x).collect();
    abscissae.sort_unstable_by(f64::total_cmp);
    abscissae.dedup();
    abscissae
}

/// The values of a curve at these abscissae, where they are continued, and which of them are rows.
fn values(curve: &Curve, side: Side, abscissae: &[f64]) -> Value {
    let branch = curve.branch(side);
    let samples: HashMap<u64, _> = branch.samples.iter().map(|sample| (sample.x.to_bits(), sample)).collect();
    let of = |x: &f64| samples.get(&x.to_bits());
    let y: Vec<Option<f64>> = abscissae.iter().map(|x| of(x).map(|sample| sample.y)).collect();
    let continued: Vec<u8> =
        abscissae.iter().map(|x| u8::from(of(x).is_some_and(|sample| sample.reach == Reach::Continued))).collect();
    let knots: Vec<f64> = branch.knots.iter().map(|knot| knot.x + 0.0).collect();
    let rows: Vec<usize> = branch.knots.iter().map(|knot| knot.row).collect();
    json!({"y": y, "continued": continued, "knots": knots, "rows": rows})
}

/// The interfaces in space, one drawing per result.
pub(super) fn surfaces(page: &mut Page, surfaces: &[Surface]) {
    for surface in surfaces {
        page.element("h3", &[], &format!("{} on the interfaces", surface.output));
        page.open("figure", &[("class", "law")]);
        page.drawing(&surface.svg());
        page.element("figcaption", &[("class", "quiet")], &surface.description());
        page.close("figure");
    }
}

/// Sums over interfaces: a drawing of those with several times, a table of all.
pub(super) fn histories(page: &mut Page, histories: &[History]) {
    /// The maximum number of rows of the table of one sum.
    const MAX_TIMES: usize = 200;
    for history in histories {
        page.element("h3", &[], &format!("{} of {}, over all nodes", history.output, history.interaction));
        let timed: Vec<(f64, f64)> =
            history.points.iter().filter_map(|(time, value)| time.map(|time| (time, *value))).collect();
        if 1 < timed.len() {
            page.open("figure", &[("class", "law")]);
            page.drawing(&sheet::svg_of_history(&history.interaction, &history.output, &timed));
            page.close("figure");
        }
        page.open("details", if timed.len() < 2 { &[("open", "")] } else { &[] });
        page.element("summary", &[], "Values");
        page.table(&["time", &history.output], |page| {
            for (time, value) in history.points.iter().take(MAX_TIMES) {
                page.open("tr", &[]);
                page.element("td", &[], &time.map_or_else(|| "all rows".to_owned(), number));
                page.element("td", &[], &number(*value));
                page.close("tr");
            }
        });
        if MAX_TIMES < history.points.len() {
            page.element("p", &[], &format!("{} more times.", history.points.len() - MAX_TIMES));
        }
        page.close("details");
    }
}
