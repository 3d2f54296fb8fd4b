//! Some rows of a node table as columns.

use inpact_diagnostics::Place;
use std::ops::Range;

/// Some consecutive rows of a node table: the requested columns, in the requested order.
#[derive(Debug, Clone, Default)]
pub struct Batch {
    /// The number of rows.
    pub rows: usize,
    /// The number of the first row, counted from 0.
    pub first_row: u64,
    /// The line of the file on which each row ends, from 1.
    pub lines: Vec<u64>,
    /// The columns of texts.
    pub labels: Vec<LabelColumn>,
    /// The columns of numbers.
    pub numbers: Vec<NumberColumn>,
}

/// A column of texts, unchanged.
#[derive(Debug, Clone, Default)]
pub struct LabelColumn {
    texts: Texts,
    /// The stored array, for columnar files; its texts are made lazily.
    #[cfg(feature = "columnar")]
    array: Option<(crate::arrow::array::ArrayRef, std::sync::OnceLock<Texts>)>,
}

/// Concatenated texts.
#[derive(Debug, Clone, Default)]
struct Texts {
    bytes: Vec<u8>,
    ends: Vec<usize>,
}

/// A column of numbers, some of which may be missing.
#[derive(Debug, Clone, Default)]
pub struct NumberColumn {
    /// NaN where the number is missing.
    values: Values,
    /// Flags of the numbers present; empty where all of them are.
    present: Vec<bool>,
}

/// Owned numbers, or a shared array, copied on write.
#[derive(Debug, Clone)]
enum Values {
    Owned(Vec<f64>),
    #[cfg(feature = "columnar")]
    Shared(arrow_buffer::ScalarBuffer<f64>),
}

impl Values {
    /// The numbers as a mutable vector.
    #[inline]
    fn owned(&mut self) -> &mut Vec<f64> {
        #[cfg(feature = "columnar")]
        if let Self::Shared(buffer) = self {
            *self = Self::Owned(buffer.to_vec());
        }
        match self {
            Self::Owned(values) => values,
            #[cfg(feature = "columnar")]
            Self::Shared(_) => unreachable!("shared numbers have just been copied"),
        }
    }

    /// An empty vector; an owned allocation is kept.
    fn clear(&mut self) {
        match self {
            Self::Owned(values) => values.clear(),
            #[cfg(feature = "columnar")]
            Self::Shared(_) => *self = Self::default(),
        }
    }

    /// Their size in bytes.
    fn size(&self) -> usize {
        let count = match self {
            Self::Owned(values) => values.capacity(),
            #[cfg(feature = "columnar")]
            Self::Shared(buffer) => buffer.len(),
        };
        size_of::<f64>() * count
    }
}

impl Default for Values {
    fn default() -> Self {
        Self::Owned(Vec::new())
    }
}

impl std::ops::Deref for Values {
    type Target = [f64];

    #[inline]
    fn deref(&self) -> &[f64] {
        match self {
            Self::Owned(values) => values,
            #[cfg(feature = "columnar")]
            Self::Shared(buffer) => buffer,
        }
    }
}

impl LabelColumn {
    /// The text in row `row` of the batch.
    #[inline]
    pub fn get(&self, row: usize) -> &[u8] {
        #[cfg(feature = "columnar")]
        if let Some((array, texts)) = &self.array {
            return texts.get_or_init(|| Texts::of_array(array)).get(row);
        }
        self.texts.get(row)
    }

    /// The same texts of some rows.
    fn gather(&self, rows: &[u32]) -> Self {
        #[cfg(feature = "columnar")]
        if let Some(array) = self.array().and_then(|array| super::arrays::gathered(array, rows)) {
            return Self::from_array(array);
        }
        let mut gathered = Self::default();
        for row in rows {
            gathered.push(self.get(*row as usize));
        }
        gathered
    }

    /// Adds a row.
    #[inline]
    pub fn push(&mut self, text: &[u8]) {
        self.texts.push(text);
    }

    /// Makes it a column of this many rows with the same text.
    pub(crate) fn fill(&mut self, text: &[u8], rows: usize) {
        self.clear();
        (0..rows).for_each(|_| self.texts.push(text));
    }

    /// A column of concatenated texts with these ends.
    pub(super) fn from_texts(bytes: Vec<u8>, ends: Vec<usize>) -> Self {
        Self {
            texts: Texts { bytes, ends },
            #[cfg(feature = "columnar")]
            array: None,
        }
    }

    /// The concatenated texts, and their ends.
    pub(super) fn texts(&self) -> (&[u8], &[usize]) {
        (&self.texts.bytes, &self.texts.ends)
    }

