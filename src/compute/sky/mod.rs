//! Sky, sun and what else is outside: luminance as a function of the direction in the world's frame.
//!
//! | file | what |
//! | --- | --- |
//! | `distribution` | relative luminance of every model |
//! | `cie`, `perez`, `scan` | their parameters |
//! | `horizontal` | the exact illuminance of the horizontal plane, which scales a sky |
//! | `availability`, `clear_sky` | illuminances that belong to an altitude of the sun |
//! | `patches` | Tregenza's 145 patches of the dome |
//! | `outside` | a scaled sky over ground, behind a skyline |
//! | `region` | regions of the sphere and how horizon and skyline cut them |
//! | `integral`, `scan_region` | integrals over regions, smooth and measured skies |
//! | `prospect`, `opening` | what stands before sky and ground: seen from a point, through an opening |
//! | `on_dome` | regions swept by the bearing: skylines and measured skies behind what stands before them |
//! | `scenery` | what stands there, and the ground: bodies and their surfaces |
//! | `faces`, `vista`, `received`, `open_ground`, `equations` | the light on these |
//! | `prepared`, `dome`, `sunlit` | light on surfaces under many skies and suns |
//! | `ground_shade` | the sun's shade on the ground, for pictures |
//! | `incident` | illuminance of an aperture per cell of a basis |
//! | `samples` | the same for smooth skies by fixed directions |
//! | `sun` | the disc |
//!
//! The direct beam is never part of an [`Outside`]; it is a [`Sun`].

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
