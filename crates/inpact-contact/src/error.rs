//! The error type of this crate.

use inpact_parser::model::Name;

/// The reason why no rows can be made: a pair without a valid geometry, or result files without usable data.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(transparent)]
pub struct Error(Kind);

#[derive(Debug, Clone, PartialEq, thiserror::Error)]
enum Kind {
    #[error("the contact pair of `{}` and `{}` has no geometry{}: {reason}", pair[0], pair[1], at(*.time))]
    Geometry { pair: [String; 2], time: Option<f64>, reason: String },
    #[error("{0}")]
    ResultFiles(String),
}

fn at(time: Option<f64>) -> String {
    time.map_or_else(String::new, |time| format!(" at time {time:?}"))
}

impl Error {
    /// The slave and the master surface of the contact pair without a valid geometry.
    pub fn pair(&self) -> Option<[&str; 2]> {
        match &self.0 {
            Kind::Geometry { pair: [slave, master], .. } => Some([slave, master]),
            Kind::ResultFiles(_) => None,
        }
    }

    pub(crate) fn geometry(slave: &Name, master: &Name, time: Option<f64>, reason: String) -> Self {
        Self(Kind::Geometry { pair: [slave.to_string(), master.to_string()], time, reason })
    }

    pub(crate) fn result_files(message: String) -> Self {
        Self(Kind::ResultFiles(message))
    }
}
