//! Units of the numbers of a scene file, by the names of their keys.

/// Units, each with the keys whose numbers have it, in any section.
const UNITS: [(&str, &[&str]); 7] = [
    (
        "m",
        &[
            "room.width",
            "room.depth",
            "room.height",
            "aperture.origin",
            "aperture.size",
            "sensors.plane.z",
            "sensors.points",
            "site.elevation",
            "outside.box.from",
            "outside.box.to",
        ],
    ),
    ("°", &["azimuth", "latitude", "longitude", "altitude", "altitudes", "turn", "elevation", "curve", "hysteresis"]),
    ("h", &["utc_offset"]),
    ("lx", &["diffuse_horizontal", "direct_normal", "threshold", "close_above", "open_below", "indoor"]),
    ("W/m²", &["direct_horizontal_irradiance", "diffuse_horizontal_irradiance"]),
    ("cd/m²", &["luminance"]),
    (
        "shares from 0 to 1",
        &["floor", "walls", "ceiling", "reflectance", "ground_reflectance", "frame", "dirt", "transmittance"],
    ),
];

/// Returns the unit of the number under a key, which is written without the indices of its lists, such as
/// `aperture.size`; `None` for numbers without unit.
pub fn unit_of(key: &str) -> Option<&'static str> {
    // Candidates have the keys of scenes.
    let key = key.strip_prefix("compare.").unwrap_or(key);
    let last = key.rsplit('.').next().unwrap_or(key);
    let of = |name: &str| UNITS.iter().find(|(_, keys)| keys.contains(&name)).map(|(unit, _)| *unit);
    of(key).or_else(|| of(last))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_go_by_whole_names_first() {
        assert_eq!(unit_of("site.elevation"), Some("m"));
        assert_eq!(unit_of("control.elevation"), Some("°"));
        assert_eq!(unit_of("compare.room.width"), Some("m"));
        assert_eq!(unit_of("sky.sun.altitude"), Some("°"));
        assert_eq!(unit_of("sky.type"), None);
    }
}
