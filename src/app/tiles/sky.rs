//! The sky tile: luminances of sky and surroundings as seen from the façade; the sun can be dragged.

use super::drawn::{Drawn, TileInput};
use crate::app::command::Command;
use crate::app::scene::facing::surface;
use crate::app::scene::moment;
use crate::app::shell::jobs::Lane;
use crate::app::state::Tile;
use crate::app::title;
use crate::app::views::sky;
use crate::compute::angle::Bearing;
use crate::compute::direction::{Dir, Surface};
use crate::study::scene_file::SkyModelKey;
use crate::texts::tiles as say;
use egui::Ui;

/// The sky tile.
pub const TILE: Tile = Tile { title: "Sky", name: say::SKY, help: say::SKY_HELP };

/// Drawing of the sky tile, with its state between frames.
#[derive(Default)]
pub struct Drawing {
    view: sky::State,
}

impl Drawn for Drawing {
    fn log(&mut self) -> Option<&mut bool> {
        Some(&mut self.view.log)
    }

    fn lanes(&self) -> &'static [Lane] {
        &[Lane::Lid]
    }

    fn ready(&self, seen: &TileInput<'_>) -> bool {
        seen.state.daylight.value.is_some() || seen.state.daylight.error.is_some()
    }

    fn show(&mut self, ui: &mut Ui, seen: &TileInput<'_>, commands: &mut Vec<Command>) -> Option<String> {
        let state = seen.state;
        let scene = &state.document.scene;
        let daylight = state.daylight.value.as_deref();
        let luminance = daylight.map(|daylight| {
            let outside = daylight.seen.as_deref().unwrap_or(&daylight.outside);
            move |altitude: f64, bearing: f64| {
                outside.luminance(Dir::from_altitude_bearing(altitude, Bearing::from_radians(bearing)))
            }
        });
        let name = title::sky(scene);
        let place = |(altitude, bearing): (f64, f64)| sky::Place { altitude, bearing: bearing.to_radians() };
        let input = sky::Input {
            luminance: luminance.as_ref().map(|function| function as &dyn Fn(f64, f64) -> f64),
            name: &name,
            // A weather has its own place and clock.
            sun: match daylight.filter(|_| scene.sky.model == SkyModelKey::Weather) {
                Some(daylight) => daylight.sun.map(|sun| sky::Place {
                    altitude: sun.direction.altitude(),
                    bearing: sun.direction.bearing().radians(),
                }),
                None => moment::sun_of_site(scene).map(place),
            },
            behind_boxes: daylight.is_some_and(|daylight| daylight.seen.is_some()),
            facade_bearing: scene.site.azimuth.to_radians(),
            skyline: daylight.map_or(0.0, |daylight| daylight.outside.skyline_altitude()),
            diffuse_horizontal: daylight.map(|daylight| daylight.outside.diffuse_horizontal()),
            direct_horizontal: daylight.map(|daylight| daylight.sun.map_or(0.0, |sun| sun.horizontal())),
            facade_vertical: (surface(scene) == Surface::Facade)
                .then(|| seen.results.lid.value.as_ref().and_then(|lid| lid.incident))
                .flatten(),
            facade_stale: seen.results.lid.stale,
            range: seen.scale,
            revision: state.daylight.revision,
            status: seen.status_of(&state.daylight, Lane::Scene),
        };
        for action in sky::show(ui, &input, &mut self.view) {
            if let sky::Action::SunDragged { place, free, date } = action {
                let mut scene = scene.clone();
                if free || !moment::towards(&mut scene, place.altitude, place.bearing, date) {
                    scene.sky.time = None;
                    scene.sky.sun.altitude = Some(place.altitude.to_degrees());
                    scene.sky.sun.azimuth = Some(place.bearing.to_degrees());
                }
                commands.push(Command::Scene(Box::new(scene)));
            }
        }
        seen.numbers.then(|| sky::csv(&input))
    }
}
