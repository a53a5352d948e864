//! View of the BTDF tile: the hemisphere of incident directions on the left, that of emergent directions on the right,
//! both as seen from inside the room.

mod cut;
mod form;
mod input;
mod lobe;
mod place;
mod schemes;
mod words;

pub use form::words as form_words;
pub use input::{Action, FormInput, Input, SchemesInput};

use super::Cache;
use crate::app::paint::colour_scale::{ColourScale, ColourScaleExt as _};
use crate::app::paint::frozen::{Grain, frozen, grain};
use crate::app::paint::hemisphere::{Disk, Projection, Side, cell_outline, emergent_disk, incident_disk, neighbour};
use crate::app::paint::palette::{ColourMap, Palette};
use crate::app::paint::tile::{self, Foot, Words};
use crate::app::scene::incidence::Source;
use crate::compute::basis::{Cell, RingBasis};
use crate::compute::btdf::{Btdf, Indicatrix};
use crate::compute::direction::{Dir, Emergent, Facade, Incident};
use crate::drawing::ticks::number;
use crate::texts::{Text, tiles as say};
use egui::{Align2, Color32, EventFilter, Key, Mesh, Rect, Sense, Shape, Stroke, Ui, pos2};
use place::{Place, frame, places};
use std::sync::Arc;
use words::{drawn, leaving_text, pointed_text, selection_text};

type Bits = [u64; 3];

/// Key of the cached picture of the emergent side: revision number of the data, incident direction as bits, disk,
/// projection, whether q·cosθ is drawn, and colour scale.
type EmergentKey = (u64, Bits, Disk, Projection, bool, ColourScale);

/// Returns the vector of an incident direction as bits, for keys.
fn bits(incident: Incident) -> Bits {
    incident.0.vector().to_array().map(f64::to_bits)
}

/// Incident side of the view: cells shaded by transmittance, and the incident directions that can be chosen.
#[derive(Debug, Clone)]
struct Incidences {
    basis: RingBasis,
    /// Transmittance τ for the centre of every cell of `basis`.
    tau: Vec<f64>,
    /// Incident directions that can be chosen: the centres of the cells of `basis`, or the directions of the data if
    /// these do not form a lattice.
    choices: Vec<Incident>,
    /// Disk coordinates (right, up) of `choices`.
    points: Vec<[f64; 2]>,
    /// Whether `choices` are the directions of the data; every point of the disk then belongs to the nearest of them.
    listed: bool,
}

impl Incidences {
    fn new(btdf: &Btdf, projection: Projection) -> Self {
        let basis = super::incident_cells(btdf);
        let tau = basis.cells().map(|cell| btdf.tau(Incident(cell.centre()))).collect();
        let list = super::listed(btdf);
        let choices: Vec<Incident> = match list {
            Some(data) => data.incident().to_vec(),
            None => basis.cells().map(|cell| Incident(cell.centre())).collect(),
        };
        let points = choices.iter().map(|d| Side::Incident.disk(projection, d.0)).collect();
        Self { basis, tau, choices, points, listed: list.is_some() }
    }

    /// Returns the index in `choices` of the direction or cell to which an incident direction belongs; `None` if there
    /// is none.
    fn choice(&self, btdf: &Btdf, d: Dir<Facade>) -> Option<usize> {
        match super::listed(btdf) {
            Some(data) => data.standing_for(d),
            None => self.basis.index(d),
        }
    }
}

/// Display of the scattered light on the emergent side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Leaving {
    /// Disk of the emergent hemisphere in false colours.
    #[default]
    Disk,
    /// 3D polar surface whose radius is the value q or q·cosθ; it can be rotated.
    Body,
    /// Curves of the value over the emergent angle, in the plane of incidence and in the plane perpendicular to it.
    Cuts,
}

impl Leaving {
    const ALL: [(Self, Text, Text); 3] = [
        (Self::Disk, say::DISK, say::DISK_TIP),
        (Self::Body, say::BODY, say::BODY_TIP),
        (Self::Cuts, say::CUTS, say::CUTS_TIP),
    ];
}

