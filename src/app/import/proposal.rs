//! Import: files that were read but are not stored yet, the products proposed from them, and files that were left out
//! with the reasons.

use crate::app::catalogue::shelf::Addition;
use crate::catalogue::{Ambiguity, Grouping, Known, NewProduct, Provenance, SourceFile, StateName, key_of_angle};
use crate::compute::btdf::Dataset;
use crate::compute::doctor::{Diagnosis, Repair, record};
use crate::texts::{Text, import as text};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Descriptive texts of a product in the import sheet, as the user has typed them.
#[derive(Debug, Clone, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct ImportFields {
    /// Name of the product.
    pub name: String,
    /// Name of the maker.
    pub manufacturer: String,
    /// Kind of system.
    pub kind: String,
    /// Tags by which the product is found, separated by commas.
    pub tags: String,
    /// Person or body that measured or computed the data.
    pub author: String,
    /// Licence of the data.
    pub license: String,
}

impl ImportFields {
    /// Returns the tags as a list.
    pub fn tag_list(&self) -> Vec<String> {
        self.tags.split(',').map(|tag| tag.trim().to_owned()).filter(|tag| !tag.is_empty()).collect()
    }
}

/// Name and angle of a state, as the user has typed them.
#[derive(Debug, Clone, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct StateWords {
    /// Angle in degrees, as typed; may be empty.
    pub angle: String,
    /// Name of the state; may be empty if it has an angle, or if there is no other state.
    pub name: String,
}

impl StateWords {
    /// Creates the texts from the key of a state.
    pub fn of(key: &str) -> Self {
        match key.parse::<f64>() {
            Ok(_) => Self { angle: key.to_owned(), name: String::new() },
            Err(_) => Self { angle: String::new(), name: key.to_owned() },
        }
    }

    /// Returns the typed angle, which may have a decimal comma or point; `None` if it is not a valid angle. \[°\]
    pub fn number(&self) -> Option<f64> {
        let text = self.angle.trim().trim_end_matches('°').replace(',', ".").replace('−', "-");
        text.trim().parse().ok().filter(|angle: &f64| angle.is_finite() && angle.abs() <= 360.0)
    }

    /// Returns the key of the state that results from angle and name.
    pub fn key(&self) -> String {
        self.number().map_or_else(|| self.name.trim().to_owned(), key_of_angle)
    }
}

/// Product that an import proposes from files, before it is stored in the catalogue.
#[derive(Debug, Clone, Default)]
pub struct Proposed {
    /// Identifiers of its files (folder and name), in their order.
    pub files: Vec<String>,
    /// Whether the product comes from a package, whose states are not regrouped.
    pub packed: bool,
    /// Datasets, one per state, with the repairs applied.
    pub datasets: Vec<Arc<Dataset>>,
    /// Datasets as read from the files, one per state, without repairs.
    pub originals: Vec<Arc<Dataset>>,
    /// Content hashes of the original datasets, one per state, independent of names.
    pub contents: Vec<String>,
    /// Name of the file of each state; empty if the state was joined from several files.
    pub sources: Vec<String>,
    /// Files of each state, by their indices in [`Proposed::files`].
    pub parts: Vec<Vec<usize>>,
    /// Names and angles of the states, as typed.
    pub states: Vec<StateWords>,
    /// Hemispherical visible transmittance of each state; `None` without a transmission.
    pub taus: Vec<Option<f64>>,
    /// Findings of the data check, one list per state.
    pub diagnoses: Vec<Vec<Diagnosis>>,
    /// Repairs that are applied to all states, in their order; recorded when the product is stored.
    pub repairs: Vec<Repair>,
    /// Requested repairs that are being applied instead of [`Proposed::repairs`], if any.
    pub requested_repairs: Option<Vec<Repair>>,
    /// Descriptive texts that the user can complete.
    pub fields: ImportFields,
    /// Other information from the files: provenance, description, control curve, key.
    pub file_info: NewProduct,
    /// Ambiguity about the product's files that the user has to resolve before the product is stored.
    pub ambiguity: Option<Ambiguity>,
    /// Name of another file of this import with the same data, if there is one.
    pub same_as: Option<String>,
    /// Products of the catalogue that contain all data of this product already.
    pub known: Vec<Known>,
    /// Whether the product is stored even if its data are in the catalogue already.
    pub add_anyway: bool,
}

