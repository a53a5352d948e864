//! Annual simulation of a room: for every step of a weather file, the states that the controls choose, and the
//! illuminance at every sensor and observer with the apertures in these states.
//!
//! | file | what |
//! | --- | --- |
//! | `settings` | checked keys of `[year]` |
//! | `steps` | the weather's intervals with sun and sky |
//! | `states` | the state of every aperture in every step |
//! | `indoor` | readings of the room's sensors, for controls that need them |
//! | `fixed` | the scene with fixed states, at a step |
//! | `direct_sun` | direct sun alone at the sensors |
//! | `light` | illuminances: the room prepared once for each set of states, or moment by moment |
//! | `resume` | hours stored while they are computed, so that an interrupted run can be resumed |
//! | `lm83` | illuminances with blinds operated by the rule of IES LM-83-12 |
//! | `through` | solar transmittance of the systems in the apertures |
//! | `solar` | solar power transmitted through the apertures |
//! | `dgp` | daylight glare probability at the observers, from the light |
//! | `eye_light` | luminance of an aperture as the observers see it, prepared for any sky |
//! | `opening` | exposure to sunlight and view out, without light |
//! | `figures` | annual figures with errors |
//! | `metrics` | the annual metrics, one entry each |
//! | `metric` | definition of an annual metric |
//! | `entries` | annual metrics by key, with their values in a year |
//! | `annual` | a year with its figures, and the part of the scene that it depends on |
//! | `look` | view of a year: page and displayed quantity |
//! | `maps` | hours of a year as a map |
//! | `table` | figures of a year as rows with labels |
//! | `lamps` | electric lighting over a day and by month |
//!
//! Positions of the sun are not grouped into bins: every step has its own, in the middle of the lit part of its
//! interval. Nothing is computed for dark steps, and nothing for states that occur in no step.

mod annual;
mod dgp;
mod direct_sun;
mod entries;
mod eye_light;
mod figures;
mod fixed;
mod indoor;
mod lamps;
mod light;
mod lm83;
mod look;
mod maps;
mod metric;
mod metrics;
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
pub use entries::{Entry, estimate, metric, metrics, scales};
pub use figures::{Figures, SolarFigures, figures};
pub use indoor::Indoor;
pub use lamps::{Day, day, day_plot, day_words, months, sunniest};
pub use light::Light;
pub use lm83::{Group, Lm83, SHADE};
pub use look::{Look, Page, Shows};
pub use maps::{choices, csv_column, error, map, title, weather_map};
pub use metric::{Metric, Need, Quantity, Scale, Section, SumOver};
pub use opening::{NOT_JUDGED, Opening, opening};
pub use resume::{Kept, STORE_DELAY};
pub use settings::{Settings, settings};
pub use solar::{Solar, ThroughAperture};
pub use steps::{Step, Steps};
pub use table::{Row, table};

use super::error::StudyError;
use super::scene_file::SceneFile;
use super::session::Session;
use super::system::SystemLibrary;
use crate::compute::estimate::Progress;
use crate::compute::year::StepTable;
use crate::study::control::year::Moving;
use states::States;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Annual simulation: results of a year, or of the requested part of it.
#[derive(Debug, Clone)]
pub struct Year {
    /// Settings: checked keys of `[year]`.
    pub settings: Settings,
    /// All steps of the weather file.
    pub steps: Arc<Steps>,
    /// Apertures whose state a control chooses.
    pub moving: Vec<Moving>,
    /// Indices of the states, by step and moving aperture.
    pub states: Vec<Vec<usize>>,
    /// Number of state changes of each moving aperture over all steps.
    pub movements: Vec<usize>,
    /// Summary of the sensor readings for controls that depend on the illuminance in the room; `None` without such a
    /// control.
    pub indoor: Option<Indoor>,
    /// Indices of the requested steps, ascending.
    pub chosen: Vec<usize>,
    /// Illuminances in the chosen steps.
    pub light: Light,
    /// Illuminance by direct sun alone at sensors and observers, with every moving aperture in the open state of its
    /// control, over all steps of a whole year; `None` if nothing moves, nothing transmits direct sun, or it is not
    /// requested. \[lx\]
    pub retracted_sun: Option<StepTable>,
    /// Whether a system transmits direct sun in the states of the year or in the open state of its control, as far as
    /// requested.
    pub direct_sun: bool,
    /// Illuminances in the chosen steps with blinds operated by the rule of IES LM-83-12; `None` if not requested.
    pub lm83: Option<Lm83>,
    /// Solar power and energy transmitted through the apertures; `None` if not requested.
    pub solar: Option<Solar>,
    /// Daylight glare probability in the chosen steps; `None` without observers, or if not requested.
    pub dgp: Option<Dgp>,
    /// Notes for the user.
    pub notes: Vec<String>,
    /// Computing time of each stage, by name.
    pub spent: Vec<(&'static str, Duration)>,
}

/// Settings and weather of a year, which do not depend on the systems in the apertures: read once, used for every
/// product.
#[derive(Clone)]
pub struct Climate {
    /// Settings: checked keys of `[year]`.
    pub settings: Settings,
    /// All steps of the weather file.
    pub steps: Arc<Steps>,
    latest: light::Latest,
}

/// Reads settings and weather of a scene's year. `base`: folder of the scene.
///
/// # Errors
/// Returns an error if the scene has no `[year]`, a key is wrong, or the weather file cannot be read.
pub fn climate(file: &SceneFile, base: &Path) -> Result<Climate, StudyError> {
    let settings = settings(file)?;
    let steps = Arc::new(steps::steps(file, &settings, base)?);
    Ok(Climate { settings, steps, latest: Default::default() })
}

/// Computes the annual simulation of a scene, for the steps for which `wanted` returns `true`. `base`: folder of the
/// scene.
///
/// # Errors
/// Returns the errors of [`climate`] and [`year_in`].
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

/// Computes an annual simulation like [`year`], but stores its hours while they are computed, and reads those that an
/// earlier run has stored (`kept`).
///
/// # Errors
/// Returns the errors of [`year`], and an error if the partial file cannot be written.
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

/// Scene, with the source of the systems in its apertures.
struct Systems<'a> {
    file: &'a SceneFile,
    base: &'a Path,
    library: &'a dyn SystemLibrary,
    session: &'a Session,
}

/// Computes an annual simulation with settings and weather that have been read before. `file` may name other systems
/// than the scene for which they were read; room, sensors, site and `[year]` must be the same. `wanted`: steps to be
/// computed.
///
/// # Errors
/// Returns an error for wrong systems or controls, if no step is wanted, or if cancelled.
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

/// Computes the annual simulation stage by stage: states, illuminances, LM-83 blinds, solar energy, glare.
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
    let Climate { settings, steps, latest } = climate.clone();
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
        None => light::light(&question, &states, &chosen, &latest, progress)?,
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
        direct_sun: light.sun.is_some() || retracted_sun.is_some(),
        light,
        retracted_sun,
        lm83,
        solar,
        dgp,
        notes,
        spent,
    })
}

/// Returns the scene at a step of its annual simulation, with the state of every moving aperture fixed. Its
/// illuminances, computed without a year, are those of the step. `time`: local standard time of the step.
///
/// # Errors
/// Returns the errors of [`year`], and an error if the weather does not contain the moment.
pub fn scene_at(
    file: &SceneFile,
    base: &Path,
    library: &dyn SystemLibrary,
    time: jiff::civil::DateTime,
    progress: &dyn Progress,
) -> Result<SceneFile, StudyError> {
    let Climate { settings, steps, .. } = climate(file, base)?;
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
