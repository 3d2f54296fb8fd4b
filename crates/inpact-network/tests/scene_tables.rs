//! Reading the tables beside a scene file: nodes, links and interfaces, matrices of conductances, and what may be wrong with them.

mod scene_support;

use inpact_network::scene::{Course, Scene, SceneLink};
use inpact_parser::model::Name;
use proptest::prelude::*;
use scene_support::{SCENE, mutated, read_with, show};
use std::fmt::Write as _;

/// A scene with tables beside it, and what is said of them.
fn beside(entries: &str, files: &[(&str, &str)]) -> (Option<Scene>, Vec<String>) {
    let files: Vec<(&str, &[u8])> = files.iter().map(|(name, text)| (*name, text.as_bytes())).collect();
    read_with(&format!("{SCENE}{entries}"), &files)
}

fn node_file(text: &str) -> (Option<Scene>, Vec<String>) {
    beside("[[node_file]]\nfile = \"nodes.csv\"\n", &[("nodes.csv", text)])
}

fn link_file(text: &str) -> (Option<Scene>, Vec<String>) {
    beside("[[link_file]]\nfile = \"links.csv\"\n", &[("links.csv", text)])
}

fn interface_file(text: &str) -> (Option<Scene>, Vec<String>) {
    beside("[[interface_file]]\nfile = \"rows.csv\"\n", &[("rows.csv", text)])
}

/// A table of nodes goes on where the scene ends; columns come in any order and case, an empty cell says nothing.
#[test]
fn a_table_of_nodes() {
    let (scene, findings) = node_file(
        "temperature_initial, NODE ,potential_source,pore_pressure_fixed,temperature_capacity\n\
         ,a,,7,\n\n 25.5 ,\"b, c\",-1e3,,0\n",
    );
    let scene = scene.unwrap_or_else(|| panic!("{findings:?}"));
    assert_eq!(scene.nodes, ["hot", "middle", "cold", "a", "b, c"]);
    let constant = |value| Some(Course::constant(value));
    let [potential, temperature, pore_pressure] = &scene.conditions;
    assert_eq!((potential.sources.get(&3), potential.sources.get(&4)), (None, constant(-1e3).as_ref()));
    assert_eq!((temperature.initial.get(&3), temperature.initial.get(&4)), (None, Some(&25.5)));
    assert_eq!((temperature.capacities.get(&3), temperature.capacities.get(&4)), (None, Some(&0.0)));
    assert_eq!((pore_pressure.fixed.get(&3), pore_pressure.fixed.get(&4)), (constant(7.0).as_ref(), None));
    assert_eq!(scene.node_lines.get(&3), None);
}

#[test]
fn a_table_of_links() {
    let (scene, findings) =
        link_file("node_1,node_2,thermal,electrical,joule_heat_fraction\nhot,cold,inf,,\nmiddle,hot,,2.5,0.5\n");
    let scene = scene.unwrap_or_else(|| panic!("{findings:?}"));
    assert_eq!(scene.nodes, ["hot", "middle", "cold"]);
    let link = |nodes, conductances, joule_heat_fraction| SceneLink { nodes, conductances, joule_heat_fraction };
    assert_eq!(scene.links[2..], [link([0, 2], [0.0, f64::INFINITY, 0.0], 0.25), link([1, 0], [2.5, 0.0, 0.0], 0.5)]);
}

/// The names of the nodes at both ends of each link.
fn ends_of(scene: &Scene) -> Vec<String> {
    let names = |link: &SceneLink| link.nodes.map(|node| scene.nodes[node as usize].clone()).join("-");
    scene.links.iter().map(names).collect()
}

