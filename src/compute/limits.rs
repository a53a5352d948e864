//! Limits of input, computation and memory, in one table: an input beyond a limit is refused before the work is done,
//! by a message that names the limit. `cfs limits` prints the table.
//!
//! Limits protect against typing errors and files made to fill memory, not against large studies: each lies well beyond
//! what a study of daylight has needed so far. Unless its comment names another source, a value is chosen in this sense
//! and affects no result, because an input is either used as it is or refused.

/// Limit in one line of the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// Limited quantity in words.
    pub of: &'static str,
    /// Value of the limit.
    pub value: f64,
    /// Unit of the limit; empty for a count.
    pub unit: &'static str,
    /// Whether the limit is a minimum instead of a maximum.
    pub least: bool,
}

impl std::fmt::Display for Limit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let word = if self.least { "at least" } else { "at most" };
        let (value, unit) = match self.unit {
            "bytes" if self.value >= MEGABYTE => (self.value / MEGABYTE, "MB"),
            "bytes" => (self.value / 1024.0, "kB"),
            unit => (self.value, unit),
        };
        let number = if (1e-3..1e9).contains(&value) { format!("{value}") } else { format!("{value:e}") };
        write!(f, "{}: {word} {number}{}{unit}", self.of, if unit.is_empty() { "" } else { " " })
    }
}

/// Number of bytes per megabyte in messages: 2²⁰.
const MEGABYTE: f64 = 1_048_576.0;

