//! The rules, one file each, in the order of their codes.
//!
//! A new rule is a file in `rules/` and its line in the list below; a test compares the list with the folder.

use crate::rule::Rule;

/// Declares the modules of the rules and lists them.
macro_rules! list_rules {
    ($($module:ident),+ $(,)?) => {
        $(pub mod $module;)+

        /// Every rule, in the order of the codes.
        pub static RULES: &[&Rule] = &[$(&$module::RULE),+];
    };
}

list_rules! {
    k001_unknown_keyword,
    k002_ambiguous_keyword,
    k003_abbreviated_keyword,
    k004_unknown_parameter,
    k005_ambiguous_parameter,
    k006_missing_parameter,
    k007_missing_value,
    k008_unexpected_value,
    k009_duplicate_parameter,
    k010_illegal_value,
    k011_ignored_parameter,
    k012_misplaced_keyword,
    k013_wrong_level,
    k014_invalid_name,
    k015_not_in_release,
    k016_conflicting_parameters,
    k017_missing_companion,
    s001_line_too_long,
    s002_non_ascii,
    s003_dangling_comma,
    s004_data_before_keyword,
    s005_unterminated_quote,
    s006_malformed_number,
    s007_integer_expected,
    s008_number_too_long,
    s009_indented_comment,
    s010_blank_row,
    s011_not_a_deck,
    s012_include_not_found,
    s013_include_too_deep,
    s014_include_encrypted,
    s015_undefined_parameter,
    s016_invalid_parameter_expression,
    s017_parameters_from_table,
    s018_ignore_without_effect,
    t016_solver_row_limit,
}
