//! Statements of *PARAMETER: what is understood, what is not and how that is said (S-60 to S-66, A-08).

use inpact_parser::expression::{
    ExpressionProblem, Parameters, StatementLine, SubstitutionError, Value, define, references, substitute,
};
use inpact_parser::grammar::Release;
use inpact_parser::span::{SourceId, Span};

/// The lines of one block that begins its file.
fn lines(text: &str) -> Vec<StatementLine<'_>> {
    lines_of(text, SourceId::ROOT)
}

fn lines_of(text: &str, source: SourceId) -> Vec<StatementLine<'_>> {
    let mut start = 0;
    let line = |line: &'_ str| {
        let span = Span::new(source, start, start + line.len() as u64);
        start = span.end() + 1;
        span
    };
    let spans: Vec<Span> = text.split('\n').map(line).collect();
    text.split('\n').zip(spans).map(|(line, span)| StatementLine { span, text: line.as_bytes() }).collect()
}

fn run(text: &str) -> (Parameters, Vec<ExpressionProblem>) {
    let (mut parameters, mut problems) = (Parameters::of_release(Release::R2022), Vec::new());
    define(lines(text), &mut parameters, &mut problems);
    (parameters, problems)
}

/// Executes a block that has no problem; `name = value` of every definition.
fn defined(text: &str) -> Vec<String> {
    let (parameters, problems) = run(text);
    assert_eq!(problems, [], "{text}");
    let shown = |value: &Option<Value>| match value.as_ref().expect("a statement without a problem has a value") {
        Value::Text(text) => format!("'{text}'"),
        number => number.to_string(),
    };
    parameters
        .definitions()
        .iter()
        .map(|definition| format!("{} = {}", definition.name, shown(&definition.value)))
        .collect()
}

/// The only problem of a block: the text it points at, its message, its help.
fn only_problem(text: &str) -> (String, String, String) {
    let (_, problems) = run(text);
    assert_eq!(problems.len(), 1, "{text}: {problems:?}");
    let problem = problems[0].clone();
    let place = usize::try_from(problem.span.start()).unwrap()..usize::try_from(problem.span.end()).unwrap();
    (text[place].to_owned(), problem.message, problem.help.unwrap_or_default())
}

/// Runs a block with one problem, which points at `place` and says `message`.
fn check_problem(text: &str, place: &str, message: &str, help: &str) {
    assert_eq!(only_problem(text), (place.to_owned(), message.to_owned(), help.to_owned()), "{text}");
}

#[test]
fn a_08_integers_divide_as_integers() {
    let (parameters, problems) = run("sg = 5/4");
    assert_eq!(problems, []);
    assert_eq!(parameters.value("sg"), Some(&Value::Integer(1)));
    assert_eq!(substitute("<sg>, 0.", &parameters).unwrap(), "1, 0.");
    assert_eq!(defined("a = -5/4\nb = 5./4\nc = 5/4.\nd = -(5/4)"), ["a = -2", "b = 1.25", "c = 1.25", "d = -1"]);
}

/// From release 2024 on the Python of Abaqus is the third, and `/` of integers gives a real number.
#[test]
fn a_08_integers_divide_truly_from_2024_on() {
    let mut parameters = Parameters::of_release(Release::R2024);
    let text = "a = 5/4\nb = -5/4\nc = 8/4\nd = 5//4\ne = 7/2*2";
    let lines = text.lines().map(|line| StatementLine { span: Span::default(), text: line.as_bytes() });
    let mut problems = Vec::new();
    define(lines, &mut parameters, &mut problems);
    assert_eq!(problems, []);
    let values: Vec<String> =
        parameters.definitions().iter().map(|found| found.value.as_ref().unwrap().to_string()).collect();
    assert_eq!(values, ["1.25", "-1.25", "2.", "1", "7."]);
    let remainders = parameters.integer_divisions().iter().map(|found| (found.floor.clone(), found.quotient.clone()));
    let expected = [(1, 1.25), (-2, -1.25), (3, 3.5)].map(|(floor, real)| (Value::Integer(floor), Value::Real(real)));
    assert_eq!(remainders.collect::<Vec<_>>(), expected);
}

