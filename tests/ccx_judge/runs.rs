//! Running ccx and inpact on one deck.

use crate::cubes::{CONDUCTANCE, Cubes};
use crate::program::{Folder, run};
use std::collections::BTreeSet;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The longest run of ccx; two cubes take 20 milliseconds.
const PATIENCE: Duration = Duration::from_secs(10);

/// Outcome of a deck in ccx.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Ccx {
    /// It ran to the end; the heat that must be supplied to the upper and to the lower cube, as it is printed.
    Ran(Option<[String; 2]>),
    /// It stopped; the first error it printed.
    Stopped(String),
}

/// Outcome of a deck in inpact.
#[derive(Debug, Clone)]
pub(crate) struct Inpact {
    /// The codes of the errors that `check` found.
    pub(crate) errors: BTreeSet<String>,
    /// The codes of its warnings.
    pub(crate) warnings: BTreeSet<String>,
    /// The heat that must be supplied to the upper and to the lower cube, or why there is none.
    pub(crate) heats: Result<[f64; 2], String>,
}

/// Whether there is a ccx to be judged by.
pub(crate) fn ccx_is_there() -> bool {
    Command::new("ccx").arg("-v").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok()
}

/// Runs both on a deck.
pub(crate) fn both(cubes: &Cubes) -> (Ccx, Inpact) {
    let folder = Folder::with(&[("job.inp", &cubes.deck())]);
    for (name, text) in &cubes.files {
        folder.write(name, text);
    }
    let found = inpact(&folder, cubes);
    (ccx(&folder, cubes), found)
}

fn ccx(folder: &Folder, cubes: &Cubes) -> Ccx {
    let log = std::fs::File::create(folder.path().join("log")).expect("writable");
    let mut command = Command::new("ccx");
    command.arg("job").current_dir(folder.path()).env("OMP_NUM_THREADS", "1");
    let mut child = command.stdin(Stdio::null()).stdout(log).stderr(Stdio::null()).spawn().expect("ccx starts");
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().expect("ccx can be waited for") {
            break status;
        }
        if PATIENCE < start.elapsed() {
            let _ = child.kill();
            let _ = child.wait();
            return Ccx::Stopped("it does not end".to_owned());
        }
        std::thread::sleep(Duration::from_millis(2));
    };
    let log = String::from_utf8_lossy(&std::fs::read(folder.path().join("log")).expect("a log")).into_owned();
    // Faults in files that ccx finds it prints, and ends with success.
    if status.success() && !log.contains("*ERROR in readinput") {
        return Ccx::Ran(printed_heats(
            cubes,
            &std::fs::read_to_string(folder.path().join("job.dat")).unwrap_or_default(),
        ));
    }
    let mut lines = log.lines().map(str::trim);
    let first = lines.find(|line| line.contains("*ERROR")).map_or_else(|| status.to_string(), str::to_owned);
    let next = lines.next().filter(|line| !line.contains("Card image") && !line.is_empty()).unwrap_or_default();
    Ccx::Stopped(format!("{first} {next}").trim().to_owned())
}

/// The totals of both cubes.
fn printed_heats(cubes: &Cubes, dat: &str) -> Option<[String; 2]> {
    let total = |set: &str| {
        let (_, rest) = dat.split_once(&format!("total heat generation for set {set} "))?;
        Some(rest.lines().skip(1).find(|line| !line.trim().is_empty())?.trim().to_owned())
    };
    let [lower, upper] = cubes.held();
    Some([total(upper)?, total(lower)?])
}

fn inpact(folder: &Folder, cubes: &Cubes) -> Inpact {
    let inpact = |arguments: &[&str]| run(crate::program::command(folder.path(), arguments), b"");
    let checked = inpact(&["check", "--dialect", "calculix", "--format", "concise", "job.inp"]);
    let codes = |severity: &str| {
        let code = |line: &str| Some(line.split_once(severity)?.1.split_once(']')?.0.to_owned());
        checked.output.lines().filter_map(code).collect::<BTreeSet<String>>()
    };
    let (errors, warnings) = (codes(" error["), codes(" warning["));
    assert_eq!(errors.is_empty(), checked.code == 0, "{}\n{}", checked.output, checked.errors);
    let heats = if errors.is_empty() { heats(folder, cubes) } else { Err("the deck has errors".to_owned()) };
    Inpact { errors, warnings, heats }
}

