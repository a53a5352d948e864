//! Interreflection between the diffuse faces of slats, and the light that leaves the slats after it.
//!
//! With the exchange S between faces (symmetric), their lengths A and diffuse reflectances ρ, incident light g on the
//! faces leaves them as exitance M g after all interreflections, M = (I − D S)⁻¹ D, D = ρ/A: a symmetric form, so that
//! q(ψ → ψ′) = h(ψ′)ᵀ M g(ψ)/π is reciprocal (h: light from direction ψ′ on the faces). A division into strips half as
//! fine has a fourth of the strips' error (faces of constant exitance); both are solved, (4 M_fine − M_coarse)/3 is
//! used, and a third of their difference is the stated error.

use super::flows::Transport;
use super::outline::SlatSection;
use faer::Mat;
use faer::linalg::solvers::Solve;

/// Solved interreflection between the faces of a section of slats.
#[derive(Debug, Clone)]
pub(super) struct Balance {
    /// Matrix M of the module head: exitance of each face (row) per width of light that is incident on each face
    /// (column).
    pub(super) response: Mat<f64>,
    /// Share of the light incident on each face that is absorbed after all interreflections.
    pub(super) absorbed: Vec<f64>,
    /// Shares of the light incident on each face that leave the slats by diffuse reflection, to the inside and to the
    /// outside.
    pub(super) leaves: [Vec<f64>; 2],
    /// Error of `leaves`, a third of the difference between the two divisions into strips.
    pub(super) uncertainty: [Vec<f64>; 2],
}

impl Balance {
    /// Returns the memory of the solution, of which the matrix has nearly all. \[bytes\]
    pub(super) fn bytes(&self) -> usize {
        size_of::<f64>() * self.response.nrows() * self.response.ncols()
    }
}

/// Maximum diffuse reflectance in the computation: white faces that exchange light only with each other would reflect
/// it without end. Chosen: the system's condition number stays below some 1e10, which leaves six of the 16 digits of
/// f64.
const WHITEST: f64 = 1.0 - 1e-10;

/// Solution of the interreflection for one division of the slats into strips.
struct Division {
    response: Mat<f64>,
    absorbed: Vec<f64>,
    leaves: [Vec<f64>; 2],
}

/// Solves the interreflection for one division into strips, from the exchange between faces, their lengths, diffuse
/// reflectances, absorptances `lost`, and the light that each face sends out to either side.
fn solve(exchange: &Mat<f64>, length: &[f64], diffuse: &[f64], lost: &[f64], exits: &[Vec<f64>; 2]) -> Division {
    let n = length.len();
    let d: Vec<f64> =
        length.iter().zip(diffuse).map(|(a, rho)| if *a > 0.0 { rho.min(WHITEST) / a } else { 0.0 }).collect();
    let system = Mat::from_fn(n, n, |i, j| f64::from(u8::from(i == j)) - d[i] * exchange[(i, j)]);
    let source = Mat::from_fn(n, n, |i, j| if i == j { d[i] } else { 0.0 });
    let response = system.partial_piv_lu().solve(&source);
    let through =
        |row: &[f64]| -> Vec<f64> { (0..n).map(|j| (0..n).map(|i| row[i] * response[(i, j)]).sum::<f64>()).collect() };
    // Incident light in all: g + S M g.
    let landing: Vec<f64> = (0..n).map(|k| (0..n).map(|i| lost[i] * exchange[(i, k)]).sum::<f64>()).collect();
    let absorbed = through(&landing).iter().zip(lost).map(|(more, own)| own + more).collect();
    Division { absorbed, leaves: [through(&exits[0]), through(&exits[1])], response }
}

impl Balance {
    /// Solves the interreflection between the faces of a section. `hat`: weight of each node of the profile angle
    /// \[rad\].
    pub(super) fn new(section: &SlatSection, transport: &Transport, hat: &[f64]) -> Self {
        let n = section.faces.len();
        let diffuse: Vec<f64> = section.faces.iter().map(|f| f.surface.diffuse).collect();
        let lost: Vec<f64> = section.faces.iter().map(|f| 1.0 - f.surface.diffuse - f.surface.mirror).collect();
        // A face sends inside what light from inside brings to it, over all directions.
        let exits = [1, 0].map(|side: usize| {
            let mut sum = vec![0.0; n];
            for (row, weight) in transport.incident[side].iter().zip(hat) {
                sum.iter_mut().zip(row).for_each(|(sum, x)| *sum += 0.5 * weight * x);
            }
            sum
        });
        let exchange = Mat::from_fn(n, n, |i, j| transport.exchange.values[i * n + j]);
        let fine = solve(&exchange, &transport.length, &diffuse, &lost, &exits);

        let m = section.coarse;
        let of = |face: usize| section.faces[face].coarse;
        let gather = |values: &[f64]| {
            let mut sum = vec![0.0; m];
            values.iter().enumerate().for_each(|(face, x)| sum[of(face)] += x);
            sum
        };
        let pick = |values: &[f64]| {
            let mut list = vec![0.0; m];
            values.iter().enumerate().for_each(|(face, x)| list[of(face)] = *x);
            list
        };
        let mut merged = Mat::zeros(m, m);
        for i in 0..n {
            for j in 0..n {
                merged[(of(i), of(j))] += exchange[(i, j)];
            }
        }
        let coarse_exits = [gather(&exits[0]), gather(&exits[1])];
        let coarse = solve(&merged, &gather(&transport.length), &pick(&diffuse), &pick(&lost), &coarse_exits);

        let better = |fine: f64, coarse: f64| (4.0 * fine - coarse) / 3.0;
        let both = |fine: &[f64], coarse: &[f64], f: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
            fine.iter().enumerate().map(|(face, x)| f(*x, coarse[of(face)])).collect()
        };
        let uncertainty = |a: f64, b: f64| (a - b) / 3.0;
        Self {
            response: Mat::from_fn(n, n, |i, j| better(fine.response[(i, j)], coarse.response[(of(i), of(j))])),
            absorbed: both(&fine.absorbed, &coarse.absorbed, &better),
            leaves: [0, 1].map(|k: usize| both(&fine.leaves[k], &coarse.leaves[k], &better)),
            uncertainty: [0, 1].map(|k: usize| both(&fine.leaves[k], &coarse.leaves[k], &uncertainty)),
        }
    }
}
