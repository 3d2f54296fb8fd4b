//! Meshes read from decks: surfaces, sets, instances, sections, pairs; and what is said of what is not read.

use inpact_geometry::{ContactNode, FaceLabel, Shares};
use inpact_parser::deck::{Keep, ScanOptions, Scanner, scan};
use inpact_parser::grammar::Grammar;
use inpact_parser::mesh::{FaceSurface, KeptRows, Mesh, NodeSurface, SeekableRows, Sliding, SurfaceKind, read};
use inpact_parser::model;
use inpact_parser::span::SourceId;
use std::io::Cursor;

fn mesh(deck: &str) -> Mesh {
    let grammar = Grammar::builtin();
    let scanned = scan("a.inp", deck.as_bytes(), grammar);
    let (model, _) = model::read(&scanned, grammar);
    read(&scanned, grammar, &model, &mut KeptRows(&scanned)).expect("kept rows")
}

fn clean(deck: &str) -> Mesh {
    let mesh = mesh(deck);
    assert_eq!(mesh.notes, []);
    mesh
}

fn faces<'a>(mesh: &'a Mesh, name: &str) -> &'a FaceSurface {
    match &mesh.surfaces.iter().find(|surface| surface.name.written() == name).expect("a surface").kind {
        SurfaceKind::Faces(faces) => faces,
        SurfaceKind::Nodes(_) => panic!("a surface of nodes"),
    }
}

fn nodes<'a>(mesh: &'a Mesh, name: &str) -> &'a NodeSurface {
    match &mesh.surfaces.iter().find(|surface| surface.name.written() == name).expect("a surface").kind {
        SurfaceKind::Nodes(nodes) => nodes,
        SurfaceKind::Faces(_) => panic!("a surface of faces"),
    }
}

/// `7.S2` for each face.
fn named(mesh: &Mesh, name: &str) -> Vec<String> {
    faces(mesh, name).elements.iter().map(|(element, label)| format!("{element}.{label}")).collect()
}

/// Label, area and clearance of each slave node of the first pair.
fn rows(mesh: &Mesh, thickness: f64) -> Vec<(String, f64, f64)> {
    let row = |node: &ContactNode| {
        (
            mesh.nodes[node.node.index()].to_string(),
            node.area,
            node.across.as_ref().map_or(f64::NAN, |across| across.clearance),
        )
    };
    mesh.contact(&mesh.pairs[0], thickness).expect("a geometry").iter().map(row).collect()
}

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-14, "{found} for {expected}");
}

/// Two unit cubes, the upper one 0.25 above the lower.
const CUBES: &str = "*HEADING
two cubes
*NODE
1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.\n4, 0., 1., 0.
5, 0., 0., 1.\n6, 1., 0., 1.\n7, 1., 1., 1.\n8, 0., 1., 1.
*NODE, NSET=UPPER
11, 0., 0., 1.25\n12, 1., 0., 1.25\n13, 1., 1., 1.25\n14, 0., 1., 1.25
15, 0., 0., 2.25\n16, 1., 0., 2.25\n17, 1., 1., 2.25\n18, 0., 1., 2.25
*ELEMENT, TYPE=C3D8, ELSET=LOWER
1, 1, 2, 3, 4, 5, 6,
 7, 8
*ELEMENT, TYPE=C3D8R
2, 11, 12, 13, 14, 15, 16, 17, 18
*ELSET, ELSET=TOP
2
";

const PAIR: &str = "*SURFACE INTERACTION, NAME=GAP
*CONTACT PAIR, INTERACTION=GAP, TYPE=SURFACE TO SURFACE
SLAVE, MASTER
";

fn cubes(rest: &str) -> String {
    format!("{CUBES}{rest}{PAIR}")
}

const FACES: &str = "*SURFACE, NAME=SLAVE\nTOP, S1\n*SURFACE, NAME=MASTER\nLOWER, S2\n";

#[test]
fn faces_by_set_and_by_element() {
    let mesh = clean(&cubes(FACES));
    assert_eq!((named(&mesh, "SLAVE"), named(&mesh, "MASTER")), (vec!["2.S1".to_owned()], vec!["1.S2".to_owned()]));
    // Only the nodes of the faces are kept.
    let labels: Vec<String> = mesh.nodes.iter().map(ToString::to_string).collect();
    assert_eq!(labels, ["5", "6", "7", "8", "11", "12", "13", "14"]);
    for (_, area, clearance) in rows(&mesh, 1.0) {
        close(area, 0.25);
        close(clearance, 0.25);
    }
    let by_number = clean(&cubes("*SURFACE, NAME=SLAVE\n2, S1\n*SURFACE, NAME=MASTER, TYPE=ELEMENT\n1, s2\n"));
    assert_eq!((by_number.points, by_number.nodes), (mesh.points, mesh.nodes));
    assert_eq!((mesh.pairs[0].shares, mesh.pairs[0].sliding), (Shares::ShapeFunctions, Sliding::Finite));
    assert_eq!(mesh.pairs[0].interaction.as_ref().map(model::Name::written), Some("GAP"));
}