/// Display settings and cached pictures of the BTDF tile.
#[derive(Debug, Clone)]
pub struct State {
    /// Display of the emergent side.
    pub leaving: Leaving,
    /// Projection of both hemispheres: the radius in the disk as a function of θ.
    pub projection: Projection,
    /// Whether the scale of the emergent side is logarithmic.
    pub log: bool,
    /// Whether q·cosθ is drawn instead of q.
    pub weighted: bool,
    /// Whether the cells of the incident side are shaded in grey by their transmittance τ.
    pub shade_tau: bool,
    /// Whether the user has locked the scale of the emergent side.
    pub hold: bool,
    incidences: Cache<(u64, Projection), Incidences>,
    indicatrix: Cache<(u64, Bits), Option<Indicatrix>>,
    left: Cache<(u64, Disk, Projection, bool, bool), Arc<Mesh>>,
    triangles: Cache<(u64, Disk, Projection), Arc<Mesh>>,
    outlines: Cache<(u64, Disk, Projection, bool, Grain), Arc<Mesh>>,
    right: Cache<EmergentKey, Arc<Mesh>>,
    /// Cached largest value of the emergent side, q or q·cosθ. \[1/sr\]
    most: Cache<(u64, Bits, bool), f64>,
    scale: Option<ColourScale>,
    lobe: lobe::State,
}

impl Default for State {
    fn default() -> Self {
        Self {
            leaving: Leaving::default(),
            lobe: lobe::State::default(),
            projection: Projection::default(),
            log: true,
            weighted: false,
            shade_tau: true,
            hold: false,
            triangles: Cache::default(),
            outlines: Cache::default(),
            most: Cache::default(),
            incidences: Cache::default(),
            indicatrix: Cache::default(),
            left: Cache::default(),
            right: Cache::default(),
            scale: None,
        }
    }
}

/// Draws the BTDF tile into all the space of `ui`. Returns the requests of the user.
pub fn show(ui: &mut Ui, input: &Input<'_>, state: &mut State) -> Vec<Action> {
    let (mut actions, mut picked) = (vec![], vec![]);
    let words = Words {
        title: say::BTDF.get(),
        subtitle: input.name,
        help: say::BTDF_ABOUT.get(),
        empty: input.btdf.is_none().then_some(say::BTDF_EMPTY.get()),
        controls_width: 545.0,
    };
    // The toggles and the picture both write: settings are copied for the head and taken back after.
    let mut settings = (state.projection, state.log, state.weighted, state.shade_tau);
    let mut leaving = state.leaving;
    let followed = input.incidence.source != Source::Chosen;
    let mut follow = followed;
    let mut hold = state.hold;
    tile::show(
        ui,
        &words,
        &input.status,
        |ui| {
            ui.checkbox(&mut follow, say::FOLLOW_THE_SUN);
            for (look, word, tip) in Leaving::ALL {
                ui.selectable_value(&mut leaving, look, word).on_hover_text(tip);
            }
            form::choice(ui, input, &mut actions);
            ui.toggle_value(&mut settings.1, say::LOG).on_hover_text(say::LOG_THREE);
            ui.toggle_value(&mut settings.2, "q·cosθ").on_hover_text(say::WEIGHTED_TIP);
            ui.toggle_value(&mut settings.3, "τ").on_hover_text(say::SHADE_TIP);
            let mut solid = settings.0 == Projection::SolidAngle;
            ui.toggle_value(&mut solid, "Ω").on_hover_text(say::SOLID_TIP);
            ui.toggle_value(&mut hold, say::HOLD).on_hover_text(say::HOLD_TIP);
            settings.0 = if solid { Projection::SolidAngle } else { Projection::ProjectedSolidAngle };
        },
        |ui, rect| match input.btdf {
            Some(btdf) => picture(ui, rect, btdf, input, state, &mut picked),
            None => Foot::default(),
        },
    );
    actions.append(&mut picked);
    (state.projection, state.log, state.weighted, state.shade_tau) = settings;
    state.leaving = leaving;
    state.hold = hold;
    if follow != followed {
        actions.push(Action::FollowSun(follow));
    }
    actions
}

