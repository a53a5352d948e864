//! Obstructions that the window can add to a scene (overhang, fin, reveal, balcony, neighbour), with sizes derived from
//! the first aperture.

use crate::compute::estimate::Estimate;
use crate::study::outside::MOST_BOXES;
use crate::study::scene_file::{
    ApertureKeys, BoxKeys, BuildingKeys, OutsideKeys, SceneFile, SurfaceKey, USUAL_REFLECTANCE,
};
use crate::texts::{Text, scene as texts};

/// Effects of obstructions: the scene, and for every box and the building the relative effect on the illuminance of its
/// apertures (`None` if it is dark), or the reason why they cannot be computed.
pub type ObstructionEffects = (SceneFile, Result<Option<Vec<Estimate>>, String>);

/// Kind of obstruction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Horizontal slab above the aperture.
    Overhang,
    /// Vertical slab beside the aperture.
    Fin,
    /// Reveal: four sides round the aperture, which is set back between them.
    Reveal,
    /// Balcony: slab at floor level in front of the façade, with a parapet.
    Balcony,
    /// Neighbouring building across the street.
    Neighbour,
}

impl Kind {
    /// All kinds, nearest first.
    pub const ALL: [Self; 5] = [Self::Overhang, Self::Fin, Self::Reveal, Self::Balcony, Self::Neighbour];

    /// Returns the label of the kind of obstruction.
    pub const fn word(self) -> Text {
        match self {
            Self::Overhang => texts::OVERHANG,
            Self::Fin => texts::FIN,
            Self::Reveal => texts::REVEAL,
            Self::Balcony => texts::BALCONY,
            Self::Neighbour => texts::NEIGHBOUR,
        }
    }

    /// Returns the label of the command that adds an obstruction of this kind.
    pub const fn order(self) -> Text {
        match self {
            Self::Overhang => texts::ADD_OVERHANG,
            Self::Fin => texts::ADD_FIN,
            Self::Reveal => texts::ADD_REVEAL,
            Self::Balcony => texts::ADD_BALCONY,
            Self::Neighbour => texts::ADD_NEIGHBOUR,
        }
    }
}

/// Command about the boxes of obstructions, each a separate undo step. Boxes are numbered from 0; `None` means the last
/// one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Act {
    /// Add an obstruction.
    Add(Kind),
    /// Duplicate a box, with the copy beside it.
    Duplicate(Option<usize>),
    /// Remove a box.
    Remove(Option<usize>),
}

/// Reason why a command about obstructions was not executed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refused {
    /// No box to duplicate or remove.
    NothingThere,
    /// Maximum number of boxes in a scene exceeded.
    TooMany,
}

impl Refused {
    /// Returns the reason as a sentence.
    pub fn words(self) -> String {
        match self {
            Self::NothingThere => texts::NOTHING_OUTSIDE.into(),
            Self::TooMany => texts::too_many_boxes(MOST_BOXES),
        }
    }
}

/// Gap between an obstruction and the aperture's edge. \[m\]
const GAP: f64 = 0.1;
/// Thickness of slabs, fins and parapets. \[m\]
const THICK: f64 = 0.15;
/// Length by which an overhang or a balcony extends beyond the aperture's sides. \[m\]
const BEYOND: f64 = 0.5;

/// Returns a length rounded to the millimetre, so that the displayed value is the one in use. \[m\]
pub fn exact(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0 + 0.0
}

/// Returns the rectangle of the façade from which sizes of obstructions are derived, as from and to along x and z: that
/// of its first aperture, or else the whole wall. \[m\]
fn window(scene: &SceneFile) -> [[f64; 2]; 2] {
    let first = scene.aperture.iter().find(|one| one.surface == SurfaceKey::Facade);
    first.map_or([[0.0, scene.room.width], [0.0, scene.room.height]], sides)
}

fn sides(aperture: &ApertureKeys) -> [[f64; 2]; 2] {
    [0, 1].map(|k| [aperture.origin[k], aperture.origin[k] + aperture.size[k]])
}

fn solid(x: [f64; 2], y: [f64; 2], z: [f64; 2]) -> BoxKeys {
    let end = |k: usize| [x[k], y[k], z[k]].map(exact);
    BoxKeys { from: end(0), to: end(1), turn: 0.0 }
}

