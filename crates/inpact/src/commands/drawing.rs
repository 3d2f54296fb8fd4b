//! Drawings as files, for `plot` and `tradeoff`: the format by file name, and the bytes.

use crate::failure::Failure;
use std::path::Path;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum DrawingFormat {
    Svg,
    Png,
}

impl DrawingFormat {
    /// The format by file name extension; `None` for any other name.
    pub(crate) fn of_name(path: &Path) -> Option<Self> {
        match path.extension()?.to_ascii_lowercase().to_str()? {
            "svg" => Some(Self::Svg),
            "png" => Some(Self::Png),
            _ => None,
        }
    }

    /// The content of a file of this format.
    ///
    /// # Errors
    /// For a PNG: where the drawing is too large for pixels, or this program was built without PNG.
    pub(crate) fn bytes(self, svg: String) -> Result<Vec<u8>, Failure> {
        match self {
            Self::Svg => Ok(svg.into_bytes()),
            #[cfg(feature = "png")]
            Self::Png => crate::chart::png::render(&svg)
                .map_err(|error| Failure::Usage(format!("cannot draw the picture: {error}"))),
            #[cfg(not(feature = "png"))]
            Self::Png => Err(Failure::Usage("this inpact was built without PNG: draw an .svg".to_owned())),
        }
    }
}
