//! Transmission of one side of a system, derived from that of the other side by reciprocity.

use crate::compute::basis::AzimuthMap;
use crate::compute::btdf::{Btdf, Scattered, TreeRank, resample_matrix};

/// Returns the transmission for light from the other side, derived from `given` by reciprocity, and a remark on how
/// exact it is. Its cells are numbered as files number them for that side. `to_front`: whether the result is for light
/// from outside. Returns `None` for functions without values between all directions.
pub fn by_reciprocity(given: &Btdf, to_front: bool) -> Option<(Btdf, &'static str)> {
    let map = if to_front { AzimuthMap::KLEMS_FRONT } else { AzimuthMap::KLEMS_BACK };
    let (scattered, how) = match given.scattered.as_ref()? {
        Scattered::Cells(matrix) => {
            let reversed = matrix.reversed();
            let incident = reversed.incident().clone().with_azimuth(map);
            let emergent = reversed.emergent().clone().with_azimuth(map);
            (Scattered::Cells(Box::new(resample_matrix(&reversed, &incident, &emergent))), "exactly")
        }
        Scattered::Tree(tree) => {
            // A tree keeps its axes: they say how its squares stand to the façade, not which side it is for.
            let reversed = tree.reversed();
            let how = match tree.rank() {
                TreeRank::Four => "exactly",
                TreeRank::Three => "with its leaves averaged again, as rank 3 requires",
            };
            (Scattered::Tree(Box::new(reversed)), how)
        }
        Scattered::Lambert(_) | Scattered::Directions(_) => return None,
    };
    Some((Btdf { regular: given.regular.clone(), scattered: Some(scattered) }, how))
}
