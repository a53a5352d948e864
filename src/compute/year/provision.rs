//! Daylight provision by EN 17037:2018+A1:2021, method 2 (hourly illuminances; by public summaries, without access to
//! the standard itself).
//!
//! Daylight hours are the half of the year with the most diffuse horizontal light. A level demands a target illuminance
//! on half of the plane and a minimum on 95 % of it, both in half of these hours. That allows two readings: by point
//! (the share of the plane that reaches it in half of the hours) and by hour (the share of the hours in which enough of
//! the plane reaches it), and by hour is at most as good.

use super::hours::{Light, Step, share};

/// Levels of daylight provision: name, target illuminance and minimum target illuminance \[lx\]. Source: EN 17037,
/// Annex A.
pub const LEVELS: [(&str, f64, f64); 3] = [("minimum", 300.0, 100.0), ("medium", 500.0, 300.0), ("high", 750.0, 500.0)];
/// Share of the reference plane that has to reach the target illuminance. Source: EN 17037, Annex A.
const TARGET_AREA: f64 = 0.5;
/// Share of the reference plane that has to reach the minimum target illuminance. Source: EN 17037, Annex A.
const MINIMUM_AREA: f64 = 0.95;
/// Share of the daylight hours in which the illuminances have to be reached, in both readings (by point and by hour).
/// Source: EN 17037, Annex A.
const HALF: f64 = 0.5;

/// Shares of the calculation points and of the daylight hours for which a required illuminance is reached, by the two
/// readings of EN 17037.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Reached {
    /// Share of the calculation points that reach the illuminance in half of the daylight hours, 0 … 1.
    pub area_by_point: f64,
    /// Share of the daylight hours in which the required share of the points reaches the illuminance, 0 … 1.
    pub time_by_hour: f64,
}

/// Shares of points and hours that reach the illuminances of one level of daylight provision.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Level {
    /// Shares for the target illuminance, which is required on half of the reference plane.
    pub target: Reached,
    /// Shares for the minimum target illuminance, which is required on 95 % of the reference plane.
    pub minimum: Reached,
}

impl Level {
    /// Whether the level is met in the reading by point: half and 95 % of the points reach their illuminances in half
    /// of the daylight hours.
    pub fn met_by_point(&self) -> bool {
        self.target.area_by_point >= TARGET_AREA && self.minimum.area_by_point >= MINIMUM_AREA
    }

    /// Whether the level is met in the reading by hour: in half of the daylight hours enough of the points reach their
    /// illuminances.
    pub fn met_by_hour(&self) -> bool {
        self.target.time_by_hour >= HALF && self.minimum.time_by_hour >= HALF
    }
}

/// Daylight provision by EN 17037 of a whole year.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Provision {
    /// Median of the diffuse horizontal illuminance outside over the daylight hours. \[lx\]
    pub median_diffuse: f64,
    /// Shares for each level, in the order of [`LEVELS`].
    pub levels: [Level; 3],
}

impl Provision {
    /// Computes the daylight provision from the illuminances `light` of all points in all `steps` of a whole year.
    /// Daylight hours are the half of the steps with the most diffuse horizontal illuminance; of equal ones the
    /// earlier.
    pub fn of(steps: &[Step], light: Light<'_>) -> Self {
        let mut day: Vec<usize> = (0..steps.len()).collect();
        let brightness = |k: usize| steps[k].diffuse_horizontal;
        day.sort_by(|&a, &b| brightness(b).total_cmp(&brightness(a)));
        day.truncate(steps.len() / 2);
        if day.is_empty() {
            return Self::default();
        }
        let median_diffuse = 0.5 * (brightness(day[(day.len() - 1) / 2]) + brightness(day[day.len() / 2]));
        let places = light.places();
        let asked = LEVELS.map(|(_, target, minimum)| [(target, TARGET_AREA), (minimum, MINIMUM_AREA)]);
        let asked = asked.as_flattened();
        // Row by row, as the light lies in memory.
        let mut often = vec![[0_usize; 2 * LEVELS.len()]; places];
        let mut hours = [0_usize; 2 * LEVELS.len()];
        for &k in &day {
            let mut widely = [0_usize; 2 * LEVELS.len()];
            for (often, e) in often.iter_mut().zip(light.row(k)) {
                for (n, (limit, _)) in asked.iter().enumerate() {
                    let reaches = usize::from(f64::from(*e) >= *limit);
                    often[n] += reaches;
                    widely[n] += reaches;
                }
            }
            for (n, (_, area)) in asked.iter().enumerate() {
                hours[n] += usize::from(widely[n] as f64 >= area * places as f64 - 1e-9);
            }
        }
        let reached = |n: usize| Reached {
            area_by_point: share(often.iter().filter(|often| share(often[n], day.len()) >= HALF).count(), places),
            time_by_hour: share(hours[n], day.len()),
        };
        let levels = std::array::from_fn(|level| Level { target: reached(2 * level), minimum: reached(2 * level + 1) });
        Self { median_diffuse, levels }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::year::StepTable;

    #[test]
    fn both_readings_of_a_room_whose_halves_are_lit_in_turn() {
        // Four daylight hours of eight: the left place is bright in the first two, the right one in the others.
        let steps: Vec<Step> = [4.0, 3.0, 2.0, 1.0, 0.0, 0.0, 0.0, 0.0]
            .map(|diffuse_horizontal| Step { month: 6, occupied: true, diffuse_horizontal })
            .to_vec();
        let mut values = vec![0.0; 16];
        for (k, row) in values.chunks_mut(2).take(4).enumerate() {
            row.copy_from_slice(if k < 2 { &[400.0, 0.0] } else { &[0.0, 400.0] });
        }
        let provision = Provision::of(&steps, StepTable::of_rows(2, &values).unwrap().columns(0..2).unwrap());
        assert_eq!(provision.median_diffuse, 2.5);
        let least = provision.levels[0];
        assert_eq!(least.target, Reached { area_by_point: 1.0, time_by_hour: 1.0 });
        assert_eq!(least.minimum, Reached { area_by_point: 1.0, time_by_hour: 0.0 });
        assert!(least.met_by_point() && !least.met_by_hour());
        assert_eq!(provision.levels[1].target.area_by_point, 0.0);
    }
}
