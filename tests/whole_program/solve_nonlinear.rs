//! `inpact solve` where conductances depend on what is solved for: exact answers, at knots and elsewhere.

use super::solve::{close, prints, solve_text, within};

/// A thermal chain: two held ends, a body to either side of an interface with this law.
fn chain(law: &str, ends: [f64; 2], bodies: [f64; 2], initial: Option<f64>) -> [f64; 2] {
    let deck = format!("*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n{law}");
    let initial = initial.map_or(String::new(), |initial| format!("[initial]\ntemperature = {initial:?}\n"));
    let scene = format!(
        "{initial}[[node]]\nname = \"hot\"\ntemperature = {{ fixed = {:?} }}\n[[node]]\nname = \"s\"\n[[node]]\nname = \"m\"\n\
         [[node]]\nname = \"cold\"\ntemperature = {{ fixed = {:?} }}\n\
         [[link]]\nnodes = [\"hot\", \"s\"]\nthermal = {:?}\n[[link]]\nnodes = [\"m\", \"cold\"]\nthermal = {:?}\n\
         [[interface]]\nslave = \"s\"\nmaster = \"m\"\narea = 1.0\nclearance = 0.0\npressure = 0.0\n",
        ends[0], ends[1], bodies[0], bodies[1]
    );
    let solved = solve_text(&deck, &scene, &[]);
    ["s", "m"].map(|node| solved.nodes.number(&[node], "temperature"))
}

/// A joint that a current heats, in a room at 20: its potentials, and the room's links.
fn heated(law: &str, slave: &str, room: f64, initial: Option<f64>) -> [f64; 2] {
    let deck = format!("*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n{law}");
    let initial = initial.map_or(String::new(), |initial| format!("[initial]\ntemperature = {initial:?}\n"));
    let scene = format!(
        "{initial}[[node]]\nname = \"s\"\npotential = {{ {slave} }}\n[[node]]\nname = \"m\"\npotential = {{ fixed = 0.0 }}\n\
         [[node]]\nname = \"room\"\ntemperature = {{ fixed = 20.0 }}\n\
         [[link]]\nnodes = [\"s\", \"room\"]\nthermal = {room:?}\n[[link]]\nnodes = [\"m\", \"room\"]\nthermal = {room:?}\n\
         [[interface]]\nslave = \"s\"\nmaster = \"m\"\narea = 1.0\nclearance = 0.0\npressure = 0.0\n"
    );
    let solved = solve_text(&deck, &scene, &[]);
    ["temperature", "potential"].map(|field| solved.nodes.number(&["s"], field))
}

/// At the solution the mean temperature is 50, a row of the table, where the conductance is 20: 60 flow from 71.5 through 3 to 51.5, and from
/// 48.5 through 5 to 36.5. The slopes on both sides of the row differ, in the second table even in sign.
#[test]
fn a_solution_at_a_knot() {
    let below = "10., 0., 0.\n20., 0., 50.\n";
    for above in ["60., 0., 100.\n", "1., 0., 100.\n", "20., 0., 100.\n"] {
        for initial in [None, Some(0.0), Some(50.0), Some(75.0), Some(1e6)] {
            let faces = chain(&format!("{below}{above}"), [71.5, 36.5], [3.0, 5.0], initial);
            within(faces[0], 51.5, 1e-13);
            within(faces[1], 48.5, 1e-13);
        }
    }
}

/// The joint is at 100, a row of the table and its peak, where 20 * 2^2 = 80 of heat leave through 0.5 + 0.5. It is the only solution: below, the heat
/// rises by 0.75 a degree, above it falls.
#[test]
fn a_heated_joint_at_a_knot() {
    for above in ["1., 0., 200.\n", "21., 0., 200.\n"] {
        for initial in [None, Some(20.0), Some(100.0), Some(300.0)] {
            let law = format!("5., 0., 20.\n20., 0., 100.\n{above}");
            let [temperature, _] = heated(&law, "fixed = 2.0", 0.5, initial);
            within(temperature, 100.0, 1e-13);
        }
    }
}

/// A current of 30 through 1 + x/10, where x is the temperature above the room's: 900 / (1 + x/10) = x, so x = 90.
#[test]
fn a_conductance_that_rises_with_temperature() {
    for initial in [None, Some(20.0), Some(220.0)] {
        let [temperature, potential] = heated("1., 0., 20.\n21., 0., 220.\n", "source = 30.0", 0.5, initial);
        close(temperature, 110.0);
        close(potential, 3.0);
    }
}

/// A current of 990 through 1980 - 9.9 x: 980100 / (1980 - 9.9 x) = 10 x has the solutions 90 and 110, and beyond the table, where the conductance is 99,
/// 990 is another. From the temperature of the room a joint warms to the first.
#[test]
fn a_conductance_that_falls_with_temperature() {
    for initial in [None, Some(20.0)] {
        let law = "1980., 0., 20.\n99., 0., 210.\n";
        let [temperature, potential] = heated(law, "source = 990.0", 5.0, initial);
        close(temperature, 110.0);
        close(potential, 10.0 / 11.0);
    }
}

