//! More time or memory than a deck earns: what grows with the square of a deck, or with a number in it.
//!
//! Nothing is held against a clock. Each input is so large that what grew with its square would take hours, and what grew with a
//! number in it more memory than the limit that is set; a run that ends at all has not done that.

use crate::nodes_results::PRESSED;
use crate::program::{Folder, Run, command, run};
use std::io::{BufWriter, Write};

/// Runs with a limit of memory in bytes, where there is one to set.
fn within(folder: &Folder, memory: u64, arguments: &[&str]) -> Run {
    let plain = command(folder.path(), arguments);
    if !cfg!(target_os = "linux") {
        return run(plain, b"");
    }
    let mut limited = std::process::Command::new("prlimit");
    limited.arg(format!("--as={memory}")).arg(plain.get_program()).args(arguments);
    limited.current_dir(folder.path()).env("NO_COLOR", "1").env("RAYON_NUM_THREADS", "1");
    run(limited, b"")
}

#[test]
fn memory_follows_what_is_written_and_not_dependencies() {
    // Filled up to a thousand field variables, a row has 8 kB and the names of its columns 24: 3 GB for all.
    let block = |number| {
        format!(
            "*SURFACE INTERACTION, NAME=A{number}\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=1000\n 1., 0.\n 2., 1.\n"
        )
    };
    let folder = Folder::with(&[("a.inp", &(0..100_000).map(block).collect::<String>())]);
    for arguments in [&["check", "-q", "--statistics", "a.inp"][..], &["json", "a.inp", "-o", "a.json"]] {
        let run = within(&folder, 1 << 30, arguments);
        assert_eq!(run.code, 1, "{arguments:?}: {}", run.errors.chars().take(500).collect::<String>());
    }
    let deck = folder.path().join("a.inp").metadata().expect("there").len();
    let json = folder.path().join("a.json").metadata().expect("there").len();
    assert!(json < 12 * deck, "{json} bytes of JSON for {deck} bytes of deck");
}

#[test]
fn rows_that_are_short_of_a_thousand_dependencies_survive_json() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=1000\n1., 0., 20., 5.\n2., 1.\n";
    let folder = Folder::with(&[("a.inp", deck)]);
    let json = folder.inpact(&["json", "a.inp"]);
    assert!(json.output.contains("\"dependencies\": 1000"), "{}", json.output);
    folder.write("a.json", &json.output);
    let back = folder.inpact(&["inp", "a.json"]);
    assert_eq!(back.code, 0, "{}", back.shown());
    assert!(back.output.contains("DEPENDENCIES=1000"), "{}", back.output);
    folder.write("b.inp", &back.output);
    let tables = |json: &str| {
        let document: serde_json::Value = serde_json::from_str(json).expect("JSON");
        document["interactions"]["A"]["gap_electrical_conductance"].clone()
    };
    assert_eq!(tables(&folder.inpact(&["json", "b.inp"]).output), tables(&json.output));
    for wrong in ["3", "1001"] {
        folder.write("a.json", &json.output.replace("\"dependencies\": 1000", &format!("\"dependencies\": {wrong}")));
        let run = folder.inpact(&["inp", "a.json"]);
        assert!(run.code == 2 || run.code == 1, "{}", run.shown());
        assert!(run.errors.contains("dependencies") && run.errors.contains(wrong), "{}", run.shown());
    }
}

#[test]
fn interactions_that_are_used_cost_no_square() {
    let count = 60_000;
    let block = |number| {
        format!("*SURFACE INTERACTION, NAME=N{number}\n 1.,\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n 1., 0.\n 2., 1.\n")
    };
    let row = |number| format!("{number},N{number},0,1,1,0\n");
    let folder = Folder::with(&[
        ("a.inp", &(0..count).map(block).collect::<String>()),
        (
            "a.csv",
            &format!("node,interaction,clearance,pressure,epot_s,epot_m\n{}", (0..count).map(row).collect::<String>()),
        ),
    ]);
    for arguments in
        [&["eval", "a.inp", "--nodes", "a.csv"][..], &["plan", "a.inp", "--nodes", "a.csv", "--format", "json"]]
    {
        let run = within(&folder, 2 << 30, arguments);
        assert_eq!(run.code, 0, "{}", run.errors.chars().take(500).collect::<String>());
    }
}

