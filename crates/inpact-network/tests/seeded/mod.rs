//! Random numbers of few digits, as decks have them.

#![allow(dead_code, reason = "each test file uses its own part")]

/// Random numbers, the same in every run (splitmix64).
pub(crate) struct Random {
    state: u64,
    spread: Spread,
}

/// Over how many decades conductances and areas go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Spread {
    /// Three.
    Moderate,
    /// Seven.
    DoubleDouble,
}

impl Random {
    pub(crate) fn of(seed: u64, spread: Spread) -> Self {
        Self { state: seed, spread }
    }

    pub(crate) fn unit(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number of few digits, as decks have them.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        ((low + (high - low) * self.unit()) * 1000.0).round() / 1000.0
    }

    /// A number from 0.03 to 30, or from 0.001 to 10000.
    pub(crate) fn magnitude(&mut self) -> f64 {
        let exponent = match self.spread {
            Spread::Moderate => self.between(-1.5, 1.5),
            Spread::DoubleDouble => self.between(-3.0, 4.0),
        };
        (10_f64.powf(exponent) * 1000.0).round() / 1000.0
    }

    pub(crate) fn below(&mut self, limit: u32) -> u32 {
        // Truncated towards zero, as is meant.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let number = (self.unit() * f64::from(limit)) as u32;
        number
    }

    pub(crate) fn is(&mut self, share: f64) -> bool {
        self.unit() < share
    }
}
