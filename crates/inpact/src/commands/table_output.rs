//! Target and format of a table: for `eval` and `nodes`.

use super::choice::{Choice, one_of};
use super::picture::is_picture;
use clap::Args;
use inpact_evaluation::results::TableFormat;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct TableOutput {
    /// Where to write the result, instead of standard output; a name that ends in .vtu or .pvd draws the slave surfaces of the deck's mesh for ParaView, a file a state.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// How the result is stored, instead of what the extension of its file says (.csv, .parquet, .arrow, .ipc, .feather).
    #[arg(long, value_parser = one_of(&FORMATS), value_name = "FORMAT")]
    output_format: Option<TableFormat>,
}

const FORMATS: [Choice<TableFormat>; 3] = [
    ("csv", TableFormat::Csv, "Comma-separated values"),
    ("parquet", TableFormat::Parquet, "Parquet"),
    ("arrow", TableFormat::Arrow, "An Arrow IPC file"),
];

impl TableOutput {
    /// The target; `None` is standard output.
    pub(crate) fn target(&self) -> Option<&Path> {
        self.output.as_deref()
    }

    /// The target of a picture, if one is requested.
    pub(crate) fn picture(&self) -> Option<&Path> {
        self.target().filter(|target| self.output_format.is_none() && is_picture(target))
    }

    pub(crate) fn format(&self) -> TableFormat {
        let of_name = || self.target().and_then(TableFormat::of_extension);
        self.output_format.or_else(of_name).unwrap_or_default()
    }
}
