//! Ring bases: the hemisphere divided into rings about the normal and each ring into equal azimuth sectors.
//!
//! The weight of a cell is its projected solid angle ∫cosθ dω, never Ω·cosθ at the centre, so that the weights of every
//! complete basis add up to exactly π.

use crate::compute::angle::wrap_two_pi;
use crate::compute::direction::{Dir, Facade};
use std::f64::consts::PI;

/// Conversion from the azimuths φ_own of a basis to those of the façade frame: φ_F = `sign` · φ_own + `offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AzimuthMap {
    /// Sense of rotation of the basis's azimuths relative to the façade frame, +1 or −1.
    pub sign: f64,
    /// Azimuth in the façade frame of the basis's azimuth 0. \[rad\]
    pub offset: f64,
}

impl AzimuthMap {
    /// Azimuths of the façade frame itself: counter-clockwise seen from outside, 0 = right. Definition of the frame,
    /// see [`crate::compute::direction`].
    pub const FACADE: Self = Self { sign: 1.0, offset: 0.0 };
    /// Klems azimuths for light from outside: azimuth of the direction of propagation seen from the room (0 = right, 90
    /// = up); the direction of undeviated light (reversed direction of propagation) has φ_F = −φ_Klems. Convention of
    /// WINDOW and Radiance, whose BSDF frame has x to the right, y up and z into the room.
    pub const KLEMS_FRONT: Self = Self { sign: -1.0, offset: 0.0 };
    /// Klems azimuths for light from inside: azimuth of the direction of propagation seen from the room, φ_F = 180° −
    /// φ_Klems. Convention of WINDOW and Radiance.
    pub const KLEMS_BACK: Self = Self { sign: -1.0, offset: PI };

    /// Returns the azimuth in the façade frame of an azimuth `own` of the basis, 0 ≤ φ < 2π. \[rad\]
    pub fn facade_phi(self, own: f64) -> f64 {
        wrap_two_pi(self.sign * own + self.offset)
    }

    /// Returns the azimuth of the basis for an azimuth of the façade frame, 0 ≤ φ < 2π. \[rad\]
    pub fn own_phi(self, facade: f64) -> f64 {
        wrap_two_pi(self.sign * (facade - self.offset))
    }
}

/// Ring of a basis: all directions between two polar angles, divided into equal azimuth sectors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
    /// Polar angle of the ring's inner border, from the normal. \[rad\]
    pub theta_min: f64,
    /// Polar angle of the ring's outer border, from the normal. \[rad\]
    pub theta_max: f64,
    /// Number of equal azimuth sectors of the ring, at least 1.
    pub sectors: usize,
    /// Azimuth of the first sector's centre in the azimuths of the basis. \[rad\]
    pub first_phi: f64,
}

/// Cell of a ring basis: the directions between two polar angles within one azimuth sector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    /// Polar angle of the cell's inner border, from the normal. \[rad\]
    pub theta_min: f64,
    /// Polar angle of the cell's outer border, from the normal. \[rad\]
    pub theta_max: f64,
    /// Azimuth of the cell's centre in the azimuths of the basis. \[rad\]
    pub phi_own: f64,
    /// Azimuth of the cell's centre in the façade frame. \[rad\]
    pub phi: f64,
    /// Width of the cell in azimuth. \[rad\]
    pub width: f64,
}

impl Cell {
    /// Returns the projected solid angle ∫cosθ dω of the cell. \[sr\]
    pub fn projected_solid_angle(&self) -> f64 {
        // sin²b − sin²a = sin(b−a)·sin(b+a), without cancellation for thin rings.
        0.5 * self.width * (self.theta_max - self.theta_min).sin() * (self.theta_max + self.theta_min).sin()
    }

    /// Returns the solid angle of the cell. \[sr\]
    pub fn solid_angle(&self) -> f64 {
        // cos a − cos b = 2 sin((a+b)/2) sin((b−a)/2)
        2.0 * self.width
            * (0.5 * (self.theta_max + self.theta_min)).sin()
            * (0.5 * (self.theta_max - self.theta_min)).sin()
    }

