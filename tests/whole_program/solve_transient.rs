//! `inpact solve` in time: closed forms, the order of the increments, balances from what is printed, courses and averaged heat.

use super::solve::{Solved, Table, close, edited, solve_edited, solve_in, solve_json, solve_sample, solve_text};
use crate::program::Folder;

/// The cooling block of the samples: 60 above the mean at the start, with this time constant.
const TIME_CONSTANT: f64 = 0.15;

fn hot_at(time: f64) -> f64 {
    40.0 + 60.0 * (-time / TIME_CONSTANT).exp()
}

/// The error at the end with increments of a length.
fn error_with_step(step: &str) -> f64 {
    let solved = solve_edited("cooling", &[("0.0125", step)], &[]);
    solved.nodes.last(&["hot"], "temperature") - hot_at(0.6)
}

#[test]
fn two_capacities_meet_in_increments_of_one_length() {
    let solved = solve_sample("cooling", &[]);
    let [times, hot] = ["time", "temperature"].map(|column| solved.nodes.course(&["hot"], column));
    let cold = solved.nodes.course(&["cold"], "temperature");
    assert_eq!((times.len(), times[0], times[48]), (49, 0.0, 0.6));
    // Each increment divides the difference by 1 + 0.0125/0.15 = 13/12.
    let mut rest = 1.0;
    for ((time, hot), cold) in times.iter().zip(hot).zip(cold) {
        close(hot, 40.0 + 60.0 * rest);
        close(cold, 40.0 - 20.0 * rest);
        assert!((hot - hot_at(*time)).abs() < 1.0);
        rest *= 12.0 / 13.0;
    }
}

#[test]
fn half_the_step_makes_half_the_error() {
    let errors = ["0.0125", "0.00625", "0.003125", "0.0015625"].map(error_with_step);
    for pair in errors.windows(2) {
        let ratio = pair[0] / pair[1];
        assert!((1.9..2.1).contains(&ratio), "{errors:?}");
    }
}

#[test]
fn the_last_increment_ends_at_the_end() {
    let solved = solve_edited("cooling", &[("0.0125", "0.25")], &[]);
    assert_eq!(solved.nodes.course(&["hot"], "time"), [0.0, 0.25, 0.5, 0.6]);
    let exact = [100.0, 40.0 + 60.0 / (8.0 / 3.0), 40.0 + 60.0 / (64.0 / 9.0), 40.0 + 60.0 / (64.0 / 9.0 * 5.0 / 3.0)];
    solved.nodes.course(&["hot"], "temperature").into_iter().zip(exact).for_each(|(found, exact)| close(found, exact));
}

/// The temperatures approach each other, so that errors never grow, and all of them together are at most the sum of those of the increments.
/// Of a method of the first order, a hundredth of the tolerance is a tenth of the error.
#[test]
fn increments_by_their_error() {
    let of = |tolerance: &str| {
        let folder = edited("cooling", &[("step = 0.0125", &format!("tolerance = {tolerance}"))]);
        let (document, summary) = solve_json(&folder, &[]);
        let last = document["nodes"][0]["temperature"].as_f64().expect("a temperature");
        let increments = summary["increments"].as_f64().expect("a count");
        let local = summary["local_error"].as_f64().expect("an error");
        let tolerance: f64 = tolerance.parse().expect("a number");
        assert!(local <= tolerance, "{local} with {tolerance}");
        let error = (last - hot_at(0.6)).abs();
        assert!(error <= increments * tolerance * 80.0, "{error} in {increments} increments");
        error
    };
    let [coarse, fine, finest] = ["1e-2", "1e-4", "1e-6"].map(of);
    for ratio in [coarse / fine, fine / finest] {
        assert!((8.0..12.0).contains(&ratio), "{coarse} {fine} {finest}");
    }
}

/// A body in a room, into which a pulse of a thousandth of the whole time puts 10 of heat.
fn pulse(tolerance: &str) -> Folder {
    let scene = format!(
        "deck = \"deck.inp\"\nprocedure = \"transient\"\n[time]\nend = 10.0\ntolerance = {tolerance}\n\
         [[node]]\nname = \"a\"\n\
         temperature = {{ capacity = 1.0, initial = 20.0, source = [[5.0, 0.0], [5.005, 2000.0], [5.01, 0.0]] }}\n\
         [[node]]\nname = \"room\"\ntemperature = {{ fixed = 20.0 }}\n[[link]]\nnodes = [\"a\", \"room\"]\nthermal = 0.01\n"
    );
    Folder::with(&[("deck.inp", "*SURFACE INTERACTION, NAME=A\n"), ("scene.toml", &scene)])
}

