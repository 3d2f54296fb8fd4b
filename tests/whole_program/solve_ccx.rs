//! `inpact solve` beside CalculiX: three decks that are thermal networks, run by ccx here, and numbers that ccx printed elsewhere.
//!
//! Without ccx the comparison does nothing and says so; where `INPACT_REQUIRE_CCX` is set, as in the gate, it fails instead.

use super::solve::{Solved, close, edited, prints, solve_edited, solve_json, solve_sample};
use crate::program::{Folder, inpact, root};
use std::collections::BTreeMap;
use std::io::Write;
use std::process::Command;

const CALCULIX: [&str; 2] = ["--dialect", "calculix"];

/// Output of ccx for a deck: under the name of the set, total heat flows and temperatures; `None` without ccx.
fn ccx(name: &str) -> Option<BTreeMap<String, Vec<String>>> {
    let deck = std::fs::read_to_string(root().join(format!("decks/scenes/ccx/{name}.inp"))).expect("readable");
    let folder = Folder::with(&[(&format!("{name}.inp"), &deck)]);
    match Command::new("ccx").arg(name).current_dir(folder.path()).output() {
        Ok(output) if output.status.success() => Some(totals_and_temperatures(&folder.read(&format!("{name}.dat")))),
        Ok(output) => panic!("{}", String::from_utf8_lossy(&output.stdout)),
        Err(error) => {
            assert!(std::env::var_os("INPACT_REQUIRE_CCX").is_none(), "ccx: {error}");
            let _ = writeln!(std::io::stderr(), "SKIPPED, nothing was compared with CalculiX: ccx: {error}");
            None
        }
    }
}

/// The last cells of the rows below `total heat generation for set NAME ...` and `temperatures for set NAME ...`.
fn totals_and_temperatures(dat: &str) -> BTreeMap<String, Vec<String>> {
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut set = None;
    for line in dat.lines().map(str::trim).filter(|line| !line.is_empty()) {
        if let Some((what, rest)) = line.split_once(" for set ") {
            let wanted = ["total heat generation", "temperatures"].contains(&what);
            set = rest.split(' ').next().filter(|_| wanted).map(str::to_owned);
        } else if line.starts_with(|c: char| c.is_alphabetic()) {
            set = None;
        } else if let Some(set) = &set {
            found.entry(set.clone()).or_default().push(line.split_whitespace().last().expect("a cell").to_owned());
        }
    }
    found
}

/// Half a unit of the seventh digit, which is the last that ccx prints.
fn to_the_last_digit(found: f64, printed: &str) {
    let value: f64 = printed.parse().expect("a number");
    let (_, exponent) = printed.split_once('E').expect("an exponent");
    let unit = 10.0_f64.powi(exponent.parse::<i32>().expect("an exponent") - 6);
    assert!((found - value).abs() <= 0.5 * unit, "{found} for {printed}");
}

/// Compares the heat that is supplied at both ends and the temperatures of both faces.
fn compare(name: &str) {
    let Some(printed) = ccx(name) else { return };
    let solved = solve_sample(&format!("ccx/{name}"), &CALCULIX);
    let [bottom, top] = supplies(name);
    let face = |node: &str| solved.nodes.number(&[node], "temperature");
    let sets = [
        ("NBOT", 1, bottom),
        ("NTOP", 1, top),
        ("NFACELOW", 6, face("lower-face")),
        ("NFACEUP", 6, face("upper-face")),
    ];
    for (set, rows, found) in sets {
        assert_eq!(printed[set].len(), rows, "{set}");
        printed[set].iter().for_each(|printed| to_the_last_digit(found, printed));
    }
}

/// The heat that enters at the bottom and at the top.
fn supplies(name: &str) -> [f64; 2] {
    let folder = edited(&format!("ccx/{name}"), &[]);
    let (document, _) = solve_json(&folder, &CALCULIX);
    let supplies = &document["balance"]["temperature"]["supplies"];
    ["bottom", "top"].map(|end| supplies[end].as_f64().expect("a supply"))
}

#[test]
fn ccx_itself_on_three_conductances_in_series() {
    compare("thermal-series");
}

#[test]
fn ccx_itself_on_a_conductance_by_temperature() {
    compare("thermal-curves");
}

#[test]
fn ccx_itself_on_heat_of_friction() {
    compare("thermal-friction");
}

fn faces(solved: &Solved) -> [f64; 2] {
    ["lower-face", "upper-face"].map(|node| solved.nodes.number(&[node], "temperature"))
}

#[test]
fn the_series_is_exact() {
    let [lower, upper] = faces(&solve_sample("ccx/thermal-series", &CALCULIX));
    close(lower, 33_180.0 / 307.0);
    close(upper, 40_980.0 / 307.0);
    let [bottom, top] = supplies("thermal-series");
    close(bottom, -40_560.0 / 307.0);
    close(top, 40_560.0 / 307.0);
}

