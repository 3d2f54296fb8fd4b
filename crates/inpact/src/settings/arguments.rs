//! The arguments for reading a deck.

use super::{Configuration, DialectName, ReadOptions, RelativeTo, Settings};
use crate::failure::Failure;
use clap::Args;
use inpact_parser::grammar::Release;
use serde::Deserialize;
use serde::de::{Deserializer, Error};
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Options of reading a deck; the same for every command that reads one, and for the settings of an editor.
#[derive(Debug, Clone, Default, Args, Deserialize)]
#[command(next_help_heading = "How the deck is read")]
#[serde(deny_unknown_fields, rename_all = "camelCase", default)]
pub(crate) struct DeckArguments {
    /// Whose keyword language the deck is in [default: abaqus].
    #[arg(long, value_enum)]
    dialect: Option<DialectName>,
    /// Which release of Abaqus the deck is for: 6.11, 6.14, 2016, 2017, 2022, 2024 [default: 2024].
    #[arg(long)]
    #[serde(deserialize_with = "release")]
    release: Option<Release>,
    /// Look for included files here as well; may be given several times.
    #[arg(long, value_name = "FOLDER")]
    #[serde(rename = "includeDirs")]
    include_dir: Vec<PathBuf>,
    /// Read no included file outside of this folder [default: the repository, for `--format github` and `--format sarif`].
    #[arg(long, value_name = "FOLDER")]
    #[serde(deserialize_with = "filled")]
    include_root: Option<PathBuf>,
    /// What the names of included files are relative to [default: deck].
    #[arg(long, value_enum)]
    relative_to: Option<RelativeTo>,
    /// Read this configuration instead of the `inpact.toml` above the deck.
    #[arg(long, value_name = "FILE", conflicts_with = "isolated")]
    #[serde(deserialize_with = "filled")]
    config: Option<PathBuf>,
    /// Read no configuration.
    #[arg(long)]
    isolated: bool,
}

/// What an editor gives for `release`.
fn release<'de, D: Deserializer<'de>>(given: D) -> Result<Option<Release>, D::Error> {
    filled(given).map_err(|error: D::Error| D::Error::custom(format!("`release`: {error}")))
}

/// A text of an editor's settings; an empty one is not given.
fn filled<'de, D: Deserializer<'de>, T: FromStr<Err: Display>>(given: D) -> Result<Option<T>, D::Error> {
    let text: Option<String> = Option::deserialize(given)?;
    text.filter(|text| !text.is_empty()).map(|text| text.parse().map_err(D::Error::custom)).transpose()
}

impl DeckArguments {
    /// The settings for the deck at `path`: the configuration above it, overridden by the arguments.
    ///
    /// # Errors
    /// The configuration cannot be read, or has a wrong value.
    pub(crate) fn settings(&self, path: &Path) -> Result<Settings, Failure> {
        Settings::of(path, &self.options())
    }

    /// The arguments as options, for readers of decks without arguments.
    pub(crate) fn options(&self) -> ReadOptions {
        ReadOptions {
            dialect: self.dialect.map(DialectName::dialect),
            release: self.release,
            include_dirs: self.include_dir.clone(),
            include_root: self.include_root.clone(),
            relative_to: self.relative_to,
            configuration: match (&self.config, self.isolated) {
                (_, true) => Configuration::Nothing,
                (Some(file), false) => Configuration::File(file.clone()),
                (None, false) => Configuration::Nearest,
            },
            ..ReadOptions::default()
        }
    }
}
