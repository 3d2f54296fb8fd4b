//! Files of results.

use super::temporary::{Access, Temporary, hold};
use super::{PIECE, STANDARD_STREAM, access, folder_of, inputs, sync_file, sync_folder};
use crate::failure::Failure;
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The target of a result: standard output, or a file that gets its name only when it is complete.
///
/// The file is written beside its target and renamed, so a stopped run never leaves half a result under the requested name.
/// An existing file keeps its owner and permissions, and a link to it stays a link; a write-protected one is not replaced,
/// nor is any file that this run has read.
pub(crate) enum ResultFile {
    Standard(io::BufWriter<io::Stdout>),
    /// A device or a named pipe, which must not be replaced.
    Stream {
        stream: io::BufWriter<File>,
        target: PathBuf,
    },
    File {
        file: io::BufWriter<File>,
        beside: Temporary,
        target: PathBuf,
    },
}

/// Writes a result to `target`, or to standard output when there is none or it is `-`.
pub(crate) fn write_result(target: Option<&Path>, bytes: &[u8]) -> Result<(), Failure> {
    let mut output = ResultFile::create(target)?;
    output.put(bytes)?;
    output.finish()
}

impl ResultFile {
    pub(crate) fn create(target: Option<&Path>) -> Result<Self, Failure> {
        let Some(named) = target.filter(|target| target.as_os_str() != STANDARD_STREAM) else {
            return Self::standard();
        };
        let failed = |error| Failure::write(named, error);
        let present = std::fs::metadata(named).ok();
        if let Some(present) = &present {
            if let Some(stream) = Self::of_standard_stream(named, present)? {
                return Ok(stream);
            }
            inputs::refuse(named)?;
            if present.is_dir() {
                return Err(failed(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder")));
            }
            if !present.is_file() || is_open_descriptor(named) {
                let stream = File::options().append(present.is_file()).write(true).open(named).map_err(failed)?;
                return Ok(Self::Stream {
                    stream: io::BufWriter::with_capacity(PIECE, stream),
                    target: named.to_owned(),
                });
            }
            access::require_writable(named, present).map_err(failed)?;
        }
        inputs::refuse(named)?;
        let target = super::whole_path(named);
        let access = if present.is_some() { Access::Private } else { Access::OfNewFile };
        let (beside, file) = Temporary::create(folder_of(&target), access).map_err(failed)?;
        if let Some(present) = &present {
            access::pass_on(&target, present, &file).map_err(failed)?;
        }
        Ok(Self::File { file: io::BufWriter::with_capacity(PIECE, file), beside, target })
    }

    fn standard() -> Result<Self, Failure> {
        #[cfg(unix)]
        inputs::refuse_standard(&io::stdout())?;
        Ok(Self::Standard(io::BufWriter::with_capacity(PIECE, io::stdout())))
    }

    /// A target that is already standard output or standard error, such as `/dev/stdout`: output of others is kept.
    #[cfg(unix)]
    fn of_standard_stream(named: &Path, present: &std::fs::Metadata) -> Result<Option<Self>, Failure> {
        use std::os::fd::AsFd;
        let identity = Some(inputs::Identity::of(present, named));
        let is = |metadata: Option<std::fs::Metadata>| {
            metadata.map(|metadata| inputs::Identity::of(&metadata, named)) == identity
        };
        if is(inputs::standard_metadata(&io::stdout())) {
            return Self::standard().map(Some);
        }
        if present.is_file() && is(inputs::standard_metadata(&io::stderr())) {
            inputs::refuse_standard(&io::stderr())?;
            let stream = io::stderr().as_fd().try_clone_to_owned().map_err(|error| Failure::write(named, error))?;
            let stream = io::BufWriter::with_capacity(PIECE, File::from(stream));
            return Ok(Some(Self::Stream { stream, target: named.to_owned() }));
        }
        Ok(None)
    }

    #[cfg(not(unix))]
    #[allow(clippy::unnecessary_wraps)]
    fn of_standard_stream(_named: &Path, _present: &std::fs::Metadata) -> Result<Option<Self>, Failure> {
        Ok(None)
    }

    /// Writes bytes.
    pub(crate) fn put(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        self.write_all(bytes).map_err(|error| self.failure(error))
    }

    fn writer(&mut self) -> &mut dyn Write {
        match self {
            Self::Standard(output) => output,
            Self::Stream { stream, .. } => stream,
            Self::File { file, .. } => file,
        }
    }

    /// The failure for a write error.
    pub(crate) fn failure(&self, error: io::Error) -> Failure {
        match self {
            Self::Standard(_) => Failure::Output(error),
            Self::Stream { target, .. } | Self::File { target, .. } => Failure::write(target, error),
        }
    }

    /// Whether output is written immediately, so that it cannot be undone.
    pub(crate) fn is_stream(&self) -> bool {
        !matches!(self, Self::File { .. })
    }

    /// Flushes the rest and renames the file to its target.
    pub(crate) fn finish(self) -> Result<(), Failure> {
        match self {
            Self::Standard(mut output) => output.flush().map_err(Failure::Output),
            Self::Stream { mut stream, target } => stream.flush().map_err(|error| Failure::write(&target, error)),
            Self::File { file, mut beside, target } => {
                let failed = |error| Failure::write(&target, error);
                let file = file.into_inner().map_err(|error| failed(error.into_error()))?;
                sync_file(&file).map_err(failed)?;
                drop(file);
                // Files may have been read since this one was created.
                inputs::refuse(&target)?;
                beside.rename(&target, &mut hold()).map_err(failed)?;
                sync_folder(folder_of(&target)).map_err(failed)
            }
        }
    }
}

/// Whether a path leads through the descriptors of this program, such as `/dev/fd/3`: the file there belongs to the process that opened it.
fn is_open_descriptor(path: &Path) -> bool {
    let folder = path.parent().and_then(|folder| folder.canonicalize().ok());
    folder.is_some_and(|folder| folder.ends_with("fd") && (folder.starts_with("/proc") || folder.starts_with("/dev")))
}

impl Write for ResultFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer().flush()
    }
}
