//! BTDF data at single incident directions: indicatrices (q over the emergent directions) as measured by a
//! goniophotometer.
//!
//! Unlike the rows of a [`super::CellMatrix`], which are means over incident cells, the indicatrices hold for single
//! directions; [`crate::compute::incidence`] interpolates between them.

use super::CellMatrix;
use super::rows::Rows;
use crate::compute::basis::RingBasis;
use crate::compute::direction::{Dir, Emergent, Facade, Incident};
use crate::compute::wavelet::{CompactError, CompactRows, Criterion};
use std::borrow::Cow;
use std::f64::consts::PI;
use std::sync::Arc;

/// BTDF or BRDF given by indicatrices at single incident directions: luminance coefficients q \[1/sr\] on the same
/// emergent cells for each.
#[derive(Debug, Clone, PartialEq)]
pub struct Indicatrices {
    incident: Vec<Incident>,
    lattice: Option<RingBasis>,
    emergent: RingBasis,
    rows: Rows,
    tau: Vec<f64>,
    /// Share of the projected hemisphere that each incident direction represents; the shares add up to 1.
    share: Vec<f64>,
}

/// Angular distance up to which directions of a standard basis and of a file count as the same. \[rad\] Angles rounded
/// to 0.1° are off by up to 0.05° in θ and in φ, together 1.2e-3.
const SAME_DIRECTION: f64 = 2e-3;

impl Indicatrices {
    /// Creates indicatrices from the luminance coefficients `values[i · emergent.len() + o]` \[1/sr\] of incident
    /// direction i and emergent cell o; emergent cells contain reversed emergent directions. `None` if the number of
    /// values does not fit, without directions, or if two directions coincide.
    pub fn new(incident: Vec<Incident>, emergent: RingBasis, values: Vec<f64>) -> Option<Self> {
        let fit = values.len() == incident.len() * emergent.len();
        fit.then(|| Rows::of(values)).and_then(|rows| Self::with_sums(incident, emergent, rows))
    }

    /// Creates indicatrices like [`Self::new`] from luminance coefficients in single precision \[1/sr\]. `None` if the
    /// number of values does not fit, without directions, or if two directions coincide.
    pub fn of_single(incident: Vec<Incident>, emergent: RingBasis, values: Vec<f32>) -> Option<Self> {
        let fit = values.len() == incident.len() * emergent.len();
        fit.then(|| Rows::of_single(values)).and_then(|rows| Self::with_sums(incident, emergent, rows))
    }

    fn with_sums(incident: Vec<Incident>, emergent: RingBasis, rows: Rows) -> Option<Self> {
        let tau = rows.sums(incident.len(), &emergent.projected_solid_angles());
        Self::with_rows(incident, emergent, rows, tau)
    }

    /// Creates indicatrices from those compressed by wavelets, one per incident direction; they remain compressed, with
    /// the exact τ stored in them. `None` if their number does not fit, without directions, or if two directions
    /// coincide.
    pub fn from_compact(incident: Vec<Incident>, rows: Arc<CompactRows>) -> Option<Self> {
        if rows.len() != incident.len() {
            return None;
        }
        let tau = (0..rows.len()).map(|row| rows.tau(row)).collect();
        Self::with_rows(incident, rows.basis().clone(), Rows::Compact(rows), tau)
    }

    /// Returns the indicatrices compressed by wavelets: τ is exact, the errors of q are within `criterion`.
    ///
    /// # Errors
    /// Returns an error if the values cannot be compressed (negative or not finite, or too many cells) or the criterion
    /// is invalid.
    pub fn compacted(&self, criterion: Criterion) -> Result<Self, CompactError> {
        let row = |i| self.row(i).into_owned();
        let rows = CompactRows::compress(&self.emergent, self.incident.len(), row, criterion)?;
        let tau = (0..rows.len()).map(|row| rows.tau(row)).collect();
        Ok(Self { rows: Rows::Compact(Arc::new(rows)), tau, ..self.clone() })
    }

    /// Creates the data from their rows and the transmittance of every row. `None` if there is no incident direction or
    /// two of them coincide.
    fn with_rows(incident: Vec<Incident>, emergent: RingBasis, rows: Rows, tau: Vec<f64>) -> Option<Self> {
        if incident.is_empty() {
            return None;
        }
        let twins = (0..incident.len()).any(|i| (0..i).any(|j| chord(incident[i].0, incident[j].0) < SAME_DIRECTION));
        if twins {
            return None;
        }
        let lattice = [RingBasis::tregenza(), RingBasis::klems_full(crate::compute::basis::AzimuthMap::KLEMS_FRONT)]
            .into_iter()
            .find(|basis| {
                basis.len() == incident.len()
                    && basis.cells().zip(&incident).all(|(cell, d)| chord(cell.centre(), d.0) < SAME_DIRECTION)
            });
        let share = lattice.as_ref().map_or_else(
            || nearest_shares(&incident),
            |basis| basis.projected_solid_angles().iter().map(|w| w / PI).collect(),
        );
        Some(Self { incident, lattice, emergent, rows, tau, share })
    }

    /// Returns the incident directions of the data.
    pub fn incident(&self) -> &[Incident] {
        &self.incident
    }

    /// Returns the standard basis (Tregenza or Klems) whose cell centres are the incident directions, in its order;
    /// `None` for other lists of directions.
    pub fn lattice(&self) -> Option<&RingBasis> {
        self.lattice.as_ref()
    }