/// Tables of links define nodes only where the scene defines none; otherwise an unknown name is a slip.
#[test]
fn tables_of_links_define_nodes_only_where_nothing_else_does() {
    let entries = "[[link_file]]\nfile = \"l\"\n[[link_file]]\nfile = \"m.mtx\"\nconducts = \"thermal\"\n";
    let matrix = format!("{MATRIX}2 2 1\n2 1 3\n");
    let files: [(&str, &[u8]); 3] =
        [("l", b"node_1,node_2,thermal\na,1,1\n"), ("m.mtx", matrix.as_bytes()), ("n", b"node\na\n")];
    let with = |start: &str| {
        let (scene, findings) = read_with(&format!("deck = \"deck.inp\"\n{start}{entries}"), &files);
        scene.map_or_else(|| findings.clone(), |scene| ends_of(&scene))
    };
    assert_eq!(with(""), ["a-1", "2-1"]);
    // Rows of a matrix are nodes in any case, and all else may name them, be it written before.
    assert_eq!(with("[[node]]\nname = \"a\"\n"), ["a-1", "2-1"]);
    assert_eq!(
        with("[[node]]\nname = \"a\"\n[[link]]\nnodes = [\"2\", \"a\"]\nthermal = 1.0\n"),
        ["2-a", "a-1", "2-1"]
    );
    assert_eq!(with("[[node_file]]\nfile = \"n\"\n"), ["a-1", "2-1"]);
    let [unknown] = &with("[[node]]\nname = \"ab\"\n")[..] else { panic!("one finding") };
    assert!(unknown.starts_with("l:2 row 1 column node_1: Error[D013 unknown-node] the scene defines no node `a`"));
    // A table of nodes that is refused may define it.
    let (_, findings) = read_with(
        &format!("deck = \"deck.inp\"\n[[node_file]]\nfile = \"n\"\n{entries}"),
        &[("n", b"node,x\na,1\n"), files[0], files[1]],
    );
    assert_eq!(findings.iter().filter(|line| line.contains("D013")).count(), 0, "{findings:?}");
    // And so may a matrix.
    let (_, findings) = beside(entries, &[("l", "node_1,node_2,thermal\nhot,1,1\n"), ("m.mtx", "")]);
    assert_eq!(findings.len(), 1, "{findings:?}");
}

/// A million names that are not known take no comparison with a million names each.
#[test]
fn near_names_are_suggested_for_a_few() {
    let names = |letter: char| (0..30_000).map(move |number| format!("{letter}{number}"));
    let nodes: String = "node\n".to_owned() + &names('n').collect::<Vec<_>>().join("\n");
    let links: String = names('m').map(|name| format!("{name},hot,1\n")).collect();
    let entries = "[[node_file]]\nfile = \"n\"\n[[link_file]]\nfile = \"l\"\n";
    let (_, findings) = beside(entries, &[("n", &nodes), ("l", &format!("node_1,node_2,thermal\n{links}"))]);
    assert_eq!((findings.len(), findings[0].contains("is `n0` meant?")), (20, true), "{findings:?}");
    assert!(findings[19].ends_with("29980 more findings of this rule in this table are not shown"), "{findings:?}");
}

#[test]
fn a_table_of_interfaces() {
    let (scene, findings) = interface_file(
        "Secondary,MAIN,interaction,area,COPEN,cpress,closed,fv2,temp,mass_flow,shear,slip_rate,clearance_rate,char_length,perm_s,perm_m\n\
         hot,cold,other,2,0.5,3,1,9,30,4,5,6,7,8,1,2\n\
         hot,middle,,1,,,,,,,,,,,,\n",
    );
    let scene = scene.unwrap_or_else(|| panic!("{findings:?}"));
    let [_, row, bare] = &scene.interfaces[..] else { panic!("{:?}", scene.interfaces) };
    assert_eq!((row.slave, row.master, row.area), (0, 2, 2.0));
    assert_eq!(row.interaction, Some(Name::new("OTHER")));
    assert_eq!((&row.clearance, &row.pressure), (&Some(Course::constant(0.5)), &Some(Course::constant(3.0))));
    // Nothing is said of the first field variable, which is not to say that it is zero.
    let [first, second] = row.field_variables[..] else { panic!("{:?}", row.field_variables) };
    assert_eq!((row.closed, first.is_nan(), second), (Some(true), true, 9.0));
    assert_eq!(
        (row.temperature, row.mass_flow, row.shear, row.slip_rate),
        (Some(30.0), Some(4.0), Some(5.0), Some(6.0))
    );
    assert_eq!((row.clearance_rate, row.characteristic_length), (Some(7.0), Some(8.0)));
    assert_eq!((row.bulk_permeabilities, &row.place), ([Some(1.0), Some(2.0)], &(2, Some("rows.csv".to_owned()))));
    assert_eq!((bare.slave, bare.master, &bare.interaction, bare.closed), (0, 1, &None, None));
    assert_eq!((&bare.clearance, bare.field_variables.len(), bare.temperature), (&None, 0, None));
}

