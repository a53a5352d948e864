//! Annual simulation in the window: executes its commands, starts its job, reads the weather file.

pub mod input;

use crate::app::results::engine::Question;
use crate::app::results::work::Outcome;
use crate::app::shell::Shell;
use crate::app::shell::jobs::Lane;
use crate::app::state::{Shown, State};
use crate::app::tiles;
use crate::study::sun_position::parse_local_time;
use crate::study::year::at_step;
use crate::texts::{shell, year as say};
use input::{Calendar, CalendarKey, YearAct, put_record, usual_year, weather_of};
use jiff::civil::date;
use std::path::{Path, PathBuf};

/// Annual simulation of the window, except its result.
#[derive(Default)]
pub struct CalendarRequest {
    /// Key of the calendar of weather data that was last requested.
    asked_weather: Option<CalendarKey>,
}

impl CalendarRequest {
    /// Starts reading the weather file from which hours are chosen, if the scene names another one than before.
    pub fn ask_weather(&mut self, shell: &mut Shell) {
        let scene = &shell.state.document.scene;
        let key = weather_of(scene).map(|name| {
            let year = scene.year.as_ref().filter(|year| year.weather == name);
            let own = (scene.sky.light, scene.sky.sun_offset_minutes);
            let (light, offset) = year.map_or(own, |year| (year.light, year.sun_offset_minutes));
            (name.to_owned(), shell.state.base(), light, offset)
        });
        if key == self.asked_weather {
            return;
        }
        self.asked_weather.clone_from(&key);
        shell.results.weather.stale = true;
        match key {
            Some(key) => shell.start(Lane::Weather, move |_| Outcome::Weather(Calendar::read(key).map(Box::new))),
            None => {
                shell.jobs.cancel(Lane::Weather);
                shell.results.weather = Shown::default();
            }
        }
    }
}

/// Executes a command about the annual simulation.
pub fn act(shell: &mut Shell, act: YearAct) {
    match act {
        YearAct::Compute => compute(shell),
        YearAct::Look(look) => shell.state.settings.year = look,
        YearAct::Show(step, _) => {
            if let Some(annual) = shell.results.annual.value.clone()
                && step < annual.year.steps.list.len()
            {
                shell.state.document.scene = at_step(&shell.state.document.scene, &annual.year, step);
            }
        }
        YearAct::WeatherOfYear(name) => {
            let scene = &mut shell.state.document.scene;
            let mut keys = scene.year.take().unwrap_or_else(|| usual_year(scene));
            keys.weather = name;
            scene.year = Some(keys);
        }
        YearAct::Weather(name) => take_weather(shell, name),
        YearAct::Pick(time, _) => {
            let scene = &mut shell.state.document.scene;
            if let Some(weather) = weather_of(scene).map(Path::to_owned) {
                put_record(scene, &weather, time);
            }
        }
    }
}

/// Sets the weather file of the scene to `name`, for its sky at the current date and time and for its annual
/// simulation.
fn take_weather(shell: &mut Shell, name: PathBuf) {
    let scene = &mut shell.state.document.scene;
    if let Some(year) = &mut scene.year {
        year.weather.clone_from(&name);
    }
    let time = scene.sky.time.as_ref().and_then(|time| parse_local_time(&time.text()).ok());
    put_record(scene, &name, time.unwrap_or(date(2026, 3, 21).at(12, 0, 0, 0)));
}

/// Starts the annual simulation of the scene, which gets default settings if it has none.
fn compute(shell: &mut Shell) {
    let Some(shelf) = shell.state.shelf() else {
        shell.toasts.info(shell::CATALOGUE_NOT_OPEN);
        return;
    };
    let scene = &mut shell.state.document.scene;
    if scene.year.is_none() {
        let keys = usual_year(scene);
        shell.toasts.info(say::ADDED_EYE);
        scene.year = Some(keys);
    }
    let question = Question { scene: scene.clone(), base: shell.state.base(), shelf };
    let engine = shell.services.engine.clone();
    shell.results.annual.error = None;
    shell.bring_up(tiles::YEAR);
    shell.start(Lane::Annual, move |job| Outcome::Annual(engine.year(&question, job).map(Box::new)));
}

/// Returns the name by which the scene names a weather file that was opened or dropped on the window.
pub fn weather_name(state: &State, path: &Path) -> PathBuf {
    let base = state.base();
    // Beside the scene it is found wherever both go.
    path.strip_prefix(&base).ok().filter(|_| !base.as_os_str().is_empty()).unwrap_or(path).to_owned()
}
