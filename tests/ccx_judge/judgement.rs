//! Whether inpact says of a deck what ccx does with it, and for what reasons it may say something else.

use crate::cubes::Cubes;
use crate::runs::{Ccx, Inpact, is_printed_as};

/// Reasons why inpact refuses a deck that ccx runs: the codes of the errors and what ccx does instead.
pub(crate) const REFUSED_ON_PURPOSE: &[(&[&str], &str)] = &[
    (
        &["T001", "T002", "T003"],
        "a table out of order: ccx looks a value up among rows that do not ascend, and takes one that nobody meant",
    ),
    (&["P001"], "a negative conductance: heat would flow from cold to hot"),
    (
        &["R003"],
        "two interactions of one name: ccx takes the first for a contact pair, and gives the sub-options after the second to the second (K-06)",
    ),
    (&["T010"], "an option twice in one interaction: ccx takes the later one"),
    (
        &["K009", "K010"],
        "a parameter twice on one line, the other time perhaps with a value that ccx does not know (K010): it takes the last that it knows",
    ),
    (&["K012"], "a sub-option before the first *SURFACE INTERACTION: ccx gives it to the last material"),
    (
        &["S006"],
        "a sign or a point alone, which ccx reads as 0, and `nan`, `inf` or a number beyond 1.8E308, of which it makes heat that is no number",
    ),
    (&["T018"], "two curves that share no pressures: ccx stops only where a mean temperature lies between them"),
    (&["S008"], "a number of more than 20 characters, of which ccx reads another value from the first 20"),
];

/// Reasons why the heat of a deck that both run is not compared: the warning of inpact, and the difference.
pub(crate) const WARNED_OF: &[(&str, &str)] = &[
    (
        "R009",
        "there is no contact pair (its keyword is none): ccx has no contact and prints no heat; `eval` gives the heat of the interaction at the nodes of the table",
    ),
    (
        "C009",
        "node-to-surface and massless contact: ccx reads another row of the table and generates no heat; `eval` gives the heat of face-to-face contact",
    ),
];

/// Outcomes of a deck.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Judgement {
    /// Both refuse it.
    BothRefuse,
    /// Both run it; whether heats were compared, which are the same.
    SameHeat,
    /// Both run it, and ccx printed no heat, or one whose last digits depend on where its iteration ended.
    NotCompared,
    /// Both run it, and inpact warns that its heat is not that of ccx, by a code of [`WARNED_OF`].
    WarnedOf(&'static str),
    /// inpact refuses it for a reason of [`REFUSED_ON_PURPOSE`].
    OnPurpose(Vec<String>),
    /// inpact refuses it and ccx runs it.
    FalseAlarm(Vec<String>),
    /// ccx refuses it and inpact does not.
    Missed(String),
    /// Both run it, to different heat.
    OtherHeat([f64; 2], [String; 2]),
    /// Both run it, and inpact cannot say what heat there is.
    NotEvaluated(String),
}

impl Judgement {
    /// Whether inpact is wrong.
    pub(crate) fn is_against(&self) -> bool {
        matches!(self, Self::FalseAlarm(_) | Self::Missed(_) | Self::OtherHeat(..) | Self::NotEvaluated(_))
    }
}

/// Compares what both made of a deck.
pub(crate) fn judge(cubes: &Cubes, ccx: &Ccx, inpact: &Inpact) -> Judgement {
    let codes = || inpact.errors.iter().cloned().collect::<Vec<_>>();
    let printed = match (ccx, inpact.errors.is_empty()) {
        (Ccx::Stopped(_), false) => return Judgement::BothRefuse,
        (Ccx::Stopped(error), true) => return Judgement::Missed(error.clone()),
        (Ccx::Ran(_), false) => {
            // A value that is unknown is a reason only beside another one that ccx takes.
            let is_beside_another = |code: &str| code != "K010" || inpact.errors.contains("K009");
            let is_meant = |code: &String| {
                let is_listed = REFUSED_ON_PURPOSE.iter().any(|(codes, _)| codes.contains(&code.as_str()));
                is_listed && is_beside_another(code)
            };
            let is_on_purpose = inpact.errors.iter().all(is_meant);
            return if is_on_purpose { Judgement::OnPurpose(codes()) } else { Judgement::FalseAlarm(codes()) };
        }
        (Ccx::Ran(None), true) => return Judgement::NotCompared,
        (Ccx::Ran(Some(printed)), true) => printed,
    };
    match &inpact.heats {
        Err(why) => Judgement::NotEvaluated(why.clone()),
        Ok(heats) if (0..2).all(|side| is_printed_as(heats[side], &printed[side])) => Judgement::SameHeat,
        Ok(heats) => match warned_of(printed, inpact) {
            Some(code) => Judgement::WarnedOf(code),
            None if cubes.is_iterated() => Judgement::NotCompared,
            None => Judgement::OtherHeat(*heats, printed.clone()),
        },
    }
}

/// The warning that says why the heats differ, where inpact gives one that holds: without contact no heat flows.
fn warned_of(printed: &[String; 2], inpact: &Inpact) -> Option<&'static str> {
    let holds = |code: &str| code != "R009" || printed.iter().all(|heat| is_printed_as(0.0, heat));
    let mut codes = WARNED_OF.iter().map(|(code, _)| *code);
    codes.find(|code| inpact.warnings.contains(*code) && holds(code))
}
