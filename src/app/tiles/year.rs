//! The year tile: an annual simulation of the room, computed on request.

use super::drawn::{Drawn, TileInput};
use crate::app::command::Command;
use crate::app::paint::tile::Status;
use crate::app::scene::moment;
use crate::app::shell::jobs::Lane;
use crate::app::state::Tile;
use crate::app::title;
use crate::app::views::{Cache, year as view};
use crate::app::year::input::{YearAct, weather_of_year};
use crate::drawing::hour_map::HourMap;
use crate::study::weather::warning_words;
use crate::study::year::{Annual, Day, Look, Row, day, map, months, sunniest, table};
use crate::texts::{Language, language, year as say};
use egui::Ui;

/// The year tile.
pub const TILE: Tile = Tile { title: "Year", name: say::YEAR, help: say::YEAR_HELP };

/// Drawing of the year tile, with its caches between frames.
#[derive(Default)]
pub struct Drawing {
    view: view::State,
    map: Cache<(u64, Look, Language), HourMap>,
    rows: Cache<(u64, Language), Vec<Row>>,
    day: Cache<(u64, u8), Option<Day>>,
    months: Cache<u64, Option<[(f64, f64); 12]>>,
}

/// Returns the remarks beside the annual figures: defects of the weather file, and a note if the state shown differs
/// from that in the annual simulation. `now`: index of the step of the scene's date and time.
fn remarks(seen: &TileInput<'_>, annual: &Annual, now: Option<usize>) -> String {
    let warnings = annual.year.steps.weather_warnings.iter().map(|code| warning_words(code).to_owned());
    let all = warnings.chain(Some(other_state(seen, annual, now)).filter(|words| !words.is_empty()));
    all.collect::<Vec<_>>().join(". ")
}

/// Returns a note if the state shown for the scene's date and time differs from the state in the annual simulation at
/// that step (index `now`); otherwise an empty text.
fn other_state(seen: &TileInput<'_>, annual: &Annual, now: Option<usize>) -> String {
    let state = seen.state;
    let aperture = state.control_aperture() + 1;
    let moving = annual.year.moving.iter().position(|one| one.aperture == aperture);
    let Some((m, step)) = moving.zip(now) else { return String::new() };
    let own = &annual.year.moving[m].device.keys[annual.year.states[step][m]];
    let there = &state.shown_state;
    let known = !there.is_empty() && !state.dataset.stale && annual.year.steps.list[step].hour.is_lit();
    if known && own != there { say::other_state(own, there) } else { String::new() }
}

impl Drawn for Drawing {
    fn lanes(&self) -> &'static [Lane] {
        &[Lane::Annual]
    }

    fn ready(&self, seen: &TileInput<'_>) -> bool {
        seen.results.annual.value.is_some() || seen.state.shelf().is_some()
    }

    fn show(&mut self, ui: &mut Ui, seen: &TileInput<'_>, commands: &mut Vec<Command>) -> Option<String> {
        let state = seen.state;
        let scene = &state.document.scene;
        let result = &seen.results.annual;
        let annual = result.value.as_deref();
        let look = state.settings.year;
        let of = result.revision;
        let month = moment::of(scene).map_or(6, |time| time.month().unsigned_abs());
        let now = annual.and_then(|annual| annual.now(scene));
        let remark = annual.map_or_else(String::new, |annual| remarks(seen, annual, now));
        let shown = match annual {
            Some(annual) => {
                let of_day = look.month.unwrap_or(month);
                Some(view::Shown {
                    year: &annual.year,
                    map: self.map.get((of, Look { page: Default::default(), month: None, ..look }, language()), || {
                        map(&annual.year, &look)
                    }),
                    rows: self.rows.get((of, language()), || table(annual)),
                    day: self
                        .day
                        .get((of, of_day), || sunniest(&annual.year, of_day).and_then(|date| day(&annual.year, date)))
                        .as_ref(),
                    months: self.months.get(of, || months(annual)).as_ref(),
                    now,
                    remark: &remark,
                })
            }
            None => None,
        };
        let busy = (seen.busy)(Lane::Annual);
        let name = title::in_room(state);
        let weather = weather_of_year(scene);
        let stale = annual.is_some_and(|annual| !annual.is_of(scene));
        let input = view::Input {
            shown,
            look,
            month,
            name: &name,
            weather: &weather,
            running: busy.then(|| (seen.done)(Lane::Annual).unwrap_or(0.0)),
            error: result.error.as_deref().filter(|_| !busy),
            revision: hash(of, &look),
            status: Status { idle: !busy, ..seen.status(stale, None) },
        };
        for action in view::show(ui, &input, &mut self.view) {
            commands.push(match action {
                view::Action::Compute => Command::Year(YearAct::Compute),
                view::Action::Stop => Command::Cancel(Lane::Annual),
                view::Action::Look(look) => Command::Year(YearAct::Look(look)),
                view::Action::Show(step, walking) => Command::Year(YearAct::Show(step, walking)),
                view::Action::Weather(name) => Command::Year(YearAct::WeatherOfYear(name)),
                view::Action::Open => Command::Open,
            });
        }
        (seen.numbers && input.shown.is_some()).then(|| view::csv(&input))
    }
}

/// Returns a hash that identifies a map of hours, from the revision number of the results and the display settings.
fn hash(revision: u64, look: &Look) -> u64 {
    use std::hash::{DefaultHasher, Hash, Hasher};
    let mut hasher = DefaultHasher::new();
    (revision, look.shows, look.log, language()).hash(&mut hasher);
    hasher.finish()
}
