//! Pictures for ParaView: a `.vtu` of the slave surfaces for each state, with every column as point data, and a `.pvd` with their times.

use crate::failure::Failure;
use crate::files::{ResultFile, check_targets};
use inpact_contact::{SlaveFaces, State};
use inpact_evaluation::nodes::Batch;
use inpact_evaluation::results::{Output, ResultBatch};
use inpact_geometry::NodeId;
use inpact_results::vtu::{Array, Moment, write_collection, write_grid};
use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};

/// The sources of a picture: the surfaces, and the states of the rows.
#[derive(Debug)]
pub(crate) struct Drawn {
    pub(crate) faces: SlaveFaces,
    pub(crate) states: Vec<State>,
}

impl Drawn {
    /// One value per row, by state, pair (a position among those of the mesh) and node.
    pub(crate) fn rows(&self, value: impl Fn(&State, usize, NodeId) -> Option<f64>) -> Vec<Option<f64>> {
        let rows =
            self.states.iter().flat_map(|state| self.faces.rows().map(move |(pair, node, _)| (state, pair, node)));
        rows.map(|(state, pair, node)| value(state, pair, node)).collect()
    }

    /// The number of rows of all states.
    pub(crate) fn rows_in_all(&self) -> usize {
        self.states.len() * self.faces.points()
    }

    pub(crate) fn names_and_times(&self) -> (Vec<String>, Vec<Option<f64>>) {
        let rows =
            self.states.iter().flat_map(|state| self.faces.rows().map(move |(.., name)| (name, state.moment.time)));
        rows.map(|(name, time)| (name.to_owned(), time)).unzip()
    }
}

/// Whether a file name ends in `.vtu` or `.pvd`.
pub(crate) fn is_picture(path: &Path) -> bool {
    let extension = path.extension().map(std::ffi::OsStr::to_ascii_lowercase);
    extension.is_some_and(|extension| extension == "vtu" || extension == "pvd")
}

/// Collects the columns of a state, and draws it once it is complete.
pub(crate) struct PictureWriter<'a> {
    drawn: &'a Drawn,
    target: &'a Path,
    names: Vec<String>,
    columns: Vec<Vec<f64>>,
    /// The files so far; they get their names when all of them are complete.
    files: Vec<ResultFile>,
    moments: Vec<Moment>,
}

impl<'a> PictureWriter<'a> {
    /// A picture of columns with these names.
    pub(crate) fn new(drawn: &'a Drawn, target: &'a Path, names: Vec<String>) -> Result<Self, Failure> {
        let columns = vec![Vec::new(); names.len()];
        let writer = Self { drawn, target, names, columns, files: Vec::new(), moments: Vec::new() };
        let targets: Vec<PathBuf> =
            (0..drawn.states.len()).map(|state| writer.path(state)).chain(writer.collection()).collect();
        check_targets(&targets.iter().map(|path| Some(path.as_path())).collect::<Vec<_>>())?;
        Ok(writer)
    }

    /// Adds a row: one value per column.
    pub(crate) fn push(&mut self, values: impl Iterator<Item = Option<f64>>) -> Result<(), Failure> {
        for (column, value) in self.columns.iter_mut().zip(values) {
            column.push(value.unwrap_or(f64::NAN));
        }
        self.draw_if_complete()
    }

    /// Adds rows with their results: the columns of the node table at these indices, then the outputs.
    pub(crate) fn take(
        &mut self,
        batch: &Batch,
        given: &[usize],
        results: &ResultBatch,
        outputs: &[Output],
    ) -> Result<(), Failure> {
        for row in 0..batch.rows {
            let numbers = given.iter().map(|place| batch.numbers[*place].get(row));
            let mut results_of_row = results.numbers.iter().map(|column| column.get(row));
            let outputs = outputs.iter().map(|output| match results.statuses(*output) {
                // A number in the order of `Status`.
                Some(statuses) => statuses[row].map(|status| f64::from(status as u8)),
                None => results_of_row.next().flatten(),
            });
            self.push(numbers.chain(outputs))?;
        }
        Ok(())
    }

    fn draw_if_complete(&mut self) -> Result<(), Failure> {
        let rows = self.columns.first().map_or(0, Vec::len);
        if rows < self.drawn.faces.points() {
            return Ok(());
        }
        let at = self.files.len();
        let Some(state) = self.drawn.states.get(at) else { return Ok(()) };
        let arrays = self.names.iter().zip(&mut self.columns);
        let arrays = arrays.map(|(name, values)| Array::reals(name.clone(), std::mem::take(values))).collect();
        let grid = self.drawn.faces.grid(state, arrays);
        let path = self.path(at);
        let mut file = ResultFile::create(Some(&path))?;
        write_grid(&grid, &mut file).map_err(|error| file.failure(error))?;
        self.files.push(file);
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        #[expect(clippy::cast_precision_loss, reason = "states are counted")]
        let time = state.moment.time.unwrap_or(at as f64);
        self.moments.push(Moment { time, file: name });
        Ok(())
    }

    /// Renames the files to their targets, the list last.
    pub(crate) fn finish(mut self) -> Result<(), Failure> {
        for file in std::mem::take(&mut self.files) {
            file.finish()?;
        }
        let Some(path) = self.collection() else { return Ok(()) };
        let mut file = ResultFile::create(Some(&path))?;
        write_collection(&self.moments, &mut file).map_err(|error: io::Error| file.failure(error))?;
        file.finish()
    }

    /// The picture of a state: the given name if it is the only one, else with its number.
    fn path(&self, state: usize) -> PathBuf {
        if self.collection().is_none() {
            return self.target.to_owned();
        }
        let digits = self.drawn.states.len().to_string().len();
        let mut name: OsString = self.target.file_stem().unwrap_or_default().to_owned();
        name.push(format!("-{:0digits$}.vtu", state + 1));
        self.target.with_file_name(name)
    }

    /// The file that lists the pictures; none for a single one, unless its name is that of a list.
    fn collection(&self) -> Option<PathBuf> {
        let is_requested = self.target.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("pvd"));
        (is_requested || self.drawn.states.len() != 1).then(|| self.target.with_extension("pvd"))
    }
}
