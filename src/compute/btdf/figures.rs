//! Figures for searching and sorting states of systems besides transmittances: share of the transmitted skylight that
//! leaves upwards to the ceiling, share of a high sun that is blocked, share of light that is transmitted undeviated.
//!
//! All of them hold for a vertical façade and for light from outside.

use super::{Btdf, Indicatrix, Scattered};
use crate::compute::basis::{Cell, RingBasis};
use crate::compute::direction::{Dir, Facade, Incident};
use glam::DVec3;
use std::collections::HashMap;
use std::f64::consts::PI;

/// Numbers of rings and sectors of incident directions, of equal projected solid angle, for sums over the upper
/// quarter-sphere. Chosen: about four directions per Klems patch. Held by
/// `tests/catalogue/builtin.rs`, which compares computed figures with those of the table, like all constants of these figures.
const SKY: [usize; 2] = [12, 24];
/// Number of points across a cell that the horizon divides. Chosen: cost; even, so that a cell centred on the horizon
/// is halved exactly.
const ACROSS: usize = 16;
/// Transmittance below which no share of upward light is stated. Chosen: affects reporting only.
const DARK: f64 = 1e-6;
/// Angle of incidence of the high sun. \[rad\] Definition of [`LightFigures::sun_blocked`]: 45°.
const HIGH_SUN: f64 = 0.25 * PI;
/// Ratio of q in the cell of undeviated light to that of its surroundings above which it counts as a peak. Source:
/// Radiance's `aBSDF`.
const STANDS_OUT: f64 = 1.5;
/// Minimum width of the surroundings of the cell of undeviated light. \[rad\] Chosen: about two diameters of the sun
/// (0.53° each); only cells of fine trees are narrower.
const AROUND: f64 = 0.02;

/// Figures of the transmission of light from outside by one state of a system, for a vertical façade.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LightFigures {
    /// Share of the transmitted light that leaves upwards into the room, 0 … 1, for light from a uniform sky (all
    /// directions above the horizontal); `None` if nothing is transmitted.
    pub to_ceiling: Option<f64>,
    /// Share of direct sun that is not transmitted, for the sun at 45° altitude, perpendicular to the façade in plan: 1
    /// − τ.
    pub sun_blocked: f64,
    /// Normal–normal (direct-direct) transmittance: share of light at normal incidence that is transmitted undeviated.
    /// For patch-averaged data: the regular transmission if they have one, plus the excess of the cell of undeviated
    /// light over its surroundings.
    pub view: f64,
}

impl LightFigures {
    /// Computes the figures from the transmission of light from outside.
    pub fn of(btdf: &Btdf) -> Self {
        let sun = Incident(Dir::from_theta_phi(HIGH_SUN, 0.5 * PI));
        Self {
            to_ceiling: to_ceiling(btdf),
            sun_blocked: (1.0 - btdf.tau(sun)).clamp(0.0, 1.0),
            view: view(btdf).clamp(0.0, 1.0),
        }
    }
}

/// Computes [`LightFigures::to_ceiling`].
fn to_ceiling(btdf: &Btdf) -> Option<f64> {
    let mut upward = Upward::default();
    let (mut up, mut all) = (0.0, 0.0);
    for ring in 0..SKY[0] {
        let theta = ((ring as f64 + 0.5) / SKY[0] as f64).sqrt().asin();
        for sector in 0..SKY[1] {
            let phi = PI * (sector as f64 + 0.5) / SKY[1] as f64;
            let incident = Incident(Dir::from_theta_phi(theta, phi));
            // Undeviated light from above the horizon propagates downwards.
            all += btdf.regular.as_ref().map_or(0.0, |tau| tau.at(theta));
            let [some, whole] = upward.flux(btdf, incident);
            up += some;
            all += whole;
        }
    }
    (all > DARK * (SKY[0] * SKY[1]) as f64).then(|| (up / all).clamp(0.0, 1.0))
}

/// Computation of the upward flux for incident directions, with quantities that are reused from one direction to the
/// next.
#[derive(Default)]
struct Upward {
    basis: Option<RingBasis>,
    /// Projected solid angle of the part of each cell whose light leaves upwards, and of the whole cell. \[sr\]
    weights: Vec<[f64; 2]>,
    /// Cached flux of rows of tabulated data.
    fluxes: HashMap<usize, [f64; 2]>,
}

impl Upward {
    /// Returns the upward and the total scattered light for an incident direction, as shares of the incident flux.
    fn flux(&mut self, btdf: &Btdf, incident: Incident) -> [f64; 2] {
        let row = match &btdf.scattered {
            Some(Scattered::Cells(matrix)) => matrix.incident().index(incident.0),
            Some(Scattered::Directions(data)) => data.standing_for(incident.0),
            _ => None,
        };
        if let Some(flux) = row.and_then(|row| self.fluxes.get(&row)) {
            return *flux;
        }
        let flux = btdf.indicatrix(incident).map_or([0.0; 2], |indicatrix| self.sum(&indicatrix));
        self.fluxes.extend(row.map(|row| (row, flux)));
        flux
    }