#[test]
fn rows_come_from_files_as_they_come_from_memory() {
    let deck = cubes(FACES).replace('\n', "\r\n");
    let grammar = Grammar::builtin();
    let mut scanner = Scanner::new("a.inp", ScanOptions { grammar, keep: Keep::Interpreted });
    scanner.push(deck.as_bytes());
    let scanned = scanner.finish();
    let (model, _) = model::read(&scanned, grammar);
    let mut rows = SeekableRows::new([(SourceId::ROOT, Cursor::new(deck.as_bytes()))]);
    let from_file = read(&scanned, grammar, &model, &mut rows).expect("rows");
    let kept = clean(&cubes(FACES));
    assert_eq!((from_file.notes, from_file.points, from_file.nodes), (vec![], kept.points, kept.nodes));
    // Rows that were not kept are no empty rows.
    assert!(read(&scanned, grammar, &model, &mut KeptRows(&scanned)).is_err());
}

#[test]
fn a_set_without_a_face_has_its_free_faces() {
    // A third cube on the lower one, at its side: their common face is not free.
    let neighbour = "*NODE\n21, 2., 0., 0.\n22, 2., 1., 0.\n23, 2., 0., 1.\n24, 2., 1., 1.
*ELEMENT, TYPE=C3D8, ELSET=NEXT\n3, 2, 21, 22, 3, 6, 23, 24, 7\n";
    let mesh = clean(&cubes(&format!("{neighbour}*SURFACE, NAME=SLAVE\nTOP\n*SURFACE, NAME=MASTER\nLOWER\n")));
    assert_eq!(named(&mesh, "MASTER"), ["1.S1", "1.S2", "1.S3", "1.S5", "1.S6"]);
    assert_eq!(named(&mesh, "SLAVE").len(), 6);
    let both = clean(&cubes(&format!(
        "{neighbour}*ELSET, ELSET=BOTH\nLOWER, NEXT\n*SURFACE, NAME=SLAVE\nTOP, S1\n*SURFACE, NAME=MASTER\nBOTH\n"
    )));
    assert_eq!(named(&both, "MASTER").len(), 10);
}

#[test]
fn sets_are_generated_and_name_each_other() {
    let sets = "*ELSET, ELSET=A, GENERATE\n2, 6, 2\n*ELSET, ELSET=B\nA, C\n*ELSET, ELSET=C\nB\n";
    let mesh = clean(&cubes(&format!("{sets}*SURFACE, NAME=SLAVE\nB, S1\n*SURFACE, NAME=MASTER\nLOWER, S2\n")));
    assert_eq!(named(&mesh, "SLAVE"), ["2.S1"]);
}

#[test]
fn surfaces_of_nodes_have_the_areas_that_they_are_given() {
    let mesh = clean(&cubes(
        "*NSET, NSET=SOME, GENERATE\n11, 12, 1\n*SURFACE, NAME=SLAVE, TYPE=NODE\nSOME, 0.5\n13\n*SURFACE, NAME=MASTER\nLOWER, S2\n",
    ));
    assert_eq!(nodes(&mesh, "SLAVE").areas, [Some(0.5), Some(0.5), None]);
    let found: Vec<(String, f64, f64)> = rows(&mesh, 2.0);
    assert_eq!(found, [("11".to_owned(), 0.5, 0.25), ("12".to_owned(), 0.5, 0.25), ("13".to_owned(), 2.0, 0.25)]);
    // NSET on *NODE.
    let all = clean(&cubes("*SURFACE, NAME=SLAVE, TYPE=NODE\nUPPER, 0.5\n*SURFACE, NAME=MASTER\nLOWER, S2\n"));
    assert_eq!(nodes(&all, "SLAVE").nodes.len(), 8);
}

