//! Annual simulation with its figures, and the scene for which it was computed.

use super::fixed::{put_hour, put_ordinary};
use super::{Figures, Year, figures};
use crate::study::moment;
use crate::study::scene_file::SceneFile;

/// Annual simulation with its figures.
#[derive(Debug, Clone)]
pub struct Annual {
    /// Scene for which the year was computed, without the keys on which no year depends, see [`question`].
    pub of: SceneFile,
    /// Results of all steps of the year, without the light by direct sun alone.
    pub year: Year,
    /// Figures of the year as computed, with all light lower by its error, and with all light higher.
    pub figures: [Figures; 3],
}

impl Annual {
    /// Creates the figures of a year that was computed for the scene `file`.
    pub fn new(file: &SceneFile, mut year: Year) -> Self {
        let figures = figures(&year);
        // Only the figures need it, and it is half of all that a year holds.
        (year.light.sun, year.retracted_sun) = (None, None);
        Self { of: question(file), figures, year }
    }

    /// Whether the year was computed for this scene, whatever its date and time.
    pub fn is_of(&self, file: &SceneFile) -> bool {
        self.of == question(file)
    }

    /// Returns the index of the step that contains the scene's date and time; `None` if the scene's sky is not that of
    /// the year's weather.
    pub fn now(&self, file: &SceneFile) -> Option<usize> {
        let keys = &self.year.settings.keys;
        let split = keys.steps_per_hour > 1;
        let own = file.sky.weather.as_ref() == Some(&keys.weather);
        let steps = &self.year.steps;
        // Scenes use local clock time; steps are in the standard time of the weather's place.
        let standard = |clock| file.site.dst.standard(clock, steps.station.utc_offset);
        (own || split).then(|| moment::of(file).and_then(|clock| steps.at(standard(clock)))).flatten()
    }
}

/// Returns a scene without the keys on which its annual simulation does not depend: date and time, sky, comparison and
/// ranking.
pub fn question(file: &SceneFile) -> SceneFile {
    let mut asked = SceneFile { rank: None, compare: Vec::new(), ..file.clone() };
    put_ordinary(&mut asked);
    if asked.year.as_ref().is_some_and(|keys| !keys.ground.is_empty()) {
        asked.site.ground_reflectance = 0.0;
    }
    asked
}

/// Returns the scene at a step of its annual simulation: sky and ground are those of the step; the keys of control and
/// year are unchanged.
pub fn at_step(file: &SceneFile, year: &Year, step: usize) -> SceneFile {
    let mut scene = file.clone();
    put_hour(&mut scene, &year.steps, step, &year.settings.keys);
    scene
}
