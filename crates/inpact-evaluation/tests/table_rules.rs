//! Tables by the numbered rules: order of rows, ragged groups, constant ends, single rows, the zero tail, published values.

use inpact_evaluation::numbers::product;
use inpact_evaluation::table::{AxisSummary, PiecewiseTable, TableKernel, Tail};
use inpact_evaluation::{Error, ErrorKind, TableFault};

fn table(rows: &[&[f64]]) -> PiecewiseTable {
    with_tail(rows, Tail::Constant)
}

fn with_tail(rows: &[&[f64]], tail: Tail) -> PiecewiseTable {
    PiecewiseTable::from_rows(&rows.concat(), rows[0].len(), tail).unwrap()
}

/// The row, counted from one, and the fault of rows that are no table.
fn fault(rows: &[&[f64]]) -> (usize, TableFault) {
    let error = PiecewiseTable::from_rows(&rows.concat(), rows[0].len(), Tail::Constant).unwrap_err();
    let (row, fault) = row_and_fault(error);
    assert!(error.to_string().starts_with(&format!("row {row} ")), "{error}");
    (row, fault)
}

fn row_and_fault(error: Error) -> (usize, TableFault) {
    let ErrorKind::Rows { row, fault } = *error.kind() else { panic!("{error}") };
    (row + 1, fault)
}

/// conductance, clearance, temperature; the two temperatures have clearances of their own.
const A_13: [&[f64]; 5] =
    [&[10.0, 0.0, 300.0], &[6.0, 1.0, 300.0], &[2.0, 2.0, 300.0], &[20.0, 0.0, 400.0], &[10.0, 4.0, 400.0]];

#[test]
fn a_13_ragged_groups_are_interpolated_from_the_inside_out() {
    let constant = table(&A_13);
    assert_eq!(constant.value(&[2.0, 350.0]), 8.5);
    assert_eq!(constant.value(&[3.0, 350.0]), 7.25);
    let zero = with_tail(&A_13, Tail::Zero);
    assert_eq!(zero.value(&[2.0, 350.0]), 8.5);
    assert_eq!(zero.value(&[3.0, 350.0]), 6.25);
    assert_eq!(zero.value(&[4.0, 350.0]), 5.0);
    assert_eq!(zero.value(&[4.5, 350.0]), 0.0);
}

#[test]
fn a_14_rows_out_of_order_are_refused() {
    let repeated = fault(&[&[1.0, 0.0], &[2.0, 0.1], &[3.0, 0.1]]);
    assert_eq!(repeated, (3, TableFault::NotAscending { axis: 0, previous: 0.1, found: 0.1 }));
    let falling = fault(&[&[1.0, 0.1], &[2.0, 0.0]]);
    assert_eq!(falling, (2, TableFault::NotAscending { axis: 0, previous: 0.1, found: 0.0 }));
    let outer_falls = fault(&[&[1.0, 0.0, 400.0], &[2.0, 1.0, 400.0], &[3.0, 0.0, 300.0]]);
    assert_eq!(outer_falls, (3, TableFault::NotAscending { axis: 1, previous: 400.0, found: 300.0 }));
}

/// T-09: a new group opens where an outer abscissa rises, however the inner ones move.
#[test]
fn t_09_outer_abscissae_open_groups() {
    let three_axes =
        table(&[&[1.0, 5.0, 2.0, 1.0], &[2.0, 1.0, 3.0, 1.0], &[4.0, 9.0, 0.0, 2.0], &[8.0, 9.5, 0.0, 2.0]]);
    assert_eq!(three_axes.group_count(), 3);
    let sizes: Vec<_> =
        three_axes.axes().iter().map(|axis| (axis.group_count, axis.knot_count, axis.distinct_count)).collect();
    assert_eq!(sizes, [(3, 4, 4), (2, 3, 3), (1, 2, 2)]);
    assert_eq!(three_axes.value(&[9.25, 2.5, 1.0]), 1.5);
    assert_eq!(three_axes.value(&[9.25, 2.5, 1.5]), 3.75);
    assert_eq!(three_axes.value(&[9.25, 2.5, 2.0]), 6.0);
}

#[test]
fn t_08_numbers_that_are_not_finite_name_their_row() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let (row, fault) = fault(&[&[1.0, 0.0], &[2.0, bad]]);
        assert_eq!(row, 2);
        assert!(matches!(fault, TableFault::NotFinite { column: 1, .. }));
    }
    assert!(matches!(fault(&[&[f64::NAN, 0.0]]), (1, TableFault::NotFinite { column: 0, .. })));
}

