//! From dataset files to products: which files belong together, what they say about themselves.

use super::{NewProduct, Origin, Provenance};
use crate::compute::btdf::Dataset;
use crate::formats::{CatalogueFields, Format, FormatError, is_one_function, merge_sides};
use crate::formats::{catalogue_fields, read_dataset};

/// A dataset file that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct SourceFile {
    /// Its name, without folder.
    pub name: String,
    /// BLAKE3 hash of its bytes, 64 hexadecimal digits.
    pub hash: String,
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
        Ok(Self {
            name: name.to_owned(),
            hash: blake3::hash(bytes).to_hex().to_string(),
            datasets: read_dataset(name, bytes)?,
            fields: catalogue_fields(name, bytes)?,
        })
    }
}

/// A product as files tell it: what to import, state by state.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Gathered {
    /// Name, maker, kind, tags and provenance as far as told. The name may be empty.
    pub meta: NewProduct,
    /// One a state.
    pub datasets: Vec<Dataset>,
    /// The first file's name without its extension, for products without a name.
    pub file_stem: String,
}

/// Files as products. Files of formats that name a family themselves (one function of one state each) make a product a
/// name, with the functions of one state joined; all other files given together are the states of one product. States
/// without a key are named after their files where there are several. `together`: all are one product, whatever their
/// names.
pub fn gather(files: Vec<SourceFile>, together: bool) -> Vec<Gathered> {
    let named = |file: &SourceFile| {
        let own = file.datasets.iter().all(|dataset| is_one_function(dataset) && !dataset.name.is_empty());
        own.then(|| file.datasets.first().map(|dataset| dataset.name.clone())).flatten()
    };
    let apart = !together && files.iter().all(|file| named(file).is_some());
    let mut groups: Vec<(Option<String>, Vec<SourceFile>)> = Vec::new();
    for file in files {
        let name = if apart { named(&file) } else { None };
        match groups.iter_mut().find(|(other, _)| *other == name) {
            Some((_, group)) => group.push(file),
            None => groups.push((name, vec![file])),
        }
    }
    groups.into_iter().map(|(_, group)| product(group)).collect()
}

fn product(files: Vec<SourceFile>) -> Gathered {
    let meta = meta(&files);
    let stems: Vec<String> = files.iter().map(|file| Format::stem(&file.name).to_owned()).collect();
    let mut datasets = merge_sides(files.iter().flat_map(|file| file.datasets.clone()).collect());
    if datasets.len() > 1 {
        // A file of several states names them itself; one of a single nameless state gives it the file's name.
        for (file, stem) in files.iter().zip(&stems) {
            let [only] = file.datasets.as_slice() else { continue };
            if only.state.is_empty()
                && let Some(dataset) = datasets.iter_mut().find(|dataset| holds(dataset, only))
            {
                dataset.state.clone_from(stem);
            }
        }
    }
    Gathered { meta, datasets, file_stem: stems.into_iter().next().unwrap_or_default() }
}

/// Is `part` this dataset, or one of the functions that it was joined from?
fn holds(dataset: &Dataset, part: &Dataset) -> bool {
    dataset.state.is_empty()
        && dataset.name == part.name
        && part.visible.components().into_iter().all(|c| dataset.visible.get(c) == part.visible.get(c))
}

fn meta(files: &[SourceFile]) -> NewProduct {
    let first = |field: fn(&CatalogueFields) -> &str| {
        files.iter().map(|file| field(&file.fields)).find(|text| !text.trim().is_empty()).unwrap_or_default().to_owned()
    };
    let dataset = files.iter().flat_map(|file| &file.datasets).next();
    NewProduct {
        name: dataset.map(|dataset| dataset.name.clone()).unwrap_or_default(),
        manufacturer: dataset.map(|dataset| dataset.manufacturer.clone()).unwrap_or_default(),
        kind: first(|fields| &fields.kind),
        tags: files.iter().flat_map(|file| file.fields.tags.clone()).collect(),
        provenance: Provenance {
            origin: Origin::from_word(&first(|fields| &fields.origin)),
            author: first(|fields| &fields.author),
            method: first(|fields| &fields.method),
            date: first(|fields| &fields.date),
            inside_face: first(|fields| &fields.inside_face),
            source_file: files.iter().map(|file| file.name.as_str()).collect::<Vec<_>>().join(", "),
            // Of several files the hash of their hashes, which changes with each.
            source_hash: match files {
                [one] => one.hash.clone(),
                several => {
                    let all: Vec<&str> = several.iter().map(|file| file.hash.as_str()).collect();
                    blake3::hash(all.join("\n").as_bytes()).to_hex().to_string()
                }
            },
        },
        ..NewProduct::default()
    }
}
