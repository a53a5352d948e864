//! The exchange package (`.cfsp`): products of the catalogue in one zip file.
//!
//! `manifest.json` lists the products; `datasets/HASH.bin` holds each dataset in its compact binary form, named by the
//! BLAKE3 hash of its bytes, which is checked on reading.

use super::dataset_blob::content_hash;
use super::encoding::{NotText, is_web_page};
use crate::compute::limits;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, HashSet};
use std::io::{Cursor, Read, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

/// Format word of the manifest, without its version.
const FORMAT: &str = "cfs-package";
/// The newest version that is read. Written is the oldest that can hold what there is: 2 where a product tells its
/// license, else 1.
pub const VERSION: u32 = 2;
/// Largest manifest. \[bytes\]
const MOST_MANIFEST: u64 = limits::MANIFEST_BYTES;
/// Largest dataset. \[bytes\]
const MOST_DATASET: u64 = limits::ENTRY_BYTES;
/// Most bytes of all datasets together.
const MOST_TOTAL: u64 = limits::PACKAGE_BYTES;
/// Most entries of the zip file.
const MOST_ENTRIES: usize = limits::ARCHIVE_ENTRIES;

/// What a package holds.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Package {
    /// The products.
    pub products: Vec<PackageProduct>,
    /// Binary datasets by their hash.
    pub datasets: BTreeMap<String, Vec<u8>>,
}

/// The word alone: a newer manifest may have any keys beside it.
#[derive(Deserialize)]
struct Head {
    format: String,
}

#[derive(Serialize, Deserialize)]
struct Manifest {
    format: String,
    products: Vec<PackageProduct>,
}

/// A product as the manifest gives it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PackageProduct {
    /// Key in the catalogue it came from.
    pub key: String,
    /// Name.
    pub name: String,
    /// Maker; may be empty.
    #[serde(default)]
    pub manufacturer: String,
    /// Kind, e.g. `venetian`.
    #[serde(default)]
    pub kind: String,
    /// Free text.
    #[serde(default)]
    pub description: String,
    /// Where the data come from.
    #[serde(default)]
    pub provenance: PackageProvenance,
    /// On which terms the data may be passed on; may be empty.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub license: String,
    /// Words to find it by.
    #[serde(default)]
    pub tags: Vec<String>,
    /// States in order, at least one.
    pub states: Vec<PackageState>,
    /// Points of the control curve.
    #[serde(default)]
    pub control_curve: Vec<PackageCurvePoint>,
    /// Text of the description that it was computed from; empty for others.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub system: String,
}

/// Provenance in the manifest.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PackageProvenance {
    /// `measured`, `computed` or `unknown`.
    pub origin: String,
    /// By whom.
    pub author: String,
    /// How.
    pub method: String,
    /// When, as the source gives it.
    pub date: String,
    /// Name of the file it was read from.
    pub source_file: String,
    /// BLAKE3 hash of that file.
    pub source_hash: String,
    /// Which face looks into the room.
    pub inside_face: String,
}

/// A state in the manifest.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PackageState {
    /// Key; empty for the only state of a system without states.
    pub key: String,
    /// Text for people.
    #[serde(default)]
    pub label: String,
    /// Angle or other number of the state.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// Hash of its dataset.
    pub dataset: String,
}

/// A point of a control curve in the manifest.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PackageCurvePoint {
    /// Profile angle of the sun. \[°\]
    pub profile_angle: f64,
    /// Number of the state, e.g. the slat angle. \[°\]
    pub value: f64,
}

/// Why bytes are no package.
#[derive(Debug, thiserror::Error)]
pub enum PackageError {
    /// Not a zip file, or damaged.
    #[error("not a readable package: {0}")]
    Zip(#[from] zip::result::ZipError),
    /// Reading or writing an entry failed.
    #[error("package entry {entry}: {source}")]
    Entry {
        /// Name of the entry.
        entry: String,
        /// What happened.
        source: std::io::Error,
    },
    /// The manifest is not what it should be.
    #[error("package manifest.json: {0}")]
    Manifest(#[from] serde_json::Error),
    /// Written by a newer program.
    #[error("the package was written by a newer version of cfs ({FORMAT} {0}; this program reads up to {VERSION})")]
    Newer(u32),
    /// Something that must not be.
    #[error("package: {0}")]
    Content(String),
}

/// Is this a zip file, as packages are?
pub fn looks_like_package(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06")
}

/// Bytes of a package. The same content always gives the same bytes.
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

/// First bytes of every package, as of every zip archive.
pub(crate) const MAGIC: &[u8] = b"PK\x03\x04";

/// Reads a package and checks every dataset against its hash. Entries nothing refers to are not read.
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
            let told = format!("format is \"{word}\", this program reads \"{FORMAT} {VERSION}\"");
            return Err(PackageError::Content(told));
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
                return Err(PackageError::Content(format!("\"{text}\" is no dataset hash")));
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

/// Budgets of a product, before any of its data are touched.
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

/// One entry, never more than `most` bytes of it whatever its header says.
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
