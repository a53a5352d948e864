//! Indicatrix made of turned pieces of the data's own: the form that every scheme yields, drawn in one place.

use crate::compute::direction::Dir;
use crate::compute::incidence::grid::Grid;
use crate::compute::incidence::model::{Model, Recipe};
use glam::{DQuat, DVec3};

/// Base or lobe of an incident direction, with its rotation and flux.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    vertex: usize,
    /// Number of the lobe; `None` is the base.
    lobe: Option<usize>,
    /// Rotation from the piece's own place to where it goes.
    turn: DQuat,
    /// Share of the incident flux, kept exactly whatever is cut off at the horizon.
    flux: f64,
}

/// Pieces that add up to an indicatrix.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Blend {
    pieces: Vec<Piece>,
}

/// Rotation below which a piece stays where it is. \[rad, about\] Rounding of unit vectors that should be equal rotates
/// by some 2⁻⁵² ≈ 2.2e-16.
const STILL: f64 = 1e-12;

impl Piece {
    /// Whether the piece stays where the data have it.
    fn stays(&self) -> bool {
        self.turn.xyz().length() < STILL
    }

    /// Returns the approximate place of the piece: of a lobe its centre, of a base the direction that its normal has
    /// been turned to.
    fn place(&self, model: &Model) -> DVec3 {
        self.turn * self.lobe.map_or(DVec3::Z, |lobe| model.lobes[self.vertex][lobe].centre)
    }
}

impl Blend {
    /// Creates the pieces of a recipe.
    pub(super) fn of_recipe(model: &Model, recipe: &Recipe) -> Self {
        let mut blend = Self::default();
        for base in &recipe.bases {
            blend.push(base.vertex, None, DQuat::IDENTITY, base.factor * model.base_flux[base.vertex]);
        }
        for copy in &recipe.copies {
            let from = model.lobes[copy.vertex][copy.lobe].centre;
            blend.push(copy.vertex, Some(copy.lobe), DQuat::from_rotation_arc(from, copy.centre), copy.flux);
        }
        blend
    }

    /// Adds a whole indicatrix of the data, turned, carrying `flux`.
    pub(super) fn push_whole(&mut self, model: &Model, vertex: usize, turn: DQuat, flux: f64) {
        let own = model.base_flux[vertex] + model.lobes[vertex].iter().map(|lobe| lobe.flux).sum::<f64>();
        if own > 0.0 {
            self.push(vertex, None, turn, model.base_flux[vertex] / own * flux);
            for (l, lobe) in model.lobes[vertex].iter().enumerate() {
                self.push(vertex, Some(l), turn, lobe.flux / own * flux);
            }
        }
    }

    /// Adds a piece if it carries any flux.
    fn push(&mut self, vertex: usize, lobe: Option<usize>, turn: DQuat, flux: f64) {
        if flux > 0.0 {
            self.pieces.push(Piece { vertex, lobe, turn, flux });
        }
    }

    /// Returns the shape with the flux `tau`; `None` if it carries nothing and should.
    pub(super) fn with_flux(mut self, tau: f64) -> Option<Self> {
        if tau <= 0.0 {
            return Some(Self::default());
        }
        let own: f64 = self.pieces.iter().map(|piece| piece.flux).sum();
        if own <= 0.0 {
            return None;
        }
        self.pieces.iter_mut().for_each(|piece| piece.flux *= tau / own);
        Some(self)
    }

    /// Returns q on the cells of `target`, lobes as means of `points`² directions per cell. \[1/sr\]
    pub(super) fn coefficient(&self, model: &Model, target: &Grid, points: usize) -> Vec<f64> {
        let mut sum = vec![0.0; target.basis().len()];
        let mut out = Vec::new();
        for piece in &self.pieces {
            out.clear();
            match piece.lobe {
                Some(lobe) => draw_lobe(model, piece, lobe, (target, points), &mut out),
                None => draw_base(model, piece, target, &mut out),
            }
            deposit(&out, (piece.flux, piece.place(model)), target, &mut sum);
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

/// Draws the values of a base on the cells, not normalised.
fn draw_base(model: &Model, piece: &Piece, target: &Grid, out: &mut Vec<(usize, f64)>) {
    let base = model.base(piece.vertex);
    if piece.stays() {
        // Where it stays, a base has its own cells' values: interpolation would only blur it.
        let same = model.grid.basis() == target.basis();
        for (cell, &d) in target.centre.iter().enumerate() {
            let own = if same { cell } else { model.grid.basis().index(Dir::from_unit(d)).unwrap_or(0) };
            // A base is what lobes leave of the data; below 0 is rounding.
            out.push((cell, base[own].max(0.0)));
        }
        return;
    }
    // Cells ask where their light came from: drawn the other way, a turned piece would leave holes between cells.
    let back = piece.turn.conjugate();
    for (cell, &d) in target.centre.iter().enumerate() {
        let d = back * d;
        // What would have come from behind the plane is not known, and adds nothing.
        if d.z > 0.0 {
            let around = model.grid.around_rings(d);
            let first = |ring| model.grid.basis().first_cell(ring);
            let q: f64 = around.iter().map(|&(ring, k, _, w)| w * base[first(ring) + k]).sum();
            out.push((cell, q.max(0.0)));
        }
    }
}

/// Draws the values of a lobe on the cells that it reaches, not normalised.
fn draw_lobe(model: &Model, piece: &Piece, lobe: usize, (target, points): (&Grid, usize), out: &mut Vec<(usize, f64)>) {
    let own = &model.lobes[piece.vertex][lobe];
    // As in the data, to the last digit; the picture below is sampled and interpolated.
    if piece.stays() && model.grid.basis() == target.basis() {
        out.extend(own.cells(&model.grid));
        return;
    }
    let picture = model.rasters[piece.vertex][lobe].turned_by(piece.turn);
    // A little more than the lobe, since its picture fades out over the cells around it.
    target.within(piece.turn * own.centre, own.radius + 0.04, |cell| {
        let q = target.cell_mean(cell, points, |d| picture.at(d));
        if q > 0.0 {
            out.push((cell, q));
        }
    });
}