/// The findings of tables, one after the other.
#[test]
fn tables_that_are_not_right() {
    type Reads = fn(&str) -> (Option<Scene>, Vec<String>);
    let cases: [(Reads, &[&str]); 3] = [
        (
            node_file,
            &[
                "",
                "name,temperature_fixed\na,1\n",
                "node,temperature\na,1\n",
                "node,potential_capacity,potential_initial\na,1,1\n",
                "node,NODE\na,a\n",
                "node,temperature_fixed\na,warm\n",
                "node,temperature_fixed\na,1,2\n",
                "node,temperature_fixed\na,inf\nb,nan\n",
                "node,temperature_capacity\na,-1\n",
                "node\nhot\n",
                "node\na\n\"a\"\n",
                "node,temprature_fixed,pore_presure_fixed\na,1,1\n",
                "node,temperature_fixed,temperature_source,temperature_capacity\na,1,2,\nb,1,,3\nc,,2,3\n",
                "node,potential_fixed\n,1\n",
                "node,temperature_fixed\na,1e999\n",
            ],
        ),
        (
            link_file,
            &[
                "node_1,thermal\na,1\n",
                "node_1,node_2,heat\na,b,1\n",
                "node_1,node_2,thermal\na,b,-1\na,b,nan\na,b,1e\n",
                "node_1,node_2,joule_heat_fraction\na,b,inf\na,b,-1\n",
                "node_1,node_2,thermal\na,a,1\n",
                "node_1,node_2,thermal\nhot,middel,1\nelsewhere,hot,1\n",
                "node_1,node_2,thermal,joule_heat_fraction\nhot,cold,1,5\nhot,cold,1,1\n",
                "node_1,node_2,thermal,electrical\nhot,cold,,\nhot,cold,0,\n",
                "node_1,node_2\nhot,cold\n",
                "node_1,Node_2,thermal\nhot,,1\n,hot,1\n",
                "node_1,node_2,thremal\nhot,cold,1\n",
                "node_1,node_2,thermal\na,b\n",
            ],
        ),
        (
            interface_file,
            &[
                "slave,master\nhot,cold\n",
                "slave,main,master,area\nhot,cold,cold,1\n",
                "slave,master,area,node\nhot,cold,1,7\n",
                "slave,master,area,temp_s\nhot,cold,1,7\n",
                "slave,master,area\nhot,clod,1\nhto,cold,1\n",
                "slave,master,area\nhot,cold,0\nhot,cold,-1\nhot,cold,inf\n",
                "slave,master,area,fv1,char_length\nhot,cold,1,nan,1\nhot,cold,1,1,-1\n",
                "slave,master,area,closed\nhot,cold,1,yes\nhot,cold,1,nan\n",
                "slave,master,area,clearance,pressure\nhot,cold,1,nan,inf\nhot,cold,1,1,-inf\nhot,cold,1,,\n",
                "slave,master,area\nhot,hot,1\n",
                "slave,main,CNAREA\nhot,cold,\n,cold,1\nhot,,1\n",
                "slave,master,area,fv1000\nhot,cold,1,7\nhot,cloud,1,7\n",
                "slave,master,area,fv1001\nhot,cold,1,7\n",
                "slave,master,area,fv4294967295\nhot,cold,1,7\n",
                "slave,master,are,temprature\nhot,cold,1,7\n",
            ],
        ),
    ];
    let mut shown = String::new();
    for (reads, texts) in cases {
        for text in texts {
            let (scene, findings) = reads(text);
            assert!(scene.is_none(), "{text}: {findings:?}");
            let _ = writeln!(shown, "{}", text.trim_end().replace('\n', " / "));
            show(&mut shown, &findings);
        }
    }
    insta::assert_snapshot!(shown);
}

/// Bytes that are no text in one row: what came before is not blamed for it.
#[test]
fn a_table_that_is_not_utf_8() {
    let files: [(&str, &[u8]); 1] = [("nodes.csv", b"node\na\nk\xFCrzer\nb\n")];
    let (scene, findings) = read_with(&format!("{SCENE}[[node_file]]\nfile = \"nodes.csv\"\n"), &files);
    assert!(scene.is_none());
    assert_eq!(
        findings,
        ["nodes.csv:3: Error[D002 malformed-cell] the row is not UTF-8\n    help: save the table as UTF-8"]
    );
}

