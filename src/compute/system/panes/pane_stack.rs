//! Glazing as described: equal panes one behind the other.

use super::coated::Layer;
use super::measure::Panes;
use crate::compute::system::family::{Family, OpticalModelError, PIECE, Polygons, rectangle};
use crate::compute::system::measure::OpticalModel;

/// Equal panes with air between; interference left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaneStack {
    /// Pane of the stack.
    pub pane: Layer,
    /// Number of panes.
    pub panes: usize,
}

impl PaneStack {
    /// Returns the panes one by one.
    pub fn layers(&self) -> Vec<Layer> {
        vec![self.pane; self.panes]
    }
}

impl Family for PaneStack {
    fn word(&self) -> &'static str {
        "pane"
    }

    fn method(&self) -> &'static str {
        "Fresnel and Bouguer-Lambert through the stack, coated panes by the angular fits of WINDOW 4, no interference"
    }

    /// Returns a piece of every pane, the panes of a data sheet 4 mm thick, 16 mm between them; the outermost face at
    /// depth 0.
    fn drawing(&self, _: &str) -> Polygons {
        /// Distance between panes as drawn, usual for insulating glass; the description has none. \[m\] Chosen: affects
        /// drawings only, no figure.
        const GAP: f64 = 0.016;
        let thickness = match self.pane {
            Layer::Clear(pane) if pane.thickness > 0.0 => pane.thickness,
            _ => 0.004,
        };
        let outer = |k: usize| -(k as f64) * (thickness + GAP);
        (0..self.panes).map(|k| rectangle([outer(k) - thickness, 0.0], [outer(k), PIECE])).collect()
    }

    fn optical_model(&self, _: &str) -> Result<Box<dyn OpticalModel>, OpticalModelError> {
        Ok(Box::new(Panes::equal(self.pane, self.panes)))
    }
}
