//! Daylight glare probability from illuminance and glare sources, and its simplified form.

/// Minimum vertical illuminance for which DGP was tested with people (Wienold & Christoffersen 2006); the tests cover
/// DGP from 0.2 to 0.8. \[lx\]
pub const LEAST_ILLUMINANCE: f64 = 380.0;
/// Vertical illuminance below which the low-light correction (Wienold 2012) reduces DGP. \[lx\]
const LOW: f64 = 1000.0;

/// Computes DGP = 5.87·10⁻⁵ E_v + 0.0918 lg(1 + Σ / E_v^1.87) + 0.16, Σ = Σ L² ω / P² (Wienold & Christoffersen 2006,
/// eq 5), limited to 1. Below 1000 lx multiplied by e^(0.024 E_v − 4) / (1 + e^(0.024 E_v − 4)) (Wienold 2012, the
/// low-light correction). `vertical` is E_v, the illuminance at the eye on the plane perpendicular to the line of sight
/// \[lx\]; `sources` is Σ \[cd²/m⁴ sr\].
pub fn dgp(vertical: f64, sources: f64) -> f64 {
    if vertical <= 0.0 {
        return 0.0;
    }
    let value = 5.87e-5 * vertical + 0.0918 * contrast(vertical, sources).ln_1p() / std::f64::consts::LN_10 + 0.16;
    value.min(1.0) * low_light(vertical)
}

/// Returns the contrast term Σ / E_v^1.87 of DGP for the illuminance `vertical` \[lx\] and the sum `sources` of L² ω /
/// P² \[cd²/m⁴ sr\].
fn contrast(vertical: f64, sources: f64) -> f64 {
    sources / vertical.powf(1.87)
}

fn low_light(vertical: f64) -> f64 {
    if vertical < LOW { 1.0 / (1.0 + (4.0 - 0.024 * vertical).exp()) } else { 1.0 }
}

/// Computes the simplified daylight glare probability DGPs from the vertical illuminance at the eye \[lx\], 6.22·10⁻⁵
/// E_v + 0.184 (Wienold 2009): valid for eyes that neither the sun nor a lobe of it reaches.
pub fn dgps(vertical: f64) -> f64 {
    6.22e-5 * vertical + 0.184
}

/// Whether the vertical illuminance at the eye \[lx\] and DGP lie in the range in which the DGP formula was tested with
/// people.
pub fn is_proven(vertical: f64, dgp: f64) -> bool {
    vertical >= LEAST_ILLUMINANCE && (0.2..=0.8).contains(&dgp)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_formula_is_that_of_the_paper() {
        // By hand: 3000^1.87 = e^(1.87 · 8.006368) = 3.178503e6; a sun of 1e7 cd/m², 6.8e-5 sr, P = 2: Σ = 1.7e9,
        // contrast 534.84, lg 535.84 = 2.729036.
        assert!((dgp(3000.0, 1.7e9) - (0.1761 + 0.0918 * 2.729036 + 0.16)).abs() < 1e-5);
        assert!((dgp(3000.0, 0.0) - 0.3361).abs() < 1e-12);
        assert_eq!(dgp(0.0, 1e9), 0.0);
        assert_eq!(dgp(1e5, 1e9), 1.0);
        // Low light: at 166.67 lx one half.
        let at = 4.0 / 0.024;
        assert!((dgp(at, 0.0) - 0.5 * (5.87e-5 * at + 0.16)).abs() < 1e-12);
        assert!((dgps(2669.0) - 0.35).abs() < 1e-4 && (dgps(4277.0) - 0.45).abs() < 1e-4);
        assert!(is_proven(1000.0, 0.4) && !is_proven(379.0, 0.4) && !is_proven(1000.0, 0.9));
    }
}
