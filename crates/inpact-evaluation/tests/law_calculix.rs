//! The conductance of CalculiX, row by row against runs of ccx 2.20: two unit cubes, face to face, 100 degrees between them.
//!
//! All temperatures of a run are prescribed, so the heat that ccx printed is Q = k(p, θ̄) × 1 × 100.

use inpact_evaluation::law::{
    CalculixConductance, Clearance, ContactPoint, ContactPressure, ContactState, HeatGeneration, InterfaceHeat,
    ShearStress, SlipRate, Temperatures, ThermalConductance, conducted_heat, frictional_heat,
};
use inpact_evaluation::numbers::Amount;
use inpact_evaluation::table::{PiecewiseTable, Tail};
use inpact_evaluation::{ErrorKind, TableFault};
use proptest::prelude::*;

type Row = [f64; 3];

/// One curve, given for one temperature and used at any.
const ONE: &[Row] = &[[100.0, 0.0, 293.0], [200.0, 500.0, 293.0], [400.0, 1000.0, 293.0], [1000.0, 5000.0, 293.0]];
/// The same and twice as much, 100 degrees higher.
const T2: &[Row] = &[
    [100.0, 0.0, 293.0],
    [200.0, 500.0, 293.0],
    [400.0, 1000.0, 293.0],
    [1000.0, 5000.0, 293.0],
    [200.0, 0.0, 393.0],
    [400.0, 500.0, 393.0],
    [800.0, 1000.0, 393.0],
    [2000.0, 5000.0, 393.0],
];
/// Two curves over different pressures.
const T3: &[Row] = &[
    [100.0, 0.0, 293.0],
    [200.0, 500.0, 293.0],
    [400.0, 1000.0, 293.0],
    [1000.0, 5000.0, 293.0],
    [400.0, 500.0, 393.0],
    [800.0, 2000.0, 393.0],
];

fn law(rows: &[Row]) -> CalculixConductance {
    CalculixConductance::from_rows(rows.as_flattened()).unwrap()
}

fn conductance(rows: &[Row], pressure: f64, temperature: f64) -> f64 {
    let variables = [temperature];
    law(rows).conductance(&closed(pressure, &variables)).value
}

fn closed(pressure: f64, variables: &[f64]) -> ContactPoint<'_> {
    ContactPoint {
        clearance: Clearance(0.0),
        pressure: ContactPressure(pressure),
        state: ContactState::Closed,
        variables,
    }
}

/// The heat out of the upper cube, which is the slave and 100 degrees hotter than the lower one.
fn heat(rows: &[Row], pressure: f64, lower: f64) -> f64 {
    let sides = Temperatures::of(lower + 100.0, lower);
    conducted_heat(conductance(rows, pressure, sides.mean()), sides)
}

/// That a number agrees with one printed with seven digits.
#[track_caller]
fn agrees(found: f64, printed: &str) {
    let printed: f64 = printed.parse().unwrap();
    assert!((found / printed - 1.0).abs() <= 5e-7, "{found} against {printed}");
}

#[test]
fn one_curve() {
    let printed = [
        (0.1, "1.000200E+04"),
        (250.0, "1.500000E+04"),
        (500.0, "2.000000E+04"),
        (750.0, "3.000000E+04"),
        (1000.0, "4.000000E+04"),
        (3000.0, "7.000000E+04"),
        (5000.0, "1.000000E+05"),
        (10000.0, "1.000000E+05"),
    ];
    for (pressure, printed) in printed {
        agrees(heat(ONE, pressure, 293.0), printed);
    }
    // At any temperature.
    assert_eq!(conductance(ONE, 750.0, 1e6), conductance(ONE, 750.0, -1e6));
}

