//! The choice of a method: by bound first, by the shape of the table second, with a reason for each method that was not chosen.

mod table_judge;

use inpact_evaluation::table::{Candidate, Choice, Method, PiecewiseTable, Refusal, Shape, Tail, choose, full_bound};
use inpact_evaluation::{Accuracy, Tolerance, Wanted};
use table_judge::random_tables::{Range, compile, random_ending, random_rows};
use table_judge::{Random, cases};

fn table(cells: &[f64], width: usize) -> PiecewiseTable {
    PiecewiseTable::from_rows(cells, width, Tail::Constant).unwrap()
}

fn one_axis() -> PiecewiseTable {
    table(&[20.0, 0.0, 10.0, 0.1, 3.0, 0.35], 2)
}

/// Two axes with round abscissae.
fn regular() -> PiecewiseTable {
    let mut cells = Vec::new();
    for y in 0..10_u8 {
        for x in 0..10_u8 {
            let value = 1.0 + f64::from(x * 7 % 5) + 0.3 * f64::from(y);
            cells.extend([value, f64::from(x) * 0.5, 300.0 + 20.0 * f64::from(y)]);
        }
    }
    table(&cells, 3)
}

fn all(choice: &Choice) -> impl Iterator<Item = &Candidate> {
    std::iter::once(&choice.chosen).chain(&choice.refused)
}

#[test]
fn modes_are_taken_at_their_word() {
    for (accuracy, method) in [
        (Accuracy::Reference, Method::Reference),
        (Accuracy::Full, Method::Full),
        (Accuracy::Fast, Method::Grid { cells: vec![9, 9] }),
    ] {
        assert_eq!(choose(&regular(), Wanted::Mode(accuracy)).chosen.method, method);
    }
    assert_eq!(Accuracy::default(), Accuracy::Full);
}

/// Whatever is asked of it, a table of one axis is not resampled.
#[test]
fn one_axis_is_always_full_unless_more_is_wanted() {
    let irregular: Vec<f64> = (0..1000_u16).flat_map(|knot| [1.0, f64::from(knot).powi(5)]).collect();
    for table in [one_axis(), table(&irregular, 2)] {
        assert_eq!(choose(&table, Wanted::Mode(Accuracy::Fast)).chosen.method, Method::Full);
        for (tolerance, method) in [
            (1.0, Method::Full),
            (1e-3, Method::Full),
            (1e-15, Method::Full),
            (1e-16, Method::Reference),
            (0.0, Method::Reference),
        ] {
            let choice = choose(&table, Wanted::Within(Tolerance::RelativeToLargest(tolerance)));
            assert_eq!(choice.chosen.method, method, "{tolerance:e}");
        }
    }
}

#[test]
fn the_cheapest_method_within_the_tolerance_is_chosen() {
    let table = regular();
    for (tolerance, method) in [
        (1e-3, Method::Grid { cells: vec![9, 9] }),
        (1e-12, Method::Grid { cells: vec![9, 9] }),
        (1e-15, Method::Full),
        (1.1e-16, Method::Reference),
    ] {
        for wanted in [Tolerance::RelativeToLargest(tolerance), Tolerance::Pointwise(tolerance * 1.2)] {
            let choice = choose(&table, Wanted::Within(wanted));
            assert_eq!(choice.chosen.method, method, "{wanted:?}: {choice:#?}");
            for candidate in &choice.refused {
                match &candidate.refusal {
                    Some(Refusal::Bound { bound, tolerance }) => assert!(bound > tolerance),
                    Some(Refusal::Slower) => assert!(choice.chosen.cost <= candidate.cost),
                    other => panic!("{other:?}"),
                }
            }
        }
    }
}

/// Never a method that is slower by the shape rule and less exact at once; and `fast` and every tolerance that `full` keeps are never slower than `full`.
#[test]
fn nothing_is_chosen_that_is_slower_and_less_exact() {
    let mut random = Random::new(0x5107);
    for round in 0..cases(100) {
        let rows = random_rows(&mut random, round % 5, [Range::Ordinary, Range::AllDecades][round % 2]);
        let table = compile(&rows, random_ending(&mut random));
        let full = Shape::of(&table).cost(&Method::Full);
        let tolerance = random.positive(-60, 2);
        for wanted in [
            Wanted::Mode(Accuracy::Fast),
            Wanted::Within(Tolerance::RelativeToLargest(tolerance)),
            Wanted::Within(Tolerance::Pointwise(tolerance)),
        ] {
            let choice = choose(&table, wanted);
            let chosen = &choice.chosen;
            let bound = chosen.bound.expect("what is chosen has a bound").absolute;
            for other in all(&choice) {
                let is_beaten = other.cost < chosen.cost && other.bound.is_some_and(|other| other.absolute < bound);
                assert!(!is_beaten, "{other:?} beats {chosen:?} for {wanted:?} on {rows:?}");
            }
            let full_keeps = match wanted {
                Wanted::Within(Tolerance::RelativeToLargest(tolerance)) => {
                    full_bound(&table).relative_to_largest <= tolerance
                }
                Wanted::Within(Tolerance::Pointwise(tolerance)) => full_bound(&table).pointwise <= tolerance,
                Wanted::Mode(_) => true,
            };
            assert!(!full_keeps || chosen.cost <= full, "{chosen:?} is slower than full for {wanted:?} on {rows:?}");
        }
    }
}

#[test]
fn a_table_that_depends_on_nothing_costs_nothing() {
    let choice = choose(&table(&[5.0], 1), Wanted::Mode(Accuracy::Fast));
    assert_eq!((choice.chosen.method, choice.chosen.cost), (Method::Full, 0.0));
}
