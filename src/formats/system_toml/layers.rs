//! Layers of a stack in a system file: given by file or catalogue key, or described inside the stack.

use super::checks::wrong;
use super::keys;
use crate::compute::system::stack::{Layer, LayerSource};
use crate::formats::location::{FormatError, Location};
use toml::{Table, Value};

/// Value of a layer's key `state` that means each of the layer's states.
pub const EACH_STATE: &str = "each";
/// Maximum depth of nested stacks (stacks whose layers are stacks).
pub const MOST_NESTED: usize = 4;

/// Returns the layers of a stack with their sources and states.
pub(super) fn stack(stack: &keys::Stack) -> Result<Vec<Layer>, FormatError> {
    if !(1..=10).contains(&stack.layers.len()) {
        return wrong("stack.layers", format!("{} layers", stack.layers.len()), "1 to 10, outside first");
    }
    if stack.layers.iter().filter(|layer| layer.state == EACH_STATE).count() > 1 {
        return wrong("stack.layers", "state = \"each\" in several layers", "one moving layer at most");
    }
    let layer = |(k, layer): (usize, &keys::Layer)| {
        let key = format!("stack.layers[{k}]");
        let source = match (&layer.file, &layer.catalogue, &layer.system) {
            (Some(file), None, None) => LayerSource::File(file.clone()),
            (None, Some(key), None) => LayerSource::Catalogue(key.clone()),
            (None, None, Some(system)) => LayerSource::Text(own_text(&format!("{key}.system"), system)?),
            _ => return wrong(&key, "not one of file, catalogue and system", "file, catalogue or system"),
        };
        Ok(Layer { source, state: layer.state.clone() })
    };
    stack.layers.iter().enumerate().map(layer).collect()
}

/// Returns the text of a description that the stack contains for a layer.
fn own_text(key: &str, system: &Table) -> Result<String, FormatError> {
    if nested(system) >= MOST_NESTED {
        return wrong(key, "stacks within stacks within stacks", format!("at most {MOST_NESTED} of them"));
    }
    toml::to_string(system).map_err(|error| {
        FormatError::new(Location::file().in_element(key), error.to_string(), "the keys of a system file")
    })
}

fn layers_of(system: &Table) -> Option<&Vec<Value>> {
    system.get("stack")?.get("layers")?.as_array()
}

/// Returns the depth of nested stacks in a system description.
fn nested(system: &Table) -> usize {
    let Some(layers) = layers_of(system) else { return 0 };
    let inner = layers.iter().filter_map(|layer| layer.get("system")?.as_table());
    1 + inner.map(nested).max().unwrap_or(0)
}
