//! The places where statements of *PARAMETER name parameters, to be renamed together.

use super::lexer::{Lexer, Token};
use std::ops::Range;

/// The names in a physical line of *PARAMETER, from left to right: parameters, and functions such as `sqrt`.
///
/// Texts and the text after `#` have none.
pub fn names(line: &[u8]) -> impl Iterator<Item = Range<usize>> {
    let mut lexer = Lexer::new(line, 0);
    std::iter::from_fn(move || {
        loop {
            let (token, range) = lexer.next_token();
            match token {
                Token::Name => return Some(range),
                Token::End => return None,
                Token::Unknown if line[range].starts_with(b"#") => return None,
                _ => {}
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::names;

    fn check(line: &str, expected: &[&str]) {
        let found: Vec<&str> = names(line.as_bytes()).map(|range| &line[range]).collect();
        assert_eq!(found, expected, "{line}");
    }

    #[test]
    fn s_60_names_of_a_statement() {
        check("h = 2.5*k_0 + sqrt(k_0)", &["h", "k_0", "sqrt", "k_0"]);
        check("name = 'k_0 # k_1'  # k_2", &["name"]);
        check("x = 1.e5 + 2d0", &["x"]);
        check("x = 'open", &["x"]);
        check("", &[]);
    }
}
