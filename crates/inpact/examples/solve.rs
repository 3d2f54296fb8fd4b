//! Solves a scene and prints the potentials of its nodes.
//!
//! `cargo run -p inpact --example solve -- decks/scenes/two-bodies.toml`

use inpact::{Error, Field, ReadOptions, Scene, SolveOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

fn main() -> Result<(), Error> {
    let sample = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../decks/scenes/two-bodies.toml"));
    let path = std::env::args_os().nth(1).map_or(sample, PathBuf::from);
    let mut output = std::io::stdout().lock();
    for line in potentials(&path)? {
        // Whoever reads the output may stop reading.
        let _ = writeln!(output, "{line}");
    }
    Ok(())
}

fn potentials(path: &Path) -> Result<Vec<String>, Error> {
    let solution = Scene::read(path, &ReadOptions::new())?.solve(&SolveOptions::new())?;
    let mut lines = Vec::new();
    for state in solution.states() {
        let values = state.values(Field::Potential).iter().flatten();
        lines.extend(
            solution.nodes().iter().zip(values).map(|(node, value)| format!("{} s, {node}: {value} V", state.time())),
        );
    }
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    #[test]
    fn the_faces_of_two_bodies() {
        let path = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../decks/scenes/two-bodies.toml"));
        let lines = super::potentials(path).expect("it has a solution");
        assert_eq!(lines[1], "0 s, left-face: 76.19047619047619 V");
    }
}
