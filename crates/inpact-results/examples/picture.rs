//! Writes pictures of a curved strip of faces at three times, and the collection of them, into a folder:
//! `cargo run -p inpact-results --example picture -- FOLDER`

use inpact_results::vtu::{Array, Cell, Grid, Moment, Space, Values, write_collection, write_grid};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::PathBuf;

/// Faces in a row; each fourth is of two triangles.
const FACES: usize = 40;

fn strip(time: f64) -> Grid {
    let point = |at: usize| {
        let (along, side) = ((at / 2) as f64 * 0.1, (at % 2) as f64);
        [along.cos(), along.sin(), side]
    };
    let points: Vec<[f64; 3]> = (0..2 * (FACES + 1)).map(point).collect();
    let cells = (0..FACES).map(|face| 2 * face).flat_map(|first| {
        let corners = [first, first + 2, first + 3, first + 1];
        let cut = if first % 8 == 0 { vec![vec![0, 1, 2], vec![0, 2, 3]] } else { vec![vec![0, 1, 2, 3]] };
        cut.into_iter().map(move |cell| Cell::face(cell.into_iter().map(|at| corners[at]).collect(), Space::Solid))
    });
    let cells: Vec<Cell> = cells.collect();
    let values = |scale: f64| -> Vec<f64> { points.iter().map(|point| scale * time * point[0] / 3.0).collect() };
    Grid {
        point_data: vec![
            Array::integers("node", (1001..).take(points.len()).collect()),
            Array::reals("ECD", values(1.0)),
            Array::reals("HFL & more <1>", values(1e-300)),
            Array { name: "normal".to_owned(), components: 3, values: Values::Reals(points.concat()) },
        ],
        cell_data: vec![Array::integers("face", (0..).take(cells.len()).collect())],
        points,
        cells,
        time: Some(time),
    }
}

fn main() -> io::Result<()> {
    let folder = std::env::args_os().nth(1).map(PathBuf::from);
    let folder = folder.ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "expected a folder"))?;
    let mut moments = Vec::new();
    for (at, time) in [0.0, 0.5, 1.0].into_iter().enumerate() {
        let file = format!("strip_{at}.vtu");
        let mut out = BufWriter::new(File::create(folder.join(&file))?);
        write_grid(&strip(time), &mut out)?;
        out.flush()?;
        moments.push(Moment { time, file });
    }
    write_collection(&moments, &mut File::create(folder.join("strip.pvd"))?)
}
