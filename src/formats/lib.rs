//! File formats: conversion between bytes and the types of `compute`. Readers take `&[u8]` and never open files.
//!
//! A new dataset format is a module here, a variant of [`Format`] and a line in [`Format::sniff`], [`read_dataset`] and
//! [`write_dataset`]; a new luminaire format is a module here and a variant of [`LuminaireFormat`].

#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::disallowed_methods))]

// Layers have these names in all crates.
use crate as formats;
use cfs_compute as compute;
use cfs_drawing as drawing;
use cfs_texts as texts;

pub mod archive;
mod beams;
pub mod bsdf_xml;
pub mod btdf_text;
pub mod compact_rows;
pub mod control_curve;
pub mod dataset_blob;
pub mod decimal_comma;
pub mod encoding;
pub mod eulumdat;
mod family;
pub mod figures_table;
pub mod gazetteer;
pub mod ies;
mod ies_tokens;
mod kind;
pub mod lid_tables;
mod location;
pub mod luminaire;
mod luminaire_check;
mod luminaire_format;
pub mod luminaire_index;
mod luminaire_opening;
mod luminaire_planes;
mod luminaire_text;
pub mod package;
pub mod scan;
pub mod state_table;
pub mod system_toml;
pub mod toml_place;
pub mod weather;
mod written;

pub use btdf_text::CatalogueFields;
pub use family::{is_one_function, merge_sides};
pub use kind::{FileKind, HEAD, extension_of};
pub use location::{FormatError, Location};
pub use luminaire_format::LuminaireFormat;
pub use written::Written;

use crate::compute::btdf::Dataset;
use crate::compute::limits;
use std::collections::HashMap;

/// Exchange format of BSDF datasets that the program reads and writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Format {
    /// LBNL BSDF XML: Klems matrices and tensor trees.
    BsdfXml,
    /// Text with a TOML header (`.btdf.txt`), for data of goniophotometers.
    BtdfText,
}

impl Format {
    /// All exchange formats of datasets.
    pub const ALL: [Self; 2] = [Self::BsdfXml, Self::BtdfText];

    /// Returns the short name of the format for messages and listings.
    pub const fn name(self) -> &'static str {
        match self {
            Self::BsdfXml => "BSDF XML",
            Self::BtdfText => "BTDF text",
        }
    }

    /// Returns the file name extensions of the format, in lower case without the dot.
    pub const fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::BsdfXml => &["xml"],
            Self::BtdfText => &["btdf.txt"],
        }
    }

    /// Returns the format with the extension of a file's name; `None` for other extensions.
    pub fn from_name(name: &str) -> Option<Self> {
        let name = name.to_ascii_lowercase();
        Self::ALL.into_iter().find(|format| format.extensions().iter().any(|ext| name.ends_with(&format!(".{ext}"))))
    }

    /// Returns the format of a file, recognised by its content, then by its name; `None` if it is unknown.
    pub fn sniff(name: &str, bytes: &[u8]) -> Option<Self> {
        let (head, _) = encoding::any_text(&bytes[..bytes.len().min(4096)]);
        if head.contains("<WindowElement") {
            return Some(Self::BsdfXml);
        }
        if head.contains("cfs-btdf") {
            return Some(Self::BtdfText);
        }
        Self::from_name(name)
    }

    /// Returns a file's name without its folder and without the extension of its format.
    pub fn stem(name: &str) -> &str {
        let name = name.rsplit(['/', '\\']).next().unwrap_or(name);
        let lower = name.to_ascii_lowercase();
        let extensions = Self::ALL.into_iter().flat_map(|format| format.extensions());
        let known = extensions.filter(|ext| lower.ends_with(&format!(".{ext}"))).map(|ext| ext.len() + 1).max();
        // ASCII lower case has the same bytes, and extensions are ASCII.
        let cut = known.or_else(|| Some(name.len() - name.rfind('.').filter(|at| *at > 0)?)).unwrap_or(0);
        &name[..name.len() - cut]
    }

    fn list() -> String {
        let names: Vec<String> = Self::ALL
            .into_iter()
            .map(|format| format!("{} (.{})", format.name(), format.extensions().join(", .")))
            .collect();
        names.join(", ")
    }
}

