//! Layers of a stack as its description names them, from outside to inside. Only a library of files and products can
//! find their data.

use crate::compute::system::family::{Family, OpticalModelError, Polygons};
use crate::compute::system::measure::OpticalModel;

/// Layer of a described stack: source of its data, and state.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// Source of the layer in the description: a system file, a dataset file, a product of the catalogue, or the
    /// description itself.
    pub source: LayerSource,
    /// Key of the layer's state; empty if it has only one.
    pub state: String,
}

/// Source of the data of a stack's layer.
#[derive(Debug, Clone, PartialEq)]
pub enum LayerSource {
    /// System or dataset file, by its path relative to the description's file.
    File(String),
    /// Product of the catalogue, by its key.
    Catalogue(String),
    /// Description inside the stack's description, as the text of a system file (text, since descriptions contain
    /// layers).
    Text(String),
}

impl Family for Vec<Layer> {
    fn word(&self) -> &'static str {
        "stack"
    }

    fn method(&self) -> &'static str {
        "adding method on matrices of refined cells (Klems, ASHRAE Transactions 100, 1994), panes side by side with \
         their polarisation in closed form"
    }

    fn inside_face(&self) -> &'static str {
        "last layer of the description"
    }

    fn drawing(&self, _: &str) -> Polygons {
        vec![]
    }

    fn optical_model(&self, _: &str) -> Result<Box<dyn OpticalModel>, OpticalModelError> {
        Err(OpticalModelError::because("its layers are to be found first"))
    }
}
