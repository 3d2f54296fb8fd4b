//! Quantities by record key.
//!
//! Source: Abaqus Output Reference, "Results file output format", records written for any node file output request (101 to
//! 237) and for any contact surface file output request (1511 to 1578); the manual's order gives 1530 as HTL.

/// Quantities of a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A node: the first attribute is its label.
    Nodal,
    /// A slave node: its label is in the header before, record 1504.
    Contact,
    /// A contact pair as a whole.
    Pair,
}

/// Names of the components of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Components {
    /// By active degrees of freedom: the names before 1 to 3 and before 4 to 6.
    Freedoms(&'static str, &'static str),
    /// By a name and a number that begins here.
    From(&'static str, usize),
    /// One by one.
    Names(&'static [&'static str]),
}

/// A quantity and its components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Quantity {
    pub(super) name: &'static str,
    pub(super) kind: Kind,
    components: Components,
}

impl Quantity {
    /// The names of this many components; `freedoms` are the active degrees of freedom in order.
    pub(super) fn columns(&self, count: usize, freedoms: &[usize]) -> Vec<String> {
        (0..count).map(|at| self.column(at, count, freedoms)).collect()
    }

    fn column(&self, at: usize, count: usize, freedoms: &[usize]) -> String {
        match self.components {
            Components::Names(names) if at < names.len() => names[at].to_owned(),
            Components::Freedoms(translation, rotation) => match freedoms.get(at) {
                Some(freedom @ 4..=6) => format!("{rotation}{}", freedom - 3),
                Some(freedom) => format!("{translation}{freedom}"),
                None if freedoms.is_empty() => format!("{translation}{}", at + 1),
                None => format!("{}_{}", self.name, at + 1),
            },
            Components::From(name, first) => format!("{name}{}", first + at),
            Components::Names(_) if count == 1 => self.name.to_owned(),
            Components::Names(_) => format!("{}{}", self.name, at + 1),
        }
    }
}

/// The quantity of a record key, if it is nodal or of contact.
pub(super) fn quantity(key: i64) -> Option<Quantity> {
    use Components::{Freedoms, From, Names};
    use Kind::{Contact, Nodal, Pair};
    let (name, kind, components) = match key {
        101 => ("U", Nodal, Freedoms("U", "UR")),
        102 => ("V", Nodal, Freedoms("V", "VR")),
        103 => ("A", Nodal, Freedoms("A", "AR")),
        104 => ("RF", Nodal, Freedoms("RF", "RM")),
        105 => ("EPOT", Nodal, Names(&[])),
        106 => ("CF", Nodal, Freedoms("CF", "CM")),
        107 => ("COORD", Nodal, From("COOR", 1)),
        108 => ("POR", Nodal, Names(&[])),
        109 => ("RVF", Nodal, Names(&[])),
        110 => ("RVT", Nodal, Names(&[])),
        119 => ("RCHG", Nodal, Names(&[])),
        120 => ("CECHG", Nodal, Names(&[])),
        136 => ("PCAV", Nodal, Names(&[])),
        137 => ("CVOL", Nodal, Names(&[])),
        138 => ("RECUR", Nodal, Names(&[])),
        139 => ("CECUR", Nodal, Names(&[])),
        145 => ("VF", Nodal, Freedoms("VF", "VM")),
        146 => ("TF", Nodal, Freedoms("TF", "TM")),
        151 => ("PABS", Nodal, Names(&[])),
        201 => ("NT", Nodal, From("NT", 11)),
        204 => ("RFL", Nodal, From("RFL", 11)),
        206 => ("CFL", Nodal, From("CFL", 11)),
        214 => ("RFLE", Nodal, From("RFLE", 11)),
        221 => ("NNC", Nodal, From("NNC", 1)),
        237 => ("MOT", Nodal, Names(&[])),
        1511 => ("CSTRESS", Contact, Names(&["CPRESS", "CSHEAR1", "CSHEAR2"])),
        1512 => ("CDSTRESS", Contact, Names(&["CDPRESS", "CDSHEAR1", "CDSHEAR2"])),
        1521 => ("CDISP", Contact, Names(&["COPEN", "CSLIP1", "CSLIP2"])),
        1522 => ("CFN", Pair, Names(&["CFNM", "CFN1", "CFN2", "CFN3"])),
        1523 => ("CFS", Pair, Names(&["CFSM", "CFS1", "CFS2", "CFS3"])),
        1524 => ("CAREA", Pair, Names(&[])),
        1526 => ("CMN", Pair, Names(&["CMNM", "CMN1", "CMN2", "CMN3"])),
        1527 => ("CMS", Pair, Names(&["CMSM", "CMS1", "CMS2", "CMS3"])),
        1528 => ("HFL", Contact, Names(&[])),
        1529 => ("HFLA", Contact, Names(&[])),
        1530 => ("HTL", Contact, Names(&[])),
        1531 => ("HTLA", Contact, Names(&[])),
        1532 => ("SFDR", Contact, Names(&[])),
        1533 => ("SFDRA", Contact, Names(&[])),
        1534 => ("SFDRT", Contact, Names(&[])),
        1535 => ("SFDRTA", Contact, Names(&[])),
        1536 => ("WEIGHT", Contact, Names(&[])),
        1537 => ("SJD", Contact, Names(&[])),
        1538 => ("SJDA", Contact, Names(&[])),
        1539 => ("SJDT", Contact, Names(&[])),
        1540 => ("SJDTA", Contact, Names(&[])),
        1541 => ("ECD", Contact, Names(&[])),
        1542 => ("ECDA", Contact, Names(&[])),
        1543 => ("ECDT", Contact, Names(&[])),
        1544 => ("ECDTA", Contact, Names(&[])),
        1545 => ("PFL", Contact, Names(&[])),
        1546 => ("PFLA", Contact, Names(&[])),
        1547 => ("PTL", Contact, Names(&[])),
        1548 => ("PTLA", Contact, Names(&[])),
        1549 => ("TPFL", Pair, Names(&[])),
        1550 => ("TPTL", Pair, Names(&[])),
        1570 => ("DBT", Contact, Names(&[])),
        1571 => ("DBSF", Contact, Names(&[])),
        1572 => ("DBS", Contact, Names(&[])),
        1573 => ("XN", Pair, From("XN", 1)),
        1574 => ("XS", Pair, From("XS", 1)),
        1575 => ("CFT", Pair, Names(&["CFTM", "CFT1", "CFT2", "CFT3"])),
        1576 => ("CMT", Pair, Names(&["CMTM", "CMT1", "CMT2", "CMT3"])),
        1577 => ("XT", Pair, From("XT", 1)),
        1578 => ("CTRQ", Pair, Names(&[])),
        _ => return None,
    };
    Some(Quantity { name, kind, components })
}
