//! Column names: the variable, node and region of each.

use crate::number;
use crate::results::{Name, Region};

/// A variable by its name.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    /// The quantity: `U`.
    pub(super) name: Name,
    /// The component: `U1`.
    pub(super) component: Name,
    pub(super) region: Region,
}

/// The name of a column of a field report: `S.S11`, `S.Mises`, `NT11`, `CPRESS ASSEMBLY_S/ASSEMBLY_M`.
///
/// Invariants have names that several quantities share, so they keep the name of theirs.
pub(super) fn of_field(name: &str) -> Variable {
    let (variable, region) = of_pair(name);
    match variable.split_once('.') {
        Some((quantity, component)) if !component.is_empty() => {
            let invariant = component.contains(|letter: char| letter.is_ascii_lowercase());
            let component = if invariant { variable } else { component };
            Variable { name: quantity.into(), component: component.into(), region }
        }
        _ => Variable { name: variable.into(), component: variable.into(), region },
    }
}

/// The name of a column of XY data, and the node it is of.
pub(super) fn of_history(name: &str) -> (Variable, Option<i64>) {
    let (text, node) = match node_at_end(name).or_else(|| node_of_database(name)) {
        Some((text, node)) => (text, Some(node)),
        None => return (Variable { name: name.into(), component: name.into(), region: Region::default() }, None),
    };
    let (text, set) = match text.split_once("PI:") {
        Some((text, instance)) => (text, instance.split_whitespace().next().map(Name::from)),
        None => (text, None),
    };
    // `Contact pressure: CPRESS …`
    let text = text.split_once(": ").map_or(text, |(_, variable)| variable).trim();
    let (variable, region) = of_pair(text);
    (Variable { name: variable.into(), component: variable.into(), region: Region { set, ..region } }, node)
}

/// `CPRESS_n12`, as users name data they make in a loop.
fn node_at_end(name: &str) -> Option<(&str, i64)> {
    let begin = name.trim_end_matches(|digit: char| digit.is_ascii_digit());
    let node = number::integer(&name.as_bytes()[begin.len()..])?;
    let variable = begin.strip_suffix(['n', 'N'])?.strip_suffix(['_', '-', ' ', '.'])?;
    (!variable.is_empty() && !variable.contains(':')).then_some((variable, node))
}

/// `… Node 12 in NSET A` or `… N: 12`, as the output database names them.
fn node_of_database(name: &str) -> Option<(&str, i64)> {
    let (text, rest) = name.rsplit_once(" Node ").or_else(|| name.rsplit_once(" N: "))?;
    let node = number::integer(rest.split_whitespace().next()?.as_bytes())?;
    Some((text, node))
}

/// A variable and the pair of surfaces after it.
fn of_pair(text: &str) -> (&str, Region) {
    let text = text.trim();
    match text.split_once(char::is_whitespace) {
        Some((variable, rest)) => match rest.trim().split_once('/') {
            Some((slave, master)) => {
                let region = Region { slave: Some(slave.trim().into()), master: Some(master.trim().into()), set: None };
                (variable, region)
            }
            None => (variable, Region { set: Some(rest.trim().into()), ..Region::default() }),
        },
        None => (text, Region::default()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_histories() {
        for (name, variable, node) in [
            ("CPRESS_n12", "CPRESS", Some(12)),
            ("COOR1_N7", "COOR1", Some(7)),
            ("CPRESS   PI: PART-1-1 N: 12", "CPRESS", Some(12)),
            ("Contact pressure: CPRESS ASSEMBLY_S/ASSEMBLY_M PI: I_S Node 1 in NSET A", "CPRESS", Some(1)),
            ("Wtot", "Wtot", None),
            ("Rf2", "Rf2", None),
            ("_temp_1", "_temp_1", None),
            ("n12", "n12", None),
        ] {
            let (found, of) = of_history(name);
            assert_eq!((&*found.name, of), (variable, node), "{name}");
        }
        let (found, _) = of_history("Contact pressure: CPRESS ASSEMBLY_S/ASSEMBLY_M PI: I_S Node 1");
        let region = found.region;
        let names = [region.slave, region.master, region.set].map(|name| name.map(|name| name.to_string()));
        assert_eq!(names, ["ASSEMBLY_S", "ASSEMBLY_M", "I_S"].map(|name| Some(name.to_owned())));
    }

    #[test]
    fn names_of_fields() {
        for (name, quantity, component) in [
            ("S.S11", "S", "S11"),
            ("S.Mises", "S", "S.Mises"),
            ("NT11", "NT11", "NT11"),
            ("CPRESS  ASSEMBLY_S/ASSEMBLY_M", "CPRESS", "CPRESS"),
        ] {
            let found = of_field(name);
            assert_eq!((&*found.name, &*found.component), (quantity, component), "{name}");
        }
    }
}
