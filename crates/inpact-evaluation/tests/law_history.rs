//! Integrals over histories: backward Euler, first rows, areas, ten million increments.

mod table_judge;

use inpact_evaluation::history::{ElectricalHistory, FlowHistory, PoreHistory, ThermalHistory};
use inpact_evaluation::law::conductance::ConductanceTables;
use inpact_evaluation::law::contact::{
    Clearance, ClearanceRate, ContactPressure, ContactState, PorePressure, PotentialJump,
};
use inpact_evaluation::law::electrical::{Dissipation, ElectricalFlow, ElectricalLaw};
use inpact_evaluation::law::heat::{GeneratedHeat, HeatGeneration};
use inpact_evaluation::law::pore::{CutoffBoundary, Cutoffs, Gap, Permeability, PoreLaw, PorePoint};
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
        let increment = history.begin(time, jump);
        let dissipation = Dissipation::Transient { jump_at_start: increment.jump_at_start };
        history.finish(&increment, &law.flow(3.0, jump, dissipation), 0.0, area);
    }
    history
}

#[test]
fn first_row_has_no_integral_and_its_own_jump() {
    let mut history = ElectricalHistory::default();
    let increment = history.begin(7.0, PotentialJump(2.0));
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
        let increment = history.begin(f64::from(step) * duration, PotentialJump(1.0));
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
        let gap = Gap::Changing(increment.clearance_rate);
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
    assert_eq!((first.duration, first.clearance_rate), (None, ClearanceRate(0.0)));
    let second = history.begin(3.0, Clearance(0.25), None);
    assert_eq!((second.duration, second.clearance_rate), (Some(2.0), ClearanceRate(-0.125)));
    let given = history.begin(4.0, Clearance(0.25), Some(ClearanceRate(7.0)));
    assert_eq!(given.clearance_rate, ClearanceRate(7.0));
    let mut with_rate = PoreHistory::default();
    assert_eq!(with_rate.begin(0.0, Clearance(1.0), Some(ClearanceRate(-1.0))).clearance_rate, ClearanceRate(-1.0));
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

/// Beyond its cutoff the gap neither draws nor gives off fluid; a rate that is given does not change the volume.
#[test]
fn gap_filling_stops_at_its_cutoff() {
    let law = pore_law(Permeability::Finite(PiecewiseTable::constant(0.0)));
    let rows = [(0.0, 0.5), (1.0, 0.75), (2.0, 1.5), (3.0, 2.0)];
    assert_eq!(run_pore(&law, &rows, 1.0, None).volume(), Some(0.125));
    assert_eq!(run_pore(&law, &rows, 1.0, Some(ClearanceRate(99.0))).volume(), Some(0.125));
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
        history.leaving.add(time, leaving, Some(0.5));
        if let Some(friction) = friction {
            history.friction.add(time, friction, None);
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
        history.add(time(step), flow(step), None);
        if step > 0 {
            // The duration is rounded once; what it is multiplied by, and the sum, are exact here.
            sum += exact(flow(step)) * exact(time(step) - time(step - 1));
        }
    }
    assert!(ulps_from(history.per_area(), &sum) <= 0.500_001);
}
