//! The rules about bodies: why they cannot be lumped, and which options of a deck lie outside of them. The doc comment of each is its page.

use inpact_diagnostics::data_rules;

data_rules! {
    /// The rules about bodies.
    BODY_RULES;

    /// The mesh of a body is not one that can be solved.
    ///
    /// Elements without *SOLID SECTION, without coordinates of a node, incomplete, inside out or flat; a section of layers; options that make nodes and elements elsewhere (*NGEN, *ELGEN, INPUT); a deck whose elements are no solids in space.
    /// Nothing is put in the place of what is missing: the body would be another one.
    ///
    /// ```inp deck.inp
    /// *NODE
    /// 1, 0., 0., 0.
    /// 2, 1., 0., 0.
    /// 3, 0., 1., 0.
    /// 4, 0., 0., 1.
    /// *ELEMENT, TYPE=C3D4, ELSET=BODY
    /// 1, 1, 3, 2, 4
    /// *SOLID SECTION, ELSET=BODY, MATERIAL=STEEL
    /// *MATERIAL, NAME=STEEL
    /// *CONDUCTIVITY
    /// 60.
    /// ```
    /// ```console
    /// $ inpact body deck.inp --terminals 1,4 --findings full
    /// error[D026] unusable-mesh
    ///
    ///   × element 1 of type C3D4: the element is inside out or flat: expected a Jacobian determinant
    ///   │ above 0 at its integration points, found -1.0
    ///    ╭─[deck.inp:6:1]
    ///  6 │ *ELEMENT, TYPE=C3D4, ELSET=BODY
    ///    · ───────────────────────────────
    ///    ╰────
    /// ```
    UNUSABLE_MESH = "D026", "unusable-mesh", Error, source: "docs/bodies.md";

    /// A property of a material says nothing that a body can be solved with.
    ///
    /// The material is not defined, or has no *CONDUCTIVITY or *ELECTRICAL CONDUCTIVITY, or that is not above 0 in every direction, or it depends on temperature and none is given (`--temperature`), or on field variables, or its directions follow axes that are not read.
    ///
    /// ```inp deck.inp
    /// *NODE
    /// 1, 0., 0., 0.
    /// 2, 1., 0., 0.
    /// 3, 0., 1., 0.
    /// 4, 0., 0., 1.
    /// *ELEMENT, TYPE=C3D4, ELSET=BODY
    /// 1, 1, 2, 3, 4
    /// *SOLID SECTION, ELSET=BODY, MATERIAL=STEEL
    /// *MATERIAL, NAME=STEEL
    /// *CONDUCTIVITY
    /// 60., 0.
    /// 40., 100.
    /// ```
    /// ```console
    /// $ inpact body deck.inp --terminals 1,4
    /// deck.inp:10:1: error[D027] *CONDUCTIVITY of `STEEL` depends on temperature, from 0.0 to 100.0: a body is lumped at one temperature, which must be given
    /// ```
    UNUSABLE_PROPERTY = "D027", "unusable-property", Error, source: "docs/bodies.md";

    /// A terminal is no part of the surface of one body.
    ///
    /// It is not defined, no solid element has a node of it, it lies in two bodies, or it shares a node with another terminal: between terminals that touch there is no conductance.
    ///
    /// ```inp deck.inp
    /// *NODE
    /// 1, 0., 0., 0.
    /// 2, 1., 0., 0.
    /// 3, 0., 1., 0.
    /// 4, 0., 0., 1.
    /// *ELEMENT, TYPE=C3D4, ELSET=BODY
    /// 1, 1, 2, 3, 4
    /// *NSET, NSET=EDGE
    /// 1, 2
    /// *SOLID SECTION, ELSET=BODY, MATERIAL=STEEL
    /// *MATERIAL, NAME=STEEL
    /// *CONDUCTIVITY
    /// 60.
    /// ```
    /// ```console
    /// $ inpact body deck.inp --terminals 1,EDGE
    /// deck.inp:8:1: error[D028] the terminals `1` and `EDGE` touch in node 1: no conductance is between them
    /// ```
    /// ```console
    /// $ inpact body deck.inp --terminals EDGE,TOP
    /// deck.inp: error[D028] the deck has no surface and no node set `TOP`: it has `EDGE`
    /// ```
    UNUSABLE_TERMINAL = "D028", "unusable-terminal", Error, source: "docs/bodies.md";

    /// A part of the deck is beside the bodies, and conducts nothing here.
    ///
    /// Elements that are not solid, and options that join nodes beside elements (*TIE, *EQUATION, *MPC, *COUPLING …) or let heat leave by radiation.
    /// Where such a part matters, the conductances are not those of the model.
    /// For a scene with both fields, materials whose *JOULE HEAT FRACTION is not given, or is none that a link can have, are such parts too: the current makes no heat in their bodies.
    ///
    /// ```inp deck.inp
    /// *NODE
    /// 1, 0., 0., 0.
    /// 2, 1., 0., 0.
    /// 3, 0., 1., 0.
    /// 4, 0., 0., 1.
    /// *ELEMENT, TYPE=C3D4, ELSET=BODY
    /// 1, 1, 2, 3, 4
    /// *ELEMENT, TYPE=S3, ELSET=SKIN
    /// 2, 1, 2, 3
    /// *SOLID SECTION, ELSET=BODY, MATERIAL=STEEL
    /// *MATERIAL, NAME=STEEL
    /// *CONDUCTIVITY
    /// 60.
    /// *DENSITY
    /// 7800.
    /// *SPECIFIC HEAT
    /// 500.
    /// ```
    /// ```console
    /// $ inpact body deck.inp --terminals 1,4
    /// deck.inp:8:1: note[D029] elements of type `S3` are not solid, and conduct nothing here
    /// ```
    BESIDE_BODIES = "D029", "beside-bodies", Note, source: "docs/bodies.md";

    /// A conductance between two terminals is below zero.
    ///
    /// By the maximum principle none is; a coarse or distorted mesh between the terminals may break that.
    /// A table shows it, but no link of a scene is below zero: `--format links` and `--format scene` are refused.
    /// A finer mesh between the two terminals mends it.
    ///
    /// ```inp deck.inp
    /// *NODE
    /// 1, 0., 0., 0.
    /// 2, 1., 0., 0.
    /// 3, 1., 1., 0.
    /// 4, 0., 1., 0.
    /// 5, 0., 0., .05
    /// 6, 1., 0., .05
    /// 7, 1., 1., .05
    /// 8, 0., 1., .05
    /// *ELEMENT, TYPE=C3D8, ELSET=PLATE
    /// 1, 1, 2, 3, 4, 5, 6, 7, 8
    /// *SOLID SECTION, ELSET=PLATE, MATERIAL=STEEL
    /// *MATERIAL, NAME=STEEL
    /// *CONDUCTIVITY
    /// 40.
    /// *DENSITY
    /// 7800.
    /// *SPECIFIC HEAT
    /// 500.
    /// ```
    /// ```console
    /// $ inpact body deck.inp --terminals 1,2,3,4,5,6,7,8 --format links
    /// deck.inp: error[D030] the thermal conductance of `1` and `2` is -44.33333, below zero, which no link of a scene is: the mesh is too coarse between them
    /// ```
    NEGATIVE_CONDUCTANCE = "D030", "negative-conductance", Error, source: "docs/bodies.md";
}