/// Increments by their error must not step over it.
#[test]
fn a_short_pulse_is_not_stepped_over() {
    let solved = solve_in(&pulse("1e-4"), "scene.toml", &[]);
    let [times, temperatures] = ["time", "temperature"].map(|column| solved.nodes.course(&["a"], column));
    for point in [5.0, 5.005, 5.01, 10.0] {
        assert!(times.contains(&point), "{point} of the course is no end of an increment");
    }
    // The errors of the increments add up at most.
    let bound = (times.len() - 1) as f64 * 1e-4 * 10.0;
    let after = temperatures[times.iter().position(|time| *time == 5.01).expect("a row")];
    assert!(bound < 5.0 && (after - 30.0).abs() < bound, "{after}, to within {bound}");
}

#[test]
fn no_increment_exceeds_the_tolerance() {
    for tolerance in [1e-2, 1e-3, 1e-4] {
        let (_, summary) = solve_json(&pulse(&format!("{tolerance:?}")), &[]);
        let local = summary["local_error"].as_f64().expect("an error");
        assert!(local <= tolerance, "the largest estimated local error is {local} of the range, with {tolerance}");
    }
}

/// Two bodies with a joint, one heated, one cooled at a wall whose temperature follows time, and a rod that a current heats.
const BALANCED: &str = "procedure = \"transient\"\njoule_heat_fraction = 1.0\n[time]\nend = 3.0\nstep = 0.0625\n[initial]\ntemperature = 20.0\n\
     [[node]]\nname = \"heater\"\npotential = { fixed = 2.0 }\ntemperature = { capacity = 3.0, source = [[0.0, 50.0], [2.0, 10.0]] }\n\
     [[node]]\nname = \"s\"\ntemperature = { capacity = 0.5 }\n\
     [[node]]\nname = \"m\"\ntemperature = { capacity = 0.25, initial = 60.0 }\n\
     [[node]]\nname = \"body\"\npotential = { fixed = 0.0 }\ntemperature = { capacity = 7.0 }\n\
     [[node]]\nname = \"wall\"\ntemperature = { fixed = [[0.0, 20.0], [1.0, 5.0], [2.5, 30.0]] }\n\
     [[link]]\nnodes = [\"heater\", \"s\"]\nthermal = 4.0\nelectrical = 3.0\n\
     [[link]]\nnodes = [\"m\", \"body\"]\nthermal = 2.0\nelectrical = 5.0\njoule_heat_fraction = 0.5\n\
     [[link]]\nnodes = [\"body\", \"wall\"]\nthermal = 1.5\n\
     [[interface]]\nslave = \"s\"\nmaster = \"m\"\narea = 0.5\nclearance = 0.0\npressure = [[0.0, 10.0], [3.0, 100.0]]\n";

const JOINT: &str = "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n5., 0.\n25., 100.\n\
     *GAP ELECTRICAL CONDUCTANCE, PRESSURE\n2., 0., 0.\n20., 100., 0.\n1., 0., 100.\n10., 100., 100.\n*GAP HEAT GENERATION\n0.75, 0.25\n";

/// The lengths of the increments, and a sum over them of something at their ends.
fn integral(times: &[f64], rates: &[f64]) -> f64 {
    assert_eq!(times.len(), rates.len());
    times.windows(2).zip(&rates[1..]).map(|(pair, rate)| (pair[1] - pair[0]) * rate).sum()
}

