//! The table of the judge in `docs/calculix.md`, and what a failing test prints.

use crate::Case;
use crate::judgement::{Judgement, REFUSED_ON_PURPOSE, WARNED_OF};
use crate::program::root;
use std::collections::BTreeMap;
use std::fmt::Write;

const BEGIN: &str = "<!-- written by the judge: begin -->\n";
const END: &str = "<!-- written by the judge: end -->\n";

/// The decks on which inpact is wrong, for the message of a failure.
pub(crate) fn listed(cases: &[&Case]) -> String {
    cases.iter().fold(String::new(), |text, case| {
        text + &format!("deck {} ({}): {:?}\n", case.number, case.changes.join(" + "), case.judgement)
    })
}

/// Every disagreement with its deck, and the table.
pub(crate) fn shown(cases: &[Case]) -> String {
    let mut text = String::new();
    for case in cases.iter().filter(|case| case.judgement.is_against()) {
        let deck = case.cubes.deck();
        let interface = deck.find("*SURFACE, NAME=").map_or("", |at| &deck[at..]);
        let _ = writeln!(
            text,
            "=== {} {:?}\n{:?}\n{interface}\n{}",
            case.number,
            case.changes,
            case.judgement,
            case.cubes.nodes(case.cubes.temperatures)
        );
    }
    text + &table(cases)
}

/// Writes the table into the page.
pub(crate) fn write(cases: &[Case]) {
    let path = root().join("docs/calculix.md");
    let page = std::fs::read_to_string(&path).expect("the page");
    let (head, rest) = page.split_once(BEGIN).expect("the mark where the table begins");
    let (_, tail) = rest.split_once(END).expect("the mark where the table ends");
    std::fs::write(&path, format!("{head}{BEGIN}{}{END}{tail}", table(cases))).expect("writable");
}

fn table(cases: &[Case]) -> String {
    let count = |is_meant: &dyn Fn(&Judgement) -> bool| cases.iter().filter(|case| is_meant(&case.judgement)).count();
    let against = count(&Judgement::is_against);
    let on_purpose = count(&|judgement| matches!(judgement, Judgement::OnPurpose(_)));
    let total = cases.len();
    let share = |part: usize| 100.0 * part as f64 / total as f64;
    let mut text = format!("\n{total} decks.\n\n| what came of them | decks |\n|---|---:|\n");
    let rows = [
        ("both refuse the deck", count(&|judgement| *judgement == Judgement::BothRefuse)),
        (
            "both run it, and the heat is the same in all digits that ccx prints",
            count(&|judgement| *judgement == Judgement::SameHeat),
        ),
        (
            "both run it, and ccx prints no heat, or stops iterating before its last digits settle",
            count(&|judgement| *judgement == Judgement::NotCompared),
        ),
        (
            "both run it, and inpact warns that its heat is not that of ccx (below)",
            count(&|judgement| matches!(judgement, Judgement::WarnedOf(_))),
        ),
        ("inpact refuses on purpose what ccx runs (below)", on_purpose),
        ("**disagreement** (below)", against),
    ];
    for (what, number) in rows {
        let _ = writeln!(text, "| {what} | {number} |");
    }
    let _ = write!(
        text,
        "\nAgreement, what is refused on purpose counted as such: {:.2} %; without it: {:.2} %.\n",
        share(total - against),
        share(total - against - on_purpose),
    );
    text += "\nWarned of, and not compared:\n\n| code | why | decks |\n|---|---|---:|\n";
    for (code, reason) in WARNED_OF {
        let number = count(&|judgement| *judgement == Judgement::WarnedOf(code));
        let _ = writeln!(text, "| {code} | {reason} | {number} |");
    }
    text += "\nRefused on purpose:\n\n| codes | what ccx does | decks |\n|---|---|---:|\n";
    for (codes, reason) in REFUSED_ON_PURPOSE {
        let number = count(&|judgement| match judgement {
            Judgement::OnPurpose(found) => found.iter().any(|code| codes.contains(&code.as_str())),
            _ => false,
        });
        let _ = writeln!(text, "| {} | {reason} | {number} |", codes.join(", "));
    }
    text += &disagreements(cases);
    text
}

fn disagreements(cases: &[Case]) -> String {
    let mut kinds: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for case in cases.iter().filter(|case| case.judgement.is_against()) {
        let what = match &case.judgement {
            Judgement::FalseAlarm(codes) => format!("ccx runs it, inpact finds {}", codes.join(", ")),
            Judgement::Missed(error) => format!("inpact passes it, ccx: `{error}`"),
            Judgement::OtherHeat(..) => "another heat".to_owned(),
            Judgement::NotEvaluated(why) => format!("`eval` has no heat: {}", why.lines().next().unwrap_or_default()),
            _ => continue,
        };
        kinds.entry(format!("{} | {what}", case.changes.join(" + "))).or_default().push(case.number);
    }
    if kinds.is_empty() {
        return "\nThere is no disagreement.\n".to_owned();
    }
    let mut text = "\nDisagreements:\n\n| changed in the deck | what differs | decks |\n|---|---|---:|\n".to_owned();
    for (kind, numbers) in kinds {
        let numbers: Vec<String> = numbers.iter().map(usize::to_string).collect();
        let _ = writeln!(text, "| {kind} | {} |", numbers.join(", "));
    }
    text
}
