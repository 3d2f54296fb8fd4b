//! Radiation by the numbered rules, and against exact rationals from the smallest to the largest temperatures.

mod table_judge;

use inpact_evaluation::law::{
    Clearance, ContactState, Emissivities, RadiationCoefficient, RadiationLaw, Temperatures, radiated_heat,
};
use inpact_evaluation::table::{PiecewiseTable, Tail};
use num_rational::BigRational;
use num_traits::{One, Pow, Zero};
use proptest::prelude::*;
use table_judge::{exact, ulps_from};

const CLOSED: ContactState = ContactState::Closed;
const OPEN: ContactState = ContactState::Open;

fn coefficient(stefan_boltzmann: f64, slave: f64, master: f64) -> Option<f64> {
    RadiationCoefficient::new(stefan_boltzmann, Emissivities { slave, master }).map(|coefficient| coefficient.0)
}

fn temperatures(slave: f64, master: f64) -> Temperatures {
    Temperatures::of(slave, master)
}

/// C (a⁴ − b⁴) F of the rounded inputs, without an error.
fn exact_heat(coefficient: f64, view_factor: f64, absolute_zero: f64, sides: Temperatures) -> BigRational {
    let power = |temperature: f64| (exact(temperature) - exact(absolute_zero)).pow(4_i32);
    exact(coefficient) * exact(view_factor) * (power(sides.slave) - power(sides.master))
}

/// A view factor of 1 in contact, half at 0.1, zero beyond.
fn law() -> RadiationLaw {
    let rows = [[1.0, 0.0], [0.5, 0.1]];
    RadiationLaw {
        coefficient: RadiationCoefficient(5e-10),
        absolute_zero: -273.15,
        view_factor: PiecewiseTable::from_rows(rows.as_flattened(), 2, Tail::Zero).unwrap(),
    }
}

/// A-30, V-8: the constants of the verification decks.
#[test]
fn a_30_coefficients() {
    let near = |found: Option<f64>, expected: f64, digits: f64| {
        assert!((found.unwrap() / expected - 1.0).abs() < digits, "{found:?} {expected}");
    };
    near(coefficient(0.1714e-8, 0.45167, 0.45167), 5.0e-10, 2e-5);
    near(coefficient(5.67e-8, 0.034_664, 0.034_664), 1.00006e-9, 1e-5);
    near(coefficient(1.7, 0.740_740_740_740_740_7, 0.740_740_740_740_740_7), 1.0, 1e-15);
    // K-40: symmetric. Black bodies: σ itself. A surface that does not radiate: nothing.
    assert_eq!(coefficient(5.67e-8, 0.8, 0.3), coefficient(5.67e-8, 0.3, 0.8));
    assert_eq!(coefficient(5.67e-8, 1.0, 1.0), Some(5.67e-8));
    assert_eq!(coefficient(5.67e-8, 0.0, 0.5), Some(0.0));
    for impossible in [1.5, -0.1, f64::NAN, f64::INFINITY] {
        assert_eq!(coefficient(5.67e-8, impossible, 0.5), None);
        assert_eq!(coefficient(5.67e-8, 0.5, impossible), None);
    }
    assert_eq!(coefficient(f64::NAN, 0.5, 0.5), None);
}

/// T-27, K-41: kept in contact, overclosure as zero clearance, zero immediately beyond the last point.
#[test]
fn t_27_view_factor() {
    let factor = |clearance, state| law().view_factor(Clearance(clearance), state).0;
    assert_eq!(factor(0.0, CLOSED), 1.0);
    assert_eq!(factor(-0.5, CLOSED), 1.0);
    assert_eq!(factor(f64::NAN, CLOSED), 1.0);
    assert_eq!(factor(0.05, OPEN), 0.75);
    assert_eq!(factor(0.05, CLOSED), 1.0, "closed by a flag or a pressure at a clearance (Q-36)");
    assert_eq!(factor(0.1, OPEN), 0.5);
    assert_eq!(factor(0.1f64.next_up(), OPEN), 0.0);
    assert!(law().view_factor(Clearance(0.2), OPEN).1.is_above(0));
    assert!(law().view_factor(Clearance(-0.5), CLOSED).1.is_within());
    assert!(factor(f64::NAN, OPEN).is_nan());
    assert!(factor(0.0, ContactState::Undetermined).is_nan());
}

#[test]
fn h_06_heat_from_the_hotter_to_the_colder() {
    let law = law();
    let heat = |slave, master| law.heat(0.5, temperatures(slave, master));
    let expected = 5e-10 * 0.5 * (373.15_f64.powi(4) - 293.15_f64.powi(4));
    assert!((heat(100.0, 20.0) / expected - 1.0).abs() < 1e-14);
    assert_eq!(heat(100.0, 20.0), -heat(20.0, 100.0));
    assert_eq!(heat(100.0, 100.0), 0.0);
    assert!(heat(20.0, 20.0).is_sign_positive());
    assert!(law.heat(0.0, temperatures(20.0, 100.0)).is_sign_positive());
    // At nearly equal temperatures the plain difference of powers has no digits left.
    let (slave, master) = (26.850_000_000_000_1, 26.85);
    let judged = exact_heat(5e-10, 1.0, -273.15, temperatures(slave, master));
    assert!(ulps_from(law.heat(1.0, temperatures(slave, master)), &judged) <= 6.0);
}

