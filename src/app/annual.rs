//! Annual simulation in the window: executes its commands, starts its job, reads the weather file.

use super::command::Command;
use super::engine::Question;
use super::jobs::Lane;
use super::state::Shown;
use super::tiles;
use super::window::App;
use super::work::Outcome;
use super::year::{Calendar, YearAct, put_record, usual_year, weather_of};
use crate::study::sun_position::parse_local_time;
use crate::study::year::{Annual, at_step};
use crate::texts::{shell, year as say};
use jiff::civil::date;
use std::path::{Path, PathBuf};
use std::sync::Arc;

impl App {
    /// Executes a command about the annual simulation.
    pub(super) fn year_act(&mut self, act: YearAct) {
        match act {
            YearAct::Compute => self.compute_year(),
            YearAct::Look(look) => self.state.settings.year = look,
            YearAct::Show(step, _) => {
                if let Some(annual) = self.results.annual.value.clone()
                    && step < annual.year.steps.list.len()
                {
                    self.state.document.scene = at_step(&self.state.document.scene, &annual.year, step);
                }
            }
            YearAct::WeatherOfYear(name) => {
                let scene = &mut self.state.document.scene;
                let mut keys = scene.year.take().unwrap_or_else(|| usual_year(scene));
                keys.weather = name;
                scene.year = Some(keys);
            }
            YearAct::Weather(name) => self.take_weather(name),
            YearAct::Pick(time, _) => {
                let scene = &mut self.state.document.scene;
                if let Some(weather) = weather_of(scene).map(Path::to_owned) {
                    put_record(scene, &weather, time);
                }
            }
        }
    }

    /// Sets the weather file of the scene to `name`, for its sky at the current date and time and for its annual
    /// simulation.
    fn take_weather(&mut self, name: PathBuf) {
        let scene = &mut self.state.document.scene;
        if let Some(year) = &mut scene.year {
            year.weather.clone_from(&name);
        }
        let time = scene.sky.time.as_ref().and_then(|time| parse_local_time(&time.text()).ok());
        put_record(scene, &name, time.unwrap_or(date(2026, 3, 21).at(12, 0, 0, 0)));
    }

    fn compute_year(&mut self) {
        let Some(shelf) = self.state.shelf() else {
            self.toasts.info(shell::CATALOGUE_NOT_OPEN);
            return;
        };
        let scene = &mut self.state.document.scene;
        if scene.year.is_none() {
            let keys = usual_year(scene);
            self.toasts.info(say::ADDED_EYE);
            scene.year = Some(keys);
        }
        let question = Question { scene: scene.clone(), base: self.state.base(), shelf };
        let engine = self.services.engine.clone();
        self.results.annual.error = None;
        self.bring_up(tiles::YEAR);
        self.start(Lane::Annual, move |job| Outcome::Annual(engine.year(&question, job).map(Box::new)));
    }

    /// Starts reading the weather file from which hours are chosen, if the scene names another one than before.
    pub(super) fn ask_weather(&mut self) {
        let scene = &self.state.document.scene;
        let key = weather_of(scene).map(|name| {
            let year = scene.year.as_ref().filter(|year| year.weather == name);
            let own = (scene.sky.light, scene.sky.sun_offset_minutes);
            let (light, offset) = year.map_or(own, |year| (year.light, year.sun_offset_minutes));
            (name.to_owned(), self.state.base(), light, offset)
        });
        if key == self.asked_weather {
            return;
        }
        self.asked_weather.clone_from(&key);
        self.results.weather.stale = true;
        match key {
            Some(key) => self.start(Lane::Weather, move |_| Outcome::Weather(Calendar::read(key).map(Box::new))),
            None => {
                self.jobs.cancel(Lane::Weather);
                self.results.weather = Shown::default();
            }
        }
    }

    /// Sets the weather file of the scene to a file that was opened or dropped on the window.
    pub(super) fn take_weather_file(&mut self, path: &Path) {
        let base = self.state.base();
        // Beside the scene it is found wherever both go.
        let name = path.strip_prefix(&base).ok().filter(|_| !base.as_os_str().is_empty()).unwrap_or(path).to_owned();
        self.toasts.success(say::weather_taken(name.display()));
        self.apply(Command::Year(YearAct::Weather(name)));
    }

    /// Returns the result of the annual simulation, if it belongs to the current scene.
    pub(super) fn present_year(&self) -> Option<Arc<Annual>> {
        self.results.annual.value.clone().filter(|annual| annual.is_of(&self.state.document.scene))
    }
}
