//! Atomic replacement of several files: all get new content, or none does.
//!
//! 1. *Prepare*: every new content is written beside its target, with the target's owner and permissions, and synced.
//! 2. *Verify*: every target is still the file that was read, byte for byte.
//! 3. *Exchange*: new and old swap names atomically, so that a complete file exists at all times, and the old one can be inspected.
//! 4. *Check*: the old file is the one that was read, and no program has it open for writing; otherwise everything is swapped back.
//!
//! So a concurrent edit by another program is never lost: before 3 it is detected, after 3 it applies to the new file.
//! Where a system cannot exchange names (some network drives), the old file gets a second name instead and the new one is renamed over it: another
//! program that creates a file there between these two calls is not detected.

use super::inputs::Identity;
use super::temporary::{Access, Hold, Temporary, hold};
use super::whole::{bounded, lines_of, lines_of_stream};
use super::{PIECE, access, folder_of, holders, open_file, sync_file, sync_folder, whole_path};
use crate::failure::Failure;
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The maximum number of bytes read from a possibly endless stream, such as a pipe.
const MAX_OF_STREAM: u64 = 1 << 30;

/// A file as it was read: its identity and content.
#[derive(Debug, Clone)]
pub(crate) struct Snapshot {
    /// The name under which it was read.
    pub(crate) name: PathBuf,
    /// Its path, links followed.
    pub(crate) path: PathBuf,
    pub(crate) bytes: Arc<[u8]>,
    /// `None` if it cannot be written back: a pipe or a device.
    identity: Option<Identity>,
}

/// New content for a file.
#[derive(Debug)]
pub(crate) struct Change {
    /// Its path, links followed.
    target: PathBuf,
    content: Arc<[u8]>,
    /// The target as it was read; `None` where it may be anything, or nothing.
    expected: Option<Snapshot>,
}

impl Snapshot {
    /// Reads a file once, as a whole.
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        let mut file = open_file(path)?;
        let unreadable = |error| Failure::read(path, error);
        let metadata = file.metadata().map_err(unreadable)?;
        let mut input = bounded(&mut file, Some(&metadata));
        let bytes = if metadata.is_file() { lines_of(&mut input) } else { lines_of_stream(&mut input, MAX_OF_STREAM) };
        let bytes = bytes.map_err(unreadable)?;
        let whole = whole_path(path);
        let identity = metadata.is_file().then(|| Identity::of(&metadata, &whole));
        Ok(Self { name: path.to_owned(), path: whole, bytes: bytes.into(), identity })
    }

    /// A snapshot of a text at a place, without reading it.
    pub(crate) fn of_text(place: &Path, bytes: Arc<[u8]>) -> Self {
        Self { name: place.to_owned(), path: place.to_owned(), bytes, identity: None }
    }

    /// Whether it is a file, which can be written back.
    pub(crate) fn is_file(&self) -> bool {
        self.identity.is_some()
    }

    /// Whether the file at `path` is the one that was read, with the same content.
    ///
    /// Without a file identity its path at the time of reading identifies it, wherever the file is now.
    fn is_unchanged_at(&self, path: &Path) -> io::Result<bool> {
        let mut file = File::open(path)?;
        let metadata = file.metadata()?;
        if self.identity.as_ref() != Some(&Identity::of(&metadata, &self.path)) {
            return Ok(false);
        }
        has_content(&mut file, &self.bytes)
    }
}