macro_rules! limits {
    (@least least) => { true };
    (@least most) => { false };
    ($($(#[$doc:meta])* $word:ident $name:ident: $kind:ty = $value:expr, $of:literal, $unit:literal;)*) => {
        $($(#[$doc])* pub const $name: $kind = $value;)*

        /// Table of all limits, in the order in which `cfs limits` prints them.
        pub const TABLE: &[Limit] =
            &[$(Limit { of: $of, value: $name as f64, unit: $unit, least: limits!(@least $word) }),*];
    };
}

limits! {
    /// Maximum size of a file that is read. \[bytes\]
    most FILE_BYTES: u64 = 1 << 30, "a file", "bytes";
    /// Maximum size of a text that holds no matrices. \[bytes\]
    most TEXT_BYTES: usize = 32 << 20, "a scene, luminaire file, index of them, control curve or sky scan", "bytes";
    /// Maximum number of files of one import.
    most IMPORTED_FILES: usize = 2000, "files of one import", "";
    /// Maximum size of the unpacked files of one import, all together. \[bytes\]
    most UNPACKED_BYTES: u64 = 1 << 30, "unpacked files of one import", "bytes";
    /// Maximum number of entries of a zip archive or package.
    most ARCHIVE_ENTRIES: usize = 20_000, "entries of an archive or package", "";
    /// Maximum unpacked size of one file of an archive, or one dataset of a package. \[bytes\]
    most ENTRY_BYTES: u64 = 256 << 20, "an unpacked file of an archive, a dataset of a package", "bytes";
    /// Maximum size of the manifest of a package. \[bytes\]
    most MANIFEST_BYTES: u64 = 16 << 20, "the manifest of a package", "bytes";
    /// Maximum packed size of the datasets of a package. \[bytes\]
    most PACKAGE_BYTES: u64 = 1 << 30, "all datasets of a package", "bytes";
    /// Maximum size of the decoded values of all datasets of a file, each counted once. \[bytes\]
    most DECODED_BYTES: u64 = 2 << 30, "decoded values of all datasets of a file", "bytes";
    /// Maximum number of states of a product.
    most STATES: usize = 1000, "states of a product", "";
    /// Maximum number of tags of a product.
    most TAGS: usize = 1000, "tags of a product", "";
    /// Maximum number of values of one function of a dataset: 2²⁴, 134 MB of f64.
    most VALUES: usize = 1 << 24, "values of one function of a dataset", "";
    /// Maximum number of incident directions of a dataset.
    most INCIDENCES: usize = 1 << 13, "incident directions of a dataset", "";
    /// Maximum magnitude of any value of a dataset. \[1/sr\]
    most COEFFICIENT: f64 = 1e9, "a value of a dataset", "1/sr";
    /// Maximum number of cells of one basis: those of a grid of [`MAX_LEVEL`](crate::compute::basis::MAX_LEVEL), 512².
    most CELLS: usize = 1 << 18, "cells of one basis", "";
    /// Maximum number of nodes of a tensor tree: 134 MB of 16 bytes each.
    most TREE_NODES: usize = 8 << 20, "nodes of a tensor tree", "";
    /// Maximum number of C planes of a luminaire file: 0 … 360° by 0.5°.
    most LUMINAIRE_PLANES: usize = 721, "C planes of a luminaire file", "";
    /// Maximum number of angles in a plane of a luminaire file: 0 … 180° by 0.5°.
    most LUMINAIRE_ANGLES: usize = 361, "angles in a plane of a luminaire file", "";
    /// Maximum size of a weather file, three times that of a year minute by minute. \[bytes\]
    most WEATHER_BYTES: u64 = 256 << 20, "a weather file", "bytes";
    /// Maximum number of rows of a weather file: a leap year minute by minute.
    most WEATHER_RECORDS: usize = 366 * 24 * 60, "rows of a weather file", "";
    /// Maximum size of a system file. \[bytes\]
    most SYSTEM_BYTES: usize = 1 << 20, "a system file", "bytes";
    /// Maximum number of states that a system file describes: a whole turn by 1°.
    most SYSTEM_STATES: usize = 361, "states of a system file", "";
    /// Maximum number of points of an outline in a system file.
    most OUTLINE_POINTS: usize = 2000, "points of an outline in a system file", "";
    /// Maximum number of points of a slat's profile; its pieces exchange light, each with all others.
    most SLAT_POINTS: usize = 400, "points of a slat's profile", "";
    /// Maximum number of points of a control curve.
    most CURVE_POINTS: usize = 10_000, "points of a control curve", "";
    /// Maximum number of pitches that a mirror slat spans in its longer dimension.
    most MIRROR_PITCHES: f64 = 8.0, "pitches that a mirror slat spans", "";
    /// Maximum number of sensors of a scene.
    most SENSORS: usize = 1_000_000, "sensors of a scene", "";
    /// Maximum size of each table of the sensors' geometry that is kept between answers; larger ones are computed
    /// again. \[bytes\] Chosen: cost only, no effect on results.
    most KEPT_BYTES: usize = 384 << 20, "a table of what sensors see, kept between answers", "bytes";
    /// Maximum size of the sensors' responses to the patches of the room for an annual simulation. \[bytes\]
    most RESPONSE_BYTES: usize = 2 << 30, "responses of sensors for a year", "bytes";
    /// Maximum number of patches of a room, whose exchange areas take 0.13 GB.
    most PATCHES: usize = 8000, "patches of a room", "";
    /// Maximum number of apertures of a scene; each is checked against all others.
    most APERTURES: usize = 10_000, "apertures of a scene", "";
    /// Maximum number of boxes outside.
    most BOXES: usize = 200, "boxes outside", "";
    /// Minimum side of an aperture. \[m\]
    least OPENING: f64 = 1e-6, "the side of an aperture", "m";
    /// Maximum illuminance of a sky or a sun, seventy times the sun's outside the atmosphere. \[lx\]
    most ILLUMINANCE: f64 = 1e7, "an illuminance of sky or sun", "lx";
    /// Maximum luminance outside, six times that of the sun's disc. \[cd/m²\]
    most LUMINANCE: f64 = 1e10, "a luminance outside", "cd/m²";
    /// Maximum intensity of a luminaire in any direction: beyond the strongest searchlights. \[cd\]
    most INTENSITY: f64 = 1e12, "an intensity of a luminaire", "cd";
    /// Maximum flux of a luminaire's lamps together. \[lm\]
    most LAMP_FLUX: f64 = 1e9, "the flux of a luminaire's lamps", "lm";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_limit_is_told_once_in_words_with_its_unit() {
        let told: Vec<String> = TABLE.iter().map(Limit::to_string).collect();
        for (index, line) in told.iter().enumerate() {
            assert!(TABLE[index].value > 0.0 && line.len() < 100, "{line}");
            assert!(!told[..index].contains(line), "{line}");
        }
        assert!(told.contains(&"sensors of a scene: at most 1000000".to_owned()));
        assert!(told.contains(&"the side of an aperture: at least 1e-6 m".to_owned()));
        assert!(told.contains(&"the manifest of a package: at most 16 MB".to_owned()));
    }
}
