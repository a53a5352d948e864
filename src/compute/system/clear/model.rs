//! Optical model of clear bodies in section: prismatic sheets, light-redirecting glass.

use super::section::ClearSection;
use super::trace::Emission;
use crate::compute::direction::{Dir, Facade};
use crate::compute::system::measure::Side;
use crate::compute::system::measure::beams::{Beams, Effort, Shares, SharpBeam, SharpBeams};
use std::cell::RefCell;

thread_local! {
    /// Result of a trace, whose buffers are reused by the next one on the same thread.
    static EMISSION: RefCell<Emission> = RefCell::default();
}

impl Beams for ClearSection {
    fn is_quick(&self) -> bool {
        false
    }

    /// Traces the light of direction `direction` (that of undeviated light) from `side`, and adds the beams that leave
    /// to `out`, by their directions of undeviated light.
    fn beams(&self, direction: Dir<Facade>, side: Side, effort: Effort, out: &mut Shares) {
        // Light from outside travels against its through direction, light from inside along it; so do its beams.
        let sign = if side == Side::Front { -1.0 } else { 1.0 };
        out.beams.clear();
        EMISSION.with_borrow_mut(|emission| {
            self.trace(sign * direction.vector(), effort, emission);
            (out.absorbed, out.lost, out.surfaces) = (emission.absorbed, emission.lost, emission.surfaces);
            out.beams.extend(emission.leaving.iter().map(|beam| SharpBeam {
                share: beam.share,
                transmitted: beam.z * sign > 0.0,
                y: sign * beam.y,
                change: beam.change,
            }));
        });
    }
}

impl ClearSection {
    /// Creates the optical model of the section, from which the virtual goniophotometer computes data.
    pub const fn optical_model(self) -> SharpBeams<Self> {
        SharpBeams(self)
    }
}
