//! Conductance by a user subroutine: *GAP ELECTRICAL CONDUCTANCE, USER.
//!
//! Abaqus passes a [`UserConductancePoint`] to its user subroutine GAPELECTR, which returns a [`UserConductanceValue`].
//! Anything that maps the one to the other is a [`UserConductance`]: a Fortran library (`--user-library` on the command line), or a type of a program that uses this crate.
//!
//! | symbol | meaning | unit | argument of GAPELECTR |
//! |---|---|---|---|
//! | σ_g | gap electrical conductance, >= 0 | C T⁻¹ L⁻² φ⁻¹ | SIGMA(1) |
//! | ∂σ_g/∂θ_A, ∂σ_g/∂θ_B | its slopes along the temperatures of slave and master | C T⁻¹ L⁻² φ⁻¹ θ⁻¹ | SIGMA(2), SIGMA(3) |
//! | d | clearance, as the node data has it: negative in overclosure | L | D |
//! | θ_A, θ_B | temperatures of slave and master | θ | TEMP |
//! | f_A, f_B | field variables of slave and master | | PREDEF, NPRED |
//!
//! The contact pressure is no argument: the manual writes σ_g(θ_A, θ_B, d, p, f_A, f_B), but the interface of the subroutine passes no p (U-1).
//! The slope of the conductance along the average temperature, output `dconductance_dtemp`, is the sum of both slopes.
//! Domain: that of the routine; it is not called for a point with a NaN in clearance, temperature or field variable.
//! Source: semantics 7.1, U-1, U-2, S-43; User Subroutines Reference Guide 1.1.11.
//!
//! A law as a Rust type:
//!
//! ```
//! use inpact_evaluation::law::{UserConductance, UserConductancePoint, UserConductanceValue, UserFault, UserLaw};
//! use inpact_evaluation::plan::Choices;
//!
//! /// σ = a exp(−d/b): the contact opens gradually.
//! struct Fading { a: f64, b: f64 }
//!
//! impl UserConductance for Fading {
//!     fn conductance(&self, point: &UserConductancePoint<'_>) -> Result<UserConductanceValue, UserFault> {
//!         Ok(UserConductanceValue { conductance: self.a * (-point.clearance / self.b).exp(), slopes: [0.0; 2] })
//!     }
//! }
//!
//! let choices = Choices { user_conductance: Some(UserLaw::new(Fading { a: 5.0e7, b: 1.0e-5 })), ..Choices::default() };
//! ```

pub(crate) mod columns;
pub(crate) mod plan;

use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

/// The length of a name for a user subroutine: CHARACTER*80.
pub const NAME_LENGTH: usize = 80;

/// A user-defined conductance.
///
/// An evaluation calls it sequentially, in the order of the rows: a routine may keep state (COMMON and SAVE in Fortran), so no call is repeated or concurrent.
pub trait UserConductance: Send + Sync {
    /// The conductance at one slave node in one increment.
    ///
    /// # Errors
    /// The routine rejects the point. Invalid values are detected by the caller, with [`UserConductanceValue::checked`].
    fn conductance(&self, point: &UserConductancePoint<'_>) -> Result<UserConductanceValue, UserFault>;
}

/// One slave node in one increment, the arguments of a user's routine; pairs are slave and master.
#[derive(Clone, Copy, Debug)]
pub struct UserConductancePoint<'a> {
    /// Clearance d, L; negative in overclosure.
    pub clearance: f64,
    /// Temperatures, θ.
    pub temperatures: [f64; 2],
    /// Field variables from number 1 on.
    pub field_variables: &'a [[f64; 2]],
    /// Step time and total time, T.
    pub time: [f64; 2],
    /// The names of the interaction and its surfaces.
    pub names: &'a UserNames,
    /// Coordinates of the slave node and of the point opposite to it on the master surface, L.
    pub coordinates: [[f64; 3]; 2],
    /// The number of the slave node; 0 where its label is not a number.
    pub node: i32,
    /// The number of the step, from 1.
    pub step: i32,
    /// The number of the increment in the step, from 1.
    pub increment: i32,
}

/// Results of a user's routine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UserConductanceValue {
    /// σ_g, C T⁻¹ L⁻² φ⁻¹.
    pub conductance: f64,
    /// Its slopes along the temperatures of slave and master, C T⁻¹ L⁻² φ⁻¹ θ⁻¹.
    pub slopes: [f64; 2],
}

/// Reasons why the result of a user's routine is not a conductance.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum UserFault {
    /// The conductance or a slope is NaN or infinite.
    NotFinite {
        /// Which: SIGMA(1), the conductance, or a slope, SIGMA(2) or SIGMA(3).
        item: usize,
        /// The number.
        value: f64,
    },
    /// The conductance is below zero, which would create energy (K-13).
    Negative(f64),
    /// The routine, or its caller, rejects the point: the reason, in words that follow "the routine".
    Refused(String),
}

/// The names passed to a user's routine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UserNames {
    /// The surface interaction, CINAME.
    pub interaction: UserName,
    /// The slave surface, SLNAME; blank where it is not known.
    pub slave: UserName,
    /// The master surface, MSNAME; blank where it is not known.
    pub master: UserName,
}

/// A name as in Fortran: 80 characters, padded with blanks.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct UserName([u8; NAME_LENGTH]);

/// A shared [`UserConductance`]; two are equal when they are the same object.
#[derive(Clone)]
pub struct UserLaw(Arc<dyn UserConductance>);

