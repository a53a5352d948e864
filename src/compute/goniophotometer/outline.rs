//! Drawings of described systems in section: closed polygons of one period.

use super::panes::Panes;
use crate::compute::dielectric::{Body, Material, Outline, Section};
use crate::compute::section::SlatArray;
use crate::compute::system::description::{
    Hole, Perforated, RedirectingGlass, SystemDescription, SystemKind, Venetian, Woven, state_key,
};
use std::f64::consts::TAU;

/// Height of the piece of a plain sheet that is drawn. \[m\]
const PIECE: f64 = 0.1;
/// Thickness that a scattering sheet is drawn with; its description has none. \[m\]
const SHEET: f64 = 0.004;
/// Pitch of the yarns of a fabric as drawn; its description has none. \[m\]
const YARN_PITCH: f64 = 0.001;

/// Closed polygons (outward, upward) of one period of a state, their first points not repeated; of an upright system
/// the section seen from above, (outward, to the right as seen from outside). \[m\]
///
/// A slat without thickness goes there and back on the same line. Fabrics, perforated and scattering sheets are drawn
/// schematically, since their descriptions leave out what a section shows. Empty for a stack, for a state that is not
/// there, and for geometry that encloses nothing.
pub fn section_drawing(system: &SystemDescription, state: &str) -> Vec<Vec<[f64; 2]>> {
    match &system.kind {
        SystemKind::Venetian(blind) => slats(blind, state).unwrap_or_default(),
        _ if !state.is_empty() => vec![],
        SystemKind::LaserCutPanel(panel) => panel.outline(),
        SystemKind::Prismatic(sheet) => sheet.section().map(|section| section.outline()).unwrap_or_default(),
        SystemKind::RedirectingGlass(glass) => redirecting(glass).unwrap_or_default(),
        SystemKind::Pane(stack) => Panes::equal(stack.pane, stack.panes).outline(),
        SystemKind::Diffuser(_) => vec![rectangle([-SHEET, 0.0], [0.0, PIECE])],
        SystemKind::Woven(fabric) => vec![yarn(fabric)],
        SystemKind::Perforated(sheet) => vec![web(sheet)],
        SystemKind::Stack(_) => vec![],
    }
}

/// Vertical distance at which the polygons of [`section_drawing`] repeat. \[m\] `None` for plain sheets and stacks.
pub fn drawing_period(system: &SystemDescription) -> Option<f64> {
    match &system.kind {
        SystemKind::Woven(_) => Some(YARN_PITCH),
        SystemKind::Perforated(sheet) => Some(pattern(sheet)[1]),
        _ => system.structure(),
    }
}

/// Is the drawing a picture of the principle rather than of the described lengths?
pub const fn is_schematic(system: &SystemDescription) -> bool {
    matches!(system.kind, SystemKind::Diffuser(_) | SystemKind::Woven(_) | SystemKind::Perforated(_))
}

fn rectangle(low: [f64; 2], high: [f64; 2]) -> Vec<[f64; 2]> {
    vec![low, [high[0], low[1]], high, [low[0], high[1]]]
}

fn slats(blind: &Venetian, state: &str) -> Option<Vec<Vec<[f64; 2]>>> {
    let angle = *blind.angles.iter().find(|angle| state_key(**angle) == state)?;
    let sides = [blind.upper, blind.lower];
    let array = SlatArray::new(blind.profile.clone(), blind.thickness, blind.spacing, angle, sides).ok()?;
    let mut outlines = array.outline();
    if blind.thickness == 0.0 {
        for line in &mut outlines {
            let back: Vec<_> = line.iter().rev().skip(1).copied().collect();
            line.extend(back.iter().take(back.len().saturating_sub(1)));
        }
    }
    Some(outlines)
}

fn redirecting(glass: &RedirectingGlass) -> Option<Vec<Vec<[f64; 2]>>> {
    let material = Material { index: glass.index, absorption: glass.absorption };
    let body = |outline: &Vec<[f64; 2]>| Body { outline: Outline::Closed(outline.clone()), material };
    Some(Section::new(glass.spacing, glass.bodies.iter().map(body).collect(), glass.panes).ok()?.outline())
}