    fn sum(&mut self, indicatrix: &Indicatrix) -> [f64; 2] {
        if self.basis.as_ref() != Some(&indicatrix.basis) {
            self.weights = weights(&indicatrix.basis);
            self.basis = Some(indicatrix.basis.clone());
        }
        let add = |sum: [f64; 2], (q, weight): (&f64, &[f64; 2])| [sum[0] + q * weight[0], sum[1] + q * weight[1]];
        indicatrix.q.iter().zip(&self.weights).fold([0.0; 2], add)
    }
}

/// Returns for every emergent cell the part of its projected solid angle in which light propagates upwards, and the
/// whole. \[sr\]
fn weights(basis: &RingBasis) -> Vec<[f64; 2]> {
    let of = |cell: Cell| {
        let whole = cell.projected_solid_angle();
        // Emergent cells hold directions of undeviated light, opposite to the propagation: below the horizon, light
        // goes up.
        let upward = |j: &usize| (cell.phi + cell.width * ((*j as f64 + 0.5) / ACROSS as f64 - 0.5)).sin() < 0.0;
        let [first, last] = [upward(&0), upward(&(ACROSS - 1))];
        // In less than half a turn the sine changes its sign once at most.
        let count = match first == last && cell.width < PI {
            true if first => ACROSS,
            true => 0,
            false => (0..ACROSS).filter(upward).count(),
        };
        [whole * count as f64 / ACROSS as f64, whole]
    };
    basis.cells().map(of).collect()
}

/// Computes [`LightFigures::view`].
fn view(btdf: &Btdf) -> f64 {
    let normal: Dir<Facade> = Dir::from_unit(DVec3::Z);
    let regular = btdf.regular.as_ref().map_or(0.0, |tau| tau.at(0.0));
    let Some(indicatrix) = btdf.indicatrix(Incident(normal)) else { return regular };
    let Some(straight) = indicatrix.basis.index(normal) else { return regular };
    let own = indicatrix.basis.cell(straight);
    // Around it lies a ring as wide as itself, one row of cells at least.
    let reach = own.theta_max + (own.theta_max - own.theta_min).max(AROUND);
    let mean = |holds: &dyn Fn(&Cell) -> bool| {
        let chosen = indicatrix.basis.cells().zip(&indicatrix.q).filter(|(cell, _)| holds(cell));
        let add = |[flux, weight]: [f64; 2], (cell, q): (Cell, &f64)| {
            [flux + q * cell.projected_solid_angle(), weight + cell.projected_solid_angle()]
        };
        let [flux, weight] = chosen.fold([0.0; 2], add);
        [if weight > 0.0 { flux / weight } else { 0.0 }, weight]
    };
    // All sectors of the innermost ring hold the normal.
    let [q, weight] = mean(&|cell| cell.theta_min == own.theta_min);
    let [surroundings, around] = mean(&|cell| cell.theta_min > own.theta_min && cell.theta_min < reach);
    // Without light around it, the cell has no neighbours to exceed: the system counts as a diffuser.
    let beam = around > 0.0 && q > STANDS_OUT * surroundings;
    regular + if beam { (q - surroundings) * weight } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::basis::AzimuthMap;
    use crate::compute::btdf::CellMatrix;

    /// Every incident cell sends its light to the one emergent cell that `place` says, all of it.
    fn sending(place: impl Fn(DVec3) -> DVec3) -> Btdf {
        let basis = RingBasis::klems_full(AzimuthMap::KLEMS_FRONT);
        let n = basis.len();
        let mut values = vec![0.0; n * n];
        for (i, cell) in basis.cells().enumerate() {
            let to = basis.index(Dir::from_unit(place(cell.centre().vector()))).unwrap();
            values[i * n + to] = 1.0 / basis.cell(to).projected_solid_angle();
        }
        Btdf::from_cells(CellMatrix::new(basis.clone(), basis, values).unwrap())
    }

    #[test]
    fn a_diffuser_sends_half_up_a_clear_opening_nothing_and_a_mirror_of_heights_all() {
        let half = LightFigures::of(&Btdf::ideal_diffuse(0.6));
        assert!((half.to_ceiling.unwrap() - 0.5).abs() < 1e-9 && (half.sun_blocked - 0.4).abs() < 1e-9);
        assert!(half.view.abs() < 1e-9);
        let clear = LightFigures::of(&Btdf::ideal_transparent(0.9));
        assert_eq!((clear.to_ceiling, clear.view), (Some(0.0), 0.9));
        assert!((clear.sun_blocked - 0.1).abs() < 1e-12);
        // Cells on the horizon hold light of both sides, so not quite all.
        let flipped = LightFigures::of(&sending(|name| DVec3::new(name.x, -name.y, name.z)));
        assert!(flipped.to_ceiling.unwrap() > 0.85, "{flipped:?}");
        let straight = LightFigures::of(&sending(|name| name));
        assert!(straight.to_ceiling.unwrap() < 0.15 && (straight.view - 1.0).abs() < 1e-9, "{straight:?}");
    }

    #[test]
    fn nothing_transmitted_has_no_direction() {
        let dark = LightFigures::of(&Btdf::ideal_diffuse(0.0));
        assert_eq!(dark, LightFigures { to_ceiling: None, sun_blocked: 1.0, view: 0.0 });
    }
}
