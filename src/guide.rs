//! The guide: one page per task, each with examples that the tests run.
//!
//! | page | for whoever wants to |
//! | --- | --- |
//! | [`window`] | find, look at, compare and export systems in the window |
//! | [`scenes`] | compute the daylight that a system brings into a room |
//! | [`datasets`] | check, repair, convert and compute BSDF data, and keep them in the catalogue |
//! | [`weather`] | simulate a year instead of one sky |
//! | [`control`] | let a blind move |
//! | [`ranking`] | find the product that suits a façade |
//! | [`files`] | read files of other programs and write files for them |
//! | [`exactness`] | know how far the figures can be trusted |
//!
//! Commands run in a folder that holds the project's `examples` and `assets/systems`.

pub mod control {
    #![doc = include_str!("../assets/guide/control.md")]
}
pub mod datasets {
    #![doc = include_str!("../assets/guide/datasets.md")]
}
pub mod exactness {
    #![doc = include_str!("../assets/guide/exactness.md")]
}
pub mod files {
    #![doc = include_str!("../assets/guide/files.md")]
}
pub mod ranking {
    #![doc = include_str!("../assets/guide/ranking.md")]
}
pub mod scenes {
    #![doc = include_str!("../assets/guide/scenes.md")]
}
pub mod weather {
    #![doc = include_str!("../assets/guide/weather.md")]
}
pub mod window {
    #![doc = include_str!("../assets/guide/window.md")]
}
