//! Contributions to annual figures that are sums over hours and places: by season, by sun on the façade, and by zone of
//! the room.

use crate::compute::angle::Bearing;
use crate::compute::direction::{Orientation, Surface};
use crate::compute::lid::Facing;
use crate::compute::year::lighting::Lamps;
use crate::study::error::StudyError;
use crate::study::scene_file::{SceneFile, SurfaceKey, SystemKeys};
use crate::study::scene_places::{room, sensors};
use crate::study::year::{Climate, SumOver, Year, metric};

/// Names of the seasons, which are whole calendar months; on the southern hemisphere they are shifted by half a year.
pub const SEASONS: [&str; 4] = ["winter", "spring", "summer", "autumn"];
/// Names of the two cases: with and without direct sun on the ranked façade in the middle of the step.
pub const SUN: [&str; 2] = ["sun", "no sun"];

/// Contributions to an annual figure, by season, sun and zone; empty if the figure is not a sum.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Parts {
    /// Names of the zones of the room.
    pub zones: Vec<String>,
    /// Contributions by season, within it by sun, within it by zone, in the unit of the figure; their sum is the
    /// figure.
    pub values: Vec<f64>,
}

impl Parts {
    /// Returns the names of season, sun and zone of a contribution, by its index.
    pub fn name(&self, part: usize) -> [&str; 3] {
        let zones = self.zones.len().max(1);
        let word = |list: &'static [&'static str], at: usize| list.get(at).copied().unwrap_or_default();
        let zone = self.zones.get(part % zones).map_or("", String::as_str);
        [word(&SEASONS, part / zones / SUN.len()), word(&SUN, part / zones % SUN.len()), zone]
    }
}

/// Groups of time steps and sensors by which contributions are summed; found once for a climate and an azimuth.
#[derive(Debug, Clone)]
pub struct Grouping {
    /// Index of season and sun, for each time step.
    times: Vec<usize>,
    /// Index of the zone, for each sensor.
    zones: Vec<usize>,
    names: Vec<String>,
}

impl Grouping {
    /// Creates the groups for a scene with ranked apertures; sun on the façade is determined for the first of these.
    ///
    /// # Errors
    /// Returns an error if a key of room, sensors or sky is wrong.
    pub fn of(file: &SceneFile, climate: &Climate) -> Result<Self, StudyError> {
        let surface = match file.aperture.iter().find(|one| one.system == SystemKeys::Ranked).map(|one| one.surface) {
            Some(SurfaceKey::Roof) => Surface::Roof,
            Some(SurfaceKey::Facade) | None => Surface::Facade,
        };
        let orientation = Orientation::new(Bearing::from_degrees(file.site.azimuth));
        let steps = &climate.steps;
        let south = steps.station.latitude < 0.0;
        let mut times = Vec::with_capacity(steps.list.len());
        for (k, step) in steps.list.iter().enumerate() {
            let season = (usize::from(step.month) % 12 / 3 + if south { 2 } else { 0 }) % 4;
            let sunny = step.hour.is_lit() && {
                let (outside, sun) = steps.even_outside(k)?;
                Facing { outside: &outside, sun: sun.as_ref(), orientation, surface }.sun_illuminance() > 0.0
            };
            times.push(SUN.len() * season + usize::from(!sunny));
        }
        let box_room = room(&file.room)?;
        let places = sensors(&file.sensors, &box_room)?.0;
        let depths: Vec<f64> = places.iter().map(|sensor| sensor.position.y).collect();
        let (zones, names) = zones(&depths, box_room.size.y, climate.settings.lamps.as_ref());
        Ok(Self { times, zones, names })
    }

    /// Returns the contributions to an annual figure, by its key; empty if it is not a sum over hours and places.
    pub fn parts(&self, year: &Year, key: &str) -> Parts {
        match (metric(key).and_then(|(metric, _)| metric.sum), year.settings.lamps.as_ref()) {
            (Some(SumOver::Lighting { floor }), Some(lamps)) => {
                self.lamps(year, lamps, if floor { year.settings.floor } else { 1.0 })
            }
            (Some(SumOver::Sensors { occupied, of }), _) => self.places(year, occupied, of),
            _ => Parts::default(),
        }
    }

    fn empty(&self, zones: Vec<String>) -> Parts {
        Parts { values: vec![0.0; SEASONS.len() * SUN.len() * zones.len()], zones }
    }

