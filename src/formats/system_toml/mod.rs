//! System files (`.system.toml`): geometry and material of a system, for the numerical goniophotometer.
//!
//! Keys, defaults and ranges; every wrong value is told by its key and by what would be right.

mod keys;

use super::location::{FormatError, Location, excerpt};
use crate::compute::dielectric::Material;
use crate::compute::dielectric::prism::Prisms;
use crate::compute::goniophotometer::panels::CutPanel;
use crate::compute::section::Surface;
use crate::compute::system::coated::{self, CoatedPane};
use crate::compute::system::description::{
    Diffuser, Hole, Layer, LayerSource, PaneStack, Perforated, RedirectingGlass, SystemDescription, SystemKind,
    Venetian, Woven,
};
use crate::compute::system::diffuser::{Opal, Spreading};
use crate::compute::system::glazing::Pane;
use crate::compute::system::laser_cut::LaserCutPanel;
use crate::compute::system::slat_profile::SlatProfile;
use keys::{Angles, DiffuserModel, HoleShape, Keys, Kind, Pair};

/// Most bytes of a system file.
const MOST_BYTES: usize = 1 << 20;
/// Most states of a family.
const MOST_STATES: usize = 361;
/// Most points of an outline.
const MOST_POINTS: usize = 2000;
/// Word of a layer's state that stands for all states of the layer.
pub const EACH_STATE: &str = "each";

/// A system file: the system, and what it tells the catalogue.
#[derive(Debug, Clone, PartialEq)]
pub struct SystemFile {
    /// The system.
    pub system: SystemDescription,
    /// Key for the catalogue; empty: made from the name.
    pub key: String,
    /// Words to find it by.
    pub tags: Vec<String>,
    /// Word of the rule that makes its control curve; empty: none.
    pub control: String,
}

/// Does the name say that a file is a system file?
pub fn is_system_file(name: &str) -> bool {
    name.to_ascii_lowercase().ends_with(".system.toml")
}

