//! Exchange packages (`.cfsp`): products of the catalogue with their datasets in one zip file.
//!
//! `manifest.json` lists the products; `datasets/HASH.bin` contains one dataset each in the compact binary format,
//! named by the BLAKE3 hash of its bytes, which is checked on reading.

use super::dataset_blob::content_hash;
use super::encoding::{NotText, is_web_page};
use crate::compute::limits;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, HashSet};
use std::io::{Cursor, Read, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

/// Name of the format in the manifest, without its version.
const FORMAT: &str = "cfs-package";
/// Newest version of the package format that is read. The version that is written is the oldest that can contain the
/// products: 2 where a product has a licence, else 1.
pub const VERSION: u32 = 2;
/// Maximum size of the manifest. \[bytes\]
const MOST_MANIFEST: u64 = limits::MANIFEST_BYTES;
/// Maximum size of a dataset in a package. \[bytes\]
const MOST_DATASET: u64 = limits::ENTRY_BYTES;
/// Maximum size of all datasets of a package together. \[bytes\]
const MOST_TOTAL: u64 = limits::PACKAGE_BYTES;
/// Maximum number of entries in a package's zip file.
const MOST_ENTRIES: usize = limits::ARCHIVE_ENTRIES;

/// Content of an exchange package: products and their datasets.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Package {
    /// Products of the package.
    pub products: Vec<PackageProduct>,
    /// Datasets in the compact binary format, by the BLAKE3 hash of their bytes.
    pub datasets: BTreeMap<String, Vec<u8>>,
}

/// Name of the format in a manifest, read first, since the manifest of a newer version may have any other keys.
#[derive(Deserialize)]
struct Head {
    format: String,
}

#[derive(Serialize, Deserialize)]
struct Manifest {
    format: String,
    products: Vec<PackageProduct>,
}

/// Product as the manifest of a package describes it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PackageProduct {
    /// Key of the product in the catalogue from which it was exported.
    pub key: String,
    /// Name of the product.
    pub name: String,
    /// Maker of the product; may be empty.
    #[serde(default)]
    pub manufacturer: String,
    /// Kind of system, e.g. `venetian`.
    #[serde(default)]
    pub kind: String,
    /// Description of the product in free text.
    #[serde(default)]
    pub description: String,
    /// Provenance of the product's data.
    #[serde(default)]
    pub provenance: PackageProvenance,
    /// Licence of the data; may be empty.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub license: String,
    /// Tags by which the product is found in the catalogue.
    #[serde(default)]
    pub tags: Vec<String>,
    /// States of the product in their order; at least one.
    pub states: Vec<PackageState>,
    /// Points of the product's control curve; empty without one.
    #[serde(default)]
    pub control_curve: Vec<PackageCurvePoint>,
    /// Text of the system description from which the data were computed; empty for other products.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub system: String,
}

/// Provenance of a product's data, in the manifest of a package.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PackageProvenance {
    /// Origin of the data: `measured`, `computed` or `unknown`.
    pub origin: String,
    /// Author of the measurement or computation.
    pub author: String,
    /// Method of the measurement or computation: device or formula.
    pub method: String,
    /// Date of the measurement or computation, as the source states it.
    pub date: String,
    /// Name of the file from which the data were read.
    pub source_file: String,
    /// BLAKE3 hash of the file from which the data were read.
    pub source_hash: String,
    /// Name of the face of the system that looks into the room.
    pub inside_face: String,
}

/// State of a product, in the manifest of a package.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PackageState {
    /// Key of the state; empty for a product without states.
    pub key: String,
    /// Label of the state for display.
    #[serde(default)]
    pub label: String,
    /// Value that the state sets, e.g. the slat angle \[°\]; `None` if it has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// BLAKE3 hash of the state's dataset, see [`Package::datasets`].
    pub dataset: String,
}

/// Point of a product's control curve, in the manifest of a package.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PackageCurvePoint {
    /// Profile angle of the sun. \[°\]
    pub profile_angle: f64,
    /// Demanded value at this profile angle, in the unit of the states' values, e.g. slat angle \[°\].
    pub value: f64,
}