    /// How many bytes of memory it takes.
    fn size(&self) -> usize {
        #[cfg(feature = "columnar")]
        if let Some((array, _)) = &self.array {
            return array.get_array_memory_size();
        }
        self.texts.bytes.capacity() + size_of::<usize>() * self.texts.ends.capacity()
    }

    pub(super) fn clear(&mut self) {
        self.texts.bytes.clear();
        self.texts.ends.clear();
        #[cfg(feature = "columnar")]
        {
            self.array = None;
        }
    }
}

#[cfg(feature = "columnar")]
impl LabelColumn {
    /// The column of an array of texts or numbers.
    pub(super) fn from_array(array: crate::arrow::array::ArrayRef) -> Self {
        Self { texts: Texts::default(), array: Some((array, std::sync::OnceLock::new())) }
    }

    /// The array it was made from.
    pub(crate) fn array(&self) -> Option<&crate::arrow::array::ArrayRef> {
        self.array.as_ref().map(|(array, _)| array)
    }
}

impl Texts {
    #[inline]
    fn get(&self, row: usize) -> &[u8] {
        let start = if row == 0 { 0 } else { self.ends[row - 1] };
        &self.bytes[start..self.ends[row]]
    }

    #[inline]
    fn push(&mut self, text: &[u8]) {
        self.bytes.extend_from_slice(text);
        self.ends.push(self.bytes.len());
    }

    /// The texts of an array: floats as printed in a result table, nulls as empty texts.
    #[cfg(feature = "columnar")]
    fn of_array(array: &crate::arrow::array::ArrayRef) -> Self {
        use super::arrays;
        use crate::arrow::array::{Array, AsArray, StringArray};
        use crate::arrow::datatypes::{DataType, Float64Type, Int64Type, UInt64Type};
        let mut texts = Self::default();
        let values = match array.data_type() {
            DataType::Dictionary(_, values) => values.as_ref(),
            kind => kind,
        };
        if values.is_floating() {
            let numbers = arrays::numbers(array).unwrap_or_else(|_| array.slice(0, 0));
            for value in numbers.as_primitive::<Float64Type>() {
                if let Some(value) = value {
                    crate::results::push_number(&mut texts.bytes, value);
                }
                texts.ends.push(texts.bytes.len());
            }
        } else if values.is_unsigned_integer() {
            let numbers = arrays::unsigned(array).unwrap_or_else(|_| array.slice(0, 0));
            for value in numbers.as_primitive::<UInt64Type>() {
                if let Some(value) = value {
                    push_digits(&mut texts.bytes, value);
                }
                texts.ends.push(texts.bytes.len());
            }
        } else if values.is_integer() {
            let numbers = arrays::signed(array).unwrap_or_else(|_| array.slice(0, 0));
            for value in numbers.as_primitive::<Int64Type>() {
                if let Some(value) = value {
                    if value < 0 {
                        texts.bytes.push(b'-');
                    }
                    push_digits(&mut texts.bytes, value.unsigned_abs());
                }
                texts.ends.push(texts.bytes.len());
            }
        } else {
            let strings = arrays::texts(array);
            // The reader rejects types without a text form.
            let strings = strings.unwrap_or_else(|_| std::sync::Arc::new(StringArray::new_null(array.len())));
            strings.as_string::<i32>().iter().for_each(|text| texts.push(text.unwrap_or_default().as_bytes()));
        }
        texts
    }
}

/// Adds an integer.
#[cfg(feature = "columnar")]
fn push_digits(text: &mut Vec<u8>, mut number: u64) {
    let mut digits = [0; 20];
    let mut first = digits.len();
    loop {
        first -= 1;
        digits[first] = b'0' + (number % 10) as u8;
        number /= 10;
        if number == 0 {
            break;
        }
    }
    text.extend_from_slice(&digits[first..]);
}

impl NumberColumn {
    /// A column of numbers with flags of those present: none is missing without flags.
    #[cfg(feature = "columnar")]
    pub(super) fn from_parts(mut values: Vec<f64>, present: Vec<bool>) -> Self {
        for (value, present) in values.iter_mut().zip(&present) {
            *value = if *present { *value } else { f64::NAN };
        }
        Self { values: Values::Owned(values), present }
    }

    /// The column of an array of which no number is missing; its memory is taken over if it is not shared, and shared otherwise.
    #[cfg(feature = "columnar")]
    pub(super) fn of_buffer(buffer: arrow_buffer::ScalarBuffer<f64>) -> Self {
        let values = match buffer.into_inner().into_vec() {
            Ok(values) => Values::Owned(values),
            Err(shared) => Values::Shared(shared.into()),
        };
        Self { values, present: Vec::new() }
    }