/// Returns the boxes of an obstruction of one kind for a scene, each with its name.
fn boxes(kind: Kind, scene: &SceneFile) -> Vec<(Text, BoxKeys)> {
    let [[left, right], [sill, head]] = window(scene);
    let wide = [left - BEYOND, right + BEYOND];
    let centre = 0.5 * (left + right);
    let solids = match kind {
        Kind::Overhang => vec![solid(wide, [-1.0, 0.0], [head + GAP, head + GAP + THICK])],
        Kind::Fin => vec![solid([right + GAP, right + GAP + THICK], [-0.6, 0.0], [sill, head])],
        Kind::Reveal => return reveal(scene),
        Kind::Balcony => vec![solid(wide, [-1.5, 0.0], [-0.2, 0.0]), solid(wide, [-1.5, -1.5 + THICK], [0.0, 1.0])],
        Kind::Neighbour => vec![solid([centre - 8.0, centre + 8.0], [-25.0, -15.0], [0.0, 10.0])],
    };
    let names = [kind.word(), if kind == Kind::Balcony { texts::PARAPET } else { kind.word() }];
    names.into_iter().zip(solids).collect()
}

/// Returns the four boxes of a reveal round the first aperture, in façade or roof.
fn reveal(scene: &SceneFile) -> Vec<(Text, BoxKeys)> {
    const DEEP: f64 = 0.25;
    let first = scene.aperture.first();
    let [[left, right], [low, high]] = first.map_or_else(|| window(scene), sides);
    let (xs, ups) = ([left - THICK, left, right, right + THICK], [low - THICK, low, high, high + THICK]);
    let names = [texts::REVEAL_LEFT, texts::REVEAL_RIGHT, texts::REVEAL_LOW, texts::REVEAL_HIGH];
    let across = [[xs[0], xs[1]], [xs[2], xs[3]], [xs[0], xs[3]], [xs[0], xs[3]]];
    let along = [[ups[1], ups[2]], [ups[1], ups[2]], [ups[0], ups[1]], [ups[2], ups[3]]];
    let roof = first.is_some_and(|one| one.surface == SurfaceKey::Roof);
    let top = scene.room.height;
    let place = |(x, up)| if roof { solid(x, up, [top, top + DEEP]) } else { solid(x, [-DEEP, 0.0], up) };
    names.into_iter().zip(across.into_iter().zip(along).map(place)).collect()
}

/// Returns another box of a kind beside an existing one: overhangs higher, fins further to the left, others further to
/// the right.
fn beside(kind: Kind, solid: &BoxKeys, scene: &SceneFile) -> BoxKeys {
    let [[left, _], _] = window(scene);
    let size = [0, 1, 2].map(|k| solid.to[k] - solid.from[k]);
    match kind {
        Kind::Overhang => moved(solid, 2, 0.5),
        // The other side of the window first.
        Kind::Fin if solid.from[0] >= left => moved(solid, 0, left - GAP - THICK - solid.from[0]),
        Kind::Fin => moved(solid, 0, -0.5),
        _ => moved(solid, 0, size[0] + 1.0),
    }
}

/// Returns the building round the room: flush with the façade or roof that has apertures, down to the ground.
pub fn building(scene: &SceneFile) -> BuildingKeys {
    /// Length by which the building extends beyond the room at the sides, behind and above. \[m\]
    const ON: f64 = 6.0;
    let room = &scene.room;
    let on_roof = scene.aperture.iter().any(|one| one.surface == SurfaceKey::Roof);
    let above = if on_roof { 0.0 } else { 0.5 * ON };
    BuildingKeys {
        from: [-ON, 0.0, scene.site.ground_height.min(0.0)],
        to: [room.width + ON, room.depth + ON, room.height + above].map(exact),
        reflectance: USUAL_REFLECTANCE,
    }
}

/// Returns a box moved along an axis (0 x, 1 y, 2 z) by the distance `way`. \[m\]
pub fn moved(solid: &BoxKeys, axis: usize, way: f64) -> BoxKeys {
    let mut new = *solid;
    new.from[axis] = exact(new.from[axis] + way);
    new.to[axis] = exact(new.to[axis] + way);
    new
}

/// Returns the name of a box, or its number if it has none.
pub fn name(number: usize, keys: &OutsideKeys) -> String {
    if keys.name.trim().is_empty() { texts::box_number(number + 1) } else { keys.name.trim().to_owned() }
}

