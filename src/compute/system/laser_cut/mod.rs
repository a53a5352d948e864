//! Laser-cut panels.

mod panel;
mod shares;

pub use panel::CutPanel;
pub use shares::{LaserCutPanel, PanelShares, deflected_share};
