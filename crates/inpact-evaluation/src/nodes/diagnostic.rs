//! What is wrong with a node table: rules D001 to D010 and D020 to D022, and their findings.
//!
//! A finding has a row and a column where a finding of the deck has a span. Knows no colours and no terminals; the command line renders it.
//! Findings of other data that belongs to a deck are of this kind as well; their rules stand where that data is read.

use inpact_validation::Severity;
use std::collections::BTreeMap;

/// The most findings of one rule in one table; more are counted, not kept.
const MOST_OF_ONE_RULE: usize = 20;

/// A rule about node tables: its code and name are fixed.
#[derive(Debug, PartialEq, Eq)]
pub struct DataRule {
    /// The code, such as `D002`.
    pub code: &'static str,
    /// The name, such as `malformed-cell`.
    pub name: &'static str,
    /// How grave a finding is unless it says otherwise.
    pub severity: Severity,
    /// What it is about, in one sentence.
    pub summary: &'static str,
    /// Why that matters and what to do, in sentences.
    pub explanation: &'static str,
}

/// Declares the rules and the list of them.
macro_rules! data_rules {
    ($($identifier:ident = $code:literal $name:literal $severity:ident $summary:literal $explanation:literal;)+) => {
        $(#[doc = $summary]
        pub static $identifier: DataRule = DataRule {
            code: $code,
            name: $name,
            severity: Severity::$severity,
            summary: $summary,
            explanation: $explanation,
        };)+

        /// The rules about node tables, in the order of their codes.
        pub static DATA_RULES: &[&DataRule] = &[$(&$identifier),+];
    };
}

data_rules! {
    MISSING_COLUMN = "D001" "missing-column" Error "a column that an output needs is not there"
        "The finding names the column and the output that needs it. Give the column, or ask for other outputs with `--outputs`; `inpact plan` lists what each output reads.";
    MALFORMED_CELL = "D002" "malformed-cell" Error "a cell is no number, or a row has too few or too many cells"
        "Numbers have a decimal point and no separators of thousands; an empty cell is a missing number. A row must have as many cells as the header.";
    NON_FINITE = "D003" "non-finite" Warning "a cell is NaN or infinite, and so may be the results of its row"
        "Such a row is evaluated: what the number does not reach is right, what it reaches is NaN or infinite. Where the number was meant to be missing, leave the cell empty.";
    UNKNOWN_INTERACTION = "D004" "unknown-interaction" Error "the deck does not define the interaction"
        "Names are compared as Abaqus does, without regard to case and blanks unless they are quoted. Mend the name in the table, or define the *SURFACE INTERACTION in the deck.";
    DUPLICATE_COLUMN = "D005" "duplicate-column" Error "two headers mean the same column"
        "Some columns have several names, such as `clearance` and `copen`. Keep one of the two.";
    TIME_NOT_ASCENDING = "D006" "time-not-ascending" Error "time does not rise from one row of a node to its next"
        "Histories add up from one row of a node to its next, so times of a node must rise from row to row. Sort the table by time, or give each step of a restarted analysis a table of its own.";
    BEYOND_TABLE = "D007" "beyond-table" Note "rows lie outside the range of a table"
        "The value at the end of the table is kept, as the manual says, and not extrapolated. Extend the table in the deck if the range is meant to be reached.";
    NEGATIVE_AREA = "D008" "negative-area" Error "an area is below zero"
        "An area is that of the slave node, zero or more. Mend its sign.";
    NEGATIVE_PROPERTY = "D009" "negative-property" Error "a characteristic length or a bulk permeability is below zero"
        "A characteristic element length and a bulk permeability are zero or more. Mend the sign.";
    USER_FAULT = "D010" "user-subroutine-fault" Error "a user subroutine gives what is no conductance"
        "Its conductance and the derivatives must be numbers, and the conductance not below zero. The finding says in which row it was what; mend the routine.";
    UNKNOWN_COLUMN = "D020" "unknown-column" Warning "nothing reads a column whose name is near to one that a node table may have"
        "Column names are compared without regard to case and to blanks around them, and a name that means nothing is passed over. Where the near name is meant, write it so; `inpact explain columns` lists all of them.";
    CONTRADICTORY_RATE = "D021" "contradictory-rate" Warning "a given clearance rate and the change of the clearance disagree"
        "Where `clearance_rate` is given, the gap fills at that rate: PFL is its flow and PTL that flow times the length of the increment. From row to row the clearance changes at another rate, by more than 1 %. The finding has the first such row with both rates. Mend the one that is wrong, or leave `clearance_rate` out, so that the rate follows from the clearance.";
    HEAT_OF_CLOSING = "D022" "heat-of-closing" Warning "rows whose heat takes the jump of the open circuit at their start"
        "The heat of a current in a transient is a mean over the increment, (η σ/3)(Δφ₁² + Δφ₁Δφ₀ + Δφ₀²) with the conductance σ at its end. Where the interface did not conduct at the start, Δφ₀ is the jump of the open circuit: the formula then gives a heat that no circuit supplied and that grows with the length of the increment. SJD, SJDT and what follows from them hold the manual's form all the same; the finding has the first such row. Give a row right after the circuit has closed, so that the increment in which it closes is short. `inpact solve` takes Δφ₀ = Δφ₁ there, so that power balances, unless a scene says `closing_heat = \"manual\"` under `[time]`.";
}

