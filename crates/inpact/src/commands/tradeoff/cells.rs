//! Numbers and texts in tables for users.

/// A line of cells at these widths: texts first, to the left; numbers after them, to the right.
pub(super) fn line<const COLUMNS: usize>(cells: &[String; COLUMNS], widths: [usize; COLUMNS], texts: usize) -> String {
    let mut line = String::new();
    for (number, (cell, width)) in cells.iter().zip(widths).enumerate() {
        line += &if number < texts { format!("{cell:<width$} ") } else { format!("{cell:>width$} ") };
    }
    format!("{}\n", line.trim_end())
}

/// The marker of the Pareto front.
pub(super) fn star(is_on_front: bool) -> String {
    if is_on_front { "*" } else { "" }.to_owned()
}

/// A relative error, in two digits.
pub(super) fn error(error: f64) -> String {
    if error == 0.0 { "0".to_owned() } else { format!("{error:.1e}") }
}

/// Rejected subjects grouped by reason.
pub(super) fn by_reason<N: Clone>(refused: &[(N, String)]) -> Vec<(Vec<N>, &str)> {
    let mut reasons: Vec<(Vec<N>, &str)> = Vec::new();
    for (name, reason) in refused {
        match reasons.iter_mut().find(|(_, of)| of == reason) {
            Some((names, _)) => names.push(name.clone()),
            None => reasons.push((vec![name.clone()], reason)),
        }
    }
    reasons
}

/// The name of a file without its folders.
pub(super) fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}