/// Applies a command to the boxes of obstructions of a scene.
///
/// # Errors
/// Returns [`Refused`] if nothing was done; the scene is then unchanged.
pub fn act(scene: &mut SceneFile, act: Act) -> Result<(), Refused> {
    let last = scene.outside.len().checked_sub(1);
    let there = |number: Option<usize>| {
        number.or(last).filter(|number| *number < scene.outside.len()).ok_or(Refused::NothingThere)
    };
    let room = |more: usize| if scene.outside.len() + more > MOST_BOXES { Err(Refused::TooMany) } else { Ok(()) };
    match act {
        Act::Add(kind) => {
            let mut new = boxes(kind, scene);
            room(new.len())?;
            while new.iter().any(|(_, solid)| scene.outside.iter().any(|old| old.solid == *solid)) {
                new.iter_mut().for_each(|(_, solid)| *solid = beside(kind, solid, scene));
            }
            let keys = |(name, solid): (Text, BoxKeys)| OutsideKeys {
                name: name.into(),
                solid,
                reflectance: Some(USUAL_REFLECTANCE),
                luminance: None,
            };
            scene.outside.extend(new.into_iter().map(keys));
        }
        Act::Duplicate(number) => {
            let number = there(number)?;
            room(1)?;
            let old = &scene.outside[number];
            // Beside it, and away from the room where it stands on its left.
            let way = old.solid.to[0] - old.solid.from[0] + 0.5;
            let solid = moved(&old.solid, 0, if old.solid.to[0] <= 0.0 { -way } else { way });
            let new = OutsideKeys { solid, ..old.clone() };
            scene.outside.insert(number + 1, new);
        }
        Act::Remove(number) => {
            let number = there(number)?;
            scene.outside.remove(number);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::room::mesh::BoxRoom;
    use crate::study::example::first_scene;
    use crate::study::outside;
    use glam::DVec3;

    fn room(scene: &SceneFile) -> BoxRoom {
        let size = DVec3::new(scene.room.width, scene.room.depth, scene.room.height);
        BoxRoom { size, floor: 0.2, walls: 0.5, ceiling: 0.7 }
    }

    #[test]
    fn whatever_is_added_stands_outside_the_room_and_apart_from_its_like() {
        for roof in [false, true] {
            let mut scene = first_scene();
            if roof {
                scene.aperture[0].surface = SurfaceKey::Roof;
            }
            for kind in Kind::ALL {
                for _ in 0..4 {
                    act(&mut scene, Act::Add(kind)).unwrap();
                }
            }
            assert_eq!(scene.outside.len(), 4 * (1 + 1 + 4 + 2 + 1));
            outside::boxes(&scene, &room(&scene)).unwrap();
            for (number, one) in scene.outside.iter().enumerate() {
                assert!(!scene.outside[..number].iter().any(|other| other.solid == one.solid), "{one:?}");
            }
        }
    }

    #[test]
    fn sizes_go_with_the_first_window() {
        let mut scene = first_scene();
        let window = scene.aperture[0].clone();
        act(&mut scene, Act::Add(Kind::Overhang)).unwrap();
        act(&mut scene, Act::Add(Kind::Fin)).unwrap();
        act(&mut scene, Act::Add(Kind::Fin)).unwrap();
        let [overhang, right, left] = [0, 1, 2].map(|k| scene.outside[k].solid);
        let head = window.origin[1] + window.size[1];
        assert!(overhang.from[2] >= head && overhang.to[1] == 0.0 && overhang.from[0] < window.origin[0]);
        assert!(right.from[0] >= window.origin[0] + window.size[0] && left.to[0] <= window.origin[0]);
        assert_eq!([right.from[2], right.to[2]], [window.origin[1], exact(head)]);
    }

    #[test]
    fn copies_stand_beside_and_what_is_not_there_is_refused() {
        let mut scene = first_scene();
        assert_eq!(act(&mut scene, Act::Remove(None)), Err(Refused::NothingThere));
        act(&mut scene, Act::Add(Kind::Fin)).unwrap();
        act(&mut scene, Act::Duplicate(None)).unwrap();
        assert_eq!(scene.outside[0].name, scene.outside[1].name);
        assert!(scene.outside[1].solid.from[0] > scene.outside[0].solid.to[0]);
        assert_eq!(act(&mut scene, Act::Remove(Some(2))), Err(Refused::NothingThere));
        act(&mut scene, Act::Remove(Some(0))).unwrap();
        assert_eq!(scene.outside.len(), 1);
        scene.outside = vec![scene.outside[0].clone(); MOST_BOXES];
        assert_eq!(act(&mut scene, Act::Add(Kind::Balcony)), Err(Refused::TooMany));
    }
}
