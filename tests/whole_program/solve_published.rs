//! Scenes of published verification problems (10.2 of the semantics): what the manual prints, and the exact values after it.
//!
//! A problem without printed numbers, or whose decks hold more than its text, is taken with the numbers that its text gives; the scenes say so.

use super::solve::{close, edited, prints, solve_edited, solve_json, solve_sample, solve_text, within};

#[test]
fn v_1_current_heat_and_face_between_two_plates() {
    let solved = solve_sample("plates", &[]);
    let row = |column: &str| solved.interfaces.number(&["face"], column);
    let current = row("ECD");
    close(current, 500.0 / 11.0);
    prints(current, "45.454545");
    // The dissipation of the current in the gap, of which half becomes heat.
    let dissipated = current * (solved.nodes.number(&["face"], "potential") - 50.0);
    close(dissipated, 25_000.0 / 121.0);
    prints(dissipated, "206.61157");
    close(row("SJD"), 12_500.0 / 121.0);
    for side in ["heat_s", "heat_m"] {
        close(row(side), 6_250.0 / 121.0);
        prints(row(side), "51.652893");
    }
    let face = solved.nodes.number(&["face"], "temperature");
    close(face, 78_850.0 / 1_331.0);
    prints(face, "59.241172");
    close(solved.links.number(&["end", "face"], "heat"), 100.0 - 78_850.0 / 1_331.0);
    close(solved.links.number(&["end", "face"], "current"), 500.0 / 11.0);
}

/// The same problem with radiation across the gap: a root of the fourth degree, found here with Newton's method.
#[test]
fn v_1_with_radiation() {
    let solved = solve_edited("plates", &[("\"PLATES\"", "\"RADIATING-PLATES\"")], &[]);
    let emitted = 0.1714e-8 / (2.0 / 0.45167 - 1.0);
    assert_eq!(format!("{emitted:.4e}"), "5.0000e-10");
    let opposite = (50.0_f64 + 460.0).powi(4);
    let surplus = |face: f64| 100.0 - face + 6_250.0 / 121.0 - emitted * ((face + 460.0).powi(4) - opposite);
    let mut face = 100.0;
    for _ in 0..50 {
        face += surplus(face) / (1.0 + 4.0 * emitted * (face + 460.0).powi(3));
    }
    assert!(surplus(face).abs() < 1e-12);
    within(solved.nodes.number(&["face"], "temperature"), face, 1e-10);
    close(solved.interfaces.number(&["face"], "ECD"), 500.0 / 11.0);
}

#[test]
fn two_bodies_with_a_gap_between_them() {
    let solved = solve_sample("two-bodies", &[]);
    let row = |column: &str| solved.interfaces.number(&["left-face"], column);
    close(row("ECD"), 50.0 / 2.1);
    close(row("ECD"), 500.0 / 21.0);
    close(row("SJD"), 12_500.0 / 441.0);
    let node = |name: &str, field: &str| solved.nodes.number(&[name], field);
    close(node("left-face", "potential"), 1_600.0 / 21.0);
    close(node("right-face", "potential"), 1_550.0 / 21.0);
    // 75 in the middle, 6250/441 of the heat of either side, 25/21 of the heat that is conducted.
    close(node("left-face", "temperature"), 75.0 + 6_775.0 / 441.0);
    close(node("right-face", "temperature"), 75.0 + 5_725.0 / 441.0);
    for link in [["left-end", "left-face"], ["right-face", "right-end"]] {
        close(solved.links.number(&link, "current"), 500.0 / 21.0);
    }
    close(solved.links.number(&["left-end", "left-face"], "heat"), 25.0 - 6_775.0 / 441.0);
    close(solved.links.number(&["right-face", "right-end"], "heat"), 25.0 + 5_725.0 / 441.0);
}

/// The plate of 1.7.3 with heat alone is 1.7.1.
#[test]
fn v_3_heat_alone() {
    let no_current =
        [("potential = { fixed = 100.0 }\n", ""), ("potential = { fixed = 50.0 }\n", ""), ("electrical = 1.0\n", "")];
    let solved = solve_edited("plates", &no_current, &[]);
    let flux = solved.interfaces.number(&["face"], "HFL");
    close(flux, 500.0 / 11.0);
    prints(flux, "45.4545");
    let face = solved.nodes.number(&["face"], "temperature");
    close(face, 600.0 / 11.0);
    prints(face, "54.5455");
    assert_eq!(solved.nodes.cells(&["face"], "potential"), [""]);
}

