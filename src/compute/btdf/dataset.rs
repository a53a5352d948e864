//! Photometric data of one state of one system.

use super::{Btdf, DescribedState, Finding, Thermal};

/// One of the four functions of a band.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Component {
    /// Transmission of light from outside into the room.
    TransmissionFront,
    /// Transmission of light from the room to outside.
    TransmissionBack,
    /// Reflection of light from outside back outside.
    ReflectionFront,
    /// Reflection of light from the room back into the room.
    ReflectionBack,
}

impl Component {
    /// All four functions, in the order of files and listings.
    pub const ALL: [Self; 4] =
        [Self::TransmissionFront, Self::TransmissionBack, Self::ReflectionFront, Self::ReflectionBack];

    /// Returns the key used in JSON and in the catalogue.
    pub const fn key(self) -> &'static str {
        match self {
            Self::TransmissionFront => "transmission_front",
            Self::TransmissionBack => "transmission_back",
            Self::ReflectionFront => "reflection_front",
            Self::ReflectionBack => "reflection_back",
        }
    }

    /// Returns the name as files and messages write it.
    pub const fn words(self) -> &'static str {
        match self {
            Self::TransmissionFront => "Transmission Front",
            Self::TransmissionBack => "Transmission Back",
            Self::ReflectionFront => "Reflection Front",
            Self::ReflectionBack => "Reflection Back",
        }
    }

    /// Returns the function of the same kind for light from the other side.
    pub const fn other_side(self) -> Self {
        match self {
            Self::TransmissionFront => Self::TransmissionBack,
            Self::TransmissionBack => Self::TransmissionFront,
            Self::ReflectionFront => Self::ReflectionBack,
            Self::ReflectionBack => Self::ReflectionFront,
        }
    }

    /// Whether the function is a transmission, not a reflection.
    pub const fn is_transmission(self) -> bool {
        matches!(self, Self::TransmissionFront | Self::TransmissionBack)
    }

    /// Whether the function is that of light from outside.
    pub const fn is_front(self) -> bool {
        matches!(self, Self::TransmissionFront | Self::ReflectionFront)
    }
}

/// Functions of one spectral band.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Band {
    /// Transmission of light from outside into the room.
    pub transmission_front: Option<Btdf>,
    /// Transmission of light from the room to outside.
    pub transmission_back: Option<Btdf>,
    /// Reflection of light from outside back outside.
    pub reflection_front: Option<Btdf>,
    /// Reflection of light from the room back into the room.
    pub reflection_back: Option<Btdf>,
}

impl Band {
    /// Returns one of the four functions.
    pub const fn get(&self, component: Component) -> Option<&Btdf> {
        match component {
            Component::TransmissionFront => self.transmission_front.as_ref(),
            Component::TransmissionBack => self.transmission_back.as_ref(),
            Component::ReflectionFront => self.reflection_front.as_ref(),
            Component::ReflectionBack => self.reflection_back.as_ref(),
        }
    }

    /// Returns the place of one of the four functions.
    pub const fn place(&mut self, component: Component) -> &mut Option<Btdf> {
        match component {
            Component::TransmissionFront => &mut self.transmission_front,
            Component::TransmissionBack => &mut self.transmission_back,
            Component::ReflectionFront => &mut self.reflection_front,
            Component::ReflectionBack => &mut self.reflection_back,
        }
    }

    /// Stores one of the four functions.
    pub fn set(&mut self, component: Component, btdf: Btdf) {
        *self.place(component) = Some(btdf);
    }

    /// Returns the functions that are present, in the order of [`Component::ALL`].
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
    /// Thermal data and extents as far as the source gives them.
    pub thermal: Thermal,
    /// Format of the source file, e.g. `bsdf-xml klems`; empty for closed forms.
    pub format: String,
    /// Name of the incident basis as the file gives it.
    pub incident_basis: String,
    /// Name of the emergent basis as the file gives it.
    pub emergent_basis: String,
    /// Visible band.
    pub visible: Band,
    /// Solar band, if the source has one.
    pub solar: Option<Band>,
    /// Components that were not in the file but derived (by reciprocity).
    pub derived: Vec<Component>,
    /// Findings of the reader and of the checks.
    pub findings: Vec<Finding>,
    /// Description that the dataset was computed from, where all of it is known; `None` for measured and repaired data.
    pub described: Option<DescribedState>,
}

impl Dataset {
    /// Returns the visible transmission of light from outside, the function that the whole method starts from.
    pub const fn transmission(&self) -> Option<&Btdf> {
        self.visible.transmission_front.as_ref()
    }

    /// Returns the diffuse reflectance of the room side under uniform light; `None` if the dataset does not contain it.
    pub fn room_side_reflectance(&self) -> Option<f64> {
        self.visible.reflection_back.as_ref().map(|btdf| btdf.tau_hemispherical().clamp(0.0, 1.0))
    }
}
