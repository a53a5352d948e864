//! What was read from files and is not stored yet: proposed products with their states, and what was left out and why.

use super::shelf::Addition;
use crate::catalogue::{Doubt, Grouping, Known, NewProduct, Provenance, SourceFile, StateName, key_of_angle};
use crate::compute::btdf::Dataset;
use crate::compute::doctor::{Diagnosis, Repair, record};
use crate::texts::{Text, take_in as text};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
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
    /// Who measured or computed.
    pub author: String,
    /// On which terms the data may be passed on.
    pub license: String,
}

impl ImportFields {
    /// The tags one by one.
    pub fn tag_list(&self) -> Vec<String> {
        self.tags.split(',').map(|tag| tag.trim().to_owned()).filter(|tag| !tag.is_empty()).collect()
    }
}

/// A state as it is called, as typed.
#[derive(Debug, Clone, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct StateWords {
    /// Angle in degrees; may be empty.
    pub angle: String,
    /// Name; may be empty where there is an angle or no other state.
    pub name: String,
}

impl StateWords {
    /// As a dataset calls its state.
    pub fn of(key: &str) -> Self {
        match key.parse::<f64>() {
            Ok(_) => Self { angle: key.to_owned(), name: String::new() },
            Err(_) => Self { angle: String::new(), name: key.to_owned() },
        }
    }

    /// The angle that was typed, with a comma or a point; `None` where it is none. \[°\]
    pub fn number(&self) -> Option<f64> {
        let text = self.angle.trim().trim_end_matches('°').replace(',', ".").replace('−', "-");
        text.trim().parse().ok().filter(|angle: &f64| angle.is_finite() && angle.abs() <= 360.0)
    }

    /// Key of the state.
    pub fn key(&self) -> String {
        self.number().map_or_else(|| self.name.trim().to_owned(), key_of_angle)
    }
}

/// A product that the files make, before it is stored.
#[derive(Debug, Clone, Default)]
pub struct Proposed {
    /// What stands for its files, in their order; see [`file_id`].
    pub files: Vec<String>,
    /// It comes out of a package, which is whole: its states are not taken apart.
    pub packed: bool,
    /// What was recognised, one a state, with the repairs made.
    pub datasets: Vec<Arc<Dataset>>,
    /// The same as the files hold it.
    pub originals: Vec<Arc<Dataset>>,
    /// What the files hold, whatever it is called, one a state.
    pub contents: Vec<String>,
    /// The file of each; empty where it was joined from several.
    pub sources: Vec<String>,
    /// The files of each state, by their places in [`Proposed::files`].
    pub parts: Vec<Vec<usize>>,
    /// What each state is called.
    pub states: Vec<StateWords>,
    /// Transmittance of each under uniform light, where there is one.
    pub taus: Vec<Option<f64>>,
    /// What the data doctor says about each.
    pub diagnoses: Vec<Vec<Diagnosis>>,
    /// Repairs made, in order; recorded when the product is stored.
    pub repairs: Vec<Repair>,
    /// Repairs that are being made in place of these.
    pub wished: Option<Vec<Repair>>,
    /// Fields for the user to fill in.
    pub fields: ImportFields,
    /// What else the files tell: provenance, description, control curve, key.
    pub told: NewProduct,
    /// What is to be asked before it is stored.
    pub doubt: Option<Doubt>,
    /// A file of this import that holds the same data.
    pub same_as: Option<String>,
    /// Products of the catalogue that hold all of its data.
    pub known: Vec<Known>,
    /// Stored although it is there already?
    pub add_anyway: bool,
}

impl Proposed {
    /// Is it to be stored, as far as the same is not there already?
    pub fn wanted(&self) -> bool {
        self.add_anyway || (self.known.is_empty() && self.same_as.is_none())
    }

    /// Does it have what a product needs?
    pub fn named(&self) -> bool {
        !self.fields.name.trim().is_empty()
    }

    /// Why it cannot be stored as it is, in a sentence.
    pub fn problem(&self) -> Option<String> {
        if let Some(place) = (0..self.datasets.len()).find(|&place| !transmits(&self.datasets[place])) {
            let file = self.sources.get(place).map_or("", String::as_str);
            return Some(text::tells_nothing(file).trim().to_owned());
        }
        if !self.named() {
            return Some(text::NAME_MISSING.into());
        }
        let mut keys = BTreeSet::new();
        for words in &self.states {
            if !words.angle.trim().is_empty() && words.number().is_none() {
                return Some(text::no_angle(words.angle.trim()));
            }
            let key = words.key();
            if key.is_empty() && self.states.len() > 1 {
                return Some(text::NAMELESS_STATE.into());
            }
            if !keys.insert(key.clone()) {
                return Some(text::same_key(key));
            }
        }
        None
    }

