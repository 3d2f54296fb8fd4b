//! The command line of generator and measurements: arguments, files, exit codes.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand, ValueEnum};

use inpact_bench::bodies;
use inpact_bench::checking;
use inpact_bench::deck::{self, Content, DeckRequest};
use inpact_bench::editing;
use inpact_bench::extremes;
use inpact_bench::mesh;
use inpact_bench::network::grid::{Assembled, Grid};
use inpact_bench::network::{accuracy, run};
use inpact_bench::nodes::{self, NodesRequest};
use inpact_network::linear::Method;

/// Generates decks and node tables for measurements.
#[derive(Debug, Parser)]
#[command(version)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Write a deck that is valid by the spec.
    Generate {
        /// The deck to write, or `-` for standard output.
        out: PathBuf,
        /// The parts of the deck besides its interactions.
        #[arg(long, value_enum, default_value_t = Kind::Mesh)]
        kind: Kind,
        /// Size of a meshed deck in units of 10^6 bytes [default: 100]; a deck of tables is as large as its rows.
        #[arg(long, value_parser = positive)]
        megabytes: Option<f64>,
        /// Rows of each conductance table, two at least.
        #[arg(long, default_value_t = 20, value_parser = at_least::<2>)]
        rows: usize,
        #[command(flatten)]
        shared: Shared,
    },
    /// Write a node table for the deck generated with the same --interactions and --seed.
    GenerateNodes {
        /// The node table to write (CSV), or `-` for standard output.
        out: PathBuf,
        /// Rows of the node table; with fewer nodes than rows each node has a history.
        #[arg(long)]
        rows: u64,
        /// Number of nodes [default: one for each row].
        #[arg(long, value_parser = clap::value_parser!(u64).range(1..))]
        nodes: Option<u64>,
        /// Rows of each conductance table of the deck.
        #[arg(long, default_value_t = 20, value_parser = at_least::<2>)]
        table_rows: usize,
        #[command(flatten)]
        shared: Shared,
    },
    /// Print the page of extremes: what the evaluation makes of numbers at the ends of f64 (docs/extremes.md).
    Extremes,
    /// Print the page of networks: how exact their solvers are at all contrasts (docs/network.md).
    Network,
    /// Print the page of checking: time and memory of `check` on large decks of tables (docs/check-speed.md).
    Decks {
        /// The program `inpact`, built for release.
        program: PathBuf,
        /// Number of interactions of each deck of tables.
        #[arg(long, default_value_t = 10_000, value_parser = at_least::<1>)]
        interactions: usize,
        /// Rows of each table.
        #[arg(long, default_value_t = 100, value_parser = at_least::<4>)]
        rows: usize,
        /// Runs of each deck; the best counts.
        #[arg(long, default_value_t = 5, value_parser = at_least::<1>)]
        rounds: usize,
    },
    /// Print the page of speed in editors: the latency of the language server of a program (docs/editor-speed.md).
    Editing {
        /// The program `inpact`, built for release.
        program: PathBuf,
        /// Rounds of each measurement; a quarter of them for the largest deck.
        #[arg(long, default_value_t = 200, value_parser = at_least::<1>)]
        rounds: usize,
    },
    /// Solve a grid of nodes with one interface, and print times, memory and quality as JSON.
    Grid {
        #[command(flatten)]
        grid: GridArguments,
        /// The solver.
        #[arg(long, value_enum, default_value_t = SolverName::Direct)]
        solver: SolverName,
        /// The relative error of a flow that is acceptable [default: the last digit].
        #[arg(long, value_parser = positive)]
        tolerance: Option<f64>,
        /// The number of solutions, each from nothing; the fastest counts.
        #[arg(long, default_value_t = 3, value_parser = at_least::<1>)]
        rounds: usize,
    },
    /// Print the page of meshes: how long it takes to read those of so many nodes along an edge, and how much memory (docs/mesh-speed.md).
    Mesh {
        /// Nodes along an edge of the cube.
        #[arg(default_values_t = [22, 100, 215], value_parser = clap::value_parser!(u32).range(3..=1000))]
        sides: Vec<u32>,
    },
    /// Print the page of bodies: what a body with four terminals takes beside one solution of its equations (docs/bodies-speed.md).
    Bodies {
        /// Elements along an edge of the body.
        #[arg(default_values_t = [22, 47, 100], value_parser = clap::value_parser!(u32).range(4..=400))]
        cells: Vec<u32>,
    },
    /// Solve a body once and print its measures.
    #[command(hide = true)]
    BodyOnce {
        /// The deck.
        deck: PathBuf,
        /// How much is solved.
        #[arg(value_enum)]
        work: bodies::Work,
    },
    /// Read the mesh of a deck once and print its measures.
    #[command(hide = true)]
    MeshOnce {
        /// The deck.
        deck: PathBuf,
    },
    /// Write the assembled matrix of a grid in Matrix Market form, for other solvers.
    GridMatrix {
        /// The file to write, or `-` for standard output.
        out: PathBuf,
        #[command(flatten)]
        grid: GridArguments,
    },
}