#[test]
fn rows_as_decks_write_them() {
    let block = "\
# lengths
 thickness = 10.0
\tNEW=  6    # elements in width direction (y-dir)

density = 1.57e-09
angle = 45*pi/180.0;";
    assert_eq!(defined(block), ["thickness = 10.", "NEW = 6", "density = 1.57E-9", "angle = 0.7853981633974483"]);
    assert_eq!(defined("material = 'steel'\noptions = \", effmod\""), ["material = 'steel'", "options = ', effmod'"]);
    assert_eq!(defined("a = 'it\\'s'"), ["a = 'it's'"]);
    assert_eq!(defined("note = '# 1; \"2\"' # 3; 4"), ["note = '# 1; \"2\"'"]);
    assert_eq!(defined("path = 'C:\\\\temp\\S'"), ["path = 'C:\\temp\\S'"]);
    assert_eq!(defined("_a = 1\nA_1b = _a"), ["_a = 1", "A_1b = 1"]);
    assert_eq!(defined(""), Vec::<String>::new());
}

#[test]
fn several_statements_on_a_line() {
    assert_eq!(defined("a = 1; b = a + 1 ;c='x;y'; "), ["a = 1", "b = 2", "c = 'x;y'"]);
    let (parameters, problems) = run("a = 1; b = 2x; c = 'not; this'; d = (a; e = 5 # ; f = 6");
    assert_eq!(problems.len(), 2);
    assert_eq!(parameters.value("e"), Some(&Value::Integer(5)));
    assert_eq!(parameters.definition("f"), None);
    check_problem("a = 1;; b = 2", ";", "expected the name of a parameter, found `;`", "");
}

#[test]
fn statements_over_several_lines() {
    assert_eq!(defined("a = 1 + \\\n 2 + \\  \n 3\nb = 4"), ["a = 6", "b = 4"]);
    assert_eq!(defined("a = 'one \\\n two'"), ["a = 'one  two'"]);
    assert_eq!(defined("a = 1 # not continued \\\nb = 2"), ["a = 1", "b = 2"]);
    assert_eq!(defined("a = max(1, # the least\n  2,\n\n  3)\nb = 2"), ["a = 3", "b = 2"]);
    let (parameters, _) = run("a = 1 + \\\n 2 # sum");
    assert_eq!(parameters.definitions()[0].expression, "1 +   2");
    assert_eq!(parameters.definitions()[0].span, Span::new(SourceId::ROOT, 0, 12));
    // A word does not go over the end of a line.
    check_problem("a = 1\\\n2", "2", "expected an operator, found `2`", "");
}

#[test]
fn a_missing_parenthesis_does_not_swallow_the_next_definition() {
    let (parameters, problems) = run("a = (1 + 2\n# remark\nb = 3");
    assert_eq!(problems.len(), 1);
    assert_eq!(problems[0].message, "the parenthesis is not closed");
    assert_eq!(problems[0].span, Span::new(SourceId::ROOT, 4, 5));
    assert_eq!(parameters.value("b"), Some(&Value::Integer(3)));
}

#[test]
fn a_statement_can_go_on_in_another_file() {
    let mut all = lines_of("a = 1 + \\", SourceId::ROOT);
    all.extend(lines_of("  2 + x", SourceId(1)));
    let (mut parameters, mut problems) = (Parameters::of_release(Release::R2022), Vec::new());
    define(all, &mut parameters, &mut problems);
    assert_eq!(problems[0].span, Span::new(SourceId(1), 6, 7));
    assert_eq!(parameters.definitions()[0].span, Span::new(SourceId::ROOT, 0, 9));
}