/// A node may be in the table that was refused: that it is not known is not said as well.
#[test]
fn nodes_of_a_table_that_was_refused_are_not_missed() {
    let entries = "[[node_file]]\nfile = \"nodes.csv\"\n[[link]]\nnodes = [\"hot\", \"far\"]\nthermal = 1.0\n\
                   [[interface_file]]\nfile = \"rows.csv\"\n";
    let rows = ("rows.csv", "slave,master,area\nfar,hot,1\n");
    let (scene, findings) = beside(entries, &[("nodes.csv", "node,potential_fixed\nfar,x\n"), rows]);
    assert!(scene.is_none() && findings.len() == 1 && findings[0].contains("which is no number"), "{findings:?}");
    // Nor where the table is not there; that the caller says.
    let (_, findings) = beside(entries, &[rows]);
    assert_eq!(findings, Vec::<String>::new());
    // In a table that is right it would be there.
    let (_, findings) = beside(entries, &[("nodes.csv", "node\nnear\n"), rows]);
    assert_eq!(findings.iter().filter(|line| line.contains("defines no node `far`")).count(), 2, "{findings:?}");
}

const MATRIX: &str = "%%MatrixMarket matrix coordinate real symmetric\n";

/// A scene with a matrix of this text.
fn matrix(text: &str) -> (Option<Scene>, Vec<String>) {
    beside("[[link_file]]\nfile = \"K.MTX\"\nconducts = \"thermal\"\nprefix = \"n\"\n", &[("K.MTX", text)])
}

/// The nodes and conductances of links that a matrix brings.
fn links_of(text: &str) -> Vec<(String, f64)> {
    let (scene, findings) = matrix(text);
    let scene = scene.unwrap_or_else(|| panic!("{text}: {findings:?}"));
    let link = |link: &SceneLink| {
        let names = link.nodes.map(|node| scene.nodes[node as usize].clone()).join("-");
        assert_eq!((link.conductances[0], link.conductances[2], link.joule_heat_fraction), (0.0, 0.0, 0.25));
        (names, link.conductances[1])
    };
    scene.links[2..].iter().map(link).collect()
}

#[test]
fn matrices_of_conductances_and_assembled_ones() {
    let expected = [("n2-n1".to_owned(), 2.0), ("n3-n2".to_owned(), 0.5)];
    let conductances = format!("{MATRIX}% two links\n3 3 2\n\n2 1 2.0\n%\n  3\t2  5e-1 \n");
    assert_eq!(links_of(&conductances), expected);
    let assembled = format!("{MATRIX}3 3 5\n1 1 2\n2 1 -2\n2 2 2.5\n3 2 -0.5\n3 3 0.5\n");
    assert_eq!(links_of(&assembled), expected);
    assert_eq!(links_of(&assembled.replace("coordinate real", "Coordinate INTEGER")), expected);
    assert_eq!(links_of(&conductances.replace('\n', "\r\n")), expected);
    // One triangle is as good as the other.
    assert_eq!(links_of(&format!("{MATRIX}2 2 1\n1 2 3\n")), [("n1-n2".to_owned(), 3.0)]);
    assert_eq!(links_of(&format!("{MATRIX}0 0 0\n")), []);
    // A diagonal of zero is none.
    assert_eq!(links_of(&format!("{MATRIX}2 2 2\n1 1 0\n2 1 4\n")), [("n2-n1".to_owned(), 4.0)]);
}

/// Both triangles, or an entry twice, would conduct twice what the matrix does.
#[test]
fn a_pair_of_a_symmetric_matrix_has_one_entry() {
    for (entries, line) in [("2 2 2\n2 1 2\n1 2 2\n", 4), ("3 3 3\n2 1 2\n3 1 1\n2 1 2\n", 5)] {
        let (scene, findings) = matrix(&format!("{MATRIX}{entries}"));
        assert!(scene.is_none() && findings.len() == 1, "{findings:?}");
        for said in [&format!("K.MTX:{line}"), "D011", "gives 2 and 1 a second entry, after line 3"] {
            assert!(findings[0].contains(said), "{said}: {findings:?}");
        }
    }
    let both = "2 2 4\n1 1 1\n2 1 -1\n1 2 -1\n2 2 1\n";
    assert!(matrix(&format!("{MATRIX}{both}")).1[0].contains("`1 2 -1` gives 2 and 1 a second entry, after line 4"));
}

/// No room is made for rows that have no entries, be they as many as there can be.
#[test]
fn a_matrix_takes_as_much_room_as_its_entries() {
    let most = u32::MAX;
    assert_eq!(links_of(&format!("{MATRIX}{most} {most} 0\n")), []);
    let last = format!("n{most}-n1");
    assert_eq!(links_of(&format!("{MATRIX}{most} {most} 1\n{most} 1 2\n")), [(last.clone(), 2.0)]);
    let assembled = format!("{MATRIX}{most} {most} 3\n1 1 2\n{most} 1 -2\n{most} {most} 2\n");
    assert_eq!(links_of(&assembled), [(last, 2.0)]);
    let (_, findings) = matrix(&assembled.replace("-2", "-1"));
    assert!(findings.len() == 1 && findings[0].contains("row 1 adds up to 1.0"), "{findings:?}");
}

