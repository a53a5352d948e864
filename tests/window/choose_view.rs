//! Choosing in the window: asked for, ranked as results come, stopped and gone on with, weighed, looked at, taken into the
//! room and the tray, handed on.

use crate::choose_engine::{Ranks, addition, shelf};
use crate::driven::{apply, coarsen, frames, frames_in, settle, step_until};
use crate::legible::can_be_read;
use crate::legible::inspect::words;
use cfs::app::App;
use cfs::app::catalogue::shelf::Query;
use cfs::app::command::Command;
use cfs::app::compare::view::Act;
use cfs::app::display::language::LanguageChoice;
use cfs::app::display::theme::ThemeChoice;
use cfs::app::export::choices::{Preview, What};
use cfs::app::rank::board::{ChooseAct, objectives_of};
use cfs::app::results::backend::{StudyEngine, ideals_shelf};
use cfs::app::shell::jobs::Lane;
use cfs::app::tiles::CHOOSE;
use cfs::app::year::input::YearAct;
use cfs::report::TileKind;
use cfs::study::rank::{Look, Page, Sort};
use cfs::study::scene_file::SystemKeys;
use egui::accesskit::Role;
use egui::{Key, Theme};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::sync::Arc;
use std::sync::atomic::Ordering;

const ASK: &str = "Rank the catalogue for this façade";
const LIST: &str = "Ranked products; arrow keys select, Enter puts one into the room";

fn window_in(theme: Theme, size: [f32; 2]) -> (Harness<'static, App>, Arc<Ranks>) {
    let engine = Arc::new(Ranks::default());
    let mut harness = frames_in(theme, App::with_shelf(engine.clone(), shelf), size);
    settle(&mut harness);
    apply(&mut harness, Command::Select("a".to_owned()));
    apply(&mut harness, Command::Maximise(Some(CHOOSE)));
    (harness, engine)
}

fn window() -> (Harness<'static, App>, Arc<Ranks>) {
    window_in(Theme::Dark, [1280.0, 720.0])
}

fn ranked() -> (Harness<'static, App>, Arc<Ranks>) {
    let (mut harness, engine) = window();
    apply(&mut harness, Command::Choose(ChooseAct::Rank));
    (harness, engine)
}

/// Keys in the order that the window has them in.
fn order(harness: &Harness<'_, App>) -> String {
    let app = harness.state();
    let figures = app.shell.results.rank.value.as_ref().expect("a ranking");
    let list = figures.shortlist("", &objectives_of(&app.shell.state.document.scene)).unwrap();
    list.shown(&app.shell.state.settings.choose).iter().map(|entry| entry.product.as_str()).collect()
}

fn look(harness: &mut Harness<'_, App>, change: impl FnOnce(&mut Look)) {
    let mut look = harness.state().shell.state.settings.choose.clone();
    change(&mut look);
    apply(harness, Command::Choose(ChooseAct::Look(Box::new(look))));
}

/// Weights of the objectives in their order.
fn weigh(harness: &mut Harness<'_, App>, weights: &[f64]) {
    let mut list = objectives_of(&harness.state().shell.state.document.scene);
    for (one, weight) in list.iter_mut().zip(weights) {
        one.weight = *weight;
    }
    apply(harness, Command::Choose(ChooseAct::Objectives(list, false)));
}

#[test]
fn a_click_ranks_the_catalogue_and_undo_takes_what_it_put_into_the_scene() {
    let (mut harness, engine) = window();
    let before = harness.state().shell.state.document.scene.clone();
    assert_eq!((&before.year, &before.rank), (&None, &None));
    assert!(harness.state().shell.results.rank.value.is_none(), "nothing is computed that nobody asked for");
    harness.get_by_label(ASK).click();
    step_until(&mut harness, "it begins", |app| app.works_in(Lane::Rank) || app.shell.results.rank.value.is_some());
    settle(&mut harness);
    assert_eq!(engine.years.load(Ordering::Relaxed), 5);
    let scene = &harness.state().shell.state.document.scene;
    let counts: Vec<&str> = scene.rank.as_ref().unwrap().objective.iter().map(|one| one.figure.as_str()).collect();
    assert_eq!(counts[..2], ["lighting.LENI_kWh_m2", "UDI_a"]);
    assert!(counts.iter().any(|figure| figure.starts_with("glare.Ev_1.")) && counts.contains(&"movements"));
    // What is left out is folded, and says why.
    assert_eq!(harness.query_all_by_label_contains("Excluded: ").count(), 0);
    harness.get_by_label("excluded (1)").click();
    settle(&mut harness);
    harness.get_by_label("Empty frame: Excluded: no transmission for light from outside");
    assert_eq!(order(&harness).len(), 5);
    apply(&mut harness, Command::Undo);
    assert_eq!(harness.state().shell.state.document.scene, before);
}

