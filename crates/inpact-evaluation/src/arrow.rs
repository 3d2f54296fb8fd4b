//! The part of Arrow that is used here: record batches and their arrays, types and errors.
//!
//! Re-exports the Arrow crates under the names of the `arrow` crate, without its compute kernels.

pub use crate::nodes::arrays::{numbers, texts, without_dictionary};

/// Arrays and record batches.
pub mod array {
    pub use arrow_array::builder::*;
    pub use arrow_array::cast::*;
    pub use arrow_array::*;
}

/// Types of columns.
pub mod datatypes {
    pub use arrow_array::types::*;
    pub use arrow_schema::{DataType, Field, Fields, Schema, SchemaRef};
}

/// Buffers of arrays.
pub mod buffer {
    pub use arrow_buffer::{Buffer, NullBuffer, OffsetBuffer, ScalarBuffer};
}

/// The error of all of them.
pub mod error {
    pub use arrow_schema::ArrowError;
}

/// Files and streams.
pub mod ipc {
    pub use arrow_ipc::*;
}
