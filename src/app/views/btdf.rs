//! The BTDF: left where light comes from, right where it goes, both seen from inside the room.

mod cut;
mod lobe;
mod place;
mod words;

use super::Cache;
use crate::app::incidence::{Incidence, Source};
use crate::app::paint::colour_scale::ColourScale;
use crate::app::paint::hemisphere::{Disk, Projection, Side, cell_outline, emergent_disk, incident_disk, neighbour};
use crate::app::paint::palette::{ColourMap, Palette};
use crate::app::paint::tile::{self, Foot, Status, Words};
use crate::compute::basis::{Cell, RingBasis};
use crate::compute::btdf::{Btdf, Indicatrix};
use crate::compute::direction::{Dir, Emergent, Facade, Incident};
use crate::drawing::ticks::number;
use egui::{Align2, Color32, EventFilter, Key, Mesh, Rect, Sense, Shape, Stroke, Ui, pos2};
use place::{Place, frame, places};
use std::sync::Arc;
use words::{drawn, leaving_text, pointed_text, selection_text};

/// What the tile draws.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Transmission of light from outside; `None` while no product is chosen.
    pub btdf: Option<&'a Btdf>,
    /// Product and state in words.
    pub name: &'a str,
    /// The direction of incidence, the sun's or a chosen one.
    pub incidence: Incidence,
    /// Where the sun is, if it is before the façade.
    pub sun: Option<Incident>,
    /// Scale forced from outside (comparison), lowest and highest q.
    pub range: Option<[f64; 2]>,
    /// Changes with `btdf`.
    pub revision: u64,
    /// How far the content is to be trusted.
    pub status: Status<'a>,
}

/// What the user did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Action {
    /// A cell of the incident hemisphere was chosen: its centre.
    ChooseIncidence(Incident),
    /// Couple the incidence to the sun, or not.
    FollowSun(bool),
}

type Bits = [u64; 3];

/// What the picture of the emergent side depends on.
type EmergentKey = (u64, Bits, Disk, Projection, bool, ColourScale);

fn bits(incident: Incident) -> Bits {
    incident.0.vector().to_array().map(f64::to_bits)
}

/// What the incident side shows: cells in grey, and the incidences that can be chosen.
#[derive(Debug, Clone)]
struct Incidences {
    basis: RingBasis,
    /// τ of every cell of `basis`.
    tau: Vec<f64>,
    /// The centres of the cells, or the directions of a list that is no lattice.
    choices: Vec<Incident>,
    /// Where the choices lie on the disk.
    points: Vec<[f64; 2]>,
    /// The choices are a list; every place of the disk belongs to the nearest of them.
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

    /// The choice that a direction belongs to.
    fn choice(&self, btdf: &Btdf, d: Dir<Facade>) -> Option<usize> {
        match super::listed(btdf) {
            Some(data) => data.standing_for(d),
            None => self.basis.index(d),
        }
    }
}

/// How the side is drawn on which light leaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Leaving {
    /// As a disk in false colours.
    #[default]
    Disk,
    /// As a body, its radius the value; turned by hand.
    Body,
    /// As curves over the angle, in the plane of incidence and across it.
    Cuts,
}

impl Leaving {
    const ALL: [(Self, &'static str, &'static str); 3] = [
        (Self::Disk, "Disk", "Where light goes, in false colours"),
        (Self::Body, "3D", "The same as a body, its radius the value; drag to turn, wheel to zoom"),
        (Self::Cuts, "Cuts", "Curves over the angle, in the plane of incidence and across it"),
    ];
}

/// The tile's own settings and pictures.
#[derive(Debug, Clone)]
pub struct State {
    /// How the side is drawn on which light leaves.
    pub leaving: Leaving,
    /// How θ becomes a radius.
    pub projection: Projection,
    /// Logarithmic colours.
    pub log: bool,
    /// q·cosθ instead of q.
    pub weighted: bool,
    /// Grey by τ on the incident side.
    pub shade_tau: bool,
    incidences: Cache<(u64, Projection), Incidences>,
    indicatrix: Cache<(u64, Bits), Option<Indicatrix>>,
    left: Cache<(u64, Disk, Projection, bool, bool), Arc<Mesh>>,
    right: Cache<EmergentKey, Arc<Mesh>>,
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
            incidences: Cache::default(),
            indicatrix: Cache::default(),
            left: Cache::default(),
            right: Cache::default(),
            scale: None,
        }
    }
}

const HELP: &str = "For one direction of incidence (left), the luminance coefficient q = L/E in every direction in which \
light leaves (right). Both hemispheres are seen from inside: a source is drawn where it is seen, emergent light where \
it goes. θ is counted from the façade's normal, φ from the right seen from outside towards up. Click a cell or use the \
arrow keys.\nSource: IEA SHC Task 31 report (2005), eq 2; data as measured or computed for the product.";