    /// The number in row `row` of the batch; `None` where it is missing.
    #[inline]
    pub fn get(&self, row: usize) -> Option<f64> {
        let value = self.values[row];
        (self.present.is_empty() || self.present[row]).then_some(value)
    }

    /// The numbers, NaN where one is missing.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The numbers, mutable; which of them are missing is unchanged.
    pub fn values_mut(&mut self) -> &mut [f64] {
        self.values.owned()
    }

    /// Which numbers are present, one flag per row; `None` where it is known that none is missing.
    pub fn presence(&self) -> Option<&[bool]> {
        Some(self.present.as_slice()).filter(|present| !present.is_empty())
    }

    /// Adds a row.
    #[inline]
    pub fn push(&mut self, value: Option<f64>) {
        if value.is_none() && self.present.is_empty() {
            self.present.resize(self.values.len(), true);
            self.present.push(false);
        } else if !self.present.is_empty() {
            self.present.push(value.is_some());
        }
        self.values.owned().push(value.unwrap_or(f64::NAN));
    }

    /// Adds rows: their numbers, and flags for those present; `None` where all of them are.
    ///
    /// A missing number becomes NaN.
    ///
    /// # Panics
    /// If the numbers of flags and numbers differ.
    pub fn extend_from_slices(&mut self, values: &[f64], present: Option<&[bool]>) {
        let before = self.values.len();
        self.values.owned().extend_from_slice(values);
        let Some(present) = present else {
            if !self.present.is_empty() {
                self.present.resize(self.values.len(), true);
            }
            return;
        };
        assert_eq!(values.len(), present.len(), "a flag for every number");
        if self.present.is_empty() {
            self.present.resize(before, true);
        }
        self.present.extend_from_slice(present);
        for (value, present) in self.values.owned()[before..].iter_mut().zip(present) {
            *value = if *present { *value } else { f64::NAN };
        }
    }

    /// Sets the number of an existing row.
    #[inline]
    pub fn set(&mut self, row: usize, value: f64) {
        self.values.owned()[row] = value;
        if let Some(present) = self.present.get_mut(row) {
            *present = true;
        }
    }

    /// Sets the numbers of some rows.
    #[inline]
    pub(crate) fn set_rows(&mut self, rows: Range<usize>, numbers: impl Iterator<Item = f64>) {
        if let Some(present) = self.present.get_mut(rows.clone()) {
            present.fill(true);
        }
        self.values.owned()[rows].iter_mut().zip(numbers).for_each(|(value, number)| *value = number);
    }

    /// Drops the flags of a column without missing numbers.
    pub(crate) fn settle(&mut self) {
        if !self.present.contains(&false) {
            self.present.clear();
        }
    }

    /// Marks all numbers as present: all of them have been set.
    pub(crate) fn set_all_present(&mut self) {
        self.present.clear();
    }

    /// The numbers of some rows.
    pub(crate) fn gather(&self, rows: &[u32]) -> Self {
        Self {
            values: Values::Owned(rows.iter().map(|row| self.values[*row as usize]).collect()),
            present: match self.present.as_slice() {
                [] => Vec::new(),
                present => rows.iter().map(|row| present[*row as usize]).collect(),
            },
        }
    }

    /// Scatters the numbers of some rows, those present, into `whole`.
    pub(crate) fn scatter(&self, rows: &[u32], whole: &mut Self) {
        for (index, row) in rows.iter().enumerate() {
            if let Some(value) = self.get(index) {
                whole.set(*row as usize, value);
            }
        }
    }

    /// Makes it a column of this many missing numbers.
    pub fn reset(&mut self, rows: usize) {
        self.values.clear();
        self.values.owned().resize(rows, f64::NAN);
        self.present.clear();
        self.present.resize(rows, false);
    }

    /// Makes it a column of this many numbers, all of which are about to be set.
    pub(crate) fn shape(&mut self, rows: usize) {
        self.present.clear();
        match &mut self.values {
            Values::Owned(values) => values.resize(rows, f64::NAN),
            #[cfg(feature = "columnar")]
            Values::Shared(_) => self.values = Values::Owned(vec![f64::NAN; rows]),
        }
    }

    /// How many bytes of memory it takes.
    fn size(&self) -> usize {
        self.values.size() + self.present.capacity()
    }

    pub(super) fn clear(&mut self) {
        self.values.clear();
        self.present.clear();
    }

