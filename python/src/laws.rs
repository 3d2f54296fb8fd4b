//! The laws of an interaction over NumPy arrays.

use inpact::{Against, ContactColumns};
use numpy::{PyArray1, PyReadonlyArray1, PyReadwriteArray1};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat, PyInt, PyList, PyTuple};

/// The gap electrical conductance of an interaction.
#[pyclass(module = "inpact", frozen)]
pub(crate) struct GapConductance {
    interaction: String,
    gap: inpact::GapConductance,
}

/// Points with up to so many field variables are evaluated without an allocation.
const FEW: usize = 8;

impl GapConductance {
    pub(crate) fn new(interaction: &str, gap: inpact::GapConductance) -> Self {
        Self { interaction: interaction.to_owned(), gap }
    }

    /// A number that is a plain Python number; `Err` for anything else, which goes the way of arrays.
    fn plain(value: &Bound<'_, PyAny>) -> Result<f64, ()> {
        if let Ok(number) = value.cast_exact::<PyFloat>() {
            return Ok(number.extract().unwrap_or(f64::NAN));
        }
        if value.cast_exact::<PyInt>().is_ok() {
            return value.extract().map_err(drop);
        }
        Err(())
    }

    /// The conductance where every argument is a plain number, and all that it depends on is there.
    fn at_point(
        &self,
        clearance: Option<&Bound<'_, PyAny>>,
        pressure: Option<&Bound<'_, PyAny>>,
        temperature: Option<&Bound<'_, PyAny>>,
        fv: Option<&Bound<'_, PyAny>>,
    ) -> Result<f64, ()> {
        let number = |value: Option<&Bound<'_, PyAny>>| value.map(Self::plain).transpose();
        let (clearance, pressure) = (number(clearance)?, number(pressure)?);
        if clearance.is_none() && pressure.is_none() {
            return Err(());
        }
        let mut variables = [f64::NAN; FEW];
        let depends_on = self.gap.depends_on();
        let count = depends_on.len();
        if FEW < count {
            return Err(());
        }
        let mut given = [false; FEW];
        if let Some(temperature) = number(temperature)? {
            (variables[0], given[0]) = (temperature, true);
        }
        if let Some(fv) = fv {
            let mut set = |index: usize, value: &Bound<'_, PyAny>| -> Result<(), ()> {
                let place = index + 1;
                if count <= place {
                    return Err(());
                }
                (variables[place], given[place]) = (Self::plain(value)?, true);
                Ok(())
            };
            if let Ok(list) = fv.cast_exact::<PyList>() {
                for (index, value) in list.iter().enumerate() {
                    set(index, &value)?;
                }
            } else if let Ok(tuple) = fv.cast_exact::<PyTuple>() {
                for (index, value) in tuple.iter().enumerate() {
                    set(index, &value)?;
                }
            } else {
                set(0, fv)?;
            }
        }
        if depends_on.iter().zip(&given).any(|(depends, given)| *depends && !given) {
            return Err(());
        }
        Ok(self.gap.at(clearance, pressure, &variables[..count]))
    }
}

#[pymethods]
impl GapConductance {
    #[getter]
    fn interaction(&self) -> &str {
        &self.interaction
    }

