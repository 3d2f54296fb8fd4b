//! G001 to G006: the rules on geometry; each has its page.

use inpact_diagnostics::data_rules;

data_rules! {
    /// The rules on geometry, in the order of their codes.
    GEOMETRY_RULES;

    /// Both surfaces of a contact pair face the same way.
    ///
    /// ## Why
    /// Surfaces that touch have normals against each other.
    /// Where both point the same way, one of them lies on the far side of its elements: S1 was named for S2, or SPOS for SNEG.
    /// The solver then measures clearances through a body, as overclosures as thick as that.
    ///
    /// ## What to do
    /// Name the other face of the elements.
    ///
    /// ```inp,expect
    /// *NODE
    ///  1, 0., 0., 0.
    ///  2, 1., 0., 0.
    ///  3, 1., 1., 0.
    ///  4, 0., 1., 0.
    ///  5, 0., 0., 1.
    ///  6, 1., 0., 1.
    ///  7, 1., 1., 1.
    ///  8, 0., 1., 1.
    ///  11, 0., 0., 1.1
    ///  12, 1., 0., 1.1
    ///  13, 1., 1., 1.1
    ///  14, 0., 1., 1.1
    ///  15, 0., 0., 2.1
    ///  16, 1., 0., 2.1
    ///  17, 1., 1., 2.1
    ///  18, 0., 1., 2.1
    /// *ELEMENT, TYPE=C3D8T, ELSET=LOWER
    ///  1, 1, 2, 3, 4, 5, 6, 7, 8
    /// *ELEMENT, TYPE=C3D8T, ELSET=UPPER
    ///  2, 11, 12, 13, 14, 15, 16, 17, 18
    /// *SURFACE, NAME=TOP
    ///  LOWER, S1
    /// *SURFACE, NAME=BOTTOM
    ///  UPPER, S1
    /// *SURFACE INTERACTION, NAME=GAP
    /// *GAP CONDUCTANCE
    ///  10., 0.
    ///  0., 0.5
    /// *CONTACT PAIR, INTERACTION=GAP, TYPE=SURFACE TO SURFACE
    ///  BOTTOM, TOP
    /// ```
    ///
    /// ```inp
    /// *NODE
    ///  1, 0., 0., 0.
    ///  2, 1., 0., 0.
    ///  3, 1., 1., 0.
    ///  4, 0., 1., 0.
    ///  5, 0., 0., 1.
    ///  6, 1., 0., 1.
    ///  7, 1., 1., 1.
    ///  8, 0., 1., 1.
    ///  11, 0., 0., 1.1
    ///  12, 1., 0., 1.1
    ///  13, 1., 1., 1.1
    ///  14, 0., 1., 1.1
    ///  15, 0., 0., 2.1
    ///  16, 1., 0., 2.1
    ///  17, 1., 1., 2.1
    ///  18, 0., 1., 2.1
    /// *ELEMENT, TYPE=C3D8T, ELSET=LOWER
    ///  1, 1, 2, 3, 4, 5, 6, 7, 8
    /// *ELEMENT, TYPE=C3D8T, ELSET=UPPER
    ///  2, 11, 12, 13, 14, 15, 16, 17, 18
    /// *SURFACE, NAME=TOP
    ///  LOWER, S2
    /// *SURFACE, NAME=BOTTOM
    ///  UPPER, S1
    /// *SURFACE INTERACTION, NAME=GAP
    /// *GAP CONDUCTANCE
    ///  10., 0.
    ///  0., 0.5
    /// *CONTACT PAIR, INTERACTION=GAP, TYPE=SURFACE TO SURFACE
    ///  BOTTOM, TOP
    /// ```
    WRONG_SIDE = "G001", "wrong-side", Warning, source: "C-02";

    /// A slave node has no face of its master across.
    ///
    /// ## Why
    /// Nothing is conducted at a slave node beside its master, and it is in no contact.
    /// Abaqus lets the master reach beyond its outer edge by a tenth of an edge (EXTENSION ZONE).
    ///
    /// ## What to do
    /// Make the master at least as large as the slave, or let the larger surface be the master.
    ///
    /// ```inp,expect
    /// *NODE
    ///  1, 0., 0., 0.
    ///  2, 1., 0., 0.
    ///  3, 1., 1., 0.
    ///  4, 0., 1., 0.
    ///  5, 0., 0., 1.
    ///  6, 1., 0., 1.
    ///  7, 1., 1., 1.
    ///  8, 0., 1., 1.
    ///  11, 0.5, 0., 1.1
    ///  12, 1.5, 0., 1.1
    ///  13, 1.5, 1., 1.1
    ///  14, 0.5, 1., 1.1
    ///  15, 0.5, 0., 2.1
    ///  16, 1.5, 0., 2.1
    ///  17, 1.5, 1., 2.1
    ///  18, 0.5, 1., 2.1
    /// *ELEMENT, TYPE=C3D8T, ELSET=LOWER
    ///  1, 1, 2, 3, 4, 5, 6, 7, 8
    /// *ELEMENT, TYPE=C3D8T, ELSET=UPPER
    ///  2, 11, 12, 13, 14, 15, 16, 17, 18
    /// *SURFACE, NAME=TOP
    ///  LOWER, S2
    /// *SURFACE, NAME=BOTTOM
    ///  UPPER, S1
    /// *SURFACE INTERACTION, NAME=GAP
    /// *GAP CONDUCTANCE
    ///  10., 0.
    ///  0., 0.5
    /// *CONTACT PAIR, INTERACTION=GAP, TYPE=SURFACE TO SURFACE
    ///  BOTTOM, TOP
    /// ```
    ///
    /// ```inp
    /// *NODE
    ///  1, 0., 0., 0.
    ///  2, 1., 0., 0.
    ///  3, 1., 1., 0.
    ///  4, 0., 1., 0.
    ///  5, 0., 0., 1.
    ///  6, 1., 0., 1.
    ///  7, 1., 1., 1.
    ///  8, 0., 1., 1.
    ///  11, 0., 0., 1.1
    ///  12, 1., 0., 1.1
    ///  13, 1., 1., 1.1
    ///  14, 0., 1., 1.1
    ///  15, 0., 0., 2.1
    ///  16, 1., 0., 2.1
    ///  17, 1., 1., 2.1
    ///  18, 0., 1., 2.1
    /// *ELEMENT, TYPE=C3D8T, ELSET=LOWER
    ///  1, 1, 2, 3, 4, 5, 6, 7, 8
    /// *ELEMENT, TYPE=C3D8T, ELSET=UPPER
    ///  2, 11, 12, 13, 14, 15, 16, 17, 18
    /// *SURFACE, NAME=TOP
    ///  LOWER, S2
    /// *SURFACE, NAME=BOTTOM
    ///  UPPER, S1
    /// *SURFACE INTERACTION, NAME=GAP
    /// *GAP CONDUCTANCE
    ///  10., 0.
    ///  0., 0.5
    /// *CONTACT PAIR, INTERACTION=GAP, TYPE=SURFACE TO SURFACE
    ///  BOTTOM, TOP
    /// ```
    WITHOUT_MASTER = "G002", "without-master", Note, source: "V-5";

    /// A slave node lies deeper in its master than an element is long.
    ///
    /// ## Why
    /// No mesh has such an overclosure on purpose: the bodies are at wrong places, in other units, or the pair names other surfaces than were meant.
    /// The solver pushes the bodies apart in the first increment, or finds another face.
    ///
    /// ## What to do
    /// Look at the places and units of both bodies; ADJUST moves slave nodes onto the master before anything else.
    ///
    /// ```inp,expect
    /// *NODE
    ///  1, 0., 0., 0.
    ///  2, 1., 0., 0.
    ///  3, 1., 1., 0.
    ///  4, 0., 1., 0.
    ///  5, 0., 0., 1.
    ///  6, 1., 0., 1.
    ///  7, 1., 1., 1.
    ///  8, 0., 1., 1.
    ///  11, 0., 0., -0.5
    ///  12, 1., 0., -0.5
    ///  13, 1., 1., -0.5
    ///  14, 0., 1., -0.5
    ///  15, 0., 0., 0.5
    ///  16, 1., 0., 0.5
    ///  17, 1., 1., 0.5
    ///  18, 0., 1., 0.5
    /// *ELEMENT, TYPE=C3D8T, ELSET=LOWER
    ///  1, 1, 2, 3, 4, 5, 6, 7, 8
    /// *ELEMENT, TYPE=C3D8T, ELSET=UPPER
    ///  2, 11, 12, 13, 14, 15, 16, 17, 18
    /// *SURFACE, NAME=TOP
    ///  LOWER, S2
    /// *SURFACE, NAME=BOTTOM
    ///  UPPER, S1
    /// *SURFACE INTERACTION, NAME=GAP
    /// *GAP CONDUCTANCE
    ///  10., 0.
    ///  0., 0.5
    /// *CONTACT PAIR, INTERACTION=GAP, TYPE=SURFACE TO SURFACE
    ///  BOTTOM, TOP
    /// ```
    ///
    /// ```inp
    /// *NODE
    ///  1, 0., 0., 0.
    ///  2, 1., 0., 0.
    ///  3, 1., 1., 0.
    ///  4, 0., 1., 0.
    ///  5, 0., 0., 1.
    ///  6, 1., 0., 1.
    ///  7, 1., 1., 1.
    ///  8, 0., 1., 1.
    ///  11, 0., 0., 1.1
    ///  12, 1., 0., 1.1
    ///  13, 1., 1., 1.1
    ///  14, 0., 1., 1.1
    ///  15, 0., 0., 2.1
    ///  16, 1., 0., 2.1
    ///  17, 1., 1., 2.1
    ///  18, 0., 1., 2.1
    /// *ELEMENT, TYPE=C3D8T, ELSET=LOWER
    ///  1, 1, 2, 3, 4, 5, 6, 7, 8
    /// *ELEMENT, TYPE=C3D8T, ELSET=UPPER
    ///  2, 11, 12, 13, 14, 15, 16, 17, 18
    /// *SURFACE, NAME=TOP
    ///  LOWER, S2
    /// *SURFACE, NAME=BOTTOM
    ///  UPPER, S1
    /// *SURFACE INTERACTION, NAME=GAP
    /// *GAP CONDUCTANCE
    ///  10., 0.
    ///  0., 0.5
    /// *CONTACT PAIR, INTERACTION=GAP, TYPE=SURFACE TO SURFACE
    ///  BOTTOM, TOP
    /// ```
    DEEP_OVERCLOSURE = "G003", "deep-overclosure", Warning, source: "C-02";

    /// No slave node is near enough to its master for pore fluid to cross.
    ///
    /// ## Why
    /// Beyond CUTOFF FLOW ACROSS of *CONTACT PERMEABILITY nothing flows between the surfaces.
    /// Where that holds of every slave node, the interface is dry until the surfaces come nearer in a step.
    ///
    /// ## What to do
    /// Raise the cutoff, or close the gap of the mesh (ADJUST).
    ///
    /// ```inp,expect
    /// *NODE
    ///  1, 0., 0., 0.
    ///  2, 1., 0., 0.
    ///  3, 1., 1., 0.
    ///  4, 0., 1., 0.
    ///  5, 0., 0., 1.
    ///  6, 1., 0., 1.
    ///  7, 1., 1., 1.
    ///  8, 0., 1., 1.
    ///  11, 0., 0., 1.1
    ///  12, 1., 0., 1.1
    ///  13, 1., 1., 1.1
    ///  14, 0., 1., 1.1
    ///  15, 0., 0., 2.1
    ///  16, 1., 0., 2.1
    ///  17, 1., 1., 2.1
    ///  18, 0., 1., 2.1
    /// *ELEMENT, TYPE=C3D8T, ELSET=LOWER
    ///  1, 1, 2, 3, 4, 5, 6, 7, 8
    /// *ELEMENT, TYPE=C3D8T, ELSET=UPPER
    ///  2, 11, 12, 13, 14, 15, 16, 17, 18
    /// *SURFACE, NAME=TOP
    ///  LOWER, S2
    /// *SURFACE, NAME=BOTTOM
    ///  UPPER, S1
    /// *SURFACE INTERACTION, NAME=GAP
    /// *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.05, CUTOFF GAP FILL=0.5
    ///  1.E-9, 0.
    /// *CONTACT PAIR, INTERACTION=GAP, TYPE=SURFACE TO SURFACE
    ///  BOTTOM, TOP
    /// ```
    ///
    /// ```inp
    /// *NODE
    ///  1, 0., 0., 0.
    ///  2, 1., 0., 0.
    ///  3, 1., 1., 0.
    ///  4, 0., 1., 0.
    ///  5, 0., 0., 1.
    ///  6, 1., 0., 1.
    ///  7, 1., 1., 1.
    ///  8, 0., 1., 1.
    ///  11, 0., 0., 1.1
    ///  12, 1., 0., 1.1
    ///  13, 1., 1., 1.1
    ///  14, 0., 1., 1.1
    ///  15, 0., 0., 2.1
    ///  16, 1., 0., 2.1
    ///  17, 1., 1., 2.1
    ///  18, 0., 1., 2.1
    /// *ELEMENT, TYPE=C3D8T, ELSET=LOWER
    ///  1, 1, 2, 3, 4, 5, 6, 7, 8
    /// *ELEMENT, TYPE=C3D8T, ELSET=UPPER
    ///  2, 11, 12, 13, 14, 15, 16, 17, 18
    /// *SURFACE, NAME=TOP
    ///  LOWER, S2
    /// *SURFACE, NAME=BOTTOM
    ///  UPPER, S1
    /// *SURFACE INTERACTION, NAME=GAP
    /// *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.5, CUTOFF GAP FILL=0.5
    ///  1.E-9, 0.
    /// *CONTACT PAIR, INTERACTION=GAP, TYPE=SURFACE TO SURFACE
    ///  BOTTOM, TOP
    /// ```
    BEYOND_CUTOFF = "G004", "beyond-cutoff", Warning, source: "P-20";

    /// No clearance of the mesh is within a table against clearance.
    ///
    /// ## Why
    /// A thermal conductance is zero beyond the last clearance of its table, an electrical one stays what it was there.
    /// Where the smallest clearance of a pair lies beyond it, the table says nothing of the interface until the surfaces come nearer; tables and meshes in different units look like that.
    ///
    /// ## What to do
    /// Compare the units of table and mesh, let the table go on, or close the gap of the mesh (ADJUST).
    ///
    /// ```inp,expect
    /// *NODE
    ///  1, 0., 0., 0.
    ///  2, 1., 0., 0.
    ///  3, 1., 1., 0.
    ///  4, 0., 1., 0.
    ///  5, 0., 0., 1.
    ///  6, 1., 0., 1.
    ///  7, 1., 1., 1.
    ///  8, 0., 1., 1.
    ///  11, 0., 0., 1.6
    ///  12, 1., 0., 1.6
    ///  13, 1., 1., 1.6
    ///  14, 0., 1., 1.6
    ///  15, 0., 0., 2.6
    ///  16, 1., 0., 2.6
    ///  17, 1., 1., 2.6
    ///  18, 0., 1., 2.6
    /// *ELEMENT, TYPE=C3D8T, ELSET=LOWER
    ///  1, 1, 2, 3, 4, 5, 6, 7, 8
    /// *ELEMENT, TYPE=C3D8T, ELSET=UPPER
    ///  2, 11, 12, 13, 14, 15, 16, 17, 18
    /// *SURFACE, NAME=TOP
    ///  LOWER, S2
    /// *SURFACE, NAME=BOTTOM
    ///  UPPER, S1
    /// *SURFACE INTERACTION, NAME=GAP
    /// *GAP CONDUCTANCE
    ///  10., 0.
    ///  0., 0.5
    /// *CONTACT PAIR, INTERACTION=GAP, TYPE=SURFACE TO SURFACE
    ///  BOTTOM, TOP
    /// ```
    ///
    /// ```inp
    /// *NODE
    ///  1, 0., 0., 0.
    ///  2, 1., 0., 0.
    ///  3, 1., 1., 0.
    ///  4, 0., 1., 0.
    ///  5, 0., 0., 1.
    ///  6, 1., 0., 1.
    ///  7, 1., 1., 1.
    ///  8, 0., 1., 1.
    ///  11, 0., 0., 1.1
    ///  12, 1., 0., 1.1
    ///  13, 1., 1., 1.1
    ///  14, 0., 1., 1.1
    ///  15, 0., 0., 2.1
    ///  16, 1., 0., 2.1
    ///  17, 1., 1., 2.1
    ///  18, 0., 1., 2.1
    /// *ELEMENT, TYPE=C3D8T, ELSET=LOWER
    ///  1, 1, 2, 3, 4, 5, 6, 7, 8
    /// *ELEMENT, TYPE=C3D8T, ELSET=UPPER
    ///  2, 11, 12, 13, 14, 15, 16, 17, 18
    /// *SURFACE, NAME=TOP
    ///  LOWER, S2
    /// *SURFACE, NAME=BOTTOM
    ///  UPPER, S1
    /// *SURFACE INTERACTION, NAME=GAP
    /// *GAP CONDUCTANCE
    ///  10., 0.
    ///  0., 0.5
    /// *CONTACT PAIR, INTERACTION=GAP, TYPE=SURFACE TO SURFACE
    ///  BOTTOM, TOP
    /// ```
    TABLE_NOT_REACHED = "G005", "table-not-reached", Warning, source: "T-22";

    /// A surface of nodes conducts nothing in a coupled procedure with displacements.
    ///
    /// ## Why
    /// In *COUPLED TEMPERATURE-DISPLACEMENT only surfaces of elements exchange heat and current; a slave surface of nodes (TYPE=NODE) conducts neither, whatever its interaction says.
    ///
    /// ## What to do
    /// Make the slave surface of element faces.
    ///
    /// ```inp,expect
    /// *NODE
    ///  1, 0., 0., 0.
    ///  2, 1., 0., 0.
    ///  3, 1., 1., 0.
    ///  4, 0., 1., 0.
    ///  5, 0., 0., 1.
    ///  6, 1., 0., 1.
    ///  7, 1., 1., 1.
    ///  8, 0., 1., 1.
    ///  11, 0., 0., 1.1
    ///  12, 1., 0., 1.1
    ///  13, 1., 1., 1.1
    ///  14, 0., 1., 1.1
    ///  15, 0., 0., 2.1
    ///  16, 1., 0., 2.1
    ///  17, 1., 1., 2.1
    ///  18, 0., 1., 2.1
    /// *ELEMENT, TYPE=C3D8T, ELSET=LOWER
    ///  1, 1, 2, 3, 4, 5, 6, 7, 8
    /// *ELEMENT, TYPE=C3D8T, ELSET=UPPER
    ///  2, 11, 12, 13, 14, 15, 16, 17, 18
    /// *SURFACE, NAME=TOP
    ///  LOWER, S2
    /// *SURFACE, NAME=BOTTOM, TYPE=NODE
    ///  11, 0.25
    ///  12, 0.25
    ///  13, 0.25
    ///  14, 0.25
    /// *SURFACE INTERACTION, NAME=GAP
    /// *GAP CONDUCTANCE
    ///  10., 0.
    ///  0., 0.5
    /// *CONTACT PAIR, INTERACTION=GAP, TYPE=NODE TO SURFACE
    ///  BOTTOM, TOP
    /// *STEP
    /// *COUPLED TEMPERATURE-DISPLACEMENT
    ///  0.1, 1.
    /// *END STEP
    /// ```
    ///
    /// ```inp
    /// *NODE
    ///  1, 0., 0., 0.
    ///  2, 1., 0., 0.
    ///  3, 1., 1., 0.
    ///  4, 0., 1., 0.
    ///  5, 0., 0., 1.
    ///  6, 1., 0., 1.
    ///  7, 1., 1., 1.
    ///  8, 0., 1., 1.
    ///  11, 0., 0., 1.1
    ///  12, 1., 0., 1.1
    ///  13, 1., 1., 1.1
    ///  14, 0., 1., 1.1
    ///  15, 0., 0., 2.1
    ///  16, 1., 0., 2.1
    ///  17, 1., 1., 2.1
    ///  18, 0., 1., 2.1
    /// *ELEMENT, TYPE=C3D8T, ELSET=LOWER
    ///  1, 1, 2, 3, 4, 5, 6, 7, 8
    /// *ELEMENT, TYPE=C3D8T, ELSET=UPPER
    ///  2, 11, 12, 13, 14, 15, 16, 17, 18
    /// *SURFACE, NAME=TOP
    ///  LOWER, S2
    /// *SURFACE, NAME=BOTTOM
    ///  UPPER, S1
    /// *SURFACE INTERACTION, NAME=GAP
    /// *GAP CONDUCTANCE
    ///  10., 0.
    ///  0., 0.5
    /// *CONTACT PAIR, INTERACTION=GAP, TYPE=SURFACE TO SURFACE
    ///  BOTTOM, TOP
    /// *STEP
    /// *COUPLED TEMPERATURE-DISPLACEMENT
    ///  0.1, 1.
    /// *END STEP
    /// ```
    NODE_BASED_SURFACE = "G006", "node-based-surface", Warning, source: "C-01";
}
