//! Symmetries of the visible transmission, beyond the one that its kind of data implies.

use super::at::At;
use super::blocks::{Blocks, Turn};
use super::diagnosis::Diagnosis;
use super::repair::BandScope;
use crate::compute::btdf::{Component, Finding, Scattered, TreeRank};

/// Relative difference of a function from its image below which asymmetry counts as measurement or sampling noise.
/// Chosen: affects wording only.
const NOISE: f64 = 0.05;

/// Returns a finding that states the symmetries, and a warning where a rank-3 tree's data contradict its declared
/// symmetry.
pub(super) fn check(at: &At, blocks: &Blocks) -> Vec<Diagnosis> {
    if at.scope != BandScope::Visible {
        return Vec::new();
    }
    let Some((component, block)) = Component::ALL.into_iter().find_map(|c| Some((c, blocks.get(c)?))) else {
        return Vec::new();
    };
    if blocks.hemispherical(block) == 0.0 {
        return Vec::new();
    }
    let of = |turn| blocks.asymmetry(block, turn);
    let (up, left, half, quarter) =
        (of(Turn::UpDown), of(Turn::LeftRight), of(Turn::HalfRound), of(Turn::QuarterRound));
    let found = match (up < NOISE, left < NOISE) {
        (true, true) if quarter < NOISE => "rotationally symmetric",
        (true, true) => "symmetric left to right and above to below",
        (false, true) => "symmetric left to right",
        (true, false) => "symmetric above to below",
        (false, false) if half < NOISE => "symmetric under a turn by 180° only",
        (false, false) => "without symmetry",
    };
    let message = format!(
        "{} is {found} (differences: left–right {:.1} %, above–below {:.1} %, quarter turn {:.1} %).",
        component.words(),
        100.0 * left,
        100.0 * up,
        100.0 * quarter
    );
    let mut list = vec![Finding::info("symmetry", message).into()];
    let declared = at.band.get(component).and_then(|btdf| btdf.scattered.as_ref());
    if let Some(Scattered::Tree(tree)) = declared
        && tree.rank() == TreeRank::Three
        && blocks.get(Component::TransmissionFront).zip(blocks.get(Component::TransmissionBack)).is_some()
        && super::reciprocity::of(at).is_some_and(|error| error > 0.2)
    {
        list.push(
            Finding::warning(
                "symmetry-declared",
                "The tree has rank 3, which declares rotational symmetry, but its two transmissions do not fit each other: \
                 the system is probably not rotationally symmetric and its azimuths are averaged away.",
            )
            .into(),
        );
    }
    list
}
