//! Fields of summer time: the rule for the days on which the clock is one hour ahead of standard time.

use crate::app::panels::fields::{row, typed};
use crate::app::shell::clock;
use crate::app::shell::typing::read_date;
use crate::study::scene_file::{ANY_YEAR, DstKey, SceneFile};
use crate::texts::{Text, scene as texts};
use egui::{ComboBox, Ui};
use jiff::civil::date;

const fn word(key: DstKey) -> Text {
    match key {
        DstKey::None => texts::SUMMER_NONE,
        DstKey::Eu => texts::SUMMER_EU,
        DstKey::Us => texts::SUMMER_US,
        DstKey::Australia => texts::SUMMER_AUSTRALIA,
        DstKey::NewZealand => texts::SUMMER_NEW_ZEALAND,
        DstKey::Chile => texts::SUMMER_CHILE,
        DstKey::Days(..) => texts::SUMMER_DAYS,
    }
}

/// Returns the rules in the list; the first and last day of the rule with typed days are initially those of the
/// European Union in 2026.
fn choices() -> [DstKey; 7] {
    let days = DstKey::days(date(2026, 3, 29), date(2026, 10, 25));
    [DstKey::None, DstKey::Eu, DstKey::Us, DstKey::Australia, DstKey::NewZealand, DstKey::Chile, days]
}

/// Draws the fields of summer time.
pub fn show(ui: &mut Ui, scene: &mut SceneFile) {
    let key = &mut scene.site.dst;
    let choice = row(ui, texts::SUMMER_TIME.get(), |ui| {
        let combo = ComboBox::from_id_salt("summer time").width(118.0).selected_text(word(*key).get()).truncate();
        combo
            .show_ui(ui, |ui| {
                for one in choices() {
                    let chosen = word(*key) == word(one);
                    if ui.selectable_label(chosen, word(one).get()).clicked() && !chosen {
                        *key = one;
                    }
                }
            })
            .response
    });
    choice.on_hover_text(texts::SUMMER_TIP);
    if let DstKey::Days(first, last) = *key {
        let read = |text: &str| read_date(text, ANY_YEAR);
        if let Some(first) = typed(ui, texts::SUMMER_FIRST, &clock::day_of_year(first), texts::DATE_TIP, read) {
            *key = DstKey::days(first, last);
        }
        if let Some(last) = typed(ui, texts::SUMMER_LAST, &clock::day_of_year(last), texts::DATE_TIP, read) {
            *key = DstKey::days(first, last);
        }
    }
}
