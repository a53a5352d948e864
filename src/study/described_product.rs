//! A described system as a product of the catalogue: where its data come from, how its states are named.

use super::goniophotometer::{Described, Request};
use crate::catalogue::{NewProduct, Origin, Provenance, StateName};
use crate::compute::btdf::Dataset;
use crate::compute::system::description::SystemKind;

/// What the catalogue is told about the datasets of a described system.
pub fn product_of(described: &Described, request: &Request, datasets: &[Dataset]) -> NewProduct {
    let system = &described.file.system;
    let name = |dataset: &Dataset| {
        let value = dataset.state.parse::<f64>().ok().filter(|value| value.is_finite());
        let label = match value {
            Some(degrees) => format!("slats {degrees}°"),
            None => dataset.state.clone(),
        };
        StateName { label, value }
    };
    let hash = blake3::hash(described.text.as_bytes());
    NewProduct {
        key: (!described.file.key.is_empty()).then(|| described.file.key.clone()),
        name: system.name.clone(),
        kind: system.kind.word().to_owned(),
        description: system.description.clone(),
        provenance: Provenance {
            origin: Origin::Computed,
            author: "cfs".to_owned(),
            method: described.method(request),
            source_hash: hash.to_hex().to_string(),
            inside_face: match &system.kind {
                SystemKind::Stack(_) => "last layer of the description",
                _ => "room side of the description",
            }
            .to_owned(),
            ..Provenance::default()
        },
        tags: described.file.tags.clone(),
        states: datasets.iter().map(name).collect(),
        ..NewProduct::default()
    }
}
