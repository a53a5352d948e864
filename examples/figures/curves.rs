//! Control curves of blinds: slat angle over the profile angle of the sun, continuous and in the states of a device.
//! Used by the picture and by the test of its statements.

#![allow(dead_code, reason = "the picture and the test each use their own part")]

use cfs::compute::control::controller::{Controller, Inputs, Rounding, Rule, Settings, SunAt};
use cfs::compute::control::cut_off::SlatRow;
use cfs::compute::sky::SUN_HALF_ANGLE;
use cfs::compute::system::slats::SlatProfile;

/// Elevation at which the redirecting blind sends light into the room. \[°\]
pub const ELEVATION: f64 = 30.0;
/// Step between the states of the device. \[°\]
pub const STEP: f64 = 5.0;

/// Control curve, and the states of a device that follows it.
pub struct Characteristic {
    pub name: &'static str,
    /// Points (profile angle, slat angle). \[°\]
    pub points: Vec<[f64; 2]>,
    /// Points (profile angle, slat angle of the state), chosen for the whole solar disc. \[°\]
    pub steps: Vec<[f64; 2]>,
    /// Section of the slats, for rules that need it.
    pub section: Option<SlatRow>,
}

/// Returns the section of flat slats, 80 mm every 72 mm.
pub fn flat() -> Option<SlatRow> {
    SlatRow::new(SlatProfile::Flat { width: 0.080 }, 0.072)
}

/// Returns the section of slats on an arc, chord 80 mm, pitch 72 mm, crown 16 mm over the chord.
pub fn curved() -> Option<SlatRow> {
    SlatRow::new(SlatProfile::Arc { width: 0.080, rise: 0.016 }, 0.072)
}

/// Returns the profile angles of the picture. \[°\]
fn angles() -> impl Iterator<Item = f64> {
    (1..=179).map(|k| 0.5 * f64::from(k))
}

/// Computes the curve of a rule, and the states of a device in steps of 5° over a range of slat angles \[°\].
fn characteristic(name: &'static str, rule: Rule, [low, high]: [i32; 2]) -> Option<Characteristic> {
    let section = match &rule {
        Rule::CutOff { section, .. } => Some(section.clone()),
        _ => None,
    };
    let values: Vec<f64> =
        (0..=(high - low) / 5).map(|k| (f64::from(low) + STEP * f64::from(k)).to_radians()).collect();
    let settings = Settings::new(values.clone(), rule)?;
    let points = settings.curve().iter().map(|(psi, tilt)| [psi.to_degrees(), tilt.to_degrees()]).collect();
    let steps = angles().map(|degrees| {
        let centre = degrees.to_radians();
        let sun = SunAt { centre, span: [centre - SUN_HALF_ANGLE, centre + SUN_HALF_ANGLE] };
        let inputs = Inputs {
            hour: 12.0,
            of_year: None,
            day: true,
            sun: Some(sun),
            facade_direct: 50_000.0,
            facade_global: 60_000.0,
            indoor: None,
        };
        [degrees, values[Controller::new(settings.clone()).step(0.0, &inputs).state].to_degrees()]
    });
    Some(Characteristic { name, points, steps: steps.collect(), section })
}

/// Computes all curves: cut-off of flat and of curved slats; retro-reflection and redirection of mirror slats.
pub fn all() -> Option<Vec<Characteristic>> {
    let cut_off = |section| Rule::CutOff { section, tolerance: 0.0 };
    Some(vec![
        characteristic("cut-off, flat slats", cut_off(flat()?), [0, 80])?,
        characteristic("cut-off, curved slats", cut_off(curved()?), [0, 80])?,
        characteristic("retro-reflection", Rule::RetroReflect(Rounding::Closed), [-45, 90])?,
        characteristic("redirection", Rule::Redirect(ELEVATION.to_radians(), Rounding::Nearest), [-45, 90])?,
    ])
}

/// Returns the largest share of direct sun, over all points of the solar disc, that the states pass if all of them are
/// more open by `shift`. \[°\]
pub fn leak(curve: &Characteristic, shift: f64) -> f64 {
    let Some(section) = &curve.section else { return 0.0 };
    let shares = curve.steps.iter().flat_map(|[psi, tilt]| {
        (-4..=4).map(move |k| {
            let psi = psi.to_radians() + 0.25 * f64::from(k) * SUN_HALF_ANGLE;
            section.direct_share((tilt - shift).to_radians(), psi)
        })
    });
    shares.fold(0.0, f64::max)
}

/// Returns the largest difference between states and curve, while the curve is within their range. \[°\]
pub fn rounding(curve: &Characteristic) -> f64 {
    let points: Vec<(f64, f64)> = curve.points.iter().map(|p| (p[0], p[1])).collect();
    let off = |p: &[f64; 2]| cfs::compute::control::curve_value(&points, p[0]).map_or(0.0, |tilt| (p[1] - tilt).abs());
    curve.steps.iter().map(off).fold(0.0, f64::max)
}
