//! An indicatrix made of pieces of the data's own: what every scheme comes down to, drawn in one place.

use crate::compute::direction::Dir;
use crate::compute::incidence::grid::Grid;
use crate::compute::incidence::model::{Model, Recipe};
use glam::{DQuat, DVec3};

/// What a piece looks like before it is turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// The base of an incident direction.
    Base(usize),
    /// A lobe of an incident direction.
    Lobe(usize, usize),
    /// A round Gaussian about +z with this standard deviation. \[rad\]
    Spot(f64),
}

/// A shape, where it goes and what it carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Which.
    pub shape: Shape,
    /// Turns it from its own place to where it goes.
    pub turn: DQuat,
    /// Share of the incident flux, kept exactly whatever is cut off at the horizon.
    pub flux: f64,
}

/// Pieces that add up to an indicatrix.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Blend {
    /// In no particular order.
    pub pieces: Vec<Piece>,
}

/// Turns smaller than this are none. \[rad, about\]
const STILL: f64 = 1e-12;

impl Piece {
    /// Whether it stays where the data have it.
    pub fn stays(&self) -> bool {
        self.turn.xyz().length() < STILL
    }

    /// About where it is: of a lobe its centre, of a base the direction that its normal has been turned to.
    pub fn place(&self, model: &Model) -> DVec3 {
        match self.shape {
            Shape::Lobe(vertex, lobe) => self.turn * model.lobes[vertex][lobe].centre,
            Shape::Base(_) | Shape::Spot(_) => self.turn * DVec3::Z,
        }
    }
}

impl Blend {
    /// The pieces of a recipe.
    pub fn of_recipe(model: &Model, recipe: &Recipe) -> Self {
        let mut blend = Self::default();
        for base in &recipe.bases {
            blend.push(Shape::Base(base.vertex), DQuat::IDENTITY, base.factor * model.base_flux[base.vertex]);
        }
        for copy in &recipe.copies {
            let from = model.lobes[copy.vertex][copy.lobe].centre;
            blend.push(Shape::Lobe(copy.vertex, copy.lobe), DQuat::from_rotation_arc(from, copy.centre), copy.flux);
        }
        blend
    }

    /// A whole indicatrix of the data, turned, carrying `flux`.
    pub fn of_whole(model: &Model, vertex: usize, turn: DQuat, flux: f64) -> Self {
        let own = model.base_flux[vertex] + model.lobes[vertex].iter().map(|lobe| lobe.flux).sum::<f64>();
        let mut blend = Self::default();
        if own > 0.0 {
            blend.push(Shape::Base(vertex), turn, model.base_flux[vertex] / own * flux);
            for (l, lobe) in model.lobes[vertex].iter().enumerate() {
                blend.push(Shape::Lobe(vertex, l), turn, lobe.flux / own * flux);
            }
        }
        blend
    }

    /// Adds a piece that carries anything.
    pub fn push(&mut self, shape: Shape, turn: DQuat, flux: f64) {
        if flux > 0.0 {
            self.pieces.push(Piece { shape, turn, flux });
        }
    }

    /// Adds the pieces of another, `scale` times.
    pub fn add(&mut self, other: &Self, scale: f64) {
        for piece in &other.pieces {
            self.push(piece.shape, piece.turn, piece.flux * scale);
        }
    }