/// The plate is turned by 90° about the axis through (1, 0, 0) along y, after it was shifted.
const ASSEMBLY: &str = "*PART, NAME=PLATE
*NODE
1, 0., 0.\n2, 1., 0.\n3, 1., 1.\n4, 0., 1.
*ELEMENT, TYPE=S4R, ELSET=ALL
1, 1, 2, 3, 4
*ELSET, ELSET=_SIDE_SPOS, INTERNAL
1
*SURFACE, NAME=SIDE
_SIDE_SPOS, SPOS
*SHELL SECTION, ELSET=ALL, MATERIAL=STEEL, OFFSET=SNEG
0.1, 5
*END PART
*ASSEMBLY, NAME=ASSEMBLY
*INSTANCE, NAME=PLATE-1, PART=PLATE
*END INSTANCE
*INSTANCE, NAME=PLATE-2, PART=PLATE
0., 0., 0.5
0., 0.5, 0.5, 1., 0.5, 0.5, 180.
*END INSTANCE
*ELSET, ELSET=UPPER, INSTANCE=PLATE-2
1
*SURFACE, NAME=ABOVE
UPPER, SPOS
*END ASSEMBLY
*MATERIAL, NAME=STEEL
*SURFACE INTERACTION, NAME=GAP
*CONTACT PAIR, INTERACTION=GAP, SMALL SLIDING
ABOVE, PLATE-1.SIDE
";

#[test]
fn instances_are_put_in_their_places_and_shells_have_thickness() {
    let mesh = clean(ASSEMBLY);
    let labels: Vec<String> = mesh.nodes.iter().map(ToString::to_string).collect();
    assert_eq!(labels[..2], ["PLATE-1.1", "PLATE-1.2"]);
    assert_eq!(labels[4..6], ["PLATE-2.1", "PLATE-2.2"]);
    // Turned over about its own middle line: y becomes 1 − y.
    mesh.points[4].iter().zip([0.0, 1.0, 0.5]).for_each(|(a, b)| close(*a, b));
    assert_eq!(faces(&mesh, "ABOVE").elements[0].1, FaceLabel::Positive);
    assert_eq!(faces(&mesh, "ABOVE").thickness, [Some(0.1)]);
    // The nodes are on the lower side of each plate: a whole thickness of both lies between.
    for (_, area, clearance) in rows(&mesh, 1.0) {
        close(area, 0.25);
        close(clearance, 0.5 - 2.0 * 0.1);
    }
    for (option, clearance) in
        [(", NO THICKNESS", 0.5), (", ADJUST=0.4", 0.0), (", ADJUST=0.2", 0.3), (", EXTENSION ZONE=0.2", 0.3)]
    {
        let mesh = clean(&ASSEMBLY.replace(", SMALL SLIDING", &format!(", SMALL SLIDING{option}")));
        for (_, _, found) in rows(&mesh, 1.0) {
            close(found, clearance);
        }
    }
    // Finite sliding, node to surface, does not count it.
    for (_, _, found) in rows(&clean(&ASSEMBLY.replace(", SMALL SLIDING", "")), 1.0) {
        close(found, 0.5);
    }
    let given = format!("{ASSEMBLY}*CLEARANCE, SLAVE=ABOVE, MASTER=PLATE-1.SIDE, VALUE=0.125\n");
    for (_, _, found) in rows(&clean(&given), 1.0) {
        close(found, 0.125);
    }
}

#[test]
fn plane_and_axisymmetric_elements() {
    let deck = |kind: &str, section: &str| {
        format!(
            "*NODE\n1, 1., 0.\n2, 3., 0.\n3, 3., 1.\n4, 1., 1.\n5, 1., 1.5\n6, 3., 1.5\n7, 3., 2.\n8, 1., 2.
*ELEMENT, TYPE={kind}, ELSET=LOW\n1, 1, 2, 3, 4\n*ELEMENT, TYPE={kind}, ELSET=HIGH\n2, 5, 6, 7, 8
{section}*SURFACE, NAME=SLAVE\nHIGH, S1\n*SURFACE, NAME=MASTER\nLOW, S3\n{PAIR}"
        )
    };
    let plane = clean(&deck(
        "CPE4R",
        "*SOLID SECTION, ELSET=HIGH, MATERIAL=A\n0.5,\n*SOLID SECTION, ELSET=LOW, MATERIAL=A\n0.5,\n",
    ));
    assert_eq!(faces(&plane, "SLAVE").thickness, [Some(0.5)]);
    for (_, area, clearance) in rows(&plane, 1.0) {
        close(area, 0.5);
        close(clearance, 0.5);
    }
    // Without a section the interaction gives the thickness; that there is no section is noted.
    let without = mesh(&deck("CPS4", ""));
    assert_eq!(without.notes.len(), 2);
    assert_eq!(without.notes[0].message, "no section gives a thickness to 1 faces of this surface");
    for (_, area, _) in rows(&without, 3.0) {
        close(area, 3.0);
    }
    let round = clean(&deck("CAX4", ""));
    let areas: f64 = rows(&round, 1.0).iter().map(|(_, area, _)| area).sum();
    assert!((areas - std::f64::consts::PI * 8.0).abs() <= 1e-13, "{areas}");
}

