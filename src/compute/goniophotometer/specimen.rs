//! From a description to what can be measured.

use super::Specimen;
use super::beams::SharpBeams;
use super::panes::Panes;
use super::sheet::{Sheet, Spread};
use super::upright::Upright;
use crate::compute::dielectric::{Body, Material, Outline, Section};
use crate::compute::section::SlatArray;
use crate::compute::system::description::{Diffuser, SystemDescription, SystemKind, state_key};

/// Why a description makes no specimen: what is wrong and what would be right.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct NoSpecimen(pub String);

/// The specimen of one state of a system that needs no other files.
///
/// # Errors
/// A state that is not there, geometry that encloses nothing; a stack, whose layers only its caller can find.
pub fn specimen(system: &SystemDescription, state: &str) -> Result<Box<dyn Specimen>, NoSpecimen> {
    let told = |error: &dyn std::fmt::Display| NoSpecimen(format!("{}: {error}", system.kind.word()));
    let made: Box<dyn Specimen> = match &system.kind {
        SystemKind::Venetian(blind) => {
            let angle =
                blind.angles.iter().find(|angle| state_key(**angle) == state).ok_or_else(|| no_state(system))?;
            let (profile, sides) = (blind.profile.clone(), [blind.upper, blind.lower]);
            let array = SlatArray::new(profile, blind.thickness, blind.spacing, *angle, sides);
            Box::new(array.map_err(|error| told(&error))?)
        }
        _ if !state.is_empty() => return Err(no_state(system)),
        SystemKind::LaserCutPanel(panel) => Box::new(SharpBeams(*panel)),
        SystemKind::Prismatic(sheet) => Box::new(sheet.section().map_err(|error| told(&error))?.specimen()),
        SystemKind::RedirectingGlass(glass) => {
            let material = Material { index: glass.index, absorption: glass.absorption };
            let body = |outline: &Vec<[f64; 2]>| Body { outline: Outline::Closed(outline.clone()), material };
            let section = Section::new(glass.spacing, glass.bodies.iter().map(body).collect(), glass.panes);
            Box::new(section.map_err(|error| told(&error))?.specimen())
        }
        SystemKind::Pane(stack) => Box::new(Panes::equal(stack.pane, stack.panes)),
        SystemKind::Diffuser(sheet) => {
            let out_of_range = || told(&"values that no passive sheet has");
            Box::new(diffuser(sheet).ok_or_else(out_of_range)?)
        }
        SystemKind::Woven(fabric) => Box::new(fabric.sheet()),
        SystemKind::Perforated(sheet) => Box::new(*sheet),
        SystemKind::Stack(_) => return Err(told(&"its layers are to be found first")),
    };
    Ok(if system.upright { Box::new(Upright(made)) } else { made })
}

fn no_state(system: &SystemDescription) -> NoSpecimen {
    let states: Vec<String> = system.states().iter().map(|key| format!("\"{key}\"")).collect();
    NoSpecimen(format!("no such state; its states are {}", states.join(", ")))
}

/// `None` for values that no passive sheet has.
fn diffuser(sheet: &Diffuser) -> Option<Sheet> {
    match sheet {
        Diffuser::Lambertian { transmittance, reflectance } => Some(Sheet {
            transmission: Spread::lambertian(*transmittance),
            reflection: [Spread::lambertian(*reflectance), Spread::lambertian(*reflectance)],
        }),
        Diffuser::Opal(opal) => opal.sheet(),
        Diffuser::Spreading(sheet) => sheet.sheet(),
    }
}
