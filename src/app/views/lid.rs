//! The luminous-intensity distribution of the aperture, drawn as lighting designers draw a luminaire's: nadir down.

use super::Cache;
use crate::app::paint::palette::Palette;
use crate::app::paint::polar::PolarAxes;
use crate::app::paint::tile::{self, Foot, Status, Words};
use crate::compute::direction::{Emergent, Surface};
use crate::compute::lid::Lid;
use crate::compute::lid::c_gamma::{Aim, Peaks};
use crate::drawing::lid_curves::{Curves, LidPlane, SAMPLES, diffuser, intensity, sample, vertical_planes};
use crate::drawing::ticks::{number, si};
use egui::{Color32, FontId, Rect, Sense, Shape, Stroke, Ui, pos2, vec2};
use std::f64::consts::{PI, TAU};

/// What the tile draws.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// The distribution; `None` before the first result.
    pub lid: Option<&'a Lid>,
    /// Product, state and moment in words.
    pub name: &'a str,
    /// Its largest intensities, as a luminaire file holds them; `None` until they are computed.
    pub peaks: Option<&'a Peaks>,
    /// Luminous flux into the room, the unscattered sun left out. \[lm\]
    pub flux: Option<f64>,
    /// Outermost ring forced from outside (comparison). \[cd\]
    pub max: Option<f64>,
    /// Changes with `lid`.
    pub revision: u64,
    /// How far the content is to be trusted.
    pub status: Status<'a>,
}

/// The tile asks for nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action {}

/// The tile's own settings and curves.
#[derive(Debug, Clone, Default)]
pub struct State {
    /// Intensity per m² of aperture instead of the whole aperture's.
    pub per_area: bool,
    curves: Cache<(u64, Vec<LidPlane>), Curves>,
    ring: Option<f64>,
}

const HELP: &str = "The aperture as a luminaire: luminous intensity in the vertical plane C 0° – C 180° (C 0° into the \
room, to the right) and in that of the greatest scattered intensity, nadir down, and in the horizontal plane seen from \
above. A façade radiates nothing in its own plane, C 90° – C 270°. Dashed: an ideal diffuser of the same flux. Peaks \
are means over the steps of a luminaire file, 1° or 2.5°, as its export holds them. The unscattered sun is a narrow \
beam: its intensity is told, its ray is not to scale.\nSource: IEA SHC Task 31 report (2005), eq 5; C-γ as in EN \
13032-1, C 0° into the room.";

/// Draws the tile into all the space of `ui`.
pub fn show(ui: &mut Ui, input: &Input<'_>, state: &mut State) -> Vec<Action> {
    let words = Words {
        title: "LID",
        subtitle: input.name,
        help: HELP,
        empty: input.lid.is_none().then_some("No luminous-intensity distribution: the scene has no window to shine."),
        controls_width: 60.0,
    };
    let mut per_area = state.per_area;
    tile::show(
        ui,
        &words,
        &input.status,
        |ui| {
            ui.toggle_value(&mut per_area, "per m²").on_hover_text("Candela per square metre of aperture");
        },
        |ui, rect| match input.lid {
            Some(lid) => picture(ui, rect, lid, input, state),
            None => Foot::default(),
        },
    );
    state.per_area = per_area;
    vec![]
}

/// In what intensities are told: the whole aperture's, or those of a square metre of it.
#[derive(Debug, Clone, Copy)]
struct Scaling {
    factor: f64,
    per_area: bool,
}

impl Scaling {
    const fn unit(self) -> &'static str {
        if self.per_area { "cd per m² of aperture" } else { "cd" }
    }

    /// "11.5 Mcd", "2.1 kcd per m²".
    fn text(self, intensity: f64) -> String {
        format!("{}{}", si(intensity * self.factor, "cd"), if self.per_area { " per m²" } else { "" })
    }
}

