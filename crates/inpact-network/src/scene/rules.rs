//! Rules about scenes, D011 to D019, beside those of node tables.

use inpact_diagnostics::data_rules;

data_rules! {
    /// The rules about scenes, in the order of their codes.
    SCENE_RULES;

    /// A scene is no TOML, has a key or a value that a scene has not, or entries that do not fit together.
    ///
    /// Tables beside the scene file are held to the same: a node has a name and is not held and fed at once, a link or an interface joins two nodes, a link conducts something, an interface has an area.
    /// The finding has the line, and for a misspelt key the nearest that exists.
    /// `schema/scene.schema.json` describes every key to an editor, docs/scenes.md to a person.
    MALFORMED_SCENE = "D011", "malformed-scene", Error, source: "docs/scenes.md";

    /// Two nodes of a scene have one name.
    ///
    /// A node is identified by its name, in the scene file and in all tables beside it.
    /// Rename one of the two, or give all that is known of the node in one entry.
    DUPLICATE_NODE = "D012", "duplicate-node", Error, source: "docs/scenes.md";

    /// A link or an interface names a node that the scene does not define.
    ///
    /// Define it with `[[node]]`, with a row of a table of nodes, or mend the name; names are compared letter by letter.
    /// A table of links defines nodes only where the scene has neither `[[node]]` nor a table of nodes; the rows of a Matrix Market file are nodes in any case.
    UNKNOWN_NODE = "D013", "unknown-node", Error, source: "docs/scenes.md";

    /// A number of a scene is below zero, NaN or infinite where it must not be.
    ///
    /// Conductances, capacities and lengths are zero or more, areas above zero, shares from 0 to 1; only a conductance may be `inf`, which makes its two nodes one.
    UNUSABLE_NUMBER = "D014", "unusable-number", Error, source: "docs/scenes.md";

    /// The time of a scene, or of a course, does not go forward.
    ///
    /// A transient has a start before its end and one of `step` and `tolerance`, and neither is lost in rounding: `tolerance` is 1e-12 or more, a step 4 units in the last place of the time or more, and there are 10 million increments of `step` at most.
    /// The points of a course rise in time.
    MALFORMED_TIME = "D015", "malformed-time", Error, source: "docs/scenes.md";

    /// Nothing holds the level of a body: it has no path to a fixed value.
    ///
    /// Only differences of its values count, so that any level of it would do, and a source in it has nowhere to go.
    /// The finding names the nodes.
    /// Fix the value of one of them, join the body to another, or, in a transient, give a node of it a capacity.
    /// An interface whose conductance is zero, an open gap for instance, joins nothing.
    FLOATING_BODY = "D016", "floating-body", Error, source: "docs/scenes.md";

    /// Nodes that infinite conductances make one are fixed at different values.
    ///
    /// An infinite conductance makes its two nodes one, which cannot have two values.
    /// Take away one of the fixed values, or give the conductance that is really there.
    CONTRADICTORY_VALUES = "D017", "contradictory-values", Error, source: "docs/scenes.md";

    /// An interface of a scene lacks what its law depends on.
    ///
    /// The law of the interaction depends on it, and nothing in the scene gives it.
    /// The finding says what to give, and where.
    MISSING_QUANTITY = "D018", "missing-quantity", Error, source: "docs/scenes.md";

    /// The equations of a scene were not solved.
    ///
    /// The finding says for each field how far the equations are from balance and at which node.
    /// Remedies: values to begin with under `[initial]` that are near the solution, shorter increments in a transient, and a look at the tables: a conductance that falls steeply with temperature, or a current that heats what conducts it, may have no steady state.
    NOT_CONVERGED = "D019", "not-converged", Error, source: "docs/scenes.md";
}
