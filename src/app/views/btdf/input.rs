//! What the BTDF tile draws, and what may be asked of it.

use crate::app::data_looks::{FormResult, SchemesResult};
use crate::app::incidence::Incidence;
use crate::app::paint::tile::Status;
use crate::compute::btdf::Btdf;
use crate::compute::direction::Incident;
use crate::study::data_form::DataForm;

/// What the tile draws.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Transmission of light from outside; `None` while no product is chosen.
    pub btdf: Option<&'a Btdf>,
    /// Product and state in words.
    pub name: &'a str,
    /// The direction of incidence, the sun's or a chosen one.
    pub incidence: Incidence,
    /// Where the sun is, if it is before the façade.
    pub sun: Option<Incident>,
    /// Scale forced from outside (comparison), lowest and highest q.
    pub range: Option<[f64; 2]>,
    /// Changes with `btdf`.
    pub revision: u64,
    /// The data in another form than as measured, where that is looked at.
    pub form: Option<FormInput<'a>>,
    /// The map of schemes, where it is looked at.
    pub schemes: Option<SchemesInput<'a>>,
    /// How far the content is to be trusted.
    pub status: Status<'a>,
}

/// What the user did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action {
    /// A cell of the incident hemisphere was chosen: its centre.
    ChooseIncidence(Incident),
    /// Couple the incidence to the sun, or not.
    FollowSun(bool),
    /// Show the data in this form.
    Form(DataForm),
    /// Show or hide the map of schemes.
    Schemes,
}

/// Another form of the data than as measured.
#[derive(Debug, Clone, Copy)]
pub struct FormInput<'a> {
    /// Which.
    pub form: DataForm,
    /// The data in it; `None` until they are computed.
    pub result: Option<&'a FormResult>,
    /// A fault of the program.
    pub error: Option<&'a str>,
    /// Changes with `result`.
    pub revision: u64,
}

/// The map of schemes.
#[derive(Debug, Clone, Copy)]
pub struct SchemesInput<'a> {
    /// The triangles; `None` until they are there.
    pub result: Option<&'a SchemesResult>,
    /// A fault of the program.
    pub error: Option<&'a str>,
    /// Changes with `result`.
    pub revision: u64,
}