#[test]
fn coarse_results_come_first_a_stop_keeps_them_and_it_goes_on_from_there() {
    let (mut harness, engine) = window();
    engine.hold.store(true, Ordering::Relaxed);
    harness.state_mut().apply(Command::Choose(ChooseAct::Rank));
    step_until(&mut harness, "data on cells", |app| {
        app.shell.results.rank.value.as_ref().is_some_and(|figures| figures.known.len() == 5)
    });
    harness.run_steps(2);
    assert!(harness.state().works_in(Lane::Rank), "beams as they are are still to come");
    assert_eq!(order(&harness).len(), 4);
    let figures = harness.state().shell.results.rank.value.clone().unwrap();
    assert_eq!(figures.unfinished(), 5);
    assert!(words(&harness).iter().any(|text| text.contains("5 products")), "{:?}", words(&harness));
    harness.get_by_label("Stop").click();
    harness.run_steps(2);
    settle(&mut harness);
    assert!(!harness.state().works_in(Lane::Rank) && engine.years.load(Ordering::Relaxed) == 0);
    assert_eq!(order(&harness).len(), 4, "what was found stays");
    engine.hold.store(false, Ordering::Relaxed);
    harness.get_by_label("Continue").click();
    harness.run_steps(2);
    settle(&mut harness);
    assert_eq!(engine.years.load(Ordering::Relaxed), 5);
    assert_eq!(harness.state().shell.results.rank.value.as_ref().unwrap().unfinished(), 0);
    assert!(harness.query_by_label("Continue").is_none());
}

#[test]
fn weights_and_further_objectives_order_anew_without_computing() {
    let (mut harness, engine) = ranked();
    weigh(&mut harness, &[5.0, 0.1, 0.1, 0.1]);
    assert_eq!(order(&harness), "dcba");
    weigh(&mut harness, &[0.1, 5.0, 0.1, 0.1]);
    assert_eq!(order(&harness), "abcd");
    // By a slider that stands there.
    look(&mut harness, |look| look.page = Page::Objectives);
    harness.get_by_role_and_label(Role::Slider, "Weight of Lighting energy LENI").focus();
    harness.run_steps(2);
    for _ in 0..45 {
        harness.key_press(Key::ArrowRight);
        harness.run_steps(1);
    }
    settle(&mut harness);
    let weight = harness.state().shell.state.document.scene.rank.as_ref().unwrap().objective[0].weight;
    assert!(weight > 4.0, "{weight}");
    weigh(&mut harness, &[5.0, 0.1]);
    assert_eq!(order(&harness), "dcba");
    // One more, whose figure is known of all.
    let mut list = objectives_of(&harness.state().shell.state.document.scene);
    list.push(cfs::study::rank_keys::ObjectiveKeys {
        figure: "UDI_x".to_owned(),
        better: cfs::study::rank_keys::BetterKey::Less,
        worst: 0.3,
        best: 0.0,
        weight: 50.0,
    });
    let before = harness.state().shell.state.document.scene.clone();
    apply(&mut harness, Command::Choose(ChooseAct::Objectives(list, true)));
    assert_eq!(order(&harness), "acdb");
    assert!(harness.query_by_label("Compute").is_none() && harness.query_by_label("Rank again").is_none());
    // One that is not.
    let mut list = objectives_of(&harness.state().shell.state.document.scene);
    list[4].figure = "sun_hours_1000".to_owned();
    apply(&mut harness, Command::Choose(ChooseAct::Objectives(list, true)));
    assert_eq!(engine.years.load(Ordering::Relaxed), 5);
    harness.get_by_label("Compute").click();
    harness.run_steps(2);
    settle(&mut harness);
    // What no year can be computed of is not tried again.
    assert_eq!(engine.years.load(Ordering::Relaxed), 9);
    assert_eq!(order(&harness).len(), 4);
    apply(&mut harness, Command::Undo);
    apply(&mut harness, Command::Undo);
    assert_eq!(harness.state().shell.state.document.scene, before);
}