#[test]
fn the_last_value_counts_and_nothing_is_deferred() {
    let (parameters, problems) = run("x = 2\ny = x*10\nx = 3");
    assert_eq!(problems, []);
    assert_eq!(parameters.value("x"), Some(&Value::Integer(3)));
    assert_eq!(parameters.value("y"), Some(&Value::Integer(20)));
    let last: Vec<&str> = parameters.final_definitions().map(|definition| definition.expression.as_str()).collect();
    assert_eq!(last, ["x*10", "3"]);

    let (parameters, problems) = run("y = x + 1\nx = 2");
    assert_eq!(problems.len(), 1);
    assert_eq!(problems[0].undefined.as_deref(), Some("x"));
    assert_eq!(problems[0].message, "`x` is used before it is defined");
    assert_eq!(parameters.value("y"), None);
}

#[test]
fn blocks_continue_each_other() {
    let (mut parameters, mut problems) = (Parameters::of_release(Release::R2022), Vec::new());
    define(lines("a = 2"), &mut parameters, &mut problems);
    define(lines("b = a**3"), &mut parameters, &mut problems);
    assert_eq!((problems, parameters.value("b")), (Vec::new(), Some(&Value::Integer(8))));
}

#[test]
fn what_follows_from_a_problem_is_not_reported() {
    let (parameters, problems) = run("a = 1/0\nb = a + 1\nc = b + 1/0\nd, e = 1, 2\nf = d + e\ng += 1\nh = g");
    let messages: Vec<&str> = problems.iter().map(|problem| problem.message.as_str()).collect();
    assert_eq!(
        messages,
        ["1 is divided by zero", "several names before one `=` are not understood", "`+=` is not understood"]
    );
    assert!(parameters.definitions().iter().all(|definition| definition.value.is_none()));
    assert_eq!(parameters.definitions().len(), 8);
    assert_eq!(substitute("<f>", &parameters), Err(SubstitutionError::WithoutValue("f".to_owned())));
}

#[test]
fn names_are_case_sensitive() {
    assert_eq!(defined("a = 1\nA = 2\nPi = 3"), ["a = 1", "A = 2", "Pi = 3"]);
    check_problem(
        "SL = 1\nb = sl",
        "sl",
        "`sl` is used before it is defined",
        "`SL` is defined; upper and lower case differ in names",
    );
    let (parameters, _) = run("SL = 1");
    assert_eq!(parameters.name_in_other_case("sl"), Some("SL"));
    assert_eq!(parameters.name_in_other_case("SL"), None);
    assert_eq!(parameters.name_in_other_case("sL"), Some("SL"));
    assert_eq!(parameters.name_in_other_case("SLX"), None);
    assert_eq!(run("sl = 1").0.name_in_other_case("Sl"), Some("sl"));
}

#[test]
fn a_parameter_hides_pi_but_no_function() {
    assert_eq!(defined("pi = 3\na = pi"), ["pi = 3", "a = 3"]);
    check_problem("abs = 3\na = abs(-1)", "abs", "`abs` is called, but it is a parameter, no function", "");
    check_problem(
        "a = sin + 1",
        "sin",
        "`sin` is used before it is defined",
        "call the function with its arguments: `sin(…)`",
    );
}

#[test]
fn numbers_that_are_none() {
    let d_exponent = "the number `1.5d-3` has a D exponent, which *PARAMETER does not know";
    check_problem("a = 1.5d-3 + 1", "1.5d-3", d_exponent, "write `1.5E-3`");
    let neither = "`2x` is neither a number nor a name";
    check_problem("a = 2x", "2x", neither, "");
    check_problem("a = 1.2.3", "1.2.3", "`1.2.3` is neither a number nor a name", "");
    check_problem("a = 2D", "2D", "`2D` is neither a number nor a name", "");
    check_problem("a = 1e", "1e", "`1e` is neither a number nor a name", "");
    check_problem("a = 5L", "5L", "`5L` is neither a number nor a name", "");
    check_problem("a = 0x1F", "0x1F", "`0x1F` is neither a number nor a name", "");
    check_problem("a = 2µ", "2µ", "`2µ` is neither a number nor a name", "");
    let octal = "the integer `010` begins with 0, which Python takes for octal";
    check_problem("a = 010", "010", octal, "leave out the leading zeros");
    assert_eq!(defined("a = 00\nb = 010.\nc = 010e1"), ["a = 0", "b = 10.", "c = 100."]);
    check_problem("a = 1e999", "1e999", "`1e999` is beyond the largest real number, 1.797E308", "");
    check_problem(
        "a = 9223372036854775808",
        "9223372036854775808",
        "`9223372036854775808` is beyond 64 bits",
        "give one number a decimal point, to compute with reals",
    );
}

