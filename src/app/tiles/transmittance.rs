//! The transmittance tile: τ over the incident hemisphere, the sun's paths, and where the transmitted light goes.

use super::drawn::{Drawn, TileInput};
use crate::app::command::Command;
use crate::app::facing::{incident, sun_incident, surface};
use crate::app::incidence::Incidence;
use crate::app::jobs::Lane;
use crate::app::state::Tile;
use crate::app::views::Cache;
use crate::app::views::transmittance::{self, FluxSplit};
use crate::app::{moment, title};
use crate::compute::btdf::{Btdf, zone_shares};
use crate::compute::direction::{Incident, Surface};
use crate::study::scene_file::SceneFile;
use crate::study::sun_position::sun_path;
use egui::Ui;
use glam::DVec3;

/// The tile.
pub const TILE: Tile = Tile {
    title: "Transmittance",
    help: "The share of the light from each direction that enters the room. Task 31, eq 1.",
};

/// Elevations between the zones of the flux split from top to bottom. \[°\]
const LIMITS: [f64; 3] = [10.0, -10.0, -45.0];

/// Hours of a day and where the sun is.
type SunPath = Vec<(f64, Incident)>;
/// Place and bearing that sun paths hang on.
type PathKey = (i16, [u64; 4]);
/// Dataset, direction and surface that the flux split hangs on.
type SplitKey = (u64, Incident, bool);

/// Its drawing.
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
    (year, numbers.map(|number| number.unwrap_or(f64::NAN).to_bits()))
}

/// The sun on the 21st of each month while it is up, by hours; places behind the façade part a path in two.
fn sun_paths(scene: &SceneFile) -> Vec<SunPath> {
    let Some(place) = moment::place(scene) else { return Vec::new() };
    let year = path_key(scene).0;
    (1..=12)
        .map(|month| {
            let points = sun_path(&place, year, month, 21, 0.25).unwrap_or_default();
            points
                .into_iter()
                .filter(|point| point.altitude > 0.0)
                .map(|point| (point.hour, Incident(incident(scene, point.altitude, point.bearing))))
                .collect()
        })
        .collect()
}

/// Shares of the light from one direction that go to the zones; their sum is τ.
fn split(btdf: &Btdf, incident: Incident, surface: Surface) -> FluxSplit {
    let up = surface.facade_from_room(DVec3::Z);
    let shares = zone_shares(btdf, incident, up, LIMITS.map(f64::to_radians));
    FluxSplit { ceiling: shares[0], eye_zone: shares[1], work_zone: shares[2], floor: shares[3] }
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
        let incidence = Incidence::shown(state.incident, scene);
        let btdf = dataset.value.as_deref().and_then(|dataset| dataset.transmission());
        let split = btdf.map(|btdf| {
            let incident = incidence.direction;
            *self.split.get((revision, incident, surface == Surface::Roof), || split(btdf, incident, surface))
        });
        let name = title::selection(state);
        let key = path_key(scene);
        let input = transmittance::Input {
            btdf,
            name: &name,
            sun_paths: self.paths.get(key, || sun_paths(scene)),
            moment: sun_incident(scene),
            incidence,
            split,
            range: seen.scale,
            revision: revision.wrapping_add(key.1[3]),
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