/// The storage of the capacities is the inflow from sources, the wall, and currents: all from the printed tables.
#[test]
fn what_is_stored_was_supplied() {
    let solved = solve_text(JOINT, BALANCED, &[]);
    let times = solved.nodes.course(&["heater"], "time");
    assert_eq!(times.len(), 49);
    let course = |node: &str, field: &str| solved.nodes.course(&[node], field);
    let capacities = [("heater", 3.0), ("s", 0.5), ("m", 0.25), ("body", 7.0)];
    let stored: f64 = capacities.iter().map(|(node, capacity)| capacity * gained(&course(node, "temperature"))).sum();
    let applied: Vec<f64> = times.iter().map(|time| if *time < 2.0 { 50.0 - 20.0 * time } else { 10.0 }).collect();
    let to_wall = solved.links.course(&["body", "wall"], "heat");
    // The heat of links and joint is that of the mean of an increment, as their differences of potential are linear in it.
    let drop = |from: &str, to: &str| -> Vec<f64> {
        course(from, "potential").iter().zip(course(to, "potential")).map(|(from, to)| from - to).collect()
    };
    let of_rods = [(3.0, drop("heater", "s")), (0.5 * 5.0, drop("m", "body"))];
    let of_rods: f64 = of_rods.iter().map(|(conductance, drop)| conductance * averaged(&times, drop)).sum();
    let of_joint = solved.interfaces.last(&["s"], "SJDTA");
    let supplied = integral(&times, &applied) + of_rods + of_joint - integral(&times, &to_wall);
    let turnover = integral(&times, &applied)
        + of_rods
        + of_joint
        + integral(&times, &to_wall.iter().map(|heat| heat.abs()).collect::<Vec<_>>());
    assert!(turnover > 100.0 && of_rods > 1.0 && of_joint > 1.0);
    assert!(
        (stored - supplied).abs() < 1e-13 * turnover,
        "{stored} stored, {supplied} supplied, {turnover} turned over"
    );
}

fn gained(course: &[f64]) -> f64 {
    course[course.len() - 1] - course[0]
}

/// The sum over the increments of their lengths times a third of a² + ab + b², where a and b are the drops at start and end.
fn averaged(times: &[f64], drops: &[f64]) -> f64 {
    let of = |(time, drop): (&[f64], &[f64])| {
        (time[1] - time[0]) * (drop[0] * drop[0] + drop[0] * drop[1] + drop[1] * drop[1]) / 3.0
    };
    times.windows(2).zip(drops.windows(2)).map(of).sum()
}

/// The document says the same of the last increment.
#[test]
fn the_balance_that_is_printed_is_one() {
    let scene = format!("deck = \"deck.inp\"\n{BALANCED}");
    let folder = Folder::with(&[("deck.inp", JOINT), ("scene.toml", &scene)]);
    let (document, _) = solve_json(&folder, &[]);
    for field in ["potential", "temperature"] {
        let balance = &document["balance"][field];
        let of = |name: &str| balance[name].as_f64().unwrap_or_else(|| panic!("{name}: {balance}"));
        let net = of("supplied") - of("withdrawn");
        assert!((net + of("generated") - of("stored")).abs() < 1e-13 * of("turnover"), "{balance}");
        let supplies: f64 =
            balance["supplies"].as_object().expect("supplies").values().filter_map(serde_json::Value::as_f64).sum();
        assert!((supplies - net).abs() < 1e-13 * of("turnover"), "{balance}");
    }
}

/// Without capacities each state is steady: the middle of two conductances of 1 and 3 follows the end that follows time.
#[test]
fn a_fixed_value_follows_time() {
    let scene = "procedure = \"transient\"\n[time]\nstart = -1.0\nend = 3.0\nstep = 0.5\n\
                 [[node]]\nname = \"end\"\ntemperature = { fixed = [[0.0, 20.0], [1.0, 80.0], [2.0, 40.0]] }\n[[node]]\nname = \"middle\"\n\
                 [[node]]\nname = \"other\"\ntemperature = { fixed = 0.0 }\n\
                 [[link]]\nnodes = [\"end\", \"middle\"]\nthermal = 3.0\n[[link]]\nnodes = [\"middle\", \"other\"]\nthermal = 1.0\n";
    let solved = solve_text("*SURFACE INTERACTION, NAME=A\n", scene, &[]);
    let expected = [20.0, 20.0, 20.0, 50.0, 80.0, 60.0, 40.0, 40.0, 40.0];
    assert_eq!(solved.nodes.course(&["end"], "temperature"), expected);
    solved
        .nodes
        .course(&["middle"], "temperature")
        .into_iter()
        .zip(expected)
        .for_each(|(found, end)| close(found, 0.75 * end));
}

