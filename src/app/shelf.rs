//! What the window asks of a catalogue, and a catalogue that lives in memory alone.

use crate::compute::btdf::{Btdf, Dataset};
use crate::compute::direction::{Dir, Incident};
use crate::compute::lid::Facing;
use crate::study::StudyError;
use crate::study::scene_file::ControlMode;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard};

/// A row of the list.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Product key.
    pub key: String,
    /// Product name.
    pub name: String,
    /// Maker; may be empty.
    pub manufacturer: String,
    /// Kind of system in words, e.g. `venetian blind`; may be empty.
    pub kind: String,
    /// Keys of the states; one empty key for a product without states.
    pub states: Vec<String>,
    /// τ at normal incidence, of the first state.
    pub tau_normal: Option<f64>,
    /// τ under uniform luminance, of the first state.
    pub tau_hemispherical: Option<f64>,
    /// τ from below (−90°) over the normal to above (+90°) in the vertical plane, equal steps; the thumbnail.
    pub profile: Vec<f32>,
    /// Starred by the user.
    pub favourite: bool,
}

/// What is asked for.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Query {
    /// Words that must occur.
    pub text: String,
    /// Kinds that are chosen; empty = all.
    pub kinds: Vec<String>,
    /// Starred ones alone.
    pub favourites: bool,
}

/// What was found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Found {
    /// Rows in order.
    pub entries: Vec<Entry>,
    /// Kinds with the number of products that the words alone would find.
    pub kinds: Vec<(String, usize)>,
    /// Products in the catalogue altogether.
    pub total: usize,
}

/// A product to be stored: its states, and what the user said about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Addition {
    /// Datasets, one a state.
    pub datasets: Vec<Arc<Dataset>>,
    /// Product name.
    pub name: String,
    /// Maker.
    pub manufacturer: String,
    /// Kind of system.
    pub kind: String,
    /// Words to find it by.
    pub tags: Vec<String>,
}

/// A catalogue as the window sees it. Every error is a sentence for the user.
pub trait Shelf: Send + Sync {
    /// Looks products up.
    fn search(&self, query: &Query) -> Result<Found, String>;
    /// The dataset of a state; without a key the first state's.
    fn load(&self, product: &str, state: Option<&str>) -> Result<Arc<Dataset>, String>;
    /// The state that a control picks for a product under the given outside.
    fn controlled_state(&self, product: &str, mode: ControlMode, facing: &Facing<'_>) -> Result<String, StudyError>;
    /// Stores a product; its key.
    fn add(&self, addition: &Addition) -> Result<String, String>;
    /// Takes a product out.
    fn remove(&self, product: &str) -> Result<(), String>;
    /// Sets or takes the star.
    fn set_favourite(&self, product: &str, favourite: bool) -> Result<(), String>;
}

/// τ in the vertical plane at 25 angles from −90° (below) to +90° (above).
pub fn profile(btdf: &Btdf) -> Vec<f32> {
    (0..25)
        .map(|i| {
            let angle = (-84.0 + 7.0 * f64::from(i)).to_radians();
            let phi = if angle < 0.0 { -0.5 } else { 0.5 } * std::f64::consts::PI;
            btdf.tau(Incident(Dir::from_theta_phi(angle.abs(), phi))) as f32
        })
        .collect()
}

struct Product {
    addition: Addition,
    favourite: bool,
}

/// A catalogue in memory: for tests, and when no file can be opened.
#[derive(Default)]
pub struct MemoryShelf {
    products: Mutex<BTreeMap<String, Product>>,
}

impl MemoryShelf {
    /// With the two ideal systems that every comparison starts from.
    pub fn with_ideals() -> Self {
        let shelf = Self::default();
        for (name, kind, btdf) in [
            ("Clear opening", "ideal", Btdf::ideal_transparent(1.0)),
            ("Ideal diffuser", "ideal", Btdf::ideal_diffuse(0.6)),
        ] {
            let mut dataset = Dataset { name: name.to_owned(), ..Dataset::default() };
            dataset.visible.transmission_front = Some(btdf);
            let addition = Addition {
                datasets: vec![Arc::new(dataset)],
                name: name.to_owned(),
                manufacturer: String::new(),
                kind: kind.to_owned(),
                tags: Vec::new(),
            };
            shelf.add(&addition).expect("an empty shelf takes two products of different names");
        }
        shelf
    }

    fn lock(&self) -> MutexGuard<'_, BTreeMap<String, Product>> {
        // A poisoned map is still a whole map: every change to it is one insert or remove.
        self.products.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }
}

/// Lower-case letters and digits with single hyphens.
pub fn slug(name: &str) -> String {
    let mut slug = String::new();
    for c in name.chars().flat_map(char::to_lowercase) {
        if c.is_alphanumeric() {
            slug.push(c);
        } else if !slug.ends_with('-') && !slug.is_empty() {
            slug.push('-');
        }
    }
    slug.trim_end_matches('-').to_owned()
}