fn picture(ui: &mut Ui, rect: Rect, btdf: &Btdf, input: &Input<'_>, state: &mut State, out: &mut Vec<Action>) -> Foot {
    let [outside, inside] = places(rect, state.leaving != Leaving::Disk);
    let incident = incident_side(ui, &outside, btdf, input, state, out);
    let emergent = emergent_side(ui, &inside, btdf, input, state);
    let rest = || input.form.and_then(|form| form.foot()).unwrap_or_else(|| selection_text(btdf, &input.incidence));
    emergent.or(incident).unwrap_or_else(rest)
}

fn disk_rect(disk: &Disk) -> Rect {
    Rect::from_center_size(disk.centre, egui::Vec2::splat(2.0 * disk.radius))
}

/// Draws the incident side, on which pointer and arrow keys choose a direction. Returns the line for that under the
/// pointer.
fn incident_side(
    ui: &mut Ui,
    place: &Place,
    btdf: &Btdf,
    input: &Input<'_>,
    state: &mut State,
    out: &mut Vec<Action>,
) -> Option<Foot> {
    let palette = Palette::of(ui.visuals());
    let projection = state.projection;
    let disk = place.disk;
    let response = ui.interact(disk_rect(&disk), ui.scope_id().with("incident"), Sense::click());
    let cells = state.incidences.get((input.revision, projection), || Incidences::new(btdf, projection));
    let scale = ColourScale {
        map: ColourMap::Grey,
        ..ColourScale::up_to(cells.tau.iter().copied().fold(0.0, f64::max).max(1e-3), false, 3, ColourMap::Grey)
    };
    let shade = state.shade_tau;
    let dark = ui.visuals().dark_mode;
    let mesh = state.left.get((input.revision, disk, projection, shade, dark), || {
        Arc::new(disk.cells(projection, Side::Incident, &cells.basis, |i| {
            if shade { scale.colour(cells.tau[i]) } else { palette.face }
        }))
    });
    let map = input.schemes.and_then(|schemes| schemes.triangles());
    if let (Some(list), Some(schemes)) = (map, &input.schemes) {
        ui.painter().circle_filled(disk.centre, disk.radius, palette.face);
        let key = (schemes.revision, disk, projection);
        let mesh = state.triangles.get(key, || Arc::new(schemes::mesh(&disk, projection, list, schemes)));
        ui.painter().add(Shape::Mesh(mesh.clone()));
    } else {
        ui.painter().add(Shape::Mesh(mesh.clone()));
    }
    if cells.listed {
        for at in &cells.points {
            ui.painter().circle(disk.screen(*at), 2.0, palette.face, Stroke::new(1.0, palette.ink));
        }
    } else if map.is_none() {
        let key = (input.revision, disk, projection, dark, grain(ui));
        let lines = state.outlines.get(key, || outlines(ui, &disk, projection, &cells.basis, &palette));
        ui.painter().add(Shape::Mesh(lines.clone()));
    }
    let from = match (place.legend, place.corner) {
        (None, Some(_)) if shade && map.is_none() => say::where_from_shaded(number(scale.hi, 2)),
        _ => say::WHERE_FROM.into(),
    };
    let with_key = map.is_some() && place.legend.is_none();
    if with_key && let Some((corner, align)) = place.corner {
        disk.rim(ui.painter(), projection, &palette);
        // Below "up", which stands over the disk.
        let corner = if align.y() == egui::Align::TOP { corner.with_min_y(corner.top() + 16.0) } else { corner };
        schemes::legend(ui, corner, align, input, &palette);
    } else {
        frame(ui, place, projection, [say::OUTSIDE.get(), &from], &palette);
    }
    // The chosen cell: light under dark, so that it is seen on every grey.
    let selected = cells.choice(btdf, input.incidence.direction.0);
    if let (true, Some(index)) = (cells.listed, selected) {
        let at = disk.screen(cells.points[index]);
        ui.painter().circle_stroke(at, 5.0, Stroke::new(4.0, palette.face));
        ui.painter().circle_stroke(at, 5.0, Stroke::new(2.0, palette.first));
    } else if let Some(index) = selected {
        let outline = outline(&disk, projection, Side::Incident, &cells.basis.cell(index));
        ui.painter().add(Shape::closed_line(outline.clone(), Stroke::new(4.0, palette.face)));
        ui.painter().add(Shape::closed_line(outline, Stroke::new(2.0, palette.first)));
    }
    if let Some(sun) = input.sun.filter(|sun| sun.0.vector().z > 0.0) {
        let at = disk.screen(incident_disk(projection, sun));
        ui.painter().circle(at, 6.0, palette.sun, Stroke::new(1.5, Color32::BLACK));
    }
    let mut choose = |index: usize| out.push(Action::ChooseIncidence(cells.choices[index]));
    let cell_at = |at| Side::Incident.direction_at(projection, disk.disk(at)).and_then(|d| cells.choice(btdf, d));
    if response.clicked() {
        response.request_focus();
        if let Some(index) = response.interact_pointer_pos().and_then(cell_at) {
            choose(index);
        }
    }
    if response.has_focus() {
        ui.painter().circle_stroke(disk.centre, disk.radius + 2.5, Stroke::new(1.0, palette.first));
        let filter = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
        let keys = [
            (Key::ArrowUp, [0.0, 1.0]),
            (Key::ArrowDown, [0.0, -1.0]),
            (Key::ArrowLeft, [-1.0, 0.0]),
            (Key::ArrowRight, [1.0, 0.0]),
        ];
        for (key, towards) in keys {
            let pressed = ui.input_mut(|i| i.consume_key(egui::Modifiers::NONE, key));
            let from = selected.map_or([0.0, 0.0], |index| cells.points[index]);
            if pressed && let Some(next) = neighbour(&cells.points, from, towards) {
                choose(next);
            }
        }
    }
    tile::name(ui, &response, say::INCIDENT_HEMISPHERE, selection_text(btdf, &input.incidence).full());
    if let Some(schemes) = &input.schemes {
        let reason = schemes.reason_at(response.hover_pos(), &disk, projection);
        if let (Some(_), Some(legend)) = (map, place.legend) {
            schemes::legend(ui, legend, Align2::LEFT_TOP, input, &palette);
        }
        return reason;
    }
    let pointed = response.hover_pos().and_then(cell_at);
    let pointed = pointed.map(|i| (cells.choices[i], btdf.tau(cells.choices[i])));
    if let (true, Some(legend)) = (shade, place.legend) {
        scale.paint_legend(ui.painter(), legend, "τ", pointed.map(|(_, tau)| tau), &palette);
    }
    pointed.map(|(d, tau)| pointed_text(d, tau))
}

