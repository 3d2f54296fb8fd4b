//! Units of axes: the dimensions of the grammar, or the user's unit names.

use super::Quantity;
use crate::error::Error;
use crate::failure::Failure;
use inpact_parser::grammar::{Base, Dimension, Grammar};
use std::str::FromStr;

/// The user's names of units, by base quantity or by column; Abaqus has none (O-2).
///
/// `L=mm,M=t,T=s,theta=K` names those of the base quantities, `pressure=MPa` that of one column.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Units {
    bases: [Option<String>; Base::ALL.len()],
    columns: Vec<(String, String)>,
}

impl FromStr for Units {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let mut units = Self::default();
        for entry in text.split(',').map(str::trim).filter(|entry| !entry.is_empty()) {
            let named = entry.split_once('=').map(|(name, unit)| (name.trim(), unit.trim()));
            let Some((name, unit)) = named.filter(|(name, unit)| !name.is_empty() && !unit.is_empty()) else {
                let message = format!("expected NAME=UNIT, found `{entry}`: L=mm,M=t,T=s,theta=K or pressure=MPa");
                return Err(Failure::Usage(message).into());
            };
            match base_named(name) {
                Some(base) => units.bases[base as usize] = Some(unit.to_owned()),
                None if is_column(name) => units.columns.push((name.to_ascii_lowercase(), unit.to_owned())),
                None => {
                    let message = format!(
                        "there is no quantity `{name}`; there are M, L, T, theta, phi, C and columns such as pressure, clearance, temp, fv1"
                    );
                    return Err(Failure::Usage(message).into());
                }
            }
        }
        Ok(units)
    }
}

fn base_named(name: &str) -> Option<Base> {
    match name {
        "theta" => Some(Base::Temperature),
        "phi" => Some(Base::Potential),
        _ => Base::ALL.into_iter().find(|base| base.symbol() == name),
    }
}

/// The columns of tables of laws.
fn is_column(name: &str) -> bool {
    const COLUMNS: [&str; 8] =
        ["conductance", "permeability", "view_factor", "clearance", "pressure", "pore_pressure", "temp", "mass_flow"];
    let name = name.to_ascii_lowercase();
    COLUMNS.contains(&name.as_str()) || is_field(&name)
}

/// Whether a column is that of a field variable: `fv1`, `fv2`, ….
fn is_field(column: &str) -> bool {
    column.strip_prefix("fv").is_some_and(|number| number.parse::<u32>().is_ok_and(|number| 0 < number))
}

impl Units {
    /// A column of a keyword's rows with its unit.
    pub(super) fn quantity(&self, grammar: &Grammar, keyword: &str, column: &str) -> Quantity {
        let chosen = self.columns.iter().rfind(|(named, _)| named == column).map(|(_, unit)| unit.clone());
        let unit = chosen.unwrap_or_else(|| {
            let definition = grammar.id_of(keyword).and_then(|id| grammar.keyword(id).definition());
            let data = definition.map(|definition| &definition.data);
            let of_column = data.and_then(|data| data.columns.iter().find(|known| known.name == column));
            of_column.and_then(|of| of.dimension).map_or_else(String::new, |dimension| self.of_dimension(dimension))
        });
        Quantity { column: column.to_owned(), name: name(column), unit }
    }

    /// A product of powers, the positive ones first, as in the grammar.
    fn of_dimension(&self, dimension: Dimension) -> String {
        let powers = Base::ALL.into_iter().map(|base| (base, dimension.exponent(base)));
        let (positive, negative): (Vec<_>, Vec<_>) =
            powers.filter(|(_, power)| *power != 0).partition(|(_, power)| 0 < *power);
        let written = positive.into_iter().chain(negative).map(|(base, power)| {
            let name = self.bases[base as usize].as_deref().unwrap_or(base.symbol());
            if power == 1 { name.to_owned() } else { format!("{name}{}", raised(power)) }
        });
        written.collect::<Vec<_>>().join(" ")
    }
}

/// `-2` as `⁻²`.
fn raised(power: i8) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |character: char| character.to_digit(10).and_then(|digit| DIGITS.get(digit as usize).copied());
    power.to_string().chars().map(|character| digit(character).unwrap_or('⁻')).collect()
}

/// The name of a column in a sentence.
fn name(column: &str) -> String {
    match column {
        "temp" => "temperature".to_owned(),
        "pressure" => "contact pressure".to_owned(),
        "pore_pressure" => "pore pressure".to_owned(),
        "mass_flow" => "mass flow rate".to_owned(),
        "view_factor" => "view factor".to_owned(),
        _ if is_field(column) => format!("field variable {}", &column[2..]),
        _ => column.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(units: &str, column: &str, title: &str) {
        let units: Units = units.parse().unwrap();
        let quantity = units.quantity(Grammar::builtin(), "GAP ELECTRICAL CONDUCTANCE", column);
        assert_eq!(quantity.title(), title);
    }

    #[test]
    fn units_follow_dimensions_of_the_grammar() {
        check("", "conductance", "conductance (C L⁻² T⁻¹ φ⁻¹)");
        check("", "temp", "temperature (θ)");
        check("", "fv1", "field variable 1");
    }

    #[test]
    fn users_name_units_by_base_or_by_column() {
        check("L=mm, T=s,phi=mV,C=mC", "conductance", "conductance (mC mm⁻² s⁻¹ mV⁻¹)");
        check("pressure=MPa,fv1=%", "pressure", "contact pressure (MPa)");
        check("fv1=%", "fv1", "field variable 1 (%)");
    }

    #[test]
    fn what_names_no_unit_is_refused() {
        for text in ["mm", "L=", "=mm", "presure=MPa", "fv0=K"] {
            assert!(text.parse::<Units>().is_err(), "{text}");
        }
    }
}
