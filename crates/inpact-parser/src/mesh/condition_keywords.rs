//! The keywords of conditions of a step.

/// The keywords that conditions are read of.
pub(super) const TAKEN: [&str; 8] =
    ["BOUNDARY", "CFLUX", "CECURRENT", "DFLUX", "DSFLUX", "DSECURRENT", "FILM", "SFILM"];

/// The keywords of conditions on the same fields that are not read.
const NOT_TAKEN: [&str; 16] = [
    "CFILM",
    "CFLOW",
    "CRADIATE",
    "DECURRENT",
    "DFLOW",
    "DSFLOW",
    "FIELD",
    "FLOW",
    "MASS FLOW RATE",
    "RADIATE",
    "RADIATION VIEWFACTOR",
    "CAVITY DEFINITION",
    "SFLOW",
    "SRADIATE",
    "TEMPERATURE",
    "MODEL CHANGE",
];

/// The keyword of a condition, by its name in upper case and without blanks.
pub(super) fn condition(name: &str) -> Option<&'static str> {
    TAKEN.into_iter().chain(NOT_TAKEN).find(|keyword| is_called(keyword, name))
}

/// Whether a keyword has that name, which is in upper case and without blanks.
pub(super) fn is_called(keyword: &str, name: &str) -> bool {
    keyword.bytes().filter(|byte| *byte != b' ').eq(name.bytes())
}