/// The state of the contact at temperatures of the lower and the upper face.
struct Contact {
    /// Heat into the lower and into the upper face.
    heats: [f64; 2],
    conductance: f64,
}

fn contact(folder: &Folder, cubes: &Cubes, temperatures: [f64; 2]) -> Result<Contact, String> {
    folder.write("nodes.csv", &cubes.nodes(temperatures));
    let arguments = ["eval", "job.inp", "--nodes", "nodes.csv", "--dialect", "calculix"];
    let evaluated = run(crate::program::command(folder.path(), &arguments), b"");
    // ccx without a law conducts nothing.
    if evaluated.code == 1 && evaluated.errors.contains("nothing of `job.inp` can be evaluated") {
        return Ok(Contact { heats: [0.0; 2], conductance: 0.0 });
    }
    if evaluated.code != 0 {
        return Err(format!("exit code {}: {}", evaluated.code, evaluated.errors.trim()));
    }
    let mut lines = evaluated.output.lines();
    let (Some(header), Some(row)) = (lines.next(), lines.next()) else { return Err(evaluated.output) };
    let (header, row): (Vec<&str>, Vec<&str>) = (header.split(',').collect(), row.split(',').collect());
    let cell = |name: &str| {
        let place = header.iter().position(|column| *column == name);
        place
            .and_then(|place| row[place].parse::<f64>().ok())
            .ok_or_else(|| format!("no {name} among\n{}", evaluated.output))
    };
    let (slave, master) = (cell("total_heat_s")?, cell("total_heat_m")?);
    let heats = if cubes.slave_is_upper { [master, slave] } else { [slave, master] };
    // There may be friction without conduction.
    let conductance = if header.contains(&"thermal_conductance") { cell("thermal_conductance")? } else { 0.0 };
    Ok(Contact { heats, conductance })
}

/// The heat supplied to the upper and to the lower cube.
///
/// If only the outer faces are held, the temperatures of the contact follow from the balance of each face.
fn heats(folder: &Folder, cubes: &Cubes) -> Result<[f64; 2], String> {
    const MAX_ROUNDS: usize = 50;
    let outer = cubes.temperatures;
    let mut temperatures = outer;
    let mut rounds = if cubes.friction.is_some() { MAX_ROUNDS } else { 0 };
    loop {
        let Contact { heats: [low, high], conductance } = contact(folder, cubes, temperatures)?;
        let conducted = conductance * (temperatures[1] - temperatures[0]);
        let rubbed = [low - conducted, high + conducted];
        if rounds == 0 {
            return Ok([-high, -low]);
        }
        // Each face: CONDUCTANCE * (outer - face) + heat into it = 0, the conductance of the contact as it was.
        let right = [0, 1].map(|side| CONDUCTANCE * outer[side] + rubbed[side]);
        let own = CONDUCTANCE + conductance;
        let determinant = own * own - conductance * conductance;
        let found = [0, 1].map(|side| (own * right[side] + conductance * right[1 - side]) / determinant);
        rounds = if found == temperatures { 0 } else { rounds - 1 };
        temperatures = found;
    }
}

/// Whether a value is what ccx printed with seven digits: within half a unit of the last, and what adding up its contact points may round.
pub(crate) fn is_printed_as(value: f64, printed: &str) -> bool {
    let Ok(number) = printed.parse::<f64>() else { return false };
    if number.abs() < 1e-8 && value == 0.0 {
        return true;
    }
    let Some((_, exponent)) = printed.split_once('E') else { return false };
    let Ok(exponent) = exponent.parse::<i32>() else { return false };
    let unit = 10.0_f64.powi(exponent - 6);
    (value - number).abs() <= 0.501 * unit
}
