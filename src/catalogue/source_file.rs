//! Dataset files that were read for import, with their datasets and product data.

use super::content::content_of;
use crate::compute::btdf::Dataset;
use crate::formats::{CatalogueFields, FormatError, catalogue_fields, read_dataset};

/// Dataset file that was read for import.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SourceFile {
    /// Name of the file, without folder.
    pub name: String,
    /// Folder of the file; empty when unknown. Only files in the same folder can be states of one product.
    pub folder: String,
    /// BLAKE3 hash of the file's bytes, 64 hexadecimal digits.
    pub hash: String,
    /// Content hash of the datasets without their texts: equal for files with the same data.
    pub content: String,
    /// Datasets of the file.
    pub datasets: Vec<Dataset>,
    /// Product data in the file, such as kind, tags and provenance.
    pub fields: CatalogueFields,
}

impl SourceFile {
    /// Reads a dataset file. `name`: its file name; `bytes`: its content.
    ///
    /// # Errors
    /// Returns an error if the reader of the format refuses the bytes.
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
