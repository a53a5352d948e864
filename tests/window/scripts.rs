//! Names in scripts that the built-in fonts do not have.

use crate::driven::{select, services, settle};
use cfs::app::catalogue::shelf::{Addition, Query, Shelf};
use cfs::app::display::font_search::FontSearch;
use cfs::app::display::fonts::{FindFonts, no_fonts};
use cfs::app::results::backend::ideals_shelf;
use cfs::app::shell::error::AppError;
use cfs::app::state::Settings;
use cfs::app::{App, Services};
use cfs::catalogue::NewProduct;
use cfs::compute::btdf::Dataset;
use cfs::drawing::font::DEJAVU;
use egui::FontData;
use egui_kittest::Harness;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A catalogue with a blind of a Chinese maker.
fn shelf() -> Result<Arc<dyn Shelf>, AppError> {
    let shelf = ideals_shelf()?;
    let first = shelf.search(&Query::default())?.entries[0].clone();
    let dataset = Dataset { name: "铝百叶窗".to_owned(), ..(*shelf.load(&first.key, None)?).clone() };
    let product =
        NewProduct { name: "铝百叶窗 80".to_owned(), manufacturer: "窗帘".to_owned(), ..NewProduct::default() };
    shelf.add(&Addition { datasets: vec![Arc::new(dataset)], product })?;
    Ok(shelf)
}

fn window(services: Services, find_fonts: FindFonts) -> Harness<'static, App> {
    let mut app = App::new(services, Settings::default());
    app.fonts = FontSearch::new(find_fonts);
    let mut harness =
        Harness::builder().with_size([1280.0, 720.0]).with_max_steps(200).allow_missing_glyphs().build_ui_state(
            |ui, app: &mut App| {
                let ctx = ui.ctx().clone();
                app.logic(&ctx);
                app.draw(ui);
            },
            app,
        );
    settle(&mut harness);
    harness
}

#[test]
fn characters_that_no_font_has_are_named_once() {
    let mut harness = window(services(shelf), no_fonts);
    select(&mut harness, |entry| entry.name.starts_with('铝'));
    let messages = harness.state().shell.toasts.all().map(|message| &message.text);
    let named: Vec<_> = messages.filter(|text| text.contains("铝 (U+94DD)")).collect();
    assert_eq!(named.len(), 1, "{named:?}");
}

#[test]
fn fonts_are_looked_for_when_a_text_needs_them_and_not_before() {
    static SEARCHES: AtomicUsize = AtomicUsize::new(0);
    let find: FindFonts = |characters| {
        assert!(characters.iter().all(|c| "铝百叶窗帘".contains(*c)), "{characters:?}");
        SEARCHES.fetch_add(1, Ordering::Relaxed);
        (vec![("found".to_owned(), FontData::from_static(DEJAVU))], Vec::new())
    };
    let known =
        |harness: &Harness<'_, App>| harness.ctx.fonts(|fonts| fonts.definitions().font_data.contains_key("found"));
    let harness = window(services(ideals_shelf), find);
    assert!(SEARCHES.load(Ordering::Relaxed) == 0 && !known(&harness));
    let mut harness = window(services(shelf), find);
    select(&mut harness, |entry| entry.name.starts_with('铝'));
    assert!((1..4).contains(&SEARCHES.load(Ordering::Relaxed)) && known(&harness));
    assert!(!harness.state().shell.toasts.all().any(|message| message.text.contains("U+")));
}