#[test]
fn two_curves_linear_in_temperature_and_constant_outside() {
    agrees(heat(T2, 750.0, 293.0), "4.500000E+04");
    agrees(heat(T2, 750.0, 493.0), "6.000000E+04");
    assert_eq!(conductance(T2, 750.0, 343.0), 450.0);
    assert_eq!(conductance(T2, 750.0, 543.0), 600.0);
    assert_eq!(conductance(T2, 750.0, 100.0), 300.0);
}

/// Where the curves have pressures of their own, ccx and the nested table differ.
#[test]
fn two_curves_clipped_to_the_pressures_they_share() {
    agrees(heat(T3, 100.0, 293.0), "3.000000E+04");
    agrees(heat(T3, 1500.0, 293.0), "5.708333E+04");
    agrees(heat(T3, 4000.0, 293.0), "6.750000E+04");
    let nested = PiecewiseTable::from_rows(T3.as_flattened(), 3, Tail::Constant).unwrap();
    for (pressure, clipped, by_curve) in [(100.0, 300.0, 260.0), (4000.0, 675.0, 825.0)] {
        assert_eq!(conductance(T3, pressure, 343.0), clipped);
        assert_eq!(nested.value(&[pressure, 343.0]), by_curve);
    }
    assert!((nested.value(&[1500.0, 343.0]) / conductance(T3, 1500.0, 343.0) - 1.0).abs() < 1e-15);
    // Below the first curve that curve holds as it is; from its own temperature on it is clipped.
    assert_eq!(conductance(T3, 100.0, 293.0f64.next_down()), 120.0);
    assert_eq!(conductance(T3, 100.0, 293.0), 200.0);
    // From the last curve on it holds as it is: nothing is clipped of the shorter one here.
    assert_eq!(conductance(T3, 4000.0, 393.0), 800.0);
}

/// The sweep over the number of rows: k = 100 + 10 i at p = 100 i gives 225 at 1250, as ccx does up to 32 rows; beyond, it reads past its own arrays.
#[test]
fn the_number_of_rows_changes_nothing() {
    for rows in [14_u32, 20, 21, 25, 32, 33, 60, 199] {
        let rows: Vec<Row> =
            (0..rows).map(|row| [100.0 + 10.0 * f64::from(row), 100.0 * f64::from(row), 0.0]).collect();
        assert_eq!(conductance(&rows, 1250.0, 343.0), 225.0);
    }
}

/// heatgen2: η 0.8, a quarter into the slave, speed 3 given, τ = 500, k = 100 between two cubes of conductivity 50 whose ends are held at the same temperature.
///
/// The network of the two cubes and the gap then gives what ccx printed at the two ends, 540 and 660.
#[test]
fn heat_generation_and_its_shares() {
    let generation = HeatGeneration { fraction: 0.8, slave_weight: 0.25 };
    let friction = frictional_heat(ShearStress(500.0), SlipRate(3.0), generation);
    assert_eq!((friction.total, friction.slave, friction.master), (1200.0, 300.0, 900.0));
    let law = ThermalConductance::Calculix(law(&[[100.0, 0.0, 0.0]]));
    // Unknowns: how far the faces are above the ends. Each cube leads away what its face takes in.
    let taken = |slave: f64, master: f64| {
        let sides = Temperatures::of(slave, master);
        let conductance = law.conductance(&closed(1000.0, &[sides.mean()])).value;
        let conduction = conducted_heat(conductance, sides);
        let nothing = frictional_heat(ShearStress(0.0), SlipRate(0.0), generation);
        let (conduction, radiation) = (Amount::new(conduction), Amount::ZERO);
        let heat = InterfaceHeat { conduction, radiation, current: nothing.into(), friction: friction.into() };
        (heat.into_slave(), heat.into_master())
    };
    let (mut slave, mut master) = (0.0, 0.0);
    for _ in 0..2000 {
        let (into_slave, into_master) = taken(slave, master);
        slave += 0.2 * (into_slave / 50.0 - slave);
        master += 0.2 * (into_master / 50.0 - master);
    }
    let (into_slave, into_master) = taken(slave, master);
    assert!((into_slave - 540.0).abs() < 1e-9 && (into_master - 660.0).abs() < 1e-9, "{into_slave} {into_master}");
}

