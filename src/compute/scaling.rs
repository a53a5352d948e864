//! Symmetric scaling: the d for which the rows of d A d, A symmetric and not negative, have given sums.
//!
//! Values computed from both ends of a path are averaged and so made reciprocal; then the sums over all that light can
//! do are no longer exactly what they were, and this repairs them without making anything less reciprocal.
//!
//! References: R. Sinkhorn, "A relationship between arbitrary positive matrices and doubly stochastic matrices", Ann.
//! Math. Statist. 35 (1964); the symmetric form by P. Knight, D. Ruiz, B. Uçar, "A symmetry preserving algorithm for
//! matrix scaling", SIAM J. Matrix Anal. Appl. 35 (2014); Newton's method as in P. Knight, D. Ruiz, "A fast algorithm
//! for matrix balancing", IMA J. Numer. Anal. 33 (2013).

/// Maximum number of Newton steps for the scales, and of steps of conjugate gradients in each. Chosen: Newton's method
/// doubles the digits per step, so that 8 reach rounding; the work normally ends by its tolerance.
const STEPS: [usize; 2] = [8, 200];
/// Maximum factor by which a step changes a scale, either way. Chosen: keeps the first steps from overshooting; no
/// effect near the solution, where steps are small.
const MOST: f64 = 2.0;

/// Computes the d for which d (A d) are the sums `wanted`; `sums` gives A d. By rounds of d ← √(d · wanted / (A d)),
/// which halve the remaining difference: safe from any start. They end when no sum was off by more than `left`. Where
/// no sum is wanted, or the present sum is 0, d stays 1; no d exceeds `limit`.
pub fn by_rounds(
    sums: impl Fn(&[f64]) -> Vec<f64>,
    wanted: &[Option<f64>],
    rounds: usize,
    left: f64,
    limit: f64,
) -> Vec<f64> {
    let mut d = vec![1.0; wanted.len()];
    for _ in 0..rounds {
        let found = sums(&d);
        let mut worst: f64 = 0.0;
        for ((d, sum), wanted) in d.iter_mut().zip(found).zip(wanted) {
            if let Some(wanted) = wanted.filter(|_| sum > 0.0) {
                worst = worst.max((*d * sum - wanted).abs());
                *d = (*d * wanted / sum).sqrt().min(limit);
            }
        }
        if worst <= left {
            break;
        }
    }
    d
}

/// Computes the d for which d (A d) are the sums `wanted` by Newton's method for ln d, until no sum is off by more than
/// `left`: (D + dAd) x = wanted − d (A d) with the sums on the diagonal D is symmetric and not negative. For matrices
/// that are nearly right from the start but would take very many rounds, as for light that is mostly transmitted
/// unchanged.
pub fn by_newton(sums: impl Fn(&[f64]) -> Vec<f64>, wanted: &[f64], left: f64) -> Vec<f64> {
    let times = |a: &[f64], b: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| a * b).collect() };
    let mut d = vec![1.0; wanted.len()];
    for _ in 0..STEPS[0] {
        let found = times(&d, &sums(&d));
        let lacks: Vec<f64> = wanted.iter().zip(&found).map(|(wanted, found)| wanted - found).collect();
        if lacks.iter().all(|x| x.abs() <= left) {
            break;
        }
        let matrix = |x: &[f64]| -> Vec<f64> {
            let off = times(&d, &sums(&times(&d, x)));
            off.iter().zip(times(&found, x)).map(|(a, b)| a + b).collect()
        };
        let step = conjugate_gradients(matrix, &found, &lacks, 0.1 * left);
        d.iter_mut().zip(&step).for_each(|(d, x)| *d *= x.exp().clamp(1.0 / MOST, MOST));
    }
    d
}

/// Solves a symmetric system, its diagonal being about `diagonal`, until no value is off by more than `left`.
fn conjugate_gradients(matrix: impl Fn(&[f64]) -> Vec<f64>, diagonal: &[f64], right: &[f64], left: f64) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let eased =
        |r: &[f64]| -> Vec<f64> { r.iter().zip(diagonal).map(|(r, d)| if *d > 0.0 { r / d } else { 0.0 }).collect() };
    let mut x = vec![0.0; right.len()];
    let mut rest = right.to_vec();
    let mut z = eased(&rest);
    let (mut way, mut size) = (z.clone(), dot(&rest, &z));
    for _ in 0..STEPS[1] {
        if rest.iter().all(|r| r.abs() <= left) {
            break;
        }
        let image = matrix(&way);
        let bend = dot(&way, &image);
        // What is left cannot be reached: light that does nothing but pass, of which one side has more.
        if bend <= f64::MIN_POSITIVE {
            break;
        }
        let step = size / bend;
        x.iter_mut().zip(&way).for_each(|(x, w)| *x += step * w);
        rest.iter_mut().zip(&image).for_each(|(r, y)| *r -= step * y);
        z = eased(&rest);
        let next = dot(&rest, &z);
        way.iter_mut().zip(&z).for_each(|(w, z)| *w = z + next / size * *w);
        size = next;
    }
    x
}