fn entry(key: &str, product: &Product) -> Entry {
    let first = product.addition.datasets.first().and_then(|dataset| dataset.transmission());
    Entry {
        key: key.to_owned(),
        name: product.addition.name.clone(),
        manufacturer: product.addition.manufacturer.clone(),
        kind: product.addition.kind.clone(),
        states: product.addition.datasets.iter().map(|dataset| dataset.state.clone()).collect(),
        tau_normal: first.map(Btdf::tau_normal),
        tau_hemispherical: first.map(Btdf::tau_hemispherical),
        profile: first.map_or_else(Vec::new, profile),
        favourite: product.favourite,
    }
}

impl Shelf for MemoryShelf {
    fn search(&self, query: &Query) -> Result<Found, String> {
        let products = self.lock();
        let words: Vec<String> = query.text.split_whitespace().map(str::to_lowercase).collect();
        let matches = |product: &Product| {
            let a = &product.addition;
            let text = format!("{} {} {} {}", a.name, a.manufacturer, a.kind, a.tags.join(" ")).to_lowercase();
            words.iter().all(|word| text.contains(word)) && (!query.favourites || product.favourite)
        };
        let mut found = Found { total: products.len(), ..Found::default() };
        let mut kinds = BTreeMap::new();
        for (key, product) in products.iter().filter(|(_, product)| matches(product)) {
            *kinds.entry(product.addition.kind.clone()).or_insert(0) += 1;
            if query.kinds.is_empty() || query.kinds.contains(&product.addition.kind) {
                found.entries.push(entry(key, product));
            }
        }
        found.kinds = kinds.into_iter().collect();
        Ok(found)
    }

    fn load(&self, product: &str, state: Option<&str>) -> Result<Arc<Dataset>, String> {
        let products = self.lock();
        let datasets = &products
            .get(product)
            .ok_or_else(|| format!("the catalogue has no product \"{product}\": choose one from the list"))?
            .addition
            .datasets;
        let chosen = state.map_or_else(|| datasets.first(), |key| datasets.iter().find(|dataset| dataset.state == key));
        chosen.cloned().ok_or_else(|| {
            let keys: Vec<&str> = datasets.iter().map(|dataset| dataset.state.as_str()).collect();
            format!("{product} has no state \"{}\": its states are {}", state.unwrap_or_default(), keys.join(", "))
        })
    }

    fn controlled_state(&self, product: &str, _mode: ControlMode, _facing: &Facing<'_>) -> Result<String, StudyError> {
        // Nothing in memory moves: the ideal systems have one state.
        let first = self.load(product, None).map_err(StudyError::Catalogue)?;
        Ok(first.state.clone())
    }

    fn add(&self, addition: &Addition) -> Result<String, String> {
        if addition.datasets.is_empty() {
            return Err("there is no dataset to store".to_owned());
        }
        let base = slug(&addition.name);
        if base.is_empty() {
            return Err("the product needs a name with at least one letter or digit".to_owned());
        }
        let mut products = self.lock();
        let key = (1..)
            .map(|n| if n == 1 { base.clone() } else { format!("{base}-{n}") })
            .find(|key| !products.contains_key(key))
            .ok_or_else(|| format!("no free key for \"{base}\""))?;
        products.insert(key.clone(), Product { addition: addition.clone(), favourite: false });
        Ok(key)
    }

    fn remove(&self, product: &str) -> Result<(), String> {
        self.lock().remove(product).map(drop).ok_or_else(|| format!("the catalogue has no product \"{product}\""))
    }

    fn set_favourite(&self, product: &str, favourite: bool) -> Result<(), String> {
        self.lock()
            .get_mut(product)
            .map(|product| product.favourite = favourite)
            .ok_or_else(|| format!("the catalogue has no product \"{product}\""))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_kinds_and_stars_narrow_the_list() {
        let shelf = MemoryShelf::with_ideals();
        let all = shelf.search(&Query::default()).unwrap();
        assert_eq!((all.entries.len(), all.total, all.kinds), (2, 2, vec![("ideal".to_owned(), 2)]));
        let diffuse = shelf.search(&Query { text: "DIFF ideal".into(), ..Query::default() }).unwrap();
        assert_eq!(diffuse.entries.len(), 1);
        assert!((diffuse.entries[0].tau_normal.unwrap() - 0.6).abs() < 1e-12);
        shelf.set_favourite("clear-opening", true).unwrap();
        let starred = shelf.search(&Query { favourites: true, ..Query::default() }).unwrap();
        assert_eq!(starred.entries[0].key, "clear-opening");
        assert!(shelf.load("clear-opening", Some("45")).unwrap_err().contains("no state \"45\""));
    }

    #[test]
    fn equal_names_get_keys_of_their_own() {
        let shelf = MemoryShelf::with_ideals();
        let dataset = shelf.load("clear-opening", None).unwrap();
        let addition = Addition {
            datasets: vec![dataset],
            name: "Clear  opening!".into(),
            manufacturer: String::new(),
            kind: String::new(),
            tags: vec![],
        };
        assert_eq!(shelf.add(&addition).unwrap(), "clear-opening-2");
        shelf.remove("clear-opening-2").unwrap();
        assert_eq!(shelf.search(&Query::default()).unwrap().total, 2);
    }
}