/// series_p1000: the same two cubes with 100 degrees between their ends, 100 / (1/50 + 1/400 + 1/50).
#[test]
fn in_series_with_two_cubes() {
    let rows: Vec<Row> = ONE.iter().map(|&[value, pressure, _]| [value, pressure, 0.0]).collect();
    let (mut slave, mut master) = (393.0, 293.0);
    let flux = |slave: f64, master: f64| {
        let sides = Temperatures::of(slave, master);
        conducted_heat(conductance(&rows, 1000.0, sides.mean()), sides)
    };
    for _ in 0..2000 {
        let leaving = flux(slave, master);
        slave += 0.05 * ((393.0 - leaving / 50.0) - slave);
        master += 0.05 * ((293.0 + leaving / 50.0) - master);
    }
    agrees(flux(slave, master), "2.352941E+03");
}

#[test]
fn an_open_pair_conducts_nothing() {
    let point = ContactPoint { state: ContactState::Open, clearance: Clearance(1e-5), ..closed(0.0, &[343.0]) };
    let open = law(ONE).conductance(&point);
    assert_eq!((open.value, open.sides.is_within()), (0.0, true));
    let point = ContactPoint { state: ContactState::Undetermined, ..point };
    assert!(law(ONE).conductance(&point).value.is_nan());
}

/// What ccx takes without a word and reads wrongly is no law here.
#[test]
fn rows_that_do_not_ascend_are_refused() {
    let refused = |rows: &[Row]| CalculixConductance::from_rows(rows.as_flattened()).unwrap_err().to_string();
    let row = |value, pressure| [value, pressure, 293.0];
    let unsorted = [row(100.0, 0.0), row(400.0, 1000.0), row(200.0, 500.0), row(1000.0, 5000.0)];
    assert_eq!(refused(&unsorted), "row 3 has 500.0 after 1000.0 in column 2, which must ascend");
    let descending = [row(1000.0, 5000.0), row(400.0, 1000.0), row(200.0, 500.0), row(100.0, 0.0)];
    assert_eq!(refused(&descending), "row 2 has 1000.0 after 5000.0 in column 2, which must ascend");
    let duplicate = [row(100.0, 0.0), row(200.0, 500.0), row(300.0, 500.0), row(1000.0, 5000.0)];
    assert_eq!(refused(&duplicate), "row 3 has 500.0 after 500.0 in column 2, which must ascend");
    assert_eq!(
        refused(&[[1.0, 0.0, 393.0], [1.0, 0.0, 293.0]]),
        "row 2 has 293.0 after 393.0 in column 3, which must ascend"
    );
    assert_eq!(refused(&[]), "the table has no rows");
    assert_eq!(refused(&[[f64::NAN, 0.0, 0.0]]), "row 1 has NaN in column 1");
}

/// ccx stops at curves that share no pressures, and at such as share only the end of the one that begins first.
#[test]
fn curves_without_pressures_in_common_are_refused() {
    let of = |first: [f64; 2], second: [f64; 2]| {
        let rows = [[1.0, first[0], 0.0], [2.0, first[1], 0.0], [3.0, second[0], 9.0], [4.0, second[1], 9.0]];
        CalculixConductance::from_rows(rows.as_flattened()).err()
    };
    let disjoint = of([0.0, 1.0], [2.0, 3.0]);
    let error = disjoint.expect("no pressures in common");
    assert_eq!(error.to_string(), "the curves at temperatures 0.0 and 9.0 share no pressures");
    let fault = TableFault::NoSharedPressures { temperatures: [0.0, 9.0] };
    assert_eq!(*error.kind(), ErrorKind::Rows { row: 2, fault });
    assert_eq!(of([2.0, 3.0], [0.0, 1.0]), disjoint);
    assert_eq!(of([0.0, 1.0], [1.0, 3.0]), disjoint);
    assert_eq!(of([1.0, 3.0], [0.0, 1.0]), disjoint);
    assert_eq!(of([0.0, 1.0], [0.5, 3.0]), None);
    assert_eq!(of([0.0, 1.0], [0.0, 3.0]), None);
    // Curves of one row share the one pressure where they begin.
    let rows = [[1.0, 0.0, 0.0], [3.0, 0.0, 10.0], [9.0, 5.0, 10.0]];
    assert_eq!(conductance(&rows, 4.0, 5.0), 2.0);
}

