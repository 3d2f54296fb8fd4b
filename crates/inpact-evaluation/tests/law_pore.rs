//! The pore fluid law by the numbered rules: flow across, gap filling, cutoffs, signs.

use inpact_evaluation::law::{
    BulkPermeabilities, Clearance, ClearanceRate, ContactPressure, ContactState, CutoffBoundary, Cutoffs, Flow, Gap,
    Permeability, PoreFlow, PoreLaw, PorePoint, PorePressure, across_slopes,
};
use inpact_evaluation::numbers::Amount;
use inpact_evaluation::table::{PiecewiseTable, Tail};

fn law(permeability: Permeability) -> PoreLaw {
    PoreLaw { permeability, cutoffs: Cutoffs::default(), boundary: CutoffBoundary::Inclusive }
}

fn constant(permeability: f64) -> Permeability {
    Permeability::Finite(PiecewiseTable::constant(permeability))
}

/// Rows 1 at p = 0 and 3 at p = 10 of A-24.
fn a_24_table() -> Permeability {
    Permeability::Finite(PiecewiseTable::from_rows(&[1.0, 0.0, 3.0, 10.0], 2, Tail::Constant).unwrap())
}

/// A closed interface in steady state with pore pressures of slave and master.
fn point(slave: f64, master: f64) -> PorePoint<'static> {
    PorePoint {
        clearance: Clearance(0.0),
        pressure: ContactPressure(0.0),
        state: ContactState::Closed,
        slave: PorePressure(slave),
        master: PorePressure(master),
        jump: None,
        variables: &[],
        characteristic_length: None,
        bulk: None,
        gap: Gap::Steady,
        multiplier: None,
    }
}

