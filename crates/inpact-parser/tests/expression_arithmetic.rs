//! Values of expressions: every operator and function of *PARAMETER against what Python 2.7 gives (S-60).

use inpact_parser::expression::{Parameters, StatementLine, Value, define};
use inpact_parser::grammar::Release;
use inpact_parser::span::{SourceId, Span};

fn evaluate(expression: &str) -> Result<Value, String> {
    let (mut parameters, mut problems) = (Parameters::of_release(Release::R2022), Vec::new());
    let statement = format!("x = {expression}");
    let span = Span::new(SourceId::ROOT, 0, statement.len() as u64);
    define([StatementLine { span, text: statement.as_bytes() }], &mut parameters, &mut problems);
    match problems.pop() {
        Some(problem) => Err(problem.message),
        None => Ok(parameters.value("x").expect("a statement without a problem has a value").clone()),
    }
}

fn check_integer(cases: &[(&str, i64)]) {
    for (expression, value) in cases {
        assert_eq!(evaluate(expression), Ok(Value::Integer(*value)), "{expression}");
    }
}

fn check_real(cases: &[(&str, f64)]) {
    for (expression, value) in cases {
        match evaluate(expression) {
            // Bits, so that the sign of zero counts.
            Ok(Value::Real(found)) => assert_eq!(found.to_bits(), value.to_bits(), "{expression} gives {found}"),
            other => panic!("{expression} gives {other:?}"),
        }
    }
}

fn check_text(cases: &[(&str, &str)]) {
    for (expression, value) in cases {
        assert_eq!(evaluate(expression), Ok(Value::Text((*value).to_owned())), "{expression}");
    }
}

fn check_message(cases: &[(&str, &str)]) {
    for (expression, message) in cases {
        assert_eq!(evaluate(expression), Err((*message).to_owned()), "{expression}");
    }
}

#[test]
fn integers() {
    check_integer(&[
        ("1 + 2*3 - 4", 3),
        ("(1 + 2)*3", 9),
        ("10 - 4 - 3", 3),
        ("5/4", 1),
        ("-5/4", -2),
        ("5/-4", -2),
        ("-5/-4", 1),
        ("-8/4", -2),
        ("7/2*2", 6),
        ("7//2", 3),
        ("-7//2", -4),
        ("7 % 3", 1),
        ("-7 % 3", 2),
        ("7 % -3", -2),
        ("-7 % -3", -1),
        ("2*3 % 4", 2),
        ("+-+-3", 3),
        ("1 - -1", 2),
        ("00", 0),
        ("9223372036854775807", i64::MAX),
        ("-9223372036854775807 - 1", i64::MIN),
        ("(-9223372036854775807 - 1) % -1", 0),
    ]);
}

#[test]
fn powers() {
    check_integer(&[
        ("2**10", 1024),
        ("2**3**2", 512),
        ("(2**3)**2", 64),
        ("-2**2", -4),
        ("(-2)**2", 4),
        ("2*3**2", 18),
        ("0**0", 1),
        ("2**62", 4_611_686_018_427_387_904),
        ("1**9223372036854775807", 1),
        ("(-1)**9223372036854775807", -1),
        ("(-1)**9223372036854775806", 1),
        ("0**9223372036854775807", 0),
        ("(-2)**63", i64::MIN),
    ]);
    check_real(&[
        ("2**-1", 0.5),
        ("2**-2**2", 0.0625),
        ("-2**-2", -0.25),
        ("2.**3", 8.0),
        ("2**0.5", std::f64::consts::SQRT_2),
        ("0.**0", 1.0),
        ("(-8.)**3", -512.0),
        ("1e-200**2", 0.0),
    ]);
    check_message(&[
        ("2**63", "2**63 is beyond 64 bits"),
        ("10**1000000000000", "10**1000000000000 is beyond 64 bits"),
        ("9**9**9**9**9", "9**387420489 is beyond 64 bits"),
        ("0**-1", "0.**-1. is a division by zero"),
        ("0.**-0.5", "0.**-0.5 is a division by zero"),
        ("(-8.)**(1./3)", "-8.**0.3333333333333333 is no real number: its base is negative"),
        ("10.**400", "10.**400. is beyond the largest real number, 1.797E308"),
    ]);
}

