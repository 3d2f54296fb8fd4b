//! User-defined conductance: a shared library with the Fortran routine GAPELECTR (semantics 7.1, U-1, U-2, S-43).
//!
//! The only place where foreign native code is loaded and called, and so the only one with `unsafe`.
//!
//! ## Calling convention
//!
//! That of gfortran, and of other Fortran compilers on the same systems:
//!
//! ```fortran
//!       SUBROUTINE GAPELECTR(SIGMA,D,TEMP,PREDEF,TIME,CINAME,SLNAME,
//!      1   MSNAME,COORDS,NODE,NPRED,KSTEP,KINC)
//!       INCLUDE 'ABA_PARAM.INC'
//!       CHARACTER*80 CINAME,SLNAME,MSNAME
//!       DIMENSION SIGMA(3),TEMP(2),PREDEF(2,*),TIME(2),COORDS(2,3)
//! ```
//!
//! - The symbol is the name in lower case with an underscore: `gapelectr_`.
//! - Every argument is passed by address. Reals are REAL*8, as `ABA_PARAM.INC` declares with `IMPLICIT REAL*8 (A-H,O-Z)`; integers are default INTEGER.
//! - Arrays are in column-major order: COORDS(1,1), COORDS(2,1), COORDS(1,2) and so on; PREDEF(1,1), PREDEF(2,1), PREDEF(1,2) and so on.
//! - The lengths of the three CHARACTER arguments follow after all other arguments, by value, as `size_t`.
//!
//! ## Why the calls are sound, as far as possible
//!
//! - The routine is given copies that live as long as the call, so that it may write to its arguments, as Fortran allows.
//!   SIGMA has room for eight numbers: a routine that writes more than three of them is detected.
//! - Integers are stored in eight bytes with the value in the first four (and, little-endian, in all eight), so that a routine compiled with `-fdefault-integer-8` reads them as well.
//! - One call at a time in the whole process: COMMON and SAVE are not thread-safe.
//! - The library is never unloaded, so the address of the routine stays valid, and so does the code of the library's own threads (OpenMP).
//! - The library is loaded by a separate thread: one that was linked with `-ffast-math` disables subnormal numbers in the thread that loads it.
//!
//! Other misuse by the routine (a wild pointer, another argument list) cannot be checked: it runs because the user names the file, and a crash in it ends the program.
//! A STOP in it ends the program too, with a message.

#![allow(unsafe_code)]

mod image;
mod stopping;
#[cfg(test)]
mod tests;

use crate::failure::Failure;
use inpact_evaluation::law::{
    NAME_LENGTH, UserConductance, UserConductancePoint, UserConductanceValue, UserFault, UserLaw,
};
use libloading::Library;
use std::ffi::c_char;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

const SYMBOL: &str = "gapelectr_";

/// The command that compiles the routine, for messages.
pub(crate) const COMPILE_COMMAND: &str = "gfortran -shared -fPIC -o gapelectr.so gapelectr.f";

/// Room for SIGMA: its three numbers, and some to see whether the routine writes beyond them.
const ROOM_OF_SIGMA: usize = 8;

/// SUBROUTINE GAPELECTR.
type GapElectr = unsafe extern "C" fn(
    sigma: *mut f64,
    d: *mut f64,
    temp: *mut f64,
    predef: *mut [f64; 2],
    time: *mut f64,
    ciname: *mut c_char,
    slname: *mut c_char,
    msname: *mut c_char,
    coords: *mut [f64; 2],
    node: *mut i64,
    npred: *mut i64,
    kstep: *mut i64,
    kinc: *mut i64,
    length_of_ciname: usize,
    length_of_slname: usize,
    length_of_msname: usize,
);

/// Admits one call at a time, and has room for the copy of PREDEF.
static ONE_CALL: Mutex<Vec<[f64; 2]>> = Mutex::new(Vec::new());

/// GAPELECTR in a library that stays loaded for as long as the program runs.
struct FortranRoutine {
    routine: GapElectr,
}

/// Loads a shared library and finds GAPELECTR in it.
pub(crate) fn load(path: &Path) -> Result<UserLaw, Failure> {
    image::check(path)?;
    // A bare name would be looked for in the folders of the system.
    let whole = std::path::absolute(path).map_err(|error| Failure::read(path, error))?;
    let library = open_in_a_thread(path, whole)?;
    // SAFETY: the symbol is taken for what the calling convention says; whether it is, the user answers for who names the file.
    let routine = unsafe { library.get::<GapElectr>(SYMBOL) }.map(|symbol| *symbol);
    let routine = routine.map_err(|_| without_symbol(path, library))?;
    stopping::watch();
    Ok(UserLaw::new(FortranRoutine { routine }))
}

/// Opens the library with all its symbols resolved, so that one that is missing is reported now and not in the middle of a run; it stays loaded.
fn open_in_a_thread(path: &Path, whole: PathBuf) -> Result<&'static Library, Failure> {
    let open = move || {
        // SAFETY: initialisers of the library run here; the user names the file for that.
        #[cfg(unix)]
        let opened = unsafe {
            use libloading::os::unix;
            unix::Library::open(Some(whole), unix::RTLD_NOW | unix::RTLD_LOCAL).map(Library::from)
        };
        // SAFETY: as above.
        #[cfg(not(unix))]
        let opened = unsafe { Library::new(whole) };
        // Threads that the library started may run its code until the program ends.
        opened.map(|library| &*Box::leak(Box::new(library)))
    };
    let thread = std::thread::Builder::new().spawn(open);
    let thread = thread.map_err(|error| {
        Failure::Usage(format!("cannot load `{}`: no thread can be started to load it in ({error})", path.display()))
    })?;
    let opened = thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
    opened.map_err(|error| cannot_load(path, &error))
}

