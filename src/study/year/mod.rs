//! A year in a room: every step of a weather file, the states that controls pick, and the illuminance at every sensor and
//! eye, as the room of that moment has it.
//!
//! | file | what |
//! | --- | --- |
//! | `settings` | keys judged together |
//! | `steps` | the weather's intervals with sun and sky |
//! | `states` | the state of every aperture in every step |
//! | `indoor` | what the room's sensors read, for controls that ask |
//! | `fixed` | the scene with fixed states, at a step |
//! | `direct_sun` | the sun alone, straight at the sensors |
//! | `light` | illuminances: the room prepared once for each set of states, or moment by moment |
//! | `resume` | hours kept while they are computed, for a run that is ended and goes on |
//! | `lm83` | the same with blinds by IES LM-83-12's own rule |
//! | `through` | the solar transmittance of what stands in the apertures |
//! | `solar` | solar power straight through the apertures |
//! | `dgp` | glare at the eyes, from the light |
//! | `eye_light` | what eyes see of an aperture, ready for any sky |
//! | `opening` | exposure to sunlight and view out, without light |
//! | `figures` | what the year comes to, with errors |
//! | `metrics` | figures by their keys |
//! | `annual` | a year with its figures, and what it hangs on |
//! | `look` | what of it is looked at |
//! | `maps` | its hours as a map |
//! | `table` | its figures as rows with words |
//! | `lamps` | the lamps over a day and by month |
//!
//! The sun is never binned: every step has its own, in the middle of the lit part of its interval. Nothing is computed for
//! dark steps, and nothing for states that no step picks.

mod annual;
mod dgp;
mod direct_sun;
mod eye_light;
mod figures;
mod fixed;
mod indoor;
mod lamps;
mod light;
mod lm83;
mod look;
mod maps;
pub mod metrics;
mod opening;
mod resume;
mod settings;
mod solar;
mod states;
mod steps;
mod table;
mod through;

pub use annual::{Annual, at_step, question};
pub use dgp::Dgp;
pub use figures::{Figures, SolarFigures, figures};
pub use indoor::Indoor;
pub use lamps::{Day, day, day_plot, day_words, months, sunniest};
pub use light::Light;
pub use lm83::{Group, Lm83, SHADE};
pub use look::{Look, Page, Shows};
pub use maps::{choices, error, map, title, weather_map};
pub use opening::{NOT_JUDGED, Opening, opening};
pub use resume::{Kept, PATIENCE};
pub use settings::{Settings, settings};
pub use solar::{Solar, ThroughAperture};
pub use steps::{Step, Steps};
pub use table::{Row, Section, table};

use super::error::StudyError;
use super::scene_file::SceneFile;
use super::session::Session;
use super::system::SystemLibrary;
use crate::compute::estimate::Progress;
use crate::study::control::year::Moving;
use states::States;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A year, or the part of it that was asked for.
#[derive(Debug, Clone)]
pub struct Year {
    /// What it was asked with.
    pub settings: Settings,
    /// All steps of the weather.
    pub steps: Arc<Steps>,
    /// The apertures whose state a control picks.
    pub moving: Vec<Moving>,
    /// By step and moving aperture: index of the state.
    pub states: Vec<Vec<usize>>,
    /// Movements of each moving aperture over all steps.
    pub movements: Vec<usize>,
    /// How the room was read where a control asks how bright it is.
    pub indoor: Option<Indoor>,
    /// Indices of the steps that were asked for, rising.
    pub chosen: Vec<usize>,
    /// Light of the chosen steps.
    pub light: Light,
    /// The sun alone straight at sensors and eyes with what moves in the open state of its control, over all steps of a
    /// whole year; `None` where nothing moves, nothing lets it through, or nobody asks. \[lx\]
    pub retracted_sun: Option<Vec<f64>>,
    /// The chosen steps with blinds by IES LM-83-12's own rule, where they are asked for.
    pub lm83: Option<Lm83>,
    /// Solar energy through the apertures, where it is asked for.
    pub solar: Option<Solar>,
    /// Daylight glare probability of the chosen steps; `None` without eyes, or where it is not asked for.
    pub dgp: Option<Dgp>,
    /// What a person should know.
    pub notes: Vec<String>,
    /// How long each stage took.
    pub spent: Vec<(&'static str, Duration)>,
}

/// What a year asks and the weather of it, whatever systems stand in the apertures: found once, used for every product.
#[derive(Debug, Clone)]
pub struct Climate {
    /// What is asked.
    pub settings: Settings,
    /// All steps of the weather.
    pub steps: Arc<Steps>,
}

/// Reads the weather of a scene's year.
///
/// # Errors
/// A scene without `[year]`; wrong keys; a weather file that cannot be read.
pub fn climate(file: &SceneFile, base: &Path) -> Result<Climate, StudyError> {
    let settings = settings(file)?;
    let steps = Arc::new(steps::steps(file, &settings, base)?);
    Ok(Climate { settings, steps })
}

/// Computes the steps that `wanted` takes.
///
/// # Errors
/// As [`climate`] and [`year_in`].
pub fn year(
    file: &SceneFile,
    base: &Path,
    library: &dyn SystemLibrary,
    session: &Session,
    wanted: &dyn Fn(&Step) -> bool,
    progress: &dyn Progress,
) -> Result<Year, StudyError> {
    let clock = Instant::now();
    let climate = climate(file, base)?;
    let weather = clock.elapsed();
    let mut year = year_in(&climate, file, base, library, session, wanted, progress)?;
    year.spent.insert(0, ("weather", weather));
    Ok(year)
}

/// The same with hours that are kept while they are computed, and those that an earlier run has kept.
///
/// # Errors
/// As [`year`]; a part that cannot be written.
pub fn year_kept(
    file: &SceneFile,
    base: &Path,
    library: &dyn SystemLibrary,
    session: &Session,
    wanted: &dyn Fn(&Step) -> bool,
    kept: &mut Kept,
    progress: &dyn Progress,
) -> Result<Year, StudyError> {
    let clock = Instant::now();
    let climate = climate(file, base)?;
    let weather = clock.elapsed();
    let with = Systems { file, base, library, session };
    let mut year = computed(&climate, &with, wanted, Some(kept), progress)?;
    year.spent.insert(0, ("weather", weather));
    Ok(year)
}

/// The scene with what stands in its apertures.
struct Systems<'a> {
    file: &'a SceneFile,
    base: &'a Path,
    library: &'a dyn SystemLibrary,
    session: &'a Session,
}

