//! The luminous-intensity distribution of the aperture, drawn as lighting designers draw a luminaire's: nadir down.

use super::Cache;
use crate::app::paint::palette::Palette;
use crate::app::paint::polar::PolarAxes;
use crate::app::paint::tile::{self, Status, Words};
use crate::compute::direction::{Dir, Emergent, Room, Surface};
use crate::compute::lid::Lid;
use crate::drawing::ticks::{number, si};
use egui::{FontId, Rect, Sense, Shape, Stroke, Ui, pos2, vec2};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// What the tile draws.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// The distribution; `None` before the first result.
    pub lid: Option<&'a Lid>,
    /// Product, state and moment in words.
    pub name: &'a str,
    /// Luminous flux into the room, the unscattered sun left out. \[lm\]
    pub flux: Option<f64>,
    /// Outermost ring forced from outside (comparison), in the unit shown.
    pub max: Option<f64>,
    /// Changes with `lid`.
    pub revision: u64,
    /// How far the content is to be trusted.
    pub status: Status<'a>,
}

/// The tile asks for nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action {}

/// A cut through the distribution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LidPlane {
    /// The vertical plane into the room: C 0° – C 180°.
    C0,
    /// The vertical plane along the façade: C 90° – C 270°.
    C90,
    /// The horizontal plane γ = 90°, C 0° at the bottom.
    Horizontal,
}

impl LidPlane {
    /// Direction in the room for an angle from straight down (C 0° for [`LidPlane::Horizontal`]) towards the right of
    /// the drawing. C 0° is into the room (+y), C counts anticlockwise seen from above, so C 90° is −x.
    pub fn direction(self, angle: f64) -> Dir<Room> {
        let (sin, cos) = angle.sin_cos();
        Dir::from_unit(match self {
            Self::C0 => DVec3::new(0.0, sin, -cos),
            Self::C90 => DVec3::new(-sin, 0.0, -cos),
            Self::Horizontal => DVec3::new(-sin, cos, 0.0),
        })
    }

    const fn label(self) -> &'static str {
        match self {
            Self::C0 => "C0–C180",
            Self::C90 => "C90–C270",
            Self::Horizontal => "γ = 90° (horizontal)",
        }
    }
}

const SAMPLES: usize = 720;

/// Sampled cuts of a distribution. \[cd\]
#[derive(Debug, Clone)]
struct Curves {
    c0: Vec<f64>,
    c90: Vec<f64>,
    horizontal: Vec<f64>,
    max: f64,
}

/// The tile's own settings and curves.
#[derive(Debug, Clone, Default)]
pub struct State {
    /// Intensity per m² of aperture instead of the whole aperture's.
    pub per_area: bool,
    curves: Cache<u64, Curves>,
    ring: Option<f64>,
}

/// γ from the nadir and C of a direction, both in degrees.
pub fn c_gamma(d: Dir<Room>) -> (f64, f64) {
    let v = d.vector();
    (v.x.hypot(v.y).atan2(-v.z).to_degrees(), (-v.x).atan2(v.y).to_degrees().rem_euclid(360.0))
}

/// Intensity in a direction of the room. \[cd\]
fn intensity(lid: &Lid, d: Dir<Room>) -> f64 {
    lid.intensity(Emergent(lid.surface.facade_dir(d))).max(0.0)
}

fn sample(lid: &Lid) -> Curves {
    let cut = |section: LidPlane| -> Vec<f64> {
        (0..SAMPLES).map(|k| intensity(lid, section.direction(TAU * k as f64 / SAMPLES as f64))).collect()
    };
    let (c0, c90, horizontal) = (cut(LidPlane::C0), cut(LidPlane::C90), cut(LidPlane::Horizontal));
    let max = c0.iter().chain(&c90).chain(&horizontal).copied().filter(|v| v.is_finite()).fold(0.0, f64::max);
    Curves { c0, c90, horizontal, max }
}

/// Intensity of an ideal diffuser of the same flux: Φ/π · cosθ about the aperture's normal. \[cd\]
fn diffuser(surface: Surface, flux: f64, d: Dir<Room>) -> f64 {
    flux / PI * (-surface.facade_dir(d).vector().z).max(0.0)
}

