//! Self-contained system descriptions, which refer to no other files: the descriptions of a stack's layers are
//! contained in its text.
//!
//! `layers = [{ system = { name = "…", kind = "venetian", venetian = { … } }, state = "45" }, …]`. Such a text has the
//! same meaning everywhere, so that it can be stored with data; [`self_contained`] makes it from one that refers to
//! files.

use super::layers::EACH_STATE;
use super::read;
use crate::compute::btdf::DescribedState;
use crate::compute::system::SystemKind;
use crate::compute::system::stack::LayerSource;
use toml::{Table, Value};

/// Returns a system description with the descriptions of all its layers inserted. `find` returns the self-contained
/// text of a layer, or `None` if the layer is measured data or is not found; then the result is `None`. A text that
/// refers to no other file is returned unchanged.
pub fn self_contained(text: &str, find: &mut dyn FnMut(&LayerSource) -> Option<String>) -> Option<String> {
    let SystemKind::Stack(layers) = read(text.as_bytes()).ok()?.system.kind else { return Some(text.to_owned()) };
    if states(text).is_some() {
        return Some(text.to_owned());
    }
    let mut table: Table = toml::from_str(text).ok()?;
    let entries = table.get_mut("stack")?.get_mut("layers")?.as_array_mut()?;
    for (entry, layer) in entries.iter_mut().zip(&layers) {
        let own = match &layer.source {
            LayerSource::Text(own) => self_contained(own, find)?,
            named => find(named)?,
        };
        let mut system: Table = toml::from_str(&own).ok()?;
        // The catalogue keys of the stack count, not those of its layers.
        system.remove("catalogue");
        let mut entry_of = Table::from_iter([("system".to_owned(), Value::Table(system))]);
        if !layer.state.is_empty() {
            entry_of.insert("state".to_owned(), Value::String(layer.state.clone()));
        }
        *entry = Value::Table(entry_of);
    }
    let made = toml::to_string(&table).ok()?;
    states(&made).is_some().then_some(made)
}

/// Returns the keys of the states of a self-contained description; `None` for one that refers to other files or cannot
/// be read.
pub fn states(text: &str) -> Option<Vec<String>> {
    let system = read(text.as_bytes()).ok()?.system;
    let SystemKind::Stack(layers) = &system.kind else { return Some(system.states()) };
    let mut moving = None;
    for layer in layers {
        let LayerSource::Text(own) = &layer.source else { return None };
        let states = states(own)?;
        if layer.state == EACH_STATE {
            moving = Some(states);
        } else if !states.contains(&layer.state) {
            return None;
        }
    }
    Some(moving.unwrap_or_else(|| vec![String::new()]))
}

/// Returns a description with one of its states, to be stored with data of that state; `None` unless the text is
/// self-contained and has the state.
pub fn described(text: &str, state: &str) -> Option<DescribedState> {
    states(text)?
        .iter()
        .any(|key| key == state)
        .then(|| DescribedState { text: text.to_owned(), state: state.to_owned() })
}

#[cfg(test)]
mod tests {
    use super::super::layers::MOST_NESTED;
    use super::*;

    const BLIND: &str = "name = \"Blind\"\nkind = \"venetian\"\nupright = true\n[venetian]\nwidth = 0.08\nspacing = 0.072\n\
                         angles = [0.1, 45.0]\nupper = { reflectance = 0.7 }\nlower = { reflectance = 0.7 }\n\
                         [catalogue]\nkey = \"blind\"\n";
    const PANE: &str = "name = \"Pane\"\nkind = \"pane\"\n[pane]\nindex = 1.52\nthickness = 0.004\nabsorption = 10.0\n";
    const STACK: &str = "name = \"Stack\"\nkind = \"stack\"\nupright = true\n[stack]\nlayers = [{ file = \"p.system.toml\" }, \
                         { catalogue = \"blind\", state = \"each\" }]\n[catalogue]\nkey = \"s\"\ncontrol = \"cut-off\"\n";

    fn find(source: &LayerSource) -> Option<String> {
        match source {
            LayerSource::File(name) => (name == "p.system.toml").then(|| PANE.to_owned()),
            LayerSource::Catalogue(key) => (key == "blind").then(|| BLIND.to_owned()),
            LayerSource::Text(_) => panic!("nobody looks for what is there"),
        }
    }

