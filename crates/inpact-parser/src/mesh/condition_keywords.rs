//! The keywords of conditions of a step.

/// The keywords that conditions are read of, without blanks, and as they are written.
pub(super) const TAKEN: [(&str, &str); 8] = [
    ("BOUNDARY", "BOUNDARY"),
    ("CFLUX", "CFLUX"),
    ("CECURRENT", "CECURRENT"),
    ("DFLUX", "DFLUX"),
    ("DSFLUX", "DSFLUX"),
    ("DSECURRENT", "DSECURRENT"),
    ("FILM", "FILM"),
    ("SFILM", "SFILM"),
];

/// The keywords of conditions on the same fields that are not read, without blanks, and as they are written.
pub(super) const NOT_TAKEN: [(&str, &str); 16] = [
    ("CFILM", "CFILM"),
    ("CFLOW", "CFLOW"),
    ("CRADIATE", "CRADIATE"),
    ("DECURRENT", "DECURRENT"),
    ("DFLOW", "DFLOW"),
    ("DSFLOW", "DSFLOW"),
    ("FIELD", "FIELD"),
    ("FLOW", "FLOW"),
    ("MASSFLOWRATE", "MASS FLOW RATE"),
    ("RADIATE", "RADIATE"),
    ("RADIATIONVIEWFACTOR", "RADIATION VIEWFACTOR"),
    ("CAVITYDEFINITION", "CAVITY DEFINITION"),
    ("SFLOW", "SFLOW"),
    ("SRADIATE", "SRADIATE"),
    ("TEMPERATURE", "TEMPERATURE"),
    ("MODELCHANGE", "MODEL CHANGE"),
];

/// Whether a keyword, in upper case and without blanks, may be a condition.
pub(super) fn is_condition(name: &str) -> bool {
    TAKEN.iter().chain(&NOT_TAKEN).any(|(of, _)| *of == name)
}
