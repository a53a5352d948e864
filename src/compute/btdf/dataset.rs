//! Dataset: BSDF data of one state of one system, with its source and findings.

use super::{Btdf, DescribedState, Finding, Thermal};

/// One of the four BTDFs and BRDFs of a spectral band, by side of incidence.
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
    /// All four functions of a band, in the order of files and listings.
    pub const ALL: [Self; 4] =
        [Self::TransmissionFront, Self::TransmissionBack, Self::ReflectionFront, Self::ReflectionBack];

    /// Returns the key of the function in JSON and in the catalogue.
    pub const fn key(self) -> &'static str {
        match self {
            Self::TransmissionFront => "transmission_front",
            Self::TransmissionBack => "transmission_back",
            Self::ReflectionFront => "reflection_front",
            Self::ReflectionBack => "reflection_back",
        }
    }

    /// Returns the English name of the function in files and messages.
    pub const fn words(self) -> &'static str {
        match self {
            Self::TransmissionFront => "Transmission Front",
            Self::TransmissionBack => "Transmission Back",
            Self::ReflectionFront => "Reflection Front",
            Self::ReflectionBack => "Reflection Back",
        }
    }

    /// Returns the function of the same kind (transmission or reflection) for light from the other side.
    pub const fn other_side(self) -> Self {
        match self {
            Self::TransmissionFront => Self::TransmissionBack,
            Self::TransmissionBack => Self::TransmissionFront,
            Self::ReflectionFront => Self::ReflectionBack,
            Self::ReflectionBack => Self::ReflectionFront,
        }
    }

    /// Whether the function is a transmission; otherwise it is a reflection.
    pub const fn is_transmission(self) -> bool {
        matches!(self, Self::TransmissionFront | Self::TransmissionBack)
    }

    /// Whether the function is for light from outside; otherwise for light from the room.
    pub const fn is_front(self) -> bool {
        matches!(self, Self::TransmissionFront | Self::ReflectionFront)
    }
}

/// BTDFs and BRDFs of one spectral band; `None` for functions that the source does not contain.
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
    /// Returns one of the four functions; `None` if the band does not contain it.
    pub const fn get(&self, component: Component) -> Option<&Btdf> {
        match component {
            Component::TransmissionFront => self.transmission_front.as_ref(),
            Component::TransmissionBack => self.transmission_back.as_ref(),
            Component::ReflectionFront => self.reflection_front.as_ref(),
            Component::ReflectionBack => self.reflection_back.as_ref(),
        }
    }

    /// Returns the field of one of the four functions for modification.
    pub const fn place(&mut self, component: Component) -> &mut Option<Btdf> {
        match component {
            Component::TransmissionFront => &mut self.transmission_front,
            Component::TransmissionBack => &mut self.transmission_back,
            Component::ReflectionFront => &mut self.reflection_front,
            Component::ReflectionBack => &mut self.reflection_back,
        }
    }

    /// Sets one of the four functions.
    pub fn set(&mut self, component: Component, btdf: Btdf) {
        *self.place(component) = Some(btdf);
    }

    /// Returns which of the four functions the band contains, in the order of [`Component::ALL`].
    pub fn components(&self) -> Vec<Component> {
        Component::ALL.into_iter().filter(|&component| self.get(component).is_some()).collect()
    }
}

/// Dataset of one state of one system: BSDF data read from a file or computed, with product data and findings.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Dataset {
    /// Name of the product; may be empty.
    pub name: String,
    /// Manufacturer of the product; may be empty.
    pub manufacturer: String,
    /// Free text, e.g. the comment of the file on method and device.
    pub description: String,
    /// Key of the state of the product; empty for a product with one state only.
    pub state: String,
    /// Thickness of the system \[m\]; `None` if unknown.
    pub thickness: Option<f64>,
    /// Period of the visible structure (spacing of slats or cuts) \[m\]; `None` if unknown.
    pub structure: Option<f64>,
    /// Thermal data and size of the sample, as far as the source specifies them.
    pub thermal: Thermal,
    /// Format of the source file, e.g. `bsdf-xml klems`; empty for computed data.
    pub format: String,
    /// Name of the incident basis in the source file.
    pub incident_basis: String,
    /// Name of the emergent basis in the source file.
    pub emergent_basis: String,
    /// BTDFs and BRDFs of the visible band, weighted by V(λ).
    pub visible: Band,
    /// BTDFs and BRDFs of the solar band; `None` if the source has none.
    pub solar: Option<Band>,
    /// Functions that were not in the source but derived by reciprocity.
    pub derived: Vec<Component>,
    /// Findings of the reader of the file and of the data checks.
    pub findings: Vec<Finding>,
    /// Description of the system from which the dataset was computed, if it is complete; `None` for measured and
    /// repaired data.
    pub described: Option<DescribedState>,
}

impl Dataset {
    /// Returns the visible transmission of light from outside; `None` if the dataset does not contain it.
    pub const fn transmission(&self) -> Option<&Btdf> {
        self.visible.transmission_front.as_ref()
    }

    /// Returns the visible transmission of light from outside, or of light from inside where only that is known; `None`
    /// for a dataset of reflections alone.
    pub fn transmission_of_either_side(&self) -> Option<&Btdf> {
        self.transmission().or(self.visible.transmission_back.as_ref())
    }

    /// Returns the diffuse reflectance of the room side under uniform light; `None` if the dataset does not contain it.
    pub fn room_side_reflectance(&self) -> Option<f64> {
        self.visible.reflection_back.as_ref().map(|btdf| btdf.tau_hemispherical().clamp(0.0, 1.0))
    }
}