/// A yarn of a plain weave: of the pitch p its threads of width d leave (1 − d/p)² open.
fn yarn(fabric: &Woven) -> Vec<[f64; 2]> {
    const CORNERS: usize = 32;
    let radius = 0.5 * YARN_PITCH * (1.0 - fabric.openness.max(0.0).sqrt());
    let corner = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / CORNERS as f64).sin_cos();
        [radius * (cos - 1.0), 0.5 * YARN_PITCH + radius * sin]
    };
    (0..CORNERS).map(corner).collect()
}

/// Height of a hole and the distance from one to the next above it. \[m\] The description knows the area per hole
/// alone: a square of it, or more where the holes would touch.
fn pattern(sheet: &Perforated) -> [f64; 2] {
    let height = match sheet.hole {
        Hole::Round { diameter } => diameter,
        Hole::Rectangle { height, .. } | Hole::Rhombus { height, .. } => height,
    };
    [height, sheet.area.sqrt().max(1.1 * height)]
}

/// The sheet between two holes, cut through the middle of both.
fn web(sheet: &Perforated) -> Vec<[f64; 2]> {
    let [height, pitch] = pattern(sheet);
    let (low, high) = (0.5 * height, pitch - 0.5 * height);
    let (inner, rise) = (-sheet.thickness, sheet.rise);
    vec![[inner, low + rise], [0.0, low], [0.0, high], [inner, high + rise]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::section::Surface;
    use crate::compute::system::slat_profile::SlatProfile;

    fn system(kind: SystemKind) -> SystemDescription {
        SystemDescription { name: String::new(), description: String::new(), kind, upright: false }
    }

    fn area(polygon: &[[f64; 2]]) -> f64 {
        let next = polygon.iter().cycle().skip(1);
        0.5 * polygon.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>().abs()
    }

    fn blind(thickness: f64, degrees: f64) -> SystemDescription {
        system(SystemKind::Venetian(Venetian {
            profile: SlatProfile::Flat { width: 0.08 },
            spacing: 0.072,
            thickness,
            angles: vec![degrees.to_radians()],
            upper: Surface::matt(0.5),
            lower: Surface::matt(0.5),
        }))
    }

    #[test]
    fn a_slat_turns_its_outer_edge_down() {
        let drawing = section_drawing(&blind(0.0, 30.0), "30");
        let outermost = drawing[0].iter().copied().fold([f64::NEG_INFINITY; 2], |a, b| if b[0] > a[0] { b } else { a });
        let (sin, cos) = 30_f64.to_radians().sin_cos();
        assert!((outermost[0] - 0.04 * cos).abs() < 1e-12 && (outermost[1] + 0.04 * sin).abs() < 1e-12);
        assert!(area(&drawing[0]) < 1e-15, "a sheet encloses nothing");
        let solid = section_drawing(&blind(0.002, 30.0), "30");
        assert!((area(&solid[0]) - 0.08 * 0.002).abs() < 1e-12);
        assert!(section_drawing(&blind(0.0, 30.0), "45").is_empty());
    }

    #[test]
    fn what_is_solid_of_a_sheet_with_holes() {
        let sheet = Perforated {
            hole: Hole::Rectangle { width: 0.02, height: 0.01 },
            area: 0.0004,
            thickness: 0.001,
            rise: 0.003,
            reflectance: [0.5; 3],
        };
        let system = system(SystemKind::Perforated(sheet));
        assert!((drawing_period(&system).unwrap() - 0.02).abs() < 1e-15);
        assert!((area(&section_drawing(&system, "")[0]) - 0.01 * 0.001).abs() < 1e-15);
    }

    #[test]
    fn yarns_leave_the_openness() {
        let fabric = Woven { openness: 0.09, reflectance: [0.5; 2], transmittance: 0.0 };
        let system = system(SystemKind::Woven(fabric));
        let heights = section_drawing(&system, "")[0].iter().map(|p| p[1]).collect::<Vec<_>>();
        let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let free = 1.0 - (high - low) / drawing_period(&system).unwrap();
        assert!((free * free - 0.09).abs() < 1e-9);
    }
}
