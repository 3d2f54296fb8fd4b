//! Other implementations on the same tables and queries: the crates interpn and ndarray-interp, numpy and scipy.
//!
//! Those that do not keep the end values outside a table are given queries that have been moved to its ends beforehand, which is not timed.

use std::hint::black_box;
use std::path::Path;
use std::process::Command;

use ndarray::Array1;
use ndarray_interp::interp1d::{Interp1DBuilder, Linear};

use crate::Contender;
use crate::tables::Case;

/// The crates that can evaluate the case; only grids can be compared.
pub(crate) fn of(case: &Case) -> Vec<Contender<'_>> {
    let Some(grid) = &case.grid else { return Vec::new() };
    let rows = case.columns[0].len();
    let columns: Vec<Vec<f64>> = clamped(case, grid);
    let mut contenders = Vec::new();
    // interpn wants the last axis to run fastest.
    let grids: Vec<&[f64]> = grid.iter().rev().map(Vec::as_slice).collect();
    let queries: Vec<Vec<f64>> = columns.iter().rev().cloned().collect();
    let mut values = vec![0.0; rows];
    contenders.push(Contender::new("interpn", move || {
        let queries: Vec<&[f64]> = queries.iter().map(Vec::as_slice).collect();
        let done = interpn::multilinear::rectilinear::interpn(&grids, &case.values, &queries, black_box(&mut values));
        done.expect("the grid is sound");
    }));
    if let ([knots], [queries]) = (&grid[..], &columns[..]) {
        let interpolator = Interp1DBuilder::new(Array1::from(case.values.clone()))
            .x(Array1::from(knots.clone()))
            .strategy(Linear::new())
            .build()
            .expect("the grid is sound");
        let queries = Array1::from(queries.clone());
        let mut values = Array1::zeros(rows);
        contenders.push(Contender::new("ndarray-interp", move || {
            let done = interpolator.interp_array_into(&queries, black_box(&mut values).view_mut());
            done.expect("the queries are within the table");
        }));
    }
    contenders
}

/// Times numpy.interp and scipy's RegularGridInterpolator on the same numbers, if there is a Python that has them.
///
/// `INPACT_PYTHON` names another Python than `python3`.
pub(crate) fn time_python(case: &Case, rounds: usize, copy: f64) {
    let Some(grid) = &case.grid else { return };
    let python = std::env::var("INPACT_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let directory = std::env::temp_dir().join(format!("inpact-bench-{}", std::process::id()));
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("peers/numpy_scipy.py");
    let written = std::fs::create_dir_all(&directory).and_then(|()| {
        write(&directory.join("values"), &case.values)?;
        for (axis, (knots, column)) in grid.iter().zip(clamped(case, grid)).enumerate() {
            write(&directory.join(format!("knots{axis}")), knots)?;
            write(&directory.join(format!("queries{axis}")), &column)?;
        }
        Command::new(python).arg(script).arg(&directory).arg(grid.len().to_string()).arg(rounds.to_string()).output()
    });
    match written {
        Ok(output) if output.status.success() => {
            for line in String::from_utf8_lossy(&output.stdout).lines() {
                let (name, time) = line.split_once('\t').unwrap_or((line, "nan"));
                let time: f64 = time.parse().unwrap_or(f64::NAN);
                println!("| {name} | {time:.2} | {:.2} |", time / copy);
            }
        }
        _ => println!("| numpy and scipy: no python3 that has them | | |"),
    }
    // A folder that cannot be removed stays in the temporary directory.
    let _ = std::fs::remove_dir_all(&directory);
}

fn clamped(case: &Case, grid: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let ends = grid.iter().map(|knots| (knots[0], knots[knots.len() - 1]));
    let columns = case.columns.iter().zip(ends);
    columns.map(|(column, (first, last))| column.iter().map(|x| x.clamp(first, last)).collect()).collect()
}

fn write(path: &Path, numbers: &[f64]) -> std::io::Result<()> {
    let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_ne_bytes()).collect();
    std::fs::write(path, bytes)
}