/// Section 8: the slopes against differences of the heat.
#[test]
fn slopes_are_those_of_the_heat() {
    let law = law();
    let (slave, master, step) = (400.0, 120.0, 1e-3);
    let heat = |slave, master| law.heat(0.75, temperatures(slave, master));
    let slopes = law.heat_slopes(0.75, temperatures(slave, master));
    let by_slave = (heat(slave + step, master) - heat(slave - step, master)) / (2.0 * step);
    let by_master = (heat(slave, master + step) - heat(slave, master - step)) / (2.0 * step);
    assert!((slopes.slave / by_slave - 1.0).abs() < 1e-8, "{slopes:?} {by_slave}");
    assert!((slopes.master / by_master - 1.0).abs() < 1e-8, "{slopes:?} {by_master}");
}

/// From the smallest numbers to those whose fourth power is near the end of the range, and to the end itself with a small coefficient.
#[test]
fn the_extremes() {
    let cases = [
        (5.67e-8, 1.0, 0.0, 1e-300, 0.0),
        (1e308, 1.0, 0.0, 1e-100, 0.0),
        (1.0, 1.0, 0.0, 1e-75, 2e-75),
        (1.0, 1.0, 0.0, 1e77, 9e76),
        (5.67e-8, 0.3, -273.15, 1e75, 300.0),
        (1e-300, 1e-300, 0.0, 1e200, 3.0),
        (1e-308, 1e-308, -1e150, 1e153, 1e-300),
        (4e-324, 1.0, 0.0, 1e100, 1.0),
        (1.0, 1.0, -273.15, 1e-310, 0.0),
        (1e-250, 1e-250, -1e20, 1e-160, 0.0),
    ];
    for (coefficient, view_factor, absolute_zero, slave, master) in cases {
        let sides = temperatures(slave, master);
        let heat = radiated_heat(RadiationCoefficient(coefficient), view_factor, absolute_zero, sides);
        let judged = exact_heat(coefficient, view_factor, absolute_zero, sides);
        assert!(heat.is_finite() && ulps_from(heat, &judged) <= 6.0, "{sides:?}: {heat:?}");
    }
    let heat = |slave, master| radiated_heat(RadiationCoefficient(1.0), 1.0, 0.0, temperatures(slave, master));
    assert_eq!(heat(1e300, 0.0), f64::INFINITY);
    assert_eq!(heat(0.0, 1e300), f64::NEG_INFINITY);
    assert_eq!(heat(1e300, 1e300), 0.0);
    assert_eq!(heat(f64::INFINITY, 0.0), f64::INFINITY);
    assert!(heat(f64::INFINITY, f64::INFINITY).is_nan() && heat(f64::NAN, 0.0).is_nan());
}

/// A magnitude anywhere between two powers of ten.
fn over_decades(least: f64, greatest: f64) -> impl Strategy<Value = f64> {
    (least..greatest).prop_map(|power| 10.0_f64.powf(power))
}

proptest! {
    #[test]
    fn heat_is_right_over_all_decades(
        coefficient in over_decades(-300.0, 300.0), view_factor in 0.0..=1.0_f64,
        slave in over_decades(-300.0, 75.0), master in over_decades(-300.0, 75.0),
        absolute_zero in prop_oneof![Just(0.0), Just(-273.15), Just(-459.67)],
    ) {
        let sides = temperatures(slave, master);
        let heat = radiated_heat(RadiationCoefficient(coefficient), view_factor, absolute_zero, sides);
        if heat.is_finite() {
            let judged = exact_heat(coefficient, view_factor, absolute_zero, sides);
            prop_assert!(ulps_from(heat, &judged) <= 6.0, "{heat:?}");
        }
        prop_assert!(heat == 0.0 || (heat > 0.0) == (slave > master));
    }

    #[test]
    fn heat_is_right_between_nearby_temperatures(master in -273.0..3000.0_f64, steps in -1000..1000_i64) {
        let slave = f64::from_bits((master.to_bits().cast_signed() + steps).cast_unsigned());
        prop_assume!(slave.is_finite() && slave >= -273.15);
        let sides = temperatures(slave, master);
        let heat = radiated_heat(RadiationCoefficient(5.67e-8), 0.9, -273.15, sides);
        prop_assert!(ulps_from(heat, &exact_heat(5.67e-8, 0.9, -273.15, sides)) <= 6.0);
    }

    #[test]
    fn coefficients_are_right(slave in over_decades(-320.0, 0.0), master in over_decades(-320.0, 0.0)) {
        let (slave, master) = (slave.min(1.0), master.min(1.0));
        let found = coefficient(5.67e-8, slave, master).unwrap();
        let judged = if slave == 0.0 || master == 0.0 {
            BigRational::zero()
        } else {
            let inverse = |emissivity| BigRational::one() / exact(emissivity);
            exact(5.67e-8) / (inverse(slave) + inverse(master) - BigRational::one())
        };
        prop_assert!(ulps_from(found, &judged) <= 0.500_001);
        prop_assert!(found <= 5.67e-8);
    }
}
