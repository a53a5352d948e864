//! Incident directions that a declared symmetry adds: the images of measured ones.
//!
//! A symmetric system has q(gω_e, gω′) = q(ω_e, ω′) for a mirroring or rotation g about the normal. Stored directions
//! are mirrored and rotated like directions of the file, so that this can be done with the stored ones.

use super::SAME_DIRECTION;
use super::header::Symmetry;
use super::incidence::chord;
use crate::compute::basis::RingBasis;
use crate::compute::btdf::Finding;
use crate::compute::direction::{Dir, Facade};
use std::f64::consts::PI;

/// Symmetry operation on directions: φ ↦ sign · φ + offset \[rad\], θ unchanged.
#[derive(Debug, Clone, Copy)]
struct Image {
    sign: f64,
    offset: f64,
}

impl Image {
    fn of(self, d: Dir<Facade>) -> Dir<Facade> {
        Dir::from_theta_phi(d.theta(), self.sign * d.phi() + self.offset)
    }

    /// Returns the values of the cells of `row` under this operation, as means over the same cells, and whether cells
    /// were only exchanged (no averaging).
    fn row(self, basis: &RingBasis, row: &[f64]) -> (Vec<f64>, bool) {
        const EXACT: f64 = 1e-7;
        let mut out = Vec::with_capacity(row.len());
        let mut exact = true;
        for (index, ring) in basis.rings().iter().enumerate() {
            let first = basis.first_cell(index);
            let width = 2.0 * PI / ring.sectors as f64;
            for k in 0..ring.sectors {
                let image = self.sign * basis.cell(first + k).phi + self.offset;
                let place = (basis.azimuth().own_phi(image) - ring.first_phi).rem_euclid(2.0 * PI) / width;
                let (whole, part) = (place.floor(), place.fract());
                let value = |k: usize| row[first + k % ring.sectors];
                let whole = whole as usize;
                out.push(if part < EXACT || ring.sectors == 1 {
                    value(whole)
                } else if part > 1.0 - EXACT {
                    value(whole + 1)
                } else {
                    exact = false;
                    // The image of the cell covers parts of two neighbours.
                    (1.0 - part) * value(whole) + part * value(whole + 1)
                });
            }
        }
        (out, exact)
    }
}

const LEFT_RIGHT: Image = Image { sign: -1.0, offset: PI };
const UP_DOWN: Image = Image { sign: -1.0, offset: 0.0 };
const HALF_TURN: Image = Image { sign: 1.0, offset: PI };

fn mirrors(symmetry: Symmetry) -> &'static [Image] {
    match symmetry {
        Symmetry::LeftRight => &[LEFT_RIGHT],
        Symmetry::UpDown => &[UP_DOWN],
        Symmetry::Both => &[LEFT_RIGHT, UP_DOWN, HALF_TURN],
        Symmetry::Rotational => &[],
    }
}

/// Incident directions with their values: first the measured ones, then those that symmetry adds.
#[derive(Debug)]
pub(super) struct Known {
    /// Incident directions in the façade frame.
    pub names: Vec<Dir<Facade>>,
    /// Values q of the emergent cells, in one row for each incident direction. \[1/sr\]
    pub rows: Vec<f64>,
}

impl Known {
    fn row(&self, basis: &RingBasis, index: usize) -> &[f64] {
        &self.rows[index * basis.len()..(index + 1) * basis.len()]
    }

    fn find(&self, among: usize, d: Dir<Facade>) -> Option<usize> {
        self.names[..among].iter().position(|name| chord(*name, d) < SAME_DIRECTION)
    }

    /// Returns the index of the measured incident direction, and the operation by which it gives the direction
    /// `wanted`; `None` if there is none.
    fn source(&self, measured: usize, symmetry: Symmetry, wanted: Dir<Facade>) -> Option<(usize, Image)> {
        if symmetry == Symmetry::Rotational {
            let turn = |name: Dir<Facade>| {
                let turn = (name.phi() - wanted.phi()).rem_euclid(2.0 * PI);
                if turn > PI { turn - 2.0 * PI } else { turn }
            };
            return (0..measured)
                .filter(|&k| (self.names[k].theta() - wanted.theta()).abs() < SAME_DIRECTION)
                .min_by(|&a, &b| turn(self.names[a]).abs().total_cmp(&turn(self.names[b]).abs()))
                .map(|k| (k, Image { sign: 1.0, offset: turn(self.names[k]) }));
        }
        mirrors(symmetry).iter().find_map(|image| Some((self.find(measured, image.of(wanted))?, *image)))
    }
}

/// Returns the incident directions that a symmetry adds to a list: mirror images; for rotational symmetry as many
/// rotations of every θ as a row of Tregenza's lattice at that θ has directions.
fn wanted(names: &[Dir<Facade>], symmetry: Symmetry) -> Vec<Dir<Facade>> {
    if symmetry != Symmetry::Rotational {
        return names.iter().flat_map(|name| mirrors(symmetry).iter().map(|image| image.of(*name))).collect();
    }
    names
        .iter()
        .filter(|name| name.theta() > SAME_DIRECTION)
        .flat_map(|name| {
            let half = (15.0 * name.theta().sin()).round().max(3.0);
            (1..2 * half as usize).map(move |k| Dir::from_theta_phi(name.theta(), name.phi() + PI * k as f64 / half))
        })
        .collect()
}