/// Colours of the vertical planes, in their order.
fn colours(palette: &Palette) -> [Color32; 3] {
    [palette.first, palette.second, palette.series[2]]
}

fn picture(ui: &mut Ui, rect: Rect, lid: &Lid, input: &Input<'_>, state: &mut State) -> Foot {
    let palette = Palette::of(ui.visuals());
    let scaling = Scaling { factor: if state.per_area { 1.0 / lid.area() } else { 1.0 }, per_area: state.per_area };
    let factor = scaling.factor;
    let planes = vertical_planes(lid.surface, input.peaks);
    let curves = state.curves.get((input.revision, planes.clone()), || sample(lid, &planes)).clone();
    let automatic = input.max.unwrap_or(curves.max) * factor;
    let held = input.status.hold_scale && input.max.is_none();
    let max = state.ring.filter(|_| held).unwrap_or(automatic);
    state.ring = Some(max);
    // As many lines for a scene with sun as for one without, so that the diagram keeps its place.
    let lines = if rect.width() < NARROW { 4.0 } else { 3.0 };
    let (body, legend) = rect.split_top_bottom_at_y((rect.bottom() - LINE * lines).max(rect.top() + 60.0));
    let two = body.width() > 400.0 && body.width() > 1.35 * body.height();
    let (main, side) = if two {
        let (main, side) = body.split_left_right_at_fraction(0.57);
        // The angles at the rims of both keep apart.
        (main.with_max_x(main.right() - 8.0), Some(side.with_min_x(side.left() + 8.0)))
    } else {
        (body, None)
    };
    let scaled = |values: &[f64]| -> Vec<f64> { values.iter().map(|v| v * factor).collect() };
    let axes = PolarAxes::within(main, max);
    // The angle γ at both sides; values along the spoke where no light of a façade goes.
    axes.paint(ui.painter(), |a| format!("{:.0}°", a.min(TAU - a).to_degrees()), -7.0 * PI / 12.0, &palette);
    let ideal = input.flux.filter(|flux| *flux > 0.0);
    let mut text = None;
    let vertical: Vec<_> = curves.vertical.iter().zip(colours(&palette)).rev().collect();
    if let Some(flux) = ideal {
        dashed(ui, &axes, lid.surface, flux * factor, LidPlane::Vertical(0), &palette);
    }
    for ((_, values), colour) in &vertical {
        ui.painter().add(Shape::closed_line(axes.curve(&scaled(values)), Stroke::new(2.0, *colour)));
    }
    beams(ui, &axes, lid, &palette);
    let response = ui.interact(main, ui.scope_id().with("vertical"), Sense::hover());
    if let Some(at) = response.hover_pos() {
        let (angle, _) = axes.value(at);
        let index = (angle.rem_euclid(TAU) / TAU * SAMPLES as f64).round() as usize % SAMPLES;
        for ((_, values), colour) in &vertical {
            ui.painter().circle_filled(axes.screen(angle, values[index] * factor), 3.5, *colour);
        }
        let side = |plane: LidPlane| match plane {
            LidPlane::Vertical(c) => format!("C {}°", if angle >= 0.0 { c } else { (c + 180) % 360 }),
            LidPlane::Horizontal => plane.label(),
        };
        let values = curves.vertical.iter().map(|(plane, values)| (side(*plane), scaling.text(values[index])));
        let values: Vec<String> = values.map(|(name, value)| format!("{name} {value}")).collect();
        let gamma = format!("γ {:.0}°", angle.abs().to_degrees());
        text = Some(Foot::from([format!("{gamma} · {}", values.join(" · ")), format!("{gamma} {}", values[0])]));
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
            let value = scaling.text(curves.horizontal[index]);
            text = Some(Foot::from([format!("γ 90°, C {c:.0}° · {value}"), value]));
        }
    }
    let rest = summary(lid, input, scaling);
    tile::name(ui, &response, "LID polar diagram", rest.full());
    legend_ui(ui, legend, lid, input, (&curves, scaling), &palette);
    text.unwrap_or(rest)
}

