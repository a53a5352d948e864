//! Comparison of candidates of a scene: their figures with errors, and which candidate is better in each figure.
//!
//! A candidate is the scene with another product, state, sky or room ([`candidate()`]). [`Facts`] are its computed
//! results, [`FIGURES`] the figures that follow from them, and [`compare`] lists the figures of several candidates.
//! Window and command line show the same [`Row`]s.

mod candidate;
pub mod curves;
pub mod difference;
mod figures;
pub mod scales;
mod table;

pub use candidate::{candidate, label, same_question};
pub use figures::{DataFacts, FIGURES, Facts, Figure, LidFacts, Sense, Value};
pub use table::{Row, Verdict, compare, csv, judge, verdict_words};

use super::error::StudyError;
use super::subject::Subject;
use super::{Scene, Session};
use crate::compute::estimate::Progress;
use crate::compute::lid::c_gamma::Peaks;

/// Maximum number of candidates in a comparison.
pub const MOST: usize = 6;

/// Returns the results for the comparison from a scene of which everything has been computed.
pub fn facts_of(subject: &Subject) -> Facts {
    Facts {
        data: DataFacts::of(subject.dataset()),
        lid: subject.lid.as_ref().map(|(lid, peaks)| LidFacts { flux: lid.flux, peaks: Some(*peaks) }),
        room: subject.room.as_ref().map(|room| room.sensors.iter().map(|sensor| sensor.total()).collect()),
    }
}

/// Computes the results for the comparison of one candidate: BSDF figures and light of its first aperture, and
/// illuminances in the room.
///
/// # Errors
/// Returns the errors of [`Session::room`].
pub fn facts(scene: &Scene, session: &Session, progress: &dyn Progress) -> Result<Facts, StudyError> {
    let data = scene.apertures.first().and_then(|one| DataFacts::of(&one.system.dataset));
    let lid = session.lid(scene, 0, progress)?;
    let room = session.room(scene, progress)?;
    Ok(Facts {
        data,
        lid: Some(LidFacts { flux: lid.flux, peaks: Some(Peaks::of(&lid.lid, progress)?) }),
        room: Some(room.sensors.iter().map(|sensor| sensor.total()).collect()),
    })
}
