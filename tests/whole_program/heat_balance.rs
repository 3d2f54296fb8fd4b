//! The heat that crosses the faying faces of the sample with a mesh, beside CalculiX: its thermal twin, pressed until every node touches.
//!
//! ccx holds all displacements and solves the temperatures; with its temperatures `inpact eval` finds the heat of every slave node, whose sum is the heat that
//! ccx takes out at the upper side. The conductance is the same at all pressures, because ccx reads the table of node-to-surface contact at another one.
//! Without ccx the comparison does nothing and says so; where `INPACT_REQUIRE_CCX` is set, as in the gate, it fails instead.

use crate::nodes_results::ccx;
use crate::program::root;

type Node = (u32, [f64; 3]);

/// Nodes and elements of a part of the sample.
fn part(sample: &str, name: &str) -> (Vec<Node>, Vec<Vec<u32>>) {
    let body = sample.split_once(&format!("*PART, NAME={name}\n")).expect("the part").1;
    let rows = |after: &str| {
        let rows = body.split_once(after).expect("rows").1;
        rows.lines()
            .take_while(|line| !line.starts_with('*'))
            .map(|line| line.split(',').map(str::trim).collect::<Vec<_>>())
    };
    let number = |text: &str| text.parse::<f64>().expect("a number");
    let label = |text: &str| text.parse::<u32>().expect("a label");
    let nodes = rows("*NODE, NSET=ALL\n").map(|row| (label(row[0]), [1, 2, 3].map(|at| number(row[at])))).collect();
    let elements = rows("ELSET=SHEET\n").map(|row| row.into_iter().map(label).collect()).collect();
    (nodes, elements)
}

/// The twin: the upper sheet at its place in the assembly, 11 micrometres lower, so that its crown is pressed flat and more.
///
/// The nodes of its lower side are held column by column, in the sets `COLUMN-0` to `COLUMN-5`.
pub(crate) fn twin(discretisation: &str, columns: [f64; 6]) -> String {
    let sample = std::fs::read_to_string(root().join("decks/weld-mesh/weld-mesh.inp")).expect("the sample");
    let ((lower, lower_elements), (upper, upper_elements)) = (part(&sample, "LOWER"), part(&sample, "UPPER"));
    let (sine, cosine) = 15.0_f64.to_radians().sin_cos();
    let place = |[x, y, z]: [f64; 3]| [0.003 + cosine * x - sine * y, 0.003 + sine * x + cosine * y, z + 0.001 - 11e-6];
    let top = upper.iter().fold(f64::MIN, |most, (_, [.., z])| most.max(*z));
    let line = |(node, [x, y, z]): Node| format!("{node}, {x:?}, {y:?}, {z:?}\n");
    let nodes: String =
        lower.iter().copied().map(line).chain(upper.iter().map(|(node, at)| line((node + 1000, place(*at))))).collect();
    let brick = |element: &[u32], shift: u32| {
        let labels: Vec<String> = element.iter().map(|label| (label + shift).to_string()).collect();
        labels.join(", ") + "\n"
    };
    let of_lower: String = lower_elements.iter().map(|element| brick(element, 0)).collect();
    let of_upper: String = upper_elements.iter().map(|element| brick(element, 1000)).collect();
    let at_top: String =
        upper.iter().filter(|(_, [.., z])| top - 1e-6 < *z).map(|(node, _)| format!("{},\n", node + 1000)).collect();
    let (mut sets, mut warm) = (String::new(), String::new());
    for (number, temperature) in (0_u32..).zip(columns) {
        let is_in = |(_, [x, _, z]): &&Node| *z == 0.0 && (x - 0.0012 * f64::from(number)).abs() < 1e-6;
        let rows: String = lower.iter().filter(is_in).map(|(node, _)| format!("{node},\n")).collect();
        sets += &format!("*NSET, NSET=COLUMN-{number}\n{rows}");
        warm += &format!("COLUMN-{number}, 11, 11, {temperature:?}\n");
    }
    format!(
        "*NODE, NSET=HELD\n{nodes}*ELEMENT, TYPE=C3D8, ELSET=LOWER\n{of_lower}*ELEMENT, TYPE=C3D8, ELSET=UPPER\n{of_upper}*NSET, NSET=NTOP\n{at_top}{sets}\
*SURFACE, NAME=MASTER
LOWER, S2
*SURFACE, NAME=SLAVE
UPPER, S1
*MATERIAL, NAME=STEEL
*ELASTIC
2.1E11, 0.3
*CONDUCTIVITY
45.
*SOLID SECTION, ELSET=LOWER, MATERIAL=STEEL
*SOLID SECTION, ELSET=UPPER, MATERIAL=STEEL
*SURFACE INTERACTION, NAME=FAYING
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
1.E12
*GAP CONDUCTANCE
2600., 0.
2600., 1.E9
*CONTACT PAIR, INTERACTION=FAYING, TYPE={discretisation}
SLAVE, MASTER
*INITIAL CONDITIONS, TYPE=TEMPERATURE
HELD, 40.
*STEP
*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE
1., 1.
*BOUNDARY
HELD, 1, 3
NTOP, 11, 11, 40.
{warm}*NODE PRINT, NSET=NTOP, TOTALS=ONLY
RFL
*NODE FILE
U, NT
*CONTACT FILE
CDIS, CSTR
*END STEP
"
    )
}

/// 120 degrees beside the weld before, 40 far from it, as the sample begins.
pub(crate) const WARM: [f64; 6] = [120.0, 90.0, 70.0, 55.0, 45.0, 40.0];

/// The heat that crosses: what ccx supplies at the upper side, and the sum of HFLA over all slave nodes.
fn heats(discretisation: &str) -> Option<[f64; 2]> {
    let folder = ccx(&twin(discretisation, WARM))?;
    let dat = folder.read("job.dat");
    let printed = dat.split_once("total heat generation for set NTOP").expect("the total").1;
    let supplied = printed.lines().nth(2).and_then(|line| line.trim().parse().ok()).expect("a number");
    let run = folder.inpact(&["eval", "job.inp", "--dialect", "calculix", "--results", "job.frd", "--outputs", "HFLA"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(run.errors.contains("25 rows, 25 closed, 0 open"), "{}", run.errors);
    let values = run.output.lines().skip(1).filter_map(|line| line.rsplit(',').next()?.parse::<f64>().ok());
    let values: Vec<f64> = values.collect();
    assert_eq!(values.len(), 25);
    Some([supplied, values.iter().sum()])
}

#[test]
fn node_to_surface_to_the_digits_of_the_file() {
    let Some([supplied, ours]) = heats("NODE TO SURFACE") else { return };
    // Temperatures have six digits in the `.frd`, and their differences across the interface one less.
    assert!(supplied < -1.0 && (ours - supplied).abs() <= 1e-5 * supplied.abs(), "{ours} for {supplied}");
}

#[test]
fn surface_to_surface_within_what_other_integration_points_make() {
    let Some([supplied, ours]) = heats("SURFACE TO SURFACE") else { return };
    // ccx integrates over points of pieces of faces, where the master's temperature is another than between nodes.
    assert!(supplied < -0.9 && (ours - supplied).abs() <= 0.01 * supplied.abs(), "{ours} for {supplied}");
}
