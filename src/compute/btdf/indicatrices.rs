//! Indicatrices measured (or computed) at single incident directions, as a goniophotometer gives them.
//!
//! Unlike a [`super::CellMatrix`], whose rows are means over incident cells, nothing is known here between the
//! directions: [`crate::compute::incidence`] interpolates there.

use super::CellMatrix;
use super::rows::Rows;
use crate::compute::basis::RingBasis;
use crate::compute::direction::{Dir, Emergent, Facade, Incident};
use crate::compute::wavelet::{CompactError, CompactRows, Criterion};
use std::borrow::Cow;
use std::f64::consts::PI;
use std::sync::Arc;

/// q at single incident directions, each on the same emergent cells.
#[derive(Debug, Clone, PartialEq)]
pub struct Indicatrices {
    incident: Vec<Incident>,
    lattice: Option<RingBasis>,
    emergent: RingBasis,
    rows: Rows,
    tau: Vec<f64>,
    /// Share of the projected hemisphere that each direction represents; sums to 1.
    share: Vec<f64>,
}

/// Distance up to which directions of a lattice and of a file are the same. \[rad\] Angles rounded to 0.1° are off by
/// up to 0.05° in θ and in φ, together 1.2e-3.
const SAME_DIRECTION: f64 = 2e-3;

impl Indicatrices {
    /// Creates indicatrices from values in 1/sr, `values[i · emergent.len() + o]`: incident direction i, emergent cell
    /// o (by through direction). `None` when the count does not fit, without directions, or when two directions
    /// coincide.
    pub fn new(incident: Vec<Incident>, emergent: RingBasis, values: Vec<f64>) -> Option<Self> {
        let fit = values.len() == incident.len() * emergent.len();
        fit.then(|| Rows::of(values)).and_then(|rows| Self::with_sums(incident, emergent, rows))
    }

    /// Creates indicatrices like [`Self::new`], from values that were kept as f32.
    pub fn of_single(incident: Vec<Incident>, emergent: RingBasis, values: Vec<f32>) -> Option<Self> {
        let fit = values.len() == incident.len() * emergent.len();
        fit.then(|| Rows::of_single(values)).and_then(|rows| Self::with_sums(incident, emergent, rows))
    }

    fn with_sums(incident: Vec<Incident>, emergent: RingBasis, rows: Rows) -> Option<Self> {
        let tau = rows.sums(incident.len(), &emergent.projected_solid_angles());
        Self::with_rows(incident, emergent, rows, tau)
    }

    /// Creates indicatrices from those in compact form, one per incident direction; they stay compact, and τ is what
    /// they keep. `None` when the count does not fit, without directions, or when two directions coincide.
    pub fn from_compact(incident: Vec<Incident>, rows: Arc<CompactRows>) -> Option<Self> {
        if rows.len() != incident.len() {
            return None;
        }
        let tau = (0..rows.len()).map(|row| rows.tau(row)).collect();
        Self::with_rows(incident, rows.basis().clone(), Rows::Compact(rows), tau)
    }

    /// Returns the data in compact form: τ is kept, everything else as well as the criterion says.
    ///
    /// # Errors
    /// Returns an error if the values have no compact form.
    pub fn compacted(&self, criterion: Criterion) -> Result<Self, CompactError> {
        let row = |i| self.row(i).into_owned();
        let rows = CompactRows::compress(&self.emergent, self.incident.len(), row, criterion)?;
        let tau = (0..rows.len()).map(|row| rows.tau(row)).collect();
        Ok(Self { rows: Rows::Compact(Arc::new(rows)), tau, ..self.clone() })
    }

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

    /// Returns the incident directions.
    pub fn incident(&self) -> &[Incident] {
        &self.incident
    }

    /// Returns the division of the hemisphere whose cell centres the incident directions are, in its order; `None` for
    /// other lists of directions.
    pub fn lattice(&self) -> Option<&RingBasis> {
        self.lattice.as_ref()
    }

    /// Returns the emergent cells, by through direction.
    pub fn emergent(&self) -> &RingBasis {
        &self.emergent
    }

    /// Returns the indicatrix of one incident direction. \[1/sr\] It is made on request where the data are held in
    /// compact form.
    pub fn row(&self, incident: usize) -> Cow<'_, [f64]> {
        self.rows.row(incident, self.emergent.len())
    }

    /// Returns the compact form, where the data are held in it.
    pub fn compact_rows(&self) -> Option<&Arc<CompactRows>> {
        self.rows.compact()
    }

    /// Returns the directional-hemispherical transmittance at every incident direction.
    pub fn tau_by_direction(&self) -> &[f64] {
        &self.tau
    }

    /// Returns the share of the projected hemisphere that each direction represents: of its lattice's cell, or nearest
    /// to it. Sums to 1.
    pub fn shares(&self) -> &[f64] {
        &self.share
    }

    /// Returns the index of the incident direction nearest to another.
    pub fn nearest(&self, d: Dir<Facade>) -> usize {
        nearest(&self.incident, d)
    }

    /// Returns the index of the incident direction that represents `d`: of the lattice's cell that holds it, else the
    /// nearest. `None` outside the hemisphere.
    pub fn standing_for(&self, d: Dir<Facade>) -> Option<usize> {
        match &self.lattice {
            Some(basis) => basis.index(d),
            None => (d.vector().z >= 0.0).then(|| self.nearest(d)),
        }
    }

    /// Returns the data as means over incident cells: of the lattice, or of cells of about 9° that take their nearest
    /// direction.
    pub fn to_cells(&self) -> CellMatrix {
        let incident = self.lattice.clone().unwrap_or_else(|| RingBasis::equal_area(10));
        let values = incident.cells().flat_map(|cell| {
            let i = self.standing_for(cell.centre()).expect("cells lie in the hemisphere");
            self.row(i).into_owned()
        });
        let values = values.collect();
        CellMatrix::new(incident, self.emergent.clone(), values).expect("a row was made for every cell")
    }

    /// Returns q without interpolation, of the direction that represents `incident`. \[1/sr\]
    pub fn q(&self, incident: Incident, emergent: Emergent) -> f64 {
        match (self.standing_for(incident.0), self.emergent.index(emergent.through_name())) {
            (Some(i), Some(o)) => self.rows.value(i, o, self.emergent.len()),
            _ => 0.0,
        }
    }

    /// Returns τ without interpolation, of the direction that represents `incident`.
    pub fn tau(&self, incident: Incident) -> f64 {
        self.standing_for(incident.0).map_or(0.0, |i| self.tau[i])
    }

    /// Returns the transmittance for uniform luminance, each direction representing its cell.
    pub fn tau_hemispherical(&self) -> f64 {
        self.share.iter().zip(&self.tau).map(|(share, tau)| share * tau).sum()
    }
}

/// Returns the chord between two directions, which is their angle while it is small. \[rad\]
fn chord(a: Dir<Facade>, b: Dir<Facade>) -> f64 {
    (a.vector() - b.vector()).length()
}

fn nearest(incident: &[Incident], d: Dir<Facade>) -> usize {
    let cosine = |i: usize| incident[i].0.vector().dot(d.vector());
    (1..incident.len()).fold(0, |best, i| if cosine(i) > cosine(best) { i } else { best })
}

/// Returns the share of the projected hemisphere nearest to each direction, counted on cells of about 2°.
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