/// Reads a system file.
///
/// # Errors
/// Bytes that are no TOML, keys that are missing, unknown or out of range.
pub fn read(bytes: &[u8]) -> Result<SystemFile, FormatError> {
    if bytes.len() > MOST_BYTES {
        return Err(FormatError::new(Location::file(), format!("{} bytes", bytes.len()), "at most 1 MB of TOML"));
    }
    let text = std::str::from_utf8(bytes)
        .map_err(|error| FormatError::new(Location::byte(error.valid_up_to()), "bytes that are no UTF-8", "text"))?;
    let keys: Keys = toml::from_str(text).map_err(|error| {
        let before = &text[..error.span().map_or(0, |span| span.start.min(text.len()))];
        let line = before.matches('\n').count() + 1;
        let message = error.message();
        match message.split_once(", expected ") {
            Some((found, expected)) => FormatError::new(Location::line(line), found, expected),
            None => FormatError::new(Location::line(line), message, "the keys of a system file, as TOML"),
        }
    })?;
    let kind = kind(&keys)?;
    let catalogue = keys.catalogue;
    if catalogue.key.chars().any(|c| !(c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')) {
        return wrong("catalogue.key", excerpt(&catalogue.key), "lower-case letters, digits and hyphens");
    }
    Ok(SystemFile {
        system: SystemDescription { name: keys.name, description: keys.description, kind, upright: keys.upright },
        key: catalogue.key,
        tags: catalogue.tags,
        control: catalogue.control,
    })
}

fn wrong<T>(key: &str, found: impl Into<String>, expected: impl Into<String>) -> Result<T, FormatError> {
    Err(FormatError::new(Location::file().in_element(key), found, expected))
}

/// The value if it lies in a range; the error names both.
fn within(key: &str, value: f64, (low, high): (f64, f64)) -> Result<f64, FormatError> {
    if (low..=high).contains(&value) { Ok(value) } else { wrong(key, format!("{value}"), format!("{low} to {high}")) }
}

/// A length above 0, at most a kilometre.
fn length(key: &str, value: f64) -> Result<f64, FormatError> {
    if value > 0.0 && value <= 1000.0 {
        Ok(value)
    } else {
        wrong(key, format!("{value}"), "metres, above 0, at most 1000")
    }
}

/// A length of 0 or more.
fn extent(key: &str, value: f64) -> Result<f64, FormatError> {
    if value == 0.0 { Ok(0.0) } else { length(key, value) }
}

fn share(key: &str, value: f64) -> Result<f64, FormatError> {
    within(key, value, (0.0, 1.0))
}

fn index(key: &str, value: f64) -> Result<f64, FormatError> {
    within(key, value, (1.0, 4.0))
}

fn absorption(key: &str, value: f64) -> Result<f64, FormatError> {
    within(key, value, (0.0, 1e6))
}

fn kind(keys: &Keys) -> Result<SystemKind, FormatError> {
    let tables = [
        (Kind::Venetian, keys.venetian.is_some()),
        (Kind::LaserCutPanel, keys.laser_cut_panel.is_some()),
        (Kind::Prismatic, keys.prismatic.is_some()),
        (Kind::RedirectingGlass, keys.redirecting_glass.is_some()),
        (Kind::Pane, keys.pane.is_some()),
        (Kind::Diffuser, keys.diffuser.is_some()),
        (Kind::Woven, keys.woven.is_some()),
        (Kind::Perforated, keys.perforated.is_some()),
        (Kind::Stack, keys.stack.is_some()),
    ];
    if let Some((other, _)) = tables.iter().find(|(kind, there)| *there && *kind != keys.kind) {
        let expected = format!("the table [{}] alone, or kind = \"{}\"", keys.kind.word(), other.word());
        return wrong(other.word(), format!("a table of another kind than \"{}\"", keys.kind.word()), expected);
    }
    let none = || {
        let word = keys.kind.word();
        FormatError::new(Location::file(), format!("kind = \"{word}\" without its table"), format!("a table [{word}]"))
    };
    Ok(match keys.kind {
        Kind::Venetian => SystemKind::Venetian(venetian(keys.venetian.as_ref().ok_or_else(none)?)?),
        Kind::LaserCutPanel => {
            let panel = keys.laser_cut_panel.as_ref().ok_or_else(none)?;
            let sheet = Pane {
                // Below √2 light passes through the cuts, and Edmonds' shares do not hold.
                index: within("laser-cut-panel.index", panel.index, (std::f64::consts::SQRT_2, 4.0))?,
                thickness: length("laser-cut-panel.depth", panel.depth)?,
                absorption: absorption("laser-cut-panel.absorption", panel.absorption)?,
            };
            let spacing = length("laser-cut-panel.spacing", panel.spacing)?;
            SystemKind::LaserCutPanel(CutPanel {
                panel: LaserCutPanel { sheet, spacing },
                cut_loss: share("laser-cut-panel.cut_loss", panel.cut_loss)?,
            })
        }
        Kind::Prismatic => SystemKind::Prismatic(prismatic(keys.prismatic.as_ref().ok_or_else(none)?)?),
        Kind::RedirectingGlass => {
            SystemKind::RedirectingGlass(redirecting(keys.redirecting_glass.as_ref().ok_or_else(none)?)?)
        }
        Kind::Pane => SystemKind::Pane(pane(keys.pane.as_ref().ok_or_else(none)?)?),
        Kind::Diffuser => SystemKind::Diffuser(diffuser(keys.diffuser.as_ref().ok_or_else(none)?)?),
        Kind::Woven => {
            let fabric = keys.woven.as_ref().ok_or_else(none)?;
            let face = share("woven.reflectance", fabric.reflectance)?;
            let inner = share("woven.reflectance_back", fabric.reflectance_back.unwrap_or(face))?;
            let transmittance = within("woven.transmittance", fabric.transmittance, (0.0, 1.0 - face.max(inner)))?;
            SystemKind::Woven(Woven {
                openness: within("woven.openness", fabric.openness, (0.0, 0.95))?,
                reflectance: [face, inner],
                transmittance,
            })
        }
        Kind::Perforated => SystemKind::Perforated(perforated(keys.perforated.as_ref().ok_or_else(none)?)?),
        Kind::Stack => SystemKind::Stack(stack(keys.stack.as_ref().ok_or_else(none)?)?),
    })
}

fn face(key: &str, face: keys::Face) -> Result<Surface, FormatError> {
    let diffuse = share(&format!("{key}.reflectance"), face.reflectance)?;
    let mirror = share(&format!("{key}.specular"), face.specular)?;
    if diffuse + mirror > 1.0 + 1e-12 {
        return wrong(key, format!("reflectance + specular = {}", diffuse + mirror), "at most 1 together");
    }
    let spread = within(&format!("{key}.roughness"), face.roughness, (0.0, 45.0))?.to_radians();
    Ok(Surface { diffuse, mirror, spread })
}

fn outline(key: &str, points: &[Pair], fewest: usize) -> Result<Vec<[f64; 2]>, FormatError> {
    let points: Vec<[f64; 2]> = points.iter().map(|point| point.0).collect();
    if points.len() < fewest || points.len() > MOST_POINTS {
        return wrong(key, format!("{} points", points.len()), format!("{fewest} to {MOST_POINTS}"));
    }
    match points.iter().find(|point| !point.iter().all(|c| c.abs() <= 1000.0)) {
        Some(point) => wrong(key, format!("the point {point:?}"), "metres"),
        None => Ok(points),
    }
}

fn venetian(blind: &keys::Venetian) -> Result<Venetian, FormatError> {
    let profile = match &blind.profile {
        Some(points) => {
            let points = outline("venetian.profile", points, 2)?;
            if blind.rise != 0.0 || blind.width != 0.0 {
                let stated = if blind.rise == 0.0 { "width" } else { "rise" };
                return wrong("venetian", format!("profile and {stated}"), "either the profile, or width and rise");
            }
            SlatProfile::Polyline(points)
        }
        None => {
            let width = length("venetian.width", blind.width)?;
            SlatProfile::curved(width, within("venetian.rise", blind.rise, (-0.5 * width, 0.5 * width))?)
        }
    };
    let spacing = length("venetian.spacing", blind.spacing)?;
    let degrees = match &blind.angles {
        Angles::Listed(list) => list.clone(),
        Angles::Steps(keys::Steps { from, to, step }) => {
            let steps = (to - from) / step;
            if !(*step > 0.0 && steps >= 0.0 && steps < MOST_STATES as f64) {
                return wrong(
                    "venetian.angles",
                    format!("from {from} to {to} in steps of {step}"),
                    format!("from ≤ to, a step above 0 and at most {MOST_STATES} states"),
                );
            }
            (0..=(steps + 1e-9).floor() as usize).map(|k| from + step * k as f64).collect()
        }
    };
    if degrees.is_empty() || degrees.len() > MOST_STATES {
        return wrong("venetian.angles", format!("{} angles", degrees.len()), format!("1 to {MOST_STATES}"));
    }
    for (k, &angle) in degrees.iter().enumerate() {
        within("venetian.angles", angle, (-90.0, 90.0))?;
        if degrees[..k].contains(&angle) {
            return wrong("venetian.angles", format!("{angle} twice"), "every angle once");
        }
    }
    Ok(Venetian {
        profile,
        spacing,
        thickness: within("venetian.thickness", blind.thickness, (0.0, spacing))?,
        angles: degrees.into_iter().map(f64::to_radians).collect(),
        upper: face("venetian.upper", blind.upper)?,
        lower: face("venetian.lower", blind.lower)?,
    })
}

fn prismatic(sheet: &keys::Prismatic) -> Result<Prisms, FormatError> {
    let [upper, lower] = sheet.angles.0;
    for angle in [upper, lower] {
        within("prismatic.angles", angle, (0.1, 90.0))?;
    }
    if upper > 89.9 && lower > 89.9 {
        return wrong("prismatic.angles", "two flanks normal to the sheet", "at most one of 90°");
    }
    let (pitch, base) = (length("prismatic.pitch", sheet.pitch)?, length("prismatic.base", sheet.base)?);
    // Beyond that, the prisms are lost in the rounding of the section.
    if base > 1000.0 * pitch {
        return wrong("prismatic.base", format!("{base}"), format!("at most 1000 pitches, {} m", 1000.0 * pitch));
    }
    Ok(Prisms {
        material: Material {
            index: index("prismatic.index", sheet.index)?,
            absorption: absorption("prismatic.absorption", sheet.absorption)?,
        },
        angles: [upper.to_radians(), lower.to_radians()],
        pitch,
        base,
        flipped: sheet.flipped,
    })
}

fn material(key: &str, sheet: keys::Sheet) -> Result<Pane, FormatError> {
    Ok(Pane {
        index: index(&format!("{key}.index"), sheet.index)?,
        thickness: extent(&format!("{key}.thickness"), sheet.thickness)?,
        absorption: absorption(&format!("{key}.absorption"), sheet.absorption)?,
    })
}

fn redirecting(glass: &keys::RedirectingGlass) -> Result<RedirectingGlass, FormatError> {
    if glass.bodies.is_empty() {
        return wrong("redirecting-glass.bodies", "no outline", "at least one closed outline");
    }
    let bodies = glass.bodies.iter().map(|body| outline("redirecting-glass.bodies", body, 3));
    let sheet = |key, sheet: Option<keys::Sheet>| sheet.map(|sheet| material(key, sheet)).transpose();
    Ok(RedirectingGlass {
        index: index("redirecting-glass.index", glass.index)?,
        absorption: absorption("redirecting-glass.absorption", glass.absorption)?,
        spacing: length("redirecting-glass.spacing", glass.spacing)?,
        bodies: bodies.collect::<Result<_, _>>()?,
        panes: [sheet("redirecting-glass.outer", glass.outer)?, sheet("redirecting-glass.inner", glass.inner)?],
    })
}

fn pane(pane: &keys::Pane) -> Result<PaneStack, FormatError> {
    let n = index("pane.index", pane.index)?;
    let thickness = extent("pane.thickness", pane.thickness)?;
    if pane.reflectance_normal_back.is_some() && pane.reflectance_normal.is_none() {
        return wrong("pane.reflectance_normal_back", "no reflectance_normal beside it", "both, or neither");
    }
    let glazing = match (pane.absorption, pane.transmittance_normal, pane.reflectance_normal) {
        (Some(_), Some(_), _) => {
            return wrong("pane", "absorption and transmittance_normal", "one of the two");
        }
        (None, None, _) => return wrong("pane", "neither absorption nor transmittance_normal", "one of the two"),
        (Some(_), None, Some(_)) => {
            return wrong(
                "pane.reflectance_normal",
                "a reflectance beside absorption",
                "transmittance_normal beside it",
            );
        }
        (Some(a), None, None) => {
            coated::Layer::Clear(Pane { index: n, thickness, absorption: absorption("pane.absorption", a)? })
        }
        (None, Some(tau), None) => {
            // A sheet without thickness has no coefficient of absorption; a metre stands in for it.
            let deep = if thickness > 0.0 { thickness } else { 1.0 };
            match Pane::with_normal_transmittance(n, deep, tau) {
                Some(pane) => coated::Layer::Clear(pane),
                None => {
                    let expected = "above 0 and at most what a clear pane of this index lets through, or \
                                    reflectance_normal of a coated pane beside it";
                    return wrong("pane.transmittance_normal", format!("{tau}"), expected);
                }
            }
        }
        (None, Some(tau), Some(front)) => {
            let transmittance = share("pane.transmittance_normal", tau)?;
            let most = (0.0, 1.0 - transmittance);
            let front = within("pane.reflectance_normal", front, most)?;
            let back = within("pane.reflectance_normal_back", pane.reflectance_normal_back.unwrap_or(front), most)?;
            coated::Layer::Coated(CoatedPane { transmittance, front, back })
        }
    };
    if !(1..=10).contains(&pane.panes) {
        return wrong("pane.panes", format!("{}", pane.panes), "1 to 10");
    }
    Ok(PaneStack { pane: glazing, panes: pane.panes })
}

fn diffuser(sheet: &keys::Diffuser) -> Result<Diffuser, FormatError> {
    let transmittance = share("diffuser.transmittance", sheet.transmittance)?;
    let asked = |key: &str, value: Option<f64>| match value {
        Some(value) => Ok(value),
        None => wrong(&format!("diffuser.{key}"), "no value", format!("a number for the model {:?}", sheet.model)),
    };
    let refused = |model: &str, list: &[(&str, Option<f64>)]| match list.iter().find(|(_, value)| value.is_some()) {
        Some((key, _)) => {
            wrong(&format!("diffuser.{key}"), format!("a key that the model {model} does not use"), "no such key")
        }
        None => Ok(()),
    };
    let lobe =
        [("regular", sheet.regular), ("lobe", sheet.lobe), ("spread", sheet.spread), ("absorbed", sheet.absorbed)];
    match sheet.model {
        DiffuserModel::Lambertian => {
            refused("lambertian", &lobe)?;
            refused("lambertian", &[("index", sheet.index)])?;
            let reflectance = asked("reflectance", sheet.reflectance)?;
            let reflectance = within("diffuser.reflectance", reflectance, (0.0, 1.0 - transmittance))?;
            Ok(Diffuser::Lambertian { transmittance, reflectance })
        }
        DiffuserModel::Opal => {
            refused("opal", &lobe)?;
            let opal = Opal {
                index: index("diffuser.index", asked("index", sheet.index)?)?,
                transmittance,
                reflectance: share("diffuser.reflectance", asked("reflectance", sheet.reflectance)?)?,
            };
            if opal.shares().is_none() {
                let enters = "together at most what the surface lets in (0.961 for an index of 1.49)";
                return wrong("diffuser.transmittance", "transmittance and reflectance too large", enters);
            }
            Ok(Diffuser::Opal(opal))
        }
        DiffuserModel::Spreading => {
            refused("spreading", &[("reflectance", sheet.reflectance)])?;
            let sheet = Spreading {
                index: index("diffuser.index", asked("index", sheet.index)?)?,
                regular: share("diffuser.regular", sheet.regular.unwrap_or(0.0))?,
                lobe: share("diffuser.lobe", asked("lobe", sheet.lobe)?)?,
                spread: within("diffuser.spread", asked("spread", sheet.spread)?, (0.6, 60.0))?.to_radians(),
                transmittance,
                absorbed: share("diffuser.absorbed", sheet.absorbed.unwrap_or(0.0))?,
            };
            if sheet.scale().is_none() {
                let expected = "regular + lobe at most 1, and a transmittance that the clear sheet has";
                return wrong("diffuser", "shares that do not fit together", expected);
            }
            Ok(Diffuser::Spreading(sheet))
        }
    }
}

fn perforated(sheet: &keys::Perforated) -> Result<Perforated, FormatError> {
    let width = length("perforated.width", sheet.width)?;
    let [right, up] = sheet.pitch.0;
    length("perforated.pitch", right)?;
    length("perforated.pitch", up)?;
    // A staggered pattern has a second hole in the middle of every cell.
    let area = right * up * if sheet.staggered { 0.5 } else { 1.0 };
    let height = match sheet.hole {
        HoleShape::Round => match sheet.height {
            Some(_) => return wrong("perforated.height", "a height of a round hole", "width (the diameter) alone"),
            None => width,
        },
        HoleShape::Rectangle | HoleShape::Rhombus => length("perforated.height", sheet.height.unwrap_or(width))?,
    };
    let (hole, open) = match sheet.hole {
        HoleShape::Round => (Hole::Round { diameter: width }, 0.25 * std::f64::consts::PI * width * width),
        HoleShape::Rectangle => (Hole::Rectangle { width, height }, width * height),
        HoleShape::Rhombus => (Hole::Rhombus { width, height }, 0.5 * width * height),
    };
    let meet = |[dx, dy]: [f64; 2]| match sheet.hole {
        HoleShape::Round => dx.hypot(dy) < width,
        HoleShape::Rectangle => dx < width && dy < height,
        HoleShape::Rhombus => dx / width + dy / height < 1.0,
    };
    let diagonal = sheet.staggered.then_some([0.5 * right, 0.5 * up]);
    if [[right, 0.0], [0.0, up]].into_iter().chain(diagonal).any(meet) {
        return wrong("perforated.width", format!("{width} m: holes that run into each other"), "holes apart");
    }
    if open >= area {
        return wrong("perforated.pitch", format!("an open share of {:.3}", open / area), "holes that leave a sheet");
    }
    let outer = share("perforated.reflectance", sheet.reflectance)?;
    Ok(Perforated {
        hole,
        area,
        thickness: length("perforated.thickness", sheet.thickness)?,
        rise: within("perforated.rise", sheet.rise, (-1000.0, 1000.0))?,
        reflectance: [
            outer,
            share("perforated.reflectance_back", sheet.reflectance_back.unwrap_or(outer))?,
            share("perforated.reflectance_wall", sheet.reflectance_wall.unwrap_or(outer))?,
        ],
    })
}

fn stack(stack: &keys::Stack) -> Result<Vec<Layer>, FormatError> {
    if !(1..=10).contains(&stack.layers.len()) {
        return wrong("stack.layers", format!("{} layers", stack.layers.len()), "1 to 10, outside first");
    }
    if stack.layers.iter().filter(|layer| layer.state == EACH_STATE).count() > 1 {
        return wrong("stack.layers", "state = \"each\" in several layers", "one moving layer at most");
    }
    let layer = |(k, layer): (usize, &keys::Layer)| {
        let source = match (&layer.file, &layer.catalogue) {
            (Some(file), None) => LayerSource::File(file.clone()),
            (None, Some(key)) => LayerSource::Catalogue(key.clone()),
            _ => return wrong(&format!("stack.layers[{k}]"), "not one of file and catalogue", "file or catalogue"),
        };
        Ok(Layer { source, state: layer.state.clone() })
    };
    stack.layers.iter().enumerate().map(layer).collect()
}

#[cfg(test)]
mod tests;