/// The message of the system's loader, and the remedy.
fn cannot_load(path: &Path, error: &libloading::Error) -> Failure {
    let said = std::error::Error::source(error).map_or_else(|| error.to_string(), ToString::to_string);
    let cure = match said.split_once("undefined symbol: ") {
        Some((_, symbol)) => {
            let symbol = symbol.split([' ', ',', '(']).next().unwrap_or_default();
            format!(
                "it calls `{symbol}`, which is not in it: if that is a routine of Abaqus (XIT, GETJOBNAME, …), \
                 write one of that name and compile it into the library"
            )
        }
        None => format!("compile the routine on this machine: `{COMPILE_COMMAND}`"),
    };
    Failure::Usage(format!("cannot load `{}`: {said} ({cure})", path.display()))
}

/// The library has no GAPELECTR; what it has instead, as far as that can be guessed.
fn without_symbol(path: &Path, library: &Library) -> Failure {
    // SAFETY: the address is only looked up, never used.
    let has = |symbol: &str| unsafe { library.get::<*const ()>(symbol) }.is_ok();
    let cure = if ["gapelectr", "GAPELECTR"].into_iter().any(has) {
        "it has one without the underscore: compile it without `-fno-underscoring`, or with gfortran".to_owned()
    } else if has("gapcon_") {
        "it has GAPCON, the subroutine of the thermal conductance, which is not evaluated".to_owned()
    } else {
        format!("is SUBROUTINE GAPELECTR in the file that was compiled? `{COMPILE_COMMAND}`")
    };
    Failure::Usage(format!("`{}` has no user subroutine GAPELECTR, no symbol `{SYMBOL}` ({cure})", path.display()))
}

impl UserConductance for FortranRoutine {
    fn conductance(&self, point: &UserConductancePoint<'_>) -> Result<UserConductanceValue, UserFault> {
        let mut predef = ONE_CALL.lock().unwrap_or_else(PoisonError::into_inner);
        predef.clear();
        predef.extend_from_slice(point.field_variables);
        if predef.is_empty() {
            // An address that may be read, although NPRED = 0 says that nothing is there.
            predef.push([0.0; 2]);
        }
        let mut sigma = [0.0; ROOM_OF_SIGMA];
        let (mut clearance, mut temperatures, mut time) = (point.clearance, point.temperatures, point.time);
        let [slave, master] = point.coordinates;
        let mut coordinates = [[slave[0], master[0]], [slave[1], master[1]], [slave[2], master[2]]];
        let names = point.names;
        let [mut interaction, mut slave, mut master] =
            [names.interaction, names.slave, names.master].map(|name| *name.as_bytes());
        let field_variables = i64::try_from(point.field_variables.len()).unwrap_or(i64::MAX);
        let mut integers =
            [i64::from(point.node), field_variables, i64::from(point.step), i64::from(point.increment)].map(integer);
        let [node, npred, kstep, kinc] = &mut integers;
        stopping::during(point, || {
            // SAFETY: every address is that of a value of ours with the size the calling convention gives it, which nothing else uses during the call; the library is never unloaded; `predef` is locked, so no other call is under way.
            unsafe {
                (self.routine)(
                    sigma.as_mut_ptr(),
                    &raw mut clearance,
                    temperatures.as_mut_ptr(),
                    predef.as_mut_ptr(),
                    time.as_mut_ptr(),
                    interaction.as_mut_ptr().cast(),
                    slave.as_mut_ptr().cast(),
                    master.as_mut_ptr().cast(),
                    coordinates.as_mut_ptr(),
                    node,
                    npred,
                    kstep,
                    kinc,
                    NAME_LENGTH,
                    NAME_LENGTH,
                    NAME_LENGTH,
                );
            }
        });
        value(sigma)
    }
}

/// An integer whose first four bytes have its value, on big-endian machines too.
fn integer(value: i64) -> i64 {
    if cfg!(target_endian = "big") { value << 32 } else { value }
}

/// The value that the routine left in SIGMA, which was zero.
fn value(sigma: [f64; ROOM_OF_SIGMA]) -> Result<UserConductanceValue, UserFault> {
    if let Some(beyond) = (3..ROOM_OF_SIGMA).find(|index| sigma[*index].to_bits() != 0) {
        return Err(UserFault::Refused(format!("writes SIGMA({}), but SIGMA has three items", beyond + 1)));
    }
    // A REAL*4 in the place of a REAL*8: of a number of that kind alone the upper half is zero.
    let is_half = |item: f64| item.to_bits() != 0 && item.to_bits() >> 32 == 0;
    if cfg!(target_endian = "little") && sigma.into_iter().any(is_half) {
        let why = "writes numbers of single precision: put `IMPLICIT REAL*8 (A-H,O-Z)` into `ABA_PARAM.INC`, \
                   include it, and compile again";
        return Err(UserFault::Refused(why.to_owned()));
    }
    Ok(UserConductanceValue { conductance: sigma[0], slopes: [sigma[1], sigma[2]] })
}