#[test]
fn v_4_a_conductance_by_field_variable_on_four_nodes() {
    let solved = solve_sample("four-nodes", &[]);
    for node in ["1", "2", "3", "4"] {
        let row = ["thermal_conductance", "HFL", "HFLA"].map(|column| solved.interfaces.number(&[node], column));
        assert_eq!(row, [12.5, 625.0, 156.25]);
    }
}

#[test]
fn v_4_what_is_held_supplies_what_flows() {
    let folder = edited("four-nodes", &[]);
    let (document, _) = solve_json(&folder, &[]);
    let supplies = &document["balance"]["temperature"]["supplies"];
    let of = |node: &str| supplies[node].as_f64();
    assert_eq!([of("1"), of("2"), of("3"), of("4"), of("cold")], [156.25, 156.25, 156.25, 156.25, -625.0].map(Some));
}

#[test]
fn v_5_twice_the_pressure_and_four_times_the_jumps() {
    let solved = solve_sample("pressed", &[]);
    for field in ["temperature", "potential"] {
        let [left, right] = ["left-face", "right-face"].map(|node| solved.nodes.course(&[node], field));
        let jumps: Vec<f64> = left.iter().zip(right).map(|(left, right)| left - right).collect();
        assert_eq!(jumps.len(), 2);
        close(jumps[0], 5.0);
        close(jumps[1], 20.0);
        close(jumps[1], 4.0 * jumps[0]);
    }
    assert_eq!(solved.interfaces.course(&["left-face"], "HFL"), [100.0, 100.0]);
    assert_eq!(solved.interfaces.course(&["left-face"], "ECD"), [1.0, 1.0]);
}

/// Steady states at both pressures are what the transient of the scene goes through.
#[test]
fn v_5_in_two_steady_states() {
    for (pressure, jump) in [("100.0", 5.0), ("200.0", 20.0)] {
        let steady = [
            ("procedure = \"transient\"\n", ""),
            ("[time]\nend = 1.0\nstep = 1.0\n", ""),
            ("[[0.0, 100.0], [1.0, 200.0]]", pressure),
        ];
        let solved = solve_edited("pressed", &steady, &[]);
        for field in ["temperature", "potential"] {
            let [left, right] = ["left-face", "right-face"].map(|node| solved.nodes.number(&[node], field));
            close(left - right, jump);
        }
    }
}

/// 1.6.8: half of the 120 that friction dissipates is taken up, and warms the bodies by 7.5: capacities of 8 together.
#[test]
fn v_6_heat_of_friction_warms_both_bodies() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*FRICTION\n0.1\n*GAP HEAT GENERATION\n0.5, 0.5\n";
    let scene = "procedure = \"transient\"\n[time]\nend = 2.0\nstep = 0.5\n\
                 [[node]]\nname = \"s\"\ntemperature = { capacity = 4.0, initial = 0.0 }\n\
                 [[node]]\nname = \"m\"\ntemperature = { capacity = 4.0, initial = 0.0 }\n\
                 [[interface]]\nslave = \"s\"\nmaster = \"m\"\narea = 2.0\nshear = 10.0\nslip_rate = 3.0\nclosed = true\n";
    let solved = solve_text(deck, scene, &[]);
    for node in ["s", "m"] {
        let course = solved.nodes.course(&[node], "temperature");
        assert_eq!(course.len(), 5);
        close(course[4], 7.5);
        close(course[2], 3.75);
    }
    // As in `eval`, what friction makes of heat is 0.5 of 10 times 3.
    close(solved.interfaces.last(&["s"], "SFDR"), 15.0);
}

