//! Proposed file names: product, state and moment, in characters that every system accepts.

use crate::app::export::choices::{ReportKind, What};
use crate::app::scene::moment;
use crate::app::scene::own_system;
use crate::app::shell::safe_name::safe;
use crate::app::state::{PathUse, State};
use crate::app::title;
use crate::report::TileKind;
use crate::study::scene_file::SystemKeys;
use std::path::PathBuf;

/// Returns the selected product as part of a file name.
fn product(state: &State) -> String {
    let product = safe(&state.document.selection.product);
    if product.is_empty() { "window".to_owned() } else { product }
}

/// Returns the system in the aperture as parts of a file name: the selected product and state, or the scene's ideal
/// system or dataset file.
fn in_room(state: &State) -> [String; 2] {
    let words = |keys: &SystemKeys| [safe(&title::system(keys).to_lowercase()), String::new()];
    own_system(&state.document.scene).map_or_else(|| [product(state), safe(&state.shown_state)], words)
}

/// Returns a file name made from system, state, date and time, e.g. `venetian-80-72_45_2026-03-21T1200`, and the tile,
/// if one is given.
fn study(state: &State, tile: Option<TileKind>) -> String {
    let [system, of] = match tile {
        Some(TileKind::Btdf | TileKind::Transmittance | TileKind::Control) => {
            [product(state), safe(&state.shown_state)]
        }
        _ => in_room(state),
    };
    let scene = &state.document.scene;
    let time = match (moment::of(scene), scene.sky.sun.altitude, scene.sky.sun.azimuth) {
        (Some(time), _, _) => time.strftime("%Y-%m-%dT%H%M").to_string(),
        (None, Some(altitude), Some(azimuth)) => format!("sun-{altitude:.0}-{azimuth:.0}"),
        _ => String::new(),
    };
    let words = [system, of, time];
    words.into_iter().filter(|word| !word.is_empty()).collect::<Vec<_>>().join("_")
}

/// Returns the proposed name of a file for the given purpose.
pub fn file_name(state: &State, what: PathUse) -> String {
    match what {
        PathUse::Open | PathUse::ReplaceState | PathUse::Subscribe => String::new(),
        PathUse::SaveScene => format!("{}.toml", study(state, None)),
        PathUse::ExportLid => format!("{}.ldt", study(state, None)),
        PathUse::ExportTile(tile) => {
            format!("{}_{}.csv", study(state, TileKind::titled(tile.title)), safe(&tile.title.to_lowercase()))
        }
        PathUse::Export => export_name(state),
        PathUse::ExportMeasured => "system.cfsp".to_owned(),
    }
}

/// Returns the proposed name of an export.
fn export_name(state: &State) -> String {
    let choices = &state.settings.export;
    let (ending, tile) = (choices.ending(), choices.tile.word());
    let product = product(state);
    match choices.what {
        What::Picture | What::Table => format!("{}_{tile}{ending}", study(state, Some(choices.tile))),
        What::Report if choices.report == ReportKind::Sheet => format!("{product}_sheet{ending}"),
        What::Report => format!("{}_study{ending}", study(state, None)),
        What::Series => format!("{}_index{ending}", in_room(state)[0]),
        What::Package => format!("{product}{ending}"),
        What::Dataset => {
            let shown = safe(&state.shown_state);
            let of = if shown.is_empty() { String::new() } else { format!("_{shown}") };
            format!("{product}{of}{ending}")
        }
        What::Luminaire | What::Scene => format!("{}{ending}", study(state, None)),
    }
}

/// Returns the proposed path for writing a file: for the scene its path, otherwise a name in the folder used last, or
/// in the user's documents folder.
pub fn start_path(state: &State, what: PathUse) -> PathBuf {
    if let (PathUse::SaveScene, Some(path)) = (what, &state.scene_path) {
        return path.clone();
    }
    let last = state.settings.folder.clone();
    let own = || {
        let folders = directories::UserDirs::new()?;
        Some(folders.document_dir().map_or_else(|| folders.home_dir().to_owned(), PathBuf::from))
    };
    last.or_else(own).unwrap_or_default().join(file_name(state, what))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::scene::Selection;
    use crate::app::state::Settings;
    use crate::app::tiles::TILES;
    use crate::study::scene_file::IdealKind;

    #[test]
    fn names_say_product_state_and_moment_in_safe_characters() {
        let mut state = State::new(Settings::default());
        state.document.selection = Selection { product: "venetian-80-72".to_owned(), state: String::new() };
        state.shown_state = "45".to_owned();
        assert_eq!(file_name(&state, PathUse::ExportLid), "venetian-80-72_45_2026-03-21T1200.ldt");
        assert_eq!(file_name(&state, PathUse::ExportTile(TILES[0].tile)), "venetian-80-72_45_2026-03-21T1200_btdf.csv");
        state.shown_state = "-35 °/\\:*? up".to_owned();
        assert_eq!(file_name(&state, PathUse::SaveScene), "venetian-80-72_-35-up_2026-03-21T1200.toml");
        state.document.scene.sky.time = None;
        (state.document.scene.sky.sun.altitude, state.document.scene.sky.sun.azimuth) = (Some(30.0), Some(185.0));
        assert_eq!(file_name(&state, PathUse::ExportLid), "venetian-80-72_-35-up_sun-30-185.ldt");
        assert_eq!(file_name(&state, PathUse::ExportMeasured), "system.cfsp");
        // A scene of its own system: the room's files are called by it, the product's by the product.
        let ideal = SystemKeys::Ideal { kind: IdealKind::Diffuse, transmittance: 0.6 };
        state.document.scene.aperture[0].system = ideal;
        assert_eq!(file_name(&state, PathUse::ExportLid), "ideal-diffuser_sun-30-185.ldt");
        let btdf = file_name(&state, PathUse::ExportTile(TILES[0].tile));
        assert_eq!(btdf, "venetian-80-72_-35-up_sun-30-185_btdf.csv");
        state.settings.folder = Some("/data/daylight".into());
        assert_eq!(start_path(&state, PathUse::ExportLid).parent().unwrap().to_str(), Some("/data/daylight"));
        state.scene_path = Some("/data/office.toml".into());
        assert_eq!(start_path(&state, PathUse::SaveScene).to_str(), Some("/data/office.toml"));
    }
}