/// With a capacity: the recursion of the increments, C (T - T') / dt = G (T_end - T), in the numbers of the scene.
#[test]
fn a_capacity_follows_an_end_that_follows_time() {
    let scene = "procedure = \"transient\"\n[time]\nend = 2.0\nstep = 0.25\n\
                 [[node]]\nname = \"end\"\ntemperature = { fixed = [[0.0, 20.0], [1.0, 80.0]] }\n\
                 [[node]]\nname = \"body\"\ntemperature = { capacity = 2.0, initial = 20.0 }\n[[link]]\nnodes = [\"end\", \"body\"]\nthermal = 4.0\n";
    let solved = solve_text("*SURFACE INTERACTION, NAME=A\n", scene, &[]);
    let mut expected = 20.0;
    for (increment, found) in solved.nodes.course(&["body"], "temperature").into_iter().enumerate() {
        if increment > 0 {
            let end = 20.0 + 60.0 * (0.25 * increment as f64).min(1.0);
            expected = (2.0 / 0.25 * expected + 4.0 * end) / (2.0 / 0.25 + 4.0);
        }
        close(found, expected);
    }
}

/// Two faces whose difference of potential goes from 2 to 5 within 2 seconds, and nothing that takes their heat away.
fn ramp(step: &str) -> Solved {
    let scene = format!(
        "procedure = \"transient\"\n[time]\nstart = 10.0\nend = 12.0\nstep = {step}\n\
         [[node]]\nname = \"s\"\npotential = {{ fixed = [[10.0, 2.0], [12.0, 5.0]] }}\ntemperature = {{ capacity = 2.0, initial = 0.0 }}\n\
         [[node]]\nname = \"m\"\npotential = {{ fixed = 0.0 }}\ntemperature = {{ capacity = 4.0, initial = 1.0 }}\n\
         [[interface]]\nslave = \"s\"\nmaster = \"m\"\narea = 1.0\nclearance = 0.0\npressure = 0.0\n"
    );
    solve_text("*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n3., 0.\n", &scene, &[])
}

/// A-21 through a network: 39 is the mean of the increment, half of it into either face; 78 in two seconds warm them by 39/2 and 39/4.
#[test]
fn h_08_the_heat_of_a_current_is_averaged_over_the_increment() {
    let solved = ramp("2.0");
    let of = |table: &Table, node: &str, column: &str| table.course(&[node], column);
    assert_eq!(of(&solved.interfaces, "s", "SJD"), [12.0, 39.0]);
    assert_eq!(of(&solved.interfaces, "s", "SJDT"), [0.0, 78.0]);
    assert_eq!(of(&solved.interfaces, "s", "ECD"), [6.0, 15.0]);
    assert_eq!(of(&solved.nodes, "s", "temperature"), [0.0, 19.5]);
    assert_eq!(of(&solved.nodes, "m", "temperature"), [1.0, 10.75]);
    // In two increments: (4 + 7 + 12.25) and (12.25 + 17.5 + 25), which are 78 together, as the mean of a linear difference is exact.
    let solved = ramp("1.0");
    assert_eq!(of(&solved.interfaces, "s", "SJD"), [12.0, 23.25, 54.75]);
    assert_eq!(of(&solved.nodes, "s", "temperature"), [0.0, 5.8125, 19.5]);
}

/// The heat of links has the same form.
#[test]
fn h_08_holds_for_bulk_joule_heat() {
    let scene = "procedure = \"transient\"\njoule_heat_fraction = 1.0\n[time]\nend = 2.0\nstep = 2.0\n\
                 [[node]]\nname = \"a\"\npotential = { fixed = [[0.0, 2.0], [2.0, 5.0]] }\ntemperature = { capacity = 2.0, initial = 0.0 }\n\
                 [[node]]\nname = \"b\"\npotential = { fixed = 0.0 }\ntemperature = { capacity = 4.0, initial = 1.0 }\n\
                 [[link]]\nnodes = [\"a\", \"b\"]\nelectrical = 3.0\n";
    let solved = solve_text("*SURFACE INTERACTION, NAME=A\n", scene, &[]);
    assert_eq!(solved.nodes.course(&["a"], "temperature"), [0.0, 19.5]);
    assert_eq!(solved.nodes.course(&["b"], "temperature"), [1.0, 10.75]);
}
