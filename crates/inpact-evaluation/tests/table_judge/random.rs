//! Random numbers that reach all decades, short ones and those next to a power of two more often than chance would.

/// Random numbers, the same in every run.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number below `limit`.
    pub fn below(&mut self, limit: usize) -> usize {
        usize::try_from(self.bits() % u64::try_from(limit).unwrap()).unwrap()
    }

    /// A number from 0 to 1.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / 9_007_199_254_740_992.0
    }

    /// A positive number with a binary exponent from `least` to `greatest`, -1074 to 1023; significands are random, short or next to a power of two.
    pub fn positive(&mut self, least: i32, greatest: i32) -> f64 {
        let span = usize::try_from(greatest - least + 1).unwrap();
        let exponent = least + i32::try_from(self.below(span)).unwrap();
        let noise = self.bits() >> 12;
        let fraction = match self.below(8) {
            0 => 0,
            1 => self.bits() & 7,
            2 => ((1 << 52) - 1) - (self.bits() & 7),
            3 => noise & !((1 << 44) - 1),
            _ => noise,
        };
        if exponent < -1022 {
            let bits = (1 << (exponent + 1074)) | (fraction >> (52 - (exponent + 1074)));
            return f64::from_bits(bits);
        }
        f64::from_bits(u64::try_from(exponent + 1023).unwrap() << 52 | fraction)
    }

    /// A number that is not negative, over all decades, zero included.
    pub fn of_any_decade(&mut self) -> f64 {
        match self.below(12) {
            0 => 0.0,
            1 => self.positive(-1074, -1000),
            2 => self.positive(1000, 1023),
            3 => 1.0,
            _ => self.positive(-1074, 1023),
        }
    }

    /// A number of either sign over all decades.
    pub fn signed(&mut self) -> f64 {
        let magnitude = self.of_any_decade();
        if self.below(2) == 0 { magnitude } else { -magnitude }
    }

    /// An abscissa above `x`: next to it, near it, of its own size or anywhere above.
    pub fn above(&mut self, x: f64) -> f64 {
        let candidate = match self.below(6) {
            0 => (0..=self.below(4)).fold(x, |x, _| x.next_up()),
            1 => x + x.abs() * self.positive(-52, 0),
            2 => x + x.abs() * self.positive(-2, 3),
            3 => x + self.positive(-60, 60),
            _ => self.signed(),
        };
        if candidate > x && candidate.is_finite() { candidate } else { x.next_up().min(f64::MAX) }
    }

    /// A point of the segment from `a` to `b`: at, next to or a random way from either end, about the middle, or of any size.
    pub fn within(&mut self, a: f64, b: f64) -> f64 {
        let part = match self.below(3) {
            0 => self.unit(),
            1 => self.positive(-60, -1),
            _ => 0.5 + self.positive(-56, -20) * [1.0, -1.0][self.below(2)],
        };
        let candidate = match self.below(7) {
            0 => (0..self.below(4)).fold(a, |x, _| x.next_up()),
            1 => (0..self.below(4)).fold(b, |x, _| x.next_down()),
            2 => self.signed(),
            3 => a + (b * 0.5 - a * 0.5) * part * 2.0,
            4 => b - (b * 0.5 - a * 0.5) * part * 2.0,
            _ => a * (1.0 - part) + b * part,
        };
        if candidate.is_nan() { a } else { candidate.clamp(a, b) }
    }
}
