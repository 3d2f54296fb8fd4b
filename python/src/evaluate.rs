//! Evaluation over Arrow tables of any origin, and over columns of NumPy arrays.

use crate::errors::raise;
use crate::findings::Finding;
use crate::options::one_of;
use crate::watch::{self, Watch};
use inpact::arrow::array::{
    Array, ArrayRef, BooleanArray, Float64Array, Int64Array, RecordBatch, RecordBatchReader, StringArray, StructArray,
};
use inpact::arrow::buffer::NullBuffer;
use inpact::arrow::datatypes::{Field, Schema, SchemaRef};
use inpact::arrow::error::ArrowError;
use inpact::user::{UserConductance, UserConductancePoint, UserConductanceValue, UserFault};
use inpact::{Accuracy, EvaluateOptions, EvaluatedTo, HistoryStart, Regime, Tolerance};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict, PyList};
use pyo3_arrow::PyRecordBatchReader;
use pyo3_arrow::ffi::{ArrayIterator, to_schema_pycapsule, to_stream_pycapsule};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};

/// A result table in memory.
#[pyclass(module = "inpact", frozen)]
pub(crate) struct Result {
    schema: SchemaRef,
    batches: Vec<RecordBatch>,
    findings: Vec<inpact::Diagnostic>,
    notes: Vec<String>,
}

/// Rows to be evaluated.
struct Rows {
    schema: SchemaRef,
    batches: Box<dyn Iterator<Item = std::result::Result<RecordBatch, ArrowError>> + Send>,
}

impl Rows {
    /// From a stream, or from columns of arrays that `inpact._arrays.columns` has made plain.
    fn of(table: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Ok(columns) = table.cast::<PyList>() {
            let batch = record_batch(columns)?;
            return Ok(Self { schema: batch.schema(), batches: Box::new(std::iter::once(Ok(batch))) });
        }
        let reader = table.extract::<PyRecordBatchReader>()?.into_reader()?;
        Ok(Self { schema: reader.schema(), batches: Box::new(reader) })
    }
}

/// A record batch of columns: name, values and mask of what is missing, each.
fn record_batch(columns: &Bound<'_, PyList>) -> PyResult<RecordBatch> {
    let mut fields = Vec::new();
    let mut arrays: Vec<ArrayRef> = Vec::new();
    for column in columns {
        type Column<'py> = (String, Bound<'py, PyAny>, Option<PyReadonlyArray1<'py, bool>>);
        let (name, values, missing): Column<'_> = column.extract()?;
        let missing = missing.as_ref().map(|missing| missing.as_slice()).transpose()?;
        let nulls =
            missing.map(|missing| NullBuffer::from(missing.iter().map(|missing| !missing).collect::<Vec<bool>>()));
        let array: ArrayRef = if let Ok(numbers) = values.extract::<PyReadonlyArray1<'_, f64>>() {
            Arc::new(Float64Array::new(numbers.as_slice()?.to_vec().into(), nulls))
        } else if let Ok(numbers) = values.extract::<PyReadonlyArray1<'_, i64>>() {
            Arc::new(Int64Array::new(numbers.as_slice()?.to_vec().into(), nulls))
        } else if let Ok(truths) = values.extract::<PyReadonlyArray1<'_, bool>>() {
            Arc::new(BooleanArray::new(truths.as_slice()?.to_vec().into(), nulls))
        } else {
            Arc::new(StringArray::from(values.extract::<Vec<Option<String>>>()?))
        };
        fields.push(Field::new(name, array.data_type().clone(), true));
        arrays.push(array);
    }
    RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays)
        .map_err(|error| PyValueError::new_err(error.to_string()))
}

/// The choices of an evaluation, from keyword arguments.
fn options(arguments: &Bound<'_, PyDict>) -> PyResult<EvaluateOptions> {
    let given = |name: &str| PyResult::Ok(arguments.get_item(name)?.filter(|value| !value.is_none()));
    let mut options = EvaluateOptions::new();
    if let Some(outputs) = given("outputs")? {
        options = options.outputs(outputs.extract::<Vec<String>>()?);
    }
    if let Some(interaction) = given("interaction")? {
        options = options.interaction(&interaction.extract::<String>()?);
    }
    if let Some(procedure) = given("procedure")? {
        let regimes = [("steady", Regime::SteadyState), ("transient", Regime::Transient)];
        options = options.regime(one_of("procedure", &procedure.extract::<String>()?, &regimes)?);
    }
    let tolerances = [given("tolerance")?, given("tolerance_relative")?];
    match tolerances {
        [Some(_), Some(_)] => {
            return Err(PyValueError::new_err("`tolerance` and `tolerance_relative` exclude one another"));
        }
        [Some(tolerance), None] => options = options.tolerance(Tolerance::RelativeToLargest(positive(&tolerance)?)),
        [None, Some(tolerance)] => options = options.tolerance(Tolerance::Pointwise(positive(&tolerance)?)),
        [None, None] => {
            if let Some(accuracy) = given("accuracy")? {
                let modes = [("reference", Accuracy::Reference), ("full", Accuracy::Full), ("fast", Accuracy::Fast)];
                options = options.accuracy(one_of("accuracy", &accuracy.extract::<String>()?, &modes)?);
            }
        }
    }
    if given("derivatives")?.is_some_and(|derivatives| derivatives.is_truthy().unwrap_or(false)) {
        options = options.derivatives();
    }
    if let Some(length) = given("char_length")? {
        options = options.characteristic_length(positive(&length)?);
    }
    if let Some(start) = given("history_start")? {
        let starts = [("first-row", HistoryStart::FirstRow), ("at-rest", HistoryStart::AtRest { time: 0.0 })];
        options = options.history_start(one_of("history_start", &start.extract::<String>()?, &starts)?);
    }
    if let Some(threads) = given("threads")? {
        options = options.threads(threads.extract()?);
    }
    Ok(options)
}

