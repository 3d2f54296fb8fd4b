//! A progress bar for long inputs, when standard error is a terminal.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::path::Path;

/// Smaller inputs are done quickly.
const LONG: u64 = 200_000_000;

/// The progress over some files, by their sizes; hidden without a terminal, or for short inputs.
#[derive(Debug)]
pub(crate) struct Progress(ProgressBar);

impl Progress {
    /// A bar over the files, if they are long and standard error is a terminal.
    pub(crate) fn over<'a>(files: impl Iterator<Item = &'a Path>, is_quiet: bool) -> Self {
        let total: u64 = files.map(size).sum();
        if is_quiet || total < LONG || !std::io::stderr().is_terminal() {
            return Self(ProgressBar::hidden());
        }
        let style = ProgressStyle::with_template("{bar:40} {bytes}/{total_bytes}, {eta} left");
        Self(ProgressBar::new(total).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar())))
    }

    /// One of the files is done.
    pub(crate) fn advance(&self, file: &Path) {
        self.0.inc(size(file));
    }

    /// All are done: the bar is removed.
    pub(crate) fn finish(&self) {
        self.0.finish_and_clear();
    }
}

fn size(path: &Path) -> u64 {
    std::fs::metadata(path).map_or(0, |metadata| metadata.len())
}
