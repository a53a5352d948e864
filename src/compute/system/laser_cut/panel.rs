//! Optical model of laser-cut panels: Edmonds' shares, with a loss at the cuts.

use super::shares::LaserCutPanel;
use crate::compute::direction::{Dir, Facade};
use crate::compute::system::family::{Family, OpticalModelError, Polygons, rectangle};
use crate::compute::system::measure::beams::{Beams, Effort, Shares, SharpBeam, SharpBeams};
use crate::compute::system::measure::{OpticalModel, Side};

/// Laser-cut panel whose cuts lose a share of the light that they reflect.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutPanel {
    /// Panel with ideal cuts: its sheet, and the spacing of the cuts.
    pub panel: LaserCutPanel,
    /// Share of the light that is lost at every reflection at a cut (rough cuts scatter it; here it is absorbed).
    pub cut_loss: f64,
}

impl Family for CutPanel {
    fn word(&self) -> &'static str {
        "laser-cut-panel"
    }

    fn method(&self) -> &'static str {
        "Edmonds' shares (Solar Energy Materials and Solar Cells 29, 1993), Fresnel faces"
    }

    fn structure(&self) -> Option<f64> {
        Some(self.panel.spacing)
    }

    /// Returns the section of the piece of the sheet between two cuts, with its outer face at depth 0.
    fn drawing(&self, _: &str) -> Polygons {
        let (depth, height) = (self.panel.sheet.thickness, self.panel.spacing);
        // Cuts are as wide as a laser beam; shown as a fiftieth.
        let cut = 0.01 * height;
        vec![rectangle([-depth, cut], [0.0, height - cut])]
    }

    fn optical_model(&self, _: &str) -> Result<Box<dyn OpticalModel>, OpticalModelError> {
        Ok(Box::new(SharpBeams(*self)))
    }
}

impl Beams for CutPanel {
    fn beams(&self, direction: Dir<Facade>, _: Side, _: Effort, out: &mut Shares) {
        out.beams.clear();
        let shares = self.panel.shares(direction, self.cut_loss);
        let y = direction.vector().y;
        // The panel is the same from both sides; a redirected beam has its vertical component reversed.
        for (share, transmitted, sign) in [
            (shares.straight, true, 1.0),
            (shares.deflected, true, -1.0),
            (shares.mirrored, false, 1.0),
            (shares.returned, false, -1.0),
        ] {
            if share > 0.0 {
                out.beams.push(SharpBeam { share, transmitted, y: sign * y, change: [0.0, sign] });
            }
        }
        out.lost = 0.0;
        out.absorbed = 1.0 - shares.straight - shares.deflected - shares.mirrored - shares.returned;
    }

    fn fewest_parts(&self) -> usize {
        // A closed form costs little, and the shares have kinks.
        16
    }
}
