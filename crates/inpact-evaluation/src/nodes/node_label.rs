//! Node labels, the keys of histories: whole numbers as `i64`, everything else as text.
//!
//! A number is compared by value, however it is stored: `7` in comma-separated values equals 7 in a column of integers.
//! `007` and `7.0` are labels other than `7`, since their texts differ.

use super::batch::LabelColumn;
#[cfg(feature = "columnar")]
use crate::arrow::array::{Array, Int64Array};
use std::fmt;

/// The label of a node; blanks around it do not count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum NodeLabel<'a> {
    /// A whole number that prints as the text.
    Number(i64),
    /// Any other text, and a number beyond 64 bits.
    Text(&'a [u8]),
}

/// The labels of the nodes of some rows.
#[derive(Debug)]
pub(crate) enum NodeLabels<'a> {
    /// Of a column of integers.
    #[cfg(feature = "columnar")]
    Numbers(Int64Array),
    /// Of any other column.
    Texts(&'a LabelColumn),
}

impl<'a> NodeLabel<'a> {
    /// The label of a cell.
    #[inline]
    pub(crate) fn of_text(text: &'a [u8]) -> Self {
        let text = text.trim_ascii();
        whole_number(text).map_or(Self::Text(text), Self::Number)
    }
}

impl fmt::Display for NodeLabel<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => number.fmt(formatter),
            Self::Text(text) => String::from_utf8_lossy(text).fmt(formatter),
        }
    }
}

impl<'a> NodeLabels<'a> {
    /// Those of a column.
    pub(crate) fn of(column: &'a LabelColumn) -> Self {
        #[cfg(feature = "columnar")]
        if let Some(numbers) = column.array().and_then(super::arrays::whole_numbers) {
            return Self::Numbers(numbers);
        }
        Self::Texts(column)
    }

    /// The label in row `row`.
    #[inline]
    pub(crate) fn get(&self, row: usize) -> NodeLabel<'_> {
        match self {
            #[cfg(feature = "columnar")]
            Self::Numbers(numbers) if numbers.is_valid(row) => NodeLabel::Number(numbers.value(row)),
            #[cfg(feature = "columnar")]
            Self::Numbers(_) => NodeLabel::Text(b""),
            Self::Texts(texts) => NodeLabel::of_text(texts.get(row)),
        }
    }
}

/// The number that prints as this text: without leading zeros, plus sign or minus zero.
#[inline]
fn whole_number(text: &[u8]) -> Option<i64> {
    /// The number of digits that always fits.
    const MAX_DIGITS: usize = 18;
    let (digits, sign) = text.strip_prefix(b"-").map_or((text, 1), |digits| (digits, -1));
    match digits {
        [b'0'] if sign == 1 => return Some(0),
        [b'1'..=b'9', ..] => {}
        _ => return None,
    }
    if MAX_DIGITS < digits.len() {
        return std::str::from_utf8(text).ok()?.parse().ok();
    }
    let number = digits
        .iter()
        .try_fold(0, |number, digit| digit.is_ascii_digit().then(|| 10 * number + i64::from(digit - b'0')));
    number.map(|number| sign * number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn number(text: &str) -> Option<i64> {
        match NodeLabel::of_text(text.as_bytes()) {
            NodeLabel::Number(number) => Some(number),
            NodeLabel::Text(label) => {
                assert_eq!(label, text.trim().as_bytes());
                None
            }
        }
    }

    #[test]
    fn numbers_are_compared_by_value_and_texts_by_their_bytes() {
        let numbers = ["0", " 7 ", "-12", "999999999999999999", "9223372036854775807", "-9223372036854775808"];
        assert_eq!(numbers.map(number), numbers.map(|text| text.trim().parse().ok()));
        for text in ["", " ", "-", "-0", "00", "007", "+7", "7.0", "7e0", "A.7", "1_0", "9223372036854775808", "１"] {
            assert_eq!(number(text), None, "{text}");
        }
    }

    #[cfg(feature = "columnar")]
    #[test]
    fn labels_do_not_depend_on_how_they_are_stored() {
        use crate::arrow::array::{ArrayRef, DictionaryArray, Int8Array, Int32Array, UInt64Array};
        use std::sync::Arc;
        let dictionary = DictionaryArray::new(Int8Array::from(vec![1, 0, 1]), Arc::new(Int32Array::from(vec![-3, 4])));
        let arrays: [ArrayRef; 5] = [
            Arc::new(Int64Array::from(vec![Some(i64::MIN), None, Some(7)])),
            Arc::new(Int8Array::from(vec![-7, 0, 7])),
            Arc::new(UInt64Array::from(vec![Some(7), None, Some(1 << 63)])),
            Arc::new(UInt64Array::from(vec![7, 9])),
            Arc::new(dictionary),
        ];
        for array in arrays {
            let count = array.len();
            let column = LabelColumn::from_array(array);
            let (labels, texts) = (NodeLabels::of(&column), NodeLabels::Texts(&column));
            for row in 0..count {
                assert_eq!(labels.get(row), texts.get(row), "{column:?}");
            }
        }
    }

    proptest! {
        #[test]
        fn a_label_is_a_number_where_that_prints_as_the_label(text in "-?[0-9]{0,20}", number in any::<i64>()) {
            let as_number = text.parse().ok().filter(|number: &i64| number.to_string() == text);
            prop_assert_eq!(super::whole_number(text.as_bytes()), as_number);
            prop_assert_eq!(super::whole_number(number.to_string().as_bytes()), Some(number));
        }
    }
}