    /// Share of the incident flux that all pieces carry.
    pub fn flux(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.flux).sum()
    }

    /// The same shape with another flux; `None` when it carries nothing and should.
    pub fn with_flux(mut self, tau: f64) -> Option<Self> {
        if tau <= 0.0 {
            return Some(Self::default());
        }
        let own = self.flux();
        if own <= 0.0 {
            return None;
        }
        self.pieces.iter_mut().for_each(|piece| piece.flux *= tau / own);
        Some(self)
    }

    /// q on the cells of `target`, lobes and spots as means of `points`² directions a cell. \[1/sr\]
    pub fn coefficient(&self, model: &Model, target: &Grid, points: usize) -> Vec<f64> {
        let mut sum = vec![0.0; target.basis().len()];
        let mut still = std::collections::BTreeMap::new();
        let mut out = Vec::new();
        for piece in &self.pieces {
            match piece.shape {
                Shape::Base(vertex) if piece.stays() => *still.entry(vertex).or_insert(0.0) += piece.flux,
                _ => {
                    out.clear();
                    draw(model, piece, target, points, &mut out);
                    deposit(&out, (piece.flux, piece.place(model)), target, &mut sum);
                }
            }
        }
        for (vertex, flux) in still {
            out.clear();
            let piece = Piece { shape: Shape::Base(vertex), turn: DQuat::IDENTITY, flux };
            draw(model, &piece, target, points, &mut out);
            deposit(&out, (flux, DVec3::Z), target, &mut sum);
        }
        sum
    }
}

/// Adds a drawn piece with exactly its flux. A piece that fell off the hemisphere altogether lands at its rim.
fn deposit(out: &[(usize, f64)], (wanted, place): (f64, DVec3), target: &Grid, sum: &mut [f64]) {
    let flux: f64 = out.iter().map(|&(cell, q)| q * target.projected[cell]).sum();
    if flux > 0.0 {
        out.iter().for_each(|&(cell, q)| sum[cell] += q * (wanted / flux));
    } else {
        let dot = |cell: &usize| target.centre[*cell].dot(place);
        if let Some(cell) = (0..sum.len()).max_by(|a, b| dot(a).total_cmp(&dot(b))) {
            sum[cell] += wanted / target.projected[cell];
        }
    }
}

/// Values of a piece on the cells that it reaches, not normalised.
fn draw(model: &Model, piece: &Piece, target: &Grid, points: usize, out: &mut Vec<(usize, f64)>) {
    // Cells ask where their light came from: drawn the other way, a turned piece would leave holes between cells.
    let back = piece.turn.conjugate();
    match piece.shape {
        Shape::Base(vertex) => {
            let base = model.base(vertex);
            if piece.stays() {
                // Where it stays, a base has its own cells' values: interpolation would only blur it.
                let same = model.grid.basis() == target.basis();
                for (cell, &d) in target.centre.iter().enumerate() {
                    let own = if same { cell } else { model.grid.basis().index(Dir::from_unit(d)).unwrap_or(0) };
                    // A base is what lobes leave of the data; below 0 is rounding.
                    out.push((cell, base[own].max(0.0)));
                }
            } else {
                let first = |ring| model.grid.basis().first_cell(ring);
                for (cell, &d) in target.centre.iter().enumerate() {
                    let d = back * d;
                    // What would have come from behind the plane is not known, and adds nothing.
                    if d.z > 0.0 {
                        let around = model.grid.around_rings(d);
                        let q: f64 = around.iter().map(|&(ring, k, _, w)| w * base[first(ring) + k]).sum();
                        out.push((cell, q.max(0.0)));
                    }
                }
            }
        }
        Shape::Lobe(vertex, l) => {
            let lobe = &model.lobes[vertex][l];
            // As in the data, to the last digit; the picture below is sampled and interpolated.
            if piece.stays() && model.grid.basis() == target.basis() {
                out.extend(lobe.cells(&model.grid));
                return;
            }
            let picture = model.rasters[vertex][l].turned_by(piece.turn);
            // A little more than the lobe, since its picture fades out over the cells around it.
            target.within(piece.turn * lobe.centre, lobe.radius + 0.04, |cell| {
                let q = target.cell_mean(cell, points, |d| picture.at(d));
                if q > 0.0 {
                    out.push((cell, q));
                }
            });
        }
        Shape::Spot(spread) => {
            let centre = piece.turn * DVec3::Z;
            target.within(centre, 3.5 * spread, |cell| {
                // e^((cosα − 1)/σ²) is e^(−α²/2σ²) for small α, without an arc cosine.
                let q = target.cell_mean(cell, points, |d| ((d.dot(centre) - 1.0) / (spread * spread)).exp());
                if q > 1e-6 {
                    out.push((cell, q));
                }
            });
        }
    }
}
