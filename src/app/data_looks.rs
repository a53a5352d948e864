//! Views of the BTDF tile on the data: their form, and the map of interpolation schemes between their directions.
//! Computed in jobs, only while visible.

use crate::compute::btdf::Btdf;
use crate::compute::direction::Incident;
use crate::compute::incidence::schemes::{DiffuseScheme, SunScheme};
use crate::compute::incidence::ways::Triangle;
use crate::study::data_form::{DataForm, Formed, NoForm, row_of};
use crate::study::scene_file::Interpolation;

/// View of the BTDF tile on the data.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct DataLook {
    /// Form of the emergent light.
    pub form: DataForm,
    /// Whether the map of schemes over the incident side is shown.
    pub schemes: bool,
}

/// Key that a form of the data depends on: dataset, indicatrix, form, and filter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FormKey {
    /// Revision of the dataset.
    pub dataset: u64,
    /// Index of the indicatrix.
    pub row: Option<usize>,
    /// Form of the data.
    pub form: DataForm,
    /// Scheme of diffuse light in the scene.
    pub diffuse: DiffuseScheme,
}

impl FormKey {
    /// Creates the key for the data of an incident direction.
    pub fn of(btdf: &Btdf, dataset: u64, incident: Incident, (form, diffuse): (DataForm, DiffuseScheme)) -> Self {
        // Only the filter depends on the scene.
        let diffuse = if form == DataForm::Filtered { diffuse } else { DiffuseScheme::Auto };
        Self { dataset, row: row_of(btdf, incident), form, diffuse }
    }
}

/// Data in a form, or the reason why there are none, with their key.
#[derive(Debug, Clone, PartialEq)]
pub struct FormResult {
    /// Key that the data were made for.
    pub key: FormKey,
    /// Data in the form.
    pub made: Result<Formed, NoForm>,
}

/// Key of a map of schemes: revision of the dataset, the scene's scheme for the sun, and its interpolation between
/// directions.
pub type SchemesKey = (u64, SunScheme, Interpolation);

/// Reason why there is no map of schemes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoSchemes {
    /// Patch-averaged data: nothing is interpolated.
    NoDirections,
    /// Nothing is scattered, or only by a closed form.
    ClosedForm,
    /// The scene uses the data as given.
    Patches,
    /// Directions that have no triangles between them.
    NoTriangles,
}

/// Map of schemes, or the reason why there is none, with its key.
#[derive(Debug, Clone, PartialEq)]
pub struct SchemesResult {
    /// Key that the map was made for.
    pub key: SchemesKey,
    /// Triangles of the map.
    pub made: Result<Vec<Triangle>, NoSchemes>,
}
