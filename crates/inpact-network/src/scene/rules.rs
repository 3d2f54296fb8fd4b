//! Rules about scenes, D011 to D019 and D023 to D025.

use inpact_diagnostics::data_rules;

data_rules! {
    /// The rules about scenes, in the order of their codes.
    SCENE_RULES;

    /// A scene is no TOML, has a key or a value that a scene has not, or entries that do not fit together.
    ///
    /// Tables beside the scene file are held to the same: a node has a name and is not held and fed at once, a link or an interface joins two nodes, a link conducts something, an interface has an area.
    /// The finding has the line, and for a misspelt key the nearest that exists.
    /// `schema/scene.schema.json` describes every key to an editor, docs/scenes.md to a person.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// ```
    /// ```toml scene.toml
    /// deck = "deck.inp"
    ///
    /// [[node]]
    /// name = "left"
    /// potential = { fixed = 1.0 }
    ///
    /// [[node]]
    /// name = "right"
    /// potential = { fixed = 0.0 }
    ///
    /// [[interface]]
    /// slave = "left"
    /// master = "right"
    /// area = 1.0
    /// clearence = 0.0
    /// ```
    /// ```console
    /// $ inpact solve scene.toml --findings full
    /// error[D011] malformed-scene
    ///
    ///   × there is no key `clearence` here
    ///     ╭─[scene.toml:15:1]
    ///  14 │ area = 1.0
    ///  15 │ clearence = 0.0
    ///     · ─────────
    ///     ╰────
    ///   help: is `clearance` meant? The keys here are `interaction`, `slave`, `secondary`, `master`,
    ///         `main`, `area`, `clearance`, `pressure`, `closed`, `fv`, `temperature`, `mass_flow`,
    ///         `shear`, `slip_rate`, `clearance_rate`, `char_length`, `perm_s`, `perm_m`
    /// ```
    MALFORMED_SCENE = "D011", "malformed-scene", Error, source: "docs/scenes.md";

    /// Two nodes of a scene have one name.
    ///
    /// A node is identified by its name, in the scene file and in all tables beside it.
    /// Rename one of the two, or give all that is known of the node in one entry.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// ```
    /// ```toml scene.toml
    /// deck = "deck.inp"
    ///
    /// [[node]]
    /// name = "left"
    /// potential = { fixed = 1.0 }
    ///
    /// [[node]]
    /// name = "right"
    /// potential = { fixed = 0.0 }
    ///
    /// [[interface]]
    /// slave = "left"
    /// master = "right"
    /// area = 1.0
    /// clearance = 0.0
    ///
    /// [[node]]
    /// name = "left"
    /// ```
    /// ```console
    /// $ inpact solve scene.toml --findings full
    /// error[D012] duplicate-node
    ///
    ///   × node `left` is defined twice, first in line 4
    ///     ╭─[scene.toml:18:8]
    ///  17 │ [[node]]
    ///  18 │ name = "left"
    ///     ·        ──────
    ///     ╰────
    ///   help: give every node a name of its own
    /// ```
    DUPLICATE_NODE = "D012", "duplicate-node", Error, source: "docs/scenes.md";

    /// A link or an interface names a node that the scene does not define.
    ///
    /// Define it with `[[node]]`, with a row of a table of nodes, or mend the name; names are compared letter by letter.
    /// A table of links defines nodes only where the scene has neither `[[node]]` nor a table of nodes; the rows of a Matrix Market file are nodes in any case.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// ```
    /// ```toml scene.toml
    /// deck = "deck.inp"
    ///
    /// [[node]]
    /// name = "left"
    /// potential = { fixed = 1.0 }
    ///
    /// [[node]]
    /// name = "right"
    /// potential = { fixed = 0.0 }
    ///
    /// [[interface]]
    /// slave = "left"
    /// master = "rihgt"
    /// area = 1.0
    /// clearance = 0.0
    /// ```
    /// ```console
    /// $ inpact solve scene.toml --findings full
    /// error[D013] unknown-node
    ///
    ///   × the scene defines no node `rihgt`
    ///     ╭─[scene.toml:13:10]
    ///  12 │ slave = "left"
    ///  13 │ master = "rihgt"
    ///     ·          ───────
    ///  14 │ area = 1.0
    ///     ╰────
    ///   help: is `right` meant? Otherwise add a [[node]] of that name
    /// ```
    UNKNOWN_NODE = "D013", "unknown-node", Error, source: "docs/scenes.md";

    /// A number of a scene is below zero, NaN or infinite where it must not be.
    ///
    /// Conductances, capacities and lengths are zero or more, areas above zero, shares from 0 to 1; only a conductance may be `inf`, which makes its two nodes one.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// ```
    /// ```toml scene.toml
    /// deck = "deck.inp"
    ///
    /// [[node]]
    /// name = "left"
    /// potential = { fixed = 1.0 }
    ///
    /// [[node]]
    /// name = "right"
    /// potential = { fixed = 0.0 }
    ///
    /// [[interface]]
    /// slave = "left"
    /// master = "right"
    /// area = -1.0
    /// clearance = 0.0
    /// ```
    /// ```console
    /// $ inpact solve scene.toml --findings full
    /// error[D014] unusable-number
    ///
    ///   × `area` of the interface of `left` and `right` is -1.0
    ///     ╭─[scene.toml:14:8]
    ///  13 │ master = "right"
    ///  14 │ area = -1.0
    ///     ·        ────
    ///  15 │ clearance = 0.0
    ///     ╰────
    ///   help: give a finite number above zero
    /// ```
    UNUSABLE_NUMBER = "D014", "unusable-number", Error, source: "docs/scenes.md";

    /// The time of a scene, or of a course, does not go forward.
    ///
    /// A transient has a start before its end and one of `step` and `tolerance`, and neither is lost in rounding: `tolerance` is 1e-12 or more, a step 4 units in the last place of the time or more, and there are 10 million increments of `step` at most.
    /// The points of a course rise in time.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// ```
    /// ```toml scene.toml
    /// deck = "deck.inp"
    /// procedure = "transient"
    ///
    /// [time]
    /// end = -1.0
    /// step = 0.1
    ///
    /// [[node]]
    /// name = "left"
    /// potential = { fixed = 1.0 }
    ///
    /// [[node]]
    /// name = "right"
    /// potential = { fixed = 0.0 }
    ///
    /// [[interface]]
    /// slave = "left"
    /// master = "right"
    /// area = 1.0
    /// clearance = 0.0
    /// ```
    /// ```console
    /// $ inpact solve scene.toml --findings full
    /// error[D015] malformed-time
    ///
    ///   × the time goes from 0.0 to -1.0
    ///    ╭─[scene.toml:5:7]
    ///  4 │ [time]
    ///  5 │ end = -1.0
    ///    ·       ────
    ///  6 │ step = 0.1
    ///    ╰────
    ///   help: let `end` be later than `start`
    /// ```
    MALFORMED_TIME = "D015", "malformed-time", Error, source: "docs/scenes.md";

    /// Nothing holds the level of a body: it has no path to a fixed value.
    ///
    /// Only differences of its values count, so that any level of it would do, and a source in it has nowhere to go.
    /// The finding names the nodes.
    /// Fix the value of one of them, join the body to another, or, in a transient, give a node of it a capacity.
    /// An interface whose conductance is zero, an open gap for instance, joins nothing.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// ```
    /// ```toml scene.toml
    /// deck = "deck.inp"
    ///
    /// [[node]]
    /// name = "left"
    /// potential = { source = 1.0 }
    ///
    /// [[node]]
    /// name = "right"
    /// potential = { fixed = 0.0 }
    ///
    /// [[interface]]
    /// slave = "left"
    /// master = "right"
    /// area = 1.0
    /// clearance = 1.0
    /// ```
    /// ```console
    /// $ inpact solve scene.toml --findings full
    /// error[D016] floating-body
    ///
    ///   × nothing holds the potential of `left`
    ///    ╭─[scene.toml:4:1]
    ///  3 │ [[node]]
    ///  4 │ name = "left"
    ///    · ─────────────
    ///  5 │ potential = { source = 1.0 }
    ///    ╰────
    ///   help: give one of these nodes a fixed potential, or a conductance to a body that has one; an
    ///         open gap of zero conductance is no path
    /// ```
    FLOATING_BODY = "D016", "floating-body", Error, source: "docs/scenes.md";

    /// Nodes that infinite conductances make one are fixed at different values.
    ///
    /// An infinite conductance makes its two nodes one, which cannot have two values.
    /// Take away one of the fixed values, or give the conductance that is really there.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// ```
    /// ```toml scene.toml
    /// deck = "deck.inp"
    ///
    /// [[node]]
    /// name = "left"
    /// potential = { fixed = 1.0 }
    ///
    /// [[node]]
    /// name = "right"
    /// potential = { fixed = 0.0 }
    ///
    /// [[link]]
    /// nodes = ["left", "right"]
    /// electrical = inf
    ///
    /// [[interface]]
    /// slave = "left"
    /// master = "right"
    /// area = 1.0
    /// clearance = 0.0
    /// ```
    /// ```console
    /// $ inpact solve scene.toml --findings full
    /// error[D017] contradictory-values
    ///
    ///   × the potential of `left` is fixed at 1.0 and that of `right` at 0.0, and infinite conductances
    ///   │ make them one
    ///    ╭─[scene.toml:8:1]
    ///  7 │ [[node]]
    ///  8 │ name = "right"
    ///    · ──────────────
    ///  9 │ potential = { fixed = 0.0 }
    ///    ╰────
    ///   help: fix one of the two, or both alike
    /// ```
    CONTRADICTORY_VALUES = "D017", "contradictory-values", Error, source: "docs/scenes.md";

    /// An interface of a scene lacks what its law depends on.
    ///
    /// The law of the interaction depends on it, and nothing in the scene gives it.
    /// The finding says what to give, and where.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// ```
    /// ```toml scene.toml
    /// deck = "deck.inp"
    ///
    /// [[node]]
    /// name = "left"
    /// potential = { fixed = 1.0 }
    ///
    /// [[node]]
    /// name = "right"
    /// potential = { fixed = 0.0 }
    ///
    /// [[interface]]
    /// slave = "left"
    /// master = "right"
    /// area = 1.0
    /// ```
    /// ```console
    /// $ inpact solve scene.toml --findings full
    /// error[D018] missing-quantity
    ///
    ///   × the interface of `left` and `right` lacks `clearance`, which its electrical conductance
    ///   │ depends on
    ///     ╭─[scene.toml:11:1]
    ///  10 │
    ///  11 │ [[interface]]
    ///     · ─────────────
    ///  12 │ slave = "left"
    ///     ╰────
    ///   help: give it in the scene
    /// ```
    MISSING_QUANTITY = "D018", "missing-quantity", Error, source: "docs/scenes.md";

    /// The equations of a scene were not solved.
    ///
    /// The finding says for each field how far the equations are from balance and at which node.
    /// Remedies: values to begin with under `[initial]` that are near the solution, shorter increments in a transient, and a look at the tables: a conductance that falls steeply with temperature, or a current that heats what conducts it, may have no steady state.
    ///
    /// ```inp deck.inp
    /// *PHYSICAL CONSTANTS, ABSOLUTE ZERO=0., STEFAN BOLTZMANN=5.67E-8
    /// *SURFACE INTERACTION, NAME=GAP
    /// *GAP RADIATION
    /// 1., 1.
    /// 1., 0.
    /// 1., 10.
    /// ```
    /// ```toml scene.toml
    /// deck = "deck.inp"
    ///
    /// [[node]]
    /// name = "body"
    /// temperature = { source = -1.0 }
    ///
    /// [[node]]
    /// name = "walls"
    /// temperature = { fixed = 1.0 }
    ///
    /// [[interface]]
    /// slave = "body"
    /// master = "walls"
    /// area = 1.0
    /// clearance = 1.0
    /// ```
    /// ```console
    /// $ inpact solve scene.toml --findings full
    /// error[D019] not-converged
    ///
    ///   × the temperature of `body` would be -17636683.30335097, below absolute zero at 0.0
    ///    ╭─[scene.toml:4:1]
    ///  3 │ [[node]]
    ///  4 │ name = "body"
    ///    · ─────────────
    ///  5 │ temperature = { source = -1.0 }
    ///    ╰────
    ///   help: more heat is drawn from it than can reach it: look at sources, at radiation and at
    ///         ABSOLUTE ZERO
    /// ```
    NOT_CONVERGED = "D019", "not-converged", Error, source: "docs/scenes.md";

    /// A node of a scene stands for a set or a surface that the deck does not have.
    ///
    /// Names of sets are those of *NSET and of NSET on *NODE, names of surfaces those of *SURFACE; in a deck with instances the name of the instance goes before, `PLATE-1.TOP`.
    /// A set without a node, and a surface without a face or a node, is none.
    ///
    /// ```inp deck.inp
    /// *NODE
    /// 1, 0., 0., 0.
    /// 2, 1., 0., 0.
    /// *NSET, NSET=LEFT
    /// 1,
    /// *NSET, NSET=BOTH
    /// 1, 2
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// *STEP
    /// *HEAT TRANSFER, STEADY STATE
    /// *BOUNDARY
    /// 1, 11, 11, 20.
    /// *END STEP
    /// ```
    /// ```toml scene.toml
    /// deck = "deck.inp"
    ///
    /// [conditions]
    ///
    /// [[node]]
    /// name = "left"
    /// set = "LEFT"
    ///
    /// [[node]]
    /// name = "right"
    /// set = "RIGHT"
    ///
    /// [[interface]]
    /// slave = "left"
    /// master = "right"
    /// area = 1.0
    /// clearance = 0.0
    /// ```
    /// ```console
    /// $ inpact solve scene.toml --findings full
    /// error[D023] unknown-part
    ///
    ///   × the deck has no node set `RIGHT` with a node in it
    ///     ╭─[scene.toml:11:1]
    ///  10 │ name = "right"
    ///  11 │ set = "RIGHT"
    ///     · ─────────────
    ///     ╰────
    ///   help: name a set of *NSET or a surface of *SURFACE
    /// ```
    UNKNOWN_PART = "D023", "unknown-part", Error, source: "docs/deck-scenes.md";

    /// The conditions of the deck on a set or a surface are not those of one node.
    ///
    /// A node of a scene has one value: a set of which only some nodes are held, or which is held at several values, has none.
    /// Name a smaller set, or give the condition in the scene.
    /// A condition whose course is not read (an *AMPLITUDE that is not tabular, a ramp over a transient step) is none either.
    ///
    /// ```inp deck.inp
    /// *NODE
    /// 1, 0., 0., 0.
    /// 2, 1., 0., 0.
    /// *NSET, NSET=LEFT
    /// 1,
    /// *NSET, NSET=BOTH
    /// 1, 2
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// *STEP
    /// *HEAT TRANSFER, STEADY STATE
    /// *BOUNDARY
    /// 1, 11, 11, 20.
    /// 2, 11, 11, 80.
    /// *END STEP
    /// ```
    /// ```toml scene.toml
    /// deck = "deck.inp"
    ///
    /// [conditions]
    ///
    /// [[node]]
    /// name = "left"
    /// set = "BOTH"
    ///
    /// [[node]]
    /// name = "right"
    /// temperature = { fixed = 20.0 }
    ///
    /// [[interface]]
    /// slave = "left"
    /// master = "right"
    /// area = 1.0
    /// clearance = 0.0
    /// ```
    /// ```console
    /// $ inpact solve scene.toml --findings full
    /// error[D024] not-one-condition
    ///
    ///   × the temperature of `left`: *BOUNDARY holds its nodes at several values of the temperature
    ///   │ (line 15 of `deck.inp`)
    ///    ╭─[scene.toml:7:1]
    ///  6 │ name = "left"
    ///  7 │ set = "BOTH"
    ///    · ────────────
    ///    ╰────
    ///   help: name a part on which there is one condition, or give `temperature` of the node in the
    ///         scene
    /// ```
    NOT_ONE_CONDITION = "D024", "not-one-condition", Error, source: "docs/deck-scenes.md";

    /// A condition of the deck is not in the scene.
    ///
    /// It acts on a potential, a temperature or a pore pressure in the step that the scene takes its conditions from, and no node of the scene stands for all of what it acts on, or it is of a kind that is not taken over.
    /// The finding has its line.
    /// Add a node for its set, or give what it means in the scene; where it does not matter, `inpact.toml` turns the rule off.
    ///
    /// ```inp deck.inp
    /// *NODE
    /// 1, 0., 0., 0.
    /// 2, 1., 0., 0.
    /// *NSET, NSET=LEFT
    /// 1,
    /// *NSET, NSET=BOTH
    /// 1, 2
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// *STEP
    /// *HEAT TRANSFER, STEADY STATE
    /// *BOUNDARY
    /// 1, 11, 11, 20.
    /// 2, 11, 11, 80.
    /// *END STEP
    /// ```
    /// ```toml scene.toml
    /// deck = "deck.inp"
    ///
    /// [conditions]
    ///
    /// [[node]]
    /// name = "left"
    /// set = "LEFT"
    ///
    /// [[node]]
    /// name = "right"
    /// temperature = { fixed = 20.0 }
    ///
    /// [[interface]]
    /// slave = "left"
    /// master = "right"
    /// area = 1.0
    /// clearance = 0.0
    /// ```
    /// ```console
    /// $ inpact solve scene.toml --findings full
    /// warning[D025] condition-left-out
    ///
    ///   ⚠ *BOUNDARY on `2` acts on a node that no node of the scene stands for (line 16 of `deck.inp`)
    ///   help: at scene.toml
    ///         add a node for it, or give what it means in the scene
    /// ```
    CONDITION_LEFT_OUT = "D025", "condition-left-out", Warning, source: "docs/deck-scenes.md";
}
