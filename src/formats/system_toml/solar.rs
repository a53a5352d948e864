//! Solar properties of materials in a system file, beside the visible ones.
//!
//! A table with properties of a material may contain a table `solar` with those that differ for the whole solar
//! spectrum: `upper = { reflectance = 0.45, solar = { reflectance = 0.6 } }`, `[pane.solar]`. Keys that it omits have
//! the visible values, so that an empty table means that all properties are the same in both bands. Geometry is always
//! the same in both.

use super::checks::wrong;
use crate::formats::location::{FormatError, Location};
use toml::{Table, Value};

/// Name of the tables with solar properties.
const NAME: &str = "solar";

/// Table with the properties of a material: its name within the family's table (empty if it is the family's table
/// itself), and the keys of the properties.
type Material = (&'static str, &'static [&'static str]);

/// Returns the tables of materials of a family, given by its key; none for a stack.
fn materials(word: &str) -> &'static [Material] {
    const FACE: &[&str] = &["reflectance", "specular", "roughness"];
    const CLEAR: &[&str] = &["index", "absorption"];
    match word {
        "venetian" => &[("upper", FACE), ("lower", FACE)],
        "laser-cut-panel" => &[("", &["index", "absorption", "cut_loss"])],
        "prismatic" => &[("", CLEAR)],
        "redirecting-glass" => &[("", CLEAR), ("outer", CLEAR), ("inner", CLEAR)],
        "pane" => {
            &[("", &["index", "absorption", "transmittance_normal", "reflectance_normal", "reflectance_normal_back"])]
        }
        "diffuser" => &[("", &["transmittance", "reflectance", "index", "regular", "lobe", "spread", "absorbed"])],
        "woven" => &[("", &["reflectance", "reflectance_back", "transmittance"])],
        "perforated" => &[("", &["reflectance", "reflectance_back", "reflectance_wall"])],
        _ => &[],
    }
}

/// Keys of properties that replace others: a pane is described either by its absorption or by its data sheet.
const INSTEAD: [(&str, &[&str]); 2] = [
    ("absorption", &["transmittance_normal", "reflectance_normal", "reflectance_normal_back"]),
    ("transmittance_normal", &["absorption"]),
];

/// Returns the content of a system file with the solar properties in place of the visible ones (`None` if it has none),
/// the number of materials with solar properties, and that of all materials. `family`: key of the file's kind.
pub(super) fn keys(text: &str, family: &str) -> Result<(Option<Table>, [usize; 2]), FormatError> {
    // A text that is not TOML was refused before.
    let mut file: Table = toml::from_str(text).unwrap_or_default();
    let (mut given, mut all) = (0, 0);
    for (name, properties) in materials(family) {
        let own = file.get_mut(family).and_then(Value::as_table_mut);
        let table = if name.is_empty() { own } else { own.and_then(|own| own.get_mut(*name)?.as_table_mut()) };
        let Some(table) = table else { continue };
        all += 1;
        let place = if name.is_empty() { family.to_owned() } else { format!("{family}.{name}") };
        if let Some(solar) = table.remove(NAME) {
            given += 1;
            put(table, solar, &place, properties)?;
        }
    }
    Ok(((given > 0).then_some(file), [given, all]))
}

/// Replaces the visible properties in a material's table by the solar ones.
fn put(table: &mut Table, solar: Value, place: &str, properties: &[&str]) -> Result<(), FormatError> {
    let Value::Table(solar) = solar else {
        return wrong(&format!("{place}.{NAME}"), solar.type_str(), "a table, as solar = { reflectance = 0.6 }");
    };
    for (key, value) in &solar {
        let key_place = || format!("{place}.{NAME}.{key}");
        if !properties.contains(&key.as_str()) {
            return wrong(&key_place(), "no property of the material", format!("one of {}", properties.join(", ")));
        }
        if !matches!(value, Value::Float(_) | Value::Integer(_)) {
            return wrong(&key_place(), value.type_str(), "a number");
        }
    }
    for (key, others) in INSTEAD.iter().filter(|(key, _)| solar.contains_key(*key)) {
        if let Some(other) = others.iter().find(|other| solar.contains_key(**other)) {
            return wrong(&format!("{place}.{NAME}"), format!("{key} and {other}"), "one of the two");
        }
        for other in *others {
            table.remove(*other);
        }
    }
    table.extend(solar);
    Ok(())
}

/// Returns the error with its position marked as belonging to solar properties.
pub(super) fn located(error: FormatError) -> FormatError {
    let element = error.at.element.map_or_else(|| NAME.to_owned(), |inner| format!("{inner} (solar)"));
    FormatError::new(Location::file().in_element(element), error.found, error.expected)
}

#[cfg(test)]
mod tests {
    use super::super::read;
    use crate::compute::system::SystemKind;
    use crate::compute::system::panes::coated::{CoatedPane, Layer};

    const BLIND: &str = "name = \"Blind\"\nkind = \"venetian\"\n[venetian]\nwidth = 0.08\nspacing = 0.072\nangles = [0.0, 45.0]\n\
                         upper = { reflectance = 0.4, specular = 0.1, solar = { reflectance = 0.6 } }\n\
                         lower = { reflectance = 0.2 }\n";

    fn pane(keys: &str) -> String {
        format!("name = \"p\"\nkind = \"pane\"\n[pane]\nindex = 1.52\nthickness = 0.004\n{keys}\n")
    }

    fn layer(kind: Option<SystemKind>) -> Layer {
        let Some(SystemKind::Pane(stack)) = kind else { panic!("a pane") };
        stack.pane
    }

    #[test]
    fn what_is_given_takes_the_place_of_what_light_has() {
        let file = read(BLIND.as_bytes()).unwrap();
        let (SystemKind::Venetian(light), Some(SystemKind::Venetian(solar))) = (&file.system.kind, &file.solar) else {
            panic!("slats")
        };
        assert_eq!((light.upper.diffuse, solar.upper.diffuse, solar.upper.mirror), (0.4, 0.6, 0.1));
        assert_eq!((&light.lower, &light.profile), (&solar.lower, &solar.profile));
        assert_eq!(file.materials, [1, 2]);
        let silent = read(BLIND.replace(", solar = { reflectance = 0.6 }", "").as_bytes()).unwrap();
        assert_eq!((silent.solar, silent.materials), (None, [0, 2]));
        assert_eq!(file.system, silent.system, "light is not changed by it");
        let same = read(pane("absorption = 10.0\nsolar = {}").as_bytes()).unwrap();
        assert_eq!((same.solar, same.materials), (Some(same.system.kind), [1, 1]));
    }

    #[test]
    fn a_pane_may_be_known_otherwise_in_the_other_band() {
        let sheet = "transmittance_normal = 0.6\nreflectance_normal = 0.2";
        let file = read(pane(&format!("{sheet}\nsolar = {{ transmittance_normal = 0.4 }}")).as_bytes()).unwrap();
        assert_eq!(layer(file.solar), Layer::Coated(CoatedPane { transmittance: 0.4, front: 0.2, back: 0.2 }));
        let file = read(pane(&format!("{sheet}\nsolar = {{ absorption = 30.0 }}")).as_bytes()).unwrap();
        let Layer::Clear(clear) = layer(file.solar) else { panic!("a clear pane") };
        assert_eq!((clear.absorption, clear.index), (30.0, 1.52));
        let text = pane("absorption = 10.0\n[pane.solar]\ntransmittance_normal = 0.4\nreflectance_normal = 0.3");
        let file = read(text.as_bytes()).unwrap();
        assert_eq!(layer(file.solar), Layer::Coated(CoatedPane { transmittance: 0.4, front: 0.3, back: 0.3 }));
    }

    #[test]
    fn wrong_ones_are_told_by_their_key() {
        let told = |solar: &str| {
            let text = BLIND.replace("{ reflectance = 0.6 }", solar);
            read(text.as_bytes()).unwrap_err().to_string()
        };
        for (solar, expected) in [
            ("{ width = 0.1 }", "venetian.upper.solar.width: no property of the material; expected one of reflectance"),
            ("{ reflectance = \"0.6\" }", "venetian.upper.solar.reflectance: string; expected a number"),
            ("{ reflectance = 1.2 }", "venetian.upper.reflectance (solar): 1.2; expected 0 to 1"),
            ("{ reflectance = 0.95 }", "venetian.upper (solar): reflectance + specular = 1.05"),
        ] {
            assert!(told(solar).contains(expected), "{solar}: {}", told(solar));
        }
        assert!(read(BLIND.replace("{ reflectance = 0.6 }", "0.6").as_bytes()).is_err());
        let both = pane("absorption = 10.0\nsolar = { absorption = 20.0, transmittance_normal = 0.4 }");
        let error = read(both.as_bytes()).unwrap_err().to_string();
        assert!(error.contains("pane.solar: absorption and transmittance_normal"), "{error}");
        // Geometry has no other band.
        let text = BLIND.replace("[venetian]", "[venetian]\nsolar = { spacing = 0.1 }");
        assert!(read(text.as_bytes()).unwrap_err().to_string().contains("unknown field `solar`"));
    }
}
