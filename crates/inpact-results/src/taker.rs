//! Hands over the states of a file one by one, for all readers of formats.

use crate::error::{Read, ended};
use crate::lines::LineStream;
use crate::problem::Problem;
use crate::results::{Frame, Results};
use std::ops::ControlFlow;

/// Takes states one by one, each with the preceding data that belong to no state; may stop.
pub type TakeFrame<'a> = dyn FnMut(&Results, Frame) -> ControlFlow<()> + 'a;

/// A reader of a format, state by state.
pub(crate) type ReadFrames = fn(&mut LineStream<'_>, &mut TakeFrame<'_>) -> (Results, Result<(), Problem>);

/// Reads all states of bytes in memory.
pub(crate) fn read_whole(mut bytes: &[u8], read: ReadFrames) -> Read {
    let mut frames = Vec::new();
    let mut take = |_: &Results, frame| {
        frames.push(frame);
        ControlFlow::Continue(())
    };
    let (mut results, outcome) = read(&mut LineStream::new(&mut bytes), &mut take);
    results.frames = frames;
    ended(results, outcome)
}

/// Passes on states until the receiver stops.
pub(crate) struct Taker<'a, 'b> {
    take: &'a mut TakeFrame<'b>,
    /// Whether the receiver has stopped.
    pub(crate) is_over: bool,
}

impl<'a, 'b> Taker<'a, 'b> {
    pub(crate) fn new(take: &'a mut TakeFrame<'b>) -> Self {
        Self { take, is_over: false }
    }

    /// Passes on a state, if there is one.
    pub(crate) fn take(&mut self, results: &Results, frame: Option<Frame>) {
        if let Some(frame) = frame.filter(|_| !self.is_over) {
            self.is_over = (self.take)(results, frame).is_break();
        }
    }
}
