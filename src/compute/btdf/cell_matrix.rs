//! Patch-averaged BTDF or BRDF: luminance coefficients between the cells of two bases.

use super::rows::Rows;
use crate::compute::basis::RingBasis;
use crate::compute::direction::{Emergent, Incident};
use crate::compute::wavelet::{CompactError, CompactRows, Criterion};
use std::borrow::Cow;
use std::f64::consts::PI;
use std::sync::Arc;

/// Patch-averaged BTDF or BRDF: the luminance coefficient q \[1/sr\] for every pair of an incident and an emergent
/// cell, stored by incident cell.
#[derive(Debug, Clone, PartialEq)]
pub struct CellMatrix {
    incident: RingBasis,
    emergent: RingBasis,
    rows: Rows,
    /// Directional-hemispherical transmittance τ of each incident cell.
    tau: Vec<f64>,
}

impl CellMatrix {
    /// Creates a matrix from the luminance coefficients `values[i · emergent.len() + o]` \[1/sr\] of incident cell i
    /// and emergent cell o; emergent cells contain reversed emergent directions. `None` if the number of values does
    /// not fit the bases.
    pub fn new(incident: RingBasis, emergent: RingBasis, values: Vec<f64>) -> Option<Self> {
        let fit = values.len() == incident.len() * emergent.len();
        fit.then(|| Rows::of(values)).and_then(|rows| Self::with_sums(incident, emergent, rows))
    }

    /// Creates a matrix like [`Self::new`] from luminance coefficients in single precision \[1/sr\]. `None` if the
    /// number of values does not fit the bases.
    pub fn of_single(incident: RingBasis, emergent: RingBasis, values: Vec<f32>) -> Option<Self> {
        let fit = values.len() == incident.len() * emergent.len();
        fit.then(|| Rows::of_single(values)).and_then(|rows| Self::with_sums(incident, emergent, rows))
    }

    fn with_sums(incident: RingBasis, emergent: RingBasis, rows: Rows) -> Option<Self> {
        let tau = rows.sums(incident.len(), &emergent.projected_solid_angles());
        Some(Self { incident, emergent, rows, tau })
    }

    /// Creates a matrix from indicatrices compressed by wavelets, one per incident cell; they remain compressed, with
    /// the exact τ stored in them. `None` if their number is not that of the incident cells.
    pub fn from_compact(incident: RingBasis, rows: Arc<CompactRows>) -> Option<Self> {
        (rows.len() == incident.len()).then(|| {
            let tau = (0..rows.len()).map(|row| rows.tau(row)).collect();
            Self { incident, emergent: rows.basis().clone(), rows: Rows::Compact(rows), tau }
        })
    }

    /// Returns the matrix compressed by wavelets: τ is exact, the errors of q are within `criterion`.
    ///
    /// # Errors
    /// Returns an error if the values cannot be compressed (negative or not finite, or too many cells) or the criterion
    /// is invalid.
    pub fn compacted(&self, criterion: Criterion) -> Result<Self, CompactError> {
        let row = |i| self.row(i).into_owned();
        let rows = CompactRows::compress(&self.emergent, self.incident.len(), row, criterion)?;
        Ok(Self::from_compact(self.incident.clone(), Arc::new(rows)).expect("a row was made for every incident cell"))
    }

    /// Returns the basis of the incident cells.
    pub fn incident(&self) -> &RingBasis {
        &self.incident
    }

    /// Returns the basis of the emergent cells, which contain reversed emergent directions ω′ = −ω_a.
    pub fn emergent(&self) -> &RingBasis {
        &self.emergent
    }