/// One finding in a node table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DataDiagnostic {
    /// The stable code, such as `D002`.
    pub code: &'static str,
    /// The stable name, such as `malformed-cell`.
    pub name: &'static str,
    /// How grave it is.
    pub severity: Severity,
    /// What is wrong, with the values in it; names in backticks, no full stop.
    pub message: String,
    /// What to do.
    pub help: Option<String>,
    /// The name of the table, as it was asked for.
    pub file: String,
    /// Where in it.
    pub place: Place,
}

/// A place in a node table; what does not apply is `None`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Place {
    /// The row, counted from 1 below the header.
    pub row: Option<u64>,
    /// The line of the file, from 1.
    pub line: Option<u64>,
    /// What the header calls the column.
    pub column: Option<String>,
}

/// Collects the findings of one table: the first of each rule, and how many there are.
#[derive(Debug)]
pub struct Findings {
    file: String,
    kept: Vec<DataDiagnostic>,
    /// How often each rule was reported, by its code.
    reported: BTreeMap<&'static str, usize>,
}

impl Findings {
    /// No findings yet, of the table of that name.
    pub fn new(file: &str) -> Self {
        Self { file: file.to_owned(), kept: Vec::new(), reported: BTreeMap::new() }
    }

    /// Reports a finding; an empty `help` is none.
    pub fn report(&mut self, rule: &DataRule, place: Place, message: impl Into<String>, help: impl Into<String>) {
        self.report_as(rule.severity, rule, place, message, help);
    }

    /// Reports a finding that is graver or less grave than its rule says.
    pub fn report_as(
        &mut self,
        severity: Severity,
        rule: &DataRule,
        place: Place,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        let count = self.reported.entry(rule.code).or_default();
        *count += 1;
        if *count > MOST_OF_ONE_RULE {
            return;
        }
        let help = Some(help.into()).filter(|help| !help.is_empty());
        let (code, name) = (rule.code, rule.name);
        let file = self.file.clone();
        self.kept.push(DataDiagnostic { code, name, severity, message: message.into(), help, file, place });
    }

    /// Whether one of them is an error.
    pub fn has_errors(&self) -> bool {
        self.kept.iter().any(|found| found.severity == Severity::Error)
    }

    /// The findings in the order they were reported; the last of a rule says how many of it were left out.
    pub fn into_list(mut self) -> Vec<DataDiagnostic> {
        for (code, count) in self.reported {
            let Some(hidden) = count.checked_sub(MOST_OF_ONE_RULE).filter(|hidden| *hidden > 0) else { continue };
            if let Some(last) = self.kept.iter_mut().rfind(|found| found.code == code) {
                let more = format!("{hidden} more findings of this rule in this table are not shown");
                last.help = Some(last.help.take().map_or_else(|| more.clone(), |help| format!("{help}; {more}")));
            }
        }
        self.kept
    }
}
