//! The kinds of result files.

use std::fmt;

/// The supported formats of result files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// Results file of Abaqus in ASCII.
    Fil,
    /// Reports of Abaqus/Viewer: fields and XY data.
    Rpt,
    /// Results of CalculiX in ASCII.
    Frd,
    /// Printed output of CalculiX.
    Dat,
    /// Unstructured grid of VTK in XML.
    Vtu,
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Fil => "results file of Abaqus (.fil)",
            Self::Rpt => "report of Abaqus/Viewer (.rpt)",
            Self::Frd => "results of CalculiX (.frd)",
            Self::Dat => "printed output of CalculiX (.dat)",
            Self::Vtu => "unstructured grid of VTK (.vtu)",
        })
    }
}