#[test]
fn included_files_cost_the_syntax_view_no_square() {
    let count = 150_000;
    let folder = Folder::with(&[("b.inp", "*NODE\n"), ("a.inp", &"*INCLUDE, INPUT=b.inp\n".repeat(count))]);
    let run = folder.inpact(&["json", "--view", "syntax", "a.inp"]);
    assert_eq!((run.code, run.output.matches("\"source\"").count()), (0, count + 1), "{}", run.errors);
}

#[test]
fn columns_of_a_node_table_cost_no_square() {
    let count = 150_000;
    let deck = "*SURFACE INTERACTION, NAME=A\n 1.,\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n 1., 0.\n 2., 1.\n";
    let header: String = (1..=count).map(|number| format!(",fv{number}")).collect();
    let folder = Folder::with(&[("a.inp", deck), ("a.csv", &format!("pressure{header}\n1{}\n", ",1".repeat(count)))]);
    for command in ["plan", "eval"] {
        let run = within(&folder, 2 << 30, &[command, "a.inp", "--nodes", "a.csv"]);
        assert_eq!(run.code, 0, "{command}: {}", run.errors.chars().take(500).collect::<String>());
    }
}

/// Each line of it is wrong, and the parser has to go on behind each.
#[test]
fn a_scene_of_nothing_but_slips_costs_no_square() {
    let wrong = "[[node]\nname = x y\narea\n= 5\n".repeat(100_000);
    let folder = Folder::with(&[("a.toml", &format!("deck = \"a.inp\"\n{wrong}"))]);
    let run = within(&folder, 1 << 30, &["solve", "a.toml"]);
    assert_eq!(run.code, 1, "{}", run.errors.chars().take(500).collect::<String>());
    assert!(run.errors.lines().count() < 100, "{}", run.errors.chars().take(500).collect::<String>());
}