impl Proposed {
    /// Whether the product is to be stored: its data are new, or it is added anyway.
    pub fn wanted(&self) -> bool {
        self.add_anyway || (self.known.is_empty() && self.same_as.is_none())
    }

    /// Whether the product has a name.
    pub fn named(&self) -> bool {
        !self.fields.name.trim().is_empty()
    }

    /// Returns the reason why the product cannot be stored yet, as a sentence; `None` if it can.
    pub fn problem(&self) -> Option<String> {
        if let Some(place) =
            (0..self.datasets.len()).find(|&place| self.datasets[place].transmission_of_either_side().is_none())
        {
            let file = self.sources.get(place).map_or("", String::as_str);
            return Some(text::no_transmission(file).trim().to_owned());
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

    /// Whether the product is stored when the import is added: it is to be stored, and nothing is missing.
    pub fn ready(&self) -> bool {
        self.wanted() && self.ambiguity.is_none() && self.requested_repairs.is_none() && self.problem().is_none()
    }

    /// Returns the product and its datasets for storing in the catalogue.
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
            let reported = self.file_info.states.get(*place).cloned().unwrap_or_default();
            let label = if words.name.trim().is_empty() { reported.label } else { words.name.trim().to_owned() };
            StateName { label, value: words.number().or(reported.value) }
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
                method: record(&self.file_info.provenance.method, &self.repairs),
                ..self.file_info.provenance.clone()
            },
            states: order.iter().map(name).collect(),
            contents: order.iter().map(|&place| self.contents.get(place).cloned().unwrap_or_default()).collect(),
            paths: self.paths(&order),
            ..self.file_info.clone()
        };
        Addition { datasets: order.iter().map(named).collect(), product }
    }
}

impl Proposed {
    /// Returns the paths of the files of the states, for the given order of the states.
    fn paths(&self, order: &[usize]) -> Vec<String> {
        let parts = order.iter().flat_map(|&place| self.parts.get(place).into_iter().flatten());
        parts.filter_map(|&part| self.files.get(part).cloned()).collect()
    }
}

/// Returns a count with its noun as text, in the singular (`one`) or plural (`more`).
pub fn number(count: usize, one: Text, more: fn(usize) -> String) -> String {
    if count == 1 { one.into() } else { more(count) }
}

/// Arrangement of an import's files into products, covered by undo.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Arrangement {
    /// Grouping of the files into products.
    pub grouping: Grouping,
    /// Identifiers of the files of each product, if the user has changed the grouping; else `None`.
    pub by_hand: Option<Vec<Vec<String>>>,
    /// Identifiers of the files whose ambiguity the user has resolved.
    pub answered: BTreeSet<String>,
}

/// Undoable step from one arrangement of an import's files to another.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Arranged {
    /// Files and folders of the import.
    pub paths: Vec<PathBuf>,
    /// Arrangement before the step.
    pub before: Arrangement,
    /// Arrangement after the step.
    pub after: Arrangement,
}

/// Row of the import table: index of the product and of its state.
pub type Row = (usize, usize);

/// Import: files that were read and are not stored yet.
#[derive(Debug, Clone, Default)]
pub struct Import {
    /// Files and folders that were opened for the import.
    pub paths: Vec<PathBuf>,
    /// Grouping of the files into products.
    pub grouping: Grouping,
    /// Identifiers of the files of each product, if the user has changed the grouping; else `None`.
    pub by_hand: Option<Vec<Vec<String>>>,
    /// Identifiers of the files whose ambiguity the user has resolved.
    pub answered: BTreeSet<String>,
    /// Dataset files.
    pub sources: Vec<Arc<SourceFile>>,
    /// Products proposed from the files.
    pub products: Vec<Proposed>,
    /// Errors of files that could not be read, as text: file, position, what was found, what was expected.
    pub failures: Vec<String>,
    /// Files that are not datasets, as text: file and reason.
    pub left_out: Vec<String>,
    /// Selected rows of the table.
    pub selected: BTreeSet<Row>,
    /// Row that was selected last; its details are shown beside the table.
    pub shown: Option<Row>,
    /// Indices of the products whose states are collapsed in the table.
    pub folded: BTreeSet<usize>,
    /// Whether a new arrangement is being computed, while the products are still those of the previous one.
    pub arranging: bool,
}

