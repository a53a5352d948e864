//! Series of luminaire files: the same scene on the 21st of several months, at several hours, in several states of its
//! system.

use super::error::StudyError;
use super::moment;
use super::scene_file::{SceneFile, SystemKeys, TimeKey};
use super::sun_position::{Place, parse_local_time};
use crate::texts::ascii_letters;
use std::path::Path;

/// Day of the month for which the scenes of a series are computed.
const DAY: u8 = 21;

/// Values that a series varies; an empty list stands for the value in the scene.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Series {
    /// Months, 1 to 12.
    pub months: Vec<u8>,
    /// Hours of the day by the scene's clock. \[h\]
    pub hours: Vec<f64>,
    /// Keys of the system's states.
    pub states: Vec<String>,
}

/// One scene of a series, with its names.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    /// Name in the index of luminaire files: day and hour, and state.
    pub name: String,
    /// Name in the form in which it is part of file names.
    pub tag: String,
    /// Scene with the member's time and state.
    pub scene: SceneFile,
}

impl Series {
    /// Whether the series varies nothing, so that it consists of the scene itself.
    pub fn is_empty(&self) -> bool {
        self.months.is_empty() && self.hours.is_empty() && self.states.is_empty()
    }

    /// Returns the scenes of the series, states varying fastest; and the times that are left out because the sun is
    /// below the horizon.
    ///
    /// # Errors
    /// Returns an error for months or hours out of range, for times without the scene's `sky.time` and site, or for
    /// states of a system without any.
    pub fn members(
        &self,
        scene: &SceneFile,
        base: &Path,
        aperture: usize,
    ) -> Result<(Vec<Member>, Vec<String>), StudyError> {
        let (times, dark) = self.times(scene, base)?;
        let mut list = Vec::new();
        for time in &times {
            let at = time.as_ref().map_or_else(|| scene.clone(), |time| at(scene, time));
            let time = time.clone().unwrap_or_default();
            if self.states.is_empty() {
                list.push(Member { tag: tag(&[&time]), name: time, scene: at });
                continue;
            }
            for state in &self.states {
                let mut own = at.clone();
                match &mut own.aperture[aperture].system {
                    SystemKeys::File { state: key, .. }
                    | SystemKeys::Catalogue { state: key, .. }
                    | SystemKeys::Family { state: key, .. } => {
                        *key = Some(state.clone());
                    }
                    SystemKeys::Ideal { .. } | SystemKeys::Luminaires { .. } | SystemKeys::Ranked => {
                        let place = format!("aperture[{}].system", aperture + 1);
                        return Err(StudyError::key(
                            place,
                            format!("has no states; a series over \"{state}\" needs some"),
                        ));
                    }
                }
                let name = format!("{time} state {state}").trim().to_owned();
                list.push(Member { name, tag: tag(&[&time, state]), scene: own });
            }
        }
        Ok((list, dark))
    }

    /// Returns the times of the series as text (`None` for that of the scene itself), and those that are left out
    /// because the sun is down.
    fn times(&self, scene: &SceneFile, base: &Path) -> Result<(Vec<Option<String>>, Vec<String>), StudyError> {
        if self.months.is_empty() && self.hours.is_empty() {
            return Ok((vec![None], Vec::new()));
        }
        let need =
            "a series over months or hours needs it: the year counts, and the month or the hour that is not varied";
        let time = scene.sky.time.as_ref().ok_or_else(|| StudyError::key("sky.time", format!("missing: {need}")))?;
        let time = parse_local_time(&time.text()).map_err(|error| StudyError::key("sky.time", error.to_string()))?;
        let part = |key: &str, value: Option<f64>| {
            value.ok_or_else(|| StudyError::key(key, "missing: a series over months or hours needs the place"))
        };
        let site = &scene.site;
        Place::new(
            part("site.latitude", site.latitude)?,
            part("site.longitude", site.longitude)?,
            part("site.utc_offset", site.utc_offset)?,
        )
        .map_err(|error| StudyError::key("site", error.to_string()))?;
        let own_hour = f64::from(time.hour()) + f64::from(time.minute()) / 60.0;
        let days: Vec<(u8, u8)> = if self.months.is_empty() {
            vec![(time.month().unsigned_abs(), time.day().unsigned_abs())]
        } else {
            self.months.iter().map(|month| (*month, DAY)).collect()
        };
        let hours = if self.hours.is_empty() { vec![own_hour] } else { self.hours.clone() };
        let (mut times, mut dark) = (Vec::new(), Vec::new());
        for (month, day) in days {
            if !(1..=12).contains(&month) {
                return Err(StudyError::key("months", format!("{month} is not a month (1 to 12)")));
            }
            for &hour in &hours {
                if !(0.0..24.0).contains(&hour) {
                    return Err(StudyError::key("hours", format!("{hour} is not an hour of a day (0 up to 24)")));
                }
                let minutes = (60.0 * hour).round().min(1439.0) as u32;
                let text = format!("{:04}-{month:02}-{day:02}T{:02}:{:02}", time.year(), minutes / 60, minutes % 60);
                let sun = moment::sun(&at(scene, &text), base);
                if sun.is_some_and(|(altitude, _)| altitude > 0.0) { times.push(Some(text)) } else { dark.push(text) }
            }
        }
        if times.is_empty() {
            return Err(StudyError::key("hours", "the sun is below the horizon at all of them"));
        }
        Ok((times, dark))
    }
}