/// Results of 300 increments, 130 MB: as much as one of them is in memory at a time.
#[test]
fn memory_does_not_follow_the_increments_of_a_result_file() {
    let folder = Folder::with(&[("job.inp", PRESSED)]);
    let file = std::fs::File::create(folder.path().join("job.frd")).expect("writable");
    let mut file = BufWriter::new(file);
    writeln!(file, "    1C\n    1UUSER").expect("written");
    let (nodes, increments) = (2700, 300);
    for increment in 1..=increments {
        let time = f64::from(increment) / f64::from(increments);
        let head = |count: i32| {
            format!(
                "    1PSTEP                {increment:12}{increment:12}           1\n  100CL  101{time:12.5e}{count:12}{:20} 0{increment:5}{:10} 1\n",
                "", ""
            )
        };
        writeln!(file, "{} -4  DISP        3    1", head(nodes)).expect("written");
        let names = |names: &[&str]| {
            names.iter().map(|name| format!(" -5  {name:<8}    1    2    1    0\n")).collect::<String>()
        };
        write!(file, "{}", names(&["D1", "D2", "D3"])).expect("written");
        for node in 1..=nodes {
            writeln!(file, " -1{node:10} 0.00000E+00 0.00000E+00-1.00000E-03").expect("written");
        }
        write!(file, " -3\n{} -4  NDTEMP      1    1\n{}", head(nodes), names(&["T"])).expect("written");
        for node in 1..=nodes {
            writeln!(file, " -1{node:10} 2.{increment:05}E+01").expect("written");
        }
        write!(
            file,
            " -3\n{} -4  STRESS      6    1\n{}",
            head(nodes),
            names(&["SXX", "SYY", "SZZ", "SXY", "SYZ", "SZX"])
        )
        .expect("written");
        for node in 1..=nodes {
            writeln!(file, " -1{node:10}{}", " 1.00000E+00".repeat(6)).expect("written");
        }
        writeln!(file, " -3").expect("written");
    }
    writeln!(file, " 9999").expect("written");
    drop(file);
    let size = folder.path().join("job.frd").metadata().expect("there").len();
    assert!(100_000_000 < size, "{size}");
    let run = within(&folder, 256 << 20, &["nodes", "job.inp", "--dialect", "calculix", "--results", "job.frd"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    // Four slave nodes, each in every increment.
    assert_eq!(run.output.lines().count(), 1 + 4 * 300);
}

/// Two cubes on each other, so many times, each face a surface of its own.
fn pressed_cubes(count: usize) -> String {
    use std::fmt::Write;
    let (mut nodes, mut elements, mut surfaces, mut pairs, mut held) =
        (String::new(), String::new(), String::new(), String::new(), String::new());
    let mut node = 0;
    for element in 1..=2 * count {
        let (x, z) = (3 * (element - 1) / 2, (element - 1) % 2);
        let first = node + 1;
        for (dz, dx, dy) in
            [0, 1].into_iter().flat_map(|dz| [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(dx, dy)| (dz, dx, dy)))
        {
            node += 1;
            let _ = writeln!(nodes, "{node}, {}., {dy}., {}.", x + dx, z + dz);
        }
        let corners: Vec<String> = (first..=node).map(|corner| corner.to_string()).collect();
        let _ = writeln!(elements, "{element}, {}", corners.join(", "));
        let _ = writeln!(surfaces, "*ELSET, ELSET=E{element}\n{element},");
        let _ =
            writeln!(surfaces, "*SURFACE, NAME=T{element}\nE{element}, S2\n*SURFACE, NAME=B{element}\nE{element}, S1");
        if z == 1 {
            let _ = writeln!(pairs, "*CONTACT PAIR, INTERACTION=I\nB{element}, T{}", element - 1);
            let _ = writeln!(held, "{first}, 11, 11, 100.");
        }
    }
    format!(
        "*NODE\n{nodes}*ELEMENT, TYPE=DC3D8, ELSET=ALL\n{elements}{surfaces}*SOLID SECTION, ELSET=ALL, MATERIAL=M\n*MATERIAL, NAME=M\n*CONDUCTIVITY\n50.\n*SURFACE INTERACTION, NAME=I\n1.,\n*GAP CONDUCTANCE, PRESSURE\n10., 0.\n20., 1.\n{pairs}*STEP\n*HEAT TRANSFER, STEADY STATE\n*BOUNDARY\n{held}*END STEP\n"
    )
}

/// So many instances of a cube on each other, a pair between each and the next, and a temperature for each.
fn stacked_instances(count: usize) -> String {
    let instance = |number| format!("*INSTANCE, NAME=I{number}, PART=P\n0., 0., {number}.\n*END INSTANCE\n");
    let pair = |number| format!("*CONTACT PAIR, INTERACTION=I\nI{}.B, I{number}.T\n", number + 1);
    let instances: String = (0..count).map(instance).collect();
    let pairs: String = (0..count - 1).map(pair).collect();
    let temperatures: String = (0..count).map(|number| format!("I{number}.1, {number}.\n")).collect();
    format!(
        "*PART, NAME=P\n*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 1.\n6, 1., 0., 1.\n\
         7, 1., 1., 1.\n8, 0., 1., 1.\n*ELEMENT, TYPE=DC3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*SURFACE, NAME=T\nE, S2\n\
         *SURFACE, NAME=B\nE, S1\n*END PART\n*ASSEMBLY, NAME=A\n{instances}*END ASSEMBLY\n\
         *SURFACE INTERACTION, NAME=I\n1.,\n*GAP CONDUCTANCE, PRESSURE\n10., 0.\n20., 1.\n{pairs}\
         *INITIAL CONDITIONS, TYPE=TEMPERATURE\n{temperatures}"
    )
}

/// A surface was sought among all others, what is rounding among all conductances for each of them, a body was lumped over the nodes of all, and a name was held against all instances.
#[cfg(target_os = "linux")]
#[test]
fn many_pairs_of_a_mesh_cost_no_square() {
    for (deck, arguments) in [
        (pressed_cubes(3_000), &["nodes", "a.inp", "-o", "out"][..]),
        (pressed_cubes(750), &["scene", "a.inp", "-o", "out"]),
        (stacked_instances(15_000), &["nodes", "a.inp", "-o", "out"]),
    ] {
        let folder = Folder::with(&[("a.inp", &deck)]);
        let plain = command(folder.path(), arguments);
        let mut limited = std::process::Command::new("prlimit");
        // Seconds of work, whatever else the machine does.
        limited.arg("--cpu=30").arg(plain.get_program()).args(arguments);
        limited.current_dir(folder.path()).env("NO_COLOR", "1").env("RAYON_NUM_THREADS", "1");
        let run = run(limited, b"");
        assert_eq!(run.code, 0, "{arguments:?}: {}", run.errors.chars().take(500).collect::<String>());
    }
}
