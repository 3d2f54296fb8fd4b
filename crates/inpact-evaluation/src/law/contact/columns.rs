//! Contact over columns: the states of rows that all have clearance and pressure, and the number of rows with a state.

#![expect(
    clippy::inline_always,
    reason = "what is not inlined is compiled without the instruction set that was asked for"
)]
#![expect(clippy::needless_bitwise_bool, reason = "a branch a number would keep a loop from its vectors")]

use super::ContactState;
use crate::kernel::{InstructionSet, Lanes, Operation};

/// The states of rows by clearance and pressure ([`ContactState::from_clearance_and_pressure`]).
pub(crate) fn contact_states(clearance: &[f64], pressure: &[f64], states: &mut [Option<ContactState>]) {
    InstructionSet::best().run(FindStates { clearance, pressure, states });
}

struct FindStates<'a> {
    clearance: &'a [f64],
    pressure: &'a [f64],
    states: &'a mut [Option<ContactState>],
}

impl Operation for FindStates<'_> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lanes>(self, _: L) {
        for ((state, d), p) in self.states.iter_mut().zip(self.clearance).zip(self.pressure) {
            let is_closed = (*d <= 0.0) | (*p < 0.0) | (*p > 0.0);
            let is_undetermined = d.is_nan() | p.is_nan();
            let apart = if is_undetermined { ContactState::Undetermined } else { ContactState::Open };
            *state = Some(if is_closed { ContactState::Closed } else { apart });
        }
    }
}

/// How many rows have a state.
pub(crate) fn count_states(states: &[Option<ContactState>], state: Option<ContactState>) -> u64 {
    /// Few enough for a count in a byte.
    const BLOCK: usize = 128;
    let of_block = |block: &[Option<ContactState>]| {
        u64::from(block.iter().fold(0_u8, |count, found| count + u8::from(*found == state)))
    };
    states.chunks(BLOCK).map(of_block).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::contact::{Clearance, ContactPressure};

    #[test]
    fn states_of_columns_are_those_of_points() {
        let numbers = [0.0, -0.0, 1.0, -1.0, 5e-324, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
        let pairs = numbers.iter().flat_map(|d| numbers.iter().map(|p| (*d, *p))).cycle().take(500);
        let (clearance, pressure): (Vec<f64>, Vec<f64>) = pairs.unzip();
        let mut states = vec![None; clearance.len()];
        contact_states(&clearance, &pressure, &mut states);
        for (row, state) in states.iter().enumerate() {
            let (d, p) = (Clearance(clearance[row]), ContactPressure(pressure[row]));
            assert_eq!(*state, Some(ContactState::from_clearance_and_pressure(d, p)), "{d:?} {p:?}");
        }
        for state in [ContactState::Closed, ContactState::Open, ContactState::Undetermined].map(Some) {
            let count = states.iter().filter(|found| **found == state).count() as u64;
            assert_eq!(count_states(&states, state), count);
        }
    }
}