#[test]
fn cells_that_are_no_rows_are_refused() {
    let fault =
        |cells: &[f64], width| row_and_fault(PiecewiseTable::from_rows(cells, width, Tail::Constant).unwrap_err()).1;
    assert_eq!(fault(&[], 2), TableFault::NoRows);
    assert_eq!(fault(&[1.0, 2.0, 3.0], 2), TableFault::IncompleteRow { width: 2, found: 1 });
    assert!(matches!(fault(&[1.0], 0), TableFault::IncompleteRow { width: 0, .. }));
    assert_eq!(fault(&[1.0, 2.0], 1), TableFault::SecondConstant);
}

/// T-10: 0 and -0 are one number.
#[test]
fn t_10_outer_abscissae_are_compared_as_numbers() {
    let signed_zeros = table(&[&[1.0, 0.0, 0.0], &[2.0, 1.0, -0.0]]);
    assert_eq!(signed_zeros.group_count(), 1);
    assert_eq!(signed_zeros.value(&[0.5, 7.0]), 1.5);
}

/// T-02: a blank temperature column counts as constant 0, so no temperature is needed.
#[test]
fn t_02_a_blank_column_is_constant() {
    let blank = table(&[&[1.0, 0.0, 0.0, 1.0], &[2.0, 1.0, 0.0, 1.0], &[3.0, 0.0, 0.0, 2.0], &[4.0, 1.0, 0.0, 2.0]]);
    assert!(!blank.axes()[1].matters());
    assert_eq!(blank.axes()[1].distinct_count, 1);
    for temperature in [0.0, -300.0, f64::INFINITY, f64::NAN] {
        assert_eq!(blank.value(&[0.5, temperature, 1.5]), 2.5);
        assert!(blank.sides(&[0.5, temperature, 1.5]).is_within());
    }
}

/// T-07: a group of one row is constant along its axis.
#[test]
fn t_07_a_group_of_one_row_is_constant() {
    let rows: [&[f64]; 3] = [&[10.0, 0.0, 300.0], &[6.0, 1.0, 300.0], &[20.0, 0.0, 400.0]];
    let constant = table(&rows);
    assert_eq!(constant.value(&[5.0, 400.0]), 20.0);
    assert_eq!(constant.value(&[5.0, 350.0]), 13.0);
    assert!(constant.sides(&[5.0, 400.0]).is_within());
    assert_eq!(table(&[&[20.0, 0.0]]).value(&[5.0]), 20.0);
}

/// a zero tail follows a single row too, from the very next clearance on; T-07 stays for the other axes.
#[test]
fn q_38_a_zero_tail_follows_a_single_row() {
    let least = f64::from_bits(1);
    let single = with_tail(&[&[20.0, 0.0]], Tail::Zero);
    for (d, k) in [(-1.0, 20.0), (-0.0, 20.0), (0.0, 20.0), (least, 0.0), (1e6, 0.0), (f64::INFINITY, 0.0)] {
        assert_eq!(single.value(&[d]), k, "{d:?}");
        assert_eq!(single.sides(&[d]).is_above(0), 0.0 < d, "{d:?}");
        assert_eq!(single.reference_value_at(d, &[]), k, "{d:?}");
        let mut values = [f64::NAN; 20];
        TableKernel::new(&single).values(&[&[d; 20]], &mut values);
        assert_eq!(values, [k; 20], "{d:?}");
    }
    assert!(single.value(&[f64::NAN]).is_nan());
    // Two temperatures, a row each, and one that has two: 14.5 of 10 and 20 at 345.
    let pair = with_tail(&[&[10.0, 0.0, 300.0], &[20.0, 0.0, 400.0]], Tail::Zero);
    assert_eq!([0.0, least, 1e6].map(|d| pair.value(&[d, 345.0])), [14.5, 0.0, 0.0]);
    let ragged = with_tail(&[&[10.0, 0.0, 300.0], &[6.0, 1.0, 300.0], &[20.0, 0.0, 400.0]], Tail::Zero);
    assert_eq!([0.0, 0.5, 1.0, 2.0].map(|d| ragged.value(&[d, 350.0])), [15.0, 4.0, 3.0, 0.0]);
    assert_eq!(ragged.value(&[0.0, 500.0]), 20.0);
    let folded = pair.folded(1, 345.0).expect("both groups drop at 0");
    assert_eq!([0.0, least].map(|d| folded.value(&[d, f64::NAN])), [14.5, 0.0]);
    let at_contact = pair.folded(0, 0.0).expect("both groups have 0");
    assert_eq!(at_contact.value(&[f64::NAN, 345.0]), 14.5);
    assert_eq!(pair.folded(0, least).expect("both groups end before it").value(&[f64::NAN, 345.0]), 0.0);
}

