//! Sky, sun and surroundings: luminance as a function of the direction in the world's frame.
//!
//! | file | contents |
//! | --- | --- |
//! | `distribution` | relative luminance of every model |
//! | `cie`, `perez`, `scan` | parameters of the models |
//! | `horizontal` | illuminance of the horizontal plane by a relative luminance, which scales a sky |
//! | `availability`, `clear_sky` | typical illuminances by the sun's altitude |
//! | `patches` | Tregenza's 145 patches of the dome |
//! | `outside` | a scaled sky over ground, behind a skyline |
//! | `region` | regions of the sphere, cut by horizon and skyline |
//! | `integral`, `scan_region` | integrals over regions, smooth and measured skies |
//! | `prospect`, `opening` | obstructions in front of sky and ground: seen from a point, through an opening |
//! | `on_dome` | regions swept by the bearing: skylines and measured skies behind obstructions |
//! | `scenery` | obstructions and ground: bodies and their surfaces |
//! | `faces`, `vista`, `received`, `open_ground`, `equations` | light on these surfaces |
//! | `prepared`, `dome`, `sunlit` | light on surfaces under many skies and suns |
//! | `ground_shade` | shade of the sun on the ground, for pictures |
//! | `incident` | illuminance of an aperture from every cell of a basis |
//! | `samples` | illuminance of an aperture from every cell under smooth skies, by fixed directions |
//! | `sun` | the sun's disc |
//!
//! Direct sun is never part of an [`Outside`]; it is a [`Sun`].

pub mod availability;
pub mod cie;
pub mod clear_sky;
mod distribution;
mod dome;
mod equations;
pub mod faces;
mod gradated;
mod ground_shade;
mod horizontal;
mod incident;
mod integral;
mod on_dome;
mod open_cells;
mod open_ground;
mod opening;
mod outside;
pub mod patches;
pub mod perez;
mod prepared;
mod prospect;
mod received;
mod region;
mod samples;
mod scan;
mod scan_region;
mod scenery;
mod sun;
pub mod sun_disc;
mod sunlit;
mod vista;

pub use distribution::Distribution;
pub use equations::{Counts, SparseSum};
pub use ground_shade::GroundShade;
pub use incident::{incident_illuminances, incident_illuminances_within};
pub use integral::{irradiance, mean_luminance};
pub use opening::irradiance_through;
pub use outside::{Outside, SkyError};
pub use prepared::Prepared;
pub use region::Frame;
pub use samples::SkySamples;
pub use scan::Scan;
pub use scenery::{Finish, Setting};
pub use sun::{SUN_HALF_ANGLE, Sun};
pub use vista::with_ground_behind_skyline;
