//! Conduction, friction and the sum of all heat by the numbered rules, against published numbers and exact rationals.

mod table_judge;

use inpact_evaluation::law::{
    Branch, Clearance, ConductanceTables, ContactPoint, ContactPressure, ContactState, Dissipation, GeneratedHeat,
    HeatGeneration, InterfaceHeat, PotentialJump, ShearStress, SlipRate, Temperatures, ThermalConductance,
    conducted_heat, conducted_heat_slopes, frictional_heat, generated_heat, mean_mass_flow,
};
use inpact_evaluation::numbers::Amount;
use inpact_evaluation::table::{PiecewiseTable, Tail};
use proptest::prelude::*;
use table_judge::{exact, ulps_from};

const CLOSED: ContactState = ContactState::Closed;
const OPEN: ContactState = ContactState::Open;
const NO_HEAT: GeneratedHeat = GeneratedHeat { total: 0.0, slave: 0.0, master: 0.0 };

/// The heat of an interface whose parts are known as f64.
fn interface(conduction: f64, radiation: f64, current: GeneratedHeat, friction: GeneratedHeat) -> InterfaceHeat {
    let [conduction, radiation] = [conduction, radiation].map(Amount::new);
    InterfaceHeat { conduction, radiation, current: current.into(), friction: friction.into() }
}

fn table<const WIDTH: usize>(rows: &[[f64; WIDTH]], tail: Tail) -> PiecewiseTable {
    PiecewiseTable::from_rows(rows.as_flattened(), WIDTH, tail).unwrap()
}

/// The two tables of T-21.
fn sample() -> ThermalConductance {
    ThermalConductance::Tables(ConductanceTables::Both {
        clearance: table(&[[20.0, 0.0], [10.0, 0.1]], Tail::Zero),
        pressure: table(&[[50.0, 0.0], [65.0, 100.0], [70.0, 250.0]], Tail::Constant),
    })
}

fn point(clearance: f64, pressure: f64, state: ContactState) -> ContactPoint<'static> {
    ContactPoint { clearance: Clearance(clearance), pressure: ContactPressure(pressure), state, variables: &[] }
}

fn temperatures(slave: f64, master: f64) -> Temperatures {
    Temperatures::of(slave, master)
}

