//! Integrals over histories: backward Euler, first rows, areas, ten million increments.

mod table_judge;

use inpact_evaluation::HistoryStart;
use inpact_evaluation::law::{
    Clearance, ClearanceRate, ClosingHeat, ConductanceTables, ContactPressure, ContactState, CutoffBoundary, Cutoffs,
    Dissipation, ElectricalFlow, ElectricalHistory, ElectricalLaw, FlowHistory, Gap, GeneratedHeat, HeatGeneration,
    Permeability, PoreHistory, PoreLaw, PorePoint, PorePressure, PotentialJump, ThermalHistory,
};
use inpact_evaluation::numbers::{Amount, Scaled};
use inpact_evaluation::table::PiecewiseTable;
use table_judge::{exact, ulps_from};

fn electrical_law() -> ElectricalLaw {
    ElectricalLaw {
        conductance: ConductanceTables::Clearance(PiecewiseTable::constant(3.0)),
        heat_generation: HeatGeneration::default(),
    }
}

/// Runs rows of time, jump and area through a history.
fn run(rows: &[(f64, f64, Option<f64>)]) -> ElectricalHistory {
    let law = electrical_law();
    let mut history = ElectricalHistory::default();
    for &(time, jump, area) in rows {
        let jump = PotentialJump(jump);
        let increment = history.begin(time, jump, 3.0);
        let dissipation = Dissipation::Transient { jump_at_start: increment.jump_at_start };
        history.finish(&increment, &law.flow(3.0, jump, dissipation), 0.0, area);
    }
    history
}

#[test]
fn first_row_has_no_integral_and_its_own_jump() {
    let mut history = ElectricalHistory::default();
    let increment = history.begin(7.0, PotentialJump(2.0), 3.0);
    assert_eq!((increment.duration, increment.jump_at_start), (None, PotentialJump(2.0)));
    let history = run(&[(7.0, 2.0, Some(4.0))]);
    assert_eq!((history.current(), history.heat()), (0.0, 0.0));
    assert_eq!((history.current_of_area(), history.heat_of_area()), (Some(0.0), Some(0.0)));
}

/// O-5: flow at the end of the increment times its duration; the heat of A-21 is the mean over the increment.
#[test]
fn o_5_backward_euler() {
    let history = run(&[(0.0, 2.0, Some(2.0)), (0.5, 5.0, Some(2.0)), (2.5, 5.0, Some(4.0))]);
    assert_eq!(history.current(), 15.0 * 0.5 + 15.0 * 2.0);
    assert_eq!(history.heat(), 39.0 * 0.5 + 75.0 * 2.0);
    assert_eq!(history.current_of_area(), Some(30.0 * 0.5 + 60.0 * 2.0));
    assert_eq!(history.heat_of_area(), Some(78.0 * 0.5 + 300.0 * 2.0));
}

#[test]
fn an_unknown_area_leaves_the_integrals_per_area() {
    let history = run(&[(0.0, 1.0, Some(1.0)), (1.0, 1.0, None), (2.0, 1.0, Some(1.0))]);
    assert_eq!(history.current(), 6.0);
    assert_eq!((history.current_of_area(), history.heat_of_area()), (None, None));
}

/// Ten million steps of a current that neither adds up in binary nor cancels.
#[test]
fn ten_million_increments_are_exact() {
    let steps = 10_000_000_u32;
    let (current_density, heat) = (0.1, 1e-3);
    let duration = 2f64.powi(-10);
    let flow = ElectricalFlow { current_density, heat: GeneratedHeat { total: heat, slave: 0.0, master: 0.0 } };
    let mut history = ElectricalHistory::default();
    for step in 0..=steps {
        let increment = history.begin(f64::from(step) * duration, PotentialJump(1.0), 0.1);
        history.finish(&increment, &flow, 0.0, Some(0.3));
    }
    let time = exact(f64::from(steps) * duration);
    assert!(ulps_from(history.current(), &(exact(current_density) * &time)) <= 0.500_001);
    assert!(ulps_from(history.heat(), &(exact(heat) * &time)) <= 0.500_001);
    let with_area = exact(current_density) * exact(0.3) * time;
    assert!(ulps_from(history.current_of_area().unwrap(), &with_area) <= 2.0);
}

