//! Daylight autonomy, useful daylight illuminance and sunlight exposure: shares of all occupied steps, dark ones
//! included.
//!
//! - DA: share with E ≥ x (Reinhart and Walkenhorst 2001). cDA: mean of min(1, E/x) (Rogers 2006).
//! - UDI, in the bounds that are usual since Mardaljevic et al. 2012: below 100 lx, 100 to below 300, 300 to 3000,
//!   above 3000. The four add up to 1.
//! - sDA300/50: share of the places with DA300 ≥ 50 %, with the states as given. IES LM-83-12 operates blinds by its
//!   own rule, so that this is not its figure where a shading device moves.
//! - ASE1000,250 (IES LM-83-12): share of the places with 1000 lx or more directly from the sun, unscattered and
//!   unreflected, in more than 250 h of the occupied ones.

use super::hours::{Light, Step, occupied, share};
use crate::compute::dot::wide;

/// Daylight autonomy figures of a year or a part of one: one value per calculation point, and sDA of all points. Shares
/// are of the occupied steps, 0 … 1.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Autonomy {
    /// Mean illuminance of each point over all steps, nights included. \[lx\]
    pub mean: Vec<f64>,
    /// Daylight autonomy DA300 of each point: share of the occupied steps with 300 lx or more.
    pub da_300: Vec<f64>,
    /// Daylight autonomy DA500 of each point: share of the occupied steps with 500 lx or more.
    pub da_500: Vec<f64>,
    /// Continuous daylight autonomy cDA300 of each point: mean of min(1, E / 300 lx) over the occupied steps.
    pub cda_300: Vec<f64>,
    /// UDI-n of each point, insufficient light: share of the occupied steps with less than 100 lx.
    pub udi_n: Vec<f64>,
    /// UDI-s of each point, supplementary light: share of the occupied steps with 100 to below 300 lx.
    pub udi_s: Vec<f64>,
    /// UDI-a of each point, autonomous light: share of the occupied steps with 300 to 3000 lx.
    pub udi_a: Vec<f64>,
    /// UDI-x of each point, exceeded light: share of the occupied steps with more than 3000 lx.
    pub udi_x: Vec<f64>,
    /// Spatial daylight autonomy sDA300/50%: share of the points with DA300 ≥ 50 %, 0 … 1.
    pub sda_300_50: f64,
}

impl Autonomy {
    /// Computes the autonomy figures of a year or a part of one from the illuminances `light` of all points in all
    /// `steps`.
    pub fn of(steps: &[Step], light: Light<'_>) -> Self {
        let occupied = occupied(steps);
        let mut all = vec![0.0; light.places()];
        for k in 0..steps.len() {
            add(&mut all, light.row(k), |e| e);
        }
        // Row by row, as the light lies in memory: how often each bound is reached; all shares come of these.
        let [mut at_least_100, mut at_least_300, mut at_least_500, mut above_3000, mut part_of_300] =
            [0; 5].map(|_: i32| vec![0.0; light.places()]);
        for &k in &occupied {
            let row = light.row(k);
            add(&mut at_least_100, row, |e| one_if(e >= 100.0));
            add(&mut at_least_300, row, |e| one_if(e >= 300.0));
            add(&mut at_least_500, row, |e| one_if(e >= 500.0));
            add(&mut above_3000, row, |e| one_if(e > 3000.0));
            add(&mut part_of_300, row, |e| (e / 300.0).min(1.0));
        }
        let mean = |sum: f64, count: usize| sum / count.max(1) as f64;
        let shares = |sums: &[f64]| sums.iter().map(|sum| mean(*sum, occupied.len())).collect::<Vec<_>>();
        let between = |from: &[f64], to: &[f64]| shares(&from.iter().zip(to).map(|(a, b)| a - b).collect::<Vec<_>>());
        let da_300 = shares(&at_least_300);
        Self {
            mean: all.into_iter().map(|sum| mean(sum, steps.len())).collect(),
            sda_300_50: share(da_300.iter().filter(|da| **da >= 0.5).count(), da_300.len()),
            da_300,
            da_500: shares(&at_least_500),
            cda_300: shares(&part_of_300),
            udi_n: between(&vec![occupied.len() as f64; light.places()], &at_least_100),
            udi_s: between(&at_least_100, &at_least_300),
            udi_a: between(&at_least_300, &above_3000),
            udi_x: shares(&above_3000),
        }
    }
}

