//! Differences between a candidate and a reference candidate, with their sign: of illuminances by sensor, and of
//! luminance coefficients and transmittances on common patches.

use crate::compute::basis::RingBasis;
use crate::compute::btdf::Btdf;
use crate::compute::direction::{Emergent, Incident};
use crate::compute::estimate::Estimate;
use crate::drawing::colours::{ColourMap, ColourScale};
use crate::drawing::hemisphere::Side;
use crate::drawing::ticks::fine_ceil;

/// Number of rings of the patches on which differences are taken; fine enough for Klems data and refinements of them.
const RINGS: usize = 24;

/// Returns the illuminances of a candidate minus those of the reference, sensor by sensor, with their errors added;
/// `None` if their sensors are not at the same positions. \[lx\]
pub fn of_rooms(
    [positions, base_positions]: [&[[f64; 3]]; 2],
    [room, base]: [&[Estimate]; 2],
) -> Option<Vec<Estimate>> {
    let near = |(a, b): (&[f64; 3], &[f64; 3])| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9);
    let same = positions.len() == base_positions.len() && positions.iter().zip(base_positions).all(near);
    same.then(|| {
        let less = |(a, b): (&Estimate, &Estimate)| Estimate::new(a.value - b.value, a.error + b.error);
        room.iter().zip(base).map(less).collect()
    })
}

/// Differences on patches of a hemisphere: of incident directions, or of emergent ones. An emergent patch is given by
/// the incident directions whose undeviated light leaves through it.
#[derive(Debug, Clone, PartialEq)]
pub struct OnCells {
    /// Basis of the hemisphere.
    pub basis: RingBasis,
    /// Difference at the centre of each patch, in the unit of the quantity.
    pub values: Vec<f64>,
}

/// Returns the luminance coefficients q of the light scattered from one incident direction, minus those of the
/// reference, on patches of the emergent hemisphere. \[1/sr\]
pub fn of_q(btdf: &Btdf, base: &Btdf, incident: Incident) -> OnCells {
    let basis = RingBasis::equal_area(RINGS);
    let at = |emergent: Emergent| btdf.q(incident, emergent) - base.q(incident, emergent);
    let values = basis.cells().map(|cell| at(Emergent::from_undeviated(cell.centre()))).collect();
    OnCells { basis, values }
}

/// Returns the transmittances τ on patches of the incident hemisphere, minus those of the reference.
pub fn of_tau(btdf: &Btdf, base: &Btdf) -> OnCells {
    let basis = RingBasis::equal_area(RINGS);
    let at = |incident: Incident| btdf.tau(incident) - base.tau(incident);
    let values = basis.cells().map(|cell| at(Incident(cell.centre()))).collect();
    OnCells { basis, values }
}

/// Differences between a candidate and the reference, with what a picture of them needs.
#[derive(Debug, Clone, PartialEq)]
pub enum Picture {
    /// Differences of illuminances at the sensors on a floor plan. \[lx\]
    Plan {
        /// Width and depth of the room. \[m\]
        room: [f64; 2],
        /// Number of sensors along x and y.
        count: [usize; 2],
        /// Differences, candidate minus reference, x running fastest; errors are the sums of both. \[lx\]
        values: Vec<Estimate>,
    },
    /// Differences of luminance coefficients by emergent direction \[1/sr\], or of transmittances by incident
    /// direction, on a disk.
    Disk {
        /// Hemisphere of the disk: emergent or incident.
        side: Side,
        /// Differences, candidate minus reference, on the patches of the hemisphere.
        cells: OnCells,
    },
}

impl Picture {
    /// Returns the largest absolute difference, in the unit of the quantity.
    pub fn reach(&self) -> f64 {
        let largest = |values: &mut dyn Iterator<Item = f64>| {
            values.map(f64::abs).filter(|value| value.is_finite()).fold(0.0, f64::max)
        };
        match self {
            Self::Plan { values, .. } => largest(&mut values.iter().map(|one| one.value)),
            Self::Disk { cells, .. } => largest(&mut cells.values.iter().copied()),
        }
    }

    /// Returns symbol and unit of the difference, such as "ΔE" and "lx".
    pub const fn quantity(&self) -> [&'static str; 2] {
        match self {
            Self::Plan { .. } => ["ΔE", "lx"],
            Self::Disk { side: Side::Emergent, .. } => ["Δq", "1/sr"],
            Self::Disk { side: Side::Incident, .. } => ["Δτ", ""],
        }
    }
}

/// Returns the colour scale for all pictures of differences of a quantity, symmetric about zero. `reach`: largest
/// absolute difference, in the unit of the quantity.
pub fn scale(reach: f64) -> ColourScale {
    let hi = fine_ceil(reach.max(1e-6));
    ColourScale { lo: -hi, hi, log: false, map: ColourMap::Diverging }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::direction::Dir;
    use std::f64::consts::PI;

    #[test]
    fn differences_have_their_sign_and_their_errors_add() {
        let (a, b) = (Btdf::ideal_diffuse(0.6), Btdf::ideal_diffuse(0.2));
        let incident = Incident(Dir::from_theta_phi(0.5, 1.0));
        let q = of_q(&a, &b, incident);
        assert!(q.values.len() == q.basis.len() && q.values.iter().all(|value| (value - 0.4 / PI).abs() < 1e-12));
        assert!(of_tau(&b, &a).values.iter().all(|value| (value + 0.4).abs() < 1e-12));
        let place = [[1.0, 2.0, 0.8]];
        let (room, base) = ([Estimate::new(100.0, 2.0)], [Estimate::new(130.0, 3.0)]);
        let found = of_rooms([&place, &place], [&room, &base]).unwrap();
        assert_eq!(found, [Estimate::new(-30.0, 5.0)]);
        assert_eq!(of_rooms([&place, &[[1.0, 2.0, 0.9]]], [&room, &base]), None);
    }
}