impl UserConductanceValue {
    /// Itself, if it is valid: all numbers finite and the conductance not negative.
    ///
    /// # Errors
    /// The fault.
    #[inline]
    pub fn checked(self) -> Result<Self, UserFault> {
        let items = [self.conductance, self.slopes[0], self.slopes[1]];
        if let Some(index) = items.iter().position(|item| !item.is_finite()) {
            return Err(UserFault::NotFinite { item: index + 1, value: items[index] });
        }
        if self.conductance < 0.0 {
            return Err(UserFault::Negative(self.conductance));
        }
        // A zero conductance is +0, not −0.
        Ok(Self { conductance: self.conductance + 0.0, ..self })
    }

    /// The slope along the average temperature: both sides change equally.
    #[inline]
    pub fn slope_along_mean_temperature(&self) -> f64 {
        self.slopes[0] + self.slopes[1]
    }
}

impl UserName {
    /// The first 80 bytes of `text`, whose case is kept (S-43), or fewer where a character would be split.
    pub fn new(text: &str) -> Self {
        let mut name = [b' '; NAME_LENGTH];
        let most = NAME_LENGTH.min(text.len());
        let length = (0..=most).rfind(|length| text.is_char_boundary(*length)).unwrap_or(0);
        name[..length].copy_from_slice(&text.as_bytes()[..length]);
        Self(name)
    }

    /// No name: blanks.
    pub fn blank() -> Self {
        Self::new("")
    }

    /// The characters, including trailing blanks.
    pub fn as_bytes(&self) -> &[u8; NAME_LENGTH] {
        &self.0
    }

    /// The name without trailing blanks.
    pub fn text(&self) -> Cow<'_, str> {
        String::from_utf8_lossy(self.0.trim_ascii_end())
    }
}

impl fmt::Debug for UserName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:?}", self.text())
    }
}

impl UserLaw {
    /// A law that can be shared.
    pub fn new(law: impl UserConductance + 'static) -> Self {
        Self(Arc::new(law))
    }

    /// The conductance at a point, checked; NaN, without a call, where one of its inputs is NaN.
    ///
    /// # Errors
    /// The routine rejects the point, or returns an invalid conductance.
    #[inline]
    pub fn conductance(&self, point: &UserConductancePoint<'_>) -> Result<UserConductanceValue, UserFault> {
        let fields = point.field_variables.iter().flatten();
        if fields.chain(&point.temperatures).chain([&point.clearance]).any(|quantity| quantity.is_nan()) {
            return Ok(UserConductanceValue { conductance: f64::NAN, slopes: [f64::NAN; 2] });
        }
        self.0.conductance(point)?.checked()
    }
}

impl PartialEq for UserLaw {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl fmt::Debug for UserLaw {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("UserLaw")
    }
}

impl fmt::Display for UserFault {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { item, value } => write!(formatter, "gives SIGMA({item}) = {value}"),
            Self::Negative(value) => write!(formatter, "gives a conductance below zero, SIGMA(1) = {value:?}"),
            Self::Refused(why) => formatter.write_str(why),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// σ = d, slopes as given.
    struct Echo([f64; 2]);

    impl UserConductance for Echo {
        fn conductance(&self, point: &UserConductancePoint<'_>) -> Result<UserConductanceValue, UserFault> {
            Ok(UserConductanceValue { conductance: point.clearance, slopes: self.0 })
        }
    }

    fn answer(slopes: [f64; 2], clearance: f64, temperatures: [f64; 2]) -> Result<UserConductanceValue, UserFault> {
        let blank = UserName::blank();
        let names = UserNames { interaction: blank, slave: blank, master: blank };
        UserLaw::new(Echo(slopes)).conductance(&UserConductancePoint {
            clearance,
            temperatures,
            field_variables: &[[0.0; 2]],
            time: [0.0; 2],
            names: &names,
            coordinates: [[0.0; 3]; 2],
            node: 0,
            step: 1,
            increment: 1,
        })
    }

    #[test]
    fn what_is_no_conductance_is_a_fault() {
        let good = answer([-2.0, 0.5], 3.0, [0.0; 2]).expect("finite, not negative");
        assert_eq!((good.conductance, good.slope_along_mean_temperature()), (3.0, -1.5));
        assert_eq!(answer([0.0; 2], -0.0, [0.0; 2]).map(|value| value.conductance), Ok(0.0));
        assert_eq!(answer([0.0; 2], -1.0, [0.0; 2]), Err(UserFault::Negative(-1.0)));
        let infinite = answer([0.0; 2], f64::INFINITY, [0.0; 2]);
        assert_eq!(infinite, Err(UserFault::NotFinite { item: 1, value: f64::INFINITY }));
        let fault = answer([1.0, f64::NAN], 1.0, [0.0; 2]).expect_err("a slope is NaN");
        assert_eq!(fault.to_string(), "gives SIGMA(3) = NaN");
        assert_eq!(
            answer([f64::NEG_INFINITY, 0.0], 1.0, [0.0; 2]).expect_err("infinite").to_string(),
            "gives SIGMA(2) = -inf"
        );
    }

    #[test]
    fn a_point_with_a_nan_is_not_put_to_the_routine() {
        let of_nan = answer([f64::INFINITY; 2], -1.0, [20.0, f64::NAN]).expect("the routine was not asked");
        assert!(of_nan.conductance.is_nan() && of_nan.slopes.iter().all(|slope| slope.is_nan()));
    }

    #[test]
    fn names_have_80_characters() {
        let name = UserName::new("WELD-FACE");
        assert_eq!(name.as_bytes().len(), 80);
        assert!(name.as_bytes().starts_with(b"WELD-FACE   "));
        assert_eq!(name.text(), "WELD-FACE");
        assert_eq!(UserName::new(&"N".repeat(100)).text(), "N".repeat(80));
        // The 80th byte is the first half of a letter.
        assert_eq!(UserName::new(&format!("{}é", "N".repeat(79))).text(), "N".repeat(79));
        assert_eq!(UserName::blank().text(), "");
    }
}