fn has_content(file: &mut File, mut expected: &[u8]) -> io::Result<bool> {
    let mut piece = vec![0; PIECE];
    loop {
        match file.read(&mut piece) {
            Ok(0) => return Ok(expected.is_empty()),
            Ok(count) => match expected.strip_prefix(&piece[..count]) {
                Some(rest) => expected = rest,
                None => return Ok(false),
            },
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}

impl Change {
    /// New content for a file that was read, if it is unchanged since.
    pub(crate) fn of_read(snapshot: Snapshot, content: Arc<[u8]>) -> Self {
        Self { target: snapshot.path.clone(), content, expected: Some(snapshot) }
    }

    /// A result that replaces any existing file.
    pub(crate) fn result(path: &Path, content: Arc<[u8]>) -> Self {
        Self { target: whole_path(path), content, expected: None }
    }

    /// The name of the file for messages.
    fn name(&self) -> &Path {
        self.expected.as_ref().map_or(&self.target, |snapshot| &snapshot.name)
    }

    fn failed(&self, error: io::Error) -> Failure {
        Failure::write(self.name(), error)
    }

    /// Rejects a target that has changed since it was read.
    fn verify(&self, path: &Path) -> io::Result<()> {
        match &self.expected {
            Some(snapshot) if !snapshot.is_unchanged_at(path)? => {
                Err(io::Error::other("another program changed it after it was read"))
            }
            _ => Ok(()),
        }
    }
}

/// A change whose new file is ready.
struct Prepared<'a> {
    change: &'a Change,
    new: Identity,
    beside: Temporary,
    state: State,
}

/// Stages of an exchange of names.
enum State {
    /// Old and new have their own names.
    Waiting,
    /// The old one has the name of the temporary.
    Exchanged,
    /// The temporary has the name, and the old one this second name.
    Replaced(Temporary),
    /// The temporary has the name; there was no file before.
    Created,
}

/// Writes all changes or none.
///
/// # Errors
/// The obstacles, a failure for each file; nothing is changed then.
pub(crate) fn commit(changes: &[Change]) -> Result<(), Vec<Failure>> {
    let mut prepared = all(changes.iter().map(|change| prepare(change).map_err(|error| change.failed(error))))?;
    all(changes.iter().map(|change| change.verify(&change.target).map_err(|error| change.failed(error))))?;
    let mut hold = hold();
    let mut refused = Vec::new();
    for ready in &mut prepared {
        if let Err(error) = ready.exchange(&mut hold) {
            refused.push(ready.change.failed(error));
            break;
        }
    }
    if refused.is_empty() {
        refused = look(&prepared);
    }
    if !refused.is_empty() {
        for ready in prepared.iter_mut().rev() {
            if let Err(error) = ready.put_back(&mut hold) {
                refused.push(ready.change.failed(error));
            }
        }
    }
    let folders: BTreeSet<&Path> = changes.iter().map(|change| folder_of(&change.target)).collect();
    let synced =
        all(folders.into_iter().map(|folder| sync_folder(folder).map_err(|error| Failure::write(folder, error))));
    drop(hold);
    // Here the files left under temporary names are removed: the old ones, or the new ones after a failure.
    drop(prepared);
    if refused.is_empty() { synced.map(drop) } else { Err(refused) }
}

/// Everything, or everything that failed.
fn all<T>(results: impl Iterator<Item = Result<T, Failure>>) -> Result<Vec<T>, Vec<Failure>> {
    let (mut done, mut failed) = (Vec::new(), Vec::new());
    for result in results {
        match result {
            Ok(value) => done.push(value),
            Err(failure) => failed.push(failure),
        }
    }
    if failed.is_empty() { Ok(done) } else { Err(failed) }
}

fn prepare(change: &Change) -> io::Result<Prepared<'_>> {
    let present = std::fs::metadata(&change.target).ok();
    let access = if present.is_some() { Access::Private } else { Access::OfNewFile };
    if let Some(present) = &present {
        if !present.is_file() {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is no file"));
        }
        access::require_writable(&change.target, present)?;
    }
    let (beside, mut file) = Temporary::create(folder_of(&change.target), access)?;
    file.write_all(&change.content)?;
    if let Some(present) = &present {
        access::pass_on(&change.target, present, &file)?;
    }
    sync_file(&file)?;
    let new = Identity::of(&file.metadata()?, &change.target);
    Ok(Prepared { change, new, beside, state: State::Waiting })
}