    #[test]
    fn layers_go_into_the_text_with_their_meaning() {
        assert_eq!(states(STACK), None);
        let text = self_contained(STACK, &mut find).unwrap();
        let file = read(text.as_bytes()).unwrap();
        assert_eq!((file.control.as_str(), file.key.as_str(), file.system.upright), ("cut-off", "s", true));
        assert_eq!(states(&text).unwrap(), ["0.1", "45"]);
        let SystemKind::Stack(layers) = file.system.kind else { panic!("a stack") };
        for (layer, (named, state)) in layers.iter().zip([(PANE, ""), (BLIND, EACH_STATE)]) {
            let LayerSource::Text(own) = &layer.source else { panic!("a text") };
            assert_eq!(read(own.as_bytes()).unwrap().system, read(named.as_bytes()).unwrap().system);
            assert_eq!(layer.state, state);
        }
        assert_eq!(self_contained(&text, &mut |_| None).unwrap(), text, "as it was written");
        assert_eq!(self_contained(PANE, &mut |_| None).unwrap(), PANE);
        assert_eq!(self_contained(&STACK.replace("p.system", "q.system"), &mut find), None, "measured data");
    }

    #[test]
    fn a_stack_in_a_stack_goes_into_it() {
        let outer = "name = \"Outer\"\nkind = \"stack\"\n[stack]\nlayers = [{ file = \"inner.system.toml\", state = \"45\" }]\n";
        let mut nested = |source: &LayerSource| match source {
            LayerSource::File(name) if name == "inner.system.toml" => self_contained(STACK, &mut find),
            other => find(other),
        };
        let text = self_contained(outer, &mut nested).unwrap();
        assert_eq!(states(&text).unwrap(), [""]);
        assert_eq!(described(&text, "").unwrap().text, text);
        assert_eq!(described(&text, "45"), None, "no state of the outer stack");
        // Half-way: a layer of its own that still names a file.
        let half = "name = \"Half\"\nkind = \"stack\"\n[stack]\nlayers = [{ state = \"0.1\", system = { name = \"s\", kind = \
             \"stack\", stack = { layers = [{ file = \"p.system.toml\" }, { catalogue = \"blind\", state = \"each\" }] } } }]\n";
        assert_eq!(states(half), None);
        assert_eq!(states(&self_contained(half, &mut find).unwrap()).unwrap(), [""]);
    }

    #[test]
    fn wrong_layers_are_told_by_their_place() {
        let told = |layer: &str| {
            let text = format!("name = \"s\"\nkind = \"stack\"\n[stack]\nlayers = [{layer}]\n");
            read(text.as_bytes()).unwrap_err().to_string()
        };
        let pane = |keys: &str| format!("{{ system = {{ name = \"p\", kind = \"pane\", pane = {{ {keys} }} }} }}");
        let wrong = told(&pane("index = 9.0"));
        assert!(wrong.starts_with("stack.layers[0].system.pane.index: 9; expected 1 to 4"), "{wrong}");
        let wrong = told(&pane("indes = 1.5"));
        assert!(wrong.starts_with("stack.layers[0].system.pane: unknown field `indes`"), "{wrong}");
        assert!(told("{ state = \"1\" }").contains("file, catalogue or system"));
        let both = pane("index = 1.5").replacen('{', "{ file = \"a.system.toml\", ", 1);
        assert!(told(&both).contains("not one of file, catalogue and system"));
        let mut deep = pane("index = 1.5");
        for _ in 0..MOST_NESTED {
            deep = format!("{{ system = {{ name = \"s\", kind = \"stack\", stack = {{ layers = [{deep}] }} }} }}");
        }
        assert!(told(&deep).contains("at most 4"), "{}", told(&deep));
    }

    #[test]
    fn endless_nesting_is_refused() {
        let header = format!("name = \"s\"\nkind = \"stack\"\n[stack{}]\nx = 1\n", ".stack".repeat(100_000));
        assert!(read(header.as_bytes()).is_err());
        let open = format!("name = \"s\"\nkind = \"stack\"\n[stack]\nlayers = {}", "[{ system = { x = ".repeat(50_000));
        assert!(read(open.as_bytes()).is_err());
    }
}
