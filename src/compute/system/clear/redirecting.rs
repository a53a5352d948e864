//! Light-redirecting glass: profiles of clear material between two panes.

use super::outline::Outline;
use super::section::{Body, ClearSection, Material};
use super::{METHOD, OutlineError};
use crate::compute::system::family::{Family, OpticalModelError, Polygons};
use crate::compute::system::measure::OpticalModel;
use crate::compute::system::panes::glazing::Pane;

/// Light-redirecting glass: bodies of clear material, repeated vertically with a period, between two clear panes.
#[derive(Debug, Clone, PartialEq)]
pub struct RedirectingGlass {
    /// Refractive index of the profiles.
    pub index: f64,
    /// Absorption coefficient of the profiles. \[1/m\]
    pub absorption: f64,
    /// Vertical period of the bodies. \[m\]
    pub spacing: f64,
    /// Outlines of the bodies of one period, (outward, upward). \[m\]
    pub bodies: Vec<Vec<[f64; 2]>>,
    /// Outer and inner pane; `None` where there is none.
    pub panes: [Option<Pane>; 2],
}

impl RedirectingGlass {
    fn section(&self) -> Result<ClearSection, OutlineError> {
        let material = Material { index: self.index, absorption: self.absorption };
        let body = |outline: &Vec<[f64; 2]>| Body { outline: Outline::Closed(outline.clone()), material };
        ClearSection::new(self.spacing, self.bodies.iter().map(body).collect(), self.panes)
    }
}

impl Family for RedirectingGlass {
    fn word(&self) -> &'static str {
        "redirecting-glass"
    }

    fn method(&self) -> &'static str {
        METHOD
    }

    fn structure(&self) -> Option<f64> {
        Some(self.spacing)
    }

    fn drawing(&self, _: &str) -> Polygons {
        self.section().map(|section| section.outline()).unwrap_or_default()
    }

    fn optical_model(&self, _: &str) -> Result<Box<dyn OpticalModel>, OpticalModelError> {
        Ok(Box::new(self.section().map_err(OpticalModelError::because)?.optical_model()))
    }
}