    /// Takes the numbers and their flags, leaving reusable memory with arbitrary contents.
    #[cfg(feature = "columnar")]
    pub(crate) fn take(&mut self, room: Vec<f64>) -> (Vec<f64>, Option<Vec<bool>>) {
        let present = std::mem::take(&mut self.present);
        (std::mem::replace(self.values.owned(), room), Some(present).filter(|present| !present.is_empty()))
    }
}

impl Batch {
    /// An empty batch with this many columns of each kind.
    pub fn with_columns(labels: usize, numbers: usize) -> Self {
        Self {
            rows: 0,
            first_row: 0,
            lines: Vec::new(),
            labels: vec![LabelColumn::default(); labels],
            numbers: vec![NumberColumn::default(); numbers],
        }
    }

    /// The position of row `row` of the batch in the file.
    pub fn place(&self, row: usize, column: Option<String>) -> Place {
        let line = self.lines.get(row).copied();
        Place { row: Some(self.first_row + row as u64 + 1), line, column, exact: None }
    }

    /// Some of its rows as a batch, without their lines and with these columns of texts alone.
    pub(crate) fn gather(&self, rows: &[u32], labels: &[usize]) -> Self {
        let mut gathered = Self::with_columns(self.labels.len(), 0);
        gathered.rows = rows.len();
        gathered.numbers = self.numbers.iter().map(|column| column.gather(rows)).collect();
        for place in labels {
            gathered.labels[*place] = self.labels[*place].gather(rows);
        }
        gathered
    }

    /// The size of its rows in bytes.
    pub(super) fn size(&self) -> usize {
        let labels: usize = self.labels.iter().map(LabelColumn::size).sum();
        let numbers: usize = self.numbers.iter().map(NumberColumn::size).sum();
        labels + numbers + size_of::<u64>() * self.lines.capacity()
    }

    /// The same rows with other columns: those at these indices, each at most once; `None` for an empty one.
    pub(super) fn with_selected(mut self, labels: &[Option<usize>], numbers: &[Option<usize>]) -> Self {
        let label = |place: &Option<usize>| match place {
            Some(place) => std::mem::take(&mut self.labels[*place]),
            None => LabelColumn::from_texts(Vec::new(), vec![0; self.rows]),
        };
        let labels = labels.iter().map(label).collect();
        let number = |place: &Option<usize>| match place {
            Some(place) => std::mem::take(&mut self.numbers[*place]),
            None => {
                let mut column = NumberColumn::default();
                column.reset(self.rows);
                column
            }
        };
        let numbers = numbers.iter().map(number).collect();
        Self { labels, numbers, ..self }
    }

    /// Reserves memory for the numbers of this many rows.
    pub(super) fn reserve(&mut self, rows: usize) {
        self.lines.reserve(rows);
        self.numbers.iter_mut().for_each(|column| column.values.owned().reserve(rows));
    }

    /// Resets it to an empty batch with this many columns of each kind; allocations are kept.
    pub(super) fn clear(&mut self, labels: usize, numbers: usize) {
        self.rows = 0;
        self.first_row = 0;
        self.lines.clear();
        self.labels.iter_mut().for_each(LabelColumn::clear);
        self.numbers.iter_mut().for_each(NumberColumn::clear);
        self.labels.resize_with(labels, LabelColumn::default);
        self.numbers.resize_with(numbers, NumberColumn::default);
    }
}

#[cfg(all(test, feature = "columnar"))]
mod tests {
    use super::*;
    use crate::arrow::array::{ArrayRef, Int64Array, UInt8Array, UInt64Array};
    use std::sync::Arc;

    #[test]
    fn labels_of_whole_numbers_are_their_digits() {
        let signed = Int64Array::from(vec![Some(i64::MIN), Some(-7), Some(0), None, Some(10), Some(i64::MAX)]);
        let arrays: [ArrayRef; 3] = [
            Arc::new(signed),
            Arc::new(UInt64Array::from(vec![u64::MAX, 100])),
            Arc::new(UInt8Array::from(vec![255, 9])),
        ];
        let texts = arrays.map(|array| {
            let count = crate::arrow::array::Array::len(&array);
            let column = LabelColumn::from_array(array);
            (0..count).map(|row| String::from_utf8_lossy(column.get(row)).into_owned()).collect::<Vec<_>>().join(" ")
        });
        let expected = [
            "-9223372036854775808 -7 0  10 9223372036854775807".to_owned(),
            format!("{} 100", u64::MAX),
            "255 9".to_owned(),
        ];
        assert_eq!(texts, expected);
    }
}