/// Wherever it is begun, one of the three states is found.
#[test]
fn of_several_states_one_is_found() {
    for initial in [0.0, 100.0, 125.0, 140.0, 210.0, 1e4] {
        let law = "1980., 0., 20.\n99., 0., 210.\n";
        let [temperature, potential] = heated(law, "source = 990.0", 5.0, Some(initial));
        let states = [(110.0, 10.0 / 11.0), (130.0, 10.0 / 9.0), (1010.0, 10.0)];
        let nearest =
            states.into_iter().min_by(|(a, _), (b, _)| (a - temperature).abs().total_cmp(&(b - temperature).abs()));
        let (exact_temperature, exact_potential) = nearest.expect("three states");
        close(temperature, exact_temperature);
        close(potential, exact_potential);
    }
}

/// A chain of faces with no body between them: three conductances of 10 in series.
#[test]
fn faces_between_interfaces_alone_are_part_of_the_network() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, PRESSURE\n10., 0.\n10., 1.\n";
    let pair = |slave: &str, master: &str| {
        format!(
            "[[interface]]\nslave = \"{slave}\"\nmaster = \"{master}\"\narea = 1.0\nclosed = true\npressure = 0.0\n"
        )
    };
    let scene = "[[node]]\nname = \"a\"\ntemperature = { fixed = 90.0 }\n[[node]]\nname = \"b\"\n\
                 [[node]]\nname = \"c\"\n[[node]]\nname = \"d\"\ntemperature = { fixed = 0.0 }\n";
    let solved = solve_text(deck, &format!("{scene}{}{}{}", pair("a", "b"), pair("b", "c"), pair("c", "d")), &[]);
    for slave in ["a", "b", "c"] {
        close(solved.interfaces.number(&[slave], "HFL"), 300.0);
    }
    close(solved.nodes.number(&["b"], "temperature"), 60.0);
    close(solved.nodes.number(&["c"], "temperature"), 30.0);
}

/// The thermal conductance rises from 0.2 to 70 within 30 degrees, and heat of 40 and of a current goes through it. A search from 300 random states by
/// least squares found one solution only: these temperatures, with branches that carry nothing.
#[test]
fn steep_conductances() {
    let deck = "*SURFACE INTERACTION, NAME=A\n\
                *GAP ELECTRICAL CONDUCTANCE, PRESSURE\n70., 0., 0.\n2., 0., 50.\n20., 0., 80.\n50., 0., 300.\n\
                *GAP CONDUCTANCE, PRESSURE\n0.8, 0., 0.\n0.8, 1., 0.\n0.2, 0., 50.\n0.2, 1., 50.\n\
                70., 0., 80.\n70., 1., 80.\n5., 0., 300.\n5., 1., 300.\n*GAP HEAT GENERATION\n1., 0.4\n";
    let mut scene = "[initial]\ntemperature = 200.0\n".to_owned();
    for (name, potential, temperature) in [
        ("ground", "fixed = 0.4", "fixed = 10.0"),
        ("dead-1", "source = 0.0", "source = 0.0"),
        ("middle", "source = 0.0", "source = 0.0"),
        ("dead-2", "source = 0.0", "source = 0.0"),
        ("end-1", "source = 0.0", "source = 0.0"),
        ("end-2", "source = 0.0", "source = 0.0"),
        ("hot", "fixed = 1.0", "source = 40.0"),
        ("end-3", "source = 0.0", "source = 0.0"),
    ] {
        scene +=
            &format!("[[node]]\nname = \"{name}\"\npotential = {{ {potential} }}\ntemperature = {{ {temperature} }}\n");
    }
    for (first, second, electrical) in [("dead-2", "dead-1", 2.0), ("end-2", "end-1", 10.0)] {
        scene +=
            &format!("[[link]]\nnodes = [\"{first}\", \"{second}\"]\nelectrical = {electrical:?}\nthermal = 0.3\n");
    }
    for (slave, master, area) in [
        ("dead-1", "ground", 0.5),
        ("middle", "ground", 0.18),
        ("end-1", "middle", 1.0),
        ("hot", "middle", 0.2),
        ("end-3", "end-2", 0.3),
    ] {
        scene += &format!(
            "[[interface]]\nslave = \"{slave}\"\nmaster = \"{master}\"\narea = {area:?}\nclosed = true\npressure = 0.0\n"
        );
    }
    let solved = solve_text(deck, &scene, &[]);
    for (name, temperature) in
        [("dead-2", "10.00000"), ("middle", "92.15728"), ("end-3", "92.15728"), ("hot", "95.18988")]
    {
        prints(solved.nodes.number(&[name], "temperature"), temperature);
    }
}