/// Returns the scene at a time, given as text.
fn at(scene: &SceneFile, time: &str) -> SceneFile {
    let mut scene = scene.clone();
    scene.sky.time = Some(TimeKey::Text(time.to_owned()));
    (scene.sky.sun.altitude, scene.sky.sun.azimuth) = (None, None);
    scene
}

/// Returns words in the form in which they are part of file names.
fn tag(words: &[&str]) -> String {
    let plain = |word: &str| -> String {
        // Year and colon are not needed in a file name.
        let word = word.get(5..).filter(|_| word.contains('T') && word.len() == 16).unwrap_or(word);
        ascii_letters(word)
            .chars()
            .filter(|c| *c != ':')
            .map(|c| if c.is_ascii_alphanumeric() || c == '.' { c } else { '-' })
            .collect()
    };
    words.iter().filter(|word| !word.is_empty()).map(|word| plain(word)).collect::<Vec<_>>().join("_")
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = r#"
[room]
width = 4.0
depth = 6.0
height = 3.0
reflectance = { floor = 0.2, walls = 0.5, ceiling = 0.7 }
[[aperture]]
surface = "facade"
origin = [0.0, 1.0]
size = [4.0, 1.5]
system = { file = "blind.xml", state = "45" }
[site]
latitude = 48.8
longitude = 9.2
utc_offset = 1.0
[sky]
model = "cie"
type = 12
diffuse_horizontal = 12000.0
time = "2026-03-21T12:00"
[sensors]
points = [[2.0, 2.0, 0.85]]
"#;

    fn scene() -> SceneFile {
        toml::from_str(SCENE).unwrap()
    }

    #[test]
    fn months_hours_and_states_are_combined_without_the_night() {
        let states = vec!["0".to_owned(), "tilt 45".to_owned()];
        let series = Series { months: vec![6, 12], hours: vec![5.5, 12.0], states };
        let (members, dark) = series.members(&scene(), Path::new(""), 0).unwrap();
        let names: Vec<&str> = members.iter().map(|member| member.name.as_str()).collect();
        assert_eq!(
            names,
            [
                "2026-06-21T05:30 state 0",
                "2026-06-21T05:30 state tilt 45",
                "2026-06-21T12:00 state 0",
                "2026-06-21T12:00 state tilt 45",
                "2026-12-21T12:00 state 0",
                "2026-12-21T12:00 state tilt 45",
            ]
        );
        assert_eq!(dark, ["2026-12-21T05:30"]);
        assert_eq!(members[1].tag, "06-21T0530_tilt-45");
        assert_eq!(tag(&["2026-06-21T05:30", "открыто 45"]), "06-21T0530_otkryto-45");
        let keys = &members[5].scene;
        assert_eq!(keys.sky.time.as_ref().unwrap().text(), "2026-12-21T12:00");
        assert!(matches!(&keys.aperture[0].system, SystemKeys::File { state: Some(state), .. } if state == "tilt 45"));
        // Stuttgart at noon: about 90° − 48.8° ± 23.4° high.
        assert!((moment::sun(keys, Path::new("")).unwrap().0.to_degrees() - 17.8).abs() < 0.7);
    }

    #[test]
    fn what_a_series_needs_is_told() {
        let told =
            |series: &Series, scene: &SceneFile| series.members(scene, Path::new(""), 0).unwrap_err().to_string();
        let hours = Series { hours: vec![12.0], ..Series::default() };
        let mut other = scene();
        other.sky.time = None;
        assert!(told(&hours, &other).contains("sky.time"));
        let mut other = scene();
        other.site.latitude = None;
        assert!(told(&hours, &other).contains("site.latitude"));
        assert!(told(&Series { months: vec![13], ..Series::default() }, &scene()).contains("13"));
        assert!(told(&Series { hours: vec![24.0], ..Series::default() }, &scene()).contains("24"));
        assert!(told(&Series { hours: vec![1.0], ..Series::default() }, &scene()).contains("below the horizon"));
        let mut other = scene();
        other.aperture[0].system =
            SystemKeys::Ideal { kind: crate::study::scene_file::IdealKind::Diffuse, transmittance: 0.5 };
        assert!(told(&Series { states: vec!["0".into()], ..Series::default() }, &other).contains("no states"));
    }
}
