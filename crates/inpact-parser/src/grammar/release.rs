//! The releases of Abaqus whose keyword language is distinguished (2.8).

use crate::Error;
use serde::Deserialize;
use std::fmt;
use std::str::FromStr;

/// A release of Abaqus, oldest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Deserialize)]
#[serde(try_from = "String")]
#[non_exhaustive]
pub enum Release {
    /// 6.11
    R6_11,
    /// 6.14
    R6_14,
    /// 2016
    R2016,
    /// 2017
    R2017,
    /// 2022
    R2022,
    /// 2024
    #[default]
    R2024,
}

impl Release {
    /// The default release.
    pub const NEWEST: Self = Self::R2024;

    /// Every release, oldest first.
    pub const ALL: [Self; 6] = [Self::R6_11, Self::R6_14, Self::R2016, Self::R2017, Self::R2022, Self::R2024];

    /// Whether an item introduced in `since` and last available in `until` exists; an unknown bound excludes no release.
    pub fn is_within(self, since: Option<Self>, until: Option<Self>) -> bool {
        since.is_none_or(|since| since <= self) && until.is_none_or(|until| self <= until)
    }

    fn name(self) -> &'static str {
        match self {
            Self::R6_11 => "6.11",
            Self::R6_14 => "6.14",
            Self::R2016 => "2016",
            Self::R2017 => "2017",
            Self::R2022 => "2022",
            Self::R2024 => "2024",
        }
    }
}

impl fmt::Display for Release {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(self.name())
    }
}

impl FromStr for Release {
    type Err = Error;

    fn from_str(written: &str) -> Result<Self, Error> {
        let found = Self::ALL.into_iter().find(|release| release.name() == written.trim());
        found.ok_or_else(|| Error::release(written))
    }
}

impl TryFrom<String> for Release {
    type Error = Error;

    fn try_from(written: String) -> Result<Self, Error> {
        written.parse()
    }
}

#[cfg(test)]
mod tests {
    use super::Release;

    #[test]
    fn names_read_back_and_are_in_order() {
        for release in Release::ALL {
            assert_eq!(release.to_string().parse(), Ok(release));
        }
        assert!(Release::ALL.is_sorted());
        assert_eq!(Release::ALL.last(), Some(&Release::NEWEST));
        assert_eq!(Release::default(), Release::NEWEST);
        assert!("6.12".parse::<Release>().is_err());
    }

    #[test]
    fn bounds_that_are_not_known_hold_none_back() {
        assert!(Release::R6_11.is_within(None, None));
        assert!(Release::R2017.is_within(Some(Release::R2017), None));
        assert!(!Release::R2016.is_within(Some(Release::R2017), None));
        assert!(Release::R6_14.is_within(None, Some(Release::R6_14)));
        assert!(!Release::R2016.is_within(None, Some(Release::R6_14)));
    }
}