/// "C 12°, γ 80°": where a direction lies for the aperture's luminaire file.
fn towards(surface: Surface, d: Emergent) -> String {
    let (c, gamma) = Aim::of(surface).angles(d);
    format!("C {:.0}°, γ {:.0}°", c.to_degrees().round() % 360.0, gamma.to_degrees())
}

/// The strongest scattered light and where it goes; the beam has its words in the legend.
fn summary(lid: &Lid, input: &Input<'_>, scaling: Scaling) -> Foot {
    let flux = input.flux.map_or_else(String::new, |flux| format!("scattered flux {} · ", si(flux, "lm")));
    let Some(peaks) = input.peaks else {
        let state = if input.status.idle && !input.status.hold_scale { "not computed" } else { "computing…" };
        return Foot::from([format!("{flux}scattered peak: {state}"), format!("peak: {state}")]);
    };
    let Some(peak) = peaks.scattered else { return Foot::from("nothing is scattered") };
    let value = scaling.text(peak.intensity);
    let to = towards(lid.surface, Aim::of(lid.surface).direction(peak.c, peak.gamma));
    let size = format!("aperture {} × {} m", number(lid.size[0], 3), number(lid.size[1], 3));
    Foot::from([
        format!("scattered peak {value} to {to} · {flux}{size}"),
        format!("scattered peak {value} to {to} · {}", flux.trim_end_matches(" · ")),
        format!("scattered peak {value} to {to}"),
        format!("peak {value} to {to}"),
        format!("peak {value}"),
    ])
}

fn dashed(ui: &Ui, axes: &PolarAxes, surface: Surface, flux: f64, section: LidPlane, palette: &Palette) {
    let samples: Vec<f64> =
        (0..180).map(|k| diffuser(flux, section.direction(Aim::of(surface), TAU * f64::from(k) / 180.0))).collect();
    let mut points = axes.curve(&samples);
    points.push(points[0]);
    ui.painter().extend(Shape::dashed_line(&points, Stroke::new(1.3, palette.weak), 5.0, 4.0));
}

/// Beams weaker than this share of the strongest are not drawn.
const FAINT_BEAM: f64 = 0.02;

/// The beams as rays in the C 0° plane.
fn beams(ui: &Ui, axes: &PolarAxes, lid: &Lid, palette: &Palette) {
    // The fan of a curved mirror is drawn by its stronger rays.
    let strongest = lid.beams.iter().map(|beam| beam.flux).fold(0.0, f64::max);
    for beam in lid.beams.iter().filter(|beam| beam.flux > FAINT_BEAM * strongest) {
        let (c, gamma) = Aim::of(lid.surface).angles(beam.direction);
        let angle = (gamma.sin() * c.cos()).atan2(gamma.cos());
        let (from, to) = (axes.centre, axes.screen(angle, axes.max));
        ui.painter().extend(Shape::dashed_line(&[from, to], Stroke::new(2.0, palette.beam), 2.0, 4.0));
        ui.painter().circle_filled(to, 3.5, palette.beam);
    }
}

/// Height of a line of the legend. \[points\]
const LINE: f32 = 18.0;
/// Narrower legends have one entry a line, and short ones. \[points\]
const NARROW: f32 = 300.0;

