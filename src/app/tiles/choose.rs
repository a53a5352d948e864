//! The ranking tile: annual figures of products in this room, ranked on request.

use super::drawn::{Drawn, TileInput};
use crate::app::command::Command;
use crate::app::compare::view::Act;
use crate::app::paint::tile::Status;
use crate::app::rank::board::{ChooseAct, Figures, objectives_of};
use crate::app::shell::jobs::Lane;
use crate::app::state::{State, Tile};
use crate::app::title;
use crate::app::views::{Cache, choose as view};
use crate::app::year::input::{usual_year, weather_of_year};
use crate::catalogue::Filter;
use crate::study::rank::{Reason, Shortlist, Stage, figure_words, offered};
use crate::study::rank_keys::ObjectiveKeys;
use crate::texts::{Language, choose as say, language};
use egui::Ui;
use std::sync::Arc;

/// The ranking tile.
pub const TILE: Tile = Tile { title: "Choose", name: say::CHOOSE, help: say::CHOOSE_HELP };

type Ordered = Result<Arc<Shortlist>, String>;

/// Key of the explanation of a difference between two products: revision number of the results, objectives, the two
/// products, and the language.
type ReasonKey = (u64, Vec<ObjectiveKeys>, [Option<String>; 2], Language);

/// Drawing of the ranking tile, with its caches between frames.
#[derive(Default)]
pub struct Drawing {
    list: Cache<(u64, Vec<ObjectiveKeys>, String), Ordered>,
    reason: Cache<ReasonKey, Option<Reason>>,
}

/// Returns the name of the scene in tables: the path of its file, or empty.
pub fn scene_name(state: &State) -> String {
    state.scene_path.as_ref().map(|path| path.display().to_string()).unwrap_or_default()
}

/// Returns the reason why the ranking has to be computed (again), if there is one.
fn due(figures: &Figures, stale: bool, objectives: &[ObjectiveKeys]) -> view::Due {
    let unknown = objectives.iter().any(|one| !figures.knows(&one.figure));
    match (stale, figures.unfinished()) {
        (true, _) => view::Due::Changed,
        (false, 1..) => view::Due::Unfinished(figures.unfinished()),
        (false, 0) if unknown => view::Due::Figure,
        (false, 0) => view::Due::Nothing,
    }
}

/// Returns the figures that can be added as objectives, without those that are objectives already.
fn offers(state: &State, figures: Option<&Figures>, objectives: &[ObjectiveKeys]) -> Vec<view::Offer> {
    let scene = &state.document.scene;
    let list = offered(scene.year.as_ref().unwrap_or(&usual_year(scene)));
    let free = list.into_iter().filter(|one| !objectives.iter().any(|own| own.figure == one.keys.figure));
    let offer = |keys: ObjectiveKeys| {
        let known = figures.is_some_and(|figures| figures.knows(&keys.figure));
        view::Offer { name: figure_words(&keys.figure).0, known, keys }
    };
    free.map(|one| offer(one.keys)).collect()
}

impl Drawn for Drawing {
    fn lanes(&self) -> &'static [Lane] {
        &[Lane::Rank]
    }

    fn ready(&self, seen: &TileInput<'_>) -> bool {
        seen.results.rank.value.is_some() || seen.state.shelf().is_some()
    }

    fn show(&mut self, ui: &mut Ui, seen: &TileInput<'_>, commands: &mut Vec<Command>) -> Option<String> {
        let (state, result) = (seen.state, &seen.results.rank);
        let scene = &state.document.scene;
        let figures = result.value.as_deref();
        let look = &state.settings.choose;
        let objectives = objectives_of(scene);
        let of = result.revision;
        let ordered = figures.map(|figures| {
            let name = scene_name(state);
            let make = || figures.shortlist(&name, &objectives).map(Arc::new).map_err(|error| error.to_string());
            self.list.get((of, objectives.clone(), name.clone()), make).clone()
        });
        let list = ordered.as_ref().and_then(|list| list.as_deref().ok());
        let reason = list.and_then(|list| {
            let pair = [look.product.clone(), look.against.clone()];
            let make = || list.reason(look.product.as_deref()?, look.against.as_deref());
            self.reason.get((of, objectives.clone(), pair, language()), make).as_ref()
        });
        let busy = (seen.busy)(Lane::Rank);
        let pace = seen.results.rank_pace;
        let running = busy.then(|| view::Running {
            coarse: pace.is_some_and(|pace| pace.stage == Stage::Coarse),
            done: pace.map_or(0, |pace| pace.done),
            all: pace.map_or(0, |pace| pace.all),
            left: pace.and_then(|pace| pace.left()),
        });
        let wrong = ordered.as_ref().and_then(|list| list.as_ref().err().map(String::as_str));
        let offers = offers(state, figures, &objectives);
        let weather = weather_of_year(scene);
        let name = title::place(scene);
        let stale = figures.is_some() && result.stale;
        let input = view::Input {
            list,
            reason,
            look,
            objectives: &objectives,
            offers: &offers,
            weather: &weather,
            name: &name,
            in_room: &state.document.selection.product,
            search: Filter::all().any(|filter| state.query.has(filter)).then_some(state.found.entries.len()),
            apertures: scene.aperture.len(),
            running,
            due: figures.map_or(view::Due::Nothing, |figures| due(figures, stale, &objectives)),
            error: wrong.or(result.error.as_deref()).filter(|_| !busy),
            status: Status { idle: !busy, ..seen.status(stale, None) },
        };
        for action in view::show(ui, &input) {
            commands.push(match action {
                view::Action::Rank => Command::Choose(ChooseAct::Rank),
                view::Action::Stop => Command::Cancel(Lane::Rank),
                view::Action::Look(look) => Command::Choose(ChooseAct::Look(look)),
                view::Action::Objectives(list, step) => Command::Choose(ChooseAct::Objectives(list, step)),
                view::Action::IntoRoom(product) => Command::Choose(ChooseAct::IntoRoom(product)),
                view::Action::Compare(product) => Command::Compare(Act::AddProduct(product)),
            });
        }
        seen.numbers.then(|| list.map(Shortlist::csv)).flatten()
    }
}