fn outline(disk: &Disk, projection: Projection, side: Side, cell: &Cell) -> Vec<egui::Pos2> {
    cell_outline(projection, side, cell).into_iter().map(|p| disk.screen(p)).collect()
}

/// Returns hair lines between the cells of the incident side; none for more than 400 cells, which could not be
/// distinguished.
fn outlines(ui: &Ui, disk: &Disk, projection: Projection, basis: &RingBasis, palette: &Palette) -> Arc<Mesh> {
    let stroke = Stroke::new(0.6, palette.outline.gamma_multiply(0.6));
    let lines = if basis.len() > 400 { vec![] } else { disk.borders(projection, Side::Incident, basis) };
    frozen(ui, lines.into_iter().map(|line| Shape::line(line, stroke)))
}

/// Returns the colour scale of the emergent side, up to the value `max` \[1/sr\] unless the comparison sets it or it is
/// locked.
fn scale_of(max: f64, input: &Input<'_>, state: &State) -> ColourScale {
    let hold = input.status.hold_scale || state.hold;
    let held = state.scale.clone().filter(|s| hold && s.log == state.log);
    match input.range {
        Some([lo, hi]) => ColourScale {
            lo: if state.log { lo.max(hi * 1e-6) } else { lo },
            hi,
            log: state.log,
            map: ColourMap::Sequential,
        },
        None => held.unwrap_or_else(|| ColourScale::up_to(max, state.log, 3, ColourMap::Sequential)),
    }
}

