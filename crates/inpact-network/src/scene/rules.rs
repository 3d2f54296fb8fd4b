//! Rules about scenes, D011 to D019 and D023 to D025, beside those of node tables.

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

    /// A node of a scene stands for a set or a surface that the deck does not have.
    ///
    /// Names of sets are those of *NSET and of NSET on *NODE, names of surfaces those of *SURFACE; in a deck with instances the name of the instance goes before, `PLATE-1.TOP`.
    /// A set without a node, and a surface without a face or a node, is none.
    UNKNOWN_PART = "D023", "unknown-part", Error, source: "docs/deck-scenes.md";

    /// The conditions of the deck on a set or a surface are not those of one node.
    ///
    /// A node of a scene has one value: a set of which only some nodes are held, or which is held at several values, has none.
    /// Name a smaller set, or give the condition in the scene.
    /// A condition whose course is not read (an *AMPLITUDE that is not tabular, a ramp over a transient step) is none either.
    NOT_ONE_CONDITION = "D024", "not-one-condition", Error, source: "docs/deck-scenes.md";

    /// A condition of the deck is not in the scene.
    ///
    /// It acts on a potential, a temperature or a pore pressure in the step that the scene takes its conditions from, and no node of the scene stands for all of what it acts on, or it is of a kind that is not taken over.
    /// The finding has its line.
    /// Add a node for its set, or give what it means in the scene; where it does not matter, `inpact.toml` turns the rule off.
    CONDITION_LEFT_OUT = "D025", "condition-left-out", Warning, source: "docs/deck-scenes.md";
}
