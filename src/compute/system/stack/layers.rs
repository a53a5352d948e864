//! Stacks as described: layers by name, from outside to inside. Only a library can find them.

use crate::compute::system::family::{Family, NoSpecimen, Polygons};
use crate::compute::system::measure::Specimen;

/// One layer of a stack.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// What it is, as the description names it: a system file, a dataset file, a product of the catalogue, or the
    /// description itself.
    pub source: LayerSource,
    /// Key of its state; empty for the only one.
    pub state: String,
}

/// Where a layer comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum LayerSource {
    /// A file, its path relative to the description's.
    File(String),
    /// A product of the catalogue.
    Catalogue(String),
    /// The layer's own description: text of a system file. Text, since layers are what descriptions are made of.
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

    fn specimen(&self, _: &str) -> Result<Box<dyn Specimen>, NoSpecimen> {
        Err(NoSpecimen::because("its layers are to be found first"))
    }
}
