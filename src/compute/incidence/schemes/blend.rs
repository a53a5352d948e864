//! Interpolated indicatrix as a sum of rotated bases and lobes of the data: the common result of all schemes, and its
//! values on cells.

use crate::compute::direction::Dir;
use crate::compute::incidence::grid::Grid;
use crate::compute::incidence::model::{Model, Recipe};
use glam::{DQuat, DVec3};

/// Base or lobe of an incident direction of the data, with the rotation and the flux that it has in the interpolated
/// indicatrix.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    vertex: usize,
    /// Index of the lobe; `None` for the base.
    lobe: Option<usize>,
    /// Rotation from the direction in the data to that in the interpolated indicatrix.
    turn: DQuat,
    /// Share of the incident flux; exact even if a part is cut off at the border of the hemisphere.
    flux: f64,
}

/// Rotated bases and lobes that add up to an indicatrix.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Blend {
    pieces: Vec<Piece>,
}

/// Rotation below which a base or lobe counts as unrotated. \[rad, about\] Rounding of unit vectors that should be
/// equal rotates by some 2⁻⁵² ≈ 2.2e-16.
const STILL: f64 = 1e-12;

impl Piece {
    /// Whether the base or lobe has the direction that it has in the data.
    fn stays(&self) -> bool {
        self.turn.xyz().length() < STILL
    }

    /// Returns the approximate direction of the piece: the rotated centre of a lobe, or the rotated normal for a base.
    fn place(&self, model: &Model) -> DVec3 {
        self.turn * self.lobe.map_or(DVec3::Z, |lobe| model.lobes[self.vertex][lobe].centre)
    }
}

impl Blend {
    /// Creates the sum of the bases and lobes of a recipe.
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

    /// Adds the whole indicatrix of an incident direction of the data, rotated and scaled to `flux`.
    pub(super) fn push_whole(&mut self, model: &Model, vertex: usize, turn: DQuat, flux: f64) {
        let own = model.base_flux[vertex] + model.lobes[vertex].iter().map(|lobe| lobe.flux).sum::<f64>();
        if own > 0.0 {
            self.push(vertex, None, turn, model.base_flux[vertex] / own * flux);
            for (l, lobe) in model.lobes[vertex].iter().enumerate() {
                self.push(vertex, Some(l), turn, lobe.flux / own * flux);
            }
        }
    }

    /// Adds a base or lobe if its flux is above 0.
    fn push(&mut self, vertex: usize, lobe: Option<usize>, turn: DQuat, flux: f64) {
        if flux > 0.0 {
            self.pieces.push(Piece { vertex, lobe, turn, flux });
        }
    }

    /// Returns the sum scaled to the flux `tau`; `None` if its flux is 0 and `tau` is not.
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

    /// Returns q of the sum on the cells of `target`; lobes are means of `points`² directions per cell. \[1/sr\]
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

/// Adds the values `out` of a piece to `sum`, scaled to exactly its flux. The flux of a piece outside the hemisphere
/// goes to the cell nearest to it.
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

/// Computes the values of a rotated base on the cells, not normalised.
fn draw_base(model: &Model, piece: &Piece, target: &Grid, out: &mut Vec<(usize, f64)>) {
    let base = model.base(piece.vertex);
    if piece.stays() {
        // A base that is not rotated takes the values of its cells; interpolation would blur it.
        let same = model.grid.basis() == target.basis();
        for (cell, &d) in target.centre.iter().enumerate() {
            let own = if same { cell } else { model.grid.basis().index(Dir::from_unit(d)).unwrap_or(0) };
            // The base is the data minus the lobes; negative values are rounding.
            out.push((cell, base[own].max(0.0)));
        }
        return;
    }
    // For every target cell the direction before the rotation is looked up; rotating the source cells instead would
    // leave gaps between them.
    let back = piece.turn.conjugate();
    for (cell, &d) in target.centre.iter().enumerate() {
        let d = back * d;
        // Directions that come from behind the plane have no data and add nothing.
        if d.z > 0.0 {
            let around = model.grid.around_rings(d);
            let first = |ring| model.grid.basis().first_cell(ring);
            let q: f64 = around.iter().map(|&(ring, k, _, w)| w * base[first(ring) + k]).sum();
            out.push((cell, q.max(0.0)));
        }
    }
}

/// Computes the values of a rotated lobe on the cells that it reaches, not normalised.
fn draw_lobe(model: &Model, piece: &Piece, lobe: usize, (target, points): (&Grid, usize), out: &mut Vec<(usize, f64)>) {
    let own = &model.lobes[piece.vertex][lobe];
    // Exactly the values of the data; the raster below is sampled and interpolated.
    if piece.stays() && model.grid.basis() == target.basis() {
        out.extend(own.cells(&model.grid));
        return;
    }
    let picture = model.rasters[piece.vertex][lobe].turned_by(piece.turn);
    // The radius is enlarged, because the raster fades out over the cells around the lobe.
    target.within(piece.turn * own.centre, own.radius + 0.04, |cell| {
        let q = target.cell_mean(cell, points, |d| picture.at(d));
        if q > 0.0 {
            out.push((cell, q));
        }
    });
}
