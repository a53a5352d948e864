//! Products before they are stored: checked, with their figures and the bytes of their datasets.

use super::described::{common_description, view};
use super::product::slug;
use super::{CatalogueError, NewProduct, Product, ProductFinding, State, StateName, check, profile_transmittances};
use crate::compute::btdf::{Btdf, Dataset, DescribedState, Finding, LightFigures};
use crate::compute::limits;
use crate::formats::dataset_blob::{content_hash, decode, encode_with_wordless};
use crate::texts::composed;
use rayon::prelude::*;
use std::collections::HashSet;

/// Product with the bytes of its datasets, ready to be stored in the tables.
#[derive(Debug, Clone)]
pub(super) struct Record {
    pub(super) product: Product,
    /// Hash and bytes of every dataset the product refers to.
    pub(super) datasets: Vec<(String, Vec<u8>)>,
    /// Content hash of every state, see [`super::content_of`]; empty where it is not known.
    pub(super) contents: Vec<String>,
    /// Paths of the files that the product was read from.
    pub(super) paths: Vec<String>,
}

impl Record {
    /// Creates the record of a product whose data are not computed yet.
    pub(super) const fn without_data(product: Product) -> Self {
        Self { product, datasets: Vec::new(), contents: Vec::new(), paths: Vec::new() }
    }
}

/// Checks a product and computes its figures and the bytes of its datasets; nothing is stored yet.
pub(super) fn prepare(datasets: &[Dataset], meta: NewProduct) -> Result<Record, CatalogueError> {
    prepared(datasets, meta, check)
}

/// Prepares a product whose data this program computed, with findings of its own: without the checks of data from other
/// sources.
pub(super) fn prepare_unasked(datasets: &[Dataset], meta: NewProduct) -> Result<Record, CatalogueError> {
    prepared(datasets, meta, |_| Vec::new())
}

/// Checks the product data, and prepares all states in parallel. `ask`: check that returns the findings of a dataset.
fn prepared(
    datasets: &[Dataset],
    meta: NewProduct,
    ask: fn(&Dataset) -> Vec<Finding>,
) -> Result<Record, CatalogueError> {
    let refuse = |what: String| Err(CatalogueError::Import(what));
    let Some(first) = datasets.first() else {
        return refuse("there is no dataset".to_owned());
    };
    // Composed: equal names are to be equal texts, whatever keyboard or file system they come from.
    let or = |specified: String, own: &str| {
        composed(if specified.trim().is_empty() { own.trim() } else { specified.trim() })
    };
    let name = or(meta.name, &first.name);
    if name.is_empty() {
        return refuse("the product has no name, and the dataset does not give one".to_owned());
    }
    if !meta.states.is_empty() && meta.states.len() != datasets.len() {
        return refuse(format!("{} names of states for {} datasets", meta.states.len(), datasets.len()));
    }
    let mut keys = HashSet::new();
    if let Some(twice) = datasets
        .iter()
        .find(|given| !keys.insert(given.state.as_str()) || (datasets.len() > 1 && given.state.is_empty()))
    {
        return refuse(format!("datasets of a family need distinct state keys; \"{}\" is not", twice.state));
    }
    if datasets.len() > limits::STATES || meta.tags.len() > limits::TAGS {
        let (states, tags) = (datasets.len(), meta.tags.len());
        let most = format!("at most {} and {}", limits::STATES, limits::TAGS);
        return refuse(format!("{states} states and {tags} tags ({most})"));
    }
    // Encoding and checking take the time; what they give does not depend on their order. What was read back is gone
    // with its state: only its figures and its bytes are held for all.
    let names = &meta.states;
    let ready: Vec<_> = datasets
        .par_iter()
        .enumerate()
        .map(|(index, given)| ready(given, names.get(index).cloned().unwrap_or_default(), ask))
        .collect();
    let (mut states, mut findings, mut blobs, mut contents) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for one in ready {
        let Ready { state, state_findings, dataset, content } = one?;
        states.push(state);
        findings.extend(state_findings);
        blobs.push(dataset);
        contents.push(content);
    }
    let mut meta = NewProduct {
        name,
        manufacturer: or(meta.manufacturer, &first.manufacturer),
        description: or(meta.description, &first.description),
        // Data that bring their description make a product that keeps it.
        system: if meta.system.is_empty() { common_description(datasets).unwrap_or_default() } else { meta.system },
        ..meta
    };
    let paths = std::mem::take(&mut meta.paths);
    if meta.contents.len() == datasets.len() {
        contents = std::mem::take(&mut meta.contents);
    }
    Ok(Record { product: product(meta, states, findings)?, datasets: blobs, contents, paths })
}

/// Result of preparing one state.
struct Ready {
    state: State,
    state_findings: Vec<ProductFinding>,
    /// Hash of the dataset and its bytes.
    dataset: (String, Vec<u8>),
    content: String,
}