/// Draws the scattered light on the emergent side, with legend. Returns the line for the direction under the pointer.
fn emergent_side(ui: &mut Ui, place: &Place, btdf: &Btdf, input: &Input<'_>, state: &mut State) -> Option<Foot> {
    let palette = Palette::of(ui.visuals());
    let direction = input.incidence.direction;
    let key = bits(direction);
    // Taken for this frame: the settings beside it are written meanwhile.
    let mut kept = std::mem::take(&mut state.indicatrix);
    let (revision, own) = match &input.form {
        Some(form) => (form.revision, form.made().map(|made| made.indicatrix.clone())),
        None => (input.revision, None),
    };
    let found = kept.get((revision, key), || match &input.form {
        Some(_) => own,
        None => btdf.indicatrix(direction),
    });
    let weighted = state.weighted;
    let scale = found.as_ref().map(|Indicatrix { basis, q }| {
        let values = || basis.cells().zip(q).map(|(cell, q)| drawn(*q, &cell, weighted));
        let most = *state.most.get((revision, key, weighted), || values().fold(0.0, f64::max));
        scale_of(most, input, state)
    });
    let unit = if weighted { "q·cosθ / (1/sr)" } else { "q / (1/sr)" };
    let regular = btdf.regular.as_ref().map_or(0.0, |r| r.at(direction.0.theta()));
    let legend = place.legend.unwrap_or(place.rect);
    // A scale that is shared stands above all tiles.
    let own_legend = input.range.is_none() || weighted;
    let (text, name) = match (found, &scale, state.leaving) {
        (Some(indicatrix), Some(scale), Leaving::Body) => {
            let body = lobe::Input { indicatrix, direction, regular, scale, weighted, key: (revision, key) };
            let (text, value) = lobe::show(ui, place, &body, &mut state.lobe);
            if own_legend {
                scale.paint_legend(ui.painter(), legend, unit, value, &palette);
            }
            (text, None)
        }
        (Some(indicatrix), Some(scale), Leaving::Cuts) => {
            cut::show(ui, place.rect, indicatrix, direction, scale, weighted);
            (None, None)
        }
        (found, scale, _) => {
            let (text, value, response) = emergent_disk_ui(ui, place, found.as_ref().zip(scale.as_ref()), input, state);
            match scale {
                Some(scale) if own_legend => scale.paint_legend(ui.painter(), legend, unit, value, &palette),
                Some(_) => {}
                None => {
                    let at = pos2(legend.center().x, legend.top() + 4.0);
                    let missing = input.form.map_or(say::NOTHING_SCATTERED.into(), |form| form.missing());
                    tile::caption(ui, at, Align2::CENTER_TOP, &missing);
                }
            }
            frame(ui, place, state.projection, [say::INSIDE.get(), say::WHERE_TO.get()], &palette);
            if regular > 0.0 && direction.0.vector().z > 0.0 {
                regular_dot(ui, place, state.projection, (direction, regular), &palette);
            }
            (text, Some(response))
        }
    };
    state.indicatrix = kept;
    state.scale = scale.or(state.scale.take());
    if let Some(response) = name {
        tile::name(ui, &response, say::EMERGENT_HEMISPHERE, selection_text(btdf, &input.incidence).full());
    }
    text
}

/// Draws the emergent hemisphere in false colours. Returns text and value (q or q·cosθ) \[1/sr\] for the cell under the
/// pointer, and the response of the disk.
fn emergent_disk_ui(
    ui: &mut Ui,
    place: &Place,
    found: Option<(&Indicatrix, &ColourScale)>,
    input: &Input<'_>,
    state: &mut State,
) -> (Option<Foot>, Option<f64>, egui::Response) {
    let palette = Palette::of(ui.visuals());
    let (projection, weighted, disk) = (state.projection, state.weighted, place.disk);
    let response = ui.interact(disk_rect(&disk), ui.scope_id().with("emergent"), Sense::hover());
    ui.painter().circle_filled(disk.centre, disk.radius, palette.face);
    let Some((Indicatrix { basis, q }, scale)) = found else { return (None, None, response) };
    let key = bits(input.incidence.direction);
    let revision = input.form.map_or(input.revision, |form| form.revision);
    let mesh = state.right.get((revision, key, disk, projection, weighted, scale.clone()), || {
        Arc::new(disk.cells(projection, Side::Emergent, basis, |i| scale.colour(drawn(q[i], &basis.cell(i), weighted))))
    });
    ui.painter().add(Shape::Mesh(mesh.clone()));
    let pointed = response
        .hover_pos()
        .and_then(|at| Side::Emergent.direction_at(projection, disk.disk(at)))
        .and_then(|d| basis.index(d));
    let Some(index) = pointed else { return (None, None, response) };
    let cell = basis.cell(index);
    let outline = outline(&disk, projection, Side::Emergent, &cell);
    ui.painter().add(Shape::closed_line(outline, Stroke::new(1.5, Color32::WHITE)));
    let value = drawn(q[index], &cell, weighted);
    (Some(leaving_text(cell.centre(), value, weighted)), Some(value), response)
}

