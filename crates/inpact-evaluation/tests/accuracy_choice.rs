//! The choice of a form: by bound first, by cost second, with a reason for each form left out.

use inpact_evaluation::accuracy::{
    Accuracy, Approximation, Choice, Columns, Form, Method, Refusal, Tolerance, Wanted, choose, choose_for,
};
use inpact_evaluation::table::{PiecewiseTable, Tail};

fn table(cells: &[f64], width: usize) -> PiecewiseTable {
    PiecewiseTable::from_rows(cells, width, Tail::Constant).unwrap()
}

fn ordinary() -> PiecewiseTable {
    table(&[20.0, 0.0, 10.0, 0.1, 3.0, 0.35], 2)
}

fn chosen(choice: &Choice) -> Method {
    choice.chosen().unwrap().method.clone()
}

#[test]
fn modes_are_taken_at_their_word() {
    let table = ordinary();
    for (accuracy, method) in [
        (Accuracy::Reference, Method::Reference),
        (Accuracy::Full, Method::Full),
        (Accuracy::Fast, Method::Fast(Form::Single)),
    ] {
        let choice = choose_for(&table, Wanted::Mode(accuracy), Columns::Single);
        assert_eq!(chosen(&choice), method);
        assert_eq!(choice.approximation.is_some(), accuracy == Accuracy::Fast);
    }
    assert_eq!(Accuracy::default(), Accuracy::Full);
}

#[test]
fn the_cheapest_form_within_the_tolerance_is_chosen() {
    let table = ordinary();
    for (tolerance, method) in [
        (1e-3, Method::Fast(Form::Single)),
        (1e-10, Method::Fast(Form::Slope)),
        (1e-16, Method::Reference),
        (0.0, Method::Reference),
    ] {
        let choice = choose_for(&table, Wanted::Within(Tolerance::RelativeToLargest(tolerance)), Columns::Single);
        assert_eq!(chosen(&choice), method, "{tolerance:e}: {:#?}", choice.candidates);
        let pointwise = choose_for(&table, Wanted::Within(Tolerance::Pointwise(tolerance)), Columns::Single);
        assert_eq!(chosen(&pointwise), method, "{tolerance:e}: {:#?}", pointwise.candidates);
        for candidate in &choice.candidates {
            let is_within = candidate.bound.is_some_and(|bound| bound.relative_to_largest <= tolerance);
            match &candidate.refusal {
                None => assert!(is_within || tolerance == 0.0),
                Some(Refusal::Bound { bound, tolerance: wanted }) => assert!(bound > wanted && *wanted == tolerance),
                Some(Refusal::Slower) => assert!(is_within),
                Some(other) => panic!("{other}"),
            }
        }
        assert_eq!(choice.candidates.iter().filter(|candidate| candidate.refusal.is_none()).count(), 1);
    }
}

/// A contact jump a nanometre wide at the end of a metre: f32 cannot tell its two abscissae apart, and where it can the slope costs too much.
#[test]
fn a_steep_table_is_not_approximated_in_f32() {
    let merged = table(&[1.0, 0.0, 1.0, 1.0, 1e6, 1.000_000_001], 2);
    let choice = choose(&merged, Wanted::Mode(Accuracy::Fast));
    assert_eq!(chosen(&choice), Method::Fast(Form::Slope));
    let single = choice.candidates.iter().find(|candidate| candidate.method == Method::Fast(Form::Single)).unwrap();
    assert_eq!(single.refusal, Some(Refusal::Merged(1.0)));
    assert_eq!(single.bound, None);
    let steep = table(&[1.0, 0.0, 1.0, 1.0, 1e6, 1.000_01], 2);
    let bound = Approximation::single(&steep).unwrap().bound();
    assert!(bound.relative_to_largest > 1e-3, "{bound:?}");
    assert_eq!(chosen(&choose(&steep, Wanted::Mode(Accuracy::Fast))), Method::Fast(Form::Slope));
}

#[test]
fn extremes_are_refused_with_the_reason() {
    for (cells, expected) in [
        ([1.0, 0.0, 1e39, 1.0], Refusal::TooLarge(1e39)),
        ([1.0, 0.0, 1e-39, 1.0], Refusal::TooSmall(1e-39)),
        ([1.0, 0.0, 2.0, 1e-39], Refusal::TooSmall(1e-39)),
        ([1.0, 0.0, 2.0, 1e300], Refusal::TooLarge(1e300)),
    ] {
        let refusal = Approximation::single(&table(&cells, 2)).map(|made| made.bound()).unwrap_err();
        assert_eq!(refusal, expected, "{cells:?}");
    }
    let flat = Approximation::single(&table(&[1e-20, 0.0, 2e-20, 1e20], 2)).map(|made| made.bound());
    assert!(matches!(flat, Err(Refusal::Slope(slope)) if (slope / 1e-40 - 1.0).abs() < 1e-6), "{flat:?}");
    let huge = table(&[1.0, 0.0, f64::MAX, 1.0], 2);
    assert_eq!(Approximation::slope(&huge).map(|made| made.bound()), Err(Refusal::TooLarge(f64::MAX)));
    assert_eq!(chosen(&choose(&huge, Wanted::Mode(Accuracy::Fast))), Method::Full);
    let constant = table(&[5.0], 1);
    assert_eq!(Approximation::slope(&constant).map(|made| made.bound()), Err(Refusal::Constant));
    assert_eq!(chosen(&choose(&constant, Wanted::Mode(Accuracy::Fast))), Method::Full);
    assert_eq!(Approximation::grid(&ordinary(), &[8]).map(|made| made.bound()), Err(Refusal::OneAxis));
}

/// A table of two axes with a regular layout is its own grid: no error but rounding, and cheaper.
#[test]
fn a_regular_table_becomes_a_grid() {
    let mut cells = Vec::new();
    for y in 0..10_u8 {
        for x in 0..10_u8 {
            cells.extend([
                1.0 + f64::from(x * 7 % 5) + 0.3 * f64::from(y),
                f64::from(x) * 0.5,
                300.0 + 20.0 * f64::from(y),
            ]);
        }
    }
    let choice = choose(&table(&cells, 3), Wanted::Within(Tolerance::Pointwise(1e-12)));
    assert_eq!(chosen(&choice), Method::Fast(Form::Grid { cells: vec![9, 9] }), "{:#?}", choice.candidates);
    assert_eq!(choice.approximation.unwrap().form().to_string(), "grid 9x9");
}
