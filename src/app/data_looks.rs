//! How the BTDF tile looks at the data: their form, and the map of what is done between their directions. Made in jobs,
//! only while it is looked at.

use crate::compute::btdf::Btdf;
use crate::compute::direction::Incident;
use crate::compute::incidence::schemes::{DiffuseScheme, SunScheme};
use crate::compute::incidence::ways::Triangle;
use crate::study::data_form::{DataForm, Formed, NoForm, row_of};
use crate::study::scene_file::Interpolation;

/// What is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct DataLook {
    /// The form of what leaves.
    pub form: DataForm,
    /// The map of schemes, over the incident side.
    pub schemes: bool,
}

/// What a form of the data hangs on: dataset, which of its indicatrices, form, and filter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FormKey {
    /// Revision of the dataset.
    pub dataset: u64,
    /// Number of the indicatrix.
    pub row: Option<usize>,
    /// Which form.
    pub form: DataForm,
    /// The scene's scheme of diffuse light.
    pub diffuse: DiffuseScheme,
}

impl FormKey {
    /// Of the data of an incidence.
    pub fn of(btdf: &Btdf, dataset: u64, incident: Incident, (form, diffuse): (DataForm, DiffuseScheme)) -> Self {
        // Only the filter hangs on the scene.
        let diffuse = if form == DataForm::Filtered { diffuse } else { DiffuseScheme::Auto };
        Self { dataset, row: row_of(btdf, incident), form, diffuse }
    }
}

/// Data in a form, or why they have none; and of what.
#[derive(Debug, Clone, PartialEq)]
pub struct FormResult {
    /// Of what.
    pub key: FormKey,
    /// The data.
    pub made: Result<Formed, NoForm>,
}

/// What a map of schemes is of: dataset, the scene's scheme for the sun, and its way between directions.
pub type SchemesKey = (u64, SunScheme, Interpolation);

/// Why there is no map of schemes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoSchemes {
    /// The data are means over cells: nothing is interpolated.
    NoDirections,
    /// Nothing is scattered, or by a closed form.
    ClosedForm,
    /// The scene takes the data at their word.
    Patches,
    /// The directions have no triangles between them.
    NoTriangles,
}

/// The map of schemes, or why there is none; and of what.
#[derive(Debug, Clone, PartialEq)]
pub struct SchemesResult {
    /// Of what.
    pub key: SchemesKey,
    /// The triangles.
    pub made: Result<Vec<Triangle>, NoSchemes>,
}