#[test]
fn reals() {
    check_real(&[
        ("5./4", 1.25),
        ("5/4.", 1.25),
        ("5/4 + 0.", 1.0),
        (".5", 0.5),
        ("5.", 5.0),
        ("1e3", 1000.0),
        ("1.E-3", 0.001),
        ("2.5e+2", 250.0),
        ("0.1 + 0.2", 0.300_000_000_000_000_04),
        ("1.5-3", -1.5),
        ("7.5//2", 3.0),
        ("-7.5//2", -4.0),
        ("1//0.1", 9.0),
        ("-7.5 % 2", 0.5),
        ("7.5 % -2", -0.5),
        ("4. % -2", -0.0),
        ("0./-3", -0.0),
        ("0.//-3", -0.0),
        ("-0.", -0.0),
        ("9007199254740993 + 0.", 9_007_199_254_740_992.0),
        ("pi", std::f64::consts::PI),
        ("5e-324", 5e-324),
        ("1e-999", 0.0),
    ]);
}

#[test]
fn overflow_and_division_by_zero() {
    check_message(&[
        ("9223372036854775807 + 1", "the integer 9223372036854775808 is beyond 64 bits"),
        ("-9223372036854775807 - 2", "the integer -9223372036854775809 is beyond 64 bits"),
        ("4294967296*4294967296", "the integer 18446744073709551616 is beyond 64 bits"),
        ("-(-9223372036854775807 - 1)", "the integer 9223372036854775808 is beyond 64 bits"),
        ("(-9223372036854775807 - 1)/-1", "the integer 9223372036854775808 is beyond 64 bits"),
        ("abs(-9223372036854775807 - 1)", "the integer 9223372036854775808 is beyond 64 bits"),
        ("1e308*10", "1E308 * 10. is beyond the largest real number, 1.797E308"),
        ("-1e308 - 1e308", "-1E308 - 1E308 is beyond the largest real number, 1.797E308"),
        ("1/1e-320*1e300", "1. / 1E-320 is beyond the largest real number, 1.797E308"),
        ("5/0", "5 is divided by zero"),
        ("5%0", "5 is divided by zero"),
        ("5//0", "5 is divided by zero"),
        ("5/0.", "5. is divided by zero"),
        ("0./0", "0. is divided by zero"),
        ("5.5 % 0", "5.5 is divided by zero"),
        ("1e308//1e-308", "1E308 // 1E-308 is beyond the largest real number, 1.797E308"),
    ]);
}

#[test]
fn functions() {
    check_real(&[
        ("acos(0)", std::f64::consts::FRAC_PI_2),
        ("asin(1)", std::f64::consts::FRAC_PI_2),
        ("atan(1)", std::f64::consts::FRAC_PI_4),
        ("cos(0)", 1.0),
        ("log(1)", 0.0),
        ("log(8, 2)", 3.0),
        ("log10(1000)", 3.0),
        ("pow(2, 3)", 8.0),
        ("pow(2, 3)/3", 8.0 / 3.0),
        ("sin(0)", 0.0),
        ("sqrt(16)", 4.0),
        ("tan(0)", 0.0),
        ("abs(-2.5)", 2.5),
        ("2.0 * acos(0.0)", std::f64::consts::PI),
        ("float(3)", 3.0),
        ("float(' 1.5e3 ')", 1500.0),
        ("max(1.e-9, 1)*1.", 1.0),
    ]);
    check_integer(&[
        ("abs(-3)", 3),
        ("int(2.9)", 2),
        ("int(-2.9)", -2),
        ("int(7)", 7),
        ("int(' -12 ')", -12),
        ("int(9.2233720368547748e18)", 9_223_372_036_854_774_784),
        ("int(-9.223372036854775808e18)", i64::MIN),
        ("max(5, int(2.7))", 5),
        ("max(2, 2.)", 2),
        ("min(3, 1, 2,)", 1),
        ("max(9007199254740992, 9007199254740993)", 9_007_199_254_740_993),
    ]);
    check_real(&[("min(3, 1., 1)", 1.0), ("max(2., 2)", 2.0)]);
}

