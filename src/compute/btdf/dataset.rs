//! Everything known photometrically about one state of one system.

use super::{Btdf, DescribedState, Finding, Thermal};

/// Which of the four functions of a band.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Component {
    /// Light from outside into the room.
    TransmissionFront,
    /// Light from the room to outside.
    TransmissionBack,
    /// Light from outside thrown back outside.
    ReflectionFront,
    /// Light from the room thrown back into the room.
    ReflectionBack,
}

impl Component {
    /// All four, in the order of files and listings.
    pub const ALL: [Self; 4] =
        [Self::TransmissionFront, Self::TransmissionBack, Self::ReflectionFront, Self::ReflectionBack];

    /// The word used in JSON and in the catalogue.
    pub const fn key(self) -> &'static str {
        match self {
            Self::TransmissionFront => "transmission_front",
            Self::TransmissionBack => "transmission_back",
            Self::ReflectionFront => "reflection_front",
            Self::ReflectionBack => "reflection_back",
        }
    }

    /// The name as files and messages write it.
    pub const fn words(self) -> &'static str {
        match self {
            Self::TransmissionFront => "Transmission Front",
            Self::TransmissionBack => "Transmission Back",
            Self::ReflectionFront => "Reflection Front",
            Self::ReflectionBack => "Reflection Back",
        }
    }

    /// The same for light from the other side.
    pub const fn other_side(self) -> Self {
        match self {
            Self::TransmissionFront => Self::TransmissionBack,
            Self::TransmissionBack => Self::TransmissionFront,
            Self::ReflectionFront => Self::ReflectionBack,
            Self::ReflectionBack => Self::ReflectionFront,
        }
    }

    /// Light that goes through, not back?
    pub const fn is_transmission(self) -> bool {
        matches!(self, Self::TransmissionFront | Self::TransmissionBack)
    }

    /// Of light from outside?
    pub const fn is_front(self) -> bool {
        matches!(self, Self::TransmissionFront | Self::ReflectionFront)
    }
}

/// The functions of one spectral band.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Band {
    /// Light from outside into the room.
    pub transmission_front: Option<Btdf>,
    /// Light from the room to outside.
    pub transmission_back: Option<Btdf>,
    /// Light from outside thrown back outside.
    pub reflection_front: Option<Btdf>,
    /// Light from the room thrown back into the room.
    pub reflection_back: Option<Btdf>,
}

impl Band {
    /// One of the four.
    pub const fn get(&self, component: Component) -> Option<&Btdf> {
        match component {
            Component::TransmissionFront => self.transmission_front.as_ref(),
            Component::TransmissionBack => self.transmission_back.as_ref(),
            Component::ReflectionFront => self.reflection_front.as_ref(),
            Component::ReflectionBack => self.reflection_back.as_ref(),
        }
    }

    /// The place of one of the four.
    pub const fn place(&mut self, component: Component) -> &mut Option<Btdf> {
        match component {
            Component::TransmissionFront => &mut self.transmission_front,
            Component::TransmissionBack => &mut self.transmission_back,
            Component::ReflectionFront => &mut self.reflection_front,
            Component::ReflectionBack => &mut self.reflection_back,
        }
    }

    /// Stores one of the four.
    pub fn set(&mut self, component: Component, btdf: Btdf) {
        *self.place(component) = Some(btdf);
    }

    /// Which are there, in the order of [`Component::ALL`].
    pub fn components(&self) -> Vec<Component> {
        Component::ALL.into_iter().filter(|&component| self.get(component).is_some()).collect()
    }
}

/// One state of one system: what a file holds, or what a closed form gives.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Dataset {
    /// Product name; may be empty.
    pub name: String,
    /// Maker; may be empty.
    pub manufacturer: String,
    /// Free text, e.g. the file's own comment on method and device.
    pub description: String,
    /// Key of the state within a family; empty for a system without states.
    pub state: String,
    /// Thickness of the system where it is known. \[m\]
    pub thickness: Option<f64>,
    /// Period of the visible structure (pitch of slats or cuts) where it is known. \[m\]
    pub structure: Option<f64>,
    /// Thermal data and extents as far as the source tells them.
    pub thermal: Thermal,
    /// The format it was read from, e.g. `bsdf-xml klems`; empty for closed forms.
    pub format: String,
    /// Names of the bases as the file gives them.
    pub incident_basis: String,
    /// Name of the emergent basis as the file gives it.
    pub emergent_basis: String,
    /// Visible band.
    pub visible: Band,
    /// Solar band, kept when present.
    pub solar: Option<Band>,
    /// Components that were not in the file but derived (by reciprocity).
    pub derived: Vec<Component>,
    /// What the reader and the checks have to say.
    pub findings: Vec<Finding>,
    /// The description that it was computed from, where all of it is known; `None` for measured and mended data.
    pub described: Option<DescribedState>,
}

impl Dataset {
    /// Visible transmission of light from outside, the function that the whole method starts from.
    pub const fn transmission(&self) -> Option<&Btdf> {
        self.visible.transmission_front.as_ref()
    }

    /// Diffuse reflectance of the room side under uniform light; `None` when the dataset does not say.
    pub fn room_side_reflectance(&self) -> Option<f64> {
        self.visible.reflection_back.as_ref().map(|btdf| btdf.tau_hemispherical().clamp(0.0, 1.0))
    }
}