    /// Will it be stored when the import is added?
    pub fn ready(&self) -> bool {
        self.wanted() && self.doubt.is_none() && self.wished.is_none() && self.problem().is_none()
    }

    /// What is stored.
    pub fn addition(&self) -> Addition {
        let mut order: Vec<usize> = (0..self.datasets.len()).collect();
        if !self.packed && self.states.iter().all(|words| words.number().is_some()) {
            let angle = |place: &usize| self.states[*place].number().unwrap_or_default();
            order.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
        }
        let named = |place: &usize| {
            let dataset = &self.datasets[*place];
            let key = self.states.get(*place).map_or_else(|| dataset.state.clone(), StateWords::key);
            if dataset.state == key {
                return dataset.clone();
            }
            Arc::new(Dataset { state: key, ..(**dataset).clone() })
        };
        let name = |place: &usize| {
            let words = self.states.get(*place).cloned().unwrap_or_default();
            let told = self.told.states.get(*place).cloned().unwrap_or_default();
            let label = if words.name.trim().is_empty() { told.label } else { words.name.trim().to_owned() };
            StateName { label, value: words.number().or(told.value) }
        };
        let fields = &self.fields;
        let product = NewProduct {
            name: fields.name.trim().to_owned(),
            manufacturer: fields.manufacturer.trim().to_owned(),
            kind: fields.kind.trim().to_owned(),
            tags: fields.tag_list(),
            license: fields.license.trim().to_owned(),
            provenance: Provenance {
                author: fields.author.trim().to_owned(),
                method: record(&self.told.provenance.method, &self.repairs),
                ..self.told.provenance.clone()
            },
            states: order.iter().map(name).collect(),
            contents: order.iter().map(|&place| self.contents.get(place).cloned().unwrap_or_default()).collect(),
            paths: self.paths(&order),
            ..self.told.clone()
        };
        Addition { datasets: order.iter().map(named).collect(), product }
    }
}

impl Proposed {
    /// Paths of the files of the states, in this order of theirs.
    fn paths(&self, order: &[usize]) -> Vec<String> {
        let parts = order.iter().flat_map(|&place| self.parts.get(place).into_iter().flatten());
        parts.filter_map(|&part| self.files.get(part).cloned()).collect()
    }
}

/// Is there what a product needs?
fn transmits(dataset: &Dataset) -> bool {
    dataset.transmission().or(dataset.visible.transmission_back.as_ref()).is_some()
}

/// A number of things in words.
pub fn number(count: usize, one: Text, more: fn(usize) -> String) -> String {
    if count == 1 { one.into() } else { more(count) }
}

/// How the files of an import are taken: what undo goes over.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Arrangement {
    /// How the files are taken as a whole.
    pub grouping: Grouping,
    /// Which files make a product each, where that was changed by hand.
    pub by_hand: Option<Vec<Vec<String>>>,
    /// Files about which the question was answered.
    pub answered: BTreeSet<String>,
}

/// A step from one arrangement of an import to another.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Arranged {
    /// Files and folders of the import.
    pub paths: Vec<PathBuf>,
    /// Before the step.
    pub before: Arrangement,
    /// After it.
    pub after: Arrangement,
}

/// A state in the table: number of the product and of the state, from 0.
pub type Row = (usize, usize);

/// Which files were read and are not stored yet.
#[derive(Debug, Clone, Default)]
pub struct Import {
    /// Files and folders as they were given.
    pub paths: Vec<PathBuf>,
    /// How the files are taken.
    pub grouping: Grouping,
    /// Which files make a product each, where that was changed by hand.
    pub by_hand: Option<Vec<Vec<String>>>,
    /// Files about which the question was answered.
    pub answered: BTreeSet<String>,
    /// The dataset files.
    pub sources: Vec<Arc<SourceFile>>,
    /// What they make.
    pub products: Vec<Proposed>,
    /// Files that could not be read: file, place, what, what would be right.
    pub failures: Vec<String>,
    /// Files that are no datasets: file and reason.
    pub left_out: Vec<String>,
    /// Rows that are selected.
    pub selected: BTreeSet<Row>,
    /// The row that was selected last: what is shown beside the table.
    pub shown: Option<Row>,
    /// Products whose states are folded away.
    pub folded: BTreeSet<usize>,
    /// The products are still those of the arrangement before.
    pub arranging: bool,
}

/// What stands for a file in an import: where it lies and its name.
pub fn file_id(file: &SourceFile) -> String {
    if file.folder.is_empty() {
        file.name.clone()
    } else {
        Path::new(&file.folder).join(&file.name).display().to_string()
    }
}

impl Import {
    /// How its files are taken.
    pub fn arrangement(&self) -> Arrangement {
        Arrangement { grouping: self.grouping, by_hand: self.by_hand.clone(), answered: self.answered.clone() }
    }