    /// Whether there are tables against clearance and against pressure.
    #[getter]
    fn tables(&self) -> Vec<&'static str> {
        let both = [("clearance", Against::Clearance), ("pressure", Against::Pressure)];
        both.into_iter().filter(|(_, against)| self.gap.has(*against)).map(|(name, _)| name).collect()
    }

    /// Whether the value depends on the temperature, then on each field variable.
    #[getter]
    fn depends_on(&self) -> Vec<bool> {
        self.gap.depends_on().to_vec()
    }

    /// The conductance of plain numbers as a float; anything else goes to `inpact._arrays.conductance`.
    #[pyo3(signature = (clearance=None, pressure=None, temperature=None, fv=None, *, derivatives=false))]
    fn conductance<'py>(
        slf: &Bound<'py, Self>,
        clearance: Option<&Bound<'py, PyAny>>,
        pressure: Option<&Bound<'py, PyAny>>,
        temperature: Option<&Bound<'py, PyAny>>,
        fv: Option<&Bound<'py, PyAny>>,
        derivatives: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = slf.py();
        if !derivatives && let Ok(value) = slf.get().at_point(clearance, pressure, temperature, fv) {
            return Ok(PyFloat::new(py, value).into_any());
        }
        let arrays = py.import("inpact._arrays")?.getattr("conductance")?;
        arrays.call1((slf, clearance, pressure, temperature, fv, derivatives))
    }

    /// The conductance over contiguous columns of equal length, into one of that length.
    fn values<'py>(
        &self,
        py: Python<'py>,
        rows: usize,
        clearance: Option<PyReadonlyArray1<'py, f64>>,
        pressure: Option<PyReadonlyArray1<'py, f64>>,
        variables: Vec<Option<PyReadonlyArray1<'py, f64>>>,
        mut out: PyReadwriteArray1<'py, f64>,
    ) -> PyResult<()> {
        let out = out.as_slice_mut()?;
        let clearance = clearance.as_ref().map(|column| column.as_slice()).transpose()?;
        let pressure = pressure.as_ref().map(|column| column.as_slice()).transpose()?;
        let variables = slices(&variables)?;
        self.check_columns(rows, &[clearance, pressure, Some(&*out)], &variables)?;
        let columns = ContactColumns { clearance, pressure, variables: &variables };
        py.detach(|| self.gap.values(&columns, out));
        Ok(())
    }

    /// The slopes over contiguous columns of equal length, by the names of what they are along.
    fn slopes<'py>(
        &self,
        py: Python<'py>,
        rows: usize,
        clearance: Option<PyReadonlyArray1<'py, f64>>,
        pressure: Option<PyReadonlyArray1<'py, f64>>,
        variables: Vec<Option<PyReadonlyArray1<'py, f64>>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let clearance = clearance.as_ref().map(|column| column.as_slice()).transpose()?;
        let pressure = pressure.as_ref().map(|column| column.as_slice()).transpose()?;
        let variables = slices(&variables)?;
        self.check_columns(rows, &[clearance, pressure], &variables)?;
        let count = self.gap.depends_on().len();
        let mut along: Vec<Vec<f64>> = vec![vec![0.0; rows]; 2 + count];
        py.detach(|| {
            let (mut point, mut slopes) = (vec![f64::NAN; count], vec![0.0; count]);
            for row in 0..rows {
                for (place, column) in point.iter_mut().zip(&variables) {
                    *place = column.get(row).copied().unwrap_or(f64::NAN);
                }
                let contact = (clearance.map(|column| column[row]), pressure.map(|column| column[row]));
                let found = self.gap.slopes_at(contact, &point, &mut slopes);
                for (column, slope) in along.iter_mut().zip(found.iter().chain(&slopes)) {
                    column[row] = *slope;
                }
            }
        });
        let names = ["clearance", "pressure", "temperature"].map(str::to_owned);
        let names = names.into_iter().chain((1..count.max(1)).map(|number| format!("fv{number}")));
        let dict = PyDict::new(py);
        for (name, column) in names.zip(along) {
            dict.set_item(name, PyArray1::from_vec(py, column))?;
        }
        Ok(dict)
    }

    /// One table by itself over contiguous columns of equal length, into one of that length.
    fn table_values<'py>(
        &self,
        py: Python<'py>,
        against: &str,
        rows: usize,
        columns: Vec<Option<PyReadonlyArray1<'py, f64>>>,
        mut out: PyReadwriteArray1<'py, f64>,
    ) -> PyResult<()> {
        let against = self.against(against)?;
        let out = out.as_slice_mut()?;
        let columns = slices(&columns)?;
        self.check_columns(rows, &[columns.first().copied(), Some(&*out)], columns.get(1..).unwrap_or_default())?;
        py.detach(|| self.gap.table_values(against, &columns, out));
        Ok(())
    }

    /// The abscissae of a table.
    fn abscissae<'py>(&self, py: Python<'py>, against: &str) -> PyResult<Bound<'py, PyArray1<f64>>> {
        Ok(PyArray1::from_slice(py, self.gap.abscissae(self.against(against)?)))
    }

    fn __repr__(&self) -> String {
        format!("<GapConductance of {:?} against {}>", self.interaction, self.tables().join(" and "))
    }
}

impl GapConductance {
    fn against(&self, name: &str) -> PyResult<Against> {
        let against = match name {
            "clearance" => Against::Clearance,
            "pressure" => Against::Pressure,
            other => {
                let message = format!("expected `clearance` or `pressure`, found `{other}`");
                return Err(pyo3::exceptions::PyValueError::new_err(message));
            }
        };
        if self.gap.has(against) {
            return Ok(against);
        }
        let message = format!("`{}` has no table against {name}", self.interaction);
        Err(pyo3::exceptions::PyKeyError::new_err(message))
    }

    /// Refuses columns of another length than there are rows, and lets none be missing that the value depends on.
    fn check_columns(&self, rows: usize, contact: &[Option<&[f64]>], variables: &[&[f64]]) -> PyResult<()> {
        let wrong = |column: &&[f64]| column.len() != rows;
        if let Some(column) = contact.iter().flatten().find(|column| wrong(column)) {
            return Err(PyTypeError::new_err(format!("a column has {} rows, expected {rows}", column.len())));
        }
        for (place, depends) in self.gap.depends_on().iter().enumerate() {
            let column = variables.get(place).copied().unwrap_or_default();
            if wrong(&column) && (*depends || !column.is_empty()) {
                let message = format!("variable {place} has {} rows, expected {rows}", column.len());
                return Err(PyTypeError::new_err(message));
            }
        }
        Ok(())
    }
}

/// The slices of columns; an empty one for a column that is not given.
fn slices<'a>(columns: &'a [Option<PyReadonlyArray1<'_, f64>>]) -> PyResult<Vec<&'a [f64]>> {
    let slice = |column: &'a Option<PyReadonlyArray1<'_, f64>>| match column {
        Some(column) => Ok(column.as_slice()?),
        None => Ok(&[][..]),
    };
    columns.iter().map(slice).collect()
}
