//! The electrical law by the numbered rules: branches, tails, current and heat, slopes, extremes.

mod table_judge;

use inpact_evaluation::law::{
    Branch, Clearance, ConductanceTables, ContactPoint, ContactPressure, ContactState, Dissipation, ElectricalLaw,
    HeatGeneration, PotentialJump, generated_heat,
};
use inpact_evaluation::table::{PiecewiseTable, Tail};
use num_rational::BigRational;
use proptest::prelude::*;
use table_judge::{exact, ulps_from};

const CLOSED: ContactState = ContactState::Closed;
const OPEN: ContactState = ContactState::Open;

fn table(rows: &[[f64; 2]], tail: Tail) -> PiecewiseTable {
    PiecewiseTable::from_rows(rows.as_flattened(), 2, tail).unwrap()
}

/// The clearance rows of T-21.
fn clearance_table(tail: Tail) -> PiecewiseTable {
    table(&[[20.0, 0.0], [10.0, 0.1]], tail)
}

/// The pressure rows of T-21.
fn pressure_table() -> PiecewiseTable {
    table(&[[50.0, 0.0], [65.0, 100.0], [70.0, 250.0]], Tail::Constant)
}

fn both(tail: Tail) -> ConductanceTables {
    ConductanceTables::Both { clearance: clearance_table(tail), pressure: pressure_table() }
}

fn point(clearance: f64, pressure: f64, state: ContactState) -> ContactPoint<'static> {
    ContactPoint { clearance: Clearance(clearance), pressure: ContactPressure(pressure), state, variables: &[] }
}

fn conductance(tables: &ConductanceTables, clearance: f64, pressure: f64, state: ContactState) -> f64 {
    tables.conductance(&point(clearance, pressure, state)).value
}

#[test]
fn a_10_clearance_only() {
    let constant = ConductanceTables::Clearance(clearance_table(Tail::Constant));
    for (d, expected) in [(-1e-3, 20.0), (0.0, 20.0), (0.05, 15.0), (0.1, 10.0), (0.2, 10.0)] {
        let state = ContactState::from_clearance_and_pressure(Clearance(d), ContactPressure(0.0));
        assert_eq!(conductance(&constant, d, 0.0, state), expected, "at d = {d}");
    }
    let zero = ConductanceTables::Clearance(clearance_table(Tail::Zero));
    for (d, expected) in [(-1e-3, 20.0), (0.05, 15.0), (0.1, 10.0), (0.1f64.next_up(), 0.0), (0.2, 0.0)] {
        assert_eq!(conductance(&zero, d, 0.0, OPEN), expected, "at d = {d}");
    }
    // Overclosure counts as d = 0 at any pressure and is not beyond the table; a large clearance is.
    assert_eq!(conductance(&constant, -1.0, 1e6, CLOSED), 20.0);
    assert!(constant.conductance(&point(-1.0, 0.0, CLOSED)).sides.is_within());
    assert!(constant.conductance(&point(0.2, 0.0, OPEN)).sides.is_above(0));
}

#[test]
fn a_11_both_branches() {
    let tables = both(Tail::Constant);
    assert_eq!(conductance(&tables, 0.0, 0.0, CLOSED), 50.0);
    assert_eq!(conductance(&tables, 0.0, -5.0, CLOSED), 50.0);
    assert_eq!(conductance(&tables, 1e-9, 0.0, OPEN), 20.0 - 1e-7);
    assert_eq!(conductance(&tables, 0.05, 0.0, OPEN), 15.0);
    assert!(tables.conductance(&point(0.0, -5.0, CLOSED)).sides.is_below(0));
}

#[test]
fn t_21_sample_numbers() {
    let tables = both(Tail::Zero);
    assert_eq!(conductance(&tables, 0.0, 100.0, CLOSED), 65.0);
    assert_eq!(conductance(&tables, 0.0, 175.0, CLOSED), 67.5);
    assert_eq!(conductance(&tables, 0.0, 400.0, CLOSED), 70.0);
    assert_eq!(conductance(&tables, 0.11, 0.0, OPEN), 0.0);
}

#[test]
fn a_12_pressure_only() {
    let tables = ConductanceTables::Pressure(table(&[[50.0, 0.0], [65.0, 100.0]], Tail::Constant));
    let open = tables.conductance(&point(1e-12, 0.0, OPEN));
    assert_eq!((open.value, open.branch), (0.0, Branch::Neither));
    assert_eq!(conductance(&tables, 0.0, 50.0, CLOSED), 57.5);
    assert_eq!(conductance(&tables, 0.0, 1e6, CLOSED), 65.0);
}

/// A-13 through the law: the temperature is a variable after the clearance.
#[test]
fn a_13_two_temperatures() {
    let rows = [[10.0, 0.0, 300.0], [6.0, 1.0, 300.0], [2.0, 2.0, 300.0], [20.0, 0.0, 400.0], [10.0, 4.0, 400.0]];
    let with_tail =
        |tail| ConductanceTables::Clearance(PiecewiseTable::from_rows(rows.as_flattened(), 3, tail).unwrap());
    let value = |tail, d| {
        let point = ContactPoint { variables: &[350.0], ..point(d, 0.0, OPEN) };
        with_tail(tail).conductance(&point).value
    };
    assert_eq!(value(Tail::Constant, 2.0), 8.5);
    assert_eq!(value(Tail::Constant, 3.0), 7.25);
    assert_eq!(value(Tail::Zero, 3.0), 6.25);
}