fn positive(value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let number: f64 = value.extract()?;
    if 0.0 < number && number.is_finite() {
        return Ok(number);
    }
    Err(PyValueError::new_err(format!("expected a finite number above zero, found {number}")))
}

/// Evaluates the rows of a table; `arguments` are the keyword arguments of `inpact.evaluate`.
pub(crate) fn evaluate(
    py: Python<'_>,
    deck: &inpact::Deck,
    table: &Bound<'_, PyAny>,
    arguments: &Bound<'_, PyDict>,
    progress: Option<Py<PyAny>>,
    user_conductance: Option<Py<PyAny>>,
) -> PyResult<Result> {
    let options = options(arguments)?;
    let rows = Rows::of(table)?;
    let Some(function) = user_conductance else { return run(py, deck, rows, &options, progress) };
    // The function is called once, over arrays of all points: these are found out by an evaluation of their own.
    let watch = Watch::default();
    let schema = rows.schema.clone();
    let batches = watch::run(py, &watch, None, || rows.batches.collect::<std::result::Result<Vec<_>, ArrowError>>())?
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    let again = || Rows { schema: schema.clone(), batches: Box::new(batches.clone().into_iter().map(Ok)) };
    let recorder = Recorder::default();
    run(py, deck, again(), &options.clone().user_conductance(recorder.clone()), None)?;
    let points = recorder.0.lock().unwrap_or_else(PoisonError::into_inner).split_off(0);
    let answers = answers(py, &function, points)?;
    run(py, deck, again(), &options.user_conductance(answers), progress)
}

fn run(
    py: Python<'_>,
    deck: &inpact::Deck,
    rows: Rows,
    options: &EvaluateOptions,
    progress: Option<Py<PyAny>>,
) -> PyResult<Result> {
    let watch = Arc::new(Watch::default());
    let seen = watch.clone();
    let batches = rows
        .batches
        .map(move |batch| if seen.is_stopped() { Err(ArrowError::ComputeError("stopped".to_owned())) } else { batch });
    let mut out = Vec::new();
    let take = |done, batch| {
        out.push(batch);
        if watch.advance(done) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let evaluated = watch::run(py, &watch, progress, || deck.evaluate_to(rows.schema, batches, options, take))?;
    let EvaluatedTo { schema, findings, notes, .. } = evaluated.map_err(|error| raise(py, &error))?;
    Ok(Result { schema, batches: out, findings, notes })
}

impl Result {
    /// A node table, of at least one batch.
    pub(crate) fn of_nodes(batches: Vec<RecordBatch>, notes: Vec<String>) -> Self {
        let schema = batches.first().map_or_else(|| Arc::new(Schema::empty()), RecordBatch::schema);
        Self { schema, batches, findings: Vec::new(), notes }
    }
}

#[pymethods]
impl Result {
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyCapsule>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        let field = Arc::new(Field::new_struct("", self.schema.fields().clone(), false));
        let arrays = self.batches.clone().into_iter().map(|batch| Ok(Arc::new(StructArray::from(batch)) as ArrayRef));
        Ok(to_stream_pycapsule(py, Box::new(ArrayIterator::new(arrays, field)), requested_schema)?)
    }

    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        Ok(to_schema_pycapsule(py, self.schema.as_ref())?)
    }

    #[getter]
    fn num_rows(&self) -> usize {
        self.batches.iter().map(RecordBatch::num_rows).sum()
    }

    fn __len__(&self) -> usize {
        self.num_rows()
    }

    #[getter]
    fn column_names(&self) -> Vec<&str> {
        self.schema.fields().iter().map(|field| field.name().as_str()).collect()
    }

    #[getter]
    fn findings(&self) -> Vec<Finding> {
        self.findings.iter().cloned().map(Finding::from).collect()
    }

    #[getter]
    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }

    /// A column of numbers as a NumPy array, NaN where there is none; of texts as a list.
    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        use inpact::arrow::array::AsArray;
        use inpact::arrow::datatypes::Float64Type;
        let Ok(index) = self.schema.index_of(name) else {
            let names = self.column_names().join(", ");
            return Err(pyo3::exceptions::PyKeyError::new_err(format!(
                "there is no column `{name}`: there are {names}"
            )));
        };
        let failed = |error: ArrowError| PyTypeError::new_err(error.to_string());
        if self.schema.field(index).data_type().is_numeric() {
            let mut values = Vec::with_capacity(self.num_rows());
            for batch in &self.batches {
                let column = inpact::arrow::numbers(batch.column(index)).map_err(failed)?;
                let column = column.as_primitive::<Float64Type>();
                if column.null_count() == 0 {
                    values.extend_from_slice(column.values());
                } else {
                    values.extend(column.iter().map(|value| value.unwrap_or(f64::NAN)));
                }
            }
            return Ok(PyArray1::from_vec(py, values).into_any());
        }
        let texts = PyList::empty(py);
        for batch in &self.batches {
            let column = inpact::arrow::texts(batch.column(index)).map_err(failed)?;
            for text in column.as_string::<i32>() {
                texts.append(text)?;
            }
        }
        Ok(texts.into_any())
    }

    fn __repr__(&self) -> String {
        format!("<Result of {} rows: {}>", self.num_rows(), self.column_names().join(", "))
    }
}