    /// Returns the luminance coefficients q of all pairs of cells, `[i · emergent.len() + o]`. \[1/sr\]
    pub fn values(&self) -> Cow<'_, [f64]> {
        self.rows.all()
    }

    /// Returns the luminance coefficients q of one incident cell (by index) for every emergent cell. \[1/sr\]
    /// Compressed data are restored for each call.
    pub fn row(&self, incident: usize) -> Cow<'_, [f64]> {
        self.rows.row(incident, self.emergent.len())
    }

    /// Returns the luminance coefficient q for an incident and an emergent cell, both by index. \[1/sr\]
    pub fn value(&self, incident: usize, emergent: usize) -> f64 {
        self.rows.value(incident, emergent, self.emergent.len())
    }

    /// Returns the indicatrices compressed by wavelets; `None` if the data are not compressed.
    pub fn compact_rows(&self) -> Option<&Arc<CompactRows>> {
        self.rows.compact()
    }

    /// Returns the directional-hemispherical transmittance of every incident cell, in the order of the basis.
    pub fn tau_by_cell(&self) -> &[f64] {
        &self.tau
    }

    /// Returns the luminance coefficient q of the cells that contain an incident and an emergent direction; 0 outside
    /// all cells. \[1/sr\]
    pub fn q(&self, incident: Incident, emergent: Emergent) -> f64 {
        match (self.incident.index(incident.0), self.emergent.index(emergent.undeviated_incident())) {
            (Some(i), Some(o)) => self.value(i, o),
            _ => 0.0,
        }
    }

    /// Returns the directional-hemispherical transmittance of the cell that contains an incident direction; 0 outside
    /// all cells.
    pub fn tau(&self, incident: Incident) -> f64 {
        self.incident.index(incident.0).map_or(0.0, |i| self.tau[i])
    }

    /// Returns the hemispherical transmittance, for light from a hemisphere of uniform luminance.
    pub fn tau_hemispherical(&self) -> f64 {
        self.incident.cells().zip(&self.tau).map(|(cell, tau)| cell.projected_solid_angle() * tau).sum::<f64>() / PI
    }

    /// Computes the luminance in every emergent cell from the illuminance \[lx\] of the system from every incident cell
    /// (eq 12). \[cd/m²\]
    pub fn luminance(&self, illuminance: &[f64]) -> Vec<f64> {
        assert_eq!(illuminance.len(), self.incident.len(), "one illuminance an incident cell");
        let mut luminance = vec![0.0; self.emergent.len()];
        for (i, &e) in illuminance.iter().enumerate() {
            if e != 0.0 {
                for (l, q) in luminance.iter_mut().zip(self.row(i).iter()) {
                    *l += q * e;
                }
            }
        }
        luminance
    }

    /// Returns the transmission of light in the opposite direction by reciprocity, q_back(ω′, ω_e) = q_front(ω_e, ω′):
    /// the transposed matrix, because emergent directions are stored reversed (ω′ = −ω_a). The 180° rotation of files
    /// is part of the azimuth conventions of the bases.
    pub fn reversed(&self) -> Self {
        let (n_in, n_out) = (self.incident.len(), self.emergent.len());
        let given = self.values();
        let mut values = vec![0.0; given.len()];
        for i in 0..n_in {
            for o in 0..n_out {
                values[o * n_in + i] = given[i * n_out + o];
            }
        }
        Self::new(self.emergent.clone(), self.incident.clone(), values).expect("a transpose has as many values")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::AzimuthMap;
    use crate::compute::direction::Dir;

    #[test]
    fn a_diagonal_matrix_sends_light_straight_on() {
        let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
        let weight = basis.projected_solid_angles();
        let n = basis.len();
        let mut values = vec![0.0; n * n];
        for k in 0..n {
            values[k * n + k] = 1.0 / weight[k];
        }
        let clear = CellMatrix::new(basis.clone(), basis.clone(), values).unwrap();
        assert!(clear.tau_by_cell().iter().all(|tau| (tau - 1.0).abs() < 1e-12));
        assert!((clear.tau_hemispherical() - 1.0).abs() < 1e-12);
        let sun = Incident(Dir::from_theta_phi(0.7, 1.1));
        assert!(clear.q(sun, Emergent::from_undeviated(sun.0)) > 0.0);
        // Uniform luminance stays uniform.
        let e: Vec<f64> = weight.iter().map(|w| 1000.0 * w).collect();
        assert!(clear.luminance(&e).iter().all(|l| (l - 1000.0).abs() < 1e-9));
        assert_eq!(clear.reversed().reversed(), clear);
    }

    #[test]
    fn a_wrong_count_is_refused() {
        let b = RingBasis::klems_quarter(AzimuthMap::FACADE);
        assert!(CellMatrix::new(b.clone(), b, vec![0.0; 1680]).is_none());
    }
}