/// Error in reading or writing an exchange package.
#[derive(Debug, thiserror::Error)]
pub enum PackageError {
    /// Bytes that are not a zip file, or are damaged.
    #[error("not a readable package: {0}")]
    Zip(#[from] zip::result::ZipError),
    /// Entry of the zip file that could not be read or written.
    #[error("package entry {entry}: {source}")]
    Entry {
        /// Name of the entry.
        entry: String,
        /// Error in reading or writing the entry.
        source: std::io::Error,
    },
    /// Manifest that is not valid.
    #[error("package manifest.json: {0}")]
    Manifest(#[from] serde_json::Error),
    /// Package of a newer version of the format: that version.
    #[error("the package was written by a newer version of cfs ({FORMAT} {0}; this program reads up to {VERSION})")]
    Newer(u32),
    /// Content of the package that is not valid: description of the problem.
    #[error("package: {0}")]
    Content(String),
}

/// Whether the bytes are a zip file, which all packages are (other archives, too).
pub fn looks_like_package(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06")
}

/// Returns an exchange package as bytes. Equal content always gives equal bytes.
pub fn write(package: &Package) -> Result<Vec<u8>, PackageError> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    // A fixed time in the entries: packages of the same content are the same file.
    let plain = SimpleFileOptions::default().last_modified_time(zip::DateTime::default());
    let version = if package.products.iter().any(|product| !product.license.is_empty()) { VERSION } else { 1 };
    let manifest = Manifest { format: format!("{FORMAT} {version}"), products: package.products.clone() };
    let text = serde_json::to_vec_pretty(&manifest)?;
    let mut put = |entry: String, bytes: &[u8], method| {
        zip.start_file(entry.as_str(), plain.compression_method(method))?;
        zip.write_all(bytes).map_err(|source| PackageError::Entry { entry, source })
    };
    put("manifest.json".to_owned(), &text, CompressionMethod::Deflated)?;
    for (hash, blob) in &package.datasets {
        // Already compressed inside.
        put(format!("datasets/{hash}.bin"), blob, CompressionMethod::Stored)?;
    }
    Ok(zip.finish()?.into_inner())
}

/// First bytes of every package, and of every other zip archive.
pub(crate) const MAGIC: &[u8] = b"PK\x03\x04";

/// Reads an exchange package and checks every dataset against its hash. Entries that no product refers to are not read.
pub fn read(bytes: &[u8]) -> Result<Package, PackageError> {
    if is_web_page(bytes) {
        return Err(PackageError::Content(NotText::WEB_PAGE.to_string()));
    }
    let mut zip = ZipArchive::new(Cursor::new(bytes))?;
    if zip.len() > MOST_ENTRIES {
        return Err(PackageError::Content(format!("{} entries (at most {MOST_ENTRIES})", zip.len())));
    }
    let text = entry(&mut zip, "manifest.json", MOST_MANIFEST)?;
    let Head { format } = serde_json::from_slice(&text)?;
    match format.strip_prefix(FORMAT).and_then(|version| version.trim().parse::<u32>().ok()) {
        Some(1..=VERSION) => {}
        Some(newer) if newer > VERSION => return Err(PackageError::Newer(newer)),
        _ => {
            let word: String = format.chars().take(80).collect();
            let message = format!("format is \"{word}\", this program reads \"{FORMAT} {VERSION}\"");
            return Err(PackageError::Content(message));
        }
    }
    let manifest: Manifest = serde_json::from_slice(&text)?;
    let mut package = Package { products: manifest.products, datasets: BTreeMap::new() };
    let mut left = MOST_TOTAL;
    for product in &package.products {
        if product.states.is_empty() {
            return Err(PackageError::Content(format!("product \"{}\" has no states", product.key)));
        }
        judge(product)?;
        for state in &product.states {
            if package.datasets.contains_key(&state.dataset) {
                continue;
            }
            if state.dataset.len() != 64 || !state.dataset.bytes().all(|b| b.is_ascii_hexdigit()) {
                let text: String = state.dataset.chars().take(80).collect();
                return Err(PackageError::Content(format!("\"{text}\" is not a dataset hash")));
            }
            let blob = entry(&mut zip, &format!("datasets/{}.bin", state.dataset), MOST_DATASET.min(left))?;
            left -= blob.len() as u64;
            if content_hash(&blob) != state.dataset {
                return Err(PackageError::Content(format!("dataset {} was changed: its hash differs", state.dataset)));
            }
            package.datasets.insert(state.dataset.clone(), blob);
        }
    }
    Ok(package)
}

/// Checks that a product is within the limits of the format, before its data are read.
fn judge(product: &PackageProduct) -> Result<(), PackageError> {
    let name: String = product.key.chars().take(80).collect();
    let refuse = |what: String| Err(PackageError::Content(format!("product \"{name}\" has {what}")));
    let (states, tags) = (product.states.len(), product.tags.len());
    if states > limits::STATES {
        return refuse(format!("{states} states (at most {})", limits::STATES));
    }
    if tags > limits::TAGS {
        return refuse(format!("{tags} tags (at most {})", limits::TAGS));
    }
    let mut keys = HashSet::new();
    match product.states.iter().find(|state| !keys.insert(state.key.as_str())) {
        Some(twice) => refuse(format!("two states of the key \"{}\"", twice.key.chars().take(80).collect::<String>())),
        None => Ok(()),
    }
}

/// Reads one entry of the zip file, of at most `most` bytes whatever its header states.
fn entry(zip: &mut ZipArchive<Cursor<&[u8]>>, name: &str, most: u64) -> Result<Vec<u8>, PackageError> {
    let file = zip.by_name(name).map_err(|error| match error {
        zip::result::ZipError::FileNotFound => PackageError::Content(format!("{name} is missing")),
        other => other.into(),
    })?;
    let mut bytes = Vec::new();
    file.take(most + 1)
        .read_to_end(&mut bytes)
        .map_err(|source| PackageError::Entry { entry: name.to_owned(), source })?;
    if bytes.len() as u64 > most {
        return Err(PackageError::Content(format!("{name} is larger than {most} bytes")));
    }
    Ok(bytes)
}