    /// Returns the polar angle of the cell's centre: 0 for a cap around the normal, otherwise the middle of the ring.
    /// \[rad\]
    pub fn theta(&self) -> f64 {
        if self.is_cap() { 0.0 } else { 0.5 * (self.theta_min + self.theta_max) }
    }

    /// Returns the direction of the cell's centre in the façade frame. For emergent cells it is the direction of
    /// undeviated light, the reversed emergent direction.
    pub fn centre(&self) -> Dir<Facade> {
        Dir::from_theta_phi(self.theta(), self.phi)
    }

    /// Whether the cell is a cap around the normal, with the full azimuth.
    pub fn is_cap(&self) -> bool {
        self.theta_min == 0.0 && self.width > 1.99 * PI
    }
}

/// Error of a list of rings that does not divide the hemisphere.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BasisError {
    /// Empty list of rings.
    #[error("the basis has no rings")]
    Empty,
    /// Polar angles outside 0 … 90° or not rising, or rings that overlap.
    #[error("ring {ring}: polar angles {from}° to {to}° do not rise within 0…90° after the ring before")]
    Limits {
        /// Index of the ring, from 0.
        ring: usize,
        /// Inner polar angle of the ring. \[°\]
        from: f64,
        /// Outer polar angle of the ring. \[°\]
        to: f64,
    },
    /// Number of azimuth sectors of a ring that is 0 or above 7200.
    #[error("ring {ring}: {sectors} azimuth sectors (allowed: 1 to 7200)")]
    Sectors {
        /// Index of the ring, from 0.
        ring: usize,
        /// Number of sectors of the ring.
        sectors: usize,
    },
}

/// Basis of cells: the hemisphere divided into rings of equal azimuth sectors. Cells are numbered ring by ring, within
/// a ring by rising azimuth of the basis.
#[derive(Debug, Clone, PartialEq)]
pub struct RingBasis {
    name: String,
    rings: Vec<Ring>,
    first_cell: Vec<usize>,
    azimuth: AzimuthMap,
    /// Whether rings run from the normal outwards (θ rising); otherwise from the most grazing ring inwards, like
    /// Tregenza's rows.
    outwards: bool,
}

impl RingBasis {
    /// Creates a basis from rings in the order of their cells, θ rising or falling throughout. Gaps between rings are
    /// allowed (data are 0 there).
    ///
    /// # Errors
    /// Returns an error if there are no rings, if polar angles leave 0 … 90° or overlap, or if a ring has 0 or more
    /// than 7200 sectors.
    pub fn new(name: impl Into<String>, rings: Vec<Ring>, azimuth: AzimuthMap) -> Result<Self, BasisError> {
        let (Some(first), Some(last)) = (rings.first(), rings.last()) else {
            return Err(BasisError::Empty);
        };
        let outwards = first.theta_min <= last.theta_min;
        // Overlap of two rings, or excess over 90°, that counts as rounding. [rad] Well above that of degrees converted
        // to radians (2⁻⁵² · π/2 ≈ 3.5e-16), well below the digits of angles in files.
        const SLACK: f64 = 1e-9;
        let mut reached = 0.0;
        let order: Box<dyn Iterator<Item = usize>> =
            if outwards { Box::new(0..rings.len()) } else { Box::new((0..rings.len()).rev()) };
        for index in order {
            let ring = &rings[index];
            let rising = ring.theta_min >= reached - SLACK
                && ring.theta_max > ring.theta_min
                && ring.theta_max <= PI / 2.0 + SLACK;
            if !rising {
                return Err(BasisError::Limits {
                    ring: index,
                    from: ring.theta_min.to_degrees(),
                    to: ring.theta_max.to_degrees(),
                });
            }
            if ring.sectors == 0 || ring.sectors > 7200 {
                return Err(BasisError::Sectors { ring: index, sectors: ring.sectors });
            }
            reached = ring.theta_max;
        }
        let mut first_cell = vec![0];
        for ring in &rings {
            first_cell.push(first_cell[first_cell.len() - 1] + ring.sectors);
        }
        Ok(Self { name: name.into(), rings, first_cell, azimuth, outwards })
    }

