//! Bidirectional transmittance and reflectance distribution functions (BTDF, BRDF) and datasets of them.
//!
//! A [`Btdf`] has two separate parts: regular transmission ([`Btdf::regular`], a δ in direction, without a value in
//! 1/sr) and scattered light ([`Btdf::scattered`], q in 1/sr). Emergent directions ω_a are stored reversed, as the
//! direction of undeviated light ω′ = −ω_a (see [`crate::compute::direction`]).

mod angular;
mod cell_matrix;
mod checks;
mod dataset;
mod described;
mod figures;
mod finding;
mod ideal;
mod indicatrices;
mod on_cells;
mod on_tree;
mod pyramid;
mod regular;
mod resample;
mod rows;
mod solar;
mod tensor_emission;
mod tensor_reversal;
mod tensor_tree;
mod thermal;
mod zones;

pub use angular::AngularTransmittance;
pub use cell_matrix::CellMatrix;
pub use checks::{reciprocity_error, tau_max};
pub use dataset::{Band, Component, Dataset};
pub use described::DescribedState;
pub use figures::LightFigures;
pub use finding::{Finding, Severity};
pub use indicatrices::Indicatrices;
pub use on_cells::{matrix_on, matrix_roughly_on};
pub use on_tree::{OnTree, OnTreeError, TreeShape, tree_on};
pub use regular::separate_regular;
pub use resample::resample_matrix;
pub use solar::{BandName, PARTLY_VISIBLE, SolarSource};
pub use tensor_tree::{TensorTree, TreeAxes, TreeError, TreeNode, TreeRank};
pub use thermal::{Thermal, ThermalKey};
pub use zones::zone_shares;

use crate::compute::basis::RingBasis;
use crate::compute::direction::{Emergent, Incident};
use std::sync::Arc;

/// Scattered part of a BTDF or BRDF, without regular transmission.
#[derive(Debug, Clone, PartialEq)]
pub enum Scattered {
    /// Lambertian transmission: the same luminance in every emergent direction, q = τ(θ_e)/π.
    Lambert(AngularTransmittance),
    /// Patch-averaged data: q for every pair of an incident and an emergent cell.
    Cells(Box<CellMatrix>),
    /// Indicatrices at a list of single incident directions.
    Directions(Arc<Indicatrices>),
    /// Tensor tree of rank 3 or 4 on Shirley–Chiu squares (Radiance).
    Tree(Box<TensorTree>),
}

/// Bidirectional transmittance or reflectance distribution function (BTDF, BRDF) for light from one side.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Btdf {
    /// Regular transmittance: share of the incident flux that is transmitted undeviated; `None` if there is no regular
    /// transmission.
    pub regular: Option<AngularTransmittance>,
    /// Scattered light as luminance coefficients q \[1/sr\]; `None` if nothing is scattered.
    pub scattered: Option<Scattered>,
}

/// Emergent distribution for one incident direction ("indicatrix of diffusion"): the luminance coefficient q for every
/// emergent cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Indicatrix {
    /// Emergent cells, which contain reversed emergent directions ω′ = −ω_a.
    pub basis: RingBasis,
    /// Luminance coefficient q of each cell. \[1/sr\]
    pub q: Vec<f64>,
}

impl Btdf {
    /// Creates a function without regular transmission from patch-averaged data.
    pub fn from_cells(matrix: CellMatrix) -> Self {
        Self { regular: None, scattered: Some(Scattered::Cells(Box::new(matrix))) }
    }

    /// Returns the luminance coefficient q = L/E of the scattered part for an incident and an emergent direction.
    /// \[1/sr\]
    pub fn q(&self, incident: Incident, emergent: Emergent) -> f64 {
        match &self.scattered {
            None => 0.0,
            Some(Scattered::Lambert(tau)) => tau.at(incident.0.theta()) / std::f64::consts::PI,
            Some(Scattered::Cells(matrix)) => matrix.q(incident, emergent),
            Some(Scattered::Directions(data)) => data.q(incident, emergent),
            Some(Scattered::Tree(tree)) => tree.q(incident, emergent),
        }
    }

    /// Returns the directional-hemispherical transmittance τ(ω_e) for an incident direction (eq 1), regular
    /// transmission included.
    pub fn tau(&self, incident: Incident) -> f64 {
        let theta = incident.0.theta();
        let regular = self.regular.as_ref().map_or(0.0, |tau| tau.at(theta));
        let scattered = match &self.scattered {
            None => 0.0,
            Some(Scattered::Lambert(tau)) => tau.at(theta),
            Some(Scattered::Cells(matrix)) => matrix.tau(incident),
            Some(Scattered::Directions(data)) => data.tau(incident),
            Some(Scattered::Tree(tree)) => tree.tau(incident),
        };
        regular + scattered
    }

    /// Returns the directional-hemispherical transmittance at normal incidence, regular transmission included.
    pub fn tau_normal(&self) -> f64 {
        self.tau(Incident(crate::compute::direction::Dir::from_unit(glam::DVec3::Z)))
    }

    /// Returns the hemispherical transmittance, for light from a hemisphere of uniform luminance, regular transmission
    /// included.
    pub fn tau_hemispherical(&self) -> f64 {
        let regular = self.regular.as_ref().map_or(0.0, AngularTransmittance::hemispherical);
        let scattered = match &self.scattered {
            None => 0.0,
            Some(Scattered::Lambert(tau)) => tau.hemispherical(),
            Some(Scattered::Cells(matrix)) => matrix.tau_hemispherical(),
            Some(Scattered::Directions(data)) => data.tau_hemispherical(),
            Some(Scattered::Tree(tree)) => tree.tau_hemispherical(),
        };
        regular + scattered
    }

    /// Returns the basis of incident cells for listings of the data: that of the data, or the full Klems basis for
    /// functions without cells.
    pub fn incident_basis(&self) -> RingBasis {
        match &self.scattered {
            Some(Scattered::Cells(matrix)) => matrix.incident().clone(),
            Some(Scattered::Directions(data)) => data.lattice().cloned().unwrap_or_else(RingBasis::tregenza),
            Some(Scattered::Tree(tree)) => tree.incident_listing(),
            _ => RingBasis::klems_full(crate::compute::basis::AzimuthMap::KLEMS_FRONT),
        }
    }

    /// Returns the emergent distribution of scattered light for one incident direction; `None` if nothing is scattered.
    pub fn indicatrix(&self, incident: Incident) -> Option<Indicatrix> {
        Some(match self.scattered.as_ref()? {
            Scattered::Lambert(tau) => Indicatrix {
                basis: RingBasis::hemisphere(),
                q: vec![tau.at(incident.0.theta()) / std::f64::consts::PI],
            },
            Scattered::Cells(matrix) => Indicatrix {
                basis: matrix.emergent().clone(),
                q: matrix
                    .incident()
                    .index(incident.0)
                    .map_or_else(|| vec![0.0; matrix.emergent().len()], |i| matrix.row(i).into_owned()),
            },
            Scattered::Directions(data) => Indicatrix {
                basis: data.emergent().clone(),
                q: data
                    .standing_for(incident.0)
                    .map_or_else(|| vec![0.0; data.emergent().len()], |i| data.row(i).into_owned()),
            },
            Scattered::Tree(tree) => tree.indicatrix(incident),
        })
    }
}
