//! Comparison and merging of packages, without a catalogue.

use super::CatalogueError;
use crate::compute::btdf::Btdf;
use crate::compute::direction::{Dir, Incident};
use crate::formats::dataset_blob::decode;
use crate::formats::package::{Package, PackageProduct, PackageState};
use std::collections::{BTreeMap, BTreeSet};

/// Differences between two packages of products. All lists are empty if both have the same content.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PackageDiff {
    /// Keys of the products that only the first package contains.
    pub only_first: Vec<String>,
    /// Keys of the products that only the second package contains.
    pub only_second: Vec<String>,
    /// Products that both packages contain with different content.
    pub changed: Vec<ProductDiff>,
}

/// Differences of a product between two packages.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ProductDiff {
    /// Key of the product.
    pub key: String,
    /// Fields of the product, other than its states, that differ: name of the field, value in the first package, value
    /// in the second.
    pub fields: Vec<(String, String, String)>,
    /// Keys of the states that only the first package contains.
    pub only_first: Vec<String>,
    /// Keys of the states that only the second package contains.
    pub only_second: Vec<String>,
    /// States that both packages contain with different data.
    pub states: Vec<StateDiff>,
}

/// Differences between the datasets of one state in two packages.
#[derive(Debug, Clone, PartialEq)]
pub struct StateDiff {
    /// Key of the state.
    pub key: String,
    /// Hashes of the two datasets, of the first and the second package.
    pub hashes: [String; 2],
    /// Hemispherical transmittances τ of both datasets, from outside to inside; `None` where a dataset has no
    /// transmission.
    pub tau_hemispherical: [Option<f64>; 2],
    /// Largest absolute difference of the transmittance τ between the two datasets, over incident directions every 10°
    /// of θ and 30° of φ; `None` unless both have a transmission.
    pub tau_change: Option<f64>,
}

impl PackageDiff {
    /// Whether both packages have the same content.
    pub fn is_same(&self) -> bool {
        self.only_first.is_empty() && self.only_second.is_empty() && self.changed.is_empty()
    }
}

/// Compares two packages product by product and state by state. The order of products does not matter, that of states
/// does.
///
/// # Errors
/// Returns an error if keys are not distinct, or a dataset that differs cannot be read.
pub fn diff_packages(first: &Package, second: &Package) -> Result<PackageDiff, CatalogueError> {
    let (a, b) = (by_key(first)?, by_key(second)?);
    let mut diff = PackageDiff::default();
    for (key, product) in &a {
        match b.get(key) {
            None => diff.only_first.push((*key).to_owned()),
            Some(other) if product != other => diff.changed.push(diff_products(product, other, first, second)?),
            Some(_) => {}
        }
    }
    diff.only_second = b.keys().filter(|key| !a.contains_key(*key)).map(|key| (*key).to_owned()).collect();
    Ok(diff)
}

fn by_key(package: &Package) -> Result<BTreeMap<&str, &PackageProduct>, CatalogueError> {
    let mut map = BTreeMap::new();
    for product in &package.products {
        if map.insert(product.key.as_str(), product).is_some() {
            return Err(CatalogueError::Import(format!("the package holds two products \"{}\"", product.key)));
        }
    }
    Ok(map)
}

/// Compares the two versions of a product, `a` of the first package and `b` of the second: all fields, the list of
/// states and their data.
fn diff_products(
    a: &PackageProduct,
    b: &PackageProduct,
    first: &Package,
    second: &Package,
) -> Result<ProductDiff, CatalogueError> {
    let mut diff = ProductDiff { key: a.key.clone(), ..ProductDiff::default() };
    let (p, q) = (&a.provenance, &b.provenance);
    let curve = |product: &PackageProduct| {
        // As words like every other field: a report sets the two side by side.
        let points = product.control_curve.iter().map(|point| format!("{}: {}", point.profile_angle, point.value));
        points.collect::<Vec<_>>().join(", ")
    };
    let mut field = |name: String, x: String, y: String| {
        if x != y {
            diff.fields.push((name, x, y));
        }
    };
    for (name, x, y) in [
        ("name", &a.name, &b.name),
        ("manufacturer", &a.manufacturer, &b.manufacturer),
        ("kind", &a.kind, &b.kind),
        ("description", &a.description, &b.description),
        ("license", &a.license, &b.license),
        ("provenance.origin", &p.origin, &q.origin),
        ("provenance.author", &p.author, &q.author),
        ("provenance.method", &p.method, &q.method),
        ("provenance.date", &p.date, &q.date),
        ("provenance.source_file", &p.source_file, &q.source_file),
        ("provenance.source_hash", &p.source_hash, &q.source_hash),
        ("provenance.inside_face", &p.inside_face, &q.inside_face),
    ] {
        field(name.to_owned(), x.clone(), y.clone());
    }
    // By hash: the texts are long.
    let short = |text: &str| match text {
        "" => String::new(),
        _ => blake3::hash(text.as_bytes()).to_hex()[..12].to_owned(),
    };
    field("system".to_owned(), short(&a.system), short(&b.system));
    field("tags".to_owned(), a.tags.join(", "), b.tags.join(", "));
    field("control_curve".to_owned(), curve(a), curve(b));
    let states = |product: &PackageProduct, others: &PackageProduct| -> Vec<String> {
        let alone = |state: &&PackageState| others.states.iter().all(|other| other.key != state.key);
        product.states.iter().filter(alone).map(|state| state.key.clone()).collect()
    };
    (diff.only_first, diff.only_second) = (states(a, b), states(b, a));
    for one in &a.states {
        // States of one side alone are listed above.
        let Some(other) = b.states.iter().find(|other| other.key == one.key) else { continue };
        let value = |state: &PackageState| state.value.map(|value| value.to_string()).unwrap_or_default();
        for (name, x, y) in [("label", one.label.clone(), other.label.clone()), ("value", value(one), value(other))] {
            if x != y {
                diff.fields.push((format!("states.{}.{name}", one.key), x, y));
            }
        }
        // The hash decides; only datasets that differ are decoded, which takes time.
        if one.dataset != other.dataset {
            diff.states.push(diff_states(one, other, first, second)?);
        }
    }
    let order = |product: &PackageProduct| product.states.iter().map(|s| s.key.as_str()).collect::<Vec<_>>().join(", ");
    // Where a state is missing the order differs by that alone, which has been said.
    if diff.only_first.is_empty() && diff.only_second.is_empty() && order(a) != order(b) {
        diff.fields.push(("order of states".to_owned(), order(a), order(b)));
    }
    Ok(diff)
}

