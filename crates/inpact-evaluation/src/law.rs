//! The interface laws as functions of plain inputs: what flows across a contact interface at one point.
//!
//! A law holds compiled tables and a few numbers and answers for one slave node at a time.
//! It knows nothing of decks, node files or histories: what an increment needs from its past (the jump of potential at its start, the rate of the clearance) is an input,
//! kept by [`crate::history`].
//!
//! - [`electrical`]: current across the interface and the heat it generates (*GAP ELECTRICAL CONDUCTANCE, semantics T-20 to T-25, H-01 to H-08);
//! - [`pore`]: pore fluid across the interface and into its changing gap (*CONTACT PERMEABILITY, semantics P-01 to P-42);
//! - [`heat`]: how generated heat is shared between the two sides (*GAP HEAT GENERATION);
//! - [`conductance`]: the clearance and pressure branches every conductance law shares;
//! - [`user`]: the conductance that a routine of the user's gives (*GAP ELECTRICAL CONDUCTANCE, USER, semantics 7.1);
//! - [`contact`]: the quantities at a point of contact and whether it is closed.

pub mod conductance;
pub mod contact;
pub mod electrical;
pub mod heat;
pub mod pore;
pub mod user;