#[test]
fn a_table_without_axes_is_a_constant() {
    for constant in [PiecewiseTable::constant(3.0), table(&[&[3.0]])] {
        assert_eq!(constant.value(&[]), 3.0);
        assert_eq!(constant.value(&[7.0, f64::NAN]), 3.0);
        assert_eq!((constant.axis_count(), constant.row_count(), constant.group_count()), (0, 1, 1));
        let mut slopes = [f64::NAN; 2];
        assert_eq!(constant.value_and_slopes(&[1.0, 2.0], &mut slopes), 3.0);
        assert_eq!(slopes, [0.0, 0.0]);
    }
}

#[test]
fn t_04_beyond_the_range_is_constant_and_flagged_for_each_axis() {
    let table = table(&A_13);
    let sides = |point: &[f64]| {
        let sides = table.sides(point);
        [0, 1].map(|axis| (sides.is_below(axis), sides.is_above(axis)))
    };
    assert_eq!(table.value(&[-1.0, 250.0]), 10.0);
    assert_eq!(sides(&[-1.0, 250.0]), [(true, false), (true, false)]);
    assert_eq!(table.value(&[f64::INFINITY, f64::INFINITY]), 10.0);
    assert_eq!(sides(&[5.0, 450.0]), [(false, true), (false, true)]);
    // Beyond the clearances of one group and within those of the other.
    assert_eq!(sides(&[3.0, 350.0]), [(false, true), (false, false)]);
    assert_eq!(sides(&[3.0, 400.0]), [(false, false), (false, false)]);
    // At the ends themselves.
    assert_eq!(sides(&[0.0, 300.0]), [(false, false), (false, false)]);
    assert_eq!(sides(&[4.0, 400.0]), [(false, false), (false, false)]);
}

#[test]
fn nan_gives_nan_where_the_table_depends_on_it() {
    let table = table(&A_13);
    for point in [[f64::NAN, 350.0], [1.0, f64::NAN]] {
        let mut slopes = [0.0; 2];
        assert!(table.value_and_slopes(&point, &mut slopes).is_nan());
        assert!(slopes.iter().all(|slope| slope.is_nan()));
    }
    // A coordinate that is not there is like one that is not known.
    assert!(table.value(&[1.0]).is_nan());
}

/// Semantics 4.4: right-hand slope at a knot, zero at the last one and outside.
#[test]
fn slopes_at_knots_and_outside() {
    let one_axis = table(&[&[20.0, 0.0], &[10.0, 1.0], &[4.0, 3.0]]);
    for (x, slope) in [(-1.0, 0.0), (0.0, -10.0), (0.5, -10.0), (1.0, -3.0), (2.0, -3.0), (3.0, 0.0), (9.0, 0.0)] {
        assert_eq!(one_axis.slope_at(0, x, &[]), slope, "at {x}");
    }
    let nested = table(&A_13);
    let mut slopes = [0.0; 2];
    assert_eq!(nested.value_and_slopes(&[1.0, 350.0], &mut slopes), 11.75);
    // Right-hand slopes -4 and -2.5 of the two groups; values 6 and 17.5 over 100 degrees.
    assert_eq!(slopes, [-3.25, 0.115]);
    nested.value_and_slopes(&[1.0, 400.0], &mut slopes);
    assert_eq!(slopes, [-2.5, 0.0]);
    nested.value_and_slopes(&[1.0, 300.0], &mut slopes);
    assert_eq!(slopes, [-4.0, 0.115]);
}

/// V-4 by analogy: 10 at f = 1, 15 at f = 2, in pairs d = 0, 1 as T-11 has them.
#[test]
fn v_4_field_variable() {
    let rows: [&[f64]; 4] =
        [&[10.0, 0.0, 0.0, 1.0], &[10.0, 1.0, 0.0, 1.0], &[15.0, 0.0, 0.0, 2.0], &[15.0, 1.0, 0.0, 2.0]];
    let conductance = table(&rows).value(&[0.3, 20.0, 1.5]);
    assert_eq!(conductance, 12.5);
    assert_eq!(conductance * 50.0, 625.0);
    assert_eq!(conductance * 50.0 / 4.0, 156.25);
}