    /// Returns the contributions to the mean of a function of the illuminance \[lx\] over sensors and steps.
    /// `occupied`: whether only occupied steps count.
    fn places(&self, year: &Year, occupied: bool, of: fn(f64) -> f64) -> Parts {
        let mut parts = self.empty(self.names.clone());
        let counts = |k: usize| !occupied || year.steps.list[k].occupied;
        let steps = year.chosen.iter().filter(|&&k| counts(k)).count().max(1);
        let scale = 1.0 / (steps * self.zones.len().max(1)) as f64;
        for (row, &k) in year.chosen.iter().enumerate().filter(|(_, k)| counts(**k)) {
            for (e, zone) in year.light.values.row(row).iter().zip(&self.zones) {
                parts.values[self.times[k] * self.names.len() + zone] += scale * of((*e).into());
            }
        }
        parts
    }

    /// Returns the contributions to the energy of the electric lighting, by lighting zone. \[kWh/m² × `scale`\]
    fn lamps(&self, year: &Year, lamps: &Lamps, scale: f64) -> Parts {
        let names = if lamps.zones.len() == 1 { vec!["whole room".to_owned()] } else { self.names.clone() };
        let mut parts = self.empty(names);
        let each: Vec<Lamps> =
            lamps.zones.iter().map(|zone| Lamps { zones: vec![zone.clone()], ..lamps.clone() }).collect();
        for (row, &k) in year.chosen.iter().enumerate() {
            let light = &year.light.values.row(row)[..year.settings.sensors];
            for (zone, lamps) in each.iter().enumerate() {
                let energy = lamps.watts(year.steps.list[k].occupied, light) * year.steps.length / 1000.0;
                parts.values[self.times[k] * parts.zones.len() + zone] += scale * energy;
            }
        }
        parts
    }
}

/// Returns the zone of every sensor, and the names of the zones: the lighting zones in order of their depth if there
/// are several, else the half of the room at the façade and the rear half. Sensors without a lighting zone form an
/// additional zone. `depths`: distances of the sensors from the façade; `depth`: depth of the room. \[m\]
fn zones(depths: &[f64], depth: f64, lamps: Option<&Lamps>) -> (Vec<usize>, Vec<String>) {
    let Some(lamps) = lamps.filter(|lamps| lamps.zones.len() > 1) else {
        let zones = depths.iter().map(|y| usize::from(*y >= 0.5 * depth)).collect();
        return (zones, vec!["front".to_owned(), "rear".to_owned()]);
    };
    let mean = |places: &[usize]| places.iter().map(|&k| depths[k]).sum::<f64>() / places.len().max(1) as f64;
    let mut names: Vec<String> = (1..=lamps.zones.len()).map(|number| format!("zone {number}")).collect();
    if let [a, b] = lamps.zones.as_slice()
        && mean(&a.places) != mean(&b.places)
    {
        let front = mean(&a.places) < mean(&b.places);
        names = if front { ["front", "rear"] } else { ["rear", "front"] }.map(str::to_owned).to_vec();
    }
    let others = names.len();
    let own = |k: usize| lamps.zones.iter().position(|zone| zone.places.contains(&k)).unwrap_or(others);
    let zones: Vec<usize> = (0..depths.len()).map(own).collect();
    if zones.contains(&others) {
        names.push("elsewhere".to_owned());
    }
    (zones, names)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::year::lighting::{Control, Zone};

    #[test]
    fn zones_are_those_of_the_lamps_or_halves_of_the_room() {
        let depths = [1.0, 2.9, 3.0, 5.0];
        assert_eq!(zones(&depths, 6.0, None), (vec![0, 0, 1, 1], vec!["front".to_owned(), "rear".to_owned()]));
        let zone = |places: &[usize]| Zone { places: places.to_vec(), share: 0.3 };
        let lamps = |zones| Lamps { power: 8.0, target: 500.0, control: Control::OnOff, standby: 0.0, zones };
        let (own, names) = zones(&depths, 6.0, Some(&lamps(vec![zone(&[3, 2]), zone(&[0])])));
        assert_eq!((own, names.join(" ")), (vec![1, 2, 0, 0], "rear front elsewhere".to_owned()));
        let (_, names) = zones(&depths, 6.0, Some(&lamps(vec![zone(&[0, 3]), zone(&[1, 2]), zone(&[1])])));
        assert_eq!(names.join(" "), "zone 1 zone 2 zone 3");
    }

    #[test]
    fn parts_have_names() {
        let parts = Parts { zones: vec!["front".to_owned(), "rear".to_owned()], values: vec![0.0; 16] };
        assert_eq!(parts.name(0), ["winter", "sun", "front"]);
        assert_eq!(parts.name(3), ["winter", "no sun", "rear"]);
        assert_eq!(parts.name(15), ["autumn", "no sun", "rear"]);
    }
}
