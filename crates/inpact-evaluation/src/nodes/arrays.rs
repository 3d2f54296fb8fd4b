//! Arrow arrays as the types of node tables: numbers as f64, labels as integers or texts; dictionaries as their values.
//!
//! Only the casts that are needed; those of Arrow between all types are a large library.

use crate::arrow::array::{
    Array, ArrayRef, ArrowPrimitiveType, AsArray, Float64Array, Int64Array, PrimitiveArray, StringArray, UInt32Array,
};
use crate::arrow::datatypes::{
    DataType, Float16Type, Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, UInt8Type, UInt16Type,
    UInt32Type, UInt64Type,
};
use crate::arrow::error::ArrowError;
use arrow_select::take::take;
use std::sync::Arc;

/// The array itself, or, for a dictionary, the value of each row.
///
/// # Errors
/// A dictionary with keys out of range.
pub fn without_dictionary(array: &ArrayRef) -> Result<ArrayRef, ArrowError> {
    let mut array = Arc::clone(array);
    while let Some(dictionary) = array.as_any_dictionary_opt() {
        array = take(dictionary.values(), dictionary.keys(), None)?;
    }
    Ok(array)
}

/// Floats, integers, booleans (0 and 1), or dictionaries of these, each as the nearest f64.
///
/// # Errors
/// An array of another type.
pub fn numbers(array: &ArrayRef) -> Result<ArrayRef, ArrowError> {
    let array = without_dictionary(array)?;
    Ok(match array.data_type() {
        DataType::Float64 => array,
        DataType::Float32 => converted::<Float32Type, Float64Type>(&array, f64::from),
        DataType::Float16 => converted::<Float16Type, Float64Type>(&array, f64::from),
        kind if kind.is_unsigned_integer() => {
            converted::<UInt64Type, Float64Type>(&unsigned(&array)?, |value| value as f64)
        }
        kind if kind.is_integer() => converted::<Int64Type, Float64Type>(&signed(&array)?, |value| value as f64),
        DataType::Boolean => {
            let numbers = array.as_boolean().iter().map(|value| value.map(|value| f64::from(u8::from(value))));
            Arc::new(numbers.collect::<Float64Array>())
        }
        DataType::Null => Arc::new(Float64Array::new_null(array.len())),
        kind => return Err(ArrowError::CastError(format!("expected numbers, found {kind}"))),
    })
}

/// Whole numbers without a sign as u64.
pub(super) fn unsigned(array: &ArrayRef) -> Result<ArrayRef, ArrowError> {
    let array = without_dictionary(array)?;
    Ok(match array.data_type() {
        DataType::UInt64 => array,
        DataType::UInt32 => converted::<UInt32Type, UInt64Type>(&array, u64::from),
        DataType::UInt16 => converted::<UInt16Type, UInt64Type>(&array, u64::from),
        DataType::UInt8 => converted::<UInt8Type, UInt64Type>(&array, u64::from),
        kind => return Err(ArrowError::CastError(format!("expected whole numbers without a sign, found {kind}"))),
    })
}

/// Whole numbers with a sign as i64.
pub(super) fn signed(array: &ArrayRef) -> Result<ArrayRef, ArrowError> {
    let array = without_dictionary(array)?;
    Ok(match array.data_type() {
        DataType::Int64 => array,
        DataType::Int32 => converted::<Int32Type, Int64Type>(&array, i64::from),
        DataType::Int16 => converted::<Int16Type, Int64Type>(&array, i64::from),
        DataType::Int8 => converted::<Int8Type, Int64Type>(&array, i64::from),
        kind => return Err(ArrowError::CastError(format!("expected whole numbers with a sign, found {kind}"))),
    })
}

/// Whole numbers of any type as i64; `None` where the array holds others, or one is too large.
pub(super) fn whole_numbers(array: &ArrayRef) -> Option<Int64Array> {
    if let Ok(numbers) = signed(array) {
        return Some(numbers.as_primitive::<Int64Type>().clone());
    }
    let numbers = unsigned(array).ok()?;
    let numbers = numbers.as_primitive::<UInt64Type>();
    // A number that is missing may be anything.
    let is_large = |number: &u64| i64::try_from(*number).is_err();
    let has_large = numbers.values().iter().any(is_large) && numbers.iter().flatten().any(|number| is_large(&number));
    (!has_large).then(|| numbers.unary(u64::cast_signed))
}

/// Some rows; `None` where one of them is not there.
pub(super) fn gathered(array: &ArrayRef, rows: &[u32]) -> Option<ArrayRef> {
    take(array, &UInt32Array::from(rows.to_vec()), None).ok()
}