/// The answers of CalculiX 2.20 for thermal contact, whose pressure table obeys the same law.
#[test]
fn pressure_table_as_calculix_evaluates_it() {
    let rows: [&[f64]; 4] = [&[100.0, 0.0], &[200.0, 500.0], &[400.0, 1000.0], &[1000.0, 5000.0]];
    let table = table(&rows);
    let answers = [
        (0.1, 100.02),
        (250.0, 150.0),
        (500.0, 200.0),
        (750.0, 300.0),
        (1000.0, 400.0),
        (3000.0, 700.0),
        (5000.0, 1000.0),
        (10000.0, 1000.0),
    ];
    for (pressure, conductance) in answers {
        assert_eq!(table.value(&[pressure]), conductance, "at p = {pressure}");
    }
}

/// Two curves of one range of pressure, the second with twice the conductance: linear in temperature, constant outside.
#[test]
fn two_temperatures_as_calculix_evaluates_them() {
    let curve = [(100.0, 0.0), (200.0, 500.0), (400.0, 1000.0), (1000.0, 5000.0)];
    let rows: Vec<f64> = [(293.0, 1.0), (393.0, 2.0)]
        .iter()
        .flat_map(|&(temperature, factor)| {
            curve.map(move |(conductance, pressure)| [product(&[conductance, factor]), pressure, temperature])
        })
        .flatten()
        .collect();
    let table = PiecewiseTable::from_rows(&rows, 3, Tail::Constant).unwrap();
    assert_eq!(table.value(&[750.0, 343.0]), 450.0);
    assert_eq!(table.value(&[750.0, 543.0]), 600.0);
}

/// Curves over different ranges of pressure: each is held constant by itself, where CalculiX clips both to the range they share (T-06).
#[test]
fn curves_of_different_range_are_constant_by_themselves() {
    let rows: [&[f64]; 7] = [
        &[100.0, 0.0, 293.0],
        &[200.0, 500.0, 293.0],
        &[400.0, 1000.0, 293.0],
        &[1000.0, 5000.0, 293.0],
        &[400.0, 500.0, 393.0],
        &[600.0, 1000.0, 393.0],
        &[800.0, 2000.0, 393.0],
    ];
    let table = table(&rows);
    assert_eq!(table.value(&[100.0, 343.0]), 260.0);
    assert_eq!(table.value(&[4000.0, 343.0]), 825.0);
}

#[test]
fn a_million_rows() {
    let cells: Vec<f64> = (0..1_000)
        .flat_map(|z| (0..1_000).flat_map(move |x| [f64::from(x) + f64::from(z), f64::from(x), f64::from(z)]))
        .collect();
    let table = PiecewiseTable::from_rows(&cells, 3, Tail::Constant).unwrap();
    assert_eq!((table.row_count(), table.group_count()), (1_000_000, 1_000));
    assert_eq!(table.axes()[0].distinct_count, 1_000);
    assert_eq!(table.value(&[500.25, 700.5]), 1200.75);
    assert_eq!(table.value(&[2e9, -1.0]), 999.0);
}

/// Many axes, each of which matters, so that every query goes through all of them.
#[test]
fn a_thousand_axes() {
    let axes = 1_000;
    let rows: Vec<Vec<f64>> = (0..=axes)
        .map(|step| {
            let mut row = vec![0.0; axes + 1];
            row[0] = step as f64;
            if step > 0 {
                row[step] = 1.0;
            }
            row
        })
        .collect();
    let table = PiecewiseTable::from_rows(&rows.concat(), axes + 1, Tail::Constant).unwrap();
    assert!(table.axes().iter().all(AxisSummary::matters));
    for row in &rows {
        assert_eq!(table.value(&row[1..]), row[0]);
    }
    // The slowest axis alone decides half and half between its last row and what the others give at the same point, and so on inwards.
    let mut expected = 0.5;
    for step in 2..=axes {
        expected = 0.5 * expected + 0.5 * step as f64;
    }
    assert!((table.value(&vec![0.5; axes]) - expected).abs() <= 1e-12 * expected);
    assert!(!table.sides(&vec![2.0; axes]).is_within());
}