#[test]
fn matrices_that_are_not_right() {
    let mut shown = String::new();
    let header = |kind: &str, rest: &str| format!("%%MatrixMarket {kind}\n{rest}");
    let cases = [
        String::new(),
        "1 1 0\n".to_owned(),
        header("matrix coordinate real general", "2 2 1\n2 1 1.0\n"),
        header("matrix coordinate pattern symmetric", "2 2 1\n2 1\n"),
        header("matrix array real symmetric", "2 2\n1\n-1\n1\n"),
        header("matrix coordinate complex symmetric", "2 2 1\n2 1 1.0 0.0\n"),
        MATRIX.to_owned(),
        format!("{MATRIX}2 2\n"),
        format!("{MATRIX}2 2 -1\n"),
        format!("{MATRIX}2 x 2 1\n2 1 1.0\n"),
        format!("{MATRIX}5000000000 5000000000 0\n"),
        format!("{MATRIX}2 3 1\n2 1 1.0\n"),
        format!("{MATRIX}2 2 1\n3 1 1.0\n"),
        format!("{MATRIX}2 2 1\n2 0 1.0\n"),
        format!("{MATRIX}2 2 1\n2 -1 1.0\n"),
        format!("{MATRIX}2 2 1\n2 1.5 1.0\n"),
        format!("{MATRIX}2 2 1\n2 1 one\n"),
        format!("{MATRIX}2 2 1\n2 1 inf\n"),
        format!("{MATRIX}2 2 1\n2 1 1e999\n"),
        format!("{MATRIX}2 2 1\n2 1\n"),
        format!("{MATRIX}2 2 1\n2 1 1.0 0.0\n"),
        format!("{MATRIX}2 2 2\n2 1 1.0\n"),
        format!("{MATRIX}2 2 1\n2 1 1.0\n1 2 1.0\n"),
        format!("{MATRIX}3 3 2\n2 1 1.0\n3 1 -1.0\n"),
        format!("{MATRIX}2 2 2\n1 1 1.0\n2 1 1.0\n"),
        format!("{MATRIX}2 2 3\n1 1 1.0\n2 1 -1.0\n2 2 2.0\n"),
        format!("{MATRIX}2 2 1\n2 1 -1.0\n"),
        format!("{MATRIX}2 2 3\n1 1 1e308\n1 1 1e308\n2 1 -1.0\n"),
    ];
    for text in &cases {
        let (scene, findings) = matrix(text);
        assert!(scene.is_none(), "{text}: {findings:?}");
        let _ = writeln!(shown, "{}", text.trim_end().replace('\n', " / "));
        show(&mut shown, &findings);
    }
    let unsaid = beside("[[link_file]]\nfile = \"K.mtx\"\n", &[("K.mtx", MATRIX)]);
    let _ = writeln!(shown, "without conducts\n  {}", unsaid.1.join("\n  "));
    insta::assert_snapshot!(shown);
}

const NODES: &str = "node,temperature_fixed,pore_pressure_source\na,1,2\nb,,-3\n";
const LINKS: &str = "node_1,node_2,thermal\nhot,a,1\na,b,inf\n";
const ROWS: &str = "slave,master,interaction,area,clearance,fv1\nhot,a,joint,1,0,2\n";
const ASSEMBLED: &str = "%%MatrixMarket matrix coordinate real symmetric\n% n\n2 2 3\n1 1 1.0\n2 1 -1.0\n2 2 1.0\n";

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn no_table_makes_a_panic(nodes in mutated(NODES), links in mutated(LINKS), rows in mutated(ROWS), matrix in mutated(ASSEMBLED)) {
        let entries = "[[node_file]]\nfile = \"n\"\n[[link_file]]\nfile = \"l\"\n[[link_file]]\nfile = \"m.mtx\"\nconducts = \"thermal\"\n\
                       [[interface_file]]\nfile = \"r\"\n";
        let (scene, findings) = beside(entries, &[("n", &nodes), ("l", &links), ("m.mtx", &matrix), ("r", &rows)]);
        prop_assert_eq!(scene.is_none(), !findings.is_empty(), "{:?}", findings);
    }
}