/// Compares the datasets of a state, `a` of the first package and `b` of the second.
fn diff_states(
    a: &PackageState,
    b: &PackageState,
    first: &Package,
    second: &Package,
) -> Result<StateDiff, CatalogueError> {
    let dataset = |state: &PackageState, package: &Package| {
        let blob = package.datasets.get(&state.dataset).map(Vec::as_slice).unwrap_or_default();
        decode(blob).map_err(|cause| CatalogueError::Dataset { hash: state.dataset.clone(), cause })
    };
    let (x, y) = (dataset(a, first)?, dataset(b, second)?);
    let (x, y) = (x.transmission(), y.transmission());
    Ok(StateDiff {
        key: a.key.clone(),
        hashes: [a.dataset.clone(), b.dataset.clone()],
        tau_hemispherical: [x, y].map(|btdf| btdf.map(Btdf::tau_hemispherical)),
        tau_change: x.zip(y).map(|(x, y)| largest_change(x, y)),
    })
}

fn largest_change(a: &Btdf, b: &Btdf) -> f64 {
    // Off the borders of common cells: rounding must not decide which one is compared.
    let directions = (0..9).flat_map(|k| (0..12).map(move |j| (10.0 * f64::from(k) + 0.3, 30.0 * f64::from(j) + 0.7)));
    directions
        .map(|(theta, phi): (f64, f64)| {
            let incident = Incident(Dir::from_theta_phi(theta.to_radians(), phi.to_radians()));
            (a.tau(incident) - b.tau(incident)).abs()
        })
        .fold(0.0, f64::max)
}

/// Two packages merged into one, with a report on products that both contain.
#[derive(Debug, Clone, PartialEq)]
pub struct Merged {
    /// Merged package with all products, by key. Apart from renamed keys its content does not depend on the order of
    /// the two packages.
    pub package: Package,
    /// Keys of the products that both packages contain with the same content.
    pub same: Vec<String>,
    /// Products of the second package that got a new key, because the first package contains a different product with
    /// the same key: old key, new key.
    pub renamed: Vec<(String, String)>,
}

/// Merges two packages: products of the same key and content become one; of products with the same key and different
/// content both stay, that of the second package under the first free key of KEY-2, KEY-3, ….
///
/// # Errors
/// Returns an error if keys are not distinct within a package.
pub fn merge_packages(first: &Package, second: &Package) -> Result<Merged, CatalogueError> {
    let (a, b) = (by_key(first)?, by_key(second)?);
    let mut taken: BTreeSet<String> = a.keys().chain(b.keys()).map(|key| (*key).to_owned()).collect();
    let mut products: Vec<PackageProduct> = first.products.clone();
    let (mut same, mut renamed) = (Vec::new(), Vec::new());
    for (key, product) in b {
        match a.get(key) {
            None => products.push(product.clone()),
            Some(own) if *own == product => same.push(key.to_owned()),
            Some(_) => {
                let free = free_key(key, product, &a, &taken);
                let known = a.contains_key(free.as_str());
                if !known {
                    taken.insert(free.clone());
                    products.push(PackageProduct { key: free.clone(), ..product.clone() });
                }
                renamed.push((key.to_owned(), free));
            }
        }
    }
    products.sort_by(|x, y| x.key.cmp(&y.key));
    let mut datasets = first.datasets.clone();
    datasets.extend(second.datasets.iter().map(|(hash, blob)| (hash.clone(), blob.clone())));
    Ok(Merged { package: Package { products, datasets }, same, renamed })
}

/// Returns the first of KEY-2, KEY-3, … that is free, or under which the first package contains this same product since
/// an earlier merge.
fn free_key(
    key: &str,
    product: &PackageProduct,
    a: &BTreeMap<&str, &PackageProduct>,
    taken: &BTreeSet<String>,
) -> String {
    let mut number = 2_u64;
    loop {
        let wanted = format!("{key}-{number}");
        let as_wanted = PackageProduct { key: wanted.clone(), ..product.clone() };
        if !taken.contains(&wanted) || a.get(wanted.as_str()).is_some_and(|own| **own == as_wanted) {
            return wanted;
        }
        number += 1;
    }
}
