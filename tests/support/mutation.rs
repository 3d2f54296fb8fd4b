//! Inputs by chance, the same in every run: what the tests on mutated decks have in common.

use std::path::{Path, PathBuf};

/// SplitMix64: numbers by chance, the same in every run.
pub(crate) struct Chance(pub(crate) u64);

impl Chance {
    /// The next number.
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    /// A number from 0 up to but without `end`; 0 when there is none.
    pub(crate) fn below(&mut self, end: usize) -> usize {
        usize::try_from(self.next() % end.max(1) as u64).expect("smaller than a usize")
    }

    pub(crate) fn one_of<'items>(&mut self, items: &'items [Vec<u8>]) -> &'items [u8] {
        &items[self.below(items.len())]
    }
}

/// The folder of the project.
pub(crate) fn project() -> PathBuf {
    let mut folders = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors();
    folders.find(|folder| folder.join("grammar/keywords").is_dir()).expect("the project").to_owned()
}

/// The files of a folder and of those in it, in the order of their names.
pub(crate) fn files(folder: &Path, extension: &str) -> Vec<Vec<u8>> {
    let mut paths: Vec<PathBuf> =
        std::fs::read_dir(folder).expect("a folder").map(|e| e.expect("readable").path()).collect();
    paths.sort();
    let contents = paths.iter().map(|path| match path {
        path if path.is_dir() => files(path, extension),
        path if path.extension().is_some_and(|found| found == extension) => {
            vec![std::fs::read(path).expect("readable")]
        }
        _ => Vec::new(),
    });
    contents.flatten().collect()
}