#[test]
fn statements_that_define_nothing() {
    check_problem(
        "import math",
        "import",
        "the statement `import` of Python is not understood",
        "only definitions are",
    );
    check_problem("print a", "print", "the statement `print` of Python is not understood", "only definitions are");
    check_problem(
        "lambda = 0.5",
        "lambda",
        "`lambda` is a reserved word of Python and cannot be a parameter",
        "choose another name",
    );
    check_problem("a = 1 if 2 else 3", "if", "the word `if` of Python is not understood", "only arithmetic is");
    check_problem("a 0.3", "a", "expected `=` after `a`", "write `name = expression`");
    check_problem("a", "a", "expected `=` after `a`", "write `name = expression`");
    check_problem("a == 5", "==", "`==` compares and defines nothing", "write one `=`");
    check_problem("a *= 5", "*=", "`*=` is not understood", "write it in full, as in `a = a + 1`");
    check_problem(
        "a, b = 1, 2",
        "a, b",
        "several names before one `=` are not understood",
        "define one parameter in a statement",
    );
    check_problem("logLevel, 3", "logLevel,", "`logLevel,` is no definition", "write `name = expression`");
    check_problem(
        "a = b = 1",
        "b",
        "`b` is used before it is defined",
        "define it further up: statements are executed in their order",
    );
    check_problem("a = 1 = 2", "=", "a second `=` is not understood", "define one parameter in a statement");
    check_problem("1 = a", "1", "expected the name of a parameter, found `1`", "");
    check_problem("a =", "", "expected a value, found the end of the statement", "");
    check_problem(
        "a[0] = 1",
        "[",
        "the character `[` is not understood in an expression",
        "a parameter has one value, no list",
    );
    check_problem(
        "a = f(1)",
        "f",
        "the function `f` is not understood",
        "the functions are abs, acos, asin, atan, cos, log, log10, pow, sin, sqrt, tan, int, float, str, min, max",
    );
}

#[test]
fn expressions_that_are_none() {
    let decimal = "give a parameter one value; a point, not a comma, is the decimal mark";
    check_problem("a = 1,5", ",", "a list of values is not understood", decimal);
    check_problem(
        "a = (1, 2)",
        "(1,",
        "a list of values in parentheses is not understood",
        "give a parameter one value",
    );
    check_problem(
        "a = [1, 2]",
        "[",
        "the character `[` is not understood in an expression",
        "a parameter has one value, no list",
    );
    check_problem("a = 2^3", "^", "the character `^` is not understood in an expression", "a power is written `**`");
    check_problem(
        "a = <b>*2",
        "<",
        "the character `<` is not understood in an expression",
        "a parameter is used by its bare name here, without `<` and `>`",
    );
    check_problem("a = 5 €", "€", "the character `€` is not understood in an expression", "");
    check_problem("a = 1 +", "", "expected a value, found the end of the statement", "");
    check_problem("a = * 2", "*", "expected a value, found `*`", "");
    check_problem("a = 2 MPa", "MPa", "expected an operator, found `MPa`", "");
    check_problem("a = 2)", ")", "expected an operator, found `)`", "");
    check_problem("a = ()", ")", "expected a value, found `)`", "");
    check_problem("a = (1 2)", "2", "expected an operator or `)`, found `2`", "");
    check_problem("a = 'b' 'c'", "'c'", "expected an operator, found `'c'`", "");
    check_problem("a = max(1, ,2)", ",", "expected a value, found `,`", "");
    check_problem("a = 1 \\ 2", "\\", "the character `\\` is not understood in an expression", "");
    check_problem(
        "a = a.b",
        "a",
        "`a` is used before it is defined",
        "define it further up: statements are executed in their order",
    );
}