/// Returns the identifier of a file in an import: its folder and name.
pub fn file_id(file: &SourceFile) -> String {
    if file.folder.is_empty() {
        file.name.clone()
    } else {
        Path::new(&file.folder).join(&file.name).display().to_string()
    }
}

impl Import {
    /// Returns the arrangement of the files.
    pub fn arrangement(&self) -> Arrangement {
        Arrangement { grouping: self.grouping, by_hand: self.by_hand.clone(), answered: self.answered.clone() }
    }

    /// Returns the products that are to be stored.
    pub fn wanted(&self) -> impl Iterator<Item = &Proposed> {
        self.products.iter().filter(|product| product.wanted())
    }

    /// Returns the number of states of all products.
    pub fn states(&self) -> usize {
        self.products.iter().map(|product| product.datasets.len()).sum()
    }

    /// Returns the number of unresolved ambiguities of products that are to be stored.
    pub fn questions(&self) -> usize {
        self.wanted().filter(|product| product.ambiguity.is_some()).count()
    }

    /// Returns all rows, from top to bottom.
    pub fn rows(&self) -> impl Iterator<Item = Row> {
        let states =
            |(number, product): (usize, &Proposed)| (0..product.datasets.len()).map(move |state| (number, state));
        self.products.iter().enumerate().flat_map(states)
    }

    /// Returns the indices of the products that have a selected state.
    pub fn selected_products(&self) -> Vec<usize> {
        let mut list: Vec<usize> = self.selected.iter().map(|row| row.0).collect();
        list.dedup();
        list
    }

    /// Returns the identifiers of the files of the selected states, without those of products from packages.
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

    /// Returns the name of the import in the list of drafts.
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

/// Texts and repairs of an imported product, as stored in a session.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct KeptProduct {
    /// Hash of the files of the product.
    pub source_hash: String,
    /// Identifiers of the product's files.
    pub files: Vec<String>,
    /// Texts as typed.
    pub fields: ImportFields,
    /// Names and angles of the product's states.
    pub states: Vec<StateWords>,
    /// Repairs in their text form, in their order.
    pub repairs: Vec<String>,
    /// Whether the product is stored even if its data are in the catalogue already.
    pub add_anyway: bool,
}

impl KeptProduct {
    /// Creates the stored entry of a product in its current state.
    pub fn of(product: &Proposed) -> Self {
        Self {
            source_hash: product.file_info.provenance.source_hash.clone(),
            files: product.files.clone(),
            fields: product.fields.clone(),
            states: product.states.clone(),
            repairs: product
                .requested_repairs
                .as_ref()
                .unwrap_or(&product.repairs)
                .iter()
                .map(ToString::to_string)
                .collect(),
            add_anyway: product.add_anyway,
        }
    }

    /// Returns the repairs; unknown names are left out.
    pub fn made(&self) -> Vec<Repair> {
        self.repairs.iter().filter_map(|word| word.parse().ok()).collect()
    }

    /// Whether the entry was stored for the same files as those of `product`.
    pub fn is_about(&self, product: &Proposed) -> bool {
        if self.files.is_empty() {
            self.source_hash == product.file_info.provenance.source_hash
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

/// Import that is not in the catalogue yet, as stored in a session; its files are read again when it is restored.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct KeptImport {
    /// Name in the list of drafts.
    pub name: String,
    /// Files and folders of the import.
    pub paths: Vec<PathBuf>,
    /// Grouping of the files into products.
    pub grouping: Grouping,
    /// Identifiers of the files of each product, if the user has changed the grouping; else `None`.
    pub by_hand: Option<Vec<Vec<String>>>,
    /// Identifiers of the files whose ambiguity the user has resolved.
    pub answered: BTreeSet<String>,
    /// Texts and repairs of the import's products.
    pub products: Vec<KeptProduct>,
}

impl KeptImport {
    /// Creates the stored entry of an import.
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

    /// Whether the entry equals the current content of an import.
    pub fn is_of(&self, import: &Import) -> bool {
        self.paths == import.paths
            && self.grouping == import.grouping
            && self.by_hand == import.by_hand
            && self.answered == import.answered
            && self.products.len() == import.products.len()
            && self.products.iter().zip(&import.products).all(|(kept, product)| kept.holds(product))
    }
}
