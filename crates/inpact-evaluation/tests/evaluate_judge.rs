//! Whole evaluations against a judge of their own: random decks and node tables, every output of every row, in exact rationals.

mod evaluate_support;
mod evaluation_judge;
mod table_judge;

use evaluate_support::{Run, evaluate_with};
use evaluation_judge::laws::{Number, Results, judge};
use evaluation_judge::scene::Scene;
use inpact_evaluation::plan::Choices;
use num_rational::BigRational;
use num_traits::{Signed, Zero};
use table_judge::{Random, cases, exact, report};

/// What is compared: all numbers but slopes and WEIGHT.
const OUTPUTS: [&str; 32] = [
    "ECD",
    "ECDA",
    "ECDT",
    "ECDTA",
    "SJD",
    "SJDA",
    "SJDT",
    "SJDTA",
    "HFL",
    "HFLA",
    "HTL",
    "HTLA",
    "SFDR",
    "SFDRA",
    "SFDRT",
    "SFDRTA",
    "PFL",
    "PFLA",
    "PTL",
    "PTLA",
    "conductance",
    "heat_s",
    "heat_m",
    "thermal_conductance",
    "heat_conduction",
    "heat_radiation",
    "total_heat_s",
    "total_heat_m",
    "permeability",
    "q_across",
    "q_gap_s",
    "q_s",
];

/// How far a number may be from the exact one, in parts of the magnitudes it is made of.
fn tolerance() -> BigRational {
    BigRational::new(24.into(), num_bigint::BigInt::from(1_u64 << 53))
}

/// Why a cell is not what the judge has; `None` where it is.
fn fault(cell: Option<f64>, judged: Option<&Number>) -> Option<String> {
    let (found, judged) = match (cell, judged) {
        (None, None) => return None,
        (Some(found), Some(judged)) => (found, judged),
        (found, judged) => {
            let judged = judged.map(|judged| near(&judged.value));
            return Some(format!("{found:?} for {judged:?}"));
        }
    };
    let largest = exact(f64::MAX);
    let allowed = &judged.scale * tolerance() + BigRational::new(4.into(), num_bigint::BigInt::from(1) << 1074);
    let is_right = if found.is_finite() {
        (exact(found) - &judged.value).abs() <= allowed
    } else {
        // Beyond the range by itself, and not on the way.
        !found.is_nan() && (found < 0.0) == judged.value.is_negative() && largest < judged.value.abs() + &allowed
    };
    (!is_right).then(|| format!("{found:?} for {:?}", near(&judged.value)))
}

/// A rational as text, to a few digits.
fn near(value: &BigRational) -> String {
    if value.is_zero() {
        return "0".to_owned();
    }
    let power = value.numer().abs().bits().cast_signed() - value.denom().bits().cast_signed();
    let sign = if value.is_negative() { "-" } else { "" };
    match num_traits::ToPrimitive::to_f64(value) {
        Some(number) if number.is_finite() && number != 0.0 => format!("{number:e}"),
        _ => format!("{sign}2^{power}"),
    }
}

/// The cells of a column; all missing where there is none.
fn cells(run: &Run, name: &str, rows: usize) -> Vec<Option<f64>> {
    let is_there = run.header().split(',').any(|column| column == name);
    if !is_there {
        return vec![None; rows];
    }
    run.column(name).iter().map(|cell| (!cell.is_empty()).then(|| cell.parse().expect("a number"))).collect()
}

/// Evaluates random scenes and compares every cell; says how many numbers were compared.
fn compare(seed: u64, count: usize, extreme: bool) -> usize {
    let mut random = Random::new(seed);
    let mut compared = 0;
    for case in 0..count {
        let scene = Scene::random(&mut random, extreme);
        let (deck, nodes) = (scene.deck(), scene.nodes());
        let run = evaluate_with(&deck, &nodes, &Choices::default(), 1 + case % 5);
        let is_refused = run.findings.iter().any(|finding| finding.contains("error["));
        let judged: Vec<Results> = judge(&scene);
        if run.plan.is_none() || is_refused {
            assert!(judged.iter().all(Results::is_empty), "case {case}: {:?}\n{deck}\n{nodes}", run.findings);
            continue;
        }
        for name in OUTPUTS {
            for (row, cell) in cells(&run, name, scene.rows.len()).into_iter().enumerate() {
                let judged = judged[row].get(name);
                compared += usize::from(judged.is_some());
                if let Some(fault) = fault(cell, judged) {
                    panic!("case {case}, row {}, {name}: {fault}\n{deck}\n{nodes}\n{}", row + 1, run.csv);
                }
            }
        }
    }
    compared
}

#[test]
fn random_scenes_give_what_the_semantics_say() {
    let count = cases(600);
    let compared = compare(6, count, false);
    report("ordinary scenes", &format!("{count} scenes, {compared} numbers"));
    assert!(20 * count <= compared, "{compared} numbers of {count} scenes are too few to tell anything");
}

/// Areas, temperatures, potentials, pressures and durations of all decades: a number leaves the range of f64 by itself, and never on the way to it.
#[test]
fn extreme_scenes_stay_within_the_range() {
    let count = cases(300);
    let compared = compare(7, count, true);
    report("extreme scenes", &format!("{count} scenes, {compared} numbers"));
    assert!(20 * count <= compared, "{compared} numbers of {count} scenes are too few to tell anything");
}