/// Draws the tile into all the space of `ui`.
pub fn show(ui: &mut Ui, input: &Input<'_>, state: &mut State) -> Vec<Action> {
    let mut actions = vec![];
    let words = Words {
        title: "BTDF",
        subtitle: input.name,
        help: HELP,
        empty: input.btdf.is_none().then_some("Choose a product in the catalogue to see where its light goes."),
        controls_width: 460.0,
    };
    // The toggles and the picture both write: settings are copied for the head and taken back after.
    let mut settings = (state.projection, state.log, state.weighted, state.shade_tau);
    let mut leaving = state.leaving;
    let followed = input.incidence.source != Source::Chosen;
    let mut follow = followed;
    tile::show(
        ui,
        &words,
        &input.status,
        |ui| {
            ui.checkbox(&mut follow, "Follow the sun");
            for (look, word, tip) in Leaving::ALL {
                ui.selectable_value(&mut leaving, look, word).on_hover_text(tip);
            }
            ui.toggle_value(&mut settings.1, "log").on_hover_text("Logarithmic colours, three decades");
            ui.toggle_value(&mut settings.2, "q·cosθ").on_hover_text("Times the cosine: what intensity is made of");
            ui.toggle_value(&mut settings.3, "τ").on_hover_text("Grey by transmittance on the incident side");
            let mut solid = settings.0 == Projection::SolidAngle;
            ui.toggle_value(&mut solid, "Ω").on_hover_text(
                "On: equal areas are equal solid angles (Lambert). Off: equal projected solid angles, r = sin θ",
            );
            settings.0 = if solid { Projection::SolidAngle } else { Projection::ProjectedSolidAngle };
        },
        |ui, rect| match input.btdf {
            Some(btdf) => picture(ui, rect, btdf, input, state, &mut actions),
            None => Foot::default(),
        },
    );
    (state.projection, state.log, state.weighted, state.shade_tau) = settings;
    state.leaving = leaving;
    if follow != followed {
        actions.push(Action::FollowSun(follow));
    }
    actions
}

fn picture(ui: &mut Ui, rect: Rect, btdf: &Btdf, input: &Input<'_>, state: &mut State, out: &mut Vec<Action>) -> Foot {
    let [outside, inside] = places(rect, state.leaving != Leaving::Disk);
    let incident = incident_side(ui, &outside, btdf, input, state, out);
    let emergent = emergent_side(ui, &inside, btdf, input, state);
    emergent.or(incident).unwrap_or_else(|| selection_text(btdf, &input.incidence))
}

fn disk_rect(disk: &Disk) -> Rect {
    Rect::from_center_size(disk.centre, egui::Vec2::splat(2.0 * disk.radius))
}

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
    ui.painter().add(Shape::Mesh(mesh.clone()));
    if cells.listed {
        for at in &cells.points {
            ui.painter().circle(disk.screen(*at), 2.0, palette.face, Stroke::new(1.0, palette.ink));
        }
    } else {
        outline_all(ui, &disk, projection, &cells.basis, &palette);
    }
    let from = match (place.legend, place.corner) {
        (None, Some(_)) if shade => format!("where light comes from\ngrey: τ 0–{}", number(scale.hi, 2)),
        _ => "where light comes from".to_owned(),
    };
    frame(ui, place, projection, ["outside", &from], &palette);
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
    let cell_at = |at| Side::Incident.through_name(projection, disk.disk(at)).and_then(|d| cells.choice(btdf, d));
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
    tile::name(ui, &response, "Incident hemisphere", selection_text(btdf, &input.incidence).full());
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

/// Hair lines between cells, while they are large enough to be told apart.
fn outline_all(ui: &Ui, disk: &Disk, projection: Projection, basis: &RingBasis, palette: &Palette) {
    if basis.len() > 400 {
        return;
    }
    let stroke = Stroke::new(0.6, palette.outline.gamma_multiply(0.6));
    for cell in basis.cells() {
        ui.painter().add(Shape::closed_line(outline(disk, projection, Side::Incident, &cell), stroke));
    }
}

