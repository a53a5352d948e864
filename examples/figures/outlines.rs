//! Numbers of Figure 21: luminous intensity distributions of the ideal diffuser and of the open aperture, compared with
//! eq 19 and eq 20 of the report.

#![allow(dead_code, reason = "the pictures and the test each use their own part")]

use super::systems::{self, CLEAR, OVERCAST, Place};
use anyhow::Result;
use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::btdf::Dataset;
use cfs::compute::direction::{Dir, Emergent, Facade};
use cfs::compute::lid::{Facing, Lid};
use cfs::compute::quadrature::gauss_legendre;
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::Arc;

/// Returns the four situations: name, room with sky.
pub fn situations() -> [(&'static str, Place); 4] {
    [
        ("roof, overcast", systems::top_lit(OVERCAST, vec![[2.0, 3.0, 0.0]])),
        ("roof, clear, sun at 20°", systems::top_lit(CLEAR, vec![[2.0, 3.0, 0.0]])),
        ("façade, overcast", systems::side_lit(OVERCAST, vec![[2.0, 3.0, 0.0]])),
        ("façade, clear, sun at 20°", systems::side_lit(CLEAR, vec![[2.0, 3.0, 0.0]])),
    ]
}

/// Name of the finest of the measured data.
pub const FINEST: &str = "directions: 145, cells of 1.2°";

/// Returns datasets of the open aperture with increasing resolution: patch-averaged data, and data as measured by an
/// instrument with a beam of 2° (standard deviation). The last one is regular transmission.
pub fn resolutions() -> Vec<(&'static str, Arc<Dataset>)> {
    let klems = |basis: fn(AzimuthMap) -> RingBasis| systems::open_cells(&basis(AzimuthMap::KLEMS_FRONT));
    [
        ("cells: Klems quarter, 41", klems(RingBasis::klems_quarter)),
        ("cells: Klems full, 145", klems(RingBasis::klems_full)),
        ("cells: equal area, 576", systems::open_cells(&RingBasis::equal_area(12))),
        ("cells: equal area, 2304", systems::open_cells(&RingBasis::equal_area(24))),
        ("directions: 36, cells of 1.2°", systems::open_measured(&RingBasis::equal_area(3), 72, systems::clear_2)),
        ("directions: 145, cells of 3.7°", systems::open_measured(&RingBasis::tregenza(), 24, systems::clear_2)),
        ("directions: 145, cells of 1.9°", systems::open_measured(&RingBasis::tregenza(), 48, systems::clear_2)),
        (FINEST, systems::open_measured(&RingBasis::tregenza(), 72, systems::clear_2)),
        ("regular transmission", systems::open()),
    ]
    .into_iter()
    .map(|(name, dataset)| (name, Arc::new(dataset)))
    .collect()
}

/// Returns the luminance of the outside seen through the aperture: eq 20 with τ = 1. \[cd/m²\]
pub fn outside(facing: &Facing<'_>, twin: Dir<Facade>) -> f64 {
    facing.outside.luminance(facing.orientation.world_from_room(facing.surface.room_dir(twin)))
}

/// Returns the misplaced flux compared with eq 20, ½∫|L − L_e| cosθ dω / ∫L_e cosθ dω, at 40 000 directions.
pub fn misplaced(lid: &Lid, facing: &Facing<'_>) -> f64 {
    let (mut off, mut all) = (0.0, 0.0);
    for cell in RingBasis::equal_area(100).cells() {
        let twin = cell.centre();
        let truth = outside(facing, twin);
        off += (lid.luminance(Emergent::from_undeviated(twin)) - truth).abs();
        all += truth;
    }
    0.5 * off / all
}

/// Computes the illuminance of the aperture with Gauss points in altitude and azimuth, separately for sky and ground.
/// Independent of the method of the program. \[lx\]
pub fn illuminance(facing: &Facing<'_>) -> f64 {
    let normal = facing.surface.room_from_facade(DVec3::Z);
    let nodes: Vec<(f64, f64)> = (0..24)
        .flat_map(|part| gauss_legendre(8).into_iter().map(move |(x, w)| ((f64::from(part) + x) / 24.0, w / 24.0)))
        .collect();
    let mut sum = 0.0;
    for (low, high) in [(-0.5 * PI, 0.0), (0.0, 0.5 * PI)] {
        for &(x, wx) in &nodes {
            let (sin, cos) = (low + (high - low) * x).sin_cos();
            for &(u, wu) in &nodes {
                // Two half circles of azimuth: one in front of the façade (normal −y), one behind it.
                for half in [0.0, PI] {
                    let (sin_phi, cos_phi) = (half + PI * u).sin_cos();
                    let d = DVec3::new(cos * cos_phi, -cos * sin_phi, sin);
                    let cosine = d.dot(normal);
                    if cosine > 0.0 {
                        let luminance = facing.outside.luminance(facing.orientation.world_from_room(Dir::from_unit(d)));
                        sum += luminance * cosine * cos * wx * wu * (high - low) * PI;
                    }
                }
            }
        }
    }
    sum
}

/// Returns the largest relative deviation of the luminance of an ideal diffuser from E/π over the hemisphere, for three
/// forms of data (constant, patch-averaged, measured at 145 directions).
pub fn diffuser_deviation(place: &Place) -> Result<f64> {
    let klems = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
    let emergent = RingBasis::equal_area(12);
    let cells = systems::measured(&klems, &emergent, systems::opal).to_cells();
    let given = [
        (1.0, systems::diffuser()),
        (0.5, systems::dataset("cells", cfs::compute::btdf::Btdf::from_cells(cells))),
        (0.5, systems::of_directions("measured", systems::measured(&RingBasis::tregenza(), &emergent, systems::opal))),
    ];
    let mut worst: f64 = 0.0;
    for (tau, system) in given {
        let (scene, light) = place.lid(&Arc::new(system))?;
        let truth = tau * illuminance(&scene.facing(0)) / PI;
        for cell in RingBasis::equal_area(16).cells() {
            let luminance = light.lid.luminance(Emergent::from_undeviated(cell.centre()));
            worst = worst.max((luminance / truth - 1.0).abs());
        }
    }
    Ok(worst)
}

/// Row of the table of Figure 21.
pub struct Line {
    pub situation: &'static str,
    pub resolution: &'static str,
    pub misplaced: f64,
    /// Flux into the room relative to the flux on the aperture.
    pub transmittance: f64,
}

/// Computes all resolutions in all situations.
pub fn table() -> Result<Vec<Line>> {
    let mut lines = Vec::new();
    for (resolution, system) in resolutions() {
        for (situation, place) in situations() {
            let (scene, light) = place.lid(&system)?;
            let facing = scene.facing(0);
            let flux = illuminance(&facing) * light.lid.area();
            lines.push(Line {
                situation,
                resolution,
                misplaced: misplaced(&light.lid, &facing),
                transmittance: light.flux.value / flux,
            });
        }
    }
    Ok(lines)
}

/// Samples an intensity along the vertical section through the sun, at angles of −90° to 90° from the normal; `towards`
/// is the sign of y at positive angles. \[°, unit of `intensity`\]
pub fn section(intensity: impl Fn(Dir<Facade>) -> f64, towards: f64) -> Vec<[f64; 2]> {
    (-90..=90)
        .map(|k| {
            let angle = f64::from(k);
            let v = DVec3::new(0.0, towards * angle.to_radians().sin(), angle.to_radians().cos());
            [angle, intensity(Dir::from_unit(v))]
        })
        .collect()
}