/// Texts of any kind, booleans (`true` and `false`), or dictionaries of these.
///
/// # Errors
/// An array of another type.
pub fn texts(array: &ArrayRef) -> Result<ArrayRef, ArrowError> {
    let array = without_dictionary(array)?;
    Ok(match array.data_type() {
        DataType::Utf8 => array,
        DataType::LargeUtf8 => Arc::new(array.as_string::<i64>().iter().collect::<StringArray>()),
        DataType::Utf8View => Arc::new(array.as_string_view().iter().collect::<StringArray>()),
        DataType::Boolean => {
            let words = array.as_boolean().iter().map(|value| value.map(|value| if value { "true" } else { "false" }));
            Arc::new(words.collect::<StringArray>())
        }
        DataType::Null => Arc::new(StringArray::new_null(array.len())),
        kind => return Err(ArrowError::CastError(format!("expected texts, found {kind}"))),
    })
}

fn converted<From: ArrowPrimitiveType, To: ArrowPrimitiveType>(
    array: &ArrayRef,
    convert: impl Fn(From::Native) -> To::Native,
) -> ArrayRef {
    let converted: PrimitiveArray<To> = array.as_primitive::<From>().unary(convert);
    Arc::new(converted)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arrow::array::{
        BooleanArray, DictionaryArray, Float16Array, Int8Array, Int64Array, LargeStringArray, StringViewArray,
        UInt16Array, UInt64Array, new_null_array,
    };

    fn numbers_of(array: impl Array + 'static) -> Vec<Option<f64>> {
        let array: ArrayRef = Arc::new(array);
        numbers(&array).expect("numbers").as_primitive::<Float64Type>().iter().collect()
    }

    fn texts_of(array: impl Array + 'static) -> Vec<Option<String>> {
        let array: ArrayRef = Arc::new(array);
        let texts = texts(&array).expect("texts");
        texts.as_string::<i32>().iter().map(|text| text.map(str::to_owned)).collect()
    }

    #[test]
    fn numbers_of_every_type_are_the_nearest_f64() {
        let half = <Float16Type as ArrowPrimitiveType>::Native::from_f64;
        assert_eq!(numbers_of(Float16Array::from(vec![Some(half(1.5)), None])), [Some(1.5), None]);
        let (least, greatest) = (-(2.0_f64.powi(63)), 2.0_f64.powi(64));
        assert_eq!(numbers_of(Int64Array::from(vec![i64::MIN, -7])), [Some(least), Some(-7.0)]);
        assert_eq!(numbers_of(UInt64Array::from(vec![Some(u64::MAX), None])), [Some(greatest), None]);
        assert_eq!(numbers_of(UInt16Array::from(vec![65535])), [Some(65535.0)]);
        assert_eq!(numbers_of(BooleanArray::from(vec![Some(true), None, Some(false)])), [Some(1.0), None, Some(0.0)]);
        assert_eq!(numbers_of(crate::arrow::array::NullArray::new(2)), [None, None]);
        let words: ArrayRef = Arc::new(StringArray::from(vec!["1"]));
        assert_eq!(numbers(&words).unwrap_err().to_string(), "Cast error: expected numbers, found Utf8");
    }

    /// A null may be a key or a value of a dictionary, whose values may be a dictionary.
    #[test]
    fn dictionaries_are_their_values() {
        let values: ArrayRef = Arc::new(Int64Array::from(vec![Some(5), None, Some(-6)]));
        let inner = DictionaryArray::new(Int8Array::from(vec![Some(2), Some(0), None, Some(1)]), values);
        assert_eq!(numbers_of(inner.clone()), [Some(-6.0), Some(5.0), None, None]);
        let outer = DictionaryArray::new(Int8Array::from(vec![1, 0, 1]), Arc::new(inner));
        assert_eq!(numbers_of(outer), [Some(5.0), Some(-6.0), Some(5.0)]);
        let words: ArrayRef = Arc::new(LargeStringArray::from(vec!["a", "b"]));
        assert_eq!(
            texts_of(DictionaryArray::new(Int8Array::from(vec![Some(1), None]), words)),
            [Some("b".to_owned()), None]
        );
    }

    #[test]
    fn texts_of_every_type_are_the_same() {
        let expected = [Some("x".to_owned()), None];
        assert_eq!(texts_of(StringViewArray::from(vec![Some("x"), None])), expected);
        assert_eq!(texts_of(LargeStringArray::from(vec![Some("x"), None])), expected);
        assert_eq!(texts_of(StringArray::from(vec![Some("x"), None])), expected);
        assert_eq!(texts_of(BooleanArray::from(vec![Some(true), None])), [Some("true".to_owned()), None]);
        let nothing = new_null_array(&DataType::Null, 1);
        assert!(texts(&nothing).expect("texts").is_null(0));
    }
}
