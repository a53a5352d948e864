//! Glare of an observer in closed form: the daylight glare probability DGP (Wienold & Christoffersen 2006, Energy and
//! Buildings 38) with sources that are computed instead of found in a picture.
//!
//! | file | content |
//! | --- | --- |
//! | `gaze` | an eye: its picture, the position index |
//! | `field` | apertures as seen by an eye, cut into patches |
//! | `luminance` | luminances of the patches by the light that the apertures emit |
//! | `discs` | beams that reach the eye as discs of the sun |
//! | `sources` | glare sources, grouped |
//! | `probability` | DGP of illuminance and sources, DGPs |
//! | `evaluate` | glare of one observer, with its error |
//!
//! Sources are found as Radiance's `evalglare` (3.0x) finds them in a fisheye picture: all light above a threshold,
//! parts within 5.7° of each other as one, peaks above 50,000 cd/m² separately. Walls and patches of sun on them are
//! not sources: their light counts by the illuminance at the eye. Eyes have no blind spots: all in front of the plane
//! of the eye is seen.

mod discs;
mod evaluate;
mod field;
mod gaze;
mod luminance;
mod probability;
mod sources;

pub use discs::{Disc, Ray, discs};
pub use evaluate::{Glare, Threshold, View, glare};
pub use field::{Field, Patch};
pub use gaze::{Gaze, position_index};
pub use luminance::{add_emitted, add_seen_through};
pub use probability::{LEAST_ILLUMINANCE, dgp, dgps, is_proven};
pub use sources::{Kind, PEAK, REACH, Source, Sources};