/// Without a field of temperature, the mean temperature of an interface is its own, or else the initial one of the scene.
#[test]
fn a_conductance_by_temperature_without_a_field_of_it() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n1., 0., 0.\n21., 0., 200.\n";
    let scene = "[[node]]\nname = \"s\"\npotential = { fixed = 1.0 }\n[[node]]\nname = \"m\"\npotential = { fixed = 0.0 }\n\
                 [[interface]]\nslave = \"s\"\nmaster = \"m\"\narea = 1.0\nclearance = 0.0\npressure = 0.0\n";
    let current = |before: &str, after: &str| {
        solve_text(deck, &format!("{before}{scene}{after}"), &[]).interfaces.number(&["s"], "ECD")
    };
    close(current("[initial]\ntemperature = 90.0\n", ""), 10.0);
    close(current("", "temperature = 40.0\n"), 5.0);
    close(current("[initial]\ntemperature = 90.0\n", "temperature = 40.0\n"), 5.0);
}

/// Heat by radiation alone, to a shield and from it: the surplus of a wall has one root, found here by halving.
#[test]
fn radiation_through_a_shield() {
    let deck = "*PHYSICAL CONSTANTS, ABSOLUTE ZERO=-273.15, STEFAN BOLTZMANN=5.67E-8\n*SURFACE INTERACTION, NAME=A\n\
                *GAP RADIATION\n0.8, 0.5\n1., 0.\n0.5, 1.\n";
    let scene = "[[node]]\nname = \"furnace\"\ntemperature = { fixed = 900.0 }\n[[node]]\nname = \"front\"\n[[node]]\nname = \"back\"\n\
                 [[node]]\nname = \"room\"\ntemperature = { fixed = 25.0 }\n[[link]]\nnodes = [\"front\", \"back\"]\nthermal = 400.0\n\
                 [[interface]]\nslave = \"furnace\"\nmaster = \"front\"\narea = 2.0\nclearance = 0.5\n\
                 [[interface]]\nslave = \"room\"\nmaster = \"back\"\narea = 2.0\nclearance = 0.25\n";
    let of = 5.67e-8 / (1.0 / 0.8 + 1.0 / 0.5 - 1.0);
    let fourth = |temperature: f64| (temperature + 273.15).powi(4);
    let back_of = |front: f64| front - 2.0 * 0.75 * of * (fourth(900.0) - fourth(front)) / 400.0;
    let surplus =
        |front: f64| 400.0 * (front - back_of(front)) - 2.0 * 0.875 * of * (fourth(back_of(front)) - fourth(25.0));
    let (mut low, mut high) = (25.0, 900.0);
    assert!(surplus(low) > 0.0 && surplus(high) < 0.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if surplus(middle) > 0.0 { low = middle } else { high = middle }
    }
    for initial in [
        "",
        "[initial]\ntemperature = 0.0\n",
        "[initial]\ntemperature = -273.15\n",
        "[initial]\ntemperature = 5000.0\n",
    ] {
        let solved = solve_text(deck, &format!("{initial}{scene}"), &[]);
        within(solved.nodes.number(&["front"], "temperature"), low, 1e-10);
        within(solved.nodes.number(&["back"], "temperature"), back_of(low), 1e-10);
        within(solved.links.number(&["front", "back"], "heat"), 400.0 * (low - back_of(low)), 1e-10);
    }
}

/// A rod of four links of which a current of 3 makes heat, its ends at 0: of each link's 9/2, half in either node, so that the heat of the middle node is 9/2,
/// and the parabola i (4 - i) / 2 * (9/2) / 6 is exact.
#[test]
fn bulk_joule_heat() {
    let nodes: String = (0..5).map(|node| format!("[[node]]\nname = \"{node}\"\n{}", held(node))).collect();
    let links = |own: &str| -> String {
        (0..4)
            .map(|link| {
                format!("[[link]]\nnodes = [\"{link}\", \"{}\"]\nelectrical = 2.0\nthermal = 6.0\n{own}", link + 1)
            })
            .collect()
    };
    let deck = "*SURFACE INTERACTION, NAME=A\n";
    let exact = |fraction: f64, node: u8| fraction * 4.5 / 12.0 * f64::from(node) * (4.0 - f64::from(node));
    let cases = [
        ("", "", 0.0),
        ("joule_heat_fraction = 0.75\n", "", 0.75),
        ("joule_heat_fraction = 0.75\n", "joule_heat_fraction = 0.25\n", 0.25),
    ];
    for (of_all, own, fraction) in cases {
        let solved = solve_text(deck, &format!("{of_all}{nodes}{}", links(own)), &[]);
        for node in 0..5 {
            let found = solved.nodes.number(&[&node.to_string()], "temperature");
            assert!((found - exact(fraction, node)).abs() <= 1e-12 * 1.5, "{found} at {node} for {fraction}");
        }
        close(solved.links.number(&["0", "1"], "current"), 3.0);
        // The end takes half of the heat of its link as well.
        let supplied = -fraction * 4.5 * 1.5;
        assert!((solved.links.number(&["0", "1"], "heat") - supplied).abs() <= 1e-12 * supplied.abs());
    }
}

/// The ends of the rod: 6 volts across four links of 2 are a current of 3.
fn held(node: u8) -> &'static str {
    match node {
        0 => "potential = { fixed = 6.0 }\ntemperature = { fixed = 0.0 }\n",
        4 => "potential = { fixed = 0.0 }\ntemperature = { fixed = 0.0 }\n",
        _ => "",
    }
}
