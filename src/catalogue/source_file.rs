//! A dataset file with what it tells.

use super::content::content_of;
use crate::compute::btdf::Dataset;
use crate::formats::{CatalogueFields, FormatError, catalogue_fields, read_dataset};

/// A dataset file that was read.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SourceFile {
    /// Its name, without folder.
    pub name: String,
    /// Where it lies; empty when that is not known. States of a product lie together.
    pub folder: String,
    /// BLAKE3 hash of its bytes, 64 hexadecimal digits.
    pub hash: String,
    /// What its datasets hold, whatever they are called: equal for files of the same data.
    pub content: String,
    /// What it holds.
    pub datasets: Vec<Dataset>,
    /// What it tells about the product.
    pub fields: CatalogueFields,
}

impl SourceFile {
    /// Reads a file's bytes.
    ///
    /// # Errors
    /// Of the reader.
    pub fn read(name: &str, bytes: &[u8]) -> Result<Self, FormatError> {
        let datasets = read_dataset(name, bytes)?;
        let contents: Vec<String> = datasets.iter().map(content_of).collect();
        Ok(Self {
            name: name.to_owned(),
            folder: String::new(),
            hash: blake3::hash(bytes).to_hex().to_string(),
            content: contents.join(" "),
            datasets,
            fields: catalogue_fields(name, bytes)?,
        })
    }
}
