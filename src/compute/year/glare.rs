//! Glare of an observer through the occupied steps: the simplified daylight glare probability DGPs = 6.22e-5 E_v +
//! 0.184 (Wienold 2009), not limited.
//!
//! It is valid only while neither the sun's disc nor a lobe of sunlight scattered by the system reaches the eye. Steps
//! with direct sun at the eye are left out and counted; lobes are not considered here, so that the figure is too low
//! where a system has any.

use super::hours::{Light, Step, share};
use crate::compute::glare::dgps;

/// Limits of the levels of glare protection of EN 17037, Annex E (high, medium, minimum): DGP that may be exceeded in
/// at most 5 % of the usage time.
pub const LIMITS: [f64; 3] = [0.35, 0.40, 0.45];
/// Share of the usage time in which a limit of DGP may be exceeded. Source: EN 17037, Annex E.
const EXCEEDED: f64 = 0.05;

/// Annual figures of the simplified glare probability DGPs of one observer.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Glare {
    /// Number of occupied steps with direct sun at the eye, which are left out of the other figures.
    pub sun_at_eye: usize,
    /// DGPs that is exceeded in 5 % of the occupied steps without direct sun at the eye.
    pub dgps_5_percent: f64,
    /// Shares of the occupied steps without direct sun at the eye in which DGPs exceeds each of [`LIMITS`].
    pub above: [f64; 3],
}

/// Computes the annual DGPs figures of every observer. `eyes`: vertical illuminances at the observers' eyes \[lx\];
/// `sun`: the part of them by direct sun that a system transmits unscattered, `None` if none does.
pub fn glare(steps: &[Step], eyes: Light<'_>, sun: Option<Light<'_>>) -> Vec<Glare> {
    let of = |eye: usize| {
        let occupied = || (0..steps.len()).filter(|&k| steps[k].occupied);
        let at_eye = |k: &usize| sun.is_some_and(|sun| sun.at(*k, eye) > 0.0);
        let values = occupied().filter(|k| !at_eye(k)).map(|k| dgps(eyes.at(k, eye))).collect();
        let (dgps_5_percent, above) = exceeded(values);
        Glare { sun_at_eye: occupied().filter(at_eye).count(), dgps_5_percent, above }
    };
    (0..eyes.places()).map(of).collect()
}

/// Returns the glare probability that is exceeded in at most the share [`EXCEEDED`] of the values `values`, 0 without
/// any, and the shares of the values above each of [`LIMITS`].
pub(super) fn exceeded(mut values: Vec<f64>) -> (f64, [f64; 3]) {
    values.sort_by(|a, b| b.total_cmp(a));
    let rank = (EXCEEDED * values.len() as f64) as usize;
    let above = |limit: f64| share(values.iter().filter(|value| **value > limit).count(), values.len());
    (values.get(rank).copied().unwrap_or(0.0), LIMITS.map(above))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::year::StepTable;

    #[test]
    fn the_brightest_twentieth_is_exceeded_and_suns_are_left_out() {
        let steps = vec![Step { month: 1, occupied: true, diffuse_horizontal: 1.0 }; 41];
        let values: Vec<f64> = (0..41).map(|k| 100.0 * f64::from(k)).collect();
        let mut sun = vec![0.0; 41];
        sun[40] = 1.0;
        let [light, sun] = [&values, &sun].map(|values| StepTable::of_rows(1, values).unwrap());
        let [light, sun] = [&light, &sun].map(|table| table.columns(0..1).unwrap());
        let one = glare(&steps, light, Some(sun))[0];
        assert_eq!(one.sun_at_eye, 1);
        assert_eq!(one.dgps_5_percent, dgps(3700.0));
        // 0.35 ↔ 2669 lx: 2700 … 3900 lx are 13 of 40.
        assert_eq!(one.above, [13.0 / 40.0, 5.0 / 40.0, 0.0]);
        assert_eq!(glare(&steps, light, None)[0].dgps_5_percent, dgps(3800.0));
    }
}