    /// Returns the basis of the emergent cells, which contain reversed emergent directions ω′ = −ω_a.
    pub fn emergent(&self) -> &RingBasis {
        &self.emergent
    }

    /// Returns the indicatrix of one incident direction (by index): q for every emergent cell. \[1/sr\] Compressed data
    /// are restored for each call.
    pub fn row(&self, incident: usize) -> Cow<'_, [f64]> {
        self.rows.row(incident, self.emergent.len())
    }

    /// Returns the indicatrices compressed by wavelets; `None` if the data are not compressed.
    pub fn compact_rows(&self) -> Option<&Arc<CompactRows>> {
        self.rows.compact()
    }

    /// Returns the directional-hemispherical transmittance at every incident direction.
    pub fn tau_by_direction(&self) -> &[f64] {
        &self.tau
    }

    /// Returns the share of the projected hemisphere that each incident direction represents: that of its cell in the
    /// standard basis, or of all directions nearest to it. The shares add up to 1.
    pub fn shares(&self) -> &[f64] {
        &self.share
    }

    /// Returns the index of the incident direction of the data that is nearest to `d`.
    pub fn nearest(&self, d: Dir<Facade>) -> usize {
        nearest(&self.incident, d)
    }

    /// Returns the index of the incident direction of the data that represents `d`: that of the cell of the standard
    /// basis that contains `d`, otherwise the nearest. `None` for z < 0.
    pub fn standing_for(&self, d: Dir<Facade>) -> Option<usize> {
        match &self.lattice {
            Some(basis) => basis.index(d),
            None => (d.vector().z >= 0.0).then(|| self.nearest(d)),
        }
    }

    /// Returns the data as patch-averaged data: on the incident cells of the standard basis, or on cells of about 9°
    /// that are given the indicatrix of the nearest direction.
    pub fn to_cells(&self) -> CellMatrix {
        let incident = self.lattice.clone().unwrap_or_else(|| RingBasis::equal_area(10));
        let values = incident.cells().flat_map(|cell| {
            let i = self.standing_for(cell.centre()).expect("cells lie in the hemisphere");
            self.row(i).into_owned()
        });
        let values = values.collect();
        CellMatrix::new(incident, self.emergent.clone(), values).expect("a row was made for every cell")
    }

    /// Returns the luminance coefficient q without interpolation, of the incident direction of the data that represents
    /// `incident`. \[1/sr\]
    pub fn q(&self, incident: Incident, emergent: Emergent) -> f64 {
        match (self.standing_for(incident.0), self.emergent.index(emergent.undeviated_incident())) {
            (Some(i), Some(o)) => self.rows.value(i, o, self.emergent.len()),
            _ => 0.0,
        }
    }

    /// Returns the directional-hemispherical transmittance τ without interpolation, of the incident direction of the
    /// data that represents `incident`.
    pub fn tau(&self, incident: Incident) -> f64 {
        self.standing_for(incident.0).map_or(0.0, |i| self.tau[i])
    }

    /// Returns the hemispherical transmittance, for light from a hemisphere of uniform luminance; each incident
    /// direction represents its cell.
    pub fn tau_hemispherical(&self) -> f64 {
        self.share.iter().zip(&self.tau).map(|(share, tau)| share * tau).sum()
    }
}

/// Returns the chord between two directions on the unit sphere, which equals a small angle between them. \[rad\]
fn chord(a: Dir<Facade>, b: Dir<Facade>) -> f64 {
    (a.vector() - b.vector()).length()
}

fn nearest(incident: &[Incident], d: Dir<Facade>) -> usize {
    let cosine = |i: usize| incident[i].0.vector().dot(d.vector());
    (1..incident.len()).fold(0, |best, i| if cosine(i) > cosine(best) { i } else { best })
}

/// Returns, for each incident direction, the share of the projected hemisphere that is nearest to it, counted on cells
/// of about 2°.
fn nearest_shares(incident: &[Incident]) -> Vec<f64> {
    let basis = RingBasis::equal_area(40);
    let mut share = vec![0.0; incident.len()];
    for cell in basis.cells() {
        share[nearest(incident, cell.centre())] += 1.0 / basis.len() as f64;
    }
    share
}

#[cfg(test)]
mod tests {
    use super::*;

    fn opal(incident: Vec<Incident>) -> Option<Indicatrices> {
        let emergent = RingBasis::equal_area(6);
        let values = vec![0.5 / PI; incident.len() * emergent.len()];
        Indicatrices::new(incident, emergent, values)
    }

    #[test]
    fn the_lattice_is_recognised_by_its_directions_not_by_its_count() {
        let centres: Vec<Incident> = RingBasis::tregenza().cells().map(|cell| Incident(cell.centre())).collect();
        let data = opal(centres.clone()).unwrap();
        assert_eq!(data.lattice().unwrap().name(), "Tregenza 145");
        assert!((data.tau_hemispherical() - 0.5).abs() < 1e-12);
        assert!(data.tau_by_direction().iter().all(|tau| (tau - 0.5).abs() < 1e-12));
        let reversed = opal(centres.into_iter().rev().collect()).unwrap();
        assert!(reversed.lattice().is_none());
        assert!((reversed.tau_hemispherical() - 0.5).abs() < 1e-12);
    }

    #[test]
    fn twice_the_same_direction_is_refused() {
        let d = Incident(Dir::from_theta_phi(0.3, 0.2));
        assert!(opal(vec![d, Incident(Dir::from_theta_phi(0.8, 0.2)), d]).is_none());
        assert!(opal(vec![]).is_none());
    }
}