/// What the sun's beam is, from the fullest words to the shortest.
fn beam_words(lid: &Lid, peaks: Option<&Peaks>, scaling: Scaling) -> Vec<String> {
    let Some(strongest) = lid.beams.iter().max_by(|a, b| a.flux.total_cmp(&b.flux)).filter(|beam| beam.flux > 0.0)
    else {
        return vec!["no unscattered sun".to_owned(), "no sun's beam".to_owned()];
    };
    let more = if lid.beams.len() > 1 { "most " } else { "" };
    let to = towards(lid.surface, strongest.direction);
    let flux = si(lid.beam_flux(), "lm");
    let Some(peak) = peaks.and_then(|peaks| peaks.beam) else {
        return vec![
            format!("sun's beam, {more}to {to}, {flux} (not to scale)"),
            format!("sun's beam {flux}"),
            format!("beam {flux}"),
        ];
    };
    let value = scaling.text(peak.intensity);
    vec![
        format!("sun's beam {value}, {more}to {to}, {flux} (not to scale)"),
        format!("sun's beam {value}, {more}to {to}"),
        format!("sun's beam {value}"),
        format!("beam {value}"),
    ]
}

fn legend_ui(
    ui: &Ui,
    rect: Rect,
    lid: &Lid,
    input: &Input<'_>,
    (curves, scaling): (&Curves, Scaling),
    palette: &Palette,
) {
    let font = FontId::proportional(13.0);
    let narrow = rect.width() < NARROW;
    let mut at = pos2(rect.left() + 4.0, rect.top() + 0.5 * LINE);
    // Of several wordings the first that a line can hold.
    let mut entry = |texts: Vec<String>, colour, dash: Option<f32>| {
        let galleys = texts.into_iter().map(|text| ui.painter().layout_no_wrap(text, font.clone(), palette.ink));
        let fits = |galley: &std::sync::Arc<egui::Galley>| rect.left() + 27.0 + galley.size().x <= rect.right();
        let galleys: Vec<_> = galleys.collect();
        let Some(galley) = galleys.iter().find(|galley| fits(galley)).or(galleys.last()) else { return };
        let first = at.x < rect.left() + 5.0;
        if !first && (narrow || at.x + galley.size().x + 23.0 > rect.right()) {
            at = pos2(rect.left() + 4.0, at.y + LINE);
        }
        if at.y + 0.5 * LINE > rect.bottom() + 1.0 {
            return;
        }
        let line = [at, at + vec2(18.0, 0.0)];
        match dash {
            Some(length) => ui.painter().extend(Shape::dashed_line(&line, Stroke::new(2.0, colour), length, 3.0)),
            None => {
                ui.painter().line_segment(line, Stroke::new(2.0, colour));
            }
        }
        let size = galley.size();
        ui.painter().galley(pos2(at.x + 23.0, at.y - 0.5 * size.y), galley.clone(), palette.ink);
        at.x += size.x + 38.0;
    };
    for (k, ((plane, _), colour)) in curves.vertical.iter().zip(colours(palette)).enumerate() {
        let name = plane.label();
        // The unit once, with the first plane.
        let texts = match k {
            0 => vec![
                format!("{name}, {}", scaling.unit()),
                format!("{name}, {}", scaling.unit().replace(" of aperture", "")),
            ],
            _ if *plane == LidPlane::Vertical(90) && lid.surface == Surface::Facade => {
                vec![format!("{name} (0: façade's plane)"), name]
            }
            _ if *plane == LidPlane::Vertical(90) => vec![name],
            _ => vec![format!("{name} (plane of the peak)"), name],
        };
        entry(texts, colour, None);
    }
    // Before the diffuser, which a low legend can do without.
    entry(beam_words(lid, input.peaks, scaling), palette.beam, Some(2.0));
    if input.flux.is_some() {
        entry(vec!["ideal diffuser, same flux".to_owned(), "ideal diffuser".to_owned()], palette.weak, Some(4.0));
    }
}

