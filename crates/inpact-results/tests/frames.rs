//! Reading state by state gives what reading as a whole gives, from a source of any pace.

mod common;

use common::{contact_fil, dat, frd, rpt};
use inpact_results::{Error, ErrorKind, Frame, Results, read, read_frames};
use std::io::{self, Read};
use std::ops::ControlFlow;

/// A source that gives so many bytes at a time.
struct Trickle<'a>(&'a [u8], usize);

impl Read for Trickle<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.1.min(self.0.len()).min(buffer.len());
        buffer[..count].copy_from_slice(&self.0[..count]);
        self.0 = &self.0[count..];
        Ok(count)
    }
}

fn files() -> [Vec<u8>; 4] {
    [contact_fil().bytes(), frd().into_bytes(), dat().into_bytes(), rpt().into_bytes()]
}

/// All states of a source, and what is left of it.
fn gathered(source: &mut dyn Read) -> (Vec<Frame>, Result<Results, Error>) {
    let mut frames = Vec::new();
    let outcome = read_frames(source, &mut |head, frame| {
        assert_eq!(head.frames, [], "states are handed over, not kept");
        frames.push(frame);
        ControlFlow::Continue(())
    });
    (frames, outcome)
}

/// NaN stands where a file has no value, and is not equal to itself.
fn text(what: &impl std::fmt::Debug) -> String {
    format!("{what:?}")
}

#[test]
fn states_are_those_of_the_whole() {
    for file in files() {
        let mut expected = read(&file).expect("whole");
        for pace in [1, 7, 80, 1 << 20] {
            let (frames, outcome) = gathered(&mut Trickle(&file, pace));
            assert_eq!(text(&frames), text(&expected.frames));
            let kept = std::mem::take(&mut expected.frames);
            assert_eq!(text(&outcome.expect("whole")), text(&expected));
            expected.frames = kept;
        }
    }
}

#[test]
fn a_file_cut_short_gives_the_states_before() {
    for file in files() {
        for end in (0..file.len()).step_by(37) {
            let (frames, outcome) = gathered(&mut Trickle(&file[..end], 113));
            match (read(&file[..end]), outcome) {
                (Ok(expected), Ok(_)) => assert_eq!(text(&frames), text(&expected.frames)),
                (Err(expected), Err(found)) => {
                    assert_eq!(text(found.kind()), text(expected.kind()));
                    // One that is too short to tell of which kind it is has nothing.
                    let read = expected.into_read().map(|read| read.frames).unwrap_or_default();
                    assert_eq!(text(&frames), text(&read));
                }
                (expected, found) => panic!("cut at {end}: {expected:?} and {found:?}"),
            }
        }
    }
}

/// Coordinates and surfaces are known when the first state is handed over.
#[test]
fn whoever_wants_no_more_states_gets_none() {
    for file in [contact_fil().bytes(), frd().into_bytes(), dat().into_bytes()] {
        let whole = read(&file).expect("whole");
        let mut taken = 0;
        let outcome = read_frames(&mut Trickle(&file, 64), &mut |head, frame| {
            assert_eq!(text(&head.coordinates), text(&whole.coordinates));
            assert_eq!(head.surfaces, whole.surfaces);
            assert_eq!(text(&frame), text(&whole.frames[0]));
            taken += 1;
            ControlFlow::Break(())
        });
        assert!(outcome.is_ok() && taken == 1);
    }
}

#[test]
fn a_source_that_fails_is_no_file_cut_short() {
    struct Failing<'a>(&'a [u8]);
    impl Read for Failing<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            if self.0.is_empty() {
                return Err(io::Error::other("the disk is gone"));
            }
            self.0.read(buffer)
        }
    }
    let file: Vec<u8> = frd().into_bytes();
    // More than is looked at to find out the kind.
    let long = [&file[..file.len() - 6], "    1UX\n".repeat(20_000).as_bytes()].concat();
    for bytes in [&file[..], &long] {
        let (_, outcome) = gathered(&mut Failing(bytes));
        assert!(
            matches!(&outcome.as_ref().map_err(Error::kind), Err(ErrorKind::Source(error)) if error.to_string() == "the disk is gone"),
            "{outcome:?}"
        );
    }
}