#[test]
fn slopes_are_those_of_the_clipped_curves() {
    let law = ThermalConductance::Calculix(law(T3));
    let slopes = |pressure, temperature: f64| {
        let variables = [temperature, 0.0];
        let mut along = [9.0; 2];
        let slopes = law.slopes(&closed(pressure, &variables), &mut along);
        (slopes.pressure, along)
    };
    let (along_pressure, along) = slopes(750.0, 343.0);
    // 200 → 400 over 500 in the one curve, 400 → 800 over 1500 in the other.
    assert!((along_pressure - 0.5 * (0.4 + 400.0 / 1500.0)).abs() < 1e-15);
    assert!((along[0] - (400.0 + 250.0 * 400.0 / 1500.0 - 300.0) / 100.0).abs() < 1e-14);
    assert_eq!(along[1], 0.0, "nothing depends on a mass flow rate");
    // Outside the pressures both have, and outside the temperatures.
    assert_eq!(slopes(100.0, 343.0).0, 0.0);
    assert_eq!(slopes(750.0, 400.0).1[0], 0.0);
    let point = ContactPoint { state: ContactState::Open, ..closed(750.0, &[343.0]) };
    let mut along = [9.0];
    assert_eq!((law.slopes(&point, &mut along).pressure, along), (0.0, [0.0]));
}

/// Curves over pressures of their own: rows of two temperatures, ascending.
fn curve() -> impl Strategy<Value = Vec<(f64, f64)>> {
    prop::collection::vec((1.0..100.0_f64, 1.0..1000.0_f64), 1..6).prop_map(|steps| {
        let mut pressure = -200.0;
        let row = |(step, value)| {
            pressure += step;
            (value, pressure)
        };
        steps.into_iter().map(row).collect()
    })
}

/// The value of a curve with a constant end, written anew.
fn value_of(curve: &[(f64, f64)], pressure: f64) -> f64 {
    let right = curve.iter().position(|(_, knot)| pressure < *knot);
    match right {
        None => curve[curve.len() - 1].0,
        Some(0) => curve[0].0,
        Some(right) => {
            let ((y0, x0), (y1, x1)) = (curve[right - 1], curve[right]);
            y0 + (pressure - x0) / (x1 - x0) * (y1 - y0)
        }
    }
}

proptest! {
    /// Clipping the pressure to what both curves have, and each curve by itself, is the same law.
    #[test]
    fn clipped_curves_are_curves_at_a_clipped_pressure(
        first in curve(), second in curve(), pressure in -300.0..500.0_f64, part in 0.0..1.0_f64,
    ) {
        let (start, end) = (first[0].1.max(second[0].1), first[first.len() - 1].1.min(second[second.len() - 1].1));
        prop_assume!(start < end);
        let temperature = 300.0 + 100.0 * part;
        let rows = |curve: &[(f64, f64)], at: f64| -> Vec<Row> { curve.iter().map(|&(y, p)| [y, p, at]).collect() };
        let rows = [rows(&first, 300.0), rows(&second, 400.0)].concat();
        let clipped = pressure.clamp(start, end);
        let weight = (temperature - 300.0) / 100.0;
        let expected = value_of(&first, clipped) * (1.0 - weight) + value_of(&second, clipped) * weight;
        let found = conductance(&rows, pressure, temperature);
        prop_assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    }
}
