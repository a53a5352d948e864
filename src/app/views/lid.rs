//! View of the LID tile: the luminous intensity distribution (LID) of the aperture as a polar diagram in the style of
//! lighting design, with the nadir at the bottom, or as a 3D body.

mod body;
mod scaling;

use super::Cache;
use crate::app::paint::palette::Palette;
use crate::app::paint::polar::PolarAxes;
use crate::app::paint::tile::{self, Foot, Status, Words};
use crate::compute::direction::Surface;
use crate::compute::lid::Lid;
use crate::compute::lid::c_gamma::{Aim, Peaks};
use crate::drawing::lid_curves::{Curves, LidPlane, SAMPLES, diffuser, sample_at, table, vertical_planes};
use crate::drawing::ticks::{number, si};
use crate::texts::tiles as say;
use egui::{Color32, FontId, Rect, Sense, Shape, Stroke, Ui, pos2, vec2};
use scaling::{Scaling, towards};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Input of the LID tile in one frame.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Luminous intensity distribution of the first aperture; `None` before the first result.
    pub lid: Option<&'a Lid>,
    /// Product, state, date and time as text.
    pub name: &'a str,
    /// Largest intensities of the distribution as a luminaire file would contain them; `None` until they are computed.
    pub peaks: Option<&'a Peaks>,
    /// Luminous flux into the room without the undeviated direct sun. \[lm\]
    pub flux: Option<f64>,
    /// Intensity at the outermost ring, if the comparison sets it. \[cd\]
    pub max: Option<f64>,
    /// Revision number of `lid`, which changes whenever the result does.
    pub revision: u64,
    /// Status of the results shown: preliminary, outdated or complete.
    pub status: Status<'a>,
}

/// Request of the user; the LID tile has none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action {}

/// Display settings and cached curves of the LID tile.
#[derive(Debug, Clone, Default)]
pub struct State {
    /// Whether intensities are stated per square metre of aperture instead of for the whole aperture.
    pub per_area: bool,
    /// Whether a 3D body (photometric solid) is drawn instead of polar curves.
    pub solid: bool,
    /// Whether the user has locked the value of the outermost ring.
    pub hold: bool,
    body: body::State,
    curves: Cache<(u64, Vec<LidPlane>, usize), Arc<Curves>>,
    /// Value of the outermost ring \[cd or cd/m²\], with whether it is per square metre of aperture.
    ring: Option<(bool, f64)>,
}

/// Draws the LID tile into all the space of `ui`. Returns no requests.
pub fn show(ui: &mut Ui, input: &Input<'_>, state: &mut State) -> Vec<Action> {
    let words = Words {
        title: say::LID.get(),
        subtitle: input.name,
        help: say::LID_ABOUT.get(),
        empty: input.lid.is_none().then(|| input.status.missing(say::LID_EMPTY)),
        controls_width: 170.0,
    };
    let (mut per_area, mut solid, mut hold) = (state.per_area, state.solid, state.hold);
    tile::show(
        ui,
        &words,
        &input.status,
        |ui| {
            ui.toggle_value(&mut per_area, say::PER_AREA).on_hover_text(say::PER_AREA_TIP);
            ui.toggle_value(&mut solid, say::BODY).on_hover_text(say::LID_BODY_TIP);
            ui.toggle_value(&mut hold, say::HOLD).on_hover_text(say::HOLD_TIP);
        },
        |ui, rect| match input.lid {
            Some(lid) if state.solid => {
                let scaling = Scaling::of(lid, state.per_area);
                let light = body::Input { lid, peaks: input.peaks, revision: input.revision, scaling };
                body::show(ui, rect, &light, &mut state.body).unwrap_or_else(|| summary(lid, input, scaling))
            }
            Some(lid) => picture(ui, rect, lid, input, state),
            None => Foot::default(),
        },
    );
    (state.per_area, state.solid, state.hold) = (per_area, solid, hold);
    vec![]
}

/// Returns the colours of the curves in vertical C-planes, in the order of the planes.
fn colours(palette: &Palette) -> [Color32; 3] {
    [palette.first, palette.second, palette.series[2]]
}

/// Draws the polar diagram of vertical C-planes and, if there is room, that of the horizontal plane, with legend.
/// Returns the line under them.
fn picture(ui: &mut Ui, rect: Rect, lid: &Lid, input: &Input<'_>, state: &mut State) -> Foot {
    let palette = Palette::of(ui.visuals());
    let scaling = Scaling::of(lid, state.per_area);
    let factor = scaling.factor;
    let planes = vertical_planes(lid.surface, input.peaks);
    // While something is dragged every third sample does.
    let samples = if input.status.hold_scale { SAMPLES / 3 } else { SAMPLES };
    let key = (input.revision, planes, samples);
    let curves = state.curves.get(key.clone(), || Arc::new(sample_at(lid, &key.1, samples))).clone();
    let automatic = input.max.unwrap_or(curves.max) * factor;
    let held = (input.status.hold_scale || state.hold) && input.max.is_none();
    let kept = state.ring.filter(|(per_area, _)| held && *per_area == state.per_area);
    let max = kept.map_or(automatic, |(_, max)| max);
    state.ring = Some((state.per_area, max));
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
        let index = (angle.rem_euclid(TAU) / TAU * samples as f64).round() as usize % samples;
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
        tile::name(ui, &response, say::LID_HORIZONTAL, "γ = 90°");
        if let Some(at) = response.hover_pos() {
            let (angle, _) = axes.value(at);
            let index = (angle.rem_euclid(TAU) / TAU * samples as f64).round() as usize % samples;
            ui.painter().circle_filled(axes.screen(angle, curves.horizontal[index] * factor), 3.5, palette.first);
            let c = angle.rem_euclid(TAU).to_degrees();
            let value = scaling.text(curves.horizontal[index]);
            text = Some(Foot::from([format!("γ 90°, C {c:.0}° · {value}"), value]));
        }
    }
    let rest = summary(lid, input, scaling);
    tile::name(ui, &response, say::LID_POLAR, rest.full());
    legend_ui(ui, legend, lid, input, (&curves, scaling), &palette);
    text.unwrap_or(rest)
}