fn pore_law(permeability: Permeability) -> PoreLaw {
    PoreLaw {
        permeability,
        cutoffs: Cutoffs { flow_across: Some(10.0), gap_fill: Some(1.0) },
        boundary: CutoffBoundary::Inclusive,
    }
}

/// Runs rows of time and clearance through a history; pore pressures are 1 at the slave, `master` at the master.
fn run_pore(law: &PoreLaw, rows: &[(f64, f64)], master: f64, rate: Option<ClearanceRate>) -> PoreHistory {
    let mut history = PoreHistory::default();
    for &(time, clearance) in rows {
        let increment = history.begin(time, Clearance(clearance), rate);
        let gap = increment.gap;
        let point = PorePoint {
            clearance: Clearance(clearance),
            pressure: ContactPressure(0.0),
            state: ContactState::Open,
            slave: PorePressure(1.0),
            master: PorePressure(master),
            jump: None,
            variables: &[],
            characteristic_length: None,
            bulk: None,
            gap,
            multiplier: None,
        };
        history.finish(&increment, gap, &law.flow(&point), Some(2.0));
    }
    history
}

#[test]
fn clearance_rate_comes_from_the_history() {
    let mut history = PoreHistory::default();
    let first = history.begin(1.0, Clearance(0.5), None);
    assert_eq!((first.duration, first.gap), (None, Gap::Changing(ClearanceRate(0.0))));
    let second = history.begin(3.0, Clearance(0.25), None);
    assert_eq!((second.duration, second.gap), (Some(2.0), Gap::Since { clearance: Clearance(0.5), duration: 2.0 }));
    let given = history.begin(4.0, Clearance(0.25), Some(ClearanceRate(7.0)));
    assert_eq!((given.gap, given.contradicted), (Gap::Changing(ClearanceRate(7.0)), Some(ClearanceRate(0.0))));
    let mut with_rate = PoreHistory::default();
    let first = with_rate.begin(0.0, Clearance(1.0), Some(ClearanceRate(-1.0)));
    assert_eq!((first.gap, first.contradicted), (Gap::Changing(ClearanceRate(-1.0)), None));
}

/// O-5, D021: a given rate contradicts the change of the clearance where they differ by more than 1 % of the larger.
#[test]
fn d_021_rates_that_differ_by_more_than_one_part_in_a_hundred() {
    let contradicted = |rate: f64| {
        let mut history = PoreHistory::default();
        history.begin(0.0, Clearance(1.0), None);
        history.begin(2.0, Clearance(0.0), Some(ClearanceRate(rate))).contradicted.is_some()
    };
    assert!([-0.5, -0.4951, -0.505].into_iter().all(|rate| !contradicted(rate)));
    assert!([-0.494, -0.506, 0.5, 0.0].into_iter().all(contradicted));
}

/// C-25: at rest there is no jump at the start; the first row ends an increment, and one at the start itself has none.
#[test]
fn c_25_histories_may_start_at_rest() {
    let start = HistoryStart::AtRest { time: 0.0 };
    let mut late = ElectricalHistory::new(start, ClosingHeat::Manual);
    let first = late.begin(0.5, PotentialJump(3.0), 2.0);
    assert_eq!((first.duration, first.jump_at_start, first.closes_circuit), (Some(0.5), PotentialJump(0.0), false));
    let mut at_start = ElectricalHistory::new(start, ClosingHeat::Manual);
    assert_eq!(at_start.begin(0.0, PotentialJump(3.0), 2.0).duration, None);
    let second = at_start.begin(0.5, PotentialJump(3.0), 2.0);
    assert_eq!((second.duration, second.jump_at_start), (Some(0.5), PotentialJump(0.0)));
    let third = at_start.begin(1.0, PotentialJump(3.0), 2.0);
    assert_eq!((third.duration, third.jump_at_start), (Some(0.5), PotentialJump(3.0)));
    let mut heat = FlowHistory::new(start);
    heat.add(0.5, Amount::new(4.0), Some(2.0));
    assert_eq!((heat.per_area(), heat.of_area()), (2.0, Some(4.0)));
    let mut pore = PoreHistory::new(start);
    let first = pore.begin(0.5, Clearance(0.25), None);
    assert_eq!(first.gap, Gap::Since { clearance: Clearance(0.25), duration: 0.5 });
}

