//! Input of the BTDF tile, and the requests of its user.

use crate::app::paint::tile::Status;
use crate::app::results::data_looks::{FormResult, SchemesResult};
use crate::app::scene::incidence::Incidence;
use crate::compute::btdf::Btdf;
use crate::compute::direction::Incident;
use crate::study::data_form::DataForm;

/// Input of the BTDF tile in one frame.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Bidirectional transmittance distribution function (BTDF) for light from outside; `None` while no product is
    /// selected.
    pub btdf: Option<&'a Btdf>,
    /// Names of product and state as text.
    pub name: &'a str,
    /// Incident direction shown: that of the sun or a chosen one.
    pub incidence: Incidence,
    /// Direction of the sun; `None` if it is not in front of the façade.
    pub sun: Option<Incident>,
    /// Lowest and highest q of the colour scale, if the comparison sets it. \[1/sr\]
    pub range: Option<[f64; 2]>,
    /// Revision number of `btdf`, which changes whenever the data do.
    pub revision: u64,
    /// Processed data, if these are shown instead of the original ones.
    pub form: Option<FormInput<'a>>,
    /// Map of interpolation schemes on the incident side, if it is shown.
    pub schemes: Option<SchemesInput<'a>>,
    /// Status of the data shown: preliminary, outdated or complete.
    pub status: Status<'a>,
}

/// Request of the user of the BTDF tile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action {
    /// Choice of an incident direction, such as the centre of a cell of the incident hemisphere.
    ChooseIncidence(Incident),
    /// Coupling of the incident direction to the sun (`true`), or its end (`false`).
    FollowSun(bool),
    /// Choice of the processing of the data: original, filtered or compressed.
    Form(DataForm),
    /// Switching of the map of interpolation schemes on or off.
    Schemes,
}

/// Processed data (filtered or compressed) as input of the BTDF tile.
#[derive(Debug, Clone, Copy)]
pub struct FormInput<'a> {
    /// Processing of the data.
    pub form: DataForm,
    /// Processed data; `None` until they are computed.
    pub result: Option<&'a FormResult>,
    /// Internal error of the computation, as text.
    pub error: Option<&'a str>,
    /// Revision number of `result`, which changes whenever the result does.
    pub revision: u64,
}

/// Map of interpolation schemes as input of the BTDF tile.
#[derive(Debug, Clone, Copy)]
pub struct SchemesInput<'a> {
    /// Triangles between incident directions with their interpolation schemes; `None` until they are computed.
    pub result: Option<&'a SchemesResult>,
    /// Internal error of the computation, as text.
    pub error: Option<&'a str>,
    /// Revision number of `result`, which changes whenever the result does.
    pub revision: u64,
}
