//! `inpact check --geometry`: the rules on geometry, configured, silenced and explained as others are.

use crate::program::{Folder, inpact, inpact_with_input};

/// Blocks whose surfaces face the same way, apart by more than the table goes.
const SAME_WAY: &str = "\
*NODE
1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.\n5, 0., 0., 1.\n6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.
11, 0., 0., 1.6\n12, 1., 0., 1.6\n13, 1., 1., 1.6\n14, 0., 1., 1.6\n15, 0., 0., 2.6\n16, 1., 0., 2.6\n17, 1., 1., 2.6\n18, 0., 1., 2.6
*ELEMENT, TYPE=C3D8T, ELSET=LOWER
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8T, ELSET=UPPER
2, 11, 12, 13, 14, 15, 16, 17, 18
*SURFACE, NAME=TOP
LOWER, S1
*SURFACE, NAME=BOTTOM
UPPER, S1
*SURFACE INTERACTION, NAME=GAP
*GAP CONDUCTANCE
10., 0.
0., 0.5
*CONTACT PAIR, INTERACTION=GAP, TYPE=SURFACE TO SURFACE
BOTTOM, TOP
";

fn codes(arguments: &[&str], deck: &str) -> (i32, Vec<String>) {
    let folder = Folder::with(&[("a.inp", deck)]);
    let run = folder.inpact(&[&["check", "--isolated", "--format", "concise", "a.inp"], arguments].concat());
    let code =
        |line: &str| line.split_once('[').and_then(|(_, rest)| rest.split_once(']')).map(|(code, _)| code.to_owned());
    (run.code, run.output.lines().filter_map(code).collect())
}

#[test]
fn geometry_is_checked_where_it_is_asked_for() {
    assert_eq!(codes(&[], SAME_WAY), (0, Vec::new()));
    assert_eq!(codes(&["--geometry"], SAME_WAY), (0, vec!["G001".to_owned()]));
    let right = SAME_WAY.replace("LOWER, S1", "LOWER, S2");
    assert_eq!(codes(&["--geometry"], &right), (0, vec!["G005".to_owned()]));
    let folder = Folder::with(&[("a.inp", SAME_WAY)]);
    let run = folder.inpact(&["check", "--isolated", "--geometry", "--format", "concise", "a.inp"]);
    let line =
        "a.inp:30:1: warning[G001] `BOTTOM` and `TOP` face the same way at 4 of 4 slave nodes, the first of them 11";
    assert!(run.output.contains(line), "{}", run.output);
    // From a stream, where rows cannot be read a second time, and with fixes, where files are held.
    let run =
        inpact_with_input(&["check", "--isolated", "--geometry", "--format", "concise", "-"], SAME_WAY.as_bytes());
    assert!(run.output.contains("G001"), "{}", run.output);
    assert_eq!(codes(&["--geometry", "--fix"], &format!("{SAME_WAY}  ** indented\n")).1, ["G001"]);
}

#[test]
fn a_deck_without_a_mesh_says_so_and_is_checked_otherwise() {
    let deck =
        "*SURFACE INTERACTION, NAME=GAP\n*GAP CONDUCTANCE\n10., 0.\n0., 0.5\n*CONTACT PAIR, INTERACTION=GAP\nS, M\n";
    let folder = Folder::with(&[("a.inp", deck)]);
    let run = folder.inpact(&["check", "--isolated", "--geometry", "a.inp"]);
    assert_eq!(run.code, 0, "{}", run.shown());
    assert!(run.errors.contains("a.inp: no contact pair with a mesh: no geometry is checked"), "{}", run.errors);
}

#[test]
fn rules_on_geometry_are_configured_and_explained_as_others() {
    let folder = Folder::with(&[("a.inp", SAME_WAY), ("inpact.toml", "[rules]\nG001 = \"error\"\n")]);
    assert_eq!(folder.inpact(&["check", "--geometry", "a.inp"]).code, 1);
    folder.write("inpact.toml", "[rules]\nG001 = \"off\"\n");
    let run = folder.inpact(&["check", "--geometry", "--format", "concise", "a.inp"]);
    assert_eq!((run.code, run.output.as_str()), (0, ""), "{}", run.errors);
    for code in ["G001", "G002", "G003", "G004", "G005", "G006"] {
        let run = inpact(&["explain", code]);
        assert_eq!(run.code, 0, "{}", run.errors);
        assert!(run.output.contains("## Why") || run.output.contains("Why"), "{}", run.output);
    }
}

#[test]
fn samples_with_a_mesh_have_no_finding_of_geometry_but_what_is_meant() {
    for deck in ["decks/weld-mesh/weld-mesh.inp", "decks/spot-weld/spot-weld.inp"] {
        let run = inpact(&["check", "--geometry", "--format", "concise", deck]);
        assert!(run.code == 0 && !run.output.contains("[G"), "{deck}: {}", run.shown());
    }
}
