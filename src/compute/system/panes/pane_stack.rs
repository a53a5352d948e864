//! Family of glazings that are described as equal panes one behind the other.

use super::coated::Layer;
use super::measure::Panes;
use crate::compute::system::family::{Family, OpticalModelError, PIECE, Polygons, rectangle};
use crate::compute::system::measure::OpticalModel;

/// Glazing of equal panes with air between, without interference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaneStack {
    /// Pane, the same for all positions.
    pub pane: Layer,
    /// Number of panes.
    pub panes: usize,
}

impl PaneStack {
    /// Returns the panes as a list, from outside to inside.
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

    /// Returns the section of a piece of every pane, with the outermost face at depth 0. Panes described by a data
    /// sheet are drawn 4 mm thick, and gaps 16 mm wide.
    fn drawing(&self, _: &str) -> Polygons {
        /// Distance between panes in drawings, usual for insulating glass; descriptions do not state it. \[m\] Chosen:
        /// affects drawings only, no figure.
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