/// The scale of what leaves; while something is dragged it holds still.
fn scale_of(max: f64, input: &Input<'_>, state: &State) -> ColourScale {
    let held = state.scale.clone().filter(|s| input.status.hold_scale && s.log == state.log);
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

fn emergent_side(ui: &mut Ui, place: &Place, btdf: &Btdf, input: &Input<'_>, state: &mut State) -> Option<Foot> {
    let palette = Palette::of(ui.visuals());
    let direction = input.incidence.direction;
    let key = bits(direction);
    // Taken for this frame: the settings beside it are written meanwhile.
    let mut kept = std::mem::take(&mut state.indicatrix);
    let found = kept.get((input.revision, key), || btdf.indicatrix(direction));
    let weighted = state.weighted;
    let scale = found.as_ref().map(|Indicatrix { basis, q }| {
        let values = basis.cells().zip(q).map(|(cell, q)| drawn(*q, &cell, weighted));
        scale_of(values.fold(0.0, f64::max), input, state)
    });
    let unit = if weighted { "q·cosθ / (1/sr)" } else { "q / (1/sr)" };
    let regular = btdf.regular.as_ref().map_or(0.0, |r| r.at(direction.0.theta()));
    let legend = place.legend.unwrap_or(place.rect);
    // A scale that is shared stands above all tiles.
    let own_legend = input.range.is_none() || weighted;
    let (text, name) = match (found, &scale, state.leaving) {
        (Some(indicatrix), Some(scale), Leaving::Body) => {
            let body = lobe::Input { indicatrix, direction, regular, scale, weighted, key: (input.revision, key) };
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
                    tile::caption(ui, at, Align2::CENTER_TOP, "nothing is scattered");
                }
            }
            frame(ui, place, state.projection, ["inside", "where light goes"], &palette);
            if regular > 0.0 && direction.0.vector().z > 0.0 {
                regular_dot(ui, place, state.projection, (direction, regular), &palette);
            }
            (text, Some(response))
        }
    };
    state.indicatrix = kept;
    state.scale = scale.or(state.scale.take());
    if let Some(response) = name {
        tile::name(ui, &response, "Emergent hemisphere", selection_text(btdf, &input.incidence).full());
    }
    text
}

/// The hemisphere in false colours: words and value of what is under the cursor.
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
    let mesh = state.right.get((input.revision, key, disk, projection, weighted, scale.clone()), || {
        Arc::new(disk.cells(projection, Side::Emergent, basis, |i| scale.colour(drawn(q[i], &basis.cell(i), weighted))))
    });
    ui.painter().add(Shape::Mesh(mesh.clone()));
    let pointed = response
        .hover_pos()
        .and_then(|at| Side::Emergent.through_name(projection, disk.disk(at)))
        .and_then(|d| basis.index(d));
    let Some(index) = pointed else { return (None, None, response) };
    let cell = basis.cell(index);
    let outline = outline(&disk, projection, Side::Emergent, &cell);
    ui.painter().add(Shape::closed_line(outline, Stroke::new(1.5, Color32::WHITE)));
    let value = drawn(q[index], &cell, weighted);
    (Some(leaving_text(cell.centre(), value, weighted)), Some(value), response)
}

/// What goes straight on, where it goes.
fn regular_dot(ui: &Ui, place: &Place, projection: Projection, (from, tau): (Incident, f64), palette: &Palette) {
    let rect = place.rect;
    let at = place.disk.screen(emergent_disk(projection, Emergent::from_through_name(from.0)));
    ui.painter().circle(at, 5.0, palette.beam, Stroke::new(1.5, Color32::WHITE));
    let label = format!("regular τ {}", number(tau, 3));
    let galley = ui.painter().layout_no_wrap(label, egui::FontId::proportional(13.0), palette.ink);
    // Beside the dot where there is room, else over it.
    let right = Align2::LEFT_CENTER.anchor_size(at + egui::vec2(9.0, 0.0), galley.size());
    let left = Align2::RIGHT_CENTER.anchor_size(at - egui::vec2(9.0, 0.0), galley.size());
    let over = Align2::CENTER_BOTTOM.anchor_size(at - egui::vec2(0.0, 9.0), galley.size());
    let fits = |place: &Rect| place.left() >= rect.left() + 2.0 && place.right() <= rect.right() - 2.0;
    let place = [right, left].into_iter().find(fits).unwrap_or(over);
    ui.painter().rect_filled(place.expand(2.0), 3, palette.face);
    ui.painter().galley(place.min, galley, palette.ink);
}

/// The indicatrix of the chosen incidence: direction in which light leaves (façade frame), q and solid angle.
pub fn csv(input: &Input<'_>) -> String {
    use std::fmt::Write as _;
    let mut out = String::new();
    let Some(btdf) = input.btdf else { return out };
    let theta = input.incidence.direction.0.theta();
    let regular = btdf.regular.as_ref().map_or(0.0, |r| r.at(theta));
    let _ = writeln!(out, "# {}", input.name.replace(['\n', '\r'], " "));
    let _ = writeln!(
        out,
        "# incidence theta_deg,{:.4},phi_deg,{:.4}",
        theta.to_degrees(),
        input.incidence.direction.0.phi().to_degrees()
    );
    let _ = writeln!(out, "# tau,{:.6},regular,{regular:.6}", btdf.tau(input.incidence.direction));
    out.push_str("leaving_theta_deg,leaving_phi_deg,projected_solid_angle_sr,q_per_sr\n");
    if let Some(Indicatrix { basis, q }) = btdf.indicatrix(input.incidence.direction) {
        for (cell, q) in basis.cells().zip(q) {
            let leaving = Emergent::from_through_name(cell.centre()).0;
            let (theta, phi) = (leaving.theta().to_degrees(), leaving.phi().to_degrees());
            let _ = writeln!(out, "{theta:.4},{phi:.4},{:.9},{q:.9}", cell.projected_solid_angle());
        }
    }
    out
}
