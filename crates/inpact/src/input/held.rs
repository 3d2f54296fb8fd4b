//! Files read once and kept in memory: findings are fixed in the same bytes that were checked.

use crate::failure::Failure;
use crate::files;
use crate::files::transaction::{Change, Snapshot};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Files by path with links resolved: each is stored once, whatever its names.
#[derive(Debug, Default)]
pub(crate) struct HeldFiles(Mutex<BTreeMap<PathBuf, Held>>);

/// A file with its old and new content.
#[derive(Debug, Clone)]
pub(crate) struct Held {
    pub(crate) read: Snapshot,
    pub(crate) now: Arc<[u8]>,
}

impl Held {
    pub(crate) fn is_changed(&self) -> bool {
        self.now != self.read.bytes
    }
}

impl HeldFiles {
    fn files(&self) -> MutexGuard<'_, BTreeMap<PathBuf, Held>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The content of a file, read at first use; `name` is its name in messages.
    pub(crate) fn content(&self, path: &Path, name: &Path) -> Result<Arc<[u8]>, Failure> {
        let place = files::whole_path(path);
        if let Some(held) = self.files().get_mut(&place) {
            if held.read.name == place {
                name.clone_into(&mut held.read.name);
            }
            return Ok(held.now.clone());
        }
        // Reading a pipe may take long, and must not block others.
        let mut read = Snapshot::read(path)?;
        name.clone_into(&mut read.name);
        let now = read.bytes.clone();
        Ok(self.files().entry(place).or_insert(Held { read, now }).now.clone())
    }

    /// Stores a file with known content, existing or not; it cannot be written back.
    pub(crate) fn hold(&self, place: &Path, content: Arc<[u8]>) {
        let read = Snapshot::of_text(place, content.clone());
        self.files().entry(place.to_owned()).or_insert(Held { read, now: content });
    }

    /// Sets new content of a stored file.
    pub(crate) fn set(&self, place: &Path, content: Vec<u8>) {
        if let Some(held) = self.files().get_mut(place) {
            held.now = content.into();
        }
    }

    /// Merges the files of another, except those already here.
    pub(crate) fn take_over(&self, others: Self) {
        let others = others.0.into_inner().unwrap_or_else(PoisonError::into_inner);
        let mut files = self.files();
        for (place, held) in others {
            files.entry(place).or_insert(held);
        }
    }

    pub(crate) fn get(&self, place: &Path) -> Option<Held> {
        self.files().get(place).cloned()
    }

    /// The files whose content changed.
    pub(crate) fn changed(&self) -> Vec<Held> {
        self.files().values().filter(|held| held.is_changed()).cloned().collect()
    }

    /// The files to write.
    pub(crate) fn changes(&self) -> Vec<Change> {
        self.changed().into_iter().map(|held| Change::of_read(held.read, held.now)).collect()
    }
}
