//! A year with its figures, and the scene that it belongs to.

use super::fixed::{put_hour, put_ordinary};
use super::{Figures, Year, figures};
use crate::study::moment;
use crate::study::scene_file::SceneFile;

/// A year with its figures.
#[derive(Debug, Clone)]
pub struct Annual {
    /// Scene of the year without the parts that no year depends on, see [`question`].
    pub of: SceneFile,
    /// Hourly results.
    pub year: Year,
    /// Figures of the year, with all light lower by its error, and with all light higher.
    pub figures: [Figures; 3],
}

impl Annual {
    /// Creates the figures of a computed year of a scene.
    pub fn new(file: &SceneFile, year: Year) -> Self {
        Self { of: question(file), figures: figures(&year), year }
    }

    /// Whether the year was computed for this scene, apart from its moment.
    pub fn is_of(&self, file: &SceneFile) -> bool {
        self.of == question(file)
    }

    /// Returns the step that contains the scene's moment; `None` if its sky is not that of the year's weather.
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

/// Returns a scene without the parts that its year does not depend on: moment, sky, comparison and ranking.
pub fn question(file: &SceneFile) -> SceneFile {
    let mut asked = SceneFile { rank: None, compare: Vec::new(), ..file.clone() };
    put_ordinary(&mut asked);
    if asked.year.as_ref().is_some_and(|keys| !keys.ground.is_empty()) {
        asked.site.ground_reflectance = 0.0;
    }
    asked
}

/// Returns the scene at a step of its year: sky and ground are those of the step; controls and year are unchanged.
pub fn at_step(file: &SceneFile, year: &Year, step: usize) -> SceneFile {
    let mut scene = file.clone();
    put_hour(&mut scene, &year.steps, step, &year.settings.keys);
    scene
}
