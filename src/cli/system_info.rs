//! `cfs info` for system descriptions: family, states, structure, layers and the source of the solar properties.
//! Transmittances need a computation, see `cfs goniophotometer`.

use super::output::Content;
use crate::compute::btdf::SolarSource;
use crate::compute::system::SystemKind;
use crate::compute::system::stack::{Layer, LayerSource};
use crate::formats::system_toml::{EACH_STATE, SystemFile};
use crate::study::Library;
use crate::study::goniophotometer::Described;
use crate::texts::one_line;
use anyhow::anyhow;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::Path;

/// Describes a system description file.
///
/// # Errors
/// Returns an error if the file or one of its layers cannot be read: one line with the file's name and the position in
/// it.
pub(super) fn describe(path: &Path, as_json: bool, library: &Library) -> anyhow::Result<Content> {
    let named = |error| anyhow!("{}: {error}", path.display());
    let described = Described::read(path)?;
    let states = described.states(library).map_err(named)?;
    let first = states.first().map_or("", String::as_str);
    let solar = SolarSource::of(described.materials(first, library).map_err(named)?);
    let file = &described.file;
    Ok(Content::of(as_json, || to_json(file, &states, solar), || to_text(file, &states, solar)))
}

/// Returns the layers of a stack from outside to inside; none for other systems.
fn layers(file: &SystemFile) -> &[Layer] {
    match &file.system.kind {
        SystemKind::Stack(layers) => layers,
        _ => &[],
    }
}

fn to_json(file: &SystemFile, states: &[String], solar: SolarSource) -> Value {
    let family = file.system.family();
    let layers = layers(file).iter().map(|layer| match &layer.source {
        LayerSource::File(name) => json!({"file": name, "state": layer.state}),
        LayerSource::Catalogue(key) => json!({"catalogue": key, "state": layer.state}),
        LayerSource::Text(text) => json!({"system": text, "state": layer.state}),
    });
    json!({
        "format": "system description",
        "name": file.system.name,
        "description": file.system.description,
        "kind": family.word(),
        "method": family.method(),
        // A single state has no name that `--state` could choose.
        "states": states.iter().filter(|key| !key.is_empty()).collect::<Vec<_>>(),
        "structure_m": family.structure(),
        "upright": file.system.upright,
        "layers": layers.collect::<Vec<_>>(),
        "solar_source": solar.words(),
        "key": file.key,
        "tags": file.tags,
        "control": file.control,
    })
}

fn to_text(file: &SystemFile, states: &[String], solar: SolarSource) -> String {
    let family = file.system.family();
    let mut text = String::new();
    let mut line = |label: &str, value: &str| {
        if !value.is_empty() {
            let _ = writeln!(text, "{label:<22}{}", one_line(value));
        }
    };
    line("Name", &file.system.name);
    line("Description", &file.system.description);
    line("Format", "system description");
    line("Kind", family.word());
    line("Method", family.method());
    for layer in layers(file) {
        let state = match &*layer.state {
            "" => String::new(),
            EACH_STATE => ", in each of its states".to_owned(),
            key => format!(", state {key}"),
        };
        line(
            "Layer",
            &match &layer.source {
                LayerSource::File(name) => format!("{name}{state}"),
                LayerSource::Catalogue(key) => format!("product {key} of the catalogue{state}"),
                LayerSource::Text(_) => format!("described in this file{state}"),
            },
        );
    }
    if let [first, .., last] = states {
        line("States", &format!("{}, {first} to {last}", states.len()));
    }
    line("Structure", &family.structure().map(|period| format!("{:.2} mm", 1000.0 * period)).unwrap_or_default());
    line("Orientation", if file.system.upright { "vertical" } else { "" });
    line("Solar", solar.words());
    line("Control", &file.control);
    line("Catalogue key", &file.key);
    line("Tags", &file.tags.join(", "));
    text
}
