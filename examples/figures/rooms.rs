//! Numbers of Figures 19, 20 and 23–25: shadow edges, bright lines, illuminance along the depth of a room.

#![allow(dead_code, reason = "the pictures and the test each use their own part")]

use super::systems::{self, Place, along, totals};
use anyhow::Result;
use cfs::compute::basis::RingBasis;
use cfs::compute::btdf::Dataset;
use cfs::compute::direction::Surface;
use cfs::compute::room::near_field::homogeneity;
use cfs::compute::sky::SUN_HALF_ANGLE;
use std::f64::consts::PI;
use std::sync::Arc;

/// Width over which a normal distribution goes from 10 to 90 %, in standard deviations.
pub const NORMAL_WIDTH: f64 = 2.563;
/// Width from 10 to 90 % for a straight edge across a uniform disc, in radii.
pub const DISC_WIDTH: f64 = 1.3741;
/// Direct normal illuminance. \[lx\]
const DIRECT: f64 = 80_000.0;

/// Height of the shadow's edge above the plane in Figure 19. \[m\]
pub const EDGE: f64 = 1.0;

/// Illuminance profile across the edge of a shadow.
pub struct Profile {
    pub name: String,
    /// Distance from the point where the middle of the beam meets the plane \[m\], share of full sun.
    pub points: Vec<[f64; 2]>,
    /// Width of the transition from 10 to 90 %. \[m\]
    pub width: f64,
    /// Width by the closed form. \[m\]
    pub expected: f64,
}

/// Computes the profile of an edge 1 m above the plane for a beam at `altitude` \[°\]. `spread` is the standard
/// deviation of the system \[°\], `None` for the solar disc alone.
pub fn shadow(altitude: f64, spread: Option<f64>) -> Result<Profile> {
    let h = altitude.to_radians();
    let (name, sigma) = match spread {
        None => ("the sun's disc".to_owned(), SUN_HALF_ANGLE * DISC_WIDTH / NORMAL_WIDTH),
        Some(degrees) => (format!("spread {degrees}°"), degrees.to_radians()),
    };
    let middle = EDGE / h.tan();
    let expected = NORMAL_WIDTH * sigma * EDGE / h.sin().powi(2);
    let reach = (1.6 * expected).min(0.9 * middle);
    let ys: Vec<f64> = (0..=120).map(|k| middle - reach + 2.0 * reach * f64::from(k) / 120.0).collect();
    let place = Place {
        size: [60.0, 40.0, 30.0],
        apertures: vec![(Surface::Facade, [0.0, EDGE], [60.0, 29.0])],
        ground: 0.0,
        compute: "interpolation = \"patch\"",
        ..systems::side_lit(&systems::sun_alone(altitude), along(30.0, 0.0, ys.iter().copied()))
    };
    let system = match spread {
        None => systems::open(),
        Some(_) => systems::spread_beam(h, sigma),
    };
    let lux = totals(&place.room(&Arc::new(system))?);
    let full = DIRECT * h.sin();
    let points: Vec<[f64; 2]> = ys.iter().zip(&lux).map(|(y, e)| [y - middle, e / full]).collect();
    let most = points.iter().map(|p| p[1]).fold(0.0, f64::max);
    // Behind its edge a wide beam is not uniform: its width refers to the maximum of the profile.
    let top = if spread.is_none() { 1.0 } else { most };
    let at = |share: f64| crossing(&points, share * top);
    Ok(Profile { name, width: at(0.9) - at(0.1), expected, points })
}

/// Returns the position at which a rising profile reaches a value.
fn crossing(points: &[[f64; 2]], value: f64) -> f64 {
    let k = points.iter().position(|p| p[1] >= value).unwrap_or(points.len() - 1).max(1);
    let ([xa, ya], [xb, yb]) = (points[k - 1], points[k]);
    if yb > ya { xa + (xb - xa) * ((value - ya) / (yb - ya)).clamp(0.0, 1.0) } else { xb }
}

/// Returns the share of the solar disc above an edge at altitude `edge`, with the centre of the sun at altitude
/// `sun`: a circular segment. \[rad\]
pub fn disc_share(sun: f64, edge: f64) -> f64 {
    let t = ((sun - edge) / SUN_HALF_ANGLE).clamp(-1.0, 1.0);
    0.5 + (t.asin() + t * (1.0 - t * t).sqrt()) / PI
}

