//! Temporary files: they lie beside their target, and are removed however the run ends.
//!
//! A run that is stopped by a signal, or ended by a user's routine, runs no destructors: the list of temporary files is kept here,
//! and a thread that waits for signals removes it.
//! Ends that cannot be caught (SIGKILL, a crash of the user's routine) leave the files behind; their names begin with `.inpact-`.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The prefix of the names of temporary files.
const PREFIX: &str = ".inpact-";

/// The existing temporary files.
static PRESENT: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// While it is held no signal ends the program, so renames are complete.
#[derive(Debug)]
pub(super) struct Hold(MutexGuard<'static, Vec<PathBuf>>);

/// Blocks on a signal being handled (for ever, since the program then ends), and delays others.
pub(super) fn hold() -> Hold {
    Hold(PRESENT.lock().unwrap_or_else(PoisonError::into_inner))
}

/// Permissions of a temporary file while it is being written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Access {
    /// As any new file: everybody, subject to the umask.
    OfNewFile,
    /// The user alone.
    Private,
}

/// A file that is removed when it goes out of scope, unless it was renamed.
#[derive(Debug)]
pub(crate) struct Temporary {
    path: PathBuf,
    is_there: bool,
}

/// Whether the process, and its signals, belong to the program.
static OWNS_PROCESS: AtomicBool = AtomicBool::new(false);

/// Installs the removal of temporary files on signals, for the command line.
///
/// A program that uses the library handles signals itself, such as Python with Ctrl-C.
pub(crate) fn remove_on_signals() {
    OWNS_PROCESS.store(true, Ordering::Relaxed);
}

impl Temporary {
    /// Creates an empty file in `folder`, open for writing.
    pub(super) fn create(folder: &Path, access: Access) -> io::Result<(Self, File)> {
        if OWNS_PROCESS.load(Ordering::Relaxed) {
            signals::watch();
        }
        // A user routine may change the working folder.
        let folder = std::path::absolute(folder)?;
        let mut options = File::options();
        options.read(true).write(true).create_new(true);
        #[cfg(unix)]
        std::os::unix::fs::OpenOptionsExt::mode(
            &mut options,
            match access {
                Access::OfNewFile => 0o666,
                Access::Private => 0o600,
            },
        );
        #[cfg(not(unix))]
        let _ = access;
        Self::make(&folder, &mut hold(), |path| options.open(path))
    }

    /// Gives the file at `original` a second name that is removed like a temporary file.
    pub(super) fn link(original: &Path, hold: &mut Hold) -> io::Result<Self> {
        let folder = original.parent().unwrap_or(Path::new("."));
        Ok(Self::make(folder, hold, |path| std::fs::hard_link(original, path))?.0)
    }

    fn make<T>(folder: &Path, hold: &mut Hold, make: impl Fn(&Path) -> io::Result<T>) -> io::Result<(Self, T)> {
        let mut code = None;
        let make = |path: &Path| make(path).inspect_err(|error| code = error.raw_os_error());
        let made = tempfile::Builder::new().prefix(PREFIX).make_in(folder, make);
        // The library's message names the temporary file, but the user only knows the target.
        let made = made.map_err(|error| code.map_or(error, io::Error::from_raw_os_error))?;
        let (made, path) = made.keep().map_err(|error| error.error)?;
        hold.0.push(path.clone());
        Ok((Self { path, is_there: true }, made))
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Renames the file to `target`.
    pub(super) fn rename(&mut self, target: &Path, hold: &mut Hold) -> io::Result<()> {
        std::fs::rename(&self.path, target)?;
        self.forget(hold);
        Ok(())
    }

    /// Keeps the file permanently.
    pub(super) fn forget(&mut self, hold: &mut Hold) {
        self.is_there = false;
        hold.0.retain(|path| *path != self.path);
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if self.is_there {
            let mut hold = hold();
            // It may already be removed.
            let _ = std::fs::remove_file(&self.path);
            self.forget(&mut hold);
        }
    }
}

/// Removes all temporary files, for ends of the program without destructors.
pub(crate) fn remove_all() {
    remove_those(&mut hold());
}

fn remove_those(hold: &mut Hold) {
    for path in hold.0.drain(..) {
        let _ = std::fs::remove_file(path);
    }
}

/// Signals that end the program.
#[cfg(unix)]
mod signals {
    use super::{hold, remove_those};
    use signal_hook::consts::{
        SIGALRM, SIGHUP, SIGINT, SIGPROF, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2, SIGVTALRM, SIGXCPU, SIGXFSZ,
    };
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;
    use std::ffi::c_int;
    use std::sync::{Once, mpsc};

    /// Signals that end a program by default and can be caught; the others are crashes.
    const ENDING: [c_int; 10] =
        [SIGHUP, SIGINT, SIGQUIT, SIGALRM, SIGTERM, SIGUSR1, SIGUSR2, SIGVTALRM, SIGPROF, SIGXCPU];

    /// Installs the removal of temporary files on signals, after which the program still ends by that signal.
    ///
    /// Without a thread, signals have their default action.
    pub(super) fn watch() {
        static ONCE: Once = Once::new();
        ONCE.call_once(|| {
            let (ready, is_ready) = mpsc::channel();
            let watching = move || {
                let signals = Signals::new(caught());
                // Not needed where nothing can be caught.
                let _ = ready.send(());
                let Ok(mut signals) = signals else { return };
                for signal in signals.forever() {
                    // A file beyond the size limit is a write error, which says more than the signal.
                    if signal != SIGXFSZ {
                        let mut hold = hold();
                        remove_those(&mut hold);
                        let _ = emulate_default_handler(signal);
                    }
                }
            };
            if std::thread::Builder::new().name("signals".to_owned()).spawn(watching).is_ok() {
                let _ = is_ready.recv();
            }
        });
    }

    /// The signals to catch: one that is ignored, as by `nohup`, stays ignored.
    fn caught() -> Vec<c_int> {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        match mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()) {
            Some(ignored) => {
                let is_ignored = |signal: c_int| ignored >> (signal - 1) & 1 == 1;
                ENDING.into_iter().chain([SIGXFSZ]).filter(|signal| !is_ignored(*signal)).collect()
            }
            // The ignored signals are unknown: these two are never ignored for a whole run.
            None => vec![SIGINT, SIGTERM, SIGXFSZ],
        }
    }
}

/// Signals that end the program: there are none.
#[cfg(not(unix))]
mod signals {
    pub(super) fn watch() {}
}
