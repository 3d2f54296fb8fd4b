//! Parsing of numbers as solvers print them.

/// The maximum number of characters of a number, far above Fortran's widest formats.
const MOST: usize = 64;

/// A real number: with an exponent after E or D or, as Fortran prints exponents of three digits, after its sign alone
/// (`1.5-100`); `NaN` and `Infinity`, which a solver prints where it has none.
pub(crate) fn real(text: &[u8]) -> Option<f64> {
    let mut copy = [0; MOST];
    let length = text.len();
    let plain = copy.get_mut(..length)?;
    plain.copy_from_slice(text);
    for byte in plain.iter_mut() {
        if matches!(byte, b'D' | b'd') {
            *byte = b'E';
        }
    }
    let text = std::str::from_utf8(plain).ok()?;
    text.parse().ok().or_else(|| without_letter(text))
}

/// `1.5-100`.
fn without_letter(text: &str) -> Option<f64> {
    let at = text.rfind(['+', '-']).filter(|at| 0 < *at)?;
    let (mantissa, exponent) = text.split_at(at);
    let digits = exponent.len() == 4 && exponent[1..].bytes().all(|byte| byte.is_ascii_digit());
    let plain = mantissa.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'.' | b'-' | b'+'));
    (digits && plain).then(|| format!("{mantissa}E{exponent}").parse().ok())?
}

/// An integer.
pub(crate) fn integer(text: &[u8]) -> Option<i64> {
    std::str::from_utf8(text).ok()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_solvers_print() {
        let cases: [(&str, f64); 9] = [
            (" -0.".trim(), -0.0),
            ("644.116E-06", 644.116e-6),
            ("125.E-03", 0.125),
            ("1.562500000000000D+03", 1562.5),
            ("-1.5-100", -1.5e-100),
            ("1.5+100", 1.5e100),
            (".5", 0.5),
            ("7", 7.0),
            ("1e5", 1e5),
        ];
        for (text, value) in cases {
            assert_eq!(real(text.as_bytes()).map(f64::to_bits), Some(value.to_bits()), "{text}");
        }
        assert!(real(b"NaN").is_some_and(f64::is_nan));
    }

    #[test]
    fn refuses_the_rest() {
        for text in ["", "-", "1.5E", "1.5E+", "1-2-3", "1.5-10", "x", "1 2", "--1", "1.5-1O0"] {
            assert_eq!(real(text.as_bytes()), None, "{text}");
        }
        assert_eq!(real(&[b'1'; 100]), None);
    }
}
