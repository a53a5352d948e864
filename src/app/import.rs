//! What was read from files and is not stored yet: proposed products with their states, and what was left out and why.

use crate::catalogue::{Grouping, Known, NewProduct, Provenance};
use crate::compute::btdf::Dataset;
use crate::compute::doctor::{Diagnosis, Repair, record};
use std::path::PathBuf;
use std::sync::Arc;

/// Words about a product, as typed.
#[derive(Debug, Clone, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct ImportFields {
    /// Product name.
    pub name: String,
    /// Maker.
    pub manufacturer: String,
    /// Kind of system.
    pub kind: String,
    /// Words to find it by, separated by commas.
    pub tags: String,
}

impl ImportFields {
    /// The tags one by one.
    pub fn tag_list(&self) -> Vec<String> {
        self.tags.split(',').map(|tag| tag.trim().to_owned()).filter(|tag| !tag.is_empty()).collect()
    }
}

/// A product that the files make, before it is stored.
#[derive(Debug, Clone, Default)]
pub struct Proposed {
    /// What was recognised, one a state, with the repairs made.
    pub datasets: Vec<Arc<Dataset>>,
    /// The same as the files hold it.
    pub originals: Vec<Arc<Dataset>>,
    /// The file of each; empty where it was joined from several.
    pub sources: Vec<String>,
    /// What the data doctor says about each.
    pub diagnoses: Vec<Vec<Diagnosis>>,
    /// Repairs made, in order; recorded when the product is stored.
    pub repairs: Vec<Repair>,
    /// Fields for the user to fill in.
    pub fields: ImportFields,
    /// Where the data come from, as the files tell.
    pub provenance: Provenance,
    /// Products of the catalogue that were read from the same files.
    pub known: Vec<Known>,
    /// Stored although it is there already?
    pub add_anyway: bool,
}

impl Proposed {
    /// Is it to be stored?
    pub fn wanted(&self) -> bool {
        self.known.is_empty() || self.add_anyway
    }

    /// Does it have what a product needs?
    pub fn named(&self) -> bool {
        !self.fields.name.trim().is_empty()
    }

    /// What is stored with the datasets.
    pub fn product(&self) -> NewProduct {
        NewProduct {
            name: self.fields.name.trim().to_owned(),
            manufacturer: self.fields.manufacturer.trim().to_owned(),
            kind: self.fields.kind.trim().to_owned(),
            tags: self.fields.tag_list(),
            provenance: Provenance {
                method: record(&self.provenance.method, &self.repairs),
                ..self.provenance.clone()
            },
            ..NewProduct::default()
        }
    }
}

/// Which files were read and are not stored yet.
#[derive(Debug, Clone, Default)]
pub struct Import {
    /// Files and folders as they were given.
    pub paths: Vec<PathBuf>,
    /// How the files are taken.
    pub grouping: Grouping,
    /// What they make.
    pub products: Vec<Proposed>,
    /// Files that could not be read: file, place, what, what would be right.
    pub failures: Vec<String>,
    /// Files that are no datasets: file and reason.
    pub left_out: Vec<String>,
}

impl Import {
    /// Those that are to be stored.
    pub fn wanted(&self) -> impl Iterator<Item = &Proposed> {
        self.products.iter().filter(|product| product.wanted())
    }

    /// States of all products.
    pub fn states(&self) -> usize {
        self.products.iter().map(|product| product.datasets.len()).sum()
    }
}

/// Words and repairs of a product that is being imported.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct KeptProduct {
    /// Hash of the files that it is made of.
    pub source_hash: String,
    /// Words as typed.
    pub fields: ImportFields,
    /// Repairs by their names, in order.
    pub repairs: Vec<String>,
    /// Stored although it is there already?
    pub add_anyway: bool,
}

impl KeptProduct {
    /// The repairs; a name that no repair has any more is left out.
    pub fn made(&self) -> Vec<Repair> {
        self.repairs.iter().filter_map(|word| word.parse().ok()).collect()
    }
}

/// An import that is not stored yet. The files are read again.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, serde::Deserialize)]
pub struct KeptImport {
    /// Files and folders.
    pub paths: Vec<PathBuf>,
    /// How they are taken.
    pub grouping: Grouping,
    /// What was typed and tried.
    pub products: Vec<KeptProduct>,
}

impl KeptImport {
    /// Of an import.
    pub fn of(import: &Import) -> Self {
        let product = |product: &Proposed| KeptProduct {
            source_hash: product.provenance.source_hash.clone(),
            fields: product.fields.clone(),
            repairs: product.repairs.iter().map(ToString::to_string).collect(),
            add_anyway: product.add_anyway,
        };
        Self {
            paths: import.paths.clone(),
            grouping: import.grouping,
            products: import.products.iter().map(product).collect(),
        }
    }

    /// Is it what an import holds now?
    pub fn is_of(&self, import: &Import) -> bool {
        self.paths == import.paths
            && self.grouping == import.grouping
            && self.products.len() == import.products.len()
            && self.products.iter().zip(&import.products).all(|(kept, product)| {
                kept.source_hash == product.provenance.source_hash
                    && kept.fields == product.fields
                    && kept.add_anyway == product.add_anyway
                    && kept.repairs.len() == product.repairs.len()
                    && kept.made() == product.repairs
            })
    }
}