/// Returns the largest intensity of scattered light and its direction, and the flux of scattered light, as text. The
/// legend describes the sun's undeviated beam.
fn summary(lid: &Lid, input: &Input<'_>, scaling: Scaling) -> Foot {
    let flux = input.flux.map_or_else(String::new, |flux| say::scattered_flux(si(flux, "lm")));
    let Some(peaks) = input.peaks else {
        let state = if input.status.idle && !input.status.hold_scale { say::NOT_COMPUTED } else { say::COMPUTING };
        return Foot::from([format!("{flux}{}", say::scattered_peak_state(state)), say::peak_state(state)]);
    };
    let Some(peak) = peaks.scattered else { return Foot::from(say::NOTHING_SCATTERED) };
    let value = scaling.text(peak.intensity);
    let to = towards(lid.surface, Aim::of(lid.surface).direction(peak.c, peak.gamma));
    let size = say::aperture_size(number(lid.size[0], 3), number(lid.size[1], 3));
    let peak = say::scattered_peak(&value, &to);
    Foot::from([
        format!("{peak} · {flux}{size}"),
        format!("{peak} · {}", flux.trim_end_matches(" · ")),
        peak,
        say::peak_to(&value, to),
        say::peak_alone(value),
    ])
}

fn dashed(ui: &Ui, axes: &PolarAxes, surface: Surface, flux: f64, section: LidPlane, palette: &Palette) {
    let samples: Vec<f64> =
        (0..180).map(|k| diffuser(flux, section.direction(Aim::of(surface), TAU * f64::from(k) / 180.0))).collect();
    let mut points = axes.curve(&samples);
    points.push(points[0]);
    ui.painter().extend(Shape::dashed_line(&points, Stroke::new(1.3, palette.weak), 5.0, 4.0));
}

/// Fraction of the strongest beam's flux below which a beam is not drawn.
const FAINT_BEAM: f64 = 0.02;

/// Draws the beams of the sun as rays, projected into the C 0° plane.
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

/// Height of a line of the diagram's legend. \[points\]
const LINE: f32 = 18.0;
/// Width below which the legend has one short entry in each line. \[points\]
const NARROW: f32 = 300.0;

/// Returns descriptions of the sun's beams (intensity, direction, flux), from the fullest to the shortest.
fn beam_words(lid: &Lid, peaks: Option<&Peaks>, scaling: Scaling) -> Vec<String> {
    let Some(strongest) = lid.beams.iter().max_by(|a, b| a.flux.total_cmp(&b.flux)).filter(|beam| beam.flux > 0.0)
    else {
        return vec![say::NO_BEAM.into(), say::NO_BEAM_SHORT.into()];
    };
    let many = lid.beams.len() > 1;
    let to = towards(lid.surface, strongest.direction);
    let flux = si(lid.beam_flux(), "lm");
    let Some(peak) = peaks.and_then(|peaks| peaks.beam) else {
        let full = if many { say::beam_flux_most(&to, &flux) } else { say::beam_flux_to(&to, &flux) };
        return vec![full, say::beam_value(&flux), say::beam_short(flux)];
    };
    let value = scaling.text(peak.intensity);
    let [full, middle] = if many {
        [say::beam_value_flux_most(&value, &to, &flux), say::beam_value_most(&value, &to)]
    } else {
        [say::beam_value_flux(&value, &to, &flux), say::beam_value_to(&value, &to)]
    };
    vec![full, middle, say::beam_value(&value), say::beam_short(value)]
}

/// Draws the legend of the diagram: C-planes, beams of the sun, and the ideal diffuser of the same flux.
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
            0 => vec![format!("{name}, {}", scaling.unit()), format!("{name}, {}", scaling.short_unit())],
            _ if *plane == LidPlane::Vertical(90) && lid.surface == Surface::Facade => {
                vec![say::facade_plane(&name), name]
            }
            _ if *plane == LidPlane::Vertical(90) => vec![name],
            _ => vec![say::peak_plane(&name), name],
        };
        entry(texts, colour, None);
    }
    // Before the diffuser, which a low legend can do without.
    entry(beam_words(lid, input.peaks, scaling), palette.beam, Some(2.0));
    if input.flux.is_some() {
        entry(vec![say::DIFFUSER_SAME.into(), say::DIFFUSER.into()], palette.weak, Some(4.0));
    }
}

/// Returns the intensities of the scattered light \[cd\], as the curves show them, every 5° of C and γ as CSV.
pub fn csv(input: &Input<'_>) -> String {
    use std::fmt::Write as _;
    let mut out = String::from("c_deg,gamma_deg,intensity_cd\n");
    let Some(lid) = input.lid else { return out };
    for (c, list) in table(lid, 5).into_iter().enumerate() {
        for (gamma, value) in list.into_iter().enumerate() {
            let _ = writeln!(out, "{},{},{value:.6}", 5 * c, 5 * gamma);
        }
    }
    out
}

#[cfg(test)]
mod tests;