/// Draws a dot in the emergent direction of the regularly transmitted light, with the regular transmittance τ.
fn regular_dot(ui: &Ui, place: &Place, projection: Projection, (from, tau): (Incident, f64), palette: &Palette) {
    let rect = place.rect;
    let at = place.disk.screen(emergent_disk(projection, Emergent::from_undeviated(from.0)));
    ui.painter().circle(at, 5.0, palette.beam, Stroke::new(1.5, Color32::WHITE));
    let label = say::regular_tau(number(tau, 3));
    let galley = ui.painter().layout_no_wrap(label, egui::FontId::proportional(13.0), palette.ink);
    // Beside the dot where there is room, else over it.
    let right = Align2::LEFT_CENTER.anchor_size(at + egui::vec2(9.0, 0.0), galley.size());
    let left = Align2::RIGHT_CENTER.anchor_size(at - egui::vec2(9.0, 0.0), galley.size());
    let over = Align2::CENTER_BOTTOM.anchor_size(at - egui::vec2(0.0, 9.0), galley.size());
    let fits = |place: &Rect| place.left() >= rect.left() + 2.0 && place.right() <= rect.right() - 2.0;
    let most = (rect.right() - 2.0 - galley.size().x).max(rect.left() + 2.0);
    let over = over.translate(egui::vec2(over.left().clamp(rect.left() + 2.0, most) - over.left(), 0.0));
    let place = [right, left].into_iter().find(fits).unwrap_or(over);
    ui.painter().rect_filled(place.expand(2.0), 3, palette.face);
    ui.painter().galley(place.min, galley, palette.ink);
}

/// Returns the indicatrix of the chosen incident direction as CSV: emergent direction (θ, φ in the façade frame) \[°\],
/// projected solid angle of the cell \[sr\], q \[1/sr\].
pub fn csv(input: &Input<'_>) -> String {
    use std::fmt::Write as _;
    let mut out = String::new();
    let Some(btdf) = input.btdf else { return out };
    let theta = input.incidence.direction.0.theta();
    let regular = btdf.regular.as_ref().map_or(0.0, |r| r.at(theta));
    let _ = writeln!(out, "# {}", input.name.replace(['\n', '\r'], " "));
    let phi = input.incidence.direction.0.phi();
    out.push_str("# incidence ");
    let _ = writeln!(out, "theta_deg,{:.4},phi_deg,{:.4}", theta.to_degrees(), phi.to_degrees());
    out.push_str("# ");
    let _ = writeln!(out, "tau,{:.6},regular,{regular:.6}", btdf.tau(input.incidence.direction));
    if let Some(form) = &input.form {
        let _ = writeln!(out, "# data,{}", form.key());
    }
    out.push_str("leaving_theta_deg,leaving_phi_deg,projected_solid_angle_sr,q_per_sr\n");
    let shown = match &input.form {
        Some(form) => form.made().map(|made| made.indicatrix.clone()),
        None => btdf.indicatrix(input.incidence.direction),
    };
    if let Some(Indicatrix { basis, q }) = shown {
        for (cell, q) in basis.cells().zip(q) {
            let leaving = Emergent::from_undeviated(cell.centre()).0;
            let (theta, phi) = (leaving.theta().to_degrees(), leaving.phi().to_degrees());
            let _ = writeln!(out, "{theta:.4},{phi:.4},{:.9},{q:.9}", cell.projected_solid_angle());
        }
    }
    out
}