/// where the increment closes the circuit, the manual takes the jump of the open one, and a balance that of its end.
#[test]
fn q_41_an_increment_that_closes_a_circuit() {
    let run = |closing| {
        let mut history = ElectricalHistory::new(HistoryStart::FirstRow, closing);
        history.begin(0.0, PotentialJump(10.0), 0.0);
        history.begin(1.0, PotentialJump(1e-3), 1e4)
    };
    let manual = run(ClosingHeat::Manual);
    assert_eq!((manual.jump_at_start, manual.closes_circuit), (PotentialJump(10.0), true));
    let balanced = run(ClosingHeat::Balanced);
    assert_eq!((balanced.jump_at_start, balanced.closes_circuit), (PotentialJump(1e-3), false));
}

/// PTL is what leaves the slave: the flow across against it, and half of what an opening gap draws.
#[test]
fn o_5_pore_volume() {
    let law = pore_law(Permeability::Finite(PiecewiseTable::constant(0.5)));
    let history = run_pore(&law, &[(0.0, 0.25), (1.0, 0.5), (3.0, 0.125)], 3.0, None);
    let across = -0.5 * (3.0 - 1.0) * 3.0;
    let gap = 0.5 * (0.125 - 0.25);
    assert_eq!(history.volume(), Some(across + gap));
    assert_eq!(history.volume_of_area(), Some(2.0 * (across + gap)));
}

/// O-5: gap filling adds up to -w Δd of the whole history exactly, however the steps round.
#[test]
fn gap_filling_telescopes() {
    let law = pore_law(Permeability::Finite(PiecewiseTable::constant(0.0)));
    let rows: Vec<(f64, f64)> =
        (0..=1_000_000).map(|step| (f64::from(step) * 0.1, 0.7 + 0.3 * (f64::from(step) * 0.37).sin())).collect();
    let history = run_pore(&law, &rows, 1.0, None);
    let change = (exact(rows[rows.len() - 1].1) - exact(rows[0].1)) / exact(2.0);
    assert!(ulps_from(history.volume().unwrap(), &change) <= 0.500_001);
}

/// the filled width is clamped to 0 and the cutoff, so that a closed cycle gives 0 and nothing comes of what lies beyond either.
#[test]
fn q_37_gap_filling_stops_at_zero_and_at_its_cutoff() {
    let law = pore_law(Permeability::Finite(PiecewiseTable::constant(0.0)));
    let opening = [(0.0, 0.5), (1.0, 0.75), (2.0, 1.5), (3.0, 2.0)];
    assert_eq!(run_pore(&law, &opening, 1.0, None).volume(), Some(0.5 * (1.0 - 0.5)));
    let cycle = [(0.0, 0.5), (1.0, 1.5), (2.0, 0.25), (3.0, -0.5), (4.0, -1.0), (5.0, 0.5)];
    assert_eq!(run_pore(&law, &cycle, 1.0, None).volume(), Some(0.0));
    assert_eq!(run_pore(&law, &cycle[..4], 1.0, None).volume(), Some(-0.25));
}