#[test]
fn another_room_is_told_going_back_costs_nothing_and_a_new_product_costs_one() {
    let (mut harness, engine) = ranked();
    assert!(harness.query_by_label("Rank again").is_none());
    let mut scene = harness.state().shell.state.document.scene.clone();
    scene.site.azimuth = 90.0;
    apply(&mut harness, Command::Scene(Box::new(scene)));
    assert!(harness.query_by_label("outdated").is_some());
    harness.get_by_label("Rank again").click();
    harness.run_steps(2);
    settle(&mut harness);
    assert_eq!(engine.years.load(Ordering::Relaxed), 10);
    // Back: what was found there is shown at once.
    let mut scene = harness.state().shell.state.document.scene.clone();
    scene.site.azimuth = 180.0;
    apply(&mut harness, Command::Scene(Box::new(scene)));
    assert!(harness.query_by_label("outdated").is_none() && harness.query_by_label("Rank again").is_none());
    assert_eq!(harness.state().shell.results.rank.value.as_ref().unwrap().asked.scene.site.azimuth, 180.0);
    // Neither another moment nor another product in the room makes another question.
    apply(&mut harness, Command::Hour(2));
    apply(&mut harness, Command::Select("c".to_owned()));
    assert!(harness.query_by_label("Rank again").is_none());
    assert_eq!(engine.years.load(Ordering::Relaxed), 10);
    // The catalogue has one more; the others are known.
    harness.state().shell.state.shelf().unwrap().add(&addition("f", "Foil", 0.1)).unwrap();
    apply(&mut harness, Command::Choose(ChooseAct::Rank));
    assert_eq!(engine.years.load(Ordering::Relaxed), 11);
    look(&mut harness, |look| look.excluded = true);
    assert_eq!(order(&harness).len(), 6);
}

#[test]
fn the_search_limits_what_is_ranked() {
    let (mut harness, engine) = window();
    apply(&mut harness, Command::Find(Query { text: "pane".to_owned(), ..Query::default() }));
    harness.get_by_label("only search results (2)").click();
    settle(&mut harness);
    harness.get_by_label(ASK).click();
    harness.run_steps(2);
    settle(&mut harness);
    assert_eq!((order(&harness).len(), engine.years.load(Ordering::Relaxed)), (2, 2));
    // All of them again: two are known.
    apply(&mut harness, Command::Find(Query::default()));
    look(&mut harness, |look| look.in_search = false);
    harness.get_by_label("Rank again").click();
    harness.run_steps(2);
    settle(&mut harness);
    assert_eq!((order(&harness).len(), engine.years.load(Ordering::Relaxed)), (4, 5));
}

#[test]
fn keys_walk_enter_takes_into_the_room_and_undo_takes_it_back() {
    let (mut harness, _) = ranked();
    weigh(&mut harness, &[5.0, 0.1, 0.1, 0.1]);
    harness.get_by_label(LIST).focus();
    harness.run_steps(2);
    for key in [Key::ArrowDown, Key::ArrowDown, Key::ArrowDown, Key::ArrowUp] {
        harness.key_press(key);
        harness.run_steps(2);
    }
    assert_eq!(harness.state().shell.state.settings.choose.product.as_deref(), Some("c"));
    let moment = harness.state().shell.state.document.scene.sky.clone();
    harness.key_press(Key::Enter);
    harness.run_steps(2);
    settle(&mut harness);
    let in_room = |harness: &Harness<'_, App>| match &harness.state().shell.state.document.scene.aperture[0].system {
        SystemKeys::Catalogue { key, .. } => key.clone(),
        other => panic!("{other:?}"),
    };
    assert_eq!(
        (in_room(&harness), harness.state().shell.state.document.selection.product.clone()),
        ("c".into(), "c".into())
    );
    assert_eq!(harness.state().shell.state.document.scene.sky, moment, "arrows were the list's");
    apply(&mut harness, Command::Undo);
    assert_eq!(in_room(&harness), "a");
    // Two clicks into the tray: the row, the button.
    let row = harness.query_all_by_label_contains("Deep screen: score").next().expect("its row");
    row.click();
    settle(&mut harness);
    harness.get_by_label("Add to comparison").click();
    settle(&mut harness);
    let tray: Vec<String> =
        harness.state().shell.state.document.scene.compare.iter().map(|one| one.name.clone()).collect();
    assert_eq!(tray, ["Deep screen"]);
    harness.get_by_label("Put into the room").click();
    settle(&mut harness);
    assert_eq!(in_room(&harness), "d");
    apply(&mut harness, Command::Undo);
    apply(&mut harness, Command::Compare(Act::Clear));
}