/// A point at which an evaluation needs the user's conductance.
#[derive(Debug)]
struct Point {
    clearance: f64,
    temperatures: [f64; 2],
    field_variables: Vec<[f64; 2]>,
    time: f64,
    node: i32,
    interaction: String,
}

/// Records the points that an evaluation needs, in their order; each conducts nothing.
#[derive(Debug, Clone, Default)]
struct Recorder(Arc<Mutex<Vec<Point>>>);

impl UserConductance for Recorder {
    fn conductance(&self, point: &UserConductancePoint<'_>) -> std::result::Result<UserConductanceValue, UserFault> {
        let interaction = String::from_utf8_lossy(point.names.interaction.as_bytes()).trim_end().to_owned();
        let recorded = Point {
            clearance: point.clearance,
            temperatures: point.temperatures,
            field_variables: point.field_variables.to_vec(),
            time: point.time[1],
            node: point.node,
            interaction,
        };
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(recorded);
        Ok(UserConductanceValue { conductance: 0.0, slopes: [0.0; 2] })
    }
}

/// Results of the function, in the order in which an evaluation asks: that of the rows.
struct Answers {
    values: Vec<UserConductanceValue>,
    next: Mutex<usize>,
}

impl UserConductance for Answers {
    fn conductance(&self, _: &UserConductancePoint<'_>) -> std::result::Result<UserConductanceValue, UserFault> {
        let mut next = self.next.lock().unwrap_or_else(PoisonError::into_inner);
        let answer = self.values.get(*next).copied();
        *next += 1;
        answer.ok_or_else(|| UserFault::Refused("was asked for more points than before".to_owned()))
    }
}

/// Calls the function, once for each interaction, over arrays of its points.
fn answers(py: Python<'_>, function: &Py<PyAny>, points: Vec<Point>) -> PyResult<Answers> {
    let nothing = UserConductanceValue { conductance: 0.0, slopes: [0.0; 2] };
    let mut values = vec![nothing; points.len()];
    let mut of_interaction: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (index, point) in points.iter().enumerate() {
        of_interaction.entry(&point.interaction).or_default().push(index);
    }
    let call = py.import("inpact._arrays")?.getattr("call_user_conductance")?;
    for (interaction, places) in of_interaction {
        let column =
            |of: &dyn Fn(&Point) -> f64| PyArray1::from_iter(py, places.iter().map(|place| of(&points[*place])));
        let sides = |of: &dyn Fn(&Point, usize) -> f64| [column(&|point| of(point, 0)), column(&|point| of(point, 1))];
        let count = places.first().map_or(0, |place| points[*place].field_variables.len());
        let fv: Vec<_> = (0..count).map(|fv| sides(&|point, side| point.field_variables[fv][side])).collect();
        let given = call.call1((
            function,
            interaction,
            column(&|point| point.clearance),
            sides(&|point, side| point.temperatures[side]),
            fv,
            column(&|point| point.time),
            column(&|point| f64::from(point.node)),
        ))?;
        type Given<'py> = [PyReadonlyArray1<'py, f64>; 3];
        let [conductance, of_slave, of_master]: Given<'_> = given.extract()?;
        for ((place, value), slopes) in
            places.iter().zip(conductance.as_slice()?).zip(of_slave.as_slice()?.iter().zip(of_master.as_slice()?))
        {
            values[*place] = UserConductanceValue { conductance: *value, slopes: [*slopes.0, *slopes.1] };
        }
    }
    Ok(Answers { values, next: Mutex::new(0) })
}
