//! Decks in, results out: the only place where files are opened.

use crate::failure::Failure;
use inpact_parser::deck::Scanner;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

/// How much of a deck is read at a time: small enough to stay in cache.
const PIECE: usize = 64 * 1024;

/// The longest line of a deck; Abaqus reads 256 characters.
const LONGEST_LINE: usize = 16 << 20;

/// The name that stands for standard input and standard output.
pub(crate) const STANDARD_STREAM: &str = "-";

/// Pushes a file into a scanner, piece by piece; standard input for `-`.
pub(crate) fn push_all(path: &Path, scanner: &mut Scanner<'_>) -> Result<(), Failure> {
    let mut input = open(path)?;
    let mut piece = vec![0; PIECE];
    loop {
        match input.read(&mut piece) {
            Ok(0) => return Ok(()),
            Ok(count) => {
                scanner.push(&piece[..count]);
                refuse_endless_line(path, scanner)?;
            }
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(Failure::read(path, error)),
        }
    }
}

/// A line that goes on for longer than any program could mean is kept whole until it ends: without a limit it takes all memory.
fn refuse_endless_line(path: &Path, scanner: &Scanner<'_>) -> Result<(), Failure> {
    if scanner.unfinished() <= LONGEST_LINE {
        return Ok(());
    }
    let line = scanner.line();
    let message =
        format!("line {line} is longer than {LONGEST_LINE} bytes, the most that a line may have: it is no deck");
    Err(Failure::read(path, io::Error::new(io::ErrorKind::InvalidData, message)))
}

/// Opens a file for reading, or standard input for `-`.
pub(crate) fn open(path: &Path) -> Result<Box<dyn Read>, Failure> {
    if path.as_os_str() == STANDARD_STREAM {
        return Ok(Box::new(io::stdin().lock()));
    }
    Ok(Box::new(open_file(path)?))
}

/// Opens a file for reading.
pub(crate) fn open_file(path: &Path) -> Result<File, Failure> {
    let file = File::open(path).map_err(|error| Failure::read(path, error))?;
    let is_folder = file.metadata().is_ok_and(|metadata| metadata.is_dir());
    if is_folder {
        return Err(Failure::read(path, io::Error::new(io::ErrorKind::IsADirectory, "it is a folder")));
    }
    Ok(file)
}

/// Reads all of a text file, or of standard input for `-`.
pub(crate) fn read_text(path: &Path) -> Result<String, Failure> {
    let mut text = String::new();
    open(path)?.read_to_string(&mut text).map_err(|error| Failure::read(path, error))?;
    Ok(text)
}

/// Reads all bytes of a file.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    open(path)?.read_to_end(&mut bytes).map_err(|error| Failure::read(path, error))?;
    Ok(bytes)
}

/// Refuses to write a result over a file that it is made from.
pub(crate) fn refuse_overwriting<P: AsRef<Path>>(target: Option<&Path>, inputs: &[P]) -> Result<(), Failure> {
    let Some(whole) = target.and_then(|target| target.canonicalize().ok()) else { return Ok(()) };
    let is_same = |input: &&P| input.as_ref().canonicalize().is_ok_and(|input| input == whole);
    match inputs.iter().find(is_same) {
        Some(input) => {
            let message = format!("the result would replace `{}`, which it is made from", input.as_ref().display());
            Err(Failure::Usage(message))
        }
        None => Ok(()),
    }
}

/// Refuses to write two results to one file, where the second would replace the first; what is no file, such as a device, takes both.
pub(crate) fn refuse_one_target_twice(targets: &[Option<&Path>]) -> Result<(), Failure> {
    let mut taken: Vec<PathBuf> = Vec::new();
    let is_file = |target: &&Path| {
        target.as_os_str() != STANDARD_STREAM && std::fs::metadata(target).map_or(true, |present| present.is_file())
    };
    for target in targets.iter().flatten().copied().filter(is_file) {
        let whole = whole_path(target);
        if taken.contains(&whole) {
            return Err(Failure::Usage(format!("two results would go to `{}`: name two files", target.display())));
        }
        taken.push(whole);
    }
    Ok(())
}

/// A path by which a file is told from others, be it there or not.
fn whole_path(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let name = path.file_name().unwrap_or_default();
        folder.canonicalize().map_or_else(|_| path.to_owned(), |folder| folder.join(name))
    })
}