/// Returns the largest difference between the computed profile and the closed form, as a share of full sun.
pub fn shadow_deviation(altitude: f64, profile: &Profile) -> f64 {
    let h = altitude.to_radians();
    let middle = EDGE / h.tan();
    let truth = |x: f64| disc_share(h, (EDGE / (middle + x)).atan());
    profile.points.iter().map(|[x, share]| (share - truth(*x)).abs()).fold(0.0, f64::max)
}

/// Figure 20: illuminance of a horizontal plane at sill height, relative to that from a uniform area of the same flux.
pub struct Lines {
    pub period: f64,
    /// Distance \[m\]; relative illuminance from spots, its closed form; from endless lines, its closed form.
    pub points: Vec<[f64; 5]>,
    /// Distance from which on the uniform area is a valid approximation. \[m\]
    pub trusted: f64,
}

/// Computes an aperture 1 m high with bright spots one above the other, 1 mm high, every `period`, as in the report;
/// and with lines 60 m wide instead of spots.
pub fn lines(period: f64) -> Result<Lines> {
    const LINE: f64 = 1e-3;
    let distances: Vec<f64> = (0..=60).map(|k| 0.05 * 60_f64.powf(f64::from(k) / 60.0)).collect();
    let count = (1.0 / period).round() as usize;
    let system = Arc::new(systems::diffuser());
    let shares = |width: f64| -> Result<Vec<f64>> {
        let left = 30.0 - 0.5 * width;
        let even = Place {
            size: [60.0, 10.0, 3.0],
            apertures: vec![(Surface::Facade, [left, 1.0], [width, 1.0])],
            ground: 1.0,
            ..systems::side_lit(systems::UNIFORM, along(30.0, 1.0, distances.iter().copied()))
        };
        let strip = |k: usize| (Surface::Facade, [left, 1.0 + (k as f64 + 0.5) * period - 0.5 * LINE], [width, LINE]);
        let cut = Place { apertures: (0..count).map(strip).collect(), ..even.clone() };
        let (whole, parts) = (totals(&even.room(&system)?), totals(&cut.room(&system)?));
        Ok(whole.iter().zip(&parts).map(|(whole, parts)| parts * period / LINE / whole).collect())
    };
    let (spots, wide) = (shares(LINE)?, shares(60.0)?);
    let points = distances.iter().enumerate().map(|(k, &d)| {
        let truth = 1.0 + homogeneity::deviation(period, 1.0, d, 0.5).unwrap_or(0.0);
        // Endless lines: E of each is proportional to y d/(y² + d²)^1.5, of the area to 1 − d/√(1 + d²).
        let line = |y: f64| y * d / (y * y + d * d).powf(1.5);
        let sum: f64 = (0..count).map(|k| line((k as f64 + 0.5) * period)).sum();
        [d, spots[k], truth, wide[k], sum * period / (1.0 - d / 1_f64.hypot(d))]
    });
    Ok(Lines { period, points: points.collect(), trusted: homogeneity::distance(period) })
}

/// Figure 25: illuminance along the depth of the room with an open aperture, by three methods.
pub struct SunPatch {
    pub altitude: f64,
    /// Depth \[m\]; illuminance of open aperture, closed form, and data at 145 directions \[lx\].
    pub points: Vec<[f64; 4]>,
    /// Width from 10 to 90 % of the edge under the sill: from data at 145 directions, and by the closed form of their
    /// lobe. \[m\]
    pub blur: [f64; 2],
    /// Standard deviation of the lobe in the data. \[°\]
    pub data: f64,
    /// Light on all sensor points from data at 145 directions, relative to that of the open aperture.
    pub light: f64,
}

/// Height of the sensor points of Figure 25 above the floor. \[m\]
pub const PLANE: f64 = 0.1;