/// An infinite permeability is no obstacle: both faces have one pore pressure, halfway between 2 and 1 where the blocks conduct alike, and at
/// (3 * 2 + 5 * 1) / 8 where they conduct as 3 to 5, as two axisymmetric elements of one width beside each other do.
#[test]
fn v_9_without_sliding() {
    let solved = solve_sample("seepage", &[]);
    for (case, pressure, flow) in [("plane", 1.5, 0.5e-4), ("axisymmetric", 1.375, 1.875e-4)] {
        let [high, slave, master, low] = ["high", "slave", "master", "low"].map(|end| format!("{case}-{end}"));
        for face in [&slave, &master] {
            close(solved.nodes.number(&[face], "pore_pressure"), pressure);
        }
        close(solved.links.number(&[&high, &slave], "fluid"), flow);
        close(solved.links.number(&[&master, &low], "fluid"), flow);
        close(solved.interfaces.number(&[&slave], "PFL"), flow);
        close(solved.interfaces.number(&[&slave], "q_across"), -flow);
    }
}

#[test]
fn v_10_a_closing_gap_presses_half_of_its_fluid_into_either_side() {
    let solved = solve_sample("closing-gap", &[]);
    for face in ["slave", "master"] {
        let pressures = solved.nodes.course(&[face], "pore_pressure");
        assert_eq!(pressures.len(), 5);
        pressures[1..].iter().for_each(|pressure| close(*pressure, 500.0));
    }
    for side in ["q_gap_s", "q_gap_m"] {
        solved.interfaces.course(&["slave"], side)[1..].iter().for_each(|flow| close(*flow, 0.05));
    }
    close(solved.interfaces.last(&["slave"], "PTL"), -0.05);
    // If nothing closes, the initial pore pressure stays, to the last bit.
    for face in ["still-slave", "still-master"] {
        assert_eq!(solved.nodes.course(&[face], "pore_pressure"), [50.0; 5]);
    }
    assert_eq!(solved.interfaces.course(&["still-slave"], "PFL"), [0.0; 5]);
}

/// A finite permeability does not change what is symmetric, and without bulk permeabilities the halves are halves.
#[test]
fn v_10_through_a_filter() {
    let filter = [("\"OPEN-JOINT\"", "\"FILTER\"")];
    let solved = solve_edited("closing-gap", &filter, &[]);
    for face in ["slave", "master"] {
        close(solved.nodes.last(&[face], "pore_pressure"), 500.0);
    }
}

/// Theory 5.2.2: with a finite permeability, here none, the gap's fluid goes by the permeabilities after the faces, 3 to 1.
#[test]
fn p_41_the_fluid_of_a_gap_goes_where_the_ground_takes_it() {
    let shares = [
        ("\"OPEN-JOINT\"\nslave = \"slave\"", "\"FILTER\"\nperm_s = 3.0e-4\nperm_m = 1.0e-4\nslave = \"slave\""),
        ("[\"slave-end\", \"slave\"]\nhydraulic = 1.0e-4", "[\"slave-end\", \"slave\"]\nhydraulic = 3.0e-4"),
    ];
    let solved = solve_edited("closing-gap", &shares, &[]);
    // 0.075 through 3e-4 and 0.025 through 1e-4: alike, so that the filter has nothing to do.
    for (face, flow, side) in [("slave", 0.075, "q_gap_s"), ("master", 0.025, "q_gap_m")] {
        close(solved.nodes.last(&[face], "pore_pressure"), 250.0);
        close(solved.interfaces.last(&["slave"], side), flow);
    }
    close(solved.interfaces.last(&["slave"], "PFL"), -0.075);
}

/// The interference case: where the gap opens at a tenth of the rate, it draws fluid and the pore pressure is -50.
#[test]
fn v_10_an_opening_gap_draws_fluid() {
    let opening = [("[[0.0, 0.1], [1.0, 0.0]]", "[[0.0, 0.0], [1.0, 0.01]]")];
    let solved = solve_edited("closing-gap", &opening, &[]);
    for face in ["slave", "master"] {
        close(solved.nodes.last(&[face], "pore_pressure"), -50.0);
    }
}

/// In a steady state nothing closes (P-13): the fluid of the gap is none.
#[test]
fn p_13_a_steady_state_knows_no_gap_filling() {
    let steady = [
        ("procedure = \"transient\"\n", ""),
        ("[time]\nend = 1.0\nstep = 0.25\n", ""),
        ("clearance = [[0.0, 0.1], [1.0, 0.0]]", "clearance = 0.1\nclearance_rate = -0.1"),
    ];
    let solved = solve_edited("closing-gap", &steady, &[]);
    assert_eq!(solved.nodes.number(&["slave"], "pore_pressure"), 0.0);
    assert_eq!(solved.interfaces.number(&["slave"], "q_gap_s"), 0.0);
}

