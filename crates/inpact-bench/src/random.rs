//! A small seeded generator of pseudo-random numbers.
//!
//! A generated file depends on its seed alone: no clock, no platform's mathematics library, no
//! dependency whose next version generates other numbers.
//! The stream is xorshift64* (Vigna 2016); the seed is scrambled with the finaliser of splitmix64, so that
//! neighbouring seeds give unrelated streams.

/// A stream of pseudo-random numbers.
#[derive(Debug, Clone)]
pub struct Random {
    state: u64,
}

impl Random {
    /// The stream of one seed.
    pub fn new(seed: u64) -> Self {
        // xorshift has one forbidden state, zero.
        Self { state: scramble(seed).max(1) }
    }

    /// The stream number `index` of the family `seed`: an item can be generated without its
    /// predecessors.
    pub fn of_item(seed: u64, index: u64) -> Self {
        Self::new(scramble(seed) ^ index.wrapping_mul(0xA24B_AED4_963E_E407))
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.state ^= self.state >> 12;
        self.state ^= self.state << 25;
        self.state ^= self.state >> 27;
        self.state.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }

    /// A number in `0.0..1.0`, from the upper 53 bits.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / 9_007_199_254_740_992.0
    }

    /// A number in `low..high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// An integer in `low..=high`.
    pub fn whole(&mut self, low: u64, high: u64) -> u64 {
        low + self.bits() % (high - low + 1)
    }
}

/// The finaliser of splitmix64: every bit of the result depends on every bit of `value`.
fn scramble(value: u64) -> u64 {
    let value = value.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let value = (value ^ (value >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let value = (value ^ (value >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    value ^ (value >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_gives_one_stream_and_another_seed_another() {
        let draw = |seed| {
            let mut random = Random::new(seed);
            [random.bits(), random.bits(), random.bits()]
        };
        assert_eq!(draw(1), draw(1));
        assert_ne!(draw(1), draw(2));
    }

    #[test]
    fn numbers_stay_in_their_range_and_fill_it() {
        let mut random = Random::new(7);
        let mut counts = [0_u32; 10];
        for _ in 0..10_000 {
            let value = random.between(20.0, 30.0);
            assert!((20.0..30.0).contains(&value));
            let whole = random.whole(3, 12);
            assert!((3..=12).contains(&whole));
            counts[usize::try_from(whole - 3).expect("at most 9")] += 1;
        }
        // 1000 each are expected, with a standard deviation of 30.
        assert!(counts.iter().all(|count| (850..1150).contains(count)), "{counts:?}");
    }
}
