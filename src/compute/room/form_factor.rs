//! Exchange areas A·F between axis-parallel rectangles of a box, in closed form.
//!
//! Both cases are fourth differences of one corner function (inclusion–exclusion over coordinate differences), so that
//! a whole pair of walls shares one table of corner values. References: Howell, Catalog of Radiation Configuration
//! Factors, C-13 and C-15 (parallel and perpendicular rectangles with parallel edges).

use std::f64::consts::PI;

/// Returns the corner function of exchange areas between parallel rectangles for the coordinate differences x and y of
/// two corners and the distance z > 0 of the planes. \[m²\]
pub fn parallel_corner(x: f64, y: f64, z: f64) -> f64 {
    let (a, b) = ((x * x + z * z).sqrt(), (y * y + z * z).sqrt());
    let sum = x * x + y * y;
    (y * a * (y / a).atan() + x * b * (x / b).atan()
        - y * z * (y / z).atan()
        - x * z * (x / z).atan()
        - 0.5 * z * z * (sum / (z * z)).ln_1p())
        / (2.0 * PI)
}

/// Returns the corner function of exchange areas between perpendicular rectangles for two corners: difference u along
/// the common edge's direction, distances x and y from that edge. \[m²\]
pub fn perpendicular_corner(u: f64, x: f64, y: f64) -> f64 {
    let c2 = x * x + y * y;
    let s = u * u + c2;
    if s <= 0.0 {
        return 0.0;
    }
    let c = c2.sqrt();
    let angular = if c > 0.0 { u * c * (u / c).atan() } else { 0.0 };
    (angular + 0.25 * (u * u - c2) * s.ln()) / (2.0 * PI)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A·F between two parallel rectangles `x` × `y` a distance z apart. \[m²\]
    fn parallel(x: [[f64; 2]; 2], y: [[f64; 2]; 2], z: f64) -> f64 {
        fourth_difference(|i, k, j, l| parallel_corner(x[0][i] - x[1][k], y[0][j] - y[1][l], z))
    }

    /// A·F between two perpendicular rectangles: `u` their extents along the common direction, `x` of the first and `y`
    /// of the second away from the line in which their planes meet. \[m²\]
    fn perpendicular(u: [[f64; 2]; 2], x: [f64; 2], y: [f64; 2]) -> f64 {
        fourth_difference(|i, k, j, l| perpendicular_corner(u[0][i] - u[1][k], x[j], y[l]))
    }

    fn fourth_difference(corner: impl Fn(usize, usize, usize, usize) -> f64) -> f64 {
        let mut sum = 0.0;
        for i in 0..2 {
            for k in 0..2 {
                for j in 0..2 {
                    for l in 0..2 {
                        let sign = if (i + j + k + l) % 2 == 0 { 1.0 } else { -1.0 };
                        sum += sign * corner(i, k, j, l);
                    }
                }
            }
        }
        sum.abs()
    }

    #[test]
    fn unit_cube() {
        let side = [[0.0, 1.0]; 2];
        let facing = parallel(side, side, 1.0);
        let beside = perpendicular(side, [0.0, 1.0], [0.0, 1.0]);
        assert!((facing - 0.199_824_895_7).abs() < 1e-9, "{facing}");
        assert!((beside - 0.200_043_776_1).abs() < 1e-9, "{beside}");
        assert!((facing + 4.0 * beside - 1.0).abs() < 1e-13);
    }

    #[test]
    fn far_rectangles_follow_the_inverse_square() {
        let f = parallel([[0.0, 1.0], [0.0, 1.0]], [[0.0, 1.0], [0.0, 1.0]], 50.0);
        assert!((f * PI * 2500.0 - 1.0).abs() < 1e-3);
    }
}
