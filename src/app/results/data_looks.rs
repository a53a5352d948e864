//! Data that the BTDF tile shows: original, filtered or compressed data, and the map of interpolation schemes between
//! their incident directions. Computed in jobs, only while visible.

use crate::compute::btdf::Btdf;
use crate::compute::direction::Incident;
use crate::compute::incidence::schemes::{DiffuseScheme, SunScheme};
use crate::compute::incidence::ways::Triangle;
use crate::study::data_form::{DataForm, Formed, NoForm, row_of};
use crate::study::scene_file::Interpolation;

/// Choice of the data that the BTDF tile shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct DataLook {
    /// Processing of the data on the emergent side: original, filtered for diffuse light, or compressed by wavelets.
    pub form: DataForm,
    /// Whether the map of interpolation schemes is shown on the incident side: the scheme that applies at each incident
    /// direction.
    pub schemes: bool,
}

/// Key of all input of processed data (filtered or compressed): dataset, indicatrix, kind of processing, and filter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FormKey {
    /// Revision number of the dataset.
    pub dataset: u64,
    /// Index in the dataset of the indicatrix; `None` if it has none for the incident direction.
    pub row: Option<usize>,
    /// Processing of the data: original, filtered or compressed.
    pub form: DataForm,
    /// Scheme for diffuse light of the scene, which decides the filter.
    pub diffuse: DiffuseScheme,
}

impl FormKey {
    /// Creates the key for the indicatrix of an incident direction; `dataset`: revision number of the dataset.
    pub fn of(btdf: &Btdf, dataset: u64, incident: Incident, (form, diffuse): (DataForm, DiffuseScheme)) -> Self {
        // Only the filter depends on the scene.
        let diffuse = if form == DataForm::Filtered { diffuse } else { DiffuseScheme::Auto };
        Self { dataset, row: row_of(btdf, incident), form, diffuse }
    }
}

/// Processed data (original, filtered or compressed) of one incident direction, or the reason why there are none, with
/// their key.
#[derive(Debug, Clone, PartialEq)]
pub struct FormResult {
    /// Key of the input from which the data were computed.
    pub key: FormKey,
    /// Processed data, or the reason why there are none.
    pub made: Result<Formed, NoForm>,
}

/// Key of a map of interpolation schemes: revision number of the dataset, the scene's scheme for direct sun, and its
/// setting for the interpolation between incident directions.
pub type SchemesKey = (u64, SunScheme, Interpolation);

/// Reason why there is no map of interpolation schemes over the incident directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoSchemes {
    /// Patch-averaged data, between which nothing is interpolated.
    NoDirections,
    /// No scattered light, or scattered light that is given by a closed form.
    ClosedForm,
    /// Setting of the scene by which data are used as given, without interpolation.
    Patches,
    /// Incident directions of the data that form no triangles.
    NoTriangles,
}

/// Map that shows which interpolation scheme applies at each incident direction, or the reason why there is none, with
/// its key.
#[derive(Debug, Clone, PartialEq)]
pub struct SchemesResult {
    /// Key of the input from which the map was computed.
    pub key: SchemesKey,
    /// Triangles between the incident directions of the data, each with its interpolation scheme, which form the map;
    /// or the reason why there is no map.
    pub made: Result<Vec<Triangle>, NoSchemes>,
}
