//! Products from dataset files: which files are states of one product, and the product data that the files contain.

use super::ambiguity::Ambiguity;
use super::grouping::{Grouping, propose};
use super::source_file::SourceFile;
use super::{NewProduct, Origin, Provenance};
use crate::compute::btdf::Dataset;
use crate::formats::{CatalogueFields, Format, merge_sides};

/// Product as its dataset files describe it, before it is imported.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Gathered {
    /// Name, maker, kind, tags and provenance as far as the files specify them. The name may be empty.
    pub meta: NewProduct,
    /// Datasets, one per state.
    pub datasets: Vec<Dataset>,
    /// Name of the file from which each dataset was read; empty where it was joined from several files.
    pub sources: Vec<String>,
    /// Files of each dataset, as indices into the list of the product's files.
    pub parts: Vec<Vec<usize>>,
    /// Name of the first file without its extension, for products without a name.
    pub file_stem: String,
    /// Question that the user has to answer before the product is stored, if any.
    pub ambiguity: Option<Ambiguity>,
}

/// Groups files into products according to the rule `grouping`. States are named by the angles in the file names where
/// there are any; else, where there are several, by their file names.
pub fn gather(files: Vec<SourceFile>, grouping: Grouping) -> Vec<Gathered> {
    let files: Vec<&SourceFile> = files.iter().collect();
    let product = |one: super::Proposal| {
        let own: Vec<&SourceFile> = one.files.iter().map(|&place| files[place]).collect();
        Gathered { ambiguity: one.ambiguity, ..gathered(&own, one.angles.as_deref()) }
    };
    propose(&files, grouping).into_iter().map(product).collect()
}

/// Returns the key of a state for its angle \[°\], without needless digits, such as "45".
pub fn key_of_angle(angle: f64) -> String {
    // −0 is 0.
    format!("{}", angle + 0.0)
}

/// Joins all files into one product. `angles`: slat angle (or other angle) of every file, where they are known. \[°\]
pub fn gathered(files: &[&SourceFile], angles: Option<&[f64]>) -> Gathered {
    let stems: Vec<String> = files.iter().map(|file| Format::stem(&file.name).to_owned()).collect();
    let meta = NewProduct { name: name(files, &stems), ..meta(files) };
    let named = |parts: &[Vec<usize>]| -> Vec<String> {
        let name =
            |part: &Vec<usize>| if let [one] = part.as_slice() { files[*one].name.clone() } else { String::new() };
        parts.iter().map(name).collect()
    };
    let file_stem = stems.first().cloned().unwrap_or_default();
    if let Some(angles) = angles {
        let mut datasets: Vec<Dataset> = files.iter().flat_map(|file| file.datasets.clone()).collect();
        for (dataset, angle) in datasets.iter_mut().zip(angles) {
            dataset.state = key_of_angle(*angle);
        }
        let parts: Vec<Vec<usize>> = (0..datasets.len()).map(|place| vec![place]).collect();
        return Gathered { sources: named(&parts), parts, meta, datasets, file_stem, ambiguity: None };
    }
    let mut datasets = merge_sides(files.iter().flat_map(|file| file.datasets.clone()).collect());
    let parts: Vec<Vec<usize>> = datasets
        .iter()
        .map(|whole| {
            (0..files.len()).filter(|&place| files[place].datasets.iter().any(|one| holds(whole, one))).collect()
        })
        .collect();
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
    Gathered { sources: named(&parts), parts, meta, datasets, file_stem, ambiguity: None }
}

/// Returns a text field of a dataset; empty if it is unchanged from the template of the file format.
fn specified_text(text: &str, template: &str) -> String {
    let text = text.trim();
    if text == template { String::new() } else { text.to_owned() }
}

/// Returns the name of a product from its files: the name that all datasets have; else, where datasets are named after
/// their states, the common beginning of their names, of the file names (`stems`), or the name of the folder.
fn name(files: &[&SourceFile], stems: &[String]) -> String {
    let names: Vec<String> =
        files.iter().flat_map(|file| &file.datasets).map(|dataset| specified_text(&dataset.name, "Name")).collect();
    let first = names.first().cloned().unwrap_or_default();
    if names.iter().all(|name| *name == first) {
        return first;
    }
    let begin = |texts: &[String]| {
        let mut common: Vec<char> = texts.first().map(|text| text.chars().collect()).unwrap_or_default();
        for text in texts {
            let same = common.iter().zip(text.chars()).take_while(|(a, b)| **a == *b).count();
            common.truncate(same);
        }
        let common: String = common.into_iter().collect();
        common.trim_end_matches(|c: char| c.is_ascii_digit() || "_-. ,(".contains(c)).to_owned()
    };
    let folder = files.first().map(|file| file.folder.clone()).unwrap_or_default();
    let folder = folder.rsplit(['/', '\\']).next().unwrap_or_default().to_owned();
    // One or two letters name nothing.
    [begin(&names), begin(stems), folder].into_iter().find(|text| text.chars().count() > 2).unwrap_or(first)
}

/// Whether a joined dataset contains all BSDF data of the dataset `part`, which was read from one file.
fn holds(dataset: &Dataset, part: &Dataset) -> bool {
    dataset.state == part.state
        && dataset.name == part.name
        && part.visible.components().into_iter().all(|c| dataset.visible.get(c) == part.visible.get(c))
}

/// Returns the product data that files specify, each field from the first file that has it.
fn meta(files: &[&SourceFile]) -> NewProduct {
    let first = |field: fn(&CatalogueFields) -> &str| {
        files.iter().map(|file| field(&file.fields)).find(|text| !text.trim().is_empty()).unwrap_or_default().to_owned()
    };
    let dataset = files.iter().flat_map(|file| &file.datasets).next();
    NewProduct {
        manufacturer: dataset.map(|dataset| specified_text(&dataset.manufacturer, "Manufacturer")).unwrap_or_default(),
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