/// Adds incident directions by symmetry: the `missing` ones of a lattice, or images of all listed ones. Stops at `most`
/// directions. Returns findings.
pub(super) fn fill(
    known: &mut Known,
    basis: &RingBasis,
    symmetry: Symmetry,
    missing: Option<&[Dir<Facade>]>,
    most: usize,
) -> Vec<Finding> {
    let measured = known.names.len();
    let mut findings: Vec<Finding> = broken(known, basis, symmetry).into_iter().collect();
    let list = missing.map_or_else(|| wanted(&known.names, symmetry), <[_]>::to_vec);
    let (mut added, mut blurred) = (0, 0);
    for d in list {
        if known.names.len() >= most || known.find(known.names.len(), d).is_some() {
            continue;
        }
        let Some((source, image)) = known.source(measured, symmetry, d) else { continue };
        let (row, exact) = image.row(basis, known.row(basis, source));
        known.rows.extend(row);
        known.names.push(d);
        added += 1;
        blurred += usize::from(!exact);
    }
    if added > 0 {
        let blurred = match blurred {
            0 => String::new(),
            some => format!(" {some} of them were turned by parts of a cell, which blurs them by less than a cell."),
        };
        findings.push(Finding::info(
            "symmetry-filled",
            format!(
                "{added} incidences are images of the {measured} measured ones by the declared symmetry ({}).{blurred}",
                symmetry.word()
            ),
        ));
    }
    findings
}

/// Returns a finding if the measured data contradict the declared symmetry.
fn broken(known: &Known, basis: &RingBasis, symmetry: Symmetry) -> Option<Finding> {
    const TOLERATED: f64 = 0.1;
    let weights = basis.projected_solid_angles();
    let mut worst = 0.0_f64;
    for k in 0..known.names.len() {
        let name = known.names[k];
        let twin = match symmetry {
            Symmetry::Rotational => known.source(k, symmetry, name),
            _ => mirrors(symmetry).iter().find_map(|image| Some((known.find(k, image.of(name))?, *image))),
        };
        let Some((twin, image)) = twin else { continue };
        let (mirrored, _) = image.row(basis, known.row(basis, twin));
        let (mut difference, mut sum) = (0.0, 0.0);
        for ((a, b), w) in mirrored.iter().zip(known.row(basis, k)).zip(&weights) {
            difference += w * (a - b).abs();
            sum += 0.5 * w * (a + b);
        }
        if sum > 0.0 {
            worst = worst.max(0.5 * difference / sum);
        }
    }
    (worst > TOLERATED).then(|| {
        Finding::warning(
            "symmetry-broken",
            format!(
                "The declared symmetry ({}) does not hold between measured incidences: up to {:.0} % of the light goes \
                 elsewhere. Measured incidences are kept as they are.",
                symmetry.word(),
                100.0 * worst
            ),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::{AzimuthMap, Ring};

    /// A smooth function of the direction cosines.
    fn f(x: f64, y: f64) -> f64 {
        (0.9 * x - 0.4 * y + 0.3 * x * y).exp()
    }

    #[test]
    fn images_of_cells_are_cells_where_sectors_are_even() {
        let ring = |a: f64, b: f64, sectors| Ring {
            theta_min: a.to_radians(),
            theta_max: b.to_radians(),
            sectors,
            first_phi: 0.0,
        };
        let rings = vec![ring(0.0, 10.0, 1), ring(10.0, 40.0, 8), ring(40.0, 90.0, 12)];
        for offset in [0.0, PI] {
            let basis = RingBasis::new("x", rings.clone(), AzimuthMap { sign: 1.0, offset }).unwrap();
            let at = |d: Dir<Facade>| f(d.vector().x, d.vector().y);
            let row: Vec<f64> = basis.cells().map(|cell| at(cell.centre())).collect();
            for (image, sx, sy) in [(LEFT_RIGHT, -1.0, 1.0), (UP_DOWN, 1.0, -1.0), (HALF_TURN, -1.0, -1.0)] {
                let (mirrored, exact) = image.row(&basis, &row);
                assert!(exact);
                for (cell, value) in basis.cells().zip(mirrored) {
                    let v = cell.centre().vector();
                    assert!((value - f(sx * v.x, sy * v.y)).abs() < 1e-12);
                }
            }
            let (turned, exact) = Image { sign: 1.0, offset: 0.1 }.row(&basis, &row);
            let flux = |row: &[f64]| basis.cells().zip(row).map(|(c, q)| c.projected_solid_angle() * q).sum::<f64>();
            assert!(!exact && (flux(&turned) - flux(&row)).abs() < 1e-12);
        }
    }
}
