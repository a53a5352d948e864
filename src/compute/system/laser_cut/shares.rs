//! Laser-cut panels: a transparent sheet with plane cuts, horizontal and normal to its faces, at which light is
//! totally reflected (Edmonds, Solar Energy Materials and Solar Cells 29, 1993).
//!
//! Inside the sheet (thickness D, distance s of the cuts, direction cosines y′ upward and z′ along the normal) a ray
//! climbs t = (D/s)·|y′|/z′ spacings on one passage. Averaged over the point of entry, the share f(t) = 1 − |1 − (t mod
//! 2)| leaves with its vertical component reversed. A path of k passages has f(k t), so light that the faces reflect
//! inside the sheet is followed exactly as well.

use crate::compute::direction::{Dir, Facade};
use crate::compute::system::panes::glazing::{Pane, fresnel};

/// Laser-cut panel with ideal horizontal cuts: its sheet, and the spacing of the cuts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LaserCutPanel {
    /// Sheet of the panel. Total reflection at the cuts for all incidence needs an index ≥ √2.
    pub sheet: Pane,
    /// Vertical distance between cuts. \[m\]
    pub spacing: f64,
}

/// Shares of the incident light of one direction that a laser-cut panel transmits and reflects, undeviated or with the
/// vertical component reversed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PanelShares {
    /// Share transmitted undeviated.
    pub straight: f64,
    /// Share transmitted with the vertical component reversed.
    pub deflected: f64,
    /// Share reflected as by a plane mirror parallel to the panel.
    pub mirrored: f64,
    /// Share reflected with the vertical component reversed.
    pub returned: f64,
}

/// Returns the share of light, 0 … 1, that leaves with its vertical component reversed after it has climbed `t`
/// spacings of ideal cuts.
pub fn deflected_share(t: f64) -> f64 {
    1.0 - (1.0 - t.rem_euclid(2.0)).abs()
}

/// Returns the shares of light that leave with their vertical component kept, and reversed, after climbing `t`
/// spacings; every reflection at a cut loses the share `cut_loss`.
fn after_cuts(t: f64, cut_loss: f64) -> [f64; 2] {
    if cut_loss == 0.0 {
        let turned = deflected_share(t);
        return [1.0 - turned, turned];
    }
    let (whole, part) = (t.floor(), t - t.floor());
    let left = (1.0 - cut_loss).powf(whole);
    let (fewer, more) = (left * (1.0 - part), left * (1.0 - cut_loss) * part);
    if whole.rem_euclid(2.0) == 0.0 { [fewer, more] } else { [more, fewer] }
}

impl LaserCutPanel {
    /// Returns the shares for light from the direction `d` (façade frame, of either side), where every reflection at a
    /// cut loses the share `cut_loss`. A path that climbs t spacings meets ⌊t⌋ cuts, or one more for the share t − ⌊t⌋
    /// of the possible points of entry; an odd number reverses its vertical component.
    pub fn shares(&self, d: Dir<Facade>, cut_loss: f64) -> PanelShares {
        let theta = d.theta();
        let (surface, inner) = fresnel(self.sheet.index, theta);
        let climb = self.sheet.thickness / self.spacing * (d.vector().y / self.sheet.index).abs() / inner;
        let passed = self.sheet.internal(inner);
        let mut shares = PanelShares::default();
        for r in surface {
            shares.mirrored += 0.5 * r;
            let mut inside = 0.5 * (1.0 - r);
            // Odd passages end at the far face, even ones at the near face.
            let mut passage = 1;
            while inside > 1e-12 && passage < 4000 {
                inside *= passed;
                let leaves = inside * (1.0 - r);
                let [kept, turned] = after_cuts(climb * f64::from(passage), cut_loss);
                if passage % 2 == 1 {
                    shares.straight += leaves * kept;
                    shares.deflected += leaves * turned;
                } else {
                    shares.mirrored += leaves * kept;
                    shares.returned += leaves * turned;
                }
                inside *= r;
                passage += 1;
            }
        }
        shares
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    /// D/W = spacing/depth = 0.7, n = 1.5.
    const PANEL: LaserCutPanel =
        LaserCutPanel { sheet: Pane { index: 1.5, thickness: 0.01, absorption: 0.0 }, spacing: 0.007 };

    fn first_passage(x: f64, y: f64) -> f64 {
        let d = Dir::<Facade>::from_unit(DVec3::new(x, y, (1.0 - x * x - y * y).sqrt()));
        let (_, inner) = fresnel(1.5, d.theta());
        deflected_share(0.01 / 0.007 * (y / 1.5) / inner)
    }

    #[test]
    fn shares_after_edmonds() {
        for (x, y, f) in [(0.0, 0.5, 0.50508), (0.0, 0.5_f64.sqrt(), 0.76360), (0.3, 0.5, 0.51684)] {
            assert!((first_passage(x, y) - f).abs() < 1e-5, "{x} {y}: {}", first_passage(x, y));
        }
    }

    /// Follows one ray in the plane section through cells of the panel, passage by passage.
    #[test]
    fn closed_form_is_the_mean_over_traced_entry_points() {
        let t = 1.37; // spacings climbed on a passage
        for passages in 1..=3 {
            let n = 20_000;
            let turned = (0..n)
                .filter(|k| {
                    let end = (f64::from(*k) + 0.5) / f64::from(n) + t * f64::from(passages);
                    (end.floor() as i64) % 2 != 0
                })
                .count();
            let share = turned as f64 / f64::from(n);
            assert!((share - deflected_share(t * f64::from(passages))).abs() < 1e-3, "{passages}");
        }
    }

    #[test]
    fn all_light_is_accounted_for_and_totals_are_the_panes() {
        for k in 0..89 {
            let d = Dir::from_theta_phi(f64::from(k).to_radians(), 1.1);
            let s = PANEL.shares(d, 0.0);
            assert!((s.straight + s.deflected + s.mirrored + s.returned - 1.0).abs() < 1e-9, "{k}");
            let pane = crate::compute::system::panes::glazing::stack(&[PANEL.sheet], d.theta());
            assert!((s.straight + s.deflected - pane.transmitted).abs() < 1e-9);
        }
    }

    #[test]
    fn cuts_that_lose_light() {
        // Small losses take what the number of reflections says: the derivative is the mean number of cuts met, t.
        for t in [0.3, 0.99, 1.0, 1.7, 2.4, 5.5] {
            let (clean, worn) = (after_cuts(t, 0.0), after_cuts(t, 1e-6));
            assert!((clean[0] + clean[1] - 1.0).abs() < 1e-15);
            assert!(((clean[0] + clean[1] - worn[0] - worn[1]) - 1e-6 * t).abs() < 1e-10, "{t}");
            assert!((worn[1] - clean[1]).abs() < 1e-5, "{t}: {worn:?}");
        }
        // Black cuts leave what meets none.
        assert!((after_cuts(0.4, 1.0)[0] - 0.6).abs() < 1e-15 && after_cuts(0.4, 1.0)[1] == 0.0);
        assert!(after_cuts(1.4, 1.0) == [0.0, 0.0]);
    }
}