/// Arguments of a grid.
#[derive(Debug, Clone, Copy, Args)]
struct GridArguments {
    /// Nodes along the first direction, in which the ends are held.
    #[arg(long)]
    nx: u32,
    /// Nodes along the second.
    #[arg(long)]
    ny: u32,
    /// Nodes along the third.
    #[arg(long, default_value_t = 1)]
    nz: u32,
    /// By what the conductances of the interface are larger than those of the bodies.
    #[arg(long, default_value_t = 1.0)]
    contrast: f64,
}

impl GridArguments {
    fn grid(self) -> Grid {
        Grid { size: [self.nx, self.ny, self.nz], contrast: self.contrast }
    }
}

/// The solvers by the names users give them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum SolverName {
    Direct,
    Mixed,
    Iterative,
}

impl SolverName {
    fn method(self) -> Method {
        match self {
            Self::Direct => Method::Direct,
            Self::Mixed => Method::Mixed,
            Self::Iterative => Method::Iterative,
        }
    }
}

/// Options that both generators must be given alike for a deck and its node table.
#[derive(Debug, Clone, Copy, Args)]
struct Shared {
    /// Number of interactions.
    #[arg(long, default_value_t = 50, value_parser = at_least::<1>)]
    interactions: usize,
    /// Seed of all numbers: equal options give equal bytes.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Kind {
    /// Parts of C3D8 elements, sets, surfaces, contact pairs, two steps.
    Mesh,
    /// Nothing: conductance tables only.
    Tables,
}

fn main() -> ExitCode {
    match run(Arguments::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        // The reader has seen enough: `generate - | head`.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            // If standard error is closed as well nobody sees a failure.
            let _ = writeln!(io::stderr(), "error: {error}");
            ExitCode::from(2)
        }
    }
}

fn run(command: Command) -> io::Result<()> {
    match command {
        Command::Generate { out, kind, megabytes, rows, shared } => {
            let content = match (kind, megabytes) {
                (Kind::Mesh, size) => Content::Mesh { bytes: bytes(size.unwrap_or(100.0)) },
                (Kind::Tables, None) => Content::Tables,
                (Kind::Tables, Some(_)) => {
                    return Err(io::Error::new(
                        io::ErrorKind::InvalidInput,
                        "a deck of tables is as large as its rows: give --interactions and --rows, not --megabytes",
                    ));
                }
            };
            let request = deck_request(content, rows, shared);
            let size = deck::write(&request, open(&out)?)?;
            report(&out, size)
        }
        Command::GenerateNodes { out, rows, nodes, table_rows, shared } => {
            let deck = deck_request(Content::Tables, table_rows, shared);
            let interfaces: Vec<_> = deck.interfaces().collect();
            let nodes = nodes.unwrap_or(rows).max(1);
            let request = NodesRequest { rows, nodes, seed: shared.seed };
            let size = nodes::write(&request, &interfaces, open(&out)?)?;
            report(&out, size)
        }
        Command::Extremes => io::stdout().lock().write_all(extremes::page().as_bytes()),
        Command::Network => io::stdout().lock().write_all(accuracy::page().as_bytes()),
        Command::Decks { program, interactions, rows, rounds } => {
            io::stdout().lock().write_all(checking::page(&program, interactions, rows, rounds)?.as_bytes())
        }
        Command::Editing { program, rounds } => {
            io::stdout().lock().write_all(editing::page(&program, rounds)?.as_bytes())
        }
        Command::Grid { grid, solver, tolerance, rounds } => {
            let line = run::run(grid.grid(), solver.method(), tolerance, rounds);
            let line = line.map_err(|failure| io::Error::other(format!("not solved: {failure:?}")))?;
            writeln!(io::stdout(), "{line}")
        }
        Command::Bodies { cells } => io::stdout().lock().write_all(bodies::page(&cells)?.as_bytes()),
        Command::BodyOnce { deck, work } => writeln!(io::stdout(), "{}", bodies::measure(&deck, work)?.line()),
        Command::Mesh { sides } => io::stdout().lock().write_all(mesh::page(&sides)?.as_bytes()),
        Command::MeshOnce { deck } => writeln!(io::stdout(), "{}", mesh::measure(&deck)?.line()),
        Command::GridMatrix { out, grid } => Assembled::of(&grid.grid().network()).write(&mut open(&out)?),
    }
}

fn deck_request(content: Content, rows: usize, shared: Shared) -> DeckRequest {
    DeckRequest { content, interactions: shared.interactions, rows, seed: shared.seed }
}

fn open(path: &Path) -> io::Result<BufWriter<Box<dyn Write>>> {
    let target: Box<dyn Write> = if path == Path::new("-") {
        Box::new(io::stdout().lock())
    } else {
        let file = File::create(path)
            .map_err(|error| io::Error::new(error.kind(), format!("cannot write `{}`: {error}", path.display())))?;
        Box::new(file)
    };
    Ok(BufWriter::with_capacity(1 << 16, target))
}

fn report(path: &Path, size: u64) -> io::Result<()> {
    writeln!(io::stderr(), "{}: {size} bytes", path.display())
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`positive` lets no other number through")]
fn bytes(megabytes: f64) -> u64 {
    (megabytes * 1e6) as u64
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if value > 0.0 && value < 1e9 => Ok(value),
        _ => Err("a number above 0 and below 1e9 is needed".to_owned()),
    }
}

fn at_least<const LEAST: usize>(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(value) if value >= LEAST => Ok(value),
        _ => Err(format!("a whole number of at least {LEAST} is needed")),
    }
}
