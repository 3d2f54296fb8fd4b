//! What may be wrong with a scene: rules D011 to D019, beside those of node tables.

use inpact_evaluation::nodes::DataRule;
use inpact_validation::Severity;

/// Declares the rules and the list of them.
macro_rules! scene_rules {
    ($($identifier:ident = $code:literal $name:literal $summary:literal;)+) => {
        $(#[doc = $summary]
        pub static $identifier: DataRule =
            DataRule { code: $code, name: $name, severity: Severity::Error, summary: $summary };)+

        /// The rules about scenes, in the order of their codes.
        pub static SCENE_RULES: &[&DataRule] = &[$(&$identifier),+];
    };
}

scene_rules! {
    MALFORMED_SCENE = "D011" "malformed-scene" "the scene file is no TOML, or has a key or a value that a scene has not";
    DUPLICATE_NODE = "D012" "duplicate-node" "two nodes of a scene have one name";
    UNKNOWN_NODE = "D013" "unknown-node" "a link or an interface names a node that the scene does not define";
    UNUSABLE_NUMBER = "D014" "unusable-number" "a number of a scene is below zero, NaN or infinite where it must not be";
    MALFORMED_TIME = "D015" "malformed-time" "the time of a scene, or of a course, does not go forward";
    FLOATING_BODY = "D016" "floating-body" "nothing holds the level of a body: it has no path to a fixed value";
    CONTRADICTORY_VALUES = "D017" "contradictory-values" "nodes that infinite conductances make one are fixed at different values";
    MISSING_QUANTITY = "D018" "missing-quantity" "an interface of a scene lacks what its law depends on";
    NOT_CONVERGED = "D019" "not-converged" "the equations of a scene were not solved";
}
