//! A year with its figures, and what it is a year of.

use super::fixed::{put_hour, put_ordinary};
use super::{Figures, Year, figures};
use crate::study::moment;
use crate::study::scene_file::SceneFile;

/// A year with its figures.
#[derive(Debug, Clone)]
pub struct Annual {
    /// The scene without what no year hangs on, see [`question`].
    pub of: SceneFile,
    /// Hour by hour.
    pub year: Year,
    /// What it comes to; the same with all light less, and with all light more by its error.
    pub figures: [Figures; 3],
}

impl Annual {
    /// Of a scene whose year was computed.
    pub fn new(file: &SceneFile, year: Year) -> Self {
        Self { of: question(file), figures: figures(&year), year }
    }

    /// Was it computed for this scene, whatever its moment?
    pub fn is_of(&self, file: &SceneFile) -> bool {
        self.of == question(file)
    }

    /// The step that the scene's moment lies in; `None` where its sky is not that of the year's weather.
    pub fn now(&self, file: &SceneFile) -> Option<usize> {
        let keys = &self.year.settings.keys;
        let split = keys.steps_per_hour > 1;
        let own = file.sky.weather.as_ref() == Some(&keys.weather);
        let steps = &self.year.steps;
        // People read their clock; steps are in the standard time of the weather's place.
        let standard = |clock| file.site.dst.standard(clock, steps.station.utc_offset);
        (own || split).then(|| moment::of(file).and_then(|clock| steps.at(standard(clock)))).flatten()
    }
}

/// A scene without what its year does not hang on: moment, sky, what is compared and what counts in a ranking.
pub fn question(file: &SceneFile) -> SceneFile {
    let mut asked = SceneFile { rank: None, compare: Vec::new(), ..file.clone() };
    put_ordinary(&mut asked);
    if asked.year.as_ref().is_some_and(|keys| !keys.ground.is_empty()) {
        asked.site.ground_reflectance = 0.0;
    }
    asked
}

/// The scene at a step of its year: sky and ground are those of the step; what is controlled goes on being so, and the year
/// stays what it is.
pub fn at_step(file: &SceneFile, year: &Year, step: usize) -> SceneFile {
    let mut scene = file.clone();
    put_hour(&mut scene, &year.steps, step, &year.settings.keys);
    scene
}
