//! The type of a library file, from its first bytes: system loaders give poor messages for a file that is not a library, or one for another machine.

use super::COMPILE_COMMAND;
use crate::failure::Failure;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The number of bytes examined.
const HEAD: usize = 512;

/// e_type of an ELF header.
const RELOCATABLE: u16 = 1;
const EXECUTABLE: u16 = 2;

/// e_machine of an ELF header, as far as machines with a Fortran compiler are likely.
const MACHINES: &[(u16, &str, &str)] = &[
    (3, "x86", "x86 (32 bit)"),
    (8, "mips", "MIPS"),
    (20, "powerpc", "PowerPC"),
    (21, "powerpc64", "PowerPC (64 bit)"),
    (22, "s390x", "S/390"),
    (40, "arm", "ARM (32 bit)"),
    (62, "x86_64", "x86-64"),
    (183, "aarch64", "AArch64"),
    (243, "riscv64", "RISC-V"),
    (258, "loongarch64", "LoongArch"),
];

/// Reads the head of a file that is to be loaded and refuses what cannot be a library for this machine.
pub(super) fn check(path: &Path) -> Result<(), Failure> {
    let unreadable = |error| Failure::read(path, error);
    // Before it is opened: opening a named pipe waits for its other end.
    if !std::fs::metadata(path).map_err(unreadable)?.is_file() {
        return Err(unreadable(io::Error::new(io::ErrorKind::InvalidInput, "a library is a file, and it is none")));
    }
    let mut head = Vec::new();
    File::open(path).and_then(|file| file.take(HEAD as u64).read_to_end(&mut head)).map_err(unreadable)?;
    match refusal(&head) {
        Some(why) => Err(Failure::Usage(format!("`{}` {why}", path.display()))),
        None => Ok(()),
    }
}

/// The reason why a file that begins like this cannot be loaded; the loader judges what passes.
fn refusal(head: &[u8]) -> Option<String> {
    let is_text = head.iter().all(|byte| matches!(byte, b'\t' | b'\n' | b'\r' | b' '..=b'~' | 0x80..));
    if head.is_empty() {
        Some("is empty, no shared library".to_owned())
    } else if head.starts_with(b"!<arch>\n") {
        let cure = "gfortran -shared -o gapelectr.so -Wl,--whole-archive LIBRARY.a -Wl,--no-whole-archive";
        Some(format!("is a static library, no shared one (make one of it: `{cure}`)"))
    } else if is_text {
        Some(format!(
            "is a text, no shared library (if it is the source of the routine, compile it: `{COMPILE_COMMAND}`)"
        ))
    } else if head.starts_with(b"\x7fELF") {
        if cfg!(target_os = "linux") {
            refusal_of_elf(head)
        } else {
            Some("is a library for another system".to_owned())
        }
    } else if cfg!(target_os = "linux") {
        let kind = match head {
            [b'M', b'Z', ..] => "is a library or program of Windows, not for this system",
            [0xCF | 0xCE, 0xFA, 0xED, 0xFE, ..] | [0xCA, 0xFE, 0xBA, 0xBE, ..] => {
                "is a library or program of macOS, not for this system"
            }
            _ => "is no shared library",
        };
        Some(format!("{kind} (compile the routine on this machine: `{COMPILE_COMMAND}`)"))
    } else {
        None
    }
}

fn refusal_of_elf(head: &[u8]) -> Option<String> {
    let [class, order] = [head.get(4)?, head.get(5)?];
    let is_big_endian = *order == 2;
    let half = |at: usize| {
        let bytes = [*head.get(at)?, *head.get(at + 1)?];
        Some(if is_big_endian { u16::from_be_bytes(bytes) } else { u16::from_le_bytes(bytes) })
    };
    let (Some(kind), Some(machine)) = (half(16), half(18)) else {
        return Some("is cut off, no whole shared library".to_owned());
    };
    let found = MACHINES.iter().find(|(code, ..)| *code == machine);
    let ours = MACHINES.iter().find(|(_, name, _)| *name == std::env::consts::ARCH);
    let is_ours = ours.is_none_or(|ours| found == Some(ours))
        && is_big_endian == cfg!(target_endian = "big")
        && (*class == 2) == cfg!(target_pointer_width = "64");
    if !is_ours {
        let of = found.map_or_else(|| format!("machine {machine}"), |(_, _, name)| (*name).to_owned());
        let this = ours.map_or(std::env::consts::ARCH, |(_, _, name)| *name);
        return Some(format!(
            "is compiled for {of}, and this program for {this} (compile the routine on this machine: \
             `{COMPILE_COMMAND}`)"
        ));
    }
    match kind {
        RELOCATABLE => {
            let cure = "gfortran -shared -o gapelectr.so gapelectr.o";
            Some(format!("is an object file that is not linked (link it: `{cure}`, compiled with `-fPIC`)"))
        }
        EXECUTABLE => Some(format!("is a program, no shared library (compile the routine alone: `{COMPILE_COMMAND}`)")),
        _ => None,
    }
}