/// Computes direct sun at `altitude` \[°\] through the open aperture of the side-lit room.
pub fn sun_patch(altitude: f64, data: &Arc<Dataset>) -> Result<SunPatch> {
    let h = altitude.to_radians();
    let ys: Vec<f64> = (1..=240).map(|k| 0.025 * f64::from(k)).collect();
    let place = systems::side_lit(&systems::sun_alone(altitude), along(2.0, PLANE, ys.iter().copied()));
    let open = totals(&place.room(&Arc::new(systems::open()))?);
    let measured = totals(&place.room(data)?);
    let truth = |y: f64| {
        let seen = |height: f64| disc_share(h, ((height - PLANE) / y).atan());
        DIRECT * h.sin() * (seen(1.0) - seen(3.0))
    };
    let points: Vec<[f64; 4]> = (0..ys.len()).map(|k| [ys[k], open[k], truth(ys[k]), measured[k]]).collect();
    let near: Vec<[f64; 2]> = ys.iter().zip(&measured).map(|(y, e)| [*y, *e]).collect();
    let most = measured.iter().copied().fold(0.0, f64::max);
    let sigma = spread_of(data, h);
    let width = crossing(&near, 0.9 * most) - crossing(&near, 0.1 * most);
    let expected = NORMAL_WIDTH * sigma * (1.0 - PLANE) / h.sin().powi(2);
    Ok(SunPatch {
        altitude,
        points,
        blur: [width, expected],
        data: sigma.to_degrees(),
        light: measured.iter().sum::<f64>() / open.iter().sum::<f64>(),
    })
}

/// Returns the standard deviation, along one axis, of the indicatrix nearest to a sun perpendicular to the façade in
/// plan; the size of the cells is included. \[rad\]
fn spread_of(data: &Dataset, altitude: f64) -> f64 {
    use cfs::compute::btdf::Scattered;
    use cfs::compute::direction::Dir;
    let Some(Scattered::Directions(data)) = data.transmission().and_then(|btdf| btdf.scattered.as_ref()) else {
        return 0.0;
    };
    let row = data.nearest(Dir::from_theta_phi(altitude, 0.5 * PI));
    let centre = data.incident()[row].0.vector();
    let (mut flux, mut moment) = (0.0, 0.0);
    for (cell, q) in data.emergent().cells().zip(data.row(row).iter()) {
        for d in cfs::compute::basis::sub_directions(&cell, 3) {
            let share = q * cell.projected_solid_angle();
            flux += share;
            moment += share * (d.vector() - centre).length_squared();
        }
    }
    (0.5 * moment / flux).sqrt()
}

/// Returns the open aperture as measured at the 145 Tregenza directions with a beam of 1° on cells of 1.9°.
pub fn tregenza_data() -> Arc<Dataset> {
    Arc::new(systems::open_measured(&RingBasis::tregenza(), 48, systems::clear))
}

/// Curve of Figures 23 and 24.
pub struct Depth {
    pub situation: &'static str,
    pub system: &'static str,
    /// Depth \[m\]; direct and total illuminance, uncertainty of the total \[lx\].
    pub points: Vec<[f64; 4]>,
    /// Mean relative difference of the direct component from that of 200 × 200 point sources.
    pub distance: f64,
}

/// Computes Figures 23 and 24 in the model rooms: overcast and clear, side-lit and top-lit, diffuse and transparent.
pub fn depths() -> Result<Vec<Depth>> {
    let ys: Vec<f64> = (1..=12).map(|k| 0.5 * f64::from(k) - 0.25).collect();
    let points = along(2.0, 0.85, ys.iter().copied());
    let mut list = Vec::new();
    for (situation, place) in [
        ("side-lit, overcast", systems::side_lit(systems::OVERCAST, points.clone())),
        ("side-lit, clear", systems::side_lit(systems::CLEAR, points.clone())),
        ("top-lit, overcast", systems::top_lit(systems::OVERCAST, points.clone())),
        ("top-lit, clear", systems::top_lit(systems::CLEAR, points.clone())),
    ] {
        for (name, system) in [("transparent", systems::open()), ("diffuse", systems::diffuser())] {
            let system = Arc::new(system);
            let direct = totals(&place.room(&system)?);
            let by_points =
                Place { compute: "near_field = \"subdivision\"\nnear_field_samples = 40000", ..place.clone() };
            let by_points = totals(&by_points.room(&system)?);
            let grey = Place { reflectance: [0.2, 0.5, 0.7], ..place.clone() };
            let total = grey.room(&system)?;
            let off = direct.iter().zip(&by_points).map(|(e, p)| (e / p - 1.0).abs()).sum::<f64>();
            let points = (0..ys.len()).map(|k| {
                let sum = total.sensors[k].total();
                [ys[k], direct[k], sum.value, sum.error]
            });
            let points = points.collect();
            list.push(Depth { situation, system: name, points, distance: off / ys.len() as f64 });
        }
    }
    Ok(list)
}