#[test]
fn a_chosen_aperture_is_filled_and_the_other_one_stays() {
    let (mut harness, _) = window();
    let mut scene = harness.state().shell.state.document.scene.clone();
    let mut second = scene.aperture[0].clone();
    scene.aperture[0].size[0] = 1.0;
    (second.origin[0], second.size[0]) = (2.0, 1.0);
    scene.aperture.push(second);
    apply(&mut harness, Command::Scene(Box::new(scene)));
    look(&mut harness, |look| look.aperture = Some(1));
    apply(&mut harness, Command::Choose(ChooseAct::Rank));
    let asked = &harness.state().shell.results.rank.value.as_ref().unwrap().asked.scene;
    let open: Vec<bool> = asked.aperture.iter().map(|one| one.system == SystemKeys::Ranked).collect();
    assert_eq!(open, [false, true]);
    apply(&mut harness, Command::Choose(ChooseAct::IntoRoom("d".to_owned())));
    let keys = |harness: &Harness<'_, App>| {
        let list = &harness.state().shell.state.document.scene.aperture;
        list.iter().map(|one| format!("{:?}", one.system)).collect::<Vec<_>>()
    };
    assert!(keys(&harness)[0].contains("\"a\"") && keys(&harness)[1].contains("\"d\""), "{:?}", keys(&harness));
    assert!(harness.query_by_label("Rank again").is_none(), "the other one is as it was");
    apply(&mut harness, Command::Undo);
    assert!(keys(&harness)[1].contains("\"a\""));
}

#[test]
fn why_one_is_before_another_adds_up_in_words() {
    let (mut harness, _) = ranked();
    weigh(&mut harness, &[1.0, 1.0, 0.1, 0.1]);
    look(&mut harness, |look| (look.product, look.against) = (Some("d".to_owned()), Some("b".to_owned())));
    let said = words(&harness);
    let line = said.iter().find(|text| text.contains("by Lighting energy")).unwrap_or_else(|| panic!("{said:?}"));
    assert!(line.contains("4.00 kWh/m² against 12.0 kWh/m² (−8.00 kWh/m² in winter, no sun, rear)"), "{line}");
    let app = harness.state();
    let list = app.shell.results.rank.value.as_ref().unwrap();
    let list = list.shortlist("", &objectives_of(&app.shell.state.document.scene)).unwrap();
    let reason = list.reason("d", Some("b")).unwrap();
    let sum: f64 = reason.terms.iter().map(|term| term.score_difference).sum();
    let worth = |key: &str| list.entry(key).unwrap().score.value;
    assert!((sum - (worth("d") - worth("b"))).abs() < 1e-12);
    // An approximate one says why.
    look(&mut harness, |look| (look.product, look.against) = (Some("b".to_owned()), None));
    assert!(words(&harness).iter().any(|text| text == "Approximate: measured in 13 directions"));
}

#[test]
fn rows_are_filtered_sorted_and_handed_on() {
    let (mut harness, _) = ranked();
    harness.get_by_label("Sort by Product").click();
    settle(&mut harness);
    assert_eq!(
        (order(&harness), harness.state().shell.state.settings.choose.sort.clone()),
        ("abdc".to_owned(), Sort::Name)
    );
    look(&mut harness, |look| look.words = "PANE".to_owned());
    assert_eq!(order(&harness), "ab");
    look(&mut harness, |look| (look.words, look.sort) = (String::new(), Sort::Score));
    let mut choices = harness.state().shell.state.settings.export.clone();
    (choices.what, choices.tile) = (What::Table, TileKind::Choose);
    apply(&mut harness, Command::ExportTile(CHOOSE));
    apply(&mut harness, Command::ExportChoices(Box::new(choices.clone())));
    let shown = |harness: &Harness<'_, App>| match harness.state().export.preview() {
        Some(Ok(Preview::Picture([width, height], ..))) => format!("{width} {height}"),
        Some(Ok(Preview::Text(text, _))) => text.clone(),
        Some(Err(error)) => panic!("{error}"),
        Some(Ok(Preview::Files(_))) | None => panic!("no preview"),
    };
    // The columns of `cfs rank --out`.
    let table = shown(&harness);
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let head: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    assert_eq!(head[..5], ["scene", "climate", "azimuth", "product", "lighting.LENI_kWh_m2"]);
    assert_eq!(head[head.len() - 4..], ["front", "approximate", "excluded", "why"]);
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 5);
    assert_eq!(rows[..4].iter().map(|row| &row[3]).collect::<String>(), order(&harness));
    assert_eq!(&rows[4][3], "e");
    for page in [Page::Table, Page::Plot] {
        look(&mut harness, |look| look.page = page);
        (choices.what, choices.vector) = (What::Picture, true);
        apply(&mut harness, Command::ExportChoices(Box::new(choices.clone())));
        assert_eq!(shown(&harness), "900 675");
    }
}