const HELP: &str = "The aperture as a luminaire: luminous intensity in the vertical planes C 0° – C 180° (into the room \
to the right) and C 90° – C 270°, nadir down, and in the horizontal plane seen from above. A façade radiates nothing in \
its own plane, C 90° – C 270°. Dashed: an ideal diffuser of the same flux. Unscattered sun is a beam, not part of the \
curves.\nSource: IEA SHC Task 31 report (2005), eq 5; C-γ as in EN 13032-1, C 0° into the room.";

/// Draws the tile into all the space of `ui`.
pub fn show(ui: &mut Ui, input: &Input<'_>, state: &mut State) -> Vec<Action> {
    let words = Words {
        title: "LID",
        subtitle: input.name,
        help: HELP,
        empty: input.lid.is_none().then_some("No luminous-intensity distribution yet: choose a product and a scene."),
        controls_width: 60.0,
    };
    let mut per_area = state.per_area;
    tile::show(
        ui,
        &words,
        &input.status,
        |ui| {
            ui.toggle_value(&mut per_area, "cd/m²").on_hover_text("Per square metre of aperture");
        },
        |ui, rect| match input.lid {
            Some(lid) => picture(ui, rect, lid, input, state),
            None => String::new(),
        },
    );
    state.per_area = per_area;
    vec![]
}

fn picture(ui: &mut Ui, rect: Rect, lid: &Lid, input: &Input<'_>, state: &mut State) -> String {
    let palette = Palette::of(ui.visuals());
    let (factor, unit) = if state.per_area { (1.0 / lid.area(), "cd/m²") } else { (1.0, "cd") };
    let curves = state.curves.get(input.revision, || sample(lid)).clone();
    let automatic = input.max.unwrap_or(curves.max * factor);
    let max = state.ring.filter(|_| input.status.hold_scale).unwrap_or(automatic);
    state.ring = Some(max);
    let legend_height = if !lid.beams.is_empty() && rect.width() > 300.0 { 54.0 } else { 36.0 };
    let (body, legend) = rect.split_top_bottom_at_y((rect.bottom() - legend_height).max(rect.top() + 60.0));
    let two = body.width() > 400.0 && body.width() > 1.35 * body.height();
    let (main, side) = if two {
        let (main, side) = body.split_left_right_at_fraction(0.57);
        (main, Some(side))
    } else {
        (body, None)
    };
    let scaled = |values: &[f64]| -> Vec<f64> { values.iter().map(|v| v * factor).collect() };
    let axes = PolarAxes::within(main, max);
    // The angle γ at both sides; values along the spoke where no light of a façade goes.
    axes.paint(ui.painter(), |a| format!("{:.0}°", a.min(TAU - a).to_degrees()), -7.0 * PI / 12.0, &palette);
    let ideal = input.flux.filter(|flux| *flux > 0.0);
    let mut text = None;
    let vertical = [(LidPlane::C90, &curves.c90, palette.second), (LidPlane::C0, &curves.c0, palette.first)];
    if let Some(flux) = ideal {
        dashed(ui, &axes, lid.surface, flux * factor, LidPlane::C0, &palette);
    }
    for (_, values, colour) in &vertical {
        ui.painter().add(Shape::closed_line(axes.curve(&scaled(values)), Stroke::new(2.0, *colour)));
    }
    let beam_at = beam(ui, &axes, lid, &palette);
    let response = ui.interact(main, ui.scope_id().with("vertical"), Sense::hover());
    if let Some(at) = response.hover_pos() {
        let (angle, _) = axes.value(at);
        let index = (angle.rem_euclid(TAU) / TAU * SAMPLES as f64).round() as usize % SAMPLES;
        for (_, values, colour) in &vertical {
            ui.painter().circle_filled(axes.screen(angle, values[index] * factor), 3.5, *colour);
        }
        let planes = if angle >= 0.0 { ["C 0°", "C 90°"] } else { ["C 180°", "C 270°"] };
        text = Some(format!(
            "γ {:.0}° · {} {} · {} {}",
            angle.abs().to_degrees(),
            planes[0],
            si(curves.c0[index] * factor, unit),
            planes[1],
            si(curves.c90[index] * factor, unit)
        ));
    }
    if let Some(side) = side {
        let axes = PolarAxes::within(side, max);
        axes.paint(ui.painter(), |a| format!("C{:.0}", a.to_degrees()), 7.0 * PI / 12.0, &palette);
        if let Some(flux) = ideal {
            dashed(ui, &axes, lid.surface, flux * factor, LidPlane::Horizontal, &palette);
        }
        let curve = axes.curve(&scaled(&curves.horizontal));
        ui.painter().add(Shape::closed_line(curve, Stroke::new(2.0, palette.first)));
        let response = ui.interact(side, ui.scope_id().with("horizontal"), Sense::hover());
        tile::name(ui, &response, "LID horizontal section", "γ = 90°");
        if let Some(at) = response.hover_pos() {
            let (angle, _) = axes.value(at);
            let index = (angle.rem_euclid(TAU) / TAU * SAMPLES as f64).round() as usize % SAMPLES;
            ui.painter().circle_filled(axes.screen(angle, curves.horizontal[index] * factor), 3.5, palette.first);
            let c = angle.rem_euclid(TAU).to_degrees();
            text = Some(format!("γ 90°, C {c:.0}° · {}", si(curves.horizontal[index] * factor, unit)));
        }
    }
    let rest = summary(lid, input, &curves, factor, unit, rect.width() < 380.0);
    tile::name(ui, &response, "LID polar diagram", &rest);
    legend_ui(ui, legend, lid, input, unit, beam_at, &palette);
    text.unwrap_or(rest)
}