/// Writes a result to `target`, or to standard output when there is none or it is `-`.
pub(crate) fn write_result(target: Option<&Path>, bytes: &[u8]) -> Result<(), Failure> {
    let mut output = ResultFile::create(target)?;
    output.write_all(bytes).map_err(|error| output.failure(error))?;
    output.finish()
}

/// Gives a file new content: the file a link leads to stays where it is, and so do its permissions.
pub(crate) fn rewrite(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let target = path.canonicalize().map_err(|error| Failure::write(path, error))?;
    let permissions = target.metadata().map_err(|error| Failure::write(path, error))?.permissions();
    if permissions.readonly() {
        // Renaming another file to its name would succeed, against the wish of whoever protected it.
        let error = io::Error::new(io::ErrorKind::PermissionDenied, "it is read-only");
        return Err(Failure::write(path, error));
    }
    write_result(Some(&target), bytes)?;
    std::fs::set_permissions(&target, permissions).map_err(|error| Failure::write(path, error))
}

/// Where a result goes: standard output, or a file that gets its name only when it is complete.
///
/// The file is written beside its target and renamed, so a stopped run never leaves half a result under the name that was asked for.
/// A file that is there already keeps its permissions, and a link to it stays a link; a write-protected one is left alone.
pub(crate) enum ResultFile {
    Standard(io::BufWriter<io::Stdout>),
    /// A device or a named pipe, which nothing must be renamed to.
    Stream {
        stream: io::BufWriter<File>,
        target: PathBuf,
    },
    File {
        beside: io::BufWriter<tempfile::NamedTempFile>,
        target: PathBuf,
    },
}

impl ResultFile {
    pub(crate) fn create(target: Option<&Path>) -> Result<Self, Failure> {
        let Some(target) = target.filter(|target| target.as_os_str() != STANDARD_STREAM) else {
            return Ok(Self::Standard(io::BufWriter::with_capacity(PIECE, io::stdout())));
        };
        let present = std::fs::metadata(target).ok();
        if present.as_ref().is_some_and(|present| !present.is_file() && !present.is_dir()) {
            let stream = File::options().write(true).open(target).map_err(|error| Failure::write(target, error))?;
            return Ok(Self::Stream { stream: io::BufWriter::with_capacity(PIECE, stream), target: target.to_owned() });
        }
        if present.as_ref().is_some_and(|present| present.is_file() && present.permissions().readonly()) {
            let error = io::Error::new(io::ErrorKind::PermissionDenied, "it is read-only");
            return Err(Failure::write(target, error));
        }
        let target = &match present {
            Some(_) => target.canonicalize().map_err(|error| Failure::write(target, error))?,
            None => target.to_owned(),
        };
        let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let mut builder = tempfile::Builder::new();
        builder.prefix(".inpact-");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // What any other program would give a new file; the umask takes its share.
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let beside = builder.tempfile_in(folder).map_err(|error| Failure::write(target, error))?;
        if let Some(present) = present.filter(std::fs::Metadata::is_file) {
            beside.as_file().set_permissions(present.permissions()).map_err(|error| Failure::write(target, error))?;
        }
        Ok(Self::File { beside: io::BufWriter::with_capacity(PIECE, beside), target: target.to_owned() })
    }

    /// What failed, for an error of writing.
    pub(crate) fn failure(&self, error: io::Error) -> Failure {
        match self {
            Self::Standard(_) => Failure::Output(error),
            Self::Stream { target, .. } | Self::File { target, .. } => Failure::write(target, error),
        }
    }

    /// Writes out what is left and gives the file its name.
    pub(crate) fn finish(self) -> Result<(), Failure> {
        match self {
            Self::Standard(mut output) => output.flush().map_err(Failure::Output),
            Self::Stream { mut stream, target } => stream.flush().map_err(|error| Failure::write(&target, error)),
            Self::File { beside, target } => {
                let failed = |error| Failure::write(&target, error);
                let beside = beside.into_inner().map_err(|error| failed(error.into_error()))?;
                beside.persist(&target).map(drop).map_err(|error| failed(error.error))
            }
        }
    }
}

impl Write for ResultFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::Standard(output) => output.write(bytes),
            Self::Stream { stream, .. } => stream.write(bytes),
            Self::File { beside, .. } => beside.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Standard(output) => output.flush(),
            Self::Stream { stream, .. } => stream.flush(),
            Self::File { beside, .. } => beside.flush(),
        }
    }
}
