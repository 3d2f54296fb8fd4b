//! Phrases shared by several messages.

/// The maximum number of names in a message.
const MOST: usize = 10;

/// The names in backticks, with `or` before the last: `A`, `B` or `C`.
pub(crate) fn alternatives<'name>(names: impl IntoIterator<Item = &'name str>) -> String {
    let mut quoted: Vec<String> = names.into_iter().map(|name| format!("`{name}`")).collect();
    if quoted.len() > MOST {
        let more = quoted.len() - MOST;
        quoted.truncate(MOST);
        return format!("{} or {more} more", quoted.join(", "));
    }
    match quoted.pop() {
        Some(last) if quoted.is_empty() => last,
        Some(last) => format!("{} or {last}", quoted.join(", ")),
        None => String::new(),
    }
}

/// `did you mean …?` with the names in backticks; `None` without names.
pub(crate) fn did_you_mean<'name>(names: impl IntoIterator<Item = &'name str>) -> Option<String> {
    let names = alternatives(names);
    (!names.is_empty()).then(|| format!("did you mean {names}?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_listed() {
        assert_eq!(alternatives(["A"]), "`A`");
        assert_eq!(alternatives(["A", "B", "C"]), "`A`, `B` or `C`");
        assert_eq!(alternatives(["X"; 12]), format!("{} or 2 more", ["`X`"; 10].join(", ")));
        assert_eq!(did_you_mean([]), None);
        assert_eq!(did_you_mean(["A", "B"]).as_deref(), Some("did you mean `A` or `B`?"));
    }
}
