//! Dimensions of data columns in the manual's base quantities M, L, T, θ, φ, C.
//!
//! Abaqus has no units, only dimensions (O-2): the author of a deck keeps them consistent.
//! Energy J and force F of the manual are written out: J = M L^2 T^-2, F = M L T^-2.

use crate::Error;
use serde::Deserialize;
use std::fmt;
use std::str::FromStr;

/// A product of powers of the base quantities; 1 when all exponents are 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(try_from = "String")]
pub struct Dimension {
    exponents: [i8; Base::ALL.len()],
}

/// A base quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Base {
    /// M
    Mass,
    /// L
    Length,
    /// T
    Time,
    /// θ
    Temperature,
    /// φ, electric potential
    Potential,
    /// C, electric charge
    Charge,
}

impl Base {
    /// Every base quantity, in the order in which a dimension is written.
    pub const ALL: [Self; 6] = [Self::Mass, Self::Length, Self::Time, Self::Temperature, Self::Potential, Self::Charge];

    /// The manual's letter for it.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Mass => "M",
            Self::Length => "L",
            Self::Time => "T",
            Self::Temperature => "θ",
            Self::Potential => "φ",
            Self::Charge => "C",
        }
    }
}

impl Dimension {
    /// The exponent of the quantity.
    pub fn exponent(self, base: Base) -> i8 {
        self.exponents[base as usize]
    }

    /// Whether it is 1, the dimension of a plain number.
    pub fn is_one(self) -> bool {
        self == Self::default()
    }
}

/// Positive powers first: `C L^-2 T^-1 φ^-1`; `1` for a plain number.
impl fmt::Display for Dimension {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let powers = Base::ALL.into_iter().map(|base| (base, self.exponent(base)));
        let (positive, negative): (Vec<_>, Vec<_>) =
            powers.filter(|(_, power)| *power != 0).partition(|(_, power)| *power > 0);
        let written = positive.into_iter().chain(negative).map(|(base, power)| match power {
            1 => base.symbol().to_owned(),
            _ => format!("{}^{power}", base.symbol()),
        });
        let written: Vec<String> = written.collect();
        formatter.pad(&if written.is_empty() { "1".to_owned() } else { written.join(" ") })
    }
}

impl FromStr for Dimension {
    type Err = Error;

    fn from_str(written: &str) -> Result<Self, Error> {
        let error = |reason| Error::dimension(written, reason);
        let mut dimension = Self::default();
        if written == "1" {
            return Ok(dimension);
        }
        for factor in written.split(' ') {
            let (symbol, power) = factor.split_once('^').unwrap_or((factor, "1"));
            let base = Base::ALL.into_iter().find(|base| base.symbol() == symbol);
            let base = base.ok_or_else(|| {
                error("its factors are powers of M, L, T, θ, φ and C with single blanks between them")
            })?;
            let power: i8 = power.parse().map_err(|_| error("an exponent is a small integer"))?;
            if power == 0 {
                return Err(error("a factor with exponent 0 is left out"));
            }
            let exponent = &mut dimension.exponents[base as usize];
            if *exponent != 0 {
                return Err(error("expected each quantity once"));
            }
            *exponent = power;
        }
        Ok(dimension)
    }
}

impl TryFrom<String> for Dimension {
    type Error = Error;

    fn try_from(written: String) -> Result<Self, Error> {
        written.parse()
    }
}

#[cfg(test)]
mod tests {
    use super::{Base, Dimension};

    fn check(written: &str, shown: &str) {
        let dimension: Dimension = written.parse().unwrap();
        assert_eq!(dimension.to_string(), shown);
        assert_eq!(shown.parse(), Ok(dimension));
    }

    #[test]
    fn reads_and_shows_dimensions() {
        check("C T^-1 L^-2 φ^-1", "C L^-2 T^-1 φ^-1");
        check("M L^-1 T^-2", "M L^-1 T^-2");
        check("L^2 T M^-1", "L^2 T M^-1");
        check("θ", "θ");
        check("1", "1");
    }

    #[test]
    fn tells_exponents() {
        let conductance: Dimension = "C T^-1 L^-2 φ^-1".parse().unwrap();
        assert_eq!(Base::ALL.map(|base| conductance.exponent(base)), [0, -2, -1, 0, -1, 1]);
        assert!(!conductance.is_one());
        assert!("1".parse::<Dimension>().unwrap().is_one());
    }

    #[test]
    fn refuses_what_is_no_dimension() {
        for written in ["", "J", "L L", "L^0", "L^x", "L  T", "L^", " L", "l", "L^300", "1 L"] {
            assert!(written.parse::<Dimension>().is_err(), "{written:?}");
        }
    }
}
