//! The names and aliases of columns of a node table.

use super::column::{Column, Part};
use super::contract::plain_columns;
use inpact_parser::grammar::nearest_names;
use std::fmt;

impl Column {
    /// The column of a header, ignoring case and blanks around it; `None` for a name that the contract does not have.
    pub fn named(header: &str) -> Option<Self> {
        let name = header.trim().to_ascii_lowercase();
        let listed = plain_columns().find(|page| page.names.contains(&name.as_str()));
        listed.map(|page| page.column).or_else(|| field_variable(&name))
    }

    /// The column with a name similar to a header's; `None` for a header that names one, and where none is similar.
    pub fn near(header: &str) -> Option<Self> {
        if Self::named(header).is_some() {
            return None;
        }
        let name = header.trim().to_ascii_lowercase();
        // A field variable has the number of the header.
        let digits: String = name.chars().filter(char::is_ascii_digit).collect();
        let number = digits.parse().ok().filter(|_| name.starts_with("fv") && !digits.starts_with('0'));
        let parts = [Part::Both, Part::Slave, Part::Master];
        let fields = number.map(|number| parts.map(|part| Self::FieldVariable(number, part).to_string()));
        let names = plain_columns().flat_map(|page| page.names).copied();
        let names: Vec<&str> = names.chain(fields.iter().flatten().map(String::as_str)).collect();
        // Names that differ only by underscores and blanks are the nearest.
        let plain = |name: &str| name.chars().filter(|character| character.is_alphanumeric()).collect::<String>();
        let alike = names.iter().copied().find(|known| plain(known) == plain(&name));
        Self::named(alike.or_else(|| nearest_names(name.as_bytes(), names, 1).first().copied())?)
    }
}

/// `fv1`, `fv1_s`, `fv1_m`, …; numbers are written without leading zeros, so that a column has one name.
fn field_variable(name: &str) -> Option<Column> {
    let rest = name.strip_prefix("fv")?;
    let (digits, part) = match (rest.strip_suffix("_s"), rest.strip_suffix("_m")) {
        (Some(digits), _) => (digits, Part::Slave),
        (_, Some(digits)) => (digits, Part::Master),
        _ => (rest, Part::Both),
    };
    let is_number = digits.bytes().all(|digit| digit.is_ascii_digit()) && !digits.starts_with('0');
    Some(Column::FieldVariable(digits.parse().ok().filter(|_| is_number)?, part))
}

impl fmt::Display for Column {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Self::FieldVariable(number, part) = self {
            let suffix = match part {
                Part::Slave => "_s",
                Part::Master => "_m",
                Part::Both => "",
            };
            return write!(formatter, "fv{number}{suffix}");
        }
        let listed = plain_columns().find(|page| page.column == *self);
        formatter.write_str(listed.map_or("", |page| page.names[0]))
    }
}

#[cfg(test)]
mod tests {
    use super::super::contract::COLUMN_PAGES;
    use super::*;

    #[test]
    fn names_and_aliases_are_found_in_any_case() {
        let found = |name| Column::named(name).map(|column| column.to_string());
        assert_eq!(found(" COPEN ").as_deref(), Some("clearance"));
        assert_eq!(found("CPress").as_deref(), Some("pressure"));
        assert_eq!(found("NT11_M").as_deref(), Some("temp_m"));
        assert_eq!(found("CNAREA").as_deref(), Some("area"));
        assert_eq!(found("Fv12_S").as_deref(), Some("fv12_s"));
        for unknown in ["fv", "fv0", "fv01", "fv1_x", "fv+1", "fv-1", "fv1_s_m", "por", "nt11", ""] {
            assert_eq!(found(unknown), None, "{unknown}");
        }
    }

    #[test]
    fn every_column_is_found_by_each_of_its_names() {
        for page in COLUMN_PAGES {
            assert_eq!(page.column.to_string(), page.names[0]);
            assert!(page.names.iter().all(|name| Column::named(name) == Some(page.column)));
            assert_eq!(page.column.page(), Some(page));
        }
    }

    #[test]
    fn a_misspelt_name_is_near_to_what_is_meant() {
        let near = |header| Column::near(header).map(|column| column.to_string());
        for (header, meant) in [
            ("clearence_rate", "clearance_rate"),
            ("perm_slave", "perm_s"),
            ("perm_master", "perm_m"),
            ("presure", "pressure"),
            ("tmep_s", "temp_s"),
            ("fv3s", "fv3_s"),
            ("FV_12", "fv12"),
            ("epotjump", "epot_jump"),
        ] {
            assert_eq!(near(header).as_deref(), Some(meant), "{header}");
        }
        for header in ["clearance", "fv2_m", "", "stress_xx", "u1", "displacement"] {
            assert_eq!(near(header), None, "{header}");
        }
    }
}