/// Checks that the exchanged files are those that were read, and cannot change any more.
fn look(prepared: &[Prepared<'_>]) -> Vec<Failure> {
    let read: Vec<(&Prepared<'_>, &Path)> = prepared
        .iter()
        .filter(|ready| ready.change.expected.is_some())
        .filter_map(|ready| Some((ready, ready.old()?)))
        .collect();
    // A program that has it open now can still write to it; one that had it open before has finished, and its writes are in the content.
    let names: Vec<&Path> = read.iter().map(|(_, old)| *old).collect();
    let held = holders::is_open_for_writing(&names);
    let checked = read.iter().zip(held).map(|((ready, old), is_held)| {
        let checked = if is_held {
            Err(io::Error::other("another program has it open and may write to it"))
        } else {
            ready.change.verify(old)
        };
        checked.map_err(|error| ready.change.failed(error))
    });
    all(checked).err().unwrap_or_default()
}

impl Prepared<'_> {
    /// The path of the old file, once the new one has its name.
    fn old(&self) -> Option<&Path> {
        match &self.state {
            State::Exchanged => Some(self.beside.path()),
            State::Replaced(old) => Some(old.path()),
            State::Waiting | State::Created => None,
        }
    }

    /// Renames the new file to the target.
    fn exchange(&mut self, hold: &mut Hold) -> io::Result<()> {
        let target = &self.change.target;
        match exchange(self.beside.path(), target) {
            Ok(()) => {
                self.state = State::Exchanged;
                Ok(())
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                if self.change.expected.is_some() {
                    return Err(io::Error::other("another program removed it after it was read"));
                }
                self.beside.rename(target, hold)?;
                self.state = State::Created;
                Ok(())
            }
            // The system does not support it.
            Err(_) => self.replace(hold),
        }
    }

    /// As `exchange`, in two steps.
    fn replace(&mut self, hold: &mut Hold) -> io::Result<()> {
        let target = &self.change.target;
        if !target.exists() {
            self.change.verify(target)?;
            self.beside.rename(target, hold)?;
            self.state = State::Created;
            return Ok(());
        }
        let old = Temporary::link(target, hold)?;
        self.state = State::Replaced(old);
        if let Err(error) = self.change.verify(target).and_then(|()| self.beside.rename(target, hold)) {
            // The target is unchanged.
            let state = std::mem::replace(&mut self.state, State::Waiting);
            if let State::Replaced(mut old) = state {
                let _ = std::fs::remove_file(old.path());
                old.forget(hold);
            }
            return Err(error);
        }
        Ok(())
    }

    /// Restores the old file's name, unless another program has written to the new one meanwhile.
    fn put_back(&mut self, hold: &mut Hold) -> io::Result<()> {
        let target = &self.change.target;
        match &mut self.state {
            State::Waiting => {}
            State::Created => {
                if self.new_is_untouched(target) {
                    std::fs::remove_file(target)?;
                }
            }
            State::Replaced(old) => {
                let is_new = Identity::at(target).as_ref() == Some(&self.new);
                if is_new {
                    old.rename(target, hold)?;
                }
            }
            State::Exchanged => self.exchange_back(hold)?,
        }
        self.state = State::Waiting;
        Ok(())
    }

    fn exchange_back(&mut self, hold: &mut Hold) -> io::Result<()> {
        let (target, beside) = (&self.change.target, self.beside.path());
        if let Err(error) = exchange(beside, target) {
            if error.kind() == io::ErrorKind::NotFound {
                // Another program removed the new file, believing it to be the old one.
                return Ok(());
            }
            let place = beside.display().to_string();
            self.beside.forget(hold);
            return Err(io::Error::other(format!("its content from before is in `{place}` ({error})")));
        }
        let is_edited = Identity::at(beside).as_ref() != Some(&self.new)
            || !self.new_is_untouched(beside)
            || holders::is_open_for_writing(&[beside]) == [true];
        if is_edited {
            // Another program saved its edit of the new file, or is about to: that is the latest state, and is kept.
            exchange(beside, target)?;
            return Err(io::Error::other(
                "another program is editing what had been written already, which is left to it",
            ));
        }
        Ok(())
    }

    /// Whether the file at `path` is the new one, unchanged.
    fn new_is_untouched(&self, path: &Path) -> bool {
        let Ok(mut file) = File::open(path) else { return false };
        let is_new = file.metadata().is_ok_and(|metadata| Identity::of(&metadata, &self.change.target) == self.new);
        is_new && has_content(&mut file, &self.change.content).unwrap_or(false)
    }
}

/// Swaps the names of two files atomically.
#[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
fn exchange(one: &Path, other: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE).map_err(io::Error::from)
}

