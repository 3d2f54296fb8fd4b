//! The rules, one file each, in the order of their codes.
//!
//! A new rule is a file in `rules/` and its line in the list below; a test compares the list with the folder.

use crate::rule::Check;
use inpact_diagnostics::Rule;

/// Declares the modules of the rules and lists them.
macro_rules! list_rules {
    ($($module:ident),+ $(,)?) => {
        $(pub(crate) mod $module;)+

        /// Every rule, in the order of the codes.
        pub static RULES: &[&Rule] = &[$(&$module::RULE),+];

        /// Every rule with its check, in the same order.
        pub(crate) static CHECKS: &[(&Rule, Check)] = &[$((&$module::RULE, $module::CHECK)),+];
    };
}

list_rules! {
    c001_property_never_used,
    c002_user_subroutine_needed,
    c003_mixed_user_and_table,
    c004_heat_generation_disabled,
    c005_heat_generation_without_source,
    c006_radiation_constants_missing,
    c007_default_cutoff,
    c008_penalty_with_permeability,
    c009_contact_type_heat,
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
    k018_missing_behavior,
    p001_negative_property,
    p002_negative_cutoff,
    p003_heat_share_out_of_range,
    p004_heat_fraction,
    p005_grows_with_clearance,
    p006_falls_with_pressure,
    p007_jump_at_contact,
    p008_clearance_tail,
    p009_factor_above_one,
    p010_contact_constant,
    r001_undefined_interaction,
    r002_unused_interaction,
    r003_duplicate_interaction,
    r004_undefined_surface,
    r005_pair_without_interaction,
    r006_quoted_name_mix,
    r007_incomplete_pair,
    r008_undefined_node_set,
    r009_no_contact_pair,
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
    s019_integer_division,
    s020_include_outside,
    s021_lost_asterisk,
    t001_not_ascending,
    t002_duplicate_abscissa,
    t003_group_not_ascending,
    t004_clearance_start,
    t005_pressure_start,
    t006_too_many_items,
    t007_incomplete_row,
    t008_too_few_rows,
    t009_no_data,
    t010_duplicate_table,
    t011_ignored_rows,
    t012_single_row_group,
    t013_empty_value,
    t014_row_on_one_line,
    t015_ragged_table,
    t016_solver_row_limit,
    t017_surplus_row,
    t018_disjoint_curves,
}
