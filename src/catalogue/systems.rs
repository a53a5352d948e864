//! The descriptions that come with the program: files under `assets/systems`.

use crate::compute::system::SystemKind;
use crate::compute::system::slats::Venetian;
use crate::compute::system::stack::LayerSource;
use crate::formats::system_toml::{self, EACH_STATE, SystemFile};

/// Name and text of the descriptions with the given names.
macro_rules! described {
    ($($name:literal,)*) => {
        &[$((
            concat!($name, ".system.toml"),
            include_str!(concat!("../../assets/systems/", $name, ".system.toml")),
        ),)*]
    };
}

/// File name and text of every built-in description, in the order of the catalogue.
pub const SYSTEMS: &[(&str, &str)] = described![
    "venetian-80-72",
    "bronze-single",
    "clear-double",
    "clear-single",
    "clear-triple",
    "electrochromic-clear",
    "electrochromic-dark",
    "electrochromic-light",
    "electrochromic-medium",
    "green-single",
    "grey-single",
    "low-e-pane",
    "low-iron-single",
    "reflective-single",
    "solar-control-pane",
    "acrylic-diffuser-clear",
    "acrylic-diffuser-haze",
    "laminated-white-translucent",
    "membrane-glass-fibre",
    "multiwall-polycarbonate-clear",
    "multiwall-polycarbonate-opal",
    "opal-dense",
    "opal-light",
    "patterned-glass",
    "roller-blind-beige",
    "roller-blind-white",
    "sandblasted-glass",
    "satinated-glass",
    "translucent-insulation-aerogel",
    "translucent-insulation-fleece",
    "screen-charcoal-1",
    "screen-charcoal-10",
    "screen-charcoal-3",
    "screen-grey-3",
    "screen-grey-5",
    "screen-white-10",
    "screen-white-3",
    "laser-cut-panel-050",
    "laser-cut-panel-100",
    "laser-cut-panel-150",
    "laser-cut-panel",
    "exterior-60-50-silver",
    "exterior-80-72-anthracite",
    "exterior-80-72-silver",
    "exterior-80-72-white",
    "exterior-z-90-75",
    "fixed-louvre-150-45",
    "interior-25-21-silver",
    "interior-25-21-white",
    "interior-50-42-white",
    "louvre-200-wood",
    "louvre-300-aluminium",
    "louvre-400-mirror",
    "micro-16-12-silver",
    "micro-louvre-17",
    "mirror-80-72-convex",
    "redirecting-50-42-mirror",
    "redirecting-80-72-mirror",
    "retro-stepped-45-36",
    "retro-v-60-50",
    "vertical-blind-127",
    "vertical-louvre-400",
    "vertical-louvre-terracotta",
    "wood-50-43",
    "prismatic-42-5-outside",
    "prismatic-42-5",
    "prismatic-45-45-outside",
    "prismatic-45-45",
    "prismatic-63-27",
    "prismatic-film-40-90",
    "egg-crate-facade",
    "egg-crate-white",
    "expanded-metal-fine",
    "expanded-metal-medium",
    "perforated-round-33",
    "perforated-round-51",
    "perforated-square-44",
    "double-integral-micro-blind",
    "double-laser-cut-panel",
    "low-e-double-exterior-blind",
    "low-e-double-exterior-screen",
    "low-e-double-interior-blind",
    "low-e-double-interior-screen",
    "low-e-double-opal",
    "low-e-double-redirecting-blind",
    "low-e-double",
    "low-e-triple",
    "solar-control-double",
];

/// A built-in description by the name of its file.
///
/// # Panics
/// Never: the tests read every built-in description.
pub fn builtin_system(name: &str) -> Option<(SystemFile, &'static str)> {
    let (_, text) = SYSTEMS.iter().find(|(file, _)| *file == name)?;
    Some((system_toml::read(text.as_bytes()).expect("built-in descriptions are read by the tests"), text))
}

/// The slats of a description, also of a moving layer of a built-in stack.
pub fn blind_of(system: &str) -> Option<Venetian> {
    match system_toml::read(system.as_bytes()).ok()?.system.kind {
        SystemKind::Venetian(blind) => Some(blind),
        SystemKind::Stack(layers) => {
            let moving = layers.into_iter().find(|layer| layer.state == EACH_STATE)?;
            match moving.source {
                LayerSource::File(name) => builtin_system(&name).and_then(|(_, text)| blind_of(text)),
                LayerSource::Catalogue(_) => None,
            }
        }
        _ => None,
    }
}