#[test]
fn cylindrical_and_spherical_coordinates() {
    let system = |system: &str, rows: &str| {
        let text = CUBES.replace(
            "*NODE, NSET=UPPER\n11, 0., 0., 1.25\n",
            &format!("*NODE, SYSTEM={system}\n{rows}*NODE, NSET=UPPER\n"),
        );
        let mesh = clean(&format!("{text}{FACES}{PAIR}"));
        mesh.points[4]
    };
    system("C", "11, 2., 90., 1.25\n").iter().zip([0.0, 2.0, 1.25]).for_each(|(a, b)| close(*a, b));
    system("S", "11, 2., 90., 30.\n").iter().zip([0.0, 3.0_f64.sqrt(), 1.0]).for_each(|(a, b)| close(*a, b));
}

/// Parts that are not read are noted, once, with their place.
#[test]
fn what_is_not_read_is_named() {
    let said = |deck: &str| -> Vec<String> { mesh(deck).notes.into_iter().map(|note| note.message).collect() };
    let one = |deck: &str, message: &str| assert_eq!(said(deck), [message], "{deck}");
    let master = "*SURFACE, NAME=MASTER\nLOWER, S2\n";
    one(&cubes(master), "the surface `SLAVE` is not defined here, so that its pairs were not read");
    assert_eq!(
        said(&cubes(&format!("*SURFACE, NAME=SLAVE\nNONE, S1\n{master}"))),
        [
            "the element set `NONE` is not defined here, so that nothing of it was read",
            "no face of this surface was found, so that its pairs were not read"
        ]
    );
    assert_eq!(
        said(&cubes(&format!("*SURFACE, NAME=SLAVE\n2, S1\nTOP, E1\n{master}"))),
        ["expected a face: `S1` to `S6`, `SPOS` or `SNEG`, found `E1`; the row was not read"]
    );
    assert_eq!(
        said(&cubes(&format!("*SURFACE, NAME=SLAVE\n2, S1\nTOP, SPOS\n{master}"))),
        ["element 2 of type C3D8R has no face SPOS and was left out"]
    );
    one(
        &cubes(&format!("*SURFACE, NAME=SLAVE, TYPE=REVOLUTION\nLINE, 1., 2.\n{master}")),
        "surfaces that are of type REVOLUTION are not read, so that the pairs of `SLAVE` were not read",
    );
    let unknown = format!(
        "*NODE\n31, 0., 0., 3.\n*ELEMENT, TYPE=COH3D8, ELSET=GLUE\n9, 11, 12, 13, 14, 15, 16, 17, 18\n*SURFACE, NAME=SLAVE\n2, S1\nGLUE, S1\n{master}"
    );
    one(&cubes(&unknown), "the faces of elements of type `COH3D8` are not known here; 1 rows of them were left out");
    let generated = CUBES.replace("14, 0., 1., 1.25\n", "") + "*NGEN\n13, 15, 1\n";
    assert_eq!(
        said(&format!("{generated}{FACES}{PAIR}")),
        ["face S1 of element 2 has a node that was not found (*NGEN is not read) and was left out"]
    );
    assert_eq!(
        said(&format!("*SYSTEM\n1., 0., 0.\n{}", cubes(FACES)))[0],
        "nodes of which some follow *SYSTEM are not read"
    );
    let short =
        CUBES.replace("2, 11, 12, 13, 14, 15, 16, 17, 18", "7, 11, 12\n2, 11, 12, 13, 14, 15, 16, 17, 18\n8, 11,");
    assert_eq!(
        said(&format!("{short}{FACES}{PAIR}")),
        ["element 7 of type C3D8R has 2 nodes where 8 are due and was not read, and so were 1 more"]
    );
    let self_contact = cubes(FACES).replace("SLAVE, MASTER", "SLAVE");
    one(&self_contact, "contact of `SLAVE` with itself is not read");
    let broken = cubes(FACES).replace("11, 0., 0., 1.25", "11, 0., zero, 1.25");
    assert_eq!(
        said(&broken),
        [
            "expected the number of a node and its coordinates, found `11, 0., zero, 1.25`; the node was not read",
            "face S1 of element 2 has a node that was not found and was left out"
        ]
    );
}

#[test]
fn general_contact_with_two_names_is_a_pair() {
    let general = "*SURFACE INTERACTION, NAME=GAP\n*CONTACT\n*CONTACT INCLUSIONS\nSLAVE, MASTER\n*CONTACT PROPERTY ASSIGNMENT\nSLAVE, MASTER, GAP\n";
    let mesh = clean(&format!("{CUBES}{FACES}{general}"));
    assert_eq!(mesh.pairs.len(), 1);
    assert_eq!(mesh.pairs[0].shares, Shares::ShapeFunctions);
    let all = self::mesh(&format!("{CUBES}{FACES}{}", general.replace("SLAVE, MASTER, GAP", ", , GAP")));
    assert_eq!((all.pairs.len(), all.notes.len()), (0, 1));
}
