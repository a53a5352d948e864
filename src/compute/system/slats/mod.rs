//! Endless arrays of slats in section: venetian blinds, louvres, redirecting profiles, matt, mirroring or both.
//!
//! For endless slats the direction cosine along them has no effect: scattering depends on the profile angle ψ =
//! atan2(y, z) only, and mirrors keep that direction cosine. So the section, a plane problem, is solved once per
//! profile angle, and cells are averages over ψ (`profile_weights`).
//!
//! | part | method | error |
//! | --- | --- | --- |
//! | direct share | closed form max(0, 1 − extent/(s cosψ)), integrated over cells with its kinks known | 1e-8 |
//! | first light on slats, exchange | bundles of lines of every ψ that meet the same strips (`sweep`) | ψ linear
//! between steps |
//! | matt faces | radiosity on strips, extrapolated from two divisions (`balance`) | stated |
//! | ideal mirrors | every bundle continues as rays at its ends and middle (`chain`) | seen in the energy balance |
//! | mirrors that spread light | rays drawn by equidistributed numbers, made reciprocal (`reciprocal`) | stated |
//!
//! A mirror's spread σ gives a lobe about the ideal mirror's direction that is the product of two: one in the section,
//! one in the direction cosine x along the slats. In the section the sine u of the angle to the face's normal is the
//! height of a point on the unit sphere; a step there in any direction, its components normal with σ, turns u into u′
//! with a density that is symmetric for du, since heights of uniform points are uniform (Archimedes). Along the slats a
//! step on the sphere of four dimensions does the same for the measure √(1 − x²) dx of x (`along`). Projected solid
//! angle is du √(1 − x²) dx, so that the lobe is reciprocal and keeps all energy at any σ, grazing light included, and
//! light that has become diffuse stays so. Rays draw the steps; `reciprocal` removes their scatter from sums and
//! symmetry.

mod along;
mod arc;
mod array;
mod balance;
mod chain;
mod deposit;
mod direct;

mod flows;
mod measure;
mod model;
mod outline;
mod profile;
mod profile_shares;
mod profile_weights;
mod reciprocal;
mod rough;
mod sweep;
mod transport;
mod venetian;

pub use array::{SlatArray, SlatError, Surface};
pub use model::SlatModel;
pub use profile::{SlatProfile, arc};
pub use profile_shares::ProfileShares;
pub use venetian::Venetian;