/// O-5: a given rate fills the gap for the whole increment, as PFL says, wherever there is a gap within the cutoff.
#[test]
fn o_5_a_given_rate_is_integrated_as_pfl() {
    let law = pore_law(Permeability::Finite(PiecewiseTable::constant(0.0)));
    let volume = |rows: &[(f64, f64)], rate| run_pore(&law, rows, 1.0, Some(ClearanceRate(rate))).volume();
    assert_eq!(volume(&[(0.0, 0.5), (1.0, 0.5), (3.0, 0.5)], -0.25), Some(0.5 * -0.25 * 3.0));
    // Beyond the cutoff of 1, and overclosed, nothing is filled.
    assert_eq!(volume(&[(0.0, 0.5), (1.0, 1.5), (2.0, -0.5)], 1.0), Some(0.0));
    assert_eq!(volume(&[(0.0, 0.0), (1.0, 0.0)], 1.0), Some(0.5));
    assert_eq!(volume(&[(0.0, 0.0), (1.0, 0.0)], -1.0), Some(0.0));
}

/// Under an infinite permeability the flow is unknown from the second row on; the first row has nothing to integrate.
#[test]
fn an_unknown_flow_has_no_integral() {
    let law = pore_law(Permeability::Infinite);
    assert_eq!(run_pore(&law, &[(0.0, 0.5)], 1.0, None).volume(), Some(0.0));
    let history = run_pore(&law, &[(0.0, 0.5), (1.0, 0.5)], 1.0, None);
    assert_eq!((history.volume(), history.volume_of_area()), (None, None));
}

/// HTL and SFDRT by backward Euler, each with increments of its own; the area of a row counts for the increment it ends.
#[test]
fn o_5_heat() {
    let mut history = ThermalHistory::default();
    for (time, leaving, friction) in [(1.0, 7.0, Some(3.0)), (2.0, 5.0, None), (4.0, -2.0, Some(8.0))] {
        history.leaving.add(time, Amount::new(leaving), Some(0.5));
        if let Some(friction) = friction {
            history.friction.add(time, Amount::new(friction), None);
        }
    }
    assert_eq!((history.leaving.per_area(), history.leaving.of_area()), (5.0 - 4.0, Some(0.5)));
    assert_eq!((history.friction.per_area(), history.friction.of_area()), (24.0, None));
}

/// Fifty thousand increments cost no digits.
#[test]
fn heat_over_many_increments() {
    let flow = |step: u32| 1e6 * (f64::from(step) * 0.37).sin() + 0.1;
    let time = |step: u32| f64::from(step) * 0.1;
    let mut history = FlowHistory::default();
    let mut sum = exact(0.0);
    for step in 0..=50_000_u32 {
        history.add(time(step), Amount::new(flow(step)), None);
        if step > 0 {
            // The duration is rounded once; what it is multiplied by, and the sum, are exact here.
            sum += exact(flow(step)) * exact(time(step) - time(step - 1));
        }
    }
    assert!(ulps_from(history.per_area(), &sum) <= 0.500_001);
}

/// An integral may lie within the range of f64 where the flow, or its product with area or time, does not.
#[test]
fn products_leave_the_range_on_their_way() {
    let flow = Amount::exactly(Scaled::new(1e200) * Scaled::new(1e150));
    assert_eq!(flow.value(), f64::INFINITY);
    let mut history = FlowHistory::default();
    history.add(0.0, flow, Some(1e-300));
    history.add(1e-100, flow, Some(1e-300));
    assert!(ulps_from(history.per_area(), &(exact(1e200) * exact(1e150) * exact(1e-100))) <= 1.0);
    let whole = exact(1e200) * exact(1e150) * exact(1e-100) * exact(1e-300);
    assert!(ulps_from(history.of_area().unwrap(), &whole) <= 1.0);
    let mut history = FlowHistory::default();
    history.add(0.0, Amount::new(1e200), Some(1e200));
    history.add(1e-200, Amount::new(1e200), Some(1e200));
    assert!(ulps_from(history.of_area().unwrap(), &(exact(1e200) * exact(1e200) * exact(1e-200))) <= 1.0);
}