#[test]
fn without_a_ranking_nothing_of_it_is_handed_on_and_an_empty_search_is_told() {
    let (mut harness, _) = window();
    let mut choices = harness.state().shell.state.settings.export.clone();
    (choices.what, choices.tile) = (What::Table, TileKind::Choose);
    apply(&mut harness, Command::ExportTile(CHOOSE));
    apply(&mut harness, Command::ExportChoices(Box::new(choices)));
    let Some(Err(told)) = &harness.state().export.preview() else { panic!("a ranking out of nothing") };
    assert!(told.contains("compute one in the Ranking tile"), "{told}");
    apply(&mut harness, Command::Sheet(None));
    apply(&mut harness, Command::Find(Query { text: "qqqqqqqq".to_owned(), ..Query::default() }));
    look(&mut harness, |look| look.in_search = true);
    apply(&mut harness, Command::Choose(ChooseAct::Rank));
    let error = harness.state().shell.results.rank.error.clone().expect("it is told");
    assert!(error.contains("No product matches"), "{error}");
}

#[test]
fn all_pages_can_be_read_in_light_and_dark() {
    for theme in [Theme::Light, Theme::Dark] {
        let (mut harness, _) = window_in(theme, [1100.0, 700.0]);
        let choice = if theme == Theme::Light { ThemeChoice::Light } else { ThemeChoice::Dark };
        apply(&mut harness, Command::Theme(choice));
        can_be_read(&mut harness, "before a ranking");
        apply(&mut harness, Command::Choose(ChooseAct::Rank));
        look(&mut harness, |look| (look.product, look.excluded) = (Some("b".to_owned()), true));
        for (page, what) in [(Page::Table, "table"), (Page::Plot, "plot"), (Page::Objectives, "objectives")] {
            look(&mut harness, |look| look.page = page);
            can_be_read(&mut harness, &format!("the choice's {what}"));
            apply(&mut harness, Command::Language(LanguageChoice::German));
            can_be_read(&mut harness, &format!("the choice's {what} in German"));
            apply(&mut harness, Command::Language(LanguageChoice::English));
        }
    }
}

#[test]
fn what_the_ranking_says_of_a_product_is_what_its_year_says() {
    let app = App::with_shelf(Arc::new(StudyEngine::default()), ideals_shelf);
    let mut harness = frames(app, [1280.0, 720.0]);
    coarsen(&mut harness, [2, 1]);
    settle(&mut harness);
    let found = harness.state().shell.state.found.clone();
    let key = |name: &str| found.entries.iter().find(|entry| entry.name == name).unwrap().key.clone();
    let (diffuser, opening) = (key("Ideal diffuser"), key("Clear opening"));
    apply(&mut harness, Command::Maximise(Some(CHOOSE)));
    apply(&mut harness, Command::Choose(ChooseAct::Rank));
    let error = harness.state().shell.results.rank.error.clone();
    let figures = harness.state().shell.results.rank.value.clone().unwrap_or_else(|| panic!("{error:?}"));
    assert_eq!((figures.known.len(), figures.unfinished()), (2, 0));
    apply(&mut harness, Command::Choose(ChooseAct::IntoRoom(diffuser.clone())));
    apply(&mut harness, Command::Year(YearAct::Compute));
    let annual = harness.state().shell.results.annual.value.clone().unwrap();
    let useful = annual.figures[0].autonomy.udi_a.iter().sum::<f64>() / 2.0;
    let energy = annual.figures[0].lighting.as_ref().unwrap().total();
    let scene = harness.state().shell.state.document.scene.clone();
    let list = figures.shortlist("", &objectives_of(&scene)).unwrap();
    let own = list.entry(&diffuser).unwrap();
    assert!((own.figures[0].value - energy).abs() < 1e-6 * energy, "{:?} {energy}", own.figures);
    assert!((own.figures[1].value - useful).abs() < 1e-9, "{:?} {useful}", own.figures);
    // Computing the year and weighing are no reason to rank again, and weights are none to compute the year again.
    apply(&mut harness, Command::Maximise(Some(CHOOSE)));
    weigh(&mut harness, &[3.0]);
    assert!(!harness.state().shell.results.rank.stale && annual.is_of(&harness.state().shell.state.document.scene));
    assert!(list.entry(&opening).is_some());
}