    fn from_limits(name: &str, limits_deg: &[f64], counts: &[usize], azimuth: AzimuthMap) -> Self {
        let rings = limits_deg
            .windows(2)
            .zip(counts)
            .map(|(limit, &sectors)| Ring {
                theta_min: limit[0].to_radians(),
                theta_max: limit[1].to_radians(),
                sectors,
                first_phi: 0.0,
            })
            .collect();
        Self::new(name, rings, azimuth).expect("the tables of this file are divisions of the hemisphere")
    }

    /// Creates the LBNL/Klems Full basis of 145 cells with the given azimuth convention.
    pub fn klems_full(azimuth: AzimuthMap) -> Self {
        Self::from_limits(
            "LBNL/Klems Full",
            &[0.0, 5.0, 15.0, 25.0, 35.0, 45.0, 55.0, 65.0, 75.0, 90.0],
            &[1, 8, 16, 20, 24, 24, 24, 16, 12],
            azimuth,
        )
    }

    /// Creates the LBNL/Klems Half basis of 73 cells with the given azimuth convention.
    pub fn klems_half(azimuth: AzimuthMap) -> Self {
        Self::from_limits(
            "LBNL/Klems Half",
            &[0.0, 6.5, 19.5, 32.5, 46.5, 61.5, 76.5, 90.0],
            &[1, 8, 12, 16, 20, 12, 4],
            azimuth,
        )
    }

    /// Creates the LBNL/Klems Quarter basis of 41 cells with the given azimuth convention.
    pub fn klems_quarter(azimuth: AzimuthMap) -> Self {
        Self::from_limits("LBNL/Klems Quarter", &[0.0, 9.0, 27.0, 46.0, 66.0, 90.0], &[1, 8, 12, 12, 8], azimuth)
    }

    /// Creates Tregenza's 145 patches as a basis about the façade's normal: rows at θ = 84, 72, …, 12°, the most
    /// grazing first, then a cap around the normal; rows are 12° high, the cap has a radius of 6°.
    pub fn tregenza() -> Self {
        Self::from_limits_falling(
            "Tregenza 145",
            &[90.0, 78.0, 66.0, 54.0, 42.0, 30.0, 18.0, 6.0, 0.0],
            &[30, 30, 24, 24, 18, 12, 6, 1],
        )
    }

    fn from_limits_falling(name: &str, limits_deg: &[f64], counts: &[usize]) -> Self {
        let rings = limits_deg
            .windows(2)
            .zip(counts)
            .map(|(limit, &sectors)| Ring {
                theta_min: limit[1].to_radians(),
                theta_max: limit[0].to_radians(),
                sectors,
                first_phi: 0.0,
            })
            .collect();
        Self::new(name, rings, AzimuthMap::FACADE).expect("the tables of this file are divisions of the hemisphere")
    }

    /// Creates a basis of cells of equal projected solid angle: sinθ in steps of 1/`rings`, ring i (from 1) with 8i − 4
    /// sectors. These are the cells of a (2·`rings`)² grid on the square that Shirley and Chiu map to the disk, with
    /// straightened azimuth borders.
    pub fn equal_area(rings: usize) -> Self {
        let list = (1..=rings)
            .map(|i| {
                let sectors = 8 * i - 4;
                Ring {
                    theta_min: ((i - 1) as f64 / rings as f64).asin(),
                    theta_max: (i as f64 / rings as f64).min(1.0).asin(),
                    sectors,
                    first_phi: PI / sectors as f64,
                }
            })
            .collect();
        Self::new(format!("equal-area {}", 4 * rings * rings), list, AzimuthMap::FACADE)
            .expect("sines in equal steps rise from 0 to 1")
    }

    /// Creates a basis of rings of about `step` \[rad\] (a whole number of them) with cells about as wide as high, and
    /// a cap at the normal. The number of sectors is a multiple of four, so that the basis is symmetric up and down,
    /// left and right.
    pub fn even(step: f64) -> Self {
        let rings = ((0.5 * PI / step).round() as usize).clamp(1, 900);
        let step = 0.5 * PI / rings as f64;
        let list = (0..rings)
            .map(|k| {
                let sine = ((k as f64 + 0.5) * step).sin();
                let sectors = if k == 0 { 1 } else { 4 * ((0.5 * PI * sine / step).round() as usize).max(1) };
                Ring { theta_min: k as f64 * step, theta_max: (k + 1) as f64 * step, sectors, first_phi: 0.0 }
            })
            .collect();
        Self::new(format!("even {:.3}°", step.to_degrees()), list, AzimuthMap::FACADE).expect("rings in equal steps")
    }