    /// Those that are to be stored, as far as the same is not there already.
    pub fn wanted(&self) -> impl Iterator<Item = &Proposed> {
        self.products.iter().filter(|product| product.wanted())
    }

    /// States of all products.
    pub fn states(&self) -> usize {
        self.products.iter().map(|product| product.datasets.len()).sum()
    }

    /// Questions that nobody has answered yet, of products that are to be stored.
    pub fn questions(&self) -> usize {
        self.wanted().filter(|product| product.doubt.is_some()).count()
    }

    /// All rows, from top to bottom.
    pub fn rows(&self) -> impl Iterator<Item = Row> {
        let states =
            |(number, product): (usize, &Proposed)| (0..product.datasets.len()).map(move |state| (number, state));
        self.products.iter().enumerate().flat_map(states)
    }

    /// Products that have a selected state.
    pub fn selected_products(&self) -> Vec<usize> {
        let mut list: Vec<usize> = self.selected.iter().map(|row| row.0).collect();
        list.dedup();
        list
    }

    /// Files of the states that are selected, and which each product then still has; products of packages are whole.
    pub fn files_of_selected(&self) -> Vec<String> {
        let mut files: Vec<String> = Vec::new();
        for &(product, state) in &self.selected {
            let Some(one) = self.products.get(product).filter(|one| !one.packed) else { continue };
            for &part in one.parts.get(state).into_iter().flatten() {
                if let Some(file) = one.files.get(part).filter(|file| !files.contains(*file)) {
                    files.push(file.clone());
                }
            }
        }
        files
    }

    /// What it is called among drafts.
    pub fn name(&self) -> String {
        let first = self.paths.first().map(|path| path.file_name().unwrap_or(path.as_os_str()).to_string_lossy());
        let first = first.unwrap_or_default();
        let products = number(self.products.len(), text::ONE_PRODUCT, text::products);
        match self.paths.len() {
            0 | 1 => text::draft_name(first, products),
            paths => text::draft_of_many(first, paths - 1, products),
        }
    }
}

/// Words and repairs of a product that is being imported.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct KeptProduct {
    /// Hash of the files that it is made of.
    pub source_hash: String,
    /// What stands for its files.
    pub files: Vec<String>,
    /// Words as typed.
    pub fields: ImportFields,
    /// What its states are called.
    pub states: Vec<StateWords>,
    /// Repairs by their names, in order.
    pub repairs: Vec<String>,
    /// Stored although it is there already?
    pub add_anyway: bool,
}

impl KeptProduct {
    /// Of a product as it is now.
    pub fn of(product: &Proposed) -> Self {
        Self {
            source_hash: product.told.provenance.source_hash.clone(),
            files: product.files.clone(),
            fields: product.fields.clone(),
            states: product.states.clone(),
            repairs: product.wished.as_ref().unwrap_or(&product.repairs).iter().map(ToString::to_string).collect(),
            add_anyway: product.add_anyway,
        }
    }

    /// The repairs; a name that no repair has any more is left out.
    pub fn made(&self) -> Vec<Repair> {
        self.repairs.iter().filter_map(|word| word.parse().ok()).collect()
    }

    /// Was this kept of the same files?
    pub fn is_about(&self, product: &Proposed) -> bool {
        if self.files.is_empty() {
            self.source_hash == product.told.provenance.source_hash
        } else {
            self.files == product.files
        }
    }

    fn holds(&self, product: &Proposed) -> bool {
        self.is_about(product)
            && self.fields == product.fields
            && self.states == product.states
            && self.add_anyway == product.add_anyway
            && self.repairs.len() == product.repairs.len()
            && self.made() == product.repairs
    }
}

/// An import that is not stored yet. The files are read again.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct KeptImport {
    /// What it is called among drafts.
    pub name: String,
    /// Files and folders.
    pub paths: Vec<PathBuf>,
    /// How they are taken.
    pub grouping: Grouping,
    /// Which files make a product each, where that was changed by hand.
    pub by_hand: Option<Vec<Vec<String>>>,
    /// Files about which the question was answered.
    pub answered: BTreeSet<String>,
    /// What was typed and tried.
    pub products: Vec<KeptProduct>,
}

impl KeptImport {
    /// Of an import.
    pub fn of(import: &Import) -> Self {
        Self {
            name: import.name(),
            paths: import.paths.clone(),
            grouping: import.grouping,
            by_hand: import.by_hand.clone(),
            answered: import.answered.clone(),
            products: import.products.iter().map(KeptProduct::of).collect(),
        }
    }

    /// Is it what an import holds now?
    pub fn is_of(&self, import: &Import) -> bool {
        self.paths == import.paths
            && self.grouping == import.grouping
            && self.by_hand == import.by_hand
            && self.answered == import.answered
            && self.products.len() == import.products.len()
            && self.products.iter().zip(&import.products).all(|(kept, product)| kept.holds(product))
    }
}