/// without a flag, closed means d <= 0 or p ≠ 0.
#[test]
fn t_22_closed_by_clearance_or_pressure() {
    let state = |d, p| ContactState::from_clearance_and_pressure(Clearance(d), ContactPressure(p));
    assert_eq!(state(0.0, 0.0), CLOSED);
    assert_eq!(state(-1.0, 0.0), CLOSED);
    assert_eq!(state(1e-3, 2.0), CLOSED);
    assert_eq!(state(1e-3, -2.0), CLOSED);
    assert_eq!(state(1e-3, 0.0), OPEN);
    assert_eq!(state(f64::NAN, 2.0), CLOSED);
    assert_eq!(state(-1.0, f64::NAN), CLOSED);
    assert_eq!(state(f64::NAN, 0.0), ContactState::Undetermined);
    assert_eq!(state(1.0, f64::NAN), ContactState::Undetermined);
}

#[test]
fn an_undetermined_state_or_input_gives_nan() {
    for tables in [both(Tail::Zero), ConductanceTables::Pressure(pressure_table())] {
        let undetermined = point(f64::NAN, 0.0, ContactState::Undetermined);
        assert!(tables.conductance(&undetermined).value.is_nan());
        let slopes = tables.slopes(&undetermined, &mut []);
        assert!(slopes.clearance.is_nan() && slopes.pressure.is_nan());
        assert!(conductance(&tables, 0.0, f64::NAN, CLOSED).is_nan());
    }
    assert!(conductance(&both(Tail::Zero), f64::NAN, 0.0, OPEN).is_nan());
    let clearance = ConductanceTables::Clearance(clearance_table(Tail::Constant));
    assert!(conductance(&clearance, f64::NAN, 3.0, OPEN).is_nan());
    assert!(conductance(&clearance, 0.5, f64::NAN, ContactState::Undetermined).is_nan());
    // Closed, it is the value at zero clearance, whatever the clearance.
    for clearance_of_closed in [f64::NAN, -1.0, 0.0, 0.05, 7.0] {
        assert_eq!(conductance(&clearance, clearance_of_closed, 3.0, CLOSED), conductance(&clearance, 0.0, 0.0, OPEN));
    }
}

#[test]
fn slopes_follow_the_branch_in_force() {
    let tables = both(Tail::Constant);
    let slopes = |d, p, state| {
        let slopes = tables.slopes(&point(d, p, state), &mut []);
        (slopes.clearance, slopes.pressure)
    };
    assert_eq!(slopes(0.05, 0.0, OPEN), (-100.0, 0.0));
    assert_eq!(slopes(0.0, 0.0, OPEN), (-100.0, 0.0));
    assert_eq!(slopes(0.1, 0.0, OPEN), (0.0, 0.0));
    assert_eq!(slopes(-0.1, 0.0, OPEN), (0.0, 0.0));
    assert_eq!(slopes(0.0, 0.0, CLOSED), (0.0, 0.15));
    assert_eq!(slopes(0.0, 50.0, CLOSED), (0.0, 0.15));
    assert_eq!(slopes(0.0, -5.0, CLOSED), (0.0, 0.0));
    assert_eq!(slopes(0.0, 250.0, CLOSED), (0.0, 0.0));
    let pressure_only = ConductanceTables::Pressure(pressure_table());
    let open = pressure_only.slopes(&point(1.0, 0.0, OPEN), &mut []);
    assert_eq!((open.clearance, open.pressure), (0.0, 0.0));
}

#[test]
fn slopes_along_temperature_and_field_variables() {
    let mut cells = Vec::new();
    for (field, factor) in [(0.0, 1.0), (2.0, 3.0)] {
        for (temperature, base) in [(300.0, 10.0), (400.0, 30.0)] {
            for d in [0.0, 1.0] {
                cells.extend([(base - 5.0 * d) * factor, d, temperature, field]);
            }
        }
    }
    let tables = ConductanceTables::Clearance(PiecewiseTable::from_rows(&cells, 4, Tail::Constant).unwrap());
    let point = ContactPoint { variables: &[325.0, 1.0], ..point(0.5, 0.0, OPEN) };
    let mut variables = [f64::NAN; 2];
    let slopes = tables.slopes(&point, &mut variables);
    assert_eq!(tables.conductance(&point).value, 25.0);
    assert_eq!((slopes.clearance, slopes.pressure), (-10.0, 0.0));
    assert_eq!(variables, [0.4, 12.5]);
}