#[test]
fn texts_that_are_none() {
    check_problem("a = 'abc", "'abc", "the text `'abc` is not closed", "add the quote at its end");
    check_problem("a = 'abc\\'", "'abc\\'", "the text `'abc\\'` is not closed", "add the quote at its end");
    check_problem(
        "a = 'C:\\temp'",
        "'C:\\temp'",
        "the text holds the escape `\\t`, a control character in Python",
        "write `\\\\t` for a backslash before `t`",
    );
    let (mut parameters, mut problems) = (Parameters::of_release(Release::R2022), Vec::new());
    let latin_1 = b"a = 'd\xFCnn' # d\xFCnn";
    let span = Span::new(SourceId::ROOT, 0, latin_1.len() as u64);
    define([StatementLine { span, text: latin_1 }], &mut parameters, &mut problems);
    assert_eq!(problems[0].message, "the text holds bytes that are not UTF-8");
    assert_eq!(defined("a = 'dünn' # dünn"), ["a = 'dünn'"]);
}

#[test]
fn long_names_are_cut_in_messages() {
    let (place, message, _) = only_problem(&format!("a = {}", "x".repeat(1000)));
    assert_eq!(place.len(), 1000);
    assert_eq!(message, format!("`{}…` is used before it is defined", "x".repeat(40)));
    let (_, message, _) = only_problem(&format!("a = {}", "9".repeat(41)));
    assert_eq!(message, format!("`{}…` is beyond 64 bits", "9".repeat(40)));
    let (_, message, _) = only_problem(&format!("a = {}", "9".repeat(40)));
    assert_eq!(message, format!("`{}` is beyond 64 bits", "9".repeat(40)));
}

#[test]
fn definitions_know_their_text_and_place() {
    let (parameters, _) = run("a = 1\n  b  =  a + 2  # two; c = 3\nd = 1/0");
    let definition = parameters.definition("b").unwrap();
    assert_eq!(definition.expression, "a + 2");
    assert_eq!(definition.span, Span::new(SourceId::ROOT, 8, 19));
    assert_eq!(parameters.definition("d").unwrap().expression, "1/0");
    assert_eq!(parameters.definition("c"), None);
}

fn found(text: &str) -> Vec<(&str, &str)> {
    references(text.as_bytes()).map(|reference| (&text[reference.range], reference.name)).collect()
}

#[test]
fn references_in_rows_and_values() {
    assert_eq!(found("1., <sg>,< b_2 >"), [("<sg>", "sg"), ("< b_2 >", "b_2")]);
    assert_eq!(found("<<a><b"), [("<a>", "a")]);
    for none in ["", "<", "<>", "< >", "<1a>", "<a b>", "<a+b>", "<a,b>", "a > b < c", "<é>", "<a\n>"] {
        assert_eq!(found(none), [], "{none:?}");
    }
}

#[test]
fn values_take_the_place_of_references() {
    let (parameters, _) = run("n = 7\nr = 2\nr = 2./3\nt = ', effmod'\nhidden = 1/0");
    let substituted = |text: &'static str| substitute(text, &parameters);
    assert_eq!(substituted("<n>, <r>,<t>").unwrap(), "7, 0.6666666666666666,, effmod");
    assert_eq!(substituted("type=<n>x").unwrap(), "type=7x");
    assert!(matches!(substituted("1., 2."), Ok(std::borrow::Cow::Borrowed("1., 2."))));
    assert_eq!(substituted("<n>, <x>, <y>"), Err(SubstitutionError::Undefined("x".to_owned())));
    assert_eq!(substituted("<N>"), Err(SubstitutionError::Undefined("N".to_owned())));
    assert_eq!(substituted("<hidden>"), Err(SubstitutionError::WithoutValue("hidden".to_owned())));
}

#[test]
fn values_are_not_substituted_twice() {
    let (parameters, _) = run("a = '<b>'\nb = 1");
    assert_eq!(substitute("<a>", &parameters).unwrap(), "<b>");
}
