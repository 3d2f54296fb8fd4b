//! `docs/reliability.md`: a page of sections, each written by the suite whose figures it has, and by nobody else.

use std::io;
use std::path::Path;

/// The head above all sections.
const HEAD: &str = "\
# Reliability

What happens to your files when runs are stopped, when others edit meanwhile, and when what is read is hostile.
Each section is written by its command and by nothing else; the bounded runs of the same suites are tests.
";

/// Puts `text` in the place of the section called `name`, or where it belongs by its name when there is none.
///
/// # Errors
/// A page that cannot be read or written.
pub fn write_section(page: &Path, name: &str, text: &str) -> io::Result<()> {
    let present = match std::fs::read_to_string(page) {
        Ok(present) => present,
        Err(error) if error.kind() == io::ErrorKind::NotFound => HEAD.to_owned(),
        Err(error) => return Err(error),
    };
    std::fs::write(page, with_section(&present, name, text))
}

fn with_section(page: &str, name: &str, text: &str) -> String {
    let mut parts = page.split("\n<!-- section: ");
    let head = parts.next().unwrap_or_default().trim_end();
    let mut sections: Vec<(String, String)> = parts
        .filter_map(|part| part.split_once(" -->\n"))
        .map(|(name, text)| (name.to_owned(), text.trim().to_owned()))
        .filter(|(other, _)| other != name)
        .collect();
    sections.push((name.to_owned(), text.trim().to_owned()));
    sections.sort();
    let sections = sections.iter().map(|(name, text)| format!("\n<!-- section: {name} -->\n\n{text}\n"));
    format!("{head}\n{}", sections.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::{HEAD, with_section};

    #[test]
    fn a_section_is_replaced_and_the_others_stay() {
        let one = with_section(HEAD, "stops", "## Stops\n\nold");
        let two = with_section(&one, "edits", "## Edits\n\ntext");
        let three = with_section(&two, "stops", "## Stops\n\nnew");
        let expected = "<!-- section: edits -->\n\n## Edits\n\ntext\n\n<!-- section: stops -->\n\n## Stops\n\nnew\n";
        assert_eq!(three, format!("{HEAD}\n{expected}"));
        assert_eq!(with_section(&three, "stops", "## Stops\n\nnew"), three);
    }
}