fn summary(lid: &Lid, input: &Input<'_>, curves: &Curves, factor: f64, unit: &str, short: bool) -> String {
    let flux = input.flux.map_or_else(String::new, |flux| format!("flux {} · ", si(flux, "lm")));
    if short {
        let flux = input.flux.map_or_else(String::new, |flux| format!("{} · ", si(flux, "lm")));
        return format!("{flux}peak {}", si(curves.max * factor, unit));
    }
    let size = format!("aperture {} × {} m", number(lid.size[0], 3), number(lid.size[1], 3));
    format!("{flux}largest drawn {} · {size}", si(curves.max * factor, unit))
}

fn dashed(ui: &Ui, axes: &PolarAxes, surface: Surface, flux: f64, section: LidPlane, palette: &Palette) {
    let samples: Vec<f64> =
        (0..180).map(|k| diffuser(surface, flux, section.direction(TAU * f64::from(k) / 180.0))).collect();
    let mut points = axes.curve(&samples);
    points.push(points[0]);
    ui.painter().extend(Shape::dashed_line(&points, Stroke::new(1.3, palette.weak), 5.0, 4.0));
}

/// Beams weaker than this share of the strongest are not drawn.
const FAINT_BEAM: f64 = 0.02;

/// The beams as rays in the C 0° plane; true when there is one to explain.
fn beam(ui: &Ui, axes: &PolarAxes, lid: &Lid, palette: &Palette) -> bool {
    // The fan of a curved mirror is drawn by its stronger rays.
    let strongest = lid.beams.iter().map(|beam| beam.flux).fold(0.0, f64::max);
    let drawn = lid.beams.iter().filter(|beam| beam.flux > FAINT_BEAM * strongest);
    drawn.clone().for_each(|beam| {
        let v = lid.surface.room_dir(beam.direction.0).vector();
        let angle = v.y.atan2(-v.z);
        let (from, to) = (axes.centre, axes.screen(angle, axes.max));
        ui.painter().extend(Shape::dashed_line(&[from, to], Stroke::new(2.0, palette.beam), 2.0, 4.0));
        ui.painter().circle_filled(to, 3.5, palette.beam);
    });
    drawn.count() > 0
}