#[test]
fn a_20_current_and_its_heat() {
    let law = ElectricalLaw {
        conductance: ConductanceTables::Clearance(PiecewiseTable::constant(10.0)),
        heat_generation: HeatGeneration { fraction: 0.5, slave_weight: 0.25 },
    };
    let conductance = law.conductance.conductance(&point(0.0, 0.0, CLOSED)).value;
    let flow = law.flow(conductance, PotentialJump::between(3.0, 1.0), Dissipation::Steady);
    assert_eq!(flow.current_density, 20.0);
    assert_eq!((flow.heat.total, flow.heat.slave, flow.heat.master), (20.0, 5.0, 15.0));
}

#[test]
fn a_21_transient_heat() {
    let transient = Dissipation::Transient { jump_at_start: PotentialJump(2.0) };
    let heat = generated_heat(3.0, PotentialJump(5.0), transient, HeatGeneration::default());
    assert_eq!((heat.total, heat.slave, heat.master), (39.0, 19.5, 19.5));
}

/// C-25: an increment that starts with its own jump generates the steady heat.
#[test]
fn transient_heat_of_a_constant_jump_is_steady() {
    for jump in [0.0, 1.0, -0.1, 1e160, 1e-170, 7.3e-5] {
        let jump = PotentialJump(jump);
        let of = |dissipation| generated_heat(2.5e-3, jump, dissipation, HeatGeneration::default());
        assert_eq!(of(Dissipation::Transient { jump_at_start: jump }), of(Dissipation::Steady));
    }
}

/// σ = 1e-300 and Δφ = 1e160: Δφ² overflows, the heat does not.
#[test]
fn heat_survives_overflow_on_the_way() {
    let heat = |dissipation| generated_heat(1e-300, PotentialJump(1e160), dissipation, HeatGeneration::default());
    let steady = heat(Dissipation::Steady);
    let expected = exact(1e-300) * exact(1e160) * exact(1e160);
    assert!(ulps_from(steady.total, &expected) <= 0.500_001);
    assert_eq!((steady.slave, steady.master), (0.5 * steady.total, 0.5 * steady.total));
    let transient = heat(Dissipation::Transient { jump_at_start: PotentialJump(0.0) });
    assert!(ulps_from(transient.total, &(expected / exact(3.0))) <= 0.500_001);
}

#[test]
fn heat_of_infinite_and_undefined_inputs() {
    let heat = |conductance, jump| {
        generated_heat(conductance, PotentialJump(jump), Dissipation::Steady, HeatGeneration::default()).total
    };
    assert_eq!(heat(2.0, f64::INFINITY), f64::INFINITY);
    assert!(heat(0.0, f64::INFINITY).is_nan());
    assert!(heat(f64::NAN, 1.0).is_nan());
    assert_eq!(heat(0.0, f64::MAX), 0.0);
    assert_eq!(heat(1.0, f64::MAX), f64::INFINITY);
}

/// Any finite magnitude.
fn finite() -> impl Strategy<Value = f64> {
    any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |value| value.is_finite())
}

proptest! {
    /// H-08 in exact arithmetic. A negative mixed term can quarter the sum of squares and so amplifies the roundings of its terms fourfold.
    #[test]
    fn heat_is_right_wherever_it_is_finite(conductance in finite(), end in finite(), start in finite(), fraction in 0.0..2.0, weight in 0.0..=1.0) {
        let conductance = f64::abs(conductance);
        let generation = HeatGeneration { fraction, slave_weight: weight };
        let dissipation = Dissipation::Transient { jump_at_start: PotentialJump(start) };
        let heat = generated_heat(conductance, PotentialJump(end), dissipation, generation);
        let (end, start) = (exact(end), exact(start));
        let squares = &end * &end + &end * &start + &start * &start;
        let total: BigRational = exact(fraction) * exact(conductance) * squares / exact(3.0);
        if heat.total.is_finite() {
            prop_assert!(ulps_from(heat.total, &total) <= 10.0);
        }
        if heat.slave.is_finite() {
            prop_assert!(ulps_from(heat.slave, &(exact(weight) * &total)) <= 11.0);
        }
        if heat.master.is_finite() {
            prop_assert!(ulps_from(heat.master, &((exact(1.0) - exact(weight)) * &total)) <= 12.0);
        }
    }

    /// The current's derivative along the clearance is that of its difference quotient inside a segment.
    #[test]
    fn slope_is_that_of_the_conductance(d in 0.001..0.099, p in 1.0..99.0) {
        let tables = both(Tail::Constant);
        for (state, before, after) in [
            (OPEN, point(d, 0.0, OPEN), point(d + 5e-4, 0.0, OPEN)),
            (CLOSED, point(0.0, p, CLOSED), point(0.0, p + 0.5, CLOSED)),
        ] {
            let rise = tables.conductance(&after).value - tables.conductance(&before).value;
            let slopes = tables.slopes(&before, &mut []);
            let (slope, run) = match state {
                OPEN => (slopes.clearance, after.clearance.0 - before.clearance.0),
                _ => (slopes.pressure, after.pressure.0 - before.pressure.0),
            };
            prop_assert!((rise / run - slope).abs() <= 1e-10 * slope.abs());
        }
    }
}
