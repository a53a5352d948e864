//! The transmittance tile: transmittance τ over the incident hemisphere, sun paths, and the flux split, i.e. the shares
//! of the transmitted flux by zone of emergent directions.

use super::drawn::{Drawn, TileInput};
use crate::app::command::Command;
use crate::app::scene::facing::{sun_incident, surface};
use crate::app::scene::incidence::Incidence;
use crate::app::scene::moment;
use crate::app::shell::jobs::Lane;
use crate::app::state::Tile;
use crate::app::title;
use crate::app::views::Cache;
use crate::app::views::transmittance::{self, FluxSplit};
use crate::compute::direction::{Incident, Surface};
use crate::study::incoming::{SunPath, flux_split, sun_paths};
use crate::study::scene_file::SceneFile;
use crate::texts::tiles as say;
use egui::Ui;
use std::path::PathBuf;

/// The transmittance tile.
pub const TILE: Tile = Tile { title: "Transmittance", name: say::TRANSMITTANCE, help: say::TRANSMITTANCE_HELP };

/// Key of the cached sun paths: year; latitude, longitude, UTC offset and azimuth of the façade as bits; weather file.
type PathKey = (i16, [u64; 4], Option<PathBuf>);
/// Key of the cached flux split: revision number of the dataset, incident direction, and whether the aperture lies in
/// the roof.
type SplitKey = (u64, Incident, bool);

/// Drawing of the transmittance tile, with its caches between frames.
#[derive(Default)]
pub struct Drawing {
    view: transmittance::State,
    paths: Cache<PathKey, Vec<SunPath>>,
    split: Cache<SplitKey, FluxSplit>,
}

fn path_key(scene: &SceneFile) -> PathKey {
    let site = &scene.site;
    let numbers = [site.latitude, site.longitude, site.utc_offset, Some(site.azimuth)];
    let year = moment::of(scene).map_or(2026, |time| time.year());
    (year, numbers.map(|number| number.unwrap_or(f64::NAN).to_bits()), scene.sky.weather.clone())
}

impl Drawn for Drawing {
    fn ready(&self, seen: &TileInput<'_>) -> bool {
        seen.state.dataset.value.is_some()
    }

    fn show(&mut self, ui: &mut Ui, seen: &TileInput<'_>, commands: &mut Vec<Command>) -> Option<String> {
        let state = seen.state;
        let scene = &state.document.scene;
        let dataset = &state.dataset;
        let revision = dataset.revision;
        let surface = surface(scene);
        // The light that the BTDF tile shows.
        let incidence = Incidence::shown(state.incident, scene, &state.base());
        let btdf = dataset.value.as_deref().and_then(|dataset| dataset.transmission());
        let split = btdf.map(|btdf| {
            let incident = incidence.direction;
            *self.split.get((revision, incident, surface == Surface::Roof), || flux_split(btdf, incident, surface))
        });
        let name = title::selection(state);
        let key = path_key(scene);
        let facing = key.1[3];
        let input = transmittance::Input {
            btdf,
            name: &name,
            sun_paths: self.paths.get(key, || sun_paths(scene, moment::place(scene, &state.base()))),
            moment: sun_incident(scene, &state.base()),
            incidence,
            split,
            range: seen.scale,
            revision: revision.wrapping_add(facing),
            status: seen.status_of(dataset, Lane::Scene),
        };
        for action in transmittance::show(ui, &input, &mut self.view) {
            match action {
                transmittance::Action::ChooseIncidence(chosen) => commands.push(Command::Incidence(Some(chosen))),
            }
        }
        seen.numbers.then(|| transmittance::csv(&input))
    }
}
