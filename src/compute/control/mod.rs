//! Shading control of systems with several states: rules over the sun's position in front of the façade, and a
//! controller that follows them through time.
//!
//! * [`cut_off`]: tilts that let no direct light through, for any section of slats;
//! * [`curve`]: demanded values over the profile angle: tables, and mirror slats that retro-reflect or redirect;
//! * [`states`]: choice of a device's state from a demanded value;
//! * [`controller`]: thresholds, hysteresis, dwell time, night.
//!
//! Tilts β and profile angles ψ are in radians; β > 0 lowers the outer edge. Values of states that are not angles keep
//! their own unit. The report's chapter on dynamic systems (§4.2, Figure 14) is the source of the modes.

pub mod controller;
pub mod curve;
pub mod cut_off;
pub mod states;

pub use curve::curve_value;
pub use states::{most_open, towards_closed};