#[cfg(not(any(target_os = "linux", target_os = "android", target_vendor = "apple")))]
fn exchange(_one: &Path, _other: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

#[cfg(test)]
mod tests {
    use super::{Change, Snapshot, commit};
    use std::fs;
    use std::path::Path;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(folder)
            .expect("readable")
            .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    fn mended(path: &Path, content: &str) -> Change {
        Change::of_read(Snapshot::read(path).expect("readable"), content.as_bytes().into())
    }

    #[test]
    fn all_files_are_written_and_nothing_else_stays() {
        let folder = tempfile::tempdir().expect("a folder");
        let [a, b] = ["a", "b"].map(|name| folder.path().join(name));
        fs::write(&a, "one").expect("writable");
        commit(&[mended(&a, "two"), Change::result(&b, b"new".as_slice().into())]).expect("nothing is in the way");
        assert_eq!((fs::read(&a).expect("there"), fs::read(&b).expect("there")), (b"two".to_vec(), b"new".to_vec()));
        assert_eq!(names(folder.path()), ["a", "b"]);
    }

    #[test]
    fn one_file_that_changed_keeps_all_from_being_written() {
        let folder = tempfile::tempdir().expect("a folder");
        let [a, b, c] = ["a", "b", "c"].map(|name| folder.path().join(name));
        for path in [&a, &b] {
            fs::write(path, "one").expect("writable");
        }
        let changes = [mended(&a, "two"), Change::result(&c, b"new".as_slice().into()), mended(&b, "two")];
        // Of the same length: only the content differs.
        fs::write(&b, "ONE").expect("writable");
        let refused = commit(&changes).expect_err("b is not what was read");
        assert_eq!(refused.len(), 1);
        assert!(refused[0].to_string().contains("another program changed it"), "{}", refused[0]);
        assert_eq!((fs::read(&a).expect("there"), fs::read(&b).expect("there")), (b"one".to_vec(), b"ONE".to_vec()));
        assert_eq!(names(folder.path()), ["a", "b"]);
    }

    /// Earlier exchanges are undone when a later file fails at the last moment.
    #[test]
    fn what_was_exchanged_is_exchanged_back() {
        let folder = tempfile::tempdir().expect("a folder");
        let [a, b, gone] = ["a", "b", "gone"].map(|name| folder.path().join(name));
        fs::write(&a, "one").expect("writable");
        let changes = [mended(&a, "two"), Change::result(&b, b"new".as_slice().into())];
        let mut prepared: Vec<_> = changes.iter().map(|change| super::prepare(change).expect("writable")).collect();
        let mut hold = super::hold();
        for ready in &mut prepared {
            ready.exchange(&mut hold).expect("the names are free");
        }
        assert_eq!(fs::read(&a).expect("there"), b"two");
        for ready in prepared.iter_mut().rev() {
            ready.put_back(&mut hold).expect("nobody else is here");
        }
        drop(hold);
        drop(prepared);
        assert_eq!(fs::read(&a).expect("there"), b"one");
        assert_eq!(names(folder.path()), ["a"]);
        assert!(!gone.exists());
    }

    /// A program that has the file open writes to it after the exchange of names: its edit is not lost.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_file_that_another_program_has_open_for_writing_is_left_to_it() {
        use std::io::Write;
        use std::process::{Command, Stdio};
        let folder = tempfile::tempdir().expect("a folder");
        let a = folder.path().join("a");
        fs::write(&a, "one").expect("writable");
        let mut editor = Command::new("sh")
            .args(["-c", "exec 3<>a; echo; read line; echo $line >&3; read line"])
            .current_dir(folder.path())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("a shell");
        let mut ready = [0];
        std::io::Read::read_exact(editor.stdout.as_mut().expect("piped"), &mut ready).expect("it has the file open");
        let refused = commit(&[mended(&a, "two")]).expect_err("the file is open");
        assert!(refused[0].to_string().contains("another program has it open"), "{}", refused[0]);
        assert_eq!(fs::read(&a).expect("there"), b"one");
        let mut input = editor.stdin.take().expect("piped");
        input.write_all(b"two hours of work\n\n").expect("it reads");
        drop(input);
        editor.wait().expect("it ends");
        assert_eq!(fs::read(&a).expect("there"), b"two hours of work\n");
        assert_eq!(names(folder.path()), ["a"]);
    }

    /// As where a system cannot exchange names.
    #[test]
    fn a_file_is_replaced_in_two_steps_and_taken_back() {
        let folder = tempfile::tempdir().expect("a folder");
        let a = folder.path().join("a");
        fs::write(&a, "one").expect("writable");
        let change = mended(&a, "two");
        for is_kept in [false, true] {
            let mut ready = super::prepare(&change).expect("writable");
            let mut hold = super::hold();
            ready.replace(&mut hold).expect("nobody else is here");
            assert_eq!(fs::read(&a).expect("there"), b"two");
            if !is_kept {
                ready.put_back(&mut hold).expect("nobody else is here");
            }
            drop(hold);
            drop(ready);
            assert_eq!(fs::read_to_string(&a).expect("there"), if is_kept { "two" } else { "one" });
            assert_eq!(names(folder.path()), ["a"]);
        }
    }
}