fn legend_ui(ui: &Ui, rect: Rect, lid: &Lid, input: &Input<'_>, unit: &str, beam: bool, palette: &Palette) {
    let font = FontId::proportional(13.0);
    let mut at = pos2(rect.left() + 4.0, rect.top() + 9.0);
    let mut entry = |text: String, colour, dash: Option<f32>| {
        let galley = ui.painter().layout_no_wrap(text, font.clone(), palette.ink);
        if at.x + galley.size().x + 26.0 > rect.right() && at.x > rect.left() + 5.0 {
            at = pos2(rect.left() + 4.0, at.y + 17.0);
        }
        let line = [at, at + vec2(18.0, 0.0)];
        match dash {
            Some(length) => ui.painter().extend(Shape::dashed_line(&line, Stroke::new(2.0, colour), length, 3.0)),
            None => {
                ui.painter().line_segment(line, Stroke::new(2.0, colour));
            }
        }
        let size = galley.size();
        ui.painter().galley(pos2(at.x + 23.0, at.y - 0.5 * size.y), galley, palette.ink);
        at.x += size.x + 38.0;
    };
    let narrow = rect.width() < 300.0;
    entry(format!("{}, {unit}", LidPlane::C0.label()), palette.first, None);
    let own_plane = if lid.surface == Surface::Facade && !narrow { " (0: façade's plane)" } else { "" };
    entry(format!("{}{own_plane}", LidPlane::C90.label()), palette.second, None);
    if input.flux.is_some() {
        entry(if narrow { "diffuser" } else { "ideal diffuser, same flux" }.to_owned(), palette.weak, Some(4.0));
    }
    if let (true, Some(beam)) = (beam, lid.beams.iter().max_by(|a, b| a.flux.total_cmp(&b.flux))) {
        let (gamma, c) = c_gamma(lid.surface.room_dir(beam.direction.0));
        let all = si(lid.beam_flux(), "lm");
        let more = if lid.beams.len() > 1 { "most " } else { "" };
        let text = format!("sun unscattered {all}, {more}to γ {gamma:.0}°, C {c:.0}° (not to scale)");
        let text = if narrow { format!("sun {all}") } else { text };
        entry(text, palette.beam, Some(2.0));
    }
}

/// Intensities every 5° of C and γ. \[cd\]
pub fn csv(input: &Input<'_>) -> String {
    use std::fmt::Write as _;
    let mut out = String::from("c_deg,gamma_deg,intensity_cd\n");
    let Some(lid) = input.lid else { return out };
    for c in (0..360).step_by(5) {
        for gamma in (0..=180).step_by(5) {
            let (sin_c, cos_c) = f64::from(c).to_radians().sin_cos();
            let (sin, cos) = f64::from(gamma).to_radians().sin_cos();
            let d = Dir::from_unit(DVec3::new(-sin * sin_c, sin * cos_c, -cos));
            let _ = writeln!(out, "{c},{gamma},{:.6}", intensity(lid, d));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::lid::EmergentLuminance;
    use std::f64::consts::FRAC_PI_2;

    fn lambert(surface: Surface) -> Lid {
        Lid { surface, size: [2.0, 1.5], parts: vec![EmergentLuminance::Uniform(1000.0)], beams: Vec::new() }
    }

    #[test]
    fn planes_and_angles_agree() {
        let (gamma, c) = c_gamma(LidPlane::C0.direction(0.5));
        assert!((gamma - 0.5_f64.to_degrees()).abs() < 1e-9 && c == 0.0);
        let (gamma, c) = c_gamma(LidPlane::C90.direction(0.5));
        assert!((gamma - 0.5_f64.to_degrees()).abs() < 1e-9 && (c - 90.0).abs() < 1e-9);
        let (gamma, c) = c_gamma(LidPlane::Horizontal.direction(1.0));
        assert!((gamma - 90.0).abs() < 1e-9 && (c - 1_f64.to_degrees()).abs() < 1e-9);
    }

    #[test]
    fn a_uniform_aperture_is_the_ideal_diffuser_of_its_flux() {
        for surface in [Surface::Facade, Surface::Roof] {
            let lid = lambert(surface);
            let flux = PI * 1000.0 * lid.area();
            for section in [LidPlane::C0, LidPlane::C90, LidPlane::Horizontal] {
                for k in 0..24 {
                    let d = section.direction(f64::from(k) * TAU / 24.0 + 0.01);
                    assert!((intensity(&lid, d) - diffuser(surface, flux, d)).abs() < 1e-6);
                }
            }
        }
        // A façade's largest intensity is level into the room, a roof's straight down: L·A.
        assert!((intensity(&lambert(Surface::Facade), LidPlane::C0.direction(FRAC_PI_2)) - 3000.0).abs() < 1e-9);
        assert!((intensity(&lambert(Surface::Roof), LidPlane::C0.direction(0.0)) - 3000.0).abs() < 1e-9);
    }
}
