//! Scattering between the cells of two bases.

use super::rows::Rows;
use crate::compute::basis::RingBasis;
use crate::compute::direction::{Emergent, Incident};
use crate::compute::wavelet::{CompactError, CompactRows, Criterion};
use std::borrow::Cow;
use std::f64::consts::PI;
use std::sync::Arc;

/// q for every pair of an incident and an emergent cell, stored as one indicatrix after the other.
#[derive(Debug, Clone, PartialEq)]
pub struct CellMatrix {
    incident: RingBasis,
    emergent: RingBasis,
    rows: Rows,
    /// τ of each incident cell.
    tau: Vec<f64>,
}

impl CellMatrix {
    /// Creates a matrix from values in 1/sr, `values[i · emergent.len() + o]`, incident cell i, emergent cell o (by
    /// through direction). `None` when the count does not fit the bases.
    pub fn new(incident: RingBasis, emergent: RingBasis, values: Vec<f64>) -> Option<Self> {
        let fit = values.len() == incident.len() * emergent.len();
        fit.then(|| Rows::of(values)).and_then(|rows| Self::with_sums(incident, emergent, rows))
    }

    /// Creates a matrix like [`Self::new`], from values that were kept as f32.
    pub fn of_single(incident: RingBasis, emergent: RingBasis, values: Vec<f32>) -> Option<Self> {
        let fit = values.len() == incident.len() * emergent.len();
        fit.then(|| Rows::of_single(values)).and_then(|rows| Self::with_sums(incident, emergent, rows))
    }

    fn with_sums(incident: RingBasis, emergent: RingBasis, rows: Rows) -> Option<Self> {
        let tau = rows.sums(incident.len(), &emergent.projected_solid_angles());
        Some(Self { incident, emergent, rows, tau })
    }

    /// Creates a matrix from indicatrices in compact form, one per incident cell; they stay compact, and τ is what they
    /// keep. `None` when the count does not fit.
    pub fn from_compact(incident: RingBasis, rows: Arc<CompactRows>) -> Option<Self> {
        (rows.len() == incident.len()).then(|| {
            let tau = (0..rows.len()).map(|row| rows.tau(row)).collect();
            Self { incident, emergent: rows.basis().clone(), rows: Rows::Compact(rows), tau }
        })
    }

    /// Returns the data in compact form: τ is kept, everything else as well as the criterion says.
    ///
    /// # Errors
    /// Returns an error if the values have no compact form.
    pub fn compacted(&self, criterion: Criterion) -> Result<Self, CompactError> {
        let row = |i| self.row(i).into_owned();
        let rows = CompactRows::compress(&self.emergent, self.incident.len(), row, criterion)?;
        Ok(Self::from_compact(self.incident.clone(), Arc::new(rows)).expect("a row was made for every incident cell"))
    }

    /// Returns the incident cells.
    pub fn incident(&self) -> &RingBasis {
        &self.incident
    }

    /// Returns the emergent cells, by through direction.
    pub fn emergent(&self) -> &RingBasis {
        &self.emergent
    }

    /// Returns all values, one indicatrix after the other. \[1/sr\]
    pub fn values(&self) -> Cow<'_, [f64]> {
        self.rows.all()
    }

    /// Returns the indicatrix of one incident cell. \[1/sr\] It is made on request where the data are held in compact
    /// form.
    pub fn row(&self, incident: usize) -> Cow<'_, [f64]> {
        self.rows.row(incident, self.emergent.len())
    }

    /// Returns one value, by incident cell and emergent cell. \[1/sr\]
    pub fn value(&self, incident: usize, emergent: usize) -> f64 {
        self.rows.value(incident, emergent, self.emergent.len())
    }

    /// Returns the compact form, where the data are held in it.
    pub fn compact_rows(&self) -> Option<&Arc<CompactRows>> {
        self.rows.compact()
    }

    /// Returns the directional-hemispherical transmittance of every incident cell, in the basis's order.
    pub fn tau_by_cell(&self) -> &[f64] {
        &self.tau
    }

    /// Returns q of the cells that hold the two directions; 0 outside all cells. \[1/sr\]
    pub fn q(&self, incident: Incident, emergent: Emergent) -> f64 {
        match (self.incident.index(incident.0), self.emergent.index(emergent.through_name())) {
            (Some(i), Some(o)) => self.value(i, o),
            _ => 0.0,
        }
    }

    /// Returns the directional-hemispherical transmittance of the cell that holds the direction.
    pub fn tau(&self, incident: Incident) -> f64 {
        self.incident.index(incident.0).map_or(0.0, |i| self.tau[i])
    }

    /// Returns the transmittance for uniform luminance.
    pub fn tau_hemispherical(&self) -> f64 {
        self.incident.cells().zip(&self.tau).map(|(cell, tau)| cell.projected_solid_angle() * tau).sum::<f64>() / PI
    }

    /// Computes the luminance of every emergent cell from the illuminance that arrives through every incident cell (eq
    /// 12). \[cd/m²\]
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

    /// Returns the function for light in the opposite direction: q_back(ω′, ω_e) = q_front(ω_e, ω′), in through
    /// directions a plain transpose. The 180° rotation that files need lies in the bases' azimuth maps.
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
        assert!(clear.q(sun, Emergent::from_through_name(sun.0)) > 0.0);
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
