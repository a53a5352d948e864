//! When the clock is an hour ahead of standard time.

use crate::app::clock;
use crate::app::moment;
use crate::app::panels::fields::{row, typed};
use crate::app::typing::read_date;
use crate::study::scene_file::{DstKey, SceneFile};
use crate::texts::{Text, scene as texts};
use egui::{ComboBox, Ui};
use jiff::civil::date;

const fn word(key: DstKey) -> Text {
    match key {
        DstKey::None => texts::SUMMER_NONE,
        DstKey::Eu => texts::SUMMER_EU,
        DstKey::Us => texts::SUMMER_US,
        DstKey::Days(..) => texts::SUMMER_DAYS,
    }
}

/// Draws its fields.
pub fn show(ui: &mut Ui, scene: &mut SceneFile) {
    let year = moment::of(scene).map_or(2026, |time| time.year());
    let key = &mut scene.site.dst;
    let days = DstKey::Days(date(year, 3, 29), date(year, 10, 25));
    let choice = row(ui, texts::SUMMER_TIME.get(), |ui| {
        let combo = ComboBox::from_id_salt("summer time").width(118.0).selected_text(word(*key).get()).truncate();
        combo
            .show_ui(ui, |ui| {
                for one in [DstKey::None, DstKey::Eu, DstKey::Us, days] {
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
        let read = |text: &str| read_date(text, year);
        if let Some(first) = typed(ui, texts::SUMMER_FIRST, &clock::date(first), texts::DATE_TIP, read) {
            *key = DstKey::Days(first, last.max(first));
        }
        let read = |text: &str| match read_date(text, year)? {
            day if day < first => Err(texts::summer_order(clock::date(first))),
            day => Ok(day),
        };
        if let Some(last) = typed(ui, texts::SUMMER_LAST, &clock::date(last), texts::DATE_TIP, read) {
            *key = DstKey::Days(first, last);
        }
    }
}