    /// Creates a basis of a single cell, the whole hemisphere.
    pub fn hemisphere() -> Self {
        Self::from_limits("hemisphere", &[0.0, 90.0], &[1], AzimuthMap::FACADE)
    }

    /// Returns a finer basis with every cell divided into `parts` × `parts`: rings in equal steps of θ, sectors in
    /// equal parts. A cap that is one cell is given four sectors per part, so that its parts are about as wide as high.
    pub fn refined(&self, parts: usize) -> Self {
        let cut = |ring: &Ring| {
            let step = (ring.theta_max - ring.theta_min) / parts as f64;
            let sectors = if ring.sectors == 1 { 4 * parts } else { ring.sectors * parts };
            let (coarse, fine) = (2.0 * PI / ring.sectors as f64, 2.0 * PI / sectors as f64);
            let (theta, first_phi) = (ring.theta_min, ring.first_phi - 0.5 * coarse + 0.5 * fine);
            let part = move |k: usize| Ring {
                theta_min: theta + k as f64 * step,
                theta_max: theta + (k + 1) as f64 * step,
                sectors,
                first_phi,
            };
            let order: Vec<usize> = if self.outwards { (0..parts).collect() } else { (0..parts).rev().collect() };
            order.into_iter().map(part).collect::<Vec<_>>()
        };
        let rings = self.rings.iter().flat_map(cut).collect();
        Self::new(format!("{} / {parts}²", self.name), rings, self.azimuth).expect("parts of rings rise as these do")
    }

    /// Returns the name of the basis as written in files, e.g. `LBNL/Klems Full`.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the rings in the order of the cells.
    pub fn rings(&self) -> &[Ring] {
        &self.rings
    }

    /// Returns the conversion from the azimuths of the basis to those of the façade frame.
    pub fn azimuth(&self) -> AzimuthMap {
        self.azimuth
    }

    /// Returns the basis with the same rings and another azimuth convention.
    pub fn with_azimuth(mut self, azimuth: AzimuthMap) -> Self {
        self.azimuth = azimuth;
        self
    }

    /// Returns the number of cells of the basis.
    pub fn len(&self) -> usize {
        self.first_cell[self.rings.len()]
    }

    /// Whether the basis has no cells; always `false` for a valid basis.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the index of the first cell of the ring with index `ring`.
    pub fn first_cell(&self, ring: usize) -> usize {
        self.first_cell[ring]
    }

    /// Returns the cell with this index. Panics if there is none.
    pub fn cell(&self, index: usize) -> Cell {
        let ring_index = self.first_cell.partition_point(|&first| first <= index) - 1;
        let ring = &self.rings[ring_index];
        let width = 2.0 * PI / ring.sectors as f64;
        let phi_own = wrap_two_pi(ring.first_phi + (index - self.first_cell[ring_index]) as f64 * width);
        Cell {
            theta_min: ring.theta_min,
            theta_max: ring.theta_max,
            phi_own,
            phi: self.azimuth.facade_phi(phi_own),
            width,
        }
    }