/// Without *GAP HEAT GENERATION, with empty items and with its defaults written out, all energy becomes heat, in equal halves.
#[test]
fn k_37_defaults_of_heat_generation() {
    let law = "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n7., 0.\n7., 1.\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n2., 0.\n";
    let scene = "[[node]]\nname = \"s\"\npotential = { fixed = 5.0 }\n[[node]]\nname = \"m\"\npotential = { fixed = 1.0 }\n\
                 [[node]]\nname = \"room\"\ntemperature = { fixed = 20.0 }\n\
                 [[link]]\nnodes = [\"s\", \"room\"]\nthermal = 4.0\n[[link]]\nnodes = [\"m\", \"room\"]\nthermal = 4.0\n\
                 [[interface]]\nslave = \"s\"\nmaster = \"m\"\narea = 1.0\nclearance = 0.0\npressure = 0.0\n";
    // 2 * 4^2 = 32, 16 into each side, and 4 to the room.
    for option in
        ["", "*GAP HEAT GENERATION\n1., 0.5\n", "*GAP HEAT GENERATION\n1., \n", "*GAP HEAT GENERATION\n, 0.5\n"]
    {
        let solved = solve_text(&format!("{law}{option}"), scene, &[]);
        for node in ["s", "m"] {
            close(solved.nodes.number(&[node], "temperature"), 24.0);
        }
        assert_eq!(["SJD", "WEIGHT"].map(|column| solved.interfaces.number(&["s"], column)), [32.0, 0.5], "{option}");
    }
    // An item that is given, beside: a quarter of the heat, and three eighths of that into the slave.
    let solved = solve_text(&format!("{law}*GAP HEAT GENERATION\n0.25, 0.375\n"), scene, &[]);
    close(solved.interfaces.number(&["s"], "SJD"), 8.0);
    close(solved.interfaces.number(&["s"], "heat_s"), 3.0);
    close(solved.interfaces.number(&["s"], "heat_m"), 5.0);
}

/// Pore pressure on one side only: the interface is impermeable, and the other side is not touched.
#[test]
fn p_01_one_sided_pore_pressure_gives_no_flow() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n10., 0.\n10., 1.\n\
                *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=1., CUTOFF GAP FILL=1.\n";
    let scene = "[[node]]\nname = \"ground\"\npore_pressure = { fixed = 2.0 }\ntemperature = { fixed = 10.0 }\n\
                 [[node]]\nname = \"ground-face\"\n[[node]]\nname = \"wall-face\"\n\
                 [[node]]\nname = \"wall\"\ntemperature = { fixed = 22.0 }\n\
                 [[link]]\nnodes = [\"ground\", \"ground-face\"]\nhydraulic = 3.0\nthermal = 10.0\n\
                 [[link]]\nnodes = [\"wall-face\", \"wall\"]\nthermal = 10.0\n\
                 [[interface]]\nslave = \"ground-face\"\nmaster = \"wall-face\"\narea = 1.0\nclearance = 0.0\npressure = 0.0\n";
    let turned = scene
        .replace("slave = \"ground-face\"\nmaster = \"wall-face\"", "slave = \"wall-face\"\nmaster = \"ground-face\"");
    for scene in [scene, turned.as_str()] {
        for rows in ["", "1.E-3, 0.\n"] {
            let solved = solve_text(&format!("{deck}{rows}"), scene, &[]);
            let faces = ["ground-face", "wall-face"].map(|node| solved.nodes.cells(&[node], "pore_pressure")[0]);
            assert_eq!(faces, ["2", ""]);
            assert_eq!(solved.links.number(&["ground", "ground-face"], "fluid"), 0.0);
            // Heat goes its way as if no fluid were there.
            let faces = ["ground-face", "wall-face"].map(|node| solved.nodes.number(&[node], "temperature"));
            faces.into_iter().zip([14.0, 18.0]).for_each(|(found, exact)| close(found, exact));
        }
    }
}