/// q enters at the bottom: the faces are at 220 - q/4.5 and 20 + q/1.32, and q = 0.0006 (1500 + 52.5 (Tm - 20)) times their difference.
/// With a = 1/1.32 - 1/4.5 and r = 1/1.32 + 1/4.5 that is q = (0.9 + 0.0315 (100 + a q/2)) (200 - r q).
#[test]
fn the_conductance_by_temperature_is_exact() {
    let (a, r) = (1.0 / 1.32 - 1.0 / 4.5, 1.0 / 1.32 + 1.0 / 4.5);
    let (constant, slope) = (0.9 + 0.0315 * 100.0, 0.0315 * a / 2.0);
    // slope r q² + (1 + constant r - 200 slope) q - 200 constant = 0
    let half: f64 = 0.5 * (1.0 + constant * r - 200.0 * slope);
    let heat = 200.0 * constant / (half + (half * half + slope * r * 200.0 * constant).sqrt());
    prints(heat, "172.182799103193");
    let [bottom, top] = supplies("thermal-curves");
    close(bottom, heat);
    close(top, -heat);
    let solved = solve_sample("ccx/thermal-curves", &CALCULIX);
    let [lower, upper] = faces(&solved);
    close(lower, 220.0 - heat / 4.5);
    close(upper, 20.0 + heat / 1.32);
    close(solved.interfaces.number(&["lower-face"], "thermal_conductance"), (constant + slope * heat) / 0.0006);
}

#[test]
fn the_heat_of_friction_is_exact() {
    let solved = solve_sample("ccx/thermal-friction", &CALCULIX);
    let [lower, upper] = faces(&solved);
    close(lower, 380_321.0 / 1_577.0);
    close(upper, 443_651.0 / 1_577.0);
    let [bottom, top] = supplies("thermal-friction");
    close(bottom, -1_586_205.0 / 1_577.0);
    close(top, -202_113.0 / 1_577.0);
    close(solved.interfaces.number(&["lower-face"], "SFDRA"), 1_134.0);
}

/// The run `series_p1000` of CalculiX, as a network.
#[test]
fn two_cubes_in_series() {
    let solved = solve_sample("ccx/series", &CALCULIX);
    let heat = solved.links.number(&["top", "upper-face"], "heat");
    close(heat, 40_000.0 / 17.0);
    prints(heat, "2352.941");
    close(solved.links.number(&["lower-face", "bottom"], "heat"), 40_000.0 / 17.0);
    close(solved.interfaces.number(&["upper-face"], "HFL"), 40_000.0 / 17.0);
}

/// Other pressures of the same table, with the faces held as ccx held them: Q printed is 100 times the conductance.
#[test]
fn two_cubes_at_other_pressures() {
    let cases = [
        ("0.1", "10002"),
        ("250.0", "15000"),
        ("500.0", "20000"),
        ("750.0", "30000"),
        ("1000.0", "40000"),
        ("3000.0", "70000"),
        ("5000.0", "100000"),
        ("10000.0", "100000"),
    ];
    for (pressure, printed) in cases {
        let held = [("pressure = 1000.0", &*format!("pressure = {pressure}")), ("thermal = 50.0", "thermal = inf")];
        let solved = solve_edited("ccx/series", &held, &CALCULIX);
        prints(solved.interfaces.number(&["upper-face"], "HFLA"), printed);
        prints(solved.links.number(&["top", "upper-face"], "heat"), printed);
    }
}

/// The run `heatgen2` of CalculiX, as a network.
#[test]
fn two_cubes_that_rub() {
    let solved = solve_sample("ccx/friction", &CALCULIX);
    close(solved.links.number(&["top", "upper-face"], "heat"), -540.0);
    close(solved.links.number(&["lower-face", "bottom"], "heat"), 660.0);
    close(solved.nodes.number(&["upper-face"], "temperature"), 310.8);
    close(solved.nodes.number(&["lower-face"], "temperature"), 313.2);
    close(solved.interfaces.number(&["upper-face"], "SFDR"), 1200.0);
}

/// Beside the decks a configuration says whose they are.
#[test]
fn the_dialect_may_stand_in_the_configuration() {
    for name in ["thermal-series", "thermal-curves", "thermal-friction", "series", "friction"] {
        let scene = format!("decks/scenes/ccx/{name}.toml");
        let run = inpact(&["solve", &scene]);
        assert_eq!(run.code, 0, "{}", run.errors);
        assert_eq!(run.output, inpact(&["solve", &scene, "--dialect", "calculix"]).output);
    }
}