/// The zero of a rising function between two bounds.
fn root(mut low: f64, mut high: f64, function: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if function(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[test]
fn t_21_sample_numbers() {
    let conductance = |d, p, state| sample().conductance(&point(d, p, state)).value;
    assert_eq!(conductance(0.0, 0.0, CLOSED), 50.0);
    assert_eq!(conductance(1e-9, 0.0, OPEN), 20.0 - 1e-7);
    assert_eq!(conductance(0.05, 0.0, OPEN), 15.0);
    assert_eq!(conductance(0.0, 100.0, CLOSED), 65.0);
    assert_eq!(conductance(0.0, 175.0, CLOSED), 67.5);
    assert_eq!(conductance(0.0, 400.0, CLOSED), 70.0);
    assert_eq!(conductance(0.0, -5.0, CLOSED), 50.0);
    // K-31: at the last clearance the row holds, immediately beyond it nothing.
    assert_eq!(conductance(0.1, 0.0, OPEN), 10.0);
    assert_eq!(conductance(0.1f64.next_up(), 0.0, OPEN), 0.0);
    assert_eq!(sample().conductance(&point(0.2, 0.0, OPEN)).branch, Branch::Clearance);
}

/// V-3: k = 1 over a length of 1 in series with h = 10, between 100 and 50.
#[test]
fn v_3_flux_and_face_temperature() {
    let flux = |face| conducted_heat(10.0, temperatures(face, 50.0));
    let face = root(50.0, 100.0, |face| flux(face) - (100.0 - face));
    assert!((face - 54.545_454_545_454_55).abs() < 1e-12, "{face}");
    assert!((flux(face) - 45.454_545_454_545_45).abs() < 1e-10);
}

/// V-1: the same with a current through it, half of whose dissipation becomes heat, shared equally.
#[test]
fn v_1_current_and_face_temperature() {
    let current_density = 50.0 / 1.1;
    let jump = PotentialJump(current_density / 10.0);
    let generation = HeatGeneration { fraction: 0.5, slave_weight: 0.5 };
    let current = generated_heat(10.0, jump, Dissipation::Steady, generation);
    assert!((current.slave - 51.652_892_561_983_47).abs() < 1e-12, "{current:?}");
    let leaving = |face| {
        let conduction = conducted_heat(10.0, temperatures(face, 50.0));
        interface(conduction, 0.0, current, NO_HEAT).leaving_slave().value()
    };
    let face = root(50.0, 100.0, |face| leaving(face) - (100.0 - face));
    assert!((face - 59.241_172_051_089_41).abs() < 1e-12, "{face}");
}

/// V-4: blank columns are zero, so mass flow is no axis that matters; halfway between two field values.
#[test]
fn v_4_field_variable() {
    let rows = [
        [10.0, 0.0, 0.0, 0.0, 1.0],
        [10.0, 1.0, 0.0, 0.0, 1.0],
        [15.0, 0.0, 0.0, 0.0, 2.0],
        [15.0, 1.0, 0.0, 0.0, 2.0],
    ];
    let law = ThermalConductance::Tables(ConductanceTables::Clearance(table(&rows, Tail::Zero)));
    let variables = [f64::NAN, f64::NAN, 1.5];
    let point = ContactPoint { variables: &variables, ..point(0.0, 0.0, CLOSED) };
    let conductance = law.conductance(&point).value;
    assert_eq!(conductance, 12.5);
    assert_eq!(conducted_heat(conductance, temperatures(70.0, 20.0)), 625.0);
    let mut slopes = [9.0; 3];
    law.slopes(&point, &mut slopes);
    assert_eq!(slopes, [0.0, 0.0, 5.0]);
}

/// T-03: the mass flow rate is the third variable, after clearance and temperature.
#[test]
fn k_32_mass_flow() {
    let rows = [[10.0, 0.0, 20.0, 0.0], [10.0, 1.0, 20.0, 0.0], [40.0, 0.0, 20.0, 3.0], [40.0, 1.0, 20.0, 3.0]];
    let law = ThermalConductance::Tables(ConductanceTables::Clearance(table(&rows, Tail::Zero)));
    let conductance = |mass_flow| {
        let variables = [20.0, mass_flow];
        law.conductance(&ContactPoint { variables: &variables, ..point(0.5, 0.0, OPEN) }).value
    };
    assert_eq!(conductance(mean_mass_flow(Some(-2.0), Some(1.0))), 25.0);
    assert_eq!(conductance(mean_mass_flow(Some(2.0), None)), 20.0);
    assert_eq!(conductance(mean_mass_flow(None, Some(-2.0))), 20.0);
    assert_eq!(mean_mass_flow(Some(f64::MAX), Some(f64::MAX)), f64::MAX);
    assert_eq!(mean_mass_flow(None, None), 0.0);
}

/// Section 8: the slopes of q_k against differences of q_k itself, with a conductance that is linear in the mean temperature.
#[test]
fn slopes_are_those_of_the_flux() {
    let rows = [[10.0, 0.0, 0.0], [10.0, 1.0, 0.0], [30.0, 0.0, 100.0], [50.0, 1.0, 100.0]];
    let law = ThermalConductance::Tables(ConductanceTables::Clearance(table(&rows, Tail::Zero)));
    let at = |slave: f64, master: f64| {
        let sides = temperatures(slave, master);
        let variables = [sides.mean()];
        let point = ContactPoint { variables: &variables, ..point(0.25, 0.0, OPEN) };
        let conductance = law.conductance(&point).value;
        let mut along = [0.0];
        law.slopes(&point, &mut along);
        (conducted_heat(conductance, sides), conducted_heat_slopes(conductance, along[0], sides))
    };
    let (slave, master, step) = (60.0, 25.0, 1e-4);
    let slopes = at(slave, master).1;
    let by_slave = (at(slave + step, master).0 - at(slave - step, master).0) / (2.0 * step);
    let by_master = (at(slave, master + step).0 - at(slave, master - step).0) / (2.0 * step);
    assert!((slopes.slave / by_slave - 1.0).abs() < 1e-8, "{slopes:?} {by_slave}");
    assert!((slopes.master / by_master - 1.0).abs() < 1e-8, "{slopes:?} {by_master}");
    assert_ne!(slopes.slave, -slopes.master, "the conductance depends on the temperature");
}

/// H-02, H-03, K-38: 0.8 of 500 × 3 becomes heat, a quarter of it in the slave.
#[test]
fn h_03_frictional_heat() {
    let generation = HeatGeneration { fraction: 0.8, slave_weight: 0.25 };
    let heat = frictional_heat(ShearStress(500.0), SlipRate(3.0), generation);
    assert_eq!(heat, GeneratedHeat { total: 1200.0, slave: 300.0, master: 900.0 });
    let defaults = frictional_heat(ShearStress(2.0), SlipRate(8.0), HeatGeneration::default());
    assert_eq!(defaults, GeneratedHeat { total: 16.0, slave: 8.0, master: 8.0 });
    // K-35: all of it on one side.
    let one_side = |weight| {
        let generation = HeatGeneration { fraction: 1.0, slave_weight: weight };
        let heat = frictional_heat(ShearStress(2.0), SlipRate(8.0), generation);
        (heat.slave, heat.master)
    };
    assert_eq!((one_side(1.0), one_side(0.0)), ((16.0, 0.0), (0.0, 16.0)));
    // Products whose partial results leave the range of f64.
    let tiny = HeatGeneration { fraction: 1e-300, slave_weight: 0.5 };
    let heat = frictional_heat(ShearStress(1e200), SlipRate(1e200), tiny);
    assert!((heat.total / 1e100 - 1.0).abs() < 1e-15 && (heat.slave / 5e99 - 1.0).abs() < 1e-15, "{heat:?}");
    let without_slip = frictional_heat(ShearStress(-0.0), SlipRate(1e308), HeatGeneration::default());
    assert!(without_slip.total == 0.0 && without_slip.total.is_sign_positive());
}

/// H-05: HFL = q_k + q_r − f q_g.
#[test]
fn h_05_signs() {
    let current = GeneratedHeat { total: 40.0, slave: 10.0, master: 30.0 };
    let friction = GeneratedHeat { total: 8.0, slave: 2.0, master: 6.0 };
    let heat = interface(625.0, 10.0, current, friction);
    assert_eq!(heat.leaving_slave().value(), 625.0 + 10.0 - 10.0 - 2.0);
    assert_eq!((heat.into_slave(), heat.into_master()), (-623.0, 671.0));
    let nothing = interface(0.0, 0.0, NO_HEAT, NO_HEAT);
    assert!(nothing.into_slave().is_sign_positive() && nothing.leaving_slave().value().is_sign_positive());
    // Partial sums beyond the range of f64.
    let current = GeneratedHeat { total: f64::MAX, slave: f64::MAX, master: 0.0 };
    let large = interface(f64::MAX, f64::MAX, current, NO_HEAT);
    assert_eq!((large.leaving_slave().value(), large.into_master()), (f64::MAX, f64::INFINITY));
    // And what leaves a small area is within it where what leaves a unit of area is not.
    let beyond = interface(f64::MAX, f64::MAX, NO_HEAT, NO_HEAT).leaving_slave();
    assert_eq!((beyond.value(), beyond.times(0.25)), (f64::INFINITY, f64::MAX / 2.0));
}

#[test]
fn what_is_not_finite() {
    assert!(conducted_heat(1.0, temperatures(f64::NAN, 0.0)).is_nan());
    assert!(conducted_heat(1.0, temperatures(f64::INFINITY, f64::INFINITY)).is_nan());
    assert_eq!(conducted_heat(1.0, temperatures(f64::INFINITY, 0.0)), f64::INFINITY);
    assert!(conducted_heat(0.0, temperatures(f64::INFINITY, 0.0)).is_nan());
    let none = conducted_heat(0.0, temperatures(1.0, 2.0));
    assert!(none == 0.0 && none.is_sign_positive(), "no heat is 0, not −0");
    // The difference alone exceeds the range.
    assert!((conducted_heat(1e-10, temperatures(1e308, -1e308)) / 2e298 - 1.0).abs() < 1e-15);
}

/// Any finite f64, subnormal numbers and both zeros included.
fn finite() -> impl Strategy<Value = f64> {
    any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |value| value.is_finite())
}

proptest! {
    #[test]
    fn conduction_is_right_wherever_it_is_finite(conductance in finite(), slave in finite(), master in finite()) {
        let heat = conducted_heat(conductance, temperatures(slave, master));
        if heat.is_finite() {
            prop_assert!(ulps_from(heat, &(exact(conductance) * (exact(slave) - exact(master)))) <= 1.5);
        }
    }

    /// Heat flows from the hotter to the colder side.
    #[test]
    fn heat_flows_downhill(conductance in 0.0..1e9_f64, slave in -300.0..3000.0_f64, master in -300.0..3000.0_f64) {
        let heat = conducted_heat(conductance, temperatures(slave, master));
        prop_assert!(heat == 0.0 || (heat > 0.0) == (slave > master));
    }

    /// H-09: both sides together take in what is generated, exactly judged from the rounded parts.
    #[test]
    fn both_sides_take_in_what_is_generated(
        conduction in -1e6..1e6_f64, radiation in -1e6..1e6_f64, conductance in 0.0..1e6_f64, jump in -10.0..10.0_f64,
        shear in 0.0..1e3_f64, slip in 0.0..1e3_f64, fraction in 0.0..2.0_f64, slave_weight in 0.0..=1.0_f64,
    ) {
        let generation = HeatGeneration { fraction, slave_weight };
        let current = generated_heat(conductance, PotentialJump(jump), Dissipation::Steady, generation);
        let friction = frictional_heat(ShearStress(shear), SlipRate(slip), generation);
        let heat = interface(conduction, radiation, current, friction);
        let generated = current.total + friction.total;
        let both = heat.into_slave() + heat.into_master();
        let largest = [conduction, radiation, current.total, friction.total].into_iter().map(f64::abs).fold(0.0, f64::max);
        prop_assert!((both - generated).abs() <= 8.0 * f64::EPSILON * largest, "{both} {generated}");
        prop_assert!(current.slave >= 0.0 && current.master >= 0.0 && friction.slave >= 0.0 && friction.master >= 0.0);
    }

    #[test]
    fn the_sum_of_heat_is_right(parts in prop::array::uniform4(finite())) {
        let [conduction, radiation, current, friction] = parts;
        let share = |slave| GeneratedHeat { total: slave, slave, master: slave };
        let heat = interface(conduction, radiation, share(current), share(friction));
        let exact_sum = exact(conduction) + exact(radiation) + exact(current) + exact(friction);
        let into_master = heat.into_master();
        if into_master.is_finite() {
            prop_assert!(ulps_from(into_master, &exact_sum) <= 1.0, "{into_master:?}");
        }
    }
}