/// Adds `of(E)` of the illuminance E \[lx\] of every point, given in `row`, to the point's entry of `sums`.
fn add(sums: &mut [f64], row: &[f32], of: impl Fn(f64) -> f64) {
    wide(|| sums.iter_mut().zip(row).for_each(|(sum, e)| *sum += of(f64::from(*e))));
}

fn one_if(yes: bool) -> f64 {
    f64::from(u8::from(yes))
}

/// Annual exposure of the calculation points to direct sunlight (IES LM-83-12, ASE).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Exposure {
    /// Occupied hours of each point with 1000 lx or more of direct sunlight, with the shading in use. \[h\]
    pub hours_1000: Vec<f64>,
    /// Occupied hours of each point with 1000 lx or more of direct sunlight, with the shading retracted. \[h\]
    pub ase_hours_1000: Vec<f64>,
    /// Annual sunlight exposure ASE1000,250: share of the points with more than 250 occupied hours of 1000 lx or more
    /// of direct sunlight, shading retracted, 0 … 1.
    pub ase_1000_250: f64,
}

impl Exposure {
    /// Computes the exposure from the illuminances by unscattered and unreflected sunlight in all `steps`: `in_use`
    /// with the shading in use, `retracted` with the shading retracted. `length`: duration of a step. \[h\]
    pub fn of(steps: &[Step], in_use: Light<'_>, retracted: Light<'_>, length: f64) -> Self {
        let occupied = occupied(steps);
        let hours = |sun: Light<'_>| -> Vec<f64> {
            let at = |place| length * occupied.iter().filter(|&&k| sun.at(k, place) >= 1000.0).count() as f64;
            (0..sun.places()).map(at).collect()
        };
        let ase_hours_1000 = hours(retracted);
        let ase_1000_250 = share(ase_hours_1000.iter().filter(|hours| **hours > 250.0).count(), ase_hours_1000.len());
        Self { hours_1000: hours(in_use), ase_hours_1000, ase_1000_250 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::year::StepTable;

    fn steps(occupied: &[bool]) -> Vec<Step> {
        occupied.iter().map(|&occupied| Step { month: 1, occupied, diffuse_horizontal: 1.0 }).collect()
    }

    #[test]
    fn borders_belong_to_the_sides_that_the_definitions_say() {
        let steps = steps(&[true; 5]);
        let values = [99.875, 100.0, 300.0, 3000.0, 3000.125];
        let figures = Autonomy::of(&steps, StepTable::of_rows(1, &values).unwrap().columns(0..1).unwrap());
        assert_eq!((figures.udi_n[0], figures.udi_s[0], figures.udi_a[0], figures.udi_x[0]), (0.2, 0.2, 0.4, 0.2));
        assert_eq!((figures.da_300[0], figures.da_500[0], figures.sda_300_50), (0.6, 0.4, 1.0));
        let expected = (99.875 / 300.0 + 1.0 / 3.0 + 3.0) / 5.0;
        assert!((figures.cda_300[0] - expected).abs() < 1e-12);
    }

    #[test]
    fn unoccupied_steps_count_for_the_mean_alone() {
        let figures = Autonomy::of(
            &steps(&[true, false]),
            StepTable::of_rows(2, &[400.0, 0.0, 0.0, 600.0]).unwrap().columns(0..2).unwrap(),
        );
        assert_eq!(figures.mean, [200.0, 300.0]);
        assert_eq!(figures.da_300, [1.0, 0.0]);
        assert_eq!(figures.sda_300_50, 0.5);
    }

    #[test]
    fn sunlight_counts_in_more_than_250_hours() {
        let year = steps(&vec![true; 251]);
        let mut sun = vec![1000.0; 2 * 251];
        sun[1] = 999.9;
        let (sun, dark) = (StepTable::of_rows(2, &sun).unwrap(), StepTable::zeros(251, 2, 0));
        let light = sun.columns(0..2).unwrap();
        let exposure = Exposure::of(&year, dark.columns(0..2).unwrap(), light, 1.0);
        assert_eq!((exposure.hours_1000, exposure.ase_1000_250), (vec![0.0; 2], 0.5));
        assert_eq!(exposure.ase_hours_1000, [251.0, 250.0]);
        assert_eq!(Exposure::of(&year, light, light, 0.5).ase_1000_250, 0.0);
    }
}