    /// Returns all cells of the basis in order.
    pub fn cells(&self) -> impl Iterator<Item = Cell> + '_ {
        (0..self.len()).map(|index| self.cell(index))
    }

    /// Returns the projected solid angles ∫cosθ dω of all cells, in order. \[sr\]
    pub fn projected_solid_angles(&self) -> Vec<f64> {
        // The same for all cells of a ring.
        let rings = self.rings.iter().zip(&self.first_cell);
        rings
            .flat_map(|(ring, first)| std::iter::repeat_n(self.cell(*first).projected_solid_angle(), ring.sectors))
            .collect()
    }

    /// Returns the index of the cell that contains a direction of the façade frame; for emergent cells it is the
    /// direction of undeviated light, the reversed emergent direction. Borders belong to the cell with the larger θ and
    /// the larger azimuth of the basis; `None` for directions with z < 0 and in gaps between rings.
    pub fn index(&self, d: Dir<Facade>) -> Option<usize> {
        let theta = d.theta();
        if theta > PI / 2.0 + 1e-12 {
            return None;
        }
        let theta = theta.min(PI / 2.0);
        let ring_index = self.rings.iter().position(|ring| {
            theta >= ring.theta_min && (theta < ring.theta_max || ring.theta_max >= PI / 2.0 - 1e-9)
        })?;
        let ring = &self.rings[ring_index];
        let width = 2.0 * PI / ring.sectors as f64;
        let turned = wrap_two_pi(self.azimuth.own_phi(d.phi()) - ring.first_phi + 0.5 * width);
        let sector = ((turned / width) as usize).min(ring.sectors - 1);
        Some(self.first_cell[ring_index] + sector)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> Vec<RingBasis> {
        vec![
            RingBasis::klems_full(AzimuthMap::KLEMS_FRONT),
            RingBasis::klems_half(AzimuthMap::KLEMS_BACK),
            RingBasis::klems_quarter(AzimuthMap::FACADE),
            RingBasis::tregenza(),
            RingBasis::equal_area(8),
            RingBasis::hemisphere(),
        ]
    }

    #[test]
    fn projected_solid_angles_sum_to_pi() {
        for basis in all() {
            let sum: f64 = basis.projected_solid_angles().iter().sum();
            assert!((sum - PI).abs() < 1e-13, "{}: {sum}", basis.name());
            let solid: f64 = basis.cells().map(|cell| cell.solid_angle()).sum();
            assert!((solid - 2.0 * PI).abs() < 1e-13, "{}: {solid}", basis.name());
        }
    }

    #[test]
    fn a_cell_holds_its_own_centre() {
        for basis in all() {
            for index in 0..basis.len() {
                assert_eq!(basis.index(basis.cell(index).centre()), Some(index), "{} {index}", basis.name());
            }
        }
    }

    #[test]
    fn klems_front_counts_the_travelling_light_seen_from_the_room() {
        // Light from above outside travels downwards: Klems azimuth 270.
        let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
        let from_above = Dir::from_theta_phi(40_f64.to_radians(), 90_f64.to_radians());
        let cell = basis.cell(basis.index(from_above).unwrap());
        assert!((cell.phi_own.to_degrees() - 270.0).abs() < 1e-9);
    }

    #[test]
    fn equal_area_cells_are_equal() {
        let basis = RingBasis::equal_area(5);
        for weight in basis.projected_solid_angles() {
            assert!((weight - PI / 100.0).abs() < 1e-14);
        }
    }

    #[test]
    fn refined_cells_lie_in_their_own() {
        for basis in all().into_iter().filter(|basis| basis.len() > 1) {
            let fine = basis.refined(3);
            let mut sums = vec![0.0; basis.len()];
            for cell in fine.cells() {
                sums[basis.index(cell.centre()).unwrap()] += cell.projected_solid_angle();
            }
            for (sum, weight) in sums.iter().zip(basis.projected_solid_angles()) {
                assert!((sum - weight).abs() < 1e-12, "{}", basis.name());
            }
        }
    }

    #[test]
    fn refuses_what_does_not_rise() {
        let ring = |a: f64, b: f64| Ring { theta_min: a, theta_max: b, sectors: 4, first_phi: 0.0 };
        assert!(RingBasis::new("x", vec![], AzimuthMap::FACADE).is_err());
        assert!(RingBasis::new("x", vec![ring(0.0, 0.5), ring(0.4, 1.0)], AzimuthMap::FACADE).is_err());
        assert!(RingBasis::new("x", vec![ring(0.0, 1.7)], AzimuthMap::FACADE).is_err());
        let none = Ring { sectors: 0, ..ring(0.0, 1.0) };
        assert!(RingBasis::new("x", vec![none], AzimuthMap::FACADE).is_err());
    }
}
