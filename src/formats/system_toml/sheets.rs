//! Tables of thin sheets in a system file: fabrics, diffusers, perforated and expanded metal.

use super::checks::{index, length, share, within, wrong};
use super::keys::{self, DiffuserModel, HoleShape};
use crate::compute::system::sheets::diffuser::{Opal, Spreading};
use crate::compute::system::sheets::{Diffuser, Hole, Perforated, Woven};
use crate::formats::location::FormatError;

pub(super) fn diffuser(sheet: &keys::Diffuser) -> Result<Diffuser, FormatError> {
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

pub(super) fn woven(fabric: &keys::Woven) -> Result<Woven, FormatError> {
    let face = share("woven.reflectance", fabric.reflectance)?;
    let inner = share("woven.reflectance_back", fabric.reflectance_back.unwrap_or(face))?;
    let transmittance = within("woven.transmittance", fabric.transmittance, (0.0, 1.0 - face.max(inner)))?;
    let openness = within("woven.openness", fabric.openness, (0.0, 0.95))?;
    Ok(Woven { openness, reflectance: [face, inner], transmittance })
}

pub(super) fn perforated(sheet: &keys::Perforated) -> Result<Perforated, FormatError> {
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