/// Reads a dataset file of any format (exchange formats, `.cfsd`, package of one product) from its bytes: one dataset
/// per state. Of `name` only the extension is used.
///
/// # Errors
/// Returns an error if the file is not valid, or if its format is unknown.
pub fn read_dataset(name: &str, bytes: &[u8]) -> Result<Vec<Dataset>, FormatError> {
    if bytes.starts_with(dataset_blob::MAGIC) {
        let read = dataset_blob::decode(bytes);
        let error =
            |e: dataset_blob::BlobError| FormatError::new(Location::file(), e.to_string(), "a whole .cfsd file");
        return Ok(vec![read.map_err(error)?]);
    }
    if bytes.starts_with(package::MAGIC) {
        return packed(bytes);
    }
    match Format::sniff(name, bytes) {
        Some(Format::BsdfXml) => Ok(vec![bsdf_xml::read(bytes)?]),
        Some(Format::BtdfText) => Ok(vec![btdf_text::read(bytes)?]),
        None if bytes.is_empty() => Err(FormatError::new(Location::file(), "an empty file", Format::list())),
        None if encoding::is_web_page(bytes) => Err(encoding::NotText::WEB_PAGE.into()),
        None => Err(FormatError::new(Location::file(), "an unknown format", Format::list())),
    }
}

/// Returns the datasets of a package with a single product, one per state.
fn packed(bytes: &[u8]) -> Result<Vec<Dataset>, FormatError> {
    let error = |what: String, expected: &str| FormatError::new(Location::file(), what, expected);
    let package = package::read(bytes).map_err(|e| error(e.to_string(), "a whole package (.cfsp)"))?;
    let [product] = package.products.as_slice() else {
        let what = format!("a package of {} products", package.products.len());
        return Err(error(what, "a package of one product here; the catalogue imports all"));
    };
    // What several states name is decoded once; their datasets share its values.
    let mut decoded: HashMap<&str, Dataset> = HashMap::new();
    let mut left = limits::DECODED_BYTES;
    let dataset = |state| {
        let package::PackageState { key, dataset: hash, .. }: &package::PackageState = state;
        if !decoded.contains_key(hash.as_str()) {
            let blob = package.datasets.get(hash).map(Vec::as_slice).unwrap_or_default();
            let read = dataset_blob::decode_within(blob, &mut left);
            let read = read.map_err(|e| error(format!("state {key}: {e}"), "a whole package (.cfsp)"))?;
            decoded.insert(hash, read);
        }
        let mut dataset = decoded[hash.as_str()].clone();
        // Kept once, with the product.
        dataset.described = system_toml::described(&product.system, &state.key);
        Ok(dataset)
    };
    product.states.iter().map(dataset).collect()
}

/// Returns the product data for the catalogue that a dataset file states beyond its datasets; empty for formats without
/// any.
///
/// # Errors
/// Returns an error if the file's header is not valid.
pub fn catalogue_fields(name: &str, bytes: &[u8]) -> Result<CatalogueFields, FormatError> {
    match Format::sniff(name, bytes) {
        Some(Format::BtdfText) => btdf_text::catalogue_fields(bytes),
        Some(Format::BsdfXml) | None => Ok(CatalogueFields::default()),
    }
}

/// Returns a file of the given format with the datasets, one per state.
///
/// # Errors
/// Returns an error if there are more states than a file of the format can contain, or if the format cannot express the
/// data.
pub fn write_dataset(format: Format, datasets: &[Dataset]) -> Result<Written, FormatError> {
    match (format, datasets) {
        (Format::BsdfXml, [one]) => bsdf_xml::write(one),
        (Format::BtdfText, [one]) => btdf_text::write(one),
        (Format::BsdfXml | Format::BtdfText, many) => Err(FormatError::new(
            Location::file(),
            format!("{} states for one {} file", many.len(), format.name()),
            "exactly one state (choose it by its key)",
        )),
    }
}

/// Returns the format in which a file is to be written, by the extension of its name.
///
/// # Errors
/// Returns an error if no format has the extension.
pub fn format_to_write(name: &str) -> Result<Format, FormatError> {
    Format::from_name(name)
        .ok_or_else(|| FormatError::new(Location::file(), "an extension that no format has", Format::list()))
}
