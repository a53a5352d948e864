//! Uncertainty of sunlight through a tensor tree: data are constant within a leaf of the tree, and may differ
//! completely in the next one.

use super::{Emission, Facing};
use crate::compute::btdf::TensorTree;
use crate::compute::direction::{Dir, Incident};
use glam::DVec3;
use std::f64::consts::PI;

/// Returns the displacement of the sun for the estimate: the angular distance of neighbouring finest incident cells.
/// \[rad\]
fn spacing(tree: &TensorTree) -> f64 {
    (PI / (tree.incident_resolution() * tree.incident_resolution()) as f64).sqrt()
}

impl Emission {
    /// Adds the uncertainties of the luminance by sunlight through a tensor tree: half of the larger change when the
    /// sun is displaced by one finest incident cell to either side, along both axes of the façade frame.
    pub fn estimate_leaf_uncertainty(&mut self, tree: &TensorTree, facing: &Facing<'_>) {
        let illuminance = self.incident_sun;
        let (Some(sun), Some(light)) = (facing.sun_entering(), self.cells.first_mut()) else { return };
        if illuminance <= 0.0 {
            return;
        }
        let step = spacing(tree);
        for axis in [DVec3::X, DVec3::Y] {
            let [before, after] = [-step, step].map(|by| {
                // A neighbour behind the aperture's plane is moved to the plane.
                let moved = sun.vector() + by * axis;
                let moved = Dir::new(moved.with_z(moved.z.max(1e-3))).unwrap_or(sun);
                tree.sun_luminance(Incident(moved), illuminance).1
            });
            let own = &light.sun;
            let triples = own.iter().zip(before.iter().zip(&after));
            // The larger of both changes, with its sign.
            let change =
                |(own, (a, b)): (&f64, (&f64, &f64))| if (a - own).abs() > (b - own).abs() { a - own } else { b - own };
            light.uncertainties.push(triples.map(change).map(|change| 0.5 * change).collect());
        }
        self.notes.push(
            "sun: the leaf of the tree that holds it; sun patches cannot be placed better than its directions are wide"
                .to_owned(),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::angle::Bearing;
    use crate::compute::btdf::{Btdf, Scattered, TreeAxes, TreeRank, TreeShape, tree_on};
    use crate::compute::direction::{Orientation, Surface};
    use crate::compute::sky::{Distribution, Outside, Sun};

    #[test]
    fn a_diffuser_is_in_no_doubt_and_a_pane_is() {
        let outside = Outside::new(Distribution::uniform(), 0.0).unwrap();
        let sun = Sun { direction: Dir::from_altitude_bearing(0.5, Bearing::from_degrees(170.0)), direct_normal: 5e4 };
        let facing = Facing {
            outside: &outside,
            sun: Some(&sun),
            orientation: Orientation::new(Bearing::from_degrees(180.0)),
            surface: Surface::Facade,
        };
        let doubt = |btdf: &Btdf| {
            let shape = TreeShape { rank: TreeRank::Four, level: 4, tolerance: 0.0 };
            let made = tree_on(btdf, TreeAxes::Front, shape).unwrap();
            let tree = made.tree;
            let whole = Btdf { regular: None, scattered: Some(Scattered::Tree(Box::new(tree.clone()))) };
            let mut emission = Emission::new(&whole, &facing);
            emission.estimate_leaf_uncertainty(&tree, &facing);
            let light = &emission.cells[0];
            let most = light.sun.iter().copied().fold(0.0, f64::max);
            light.uncertainties.iter().flatten().map(|d| d.abs()).fold(0.0, f64::max) / most
        };
        assert!(doubt(&Btdf::ideal_diffuse(0.5)) < 0.02);
        assert!(doubt(&Btdf::ideal_transparent(0.8)) > 0.3);
    }
}