#[test]
fn functions_outside_their_domain() {
    check_message(&[
        ("sqrt(-1)", "`sqrt` has no value at -1."),
        ("log(0)", "`log` has no value at 0."),
        ("log(-1.5)", "`log` has no value at -1.5"),
        ("log10(0)", "`log10` has no value at 0."),
        ("log(2, 1)", "`log` has no value for the base 1"),
        ("log(2, 0)", "`log` has no value at 0."),
        ("acos(1.5)", "`acos` has no value at 1.5"),
        ("asin(-2)", "`asin` has no value at -2."),
        ("pow(-1, 0.5)", "-1.**0.5 is no real number: its base is negative"),
        ("pow(0, -1)", "0.**-1. is a division by zero"),
        ("int(1e19)", "1E19 is beyond 64 bits"),
        ("int(9223372036854775808.)", "9.223372036854776E18 is beyond 64 bits"),
        ("int('9223372036854775808')", "`9223372036854775808` is beyond 64 bits"),
        ("int('1.5')", "the text `1.5` is no integer"),
        ("int('')", "the text `` is no integer"),
        ("float('1.5d3')", "the text `1.5d3` is no number"),
        ("float('nan')", "the text `nan` is no number"),
        ("float('1e999')", "`1e999` is beyond the largest real number, 1.797E308"),
        ("sin('1')", "`sin` takes a number, not a text"),
        ("abs('1')", "`abs` takes a number, not a text"),
        ("max(1, '2')", "`max` takes a number, not a text"),
        ("sin()", "`sin` takes 1 argument, 0 given"),
        ("sin(1, 2)", "`sin` takes 1 argument, more given"),
        ("pow(2)", "`pow` takes 2 arguments, 1 given"),
        ("log(1, 2, 3)", "`log` takes 1 or 2 arguments, more given"),
        ("max(1)", "`max` takes 2 to 255 arguments, 1 given"),
    ]);
}

#[test]
fn texts() {
    check_text(&[
        ("'a' + \"b\"", "ab"),
        ("'SET-' + str(3)", "SET-3"),
        ("str('a')", "a"),
        ("str(2.)", "2.0"),
        ("str(-0.)", "-0.0"),
        ("str(0.1 + 0.2)", "0.3"),
        ("str(1./3)", "0.333333333333"),
        ("str(100000)", "100000"),
        ("str(1e5)", "100000.0"),
        ("str(1e10)", "10000000000.0"),
        ("str(123456789012.5)", "1.23456789012e+11"),
        ("str(1e16)", "1e+16"),
        ("str(1e-4)", "0.0001"),
        ("str(1e-5)", "1e-05"),
        ("str(1.5e-7)", "1.5e-07"),
        ("str(1e300)", "1e+300"),
        ("str(99999999999.96)", "1e+11"),
        ("str(999999999999.9)", "1e+12"),
        ("''", ""),
        ("'a\\\\b\\'c\\\"d\\q'", "a\\b'c\"d\\q"),
    ]);
    check_message(&[
        ("'a' + 1", "`+` does not work between a text and an integer"),
        ("1.5 + 'a'", "`+` does not work between a real number and a text"),
        ("'a'*3", "`*` does not work between a text and an integer"),
        ("'a' - 'b'", "`-` does not work between a text and a text"),
        ("'%d' % 3", "`%` does not work between a text and an integer"),
        ("-'a'", "a text has no sign"),
        ("+'a'", "a text has no sign"),
        ("'a'**2", "`**` does not work between a text and an integer"),
    ]);
}

#[test]
fn values_in_the_deck_and_as_numbers() {
    let shown = |expression: &str| evaluate(expression).unwrap().to_string();
    let texts = ["7", "7.", "0.1 + 0.2", "1e-7", "1e300", "-0.", "'a, b'"].map(shown);
    assert_eq!(texts, ["7", "7.", "0.30000000000000004", "1E-7", "1E300", "-0.", "a, b"]);
    assert_eq!(evaluate("7").unwrap().as_number(), Some(7.0));
    assert_eq!(evaluate("7.5").unwrap().as_number(), Some(7.5));
    assert_eq!(evaluate("'7'").unwrap().as_number(), None);
}
