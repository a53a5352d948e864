//! Input and actions of the BTDF tile.

use crate::app::data_looks::{FormResult, SchemesResult};
use crate::app::incidence::Incidence;
use crate::app::paint::tile::Status;
use crate::compute::btdf::Btdf;
use crate::compute::direction::Incident;
use crate::study::data_form::DataForm;

/// Input of the tile.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// BTDF for light from outside; `None` while no product is chosen.
    pub btdf: Option<&'a Btdf>,
    /// Product and state as text.
    pub name: &'a str,
    /// Incident direction: the sun's or a chosen one.
    pub incidence: Incidence,
    /// Direction of the sun; `None` if it is not in front of the façade.
    pub sun: Option<Incident>,
    /// Scale forced from outside (comparison), lowest and highest q. \[1/sr\]
    pub range: Option<[f64; 2]>,
    /// Number that changes with `btdf`.
    pub revision: u64,
    /// Data in another form than the original data, where that is shown.
    pub form: Option<FormInput<'a>>,
    /// Map of schemes, where it is shown.
    pub schemes: Option<SchemesInput<'a>>,
    /// Status of the content: preliminary, outdated or complete.
    pub status: Status<'a>,
}

/// Action of the user.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action {
    /// Choice of a cell of the incident hemisphere, given by its centre.
    ChooseIncidence(Incident),
    /// Coupling of the incident direction to the sun, or (`false`) its end.
    FollowSun(bool),
    /// Choice of the form in which the data are shown.
    Form(DataForm),
    /// Switching of the map of schemes on or off.
    Schemes,
}

/// Input for another form of the data than the original data.
#[derive(Debug, Clone, Copy)]
pub struct FormInput<'a> {
    /// Form of the data.
    pub form: DataForm,
    /// Data in `form`; `None` until they are computed.
    pub result: Option<&'a FormResult>,
    /// Internal error, as text.
    pub error: Option<&'a str>,
    /// Number that changes with `result`.
    pub revision: u64,
}

/// Input for the map of schemes.
#[derive(Debug, Clone, Copy)]
pub struct SchemesInput<'a> {
    /// Triangles of the map; `None` until they are computed.
    pub result: Option<&'a SchemesResult>,
    /// Internal error, as text.
    pub error: Option<&'a str>,
    /// Number that changes with `result`.
    pub revision: u64,
}