fn open(clearance: f64, point: PorePoint<'static>) -> PorePoint<'static> {
    PorePoint { clearance: Clearance(clearance), state: ContactState::Open, ..point }
}

fn changing(rate: f64, point: PorePoint<'static>) -> PorePoint<'static> {
    PorePoint { gap: Gap::Changing(ClearanceRate(rate)), ..point }
}

/// Within every cutoff of these tests, and not closed, so that a rate that closes it fills something.
fn slightly_open(point: PorePoint<'static>) -> PorePoint<'static> {
    PorePoint { clearance: Clearance(1e-3), ..point }
}

fn gap(flow: &PoreFlow) -> (Option<f64>, Option<f64>) {
    (flow.q_gap_slave(), flow.q_gap_master())
}

#[test]
fn a_22_finite_permeability() {
    let flow = law(constant(1e-3)).flow(&changing(0.0, point(10.0, 30.0)));
    assert_eq!(flow.q_across(), Some(0.02));
    assert_eq!((flow.into_slave(), flow.into_master()), (Some(0.02), Some(-0.02)));
    assert_eq!(flow.leaving_slave().map(Amount::value), Some(-0.02));
    assert_eq!(flow.permeability, Some(1e-3));
    assert!(!flow.is_constrained);
}

#[test]
fn a_23_gap_filling_under_infinite_permeability() {
    let closing = slightly_open(changing(-2e-3, PorePoint { characteristic_length: Some(1.0), ..point(5.0, 5.0) }));
    let with_multiplier = PorePoint { multiplier: Some(0.0), ..closing };
    let flow = law(Permeability::Infinite).flow(&with_multiplier);
    assert_eq!(gap(&flow), (Some(1e-3), Some(1e-3)));
    assert_eq!(flow.leaving_slave().map(Amount::value), Some(-1e-3));
    assert!(flow.is_constrained);
    // Steady state: nothing fills.
    let steady = PorePoint { gap: Gap::Steady, ..with_multiplier };
    assert_eq!(gap(&law(Permeability::Infinite).flow(&steady)), (Some(0.0), Some(0.0)));
    // q_across is an unknown of the equations, and so is all that holds it; gap filling is not.
    let flow = law(Permeability::Infinite).flow(&closing);
    assert_eq!(gap(&flow), (Some(1e-3), Some(1e-3)));
    assert_eq!(
        (flow.q_across(), flow.into_slave(), flow.into_master(), flow.leaving_slave().map(Amount::value)),
        (None, None, None, None)
    );
    assert_eq!(flow.permeability, None);
    // Bulk permeabilities do not change the half and half of infinite permeability (P-40).
    let with_bulk = PorePoint { bulk: Some(BulkPermeabilities { slave: 3.0, master: 1.0 }), ..closing };
    assert_eq!(gap(&law(Permeability::Infinite).flow(&with_bulk)), (Some(1e-3), Some(1e-3)));
}

#[test]
fn a_23_gap_filling_follows_the_bulk_permeabilities() {
    let bulk = Some(BulkPermeabilities { slave: 3.0, master: 1.0 });
    let near = PorePoint { bulk, characteristic_length: Some(1.0), ..point(5.0, 5.0) };
    let closing = slightly_open(changing(-2e-3, near));
    let flow = law(constant(1e-3)).flow(&closing);
    assert_eq!(gap(&flow), (Some(1.5e-3), Some(5e-4)));
    assert_eq!(flow.slave_share, 0.75);
    assert_eq!(flow.into_slave(), Some(1.5e-3));
    let unknown = PorePoint { bulk: None, ..closing };
    assert_eq!(gap(&law(constant(1e-3)).flow(&unknown)), (Some(1e-3), Some(1e-3)));
    let both_zero = PorePoint { bulk: Some(BulkPermeabilities { slave: 0.0, master: 0.0 }), ..closing };
    assert_eq!(gap(&law(constant(1e-3)).flow(&both_zero)), (Some(1e-3), Some(1e-3)));
}

/// P-12: what fills the gap is what the gap gives off.
#[test]
fn p_12_both_shares_make_up_the_rate() {
    for (slave, master) in [(1.0, 3.0), (1e308, 1e308), (1e-320, 3e-320), (2.0, 0.0)] {
        let opening = PorePoint { bulk: Some(BulkPermeabilities { slave, master }), ..changing(0.5, point(7.0, 3.0)) };
        let flow = law(constant(0.25)).flow(&opening);
        let sum = flow.into_slave().unwrap() + flow.into_master().unwrap();
        assert!((sum + 0.5).abs() <= 1e-15, "{sum}");
    }
}

#[test]
fn a_24_cutoff_of_flow_across() {
    let with_cutoff =
        |cutoff| PoreLaw { cutoffs: Cutoffs { flow_across: cutoff, gap_fill: None }, ..law(a_24_table()) };
    let apart = open(0.5, point(10.0, 30.0));
    let beyond = with_cutoff(Some(0.4)).flow(&apart);
    assert_eq!((beyond.across, beyond.q_across(), beyond.permeability), (Flow::CutOff, Some(0.0), Some(0.0)));
    let at = with_cutoff(Some(0.5)).flow(&apart);
    assert_eq!((at.across, at.q_across(), at.permeability), (Flow::Active, Some(20.0), Some(1.0)));
    let unknown = with_cutoff(None).flow(&apart);
    assert_eq!(
        (unknown.across, unknown.q_across(), unknown.permeability),
        (Flow::NeedsCharacteristicLength, None, None)
    );
    assert_eq!(unknown.leaving_slave().map(Amount::value), None);
    // With a characteristic length, or closed, nothing is missing.
    let known = PorePoint { characteristic_length: Some(0.5), ..apart };
    assert_eq!(with_cutoff(None).flow(&known).q_across(), Some(20.0));
    assert_eq!(with_cutoff(None).flow(&point(10.0, 30.0)).q_across(), Some(20.0));
    // A cutoff given wins over the characteristic length.
    assert_eq!(with_cutoff(Some(0.4)).flow(&known).across, Flow::CutOff);
}

#[test]
fn q_4_the_boundary_of_a_cutoff() {
    let at = |boundary, clearance| {
        let law = PoreLaw {
            boundary,
            cutoffs: Cutoffs { flow_across: Some(0.5), gap_fill: Some(0.5) },
            ..law(constant(1.0))
        };
        let flow = law.flow(&open(clearance, changing(1.0, point(0.0, 1.0))));
        (flow.across, flow.gap_fill)
    };
    assert_eq!(at(CutoffBoundary::Inclusive, 0.5), (Flow::Active, Flow::Active));
    assert_eq!(at(CutoffBoundary::Inclusive, 0.5f64.next_up()), (Flow::CutOff, Flow::CutOff));
    assert_eq!(at(CutoffBoundary::Exclusive, 0.5), (Flow::CutOff, Flow::CutOff));
    assert_eq!(at(CutoffBoundary::Exclusive, 0.5f64.next_down()), (Flow::Active, Flow::Active));
}

/// P-22: a cutoff of zero confines the flow to the closed interface.
#[test]
fn p_22_a_cutoff_of_zero() {
    let law = PoreLaw { cutoffs: Cutoffs { flow_across: Some(0.0), gap_fill: Some(0.0) }, ..law(constant(1.0)) };
    assert_eq!(law.flow(&point(0.0, 1.0)).q_across(), Some(1.0));
    assert_eq!(law.flow(&open(1e-300, point(0.0, 1.0))).q_across(), Some(0.0));
}

/// overclosure presses nothing out, and a given rate at zero clearance counts only where it opens the gap.
#[test]
fn q_37_only_an_open_gap_is_filled() {
    let law = PoreLaw { cutoffs: Cutoffs { flow_across: Some(1.0), gap_fill: Some(0.5) }, ..law(constant(2.0)) };
    let given = |clearance, rate| gap(&law.flow(&open(clearance, changing(rate, point(1.0, 1.0)))));
    assert_eq!(given(-0.25, -1.0), (Some(0.0), Some(0.0)));
    assert_eq!(given(-0.25, 1.0), (Some(0.0), Some(0.0)));
    assert_eq!(given(0.0, -1.0), (Some(0.0), Some(0.0)));
    assert_eq!(given(0.0, 1.0), (Some(-0.5), Some(-0.5)));
    assert_eq!(given(0.5, -1.0), (Some(0.5), Some(0.5)));
    assert_eq!(given(0.5 + 1e-9, -1.0), (Some(0.0), Some(0.0)));
    let since = |start, end| {
        let gap_change = Gap::Since { clearance: Clearance(start), duration: 2.0 };
        gap(&law.flow(&open(end, PorePoint { gap: gap_change, ..point(1.0, 1.0) })))
    };
    assert_eq!(since(0.5, 0.25), (Some(0.0625), Some(0.0625)));
    assert_eq!(since(9.0, 0.25), (Some(0.0625), Some(0.0625)));
    assert_eq!(since(0.25, 9.0), (Some(-0.0625), Some(-0.0625)));
    assert_eq!(since(0.25, -9.0), (Some(0.0625), Some(0.0625)));
    assert_eq!(since(0.75, 9.0), (Some(0.0), Some(0.0)));
}

/// whether the gap fills over an increment depends on a cutoff that is not known only where its width changes.
#[test]
fn q_5_the_characteristic_length_decides_where_a_width_changes() {
    let law = PoreLaw { cutoffs: Cutoffs { flow_across: Some(1.0), gap_fill: None }, ..law(constant(2.0)) };
    let since = |start, end| {
        let gap_change = Gap::Since { clearance: Clearance(start), duration: 1.0 };
        law.flow(&open(end, PorePoint { gap: gap_change, ..point(1.0, 1.0) })).gap_fill
    };
    assert_eq!(since(0.5, 0.5), Flow::Active);
    assert_eq!(since(-0.5, -1.0), Flow::Active);
    assert_eq!(since(0.5, 0.0), Flow::NeedsCharacteristicLength);
    assert_eq!(since(-0.5, 0.5), Flow::NeedsCharacteristicLength);
}

#[test]
fn a_25_cutoffs_are_independent() {
    let law = PoreLaw { cutoffs: Cutoffs { flow_across: Some(1.0), gap_fill: Some(0.1) }, ..law(constant(2.0)) };
    let flow = law.flow(&open(0.5, changing(-1.0, point(1.0, 4.0))));
    assert_eq!((flow.across, flow.gap_fill), (Flow::Active, Flow::CutOff));
    assert_eq!(gap(&flow), (Some(0.0), Some(0.0)));
    assert_eq!(flow.q_across(), Some(6.0));
}

/// the characteristic length is asked for only where it decides.
#[test]
fn q_5_the_characteristic_length_is_needed_where_it_matters() {
    let law = PoreLaw { cutoffs: Cutoffs { flow_across: Some(1.0), gap_fill: None }, ..law(constant(2.0)) };
    let gap_fill = |point: &PorePoint<'_>| law.flow(point).gap_fill;
    let apart = open(0.5, point(1.0, 4.0));
    assert_eq!(gap_fill(&changing(-1.0, apart)), Flow::NeedsCharacteristicLength);
    assert_eq!(law.flow(&changing(-1.0, apart)).q_gap_slave(), None);
    assert_eq!(gap_fill(&changing(0.0, apart)), Flow::Active);
    assert_eq!(gap_fill(&apart), Flow::Active);
    assert_eq!(gap_fill(&changing(-1.0, point(1.0, 4.0))), Flow::Active);
}

/// P-34: while open the permeability is that of no contact pressure, whatever the pressure column holds.
#[test]
fn p_34_open_means_no_contact_pressure() {
    let law = PoreLaw { cutoffs: Cutoffs { flow_across: Some(1.0), gap_fill: None }, ..law(a_24_table()) };
    let pressed = PorePoint { pressure: ContactPressure(5.0), ..point(0.0, 1.0) };
    assert_eq!(law.flow(&pressed).permeability, Some(2.0));
    assert_eq!(law.flow(&open(0.5, pressed)).permeability, Some(1.0));
    assert_eq!(law.permeability_slopes(&pressed, &mut []), 0.2);
    assert_eq!(law.permeability_slopes(&open(0.5, pressed), &mut []), 0.0);
    let far = PorePoint { pressure: ContactPressure(50.0), ..pressed };
    assert!(law.flow(&far).sides.is_above(0));
}

/// Beyond its cutoff an infinite permeability holds nothing: the flow is zero and known.
#[test]
fn an_infinite_permeability_ends_at_its_cutoff() {
    let apart = PorePoint { characteristic_length: Some(0.1), ..open(0.5, point(1.0, 4.0)) };
    let flow = law(Permeability::Infinite).flow(&apart);
    assert_eq!((flow.across, flow.q_across(), flow.is_constrained), (Flow::CutOff, Some(0.0), false));
    assert_eq!(flow.leaving_slave().map(Amount::value), Some(0.0));
}

/// Permeability against contact pressure, mean pore pressure and temperature, in the order of T-03.
#[test]
fn p_32_variables_and_slopes() {
    let mut cells = Vec::new();
    for temperature in [300.0, 400.0] {
        for pore in [0.0, 10.0] {
            for pressure in [0.0, 2.0] {
                cells.extend([1.0 + pressure + 0.5 * pore + 0.01 * (temperature - 300.0), pressure, pore, temperature]);
            }
        }
    }
    let law = law(Permeability::Finite(PiecewiseTable::from_rows(&cells, 4, Tail::Constant).unwrap()));
    let point = PorePoint { pressure: ContactPressure(1.0), variables: &[5.0, 350.0], ..point(4.0, 6.0) };
    assert_eq!(law.flow(&point).permeability, Some(5.0));
    let mut slopes = [0.0; 2];
    assert_eq!(law.permeability_slopes(&point, &mut slopes), 1.0);
    assert_eq!(slopes, [0.5, 0.01]);
    // Section 8: d q_across by either pore pressure, through k and through the mean pore pressure.
    assert_eq!(across_slopes(5.0, slopes[0], point.slave, point.master), (-4.5, 5.5));
}

#[test]
fn nan_stays_nan_and_extremes_stay_finite() {
    let nan_clearance = PorePoint { clearance: Clearance(f64::NAN), ..point(1.0, 2.0) };
    assert!(law(constant(1.0)).flow(&nan_clearance).q_across().unwrap().is_nan());
    assert!(law(constant(1.0)).flow(&point(f64::NAN, 2.0)).q_across().unwrap().is_nan());
    let undetermined = PorePoint { state: ContactState::Undetermined, ..point(1.0, 2.0) };
    assert!(law(a_24_table()).flow(&undetermined).q_across().unwrap().is_nan());
    // The pressure difference overflows, the flow does not.
    assert_eq!(law(constant(0.25)).flow(&point(-1.5e308, 1.5e308)).q_across(), Some(7.5e307));
}
