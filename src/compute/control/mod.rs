//! Which state a moving system takes: rules over the sun's place before the façade, and a controller that follows
//! them through time.
//!
//! * [`cut_off`]: tilts that let no direct light through, for any section of slats;
//! * [`curve`]: demanded values over the profile angle: tables, and mirror slats that throw back or redirect;
//! * [`states`]: from a demanded value to one of the states that a device has;
//! * [`controller`]: thresholds, hysteresis, dwell time, night.
//!
//! Tilts β and profile angles ψ are in radians; β > 0 lowers the outer edge. Values of states that are no angles keep
//! their own unit. The report's chapter on dynamic systems (§4.2, Figure 14) is the source of the modes.

pub mod controller;
pub mod curve;
pub mod cut_off;
pub mod states;

pub use curve::curve_value;
pub use states::{most_open, towards_closed};
