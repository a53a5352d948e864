//! Self-contained descriptions, which are stored with the data computed from them: their text contains all layers, so
//! that they do not depend on a folder or catalogue.

use super::goniophotometer::{Base, Described, LayerLibrary};
use crate::compute::btdf::DescribedState;
use crate::compute::system::stack::LayerSource;
use crate::formats::system_toml::{self, MOST_NESTED, is_system_file};

impl Described {
    /// Returns the text of the description with all layers inserted that are system files (built-in or beside it) or
    /// products of the catalogue with a description. `None` if a layer is known by data only, which no text replaces,
    /// or cannot be read.
    pub fn self_contained(&self, library: &dyn LayerLibrary) -> Option<String> {
        self.contained_within(library, 0)
    }

    /// Returns the self-contained description of a state, which is stored with its data; `None` if there is none.
    pub fn described(&self, state: &str, library: &dyn LayerLibrary) -> Option<DescribedState> {
        Some(DescribedState { text: self.self_contained(library)?, state: state.to_owned() })
    }

    /// Returns the text with all layers inserted. `depth`: level of nesting so far.
    fn contained_within(&self, library: &dyn LayerLibrary, depth: usize) -> Option<String> {
        // Files may name each other in a circle.
        if depth > MOST_NESTED {
            return None;
        }
        system_toml::self_contained(&self.text, &mut |source| match source {
            LayerSource::File(name) if is_system_file(name) => {
                self.other(name).ok()?.contained_within(library, depth + 1)
            }
            LayerSource::File(_) | LayerSource::Text(_) => None,
            LayerSource::Catalogue(key) => {
                let text = library.product(key).ok()?.system;
                // Catalogues of older programs hold stacks that name built-in files.
                let product = (!text.is_empty()).then(|| Self::from_text(&text, Base::Builtin).ok())??;
                product.contained_within(library, depth + 1)
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::{AzimuthMap, RingBasis};
    use crate::compute::btdf::Dataset;
    use crate::compute::estimate::Silent;
    use crate::formats::{Format, write_dataset};
    use crate::study::Library;
    use crate::study::goniophotometer::Request;
    use std::path::Path;

    const PANE: &str = "name = \"pane\"\nkind = \"pane\"\n[pane]\nindex = 1.52\nthickness = 0.004\nabsorption = 10\n";
    const BLIND: &str = "name = \"blind\"\nkind = \"venetian\"\n[venetian]\nwidth = 0.08\nspacing = 0.072\n\
                         angles = [0, 45]\nupper = { reflectance = 0.5 }\nlower = { reflectance = 0.3 }\n";

    fn put(folder: &Path, name: &str, text: &str) {
        std::fs::write(folder.join(format!("{name}.system.toml")), text).unwrap();
    }

    fn stack(layers: &str) -> String {
        format!("name = \"stack\"\nkind = \"stack\"\n[stack]\nlayers = [{layers}]\n")
    }

    fn request() -> Request {
        let cells = RingBasis::klems_quarter(AzimuthMap::KLEMS_FRONT);
        Request { incident: cells.clone(), emergent: cells, error: 0.05, seed: 1 }
    }

    #[test]
    fn a_stack_and_its_own_text_are_the_same() {
        let folder = tempfile::tempdir().unwrap();
        put(folder.path(), "pane", PANE);
        put(folder.path(), "blind", BLIND);
        let moving = "{ file = \"pane.system.toml\" }, { file = \"blind.system.toml\", state = \"each\" }";
        put(folder.path(), "inner", &stack(moving));
        let outer = "{ file = \"pane.system.toml\" }, { file = \"inner.system.toml\", state = \"45\" }";
        put(folder.path(), "outer", &format!("upright = true\n{}", stack(outer)));
        let library = Library::default();
        for (name, state) in [("inner", "45"), ("outer", "")] {
            let named = Described::read(&folder.path().join(format!("{name}.system.toml"))).unwrap();
            let text = named.self_contained(&library).unwrap();
            // From nowhere: nothing is looked for.
            let own = Described::from_text(&text, Base::Builtin).unwrap();
            assert_eq!(own.states(&library).unwrap(), named.states(&library).unwrap());
            assert_eq!(own.self_contained(&library).as_deref(), Some(text.as_str()));
            let measured =
                |described: &Described| described.measure(state, &request(), &library, None, &Silent).unwrap().dataset;
            let (a, b) = (measured(&named), measured(&own));
            assert_eq!(a, b, "{name}");
            assert_eq!(a.described, Some(DescribedState { text: text.clone(), state: state.to_owned() }));
            assert_eq!(named.product(&request(), &[a]).system, text);
        }
    }

    #[test]
    fn measured_layers_have_no_text_and_built_in_ones_have() {
        let folder = tempfile::tempdir().unwrap();
        let mut opal = Dataset { name: "opal".to_owned(), ..Dataset::default() };
        opal.visible.transmission_front = Some(crate::compute::btdf::Btdf::ideal_diffuse(0.5));
        let file = write_dataset(Format::BsdfXml, &[opal]).unwrap();
        std::fs::write(folder.path().join("opal.xml"), file.bytes).unwrap();
        put(folder.path(), "pane", PANE);
        put(folder.path(), "itself", &stack("{ file = \"itself.system.toml\" }"));
        put(folder.path(), "measured", &stack("{ file = \"pane.system.toml\" }, { file = \"opal.xml\" }"));
        let library = Library::default();
        for name in ["itself", "measured"] {
            let described = Described::read(&folder.path().join(format!("{name}.system.toml"))).unwrap();
            assert_eq!(described.self_contained(&library), None, "{name}");
        }
        let builtin = Described::builtin("double-integral-micro-blind.system.toml").unwrap();
        let text = builtin.self_contained(&library).unwrap();
        assert!(!text.contains("file =") && crate::catalogue::blind_of(&text).is_some(), "{text}");
        assert_eq!(crate::catalogue::blind_of(&text), crate::catalogue::blind_of(&builtin.text));
    }
}