/// The same in a climate that is known already. `file` may name other systems than the scene that the climate was read for;
/// room, sensors, site and `[year]` are the same.
///
/// # Errors
/// Of systems and controls; none of the steps wanted; cancelled.
pub fn year_in(
    climate: &Climate,
    file: &SceneFile,
    base: &Path,
    library: &dyn SystemLibrary,
    session: &Session,
    wanted: &dyn Fn(&Step) -> bool,
    progress: &dyn Progress,
) -> Result<Year, StudyError> {
    computed(climate, &Systems { file, base, library, session }, wanted, None, progress)
}

fn computed(
    climate: &Climate,
    &Systems { file, base, library, session }: &Systems<'_>,
    wanted: &dyn Fn(&Step) -> bool,
    kept: Option<&mut Kept>,
    progress: &dyn Progress,
) -> Result<Year, StudyError> {
    let mut clock = Instant::now();
    let mut spent = Vec::new();
    let mut lap = |stage| {
        spent.push((stage, clock.elapsed()));
        clock = Instant::now();
    };
    let Climate { settings, steps } = climate.clone();
    let mut notes = steps.warnings.clone();
    let asked = states::Question { file, base, library, session, settings: &settings, steps: &steps };
    let States { moving, list: states, movements, indoor } = states::states(&asked, &mut notes, progress)?;
    lap("states");
    let chosen: Vec<usize> = (0..steps.list.len()).filter(|&k| wanted(&steps.list[k])).collect();
    if chosen.is_empty() {
        return Err(StudyError::key("year.weather", "holds none of the hours that were asked for"));
    }
    let question =
        light::Question { file, base, library, session, settings: &settings, steps: &steps, moving: &moving };
    let light = match kept {
        Some(kept) => resume::light(&question, &states, &chosen, kept, progress)?,
        None => light::light(&question, &states, &chosen, progress)?,
    };
    lap("light");
    let whole = steps.whole && chosen.len() == steps.list.len();
    let retracted_sun = if whole { light::retracted_sun(&question, progress)? } else { None };
    let asked = lm83::Question {
        file,
        base,
        library,
        session,
        settings: &settings,
        steps: &steps,
        moving: &moving,
        states: &states,
        chosen: &chosen,
        light: &light,
    };
    let lm83 = settings.keys.lm83.then(|| lm83::lm83(&asked, &mut notes, progress)).transpose()?;
    if lm83.is_some() {
        lap("LM-83 blinds");
    }
    let asked = solar::Question {
        file,
        base,
        library,
        session,
        steps: &steps,
        moving: &moving,
        states: &states,
        chosen: &chosen,
    };
    let solar = settings.keys.solar.then(|| solar::solar(&asked, &mut notes, progress)).transpose()?;
    if solar.is_some() {
        lap("solar");
    }
    let dgp = dgp::dgp(&question, &states, &chosen, &light, &mut notes, progress)?;
    if dgp.is_some() {
        lap("glare");
    }
    Ok(Year {
        settings,
        steps,
        moving,
        states,
        movements,
        indoor,
        chosen,
        light,
        retracted_sun,
        lm83,
        solar,
        dgp,
        notes,
        spent,
    })
}

/// The scene at a step of its year, with fixed states: what computed as a room gives the same illuminances. `state`: of
/// every moving aperture.
///
/// # Errors
/// As [`year`]; a moment that the weather does not hold.
pub fn scene_at(
    file: &SceneFile,
    base: &Path,
    library: &dyn SystemLibrary,
    time: jiff::civil::DateTime,
    progress: &dyn Progress,
) -> Result<SceneFile, StudyError> {
    let Climate { settings, steps } = climate(file, base)?;
    let session = &Session::new();
    let asked = states::Question { file, base, library, session, settings: &settings, steps: &steps };
    let States { moving, list: states, .. } = states::states(&asked, &mut Vec::new(), progress)?;
    let at = steps.at(time).ok_or_else(|| {
        let message = format!(
            "{} has no interval that holds {}",
            settings.keys.weather.display(),
            time.strftime("%Y-%m-%d %H:%M")
        );
        StudyError::key("year.weather", message)
    })?;
    let mut scene = fixed::with_states(file, &moving, &states[at]);
    fixed::put_at(&mut scene, &steps, at);
    Ok(scene)
}
