//! Solar band of a dataset: the source of its values, and the mark of values that are partly visible ones.
//!
//! Datasets and descriptions without a solar band are used with their visible values; [`SolarSource`] reports this. If
//! a description has solar properties for some of its materials only, the computed band is a mixture: the dataset's
//! text, which every format stores, then contains the words [`PARTLY_VISIBLE`], from which the finding of the same name
//! is created whenever the data are read.

use super::{Band, Btdf, Dataset, Finding};

/// Spectral band of BSDF data.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum BandName {
    /// Visible band: light, weighted by V(λ).
    #[default]
    Visible,
    /// Solar band: solar radiation over its whole spectrum.
    Solar,
}

impl BandName {
    /// Returns the key of the band in files.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Visible => "Visible",
            Self::Solar => "Solar",
        }
    }
}

/// Source of the solar properties of a system.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SolarSource {
    /// Complete solar data of the system.
    Own,
    /// Solar data of the system, with visible properties for materials without solar ones.
    Partly,
    /// Visible properties of the system, used as solar ones.
    Visible,
}

impl SolarSource {
    /// Returns the source for a described system from the number of its materials with solar properties and the number
    /// of all its materials.
    pub const fn of([given, all]: [usize; 2]) -> Self {
        match (given, given < all) {
            (0, _) => Self::Visible,
            (_, true) => Self::Partly,
            (_, false) => Self::Own,
        }
    }

    /// Returns the English label of the source in results.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Own => "solar data",
            Self::Partly => "solar data, partly visible taken as solar",
            Self::Visible => "visible taken as solar",
        }
    }
}

/// Code of the finding and words in a dataset's text for a solar band that was partly computed from visible properties.
pub const PARTLY_VISIBLE: [&str; 2] = ["solar-partly-visible", "Solar band: visible taken as solar for"];

impl Dataset {
    /// Returns the functions of a spectral band; those of the visible band if the solar one lacks any of them.
    pub fn band(&self, name: BandName) -> &Band {
        let whole = |solar: &&Band| self.visible.components().iter().all(|one| solar.get(*one).is_some());
        match (name, self.solar.as_ref().filter(whole)) {
            (BandName::Solar, Some(solar)) => solar,
            _ => &self.visible,
        }
    }

    /// Returns the transmission of light from outside in a spectral band; the visible one if there is no solar one,
    /// `None` if there is none at all.
    pub fn transmission_of(&self, name: BandName) -> Option<&Btdf> {
        match (name, self.solar.as_ref().and_then(|solar| solar.transmission_front.as_ref())) {
            (BandName::Solar, Some(solar)) => Some(solar),
            _ => self.transmission(),
        }
    }

    /// Returns the source of the solar values that [`Self::transmission_of`] returns.
    pub fn solar_source(&self) -> SolarSource {
        self.source(self.solar.as_ref().is_some_and(|solar| solar.transmission_front.is_some()))
    }

    /// Returns the source of the solar values that [`Self::band`] returns.
    pub fn solar_source_of_all(&self) -> SolarSource {
        self.source(!std::ptr::eq(self.band(BandName::Solar), &self.visible))
    }

    fn source(&self, own: bool) -> SolarSource {
        let [code, words] = PARTLY_VISIBLE;
        let partly = || self.findings.iter().any(|one| one.code == code) || self.description.contains(words);
        match own {
            false => SolarSource::Visible,
            true if partly() => SolarSource::Partly,
            true => SolarSource::Own,
        }
    }

    /// Marks the solar band of a computed dataset as partly visible: materials without solar properties were computed
    /// with their visible ones. Arguments: number of materials with solar properties, number of all materials.
    pub fn mark_partly_visible(&mut self, [given, all]: [usize; 2]) {
        let words = format!("{} {} of {all} materials.", PARTLY_VISIBLE[1], all.saturating_sub(given));
        if !self.description.is_empty() {
            self.description.push(' ');
        }
        self.description.push_str(&words);
        self.report_partly_visible();
    }

    /// Adds the finding of a partly visible solar band if the dataset's text contains the mark and the finding does not
    /// exist yet.
    pub fn report_partly_visible(&mut self) {
        let [code, words] = PARTLY_VISIBLE;
        let is_reported = self.findings.iter().any(|one| one.code == code);
        if let (Some(at), true, false) = (self.description.find(words), self.solar.is_some(), is_reported) {
            let rest = &self.description[at..];
            let sentence = rest.split_inclusive('.').next().unwrap_or(rest).to_owned();
            self.findings.push(Finding::info(code, sentence));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_is_visible_and_marked() {
        let mut data = Dataset::default();
        data.visible.transmission_front = Some(Btdf::ideal_diffuse(0.5));
        let of = |data: &Dataset| data.transmission_of(BandName::Solar).map(Btdf::tau_hemispherical);
        assert_eq!((data.solar_source(), of(&data)), (SolarSource::Visible, Some(0.5)));
        let solar = Band { transmission_front: Some(Btdf::ideal_diffuse(0.3)), ..Band::default() };
        data.solar = Some(solar);
        assert_eq!((data.solar_source(), of(&data)), (SolarSource::Own, Some(0.3)));
        assert_eq!(data.band(BandName::Visible), &data.visible);
        data.description = "A blind.".to_owned();
        data.mark_partly_visible([1, 3]);
        assert_eq!(data.solar_source(), SolarSource::Partly);
        assert_eq!(data.findings[0].message, "Solar band: visible taken as solar for 2 of 3 materials.");
        // As when it is read from a file that keeps the text alone.
        data.findings.clear();
        data.report_partly_visible();
        data.report_partly_visible();
        assert_eq!((data.findings.len(), data.solar_source()), (1, SolarSource::Partly));
    }

    #[test]
    fn materials_are_counted() {
        let of = SolarSource::of;
        assert_eq!([of([0, 2]), of([1, 2]), of([2, 2])], [SolarSource::Visible, SolarSource::Partly, SolarSource::Own]);
    }
}