/// Intensities every 5° of C and γ. \[cd\]
pub fn csv(input: &Input<'_>) -> String {
    use std::fmt::Write as _;
    let mut out = String::from("c_deg,gamma_deg,intensity_cd\n");
    let Some(lid) = input.lid else { return out };
    let aim = Aim::of(lid.surface);
    for c in (0..360).step_by(5) {
        for gamma in (0..=180).step_by(5) {
            let d = aim.direction(f64::from(c).to_radians(), f64::from(gamma).to_radians());
            let _ = writeln!(out, "{c},{gamma},{:.6}", intensity(lid, d));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::lid::EmergentLuminance;
    use crate::compute::lid::c_gamma::{Peak, Step};
    use std::f64::consts::FRAC_PI_2;

    fn lambert(surface: Surface) -> Lid {
        Lid { surface, size: [2.0, 1.5], parts: vec![EmergentLuminance::Uniform(1000.0)], beams: Vec::new() }
    }

    #[test]
    fn planes_and_angles_agree() {
        let near = |plane: LidPlane, angle: f64, c: f64, gamma: f64| {
            for aim in [Aim::Mounted, Aim::Down] {
                let found = aim.angles(plane.direction(aim, angle));
                let turned = (found.0.to_degrees() - c + 180.0).rem_euclid(360.0) - 180.0;
                assert!(turned.abs() < 1e-9 && (found.1.to_degrees() - gamma).abs() < 1e-9, "{plane:?} {found:?}");
            }
        };
        near(LidPlane::Vertical(0), 30_f64.to_radians(), 0.0, 30.0);
        near(LidPlane::Vertical(0), -30_f64.to_radians(), 180.0, 30.0);
        near(LidPlane::Vertical(15), 80_f64.to_radians(), 15.0, 80.0);
        near(LidPlane::Horizontal, 10_f64.to_radians(), 10.0, 90.0);
    }

    #[test]
    fn a_uniform_aperture_is_the_ideal_diffuser_of_its_flux() {
        for (surface, level) in [(Surface::Facade, FRAC_PI_2), (Surface::Roof, 0.0)] {
            let lid = lambert(surface);
            let aim = Aim::of(surface);
            let flux = PI * 1000.0 * lid.area();
            for section in [LidPlane::Vertical(0), LidPlane::Vertical(90), LidPlane::Horizontal] {
                for k in 0..24 {
                    let d = section.direction(aim, f64::from(k) * TAU / 24.0 + 0.01);
                    assert!((intensity(&lid, d) - diffuser(flux, d)).abs() < 1e-6);
                }
            }
            // A façade's largest intensity is level into the room, a roof's straight down: L·A.
            assert!((intensity(&lid, LidPlane::Vertical(0).direction(aim, level)) - 3000.0).abs() < 1e-9);
        }
    }

    #[test]
    fn the_plane_of_the_peak_is_drawn() {
        let peaks = |c: f64, gamma: f64| Peaks {
            scattered: Some(Peak { intensity: 1.0, c: c.to_radians(), gamma: gamma.to_radians() }),
            beam: None,
            step: Step::NORMAL,
        };
        let names = |surface, peaks: &Peaks| -> Vec<String> {
            vertical_planes(surface, Some(peaks)).iter().map(LidPlane::label).collect()
        };
        assert_eq!(names(Surface::Facade, &peaks(345.0, 80.0)), ["C0–C180", "C345–C165"]);
        // Across the façade already, or straight down: the usual two.
        for usual in [peaks(180.0, 80.0), peaks(77.0, 0.0)] {
            assert_eq!(names(Surface::Facade, &usual), ["C0–C180", "C90–C270"]);
        }
        assert_eq!(names(Surface::Roof, &peaks(45.0, 30.0)), ["C0–C180", "C45–C225", "C90–C270"]);
        assert_eq!(names(Surface::Roof, &peaks(270.0, 30.0)), ["C0–C180", "C270–C90"]);
    }

    #[test]
    fn intensities_of_a_square_metre_say_so() {
        let scaling = Scaling { factor: 0.5, per_area: true };
        assert_eq!(scaling.text(30_000.0), "15.0 kcd per m²");
        assert_eq!(scaling.unit(), "cd per m² of aperture");
        assert_eq!(Scaling { factor: 1.0, per_area: false }.text(30_000.0), "30.0 kcd");
    }
}
