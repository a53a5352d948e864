//! Selection of the data of a BSDF XML file that describe the whole system, not single layers or their absorption.

use super::document::{Source, child, child_text, children};
use crate::compute::btdf::{Component, Finding};
use crate::formats::location::{FormatError, excerpt};
use roxmltree::Node;
use std::collections::BTreeSet;

/// Returns the first `Layer` element with data.
pub(super) fn layer<'a, 'd>(
    source: &Source,
    root: Node<'a, 'd>,
    findings: &mut Vec<Finding>,
) -> Result<Node<'a, 'd>, FormatError> {
    let mut layers = root.descendants().filter(|node| child(*node, "WavelengthData").is_some());
    let first = layers.next().ok_or_else(|| {
        FormatError::new(source.place(root), "no WavelengthData", "<Optical><Layer> with WavelengthData elements")
    })?;
    let more = layers.count();
    if more > 0 {
        findings.push(Finding::warning(
            "several-layers",
            format!("The file holds data of {} layers; only the first is read.", more + 1),
        ));
    }
    Ok(first)
}

/// Returns the `WavelengthData` of the system: those whose `LayerNumber` is `System` or missing. A file of one numbered
/// layer alone describes a system of one layer.
///
/// # Errors
/// Returns an error if there are data of several layers and none of the system.
pub(super) fn of_system<'a, 'd>(
    source: &Source,
    layer: Node<'a, 'd>,
    findings: &mut Vec<Finding>,
) -> Result<Vec<Node<'a, 'd>>, FormatError> {
    let all = || children(layer, "WavelengthData");
    let absorbed = all().flat_map(|data| children(data, "WavelengthDataBlock")).filter(|block| is_absorbed(*block));
    let absorbed = absorbed.count();
    if absorbed > 0 {
        let message =
            format!("Absorbed fractions of layers ({absorbed} blocks) do not affect light and were not read.");
        findings.push(Finding::info("absorbed-not-read", message));
    }
    let is_optical = |data: &Node<'_, '_>| {
        let mut blocks = children(*data, "WavelengthDataBlock").peekable();
        blocks.peek().is_none() || blocks.any(|block| !is_absorbed(block))
    };
    let optical: Vec<Node<'a, 'd>> = all().filter(is_optical).collect();
    let mut layers: BTreeSet<String> = optical.iter().map(|data| number(*data)).collect();
    let system = if layers.contains(SYSTEM) || layers.len() > 1 {
        SYSTEM.to_owned()
    } else {
        layers.pop_first().unwrap_or_default()
    };
    layers.remove(SYSTEM);
    let list = excerpt(&layers.iter().map(String::as_str).collect::<Vec<_>>().join(", "));
    let of_system: Vec<Node<'a, 'd>> = optical.iter().copied().filter(|data| number(*data) == system).collect();
    if of_system.is_empty() && !layers.is_empty() {
        return Err(FormatError::new(
            source.place(optical[0]),
            format!("data of the layers {list} and none of the system"),
            "WavelengthData with <LayerNumber>System</LayerNumber>",
        ));
    }
    if of_system.len() < optical.len() {
        let message = format!("Data of single layers (LayerNumber {list}) were not read; those of the system were.");
        findings.push(Finding::info("layers-not-read", message));
    }
    Ok(of_system)
}

/// `LayerNumber` of data of the system, in lower case.
const SYSTEM: &str = "system";

/// Returns the `LayerNumber` of data in lower case; of data without one that of the system.
fn number(data: Node<'_, '_>) -> String {
    let number = child_text(data, "LayerNumber").to_lowercase();
    if number.is_empty() { SYSTEM.to_owned() } else { number }
}

/// Returns the words of a block's `WavelengthDataDirection`, in lower case.
pub(super) fn direction(block: Node<'_, '_>) -> Vec<String> {
    child_text(block, "WavelengthDataDirection").to_lowercase().split_whitespace().map(str::to_owned).collect()
}

/// Whether a data block states the absorptance of a layer: `Absorbed` in the schema, `Absorption` in other files.
pub(super) fn is_absorbed(block: Node<'_, '_>) -> bool {
    direction(block).first().is_some_and(|word| word.starts_with("absor"))
}

/// Returns which transmission a block without a side contains. genBSDF wrote such blocks until 2012: transmission from
/// the room side, unless it had traced from outside alone, when the file contains only the reflection of the outside
/// (Radiance, src/util/genBSDF.pl 2.37).
pub(super) fn without_side(layer: Node<'_, '_>) -> Component {
    let blocks = || layer.descendants().filter(|node| child(*node, "WavelengthDataDirection").is_some());
    let reflects = |side: &str| blocks().any(|block| direction(block) == ["reflection", side]);
    if reflects("front") && !reflects("back") { Component::TransmissionFront } else { Component::TransmissionBack }
}
