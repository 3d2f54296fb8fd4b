//! Shells with a thickness: the position of a side, given nodes on the reference surface.

use crate::{Error, ErrorKind, FaceLabel, Surface};

/// The distance (L) of the side of a shell from its nodes, along the normal of that side.
///
/// The nodes lie on the reference surface, `offset` times the thickness from the midsurface, positive towards the shell's normal (*SHELL SECTION, OFFSET; SPOS is
/// 0.5, SNEG is −0.5). A clearance between two sides is the clearance between their reference surfaces minus the shift of each.
///
/// ```
/// use inpact_geometry::{FaceLabel, sheet_shift};
/// assert_eq!(sheet_shift(FaceLabel::Positive, 0.2, 0.0), 0.1);
/// assert_eq!(sheet_shift(FaceLabel::Positive, 0.2, 0.5), 0.0);
/// assert_eq!(sheet_shift(FaceLabel::Negative, 0.2, 0.5), 0.2);
/// assert_eq!(sheet_shift(FaceLabel::Numbered(1), 0.2, 0.0), 0.0);
/// ```
pub fn sheet_shift(side: FaceLabel, thickness: f64, offset: f64) -> f64 {
    match side {
        FaceLabel::Positive => (0.5 - offset) * thickness,
        FaceLabel::Negative => (0.5 + offset) * thickness,
        FaceLabel::Numbered(_) => 0.0,
    }
}

/// The shift of each node, the average of the shifts of the faces around it (one per face), in the order of [`Surface::nodes`].
///
/// # Errors
///
/// There is not one shift per face.
pub fn node_shifts(surface: &Surface, of_faces: &[f64]) -> Result<Vec<f64>, Error> {
    if of_faces.len() != surface.len() {
        return Err(ErrorKind::Values { what: "shift", expected: surface.len(), found: of_faces.len() }.into());
    }
    let average =
        |faces: &[crate::FaceId]| faces.iter().map(|face| of_faces[face.index()]).sum::<f64>() / faces.len() as f64;
    Ok(surface.nodes().iter().map(|node| average(surface.faces_at(*node))).collect())
}
