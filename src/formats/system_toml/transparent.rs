//! Tables of clear bodies in a system file: panes, laser-cut and prismatic panels, profiles between panes.

use super::checks::{absorption, extent, index, length, outline, share, within, wrong};
use super::keys;
use crate::compute::system::clear::Material;
use crate::compute::system::clear::prism::Prisms;
use crate::compute::system::clear::redirecting::RedirectingGlass;
use crate::compute::system::laser_cut::{CutPanel, LaserCutPanel};
use crate::compute::system::panes::PaneStack;
use crate::compute::system::panes::coated::{self, CoatedPane};
use crate::compute::system::panes::glazing::Pane;
use crate::formats::location::FormatError;

pub(super) fn laser_cut(panel: &keys::LaserCut) -> Result<CutPanel, FormatError> {
    let sheet = Pane {
        // Below √2 light passes through the cuts, and Edmonds' shares do not hold.
        index: within("laser-cut-panel.index", panel.index, (std::f64::consts::SQRT_2, 4.0))?,
        thickness: length("laser-cut-panel.depth", panel.depth)?,
        absorption: absorption("laser-cut-panel.absorption", panel.absorption)?,
    };
    let spacing = length("laser-cut-panel.spacing", panel.spacing)?;
    let cut_loss = share("laser-cut-panel.cut_loss", panel.cut_loss)?;
    Ok(CutPanel { panel: LaserCutPanel { sheet, spacing }, cut_loss })
}

pub(super) fn prismatic(sheet: &keys::Prismatic) -> Result<Prisms, FormatError> {
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

fn material(key: &str, sheet: &keys::Sheet) -> Result<Pane, FormatError> {
    Ok(Pane {
        index: index(&format!("{key}.index"), sheet.index)?,
        thickness: extent(&format!("{key}.thickness"), sheet.thickness)?,
        absorption: absorption(&format!("{key}.absorption"), sheet.absorption)?,
    })
}

pub(super) fn redirecting(glass: &keys::RedirectingGlass) -> Result<RedirectingGlass, FormatError> {
    if glass.bodies.is_empty() {
        return wrong("redirecting-glass.bodies", "no outline", "at least one closed outline");
    }
    let bodies = glass.bodies.iter().map(|body| outline("redirecting-glass.bodies", body, 3));
    let sheet = |key, sheet: &Option<keys::Sheet>| sheet.as_ref().map(|sheet| material(key, sheet)).transpose();
    Ok(RedirectingGlass {
        index: index("redirecting-glass.index", glass.index)?,
        absorption: absorption("redirecting-glass.absorption", glass.absorption)?,
        spacing: length("redirecting-glass.spacing", glass.spacing)?,
        bodies: bodies.collect::<Result<_, _>>()?,
        panes: [sheet("redirecting-glass.outer", &glass.outer)?, sheet("redirecting-glass.inner", &glass.inner)?],
    })
}

pub(super) fn pane(pane: &keys::Pane) -> Result<PaneStack, FormatError> {
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
