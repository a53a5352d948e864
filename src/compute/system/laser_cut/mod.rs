//! Laser-cut panels: transparent sheets whose parallel cuts redirect light by total reflection.

mod panel;
mod shares;

pub use panel::CutPanel;
pub use shares::{LaserCutPanel, PanelShares, deflected_share};