/// Prepares one state: its dataset as bytes, its figures and its findings.
fn ready(given: &Dataset, named: StateName, ask: fn(&Dataset) -> Vec<Finding>) -> Result<Ready, CatalogueError> {
    let Packed { hash, blob, content, dataset } = packed(given)?;
    let own = ask(&dataset);
    let Some(transmission) = dataset.transmission_of_either_side() else {
        return Err(CatalogueError::Import(format!("dataset \"{}\" has no visible transmission", dataset.name)));
    };
    let mut findings = dataset.findings.clone();
    findings.extend(own.into_iter().filter(|finding| !dataset.findings.contains(finding)));
    let findings = findings.into_iter().map(|finding| ProductFinding {
        state: dataset.state.clone(),
        severity: finding.severity,
        code: finding.code.to_owned(),
        message: finding.message,
    });
    let state_findings = findings.collect();
    let state = State {
        dataset: Some(hash.clone()),
        ..figured(named_state(&dataset.state, named), transmission, given.described.as_ref())
    };
    Ok(Ready { state, state_findings, dataset: (hash, blob), content })
}

/// Returns the figures of the transmitted light (share to the ceiling, sun blocked, normal–normal transmittance). The
/// normal–normal transmittance is computed from the description where there is one, because that is more exact than
/// patch-averaged data.
pub fn light(transmission: &Btdf, described: Option<&DescribedState>) -> LightFigures {
    let own = LightFigures::of(transmission);
    LightFigures { view: described.and_then(view).unwrap_or(own.view), ..own }
}

/// Returns a state to which the transmittances and figures of its BTDF are added.
pub(super) fn figured(state: State, transmission: &Btdf, described: Option<&DescribedState>) -> State {
    State {
        tau_normal: Some(transmission.tau_normal()),
        tau_hemispherical: Some(transmission.tau_hemispherical()),
        tau_profile: profile_transmittances(transmission),
        light: Some(light(transmission, described)),
        ..state
    }
}

/// Returns a state of which only key, label and number are known.
pub(super) fn named_state(key: &str, named: StateName) -> State {
    let label = named.label.trim();
    State {
        key: key.to_owned(),
        label: if label.is_empty() { key.to_owned() } else { label.to_owned() },
        // A key that is a number is an angle, as the formats write states.
        value: named.value.or_else(|| key.parse().ok().filter(|value: &f64| value.is_finite())),
        dataset: None,
        tau_normal: None,
        tau_hemispherical: None,
        tau_profile: Vec::new(),
        light: None,
    }
}

/// Creates a product from its product data and its prepared states.
pub(super) fn product(
    meta: NewProduct,
    states: Vec<State>,
    findings: Vec<ProductFinding>,
) -> Result<Product, CatalogueError> {
    let mut tags: Vec<String> = meta.tags.iter().map(|tag| composed(tag.trim())).filter(|t| !t.is_empty()).collect();
    tags.sort();
    tags.dedup();
    let rising = meta.control_curve.windows(2).all(|pair| pair[0].profile_angle < pair[1].profile_angle);
    if !rising || meta.control_curve.iter().any(|point| !(point.profile_angle.is_finite() && point.value.is_finite())) {
        let wrong = "profile angles of the control curve must rise, and all numbers be finite";
        return Err(CatalogueError::Import(wrong.to_owned()));
    }
    Ok(Product {
        key: meta.key.unwrap_or_else(|| slug(&meta.name, &meta.manufacturer)),
        manufacturer: meta.manufacturer,
        description: meta.description,
        name: meta.name,
        kind: composed(meta.kind.trim()),
        provenance: meta.provenance,
        license: meta.license.trim().to_owned(),
        tags,
        states,
        control_curve: meta.control_curve,
        findings,
        system: meta.system,
        favourite: false,
        builtin: false,
    })
}

/// Dataset as bytes, and as it reads from these.
pub(super) struct Packed {
    pub(super) hash: String,
    pub(super) blob: Vec<u8>,
    /// Content hash of the dataset, see [`super::content_of`].
    content: String,
    /// Dataset read back from the bytes, so that all figures are those of the stored data (values rounded to f32).
    pub(super) dataset: Dataset,
}

/// Encodes a dataset as bytes, and reads it back.
///
/// # Errors
/// Returns an error if the dataset exceeds the limits of what is stored.
pub(super) fn packed(given: &Dataset) -> Result<Packed, CatalogueError> {
    let [blob, wordless] = encode_with_wordless(given);
    let (hash, content) = (content_hash(&blob), content_hash(&wordless));
    let dataset = decode(&blob).map_err(|cause| CatalogueError::Dataset { hash: hash.clone(), cause })?;
    Ok(Packed { hash, blob, content, dataset })
}
