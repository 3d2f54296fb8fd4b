//! Statuses as an Arrow array of strings.

use super::Status;
use crate::arrow::array::{Array, ArrayRef, StringArray};
use crate::arrow::buffer::{Buffer, NullBuffer, OffsetBuffer};
use std::sync::Arc;

/// The number of bytes copied for a word, including trailing ones that the next word overwrites: a fixed size avoids a call for a few bytes.
const BLOCK: usize = 16;

/// Memory of the words of the previous array, for reuse.
#[derive(Debug, Default)]
pub(super) struct StatusRoom {
    bytes: Vec<u8>,
}

impl StatusRoom {
    /// The memory of words that are no longer shared; otherwise none.
    pub(super) fn of(bytes: Buffer) -> Self {
        Self { bytes: bytes.into_vec().unwrap_or_default() }
    }

    /// The words of statuses, null where there is none.
    pub(super) fn array(self, statuses: &[Option<Status>]) -> ArrayRef {
        let Self { mut bytes } = self;
        let mut lengths = [0; Status::ALL.len() + 1];
        let mut blocks = [[0; BLOCK]; Status::ALL.len() + 1];
        for status in Status::ALL {
            let word = status.word().as_bytes();
            lengths[place(Some(status))] = word.len();
            blocks[place(Some(status))][..word.len()].copy_from_slice(word);
        }
        let ends = OffsetBuffer::from_lengths(statuses.iter().map(|status| lengths[place(*status)]));
        let length = usize::try_from(ends[statuses.len()]).unwrap_or_default();
        bytes.resize(length + BLOCK, 0);
        for (status, start) in statuses.iter().zip(&*ends) {
            let start = usize::try_from(*start).unwrap_or_default();
            bytes[start..start + BLOCK].copy_from_slice(&blocks[place(*status)]);
        }
        bytes.truncate(length);
        let missing = statuses.iter().filter(|status| status.is_none()).count();
        let nulls = (0 < missing).then(|| statuses.iter().map(Option::is_some).collect::<NullBuffer>());
        Arc::new(StringArray::new(ends, bytes.into(), nulls))
    }
}

/// The words of an array.
pub(super) fn words(array: &ArrayRef) -> Option<Buffer> {
    Some(array.as_any().downcast_ref::<StringArray>()?.values().clone())
}

/// The index of a status; that of none is last.
fn place(status: Option<Status>) -> usize {
    status.map_or(Status::ALL.len(), |status| status as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arrow::array::AsArray;

    #[test]
    fn statuses_are_their_words_in_memory_of_any_size() {
        let all: Vec<_> = Status::ALL.into_iter().map(Some).chain([None]).collect();
        let mut before: Option<ArrayRef> = None;
        for count in [0, 1, 5, 7, 300, 2, 1000] {
            let statuses: Vec<_> = (0..count).map(|row| all[(row * row + row / 3) % all.len()]).collect();
            let room = before.take().and_then(|array| words(&array)).map(StatusRoom::of);
            let array = room.unwrap_or_default().array(&statuses);
            let found: Vec<_> = array.as_string::<i32>().iter().collect();
            assert_eq!(found, statuses.iter().map(|status| status.map(Status::word)).collect::<Vec<_>>());
            before = Some(array);
        }
    }
}
