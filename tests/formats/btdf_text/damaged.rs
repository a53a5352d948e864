//! Broken and hostile files: one line that says where, what and what would be right.

use super::{File, uneven};
use cfs::compute::btdf::Component;
use cfs::formats::btdf_text::read;

#[test]
fn one_clear_line_for_every_broken_file() {
    let good = File::new(Component::TransmissionFront).text(|_, _| 0.2);
    assert!(read(good.as_bytes()).is_ok());
    let swap = |from: &str, to: &str| {
        assert!(good.contains(from), "{from}");
        good.replacen(from, to, 1)
    };
    let records = good.lines().count();
    let cut = |bytes: usize| good[..bytes].to_owned();
    let third = good.lines().nth(13).unwrap();
    assert!(third.starts_with("84 24 "));
    let cases: Vec<(&str, String, &[&str])> = vec![
        ("empty", String::new(), &["---"]),
        ("no fence", "1 2 3\n".into(), &["line 1", "---"]),
        ("open header", "---\nformat = \"cfs-btdf 1\"\n".into(), &["line 2", "second line"]),
        ("no format", swap("format = \"cfs-btdf 1\"\n", ""), &["format"]),
        ("version", swap("cfs-btdf 1", "cfs-btdf 2"), &["cfs-btdf 2", "cfs-btdf 1"]),
        ("syntax", swap("layout = ", "layout "), &["line 7"]),
        ("unknown key", swap("layout", "emergence = 3\nlayout"), &["line 7", "emergence", "expected"]),
        ("key twice", swap("layout", "name = \"b\"\nlayout"), &["line 7"]),
        ("quantity", swap("\"btdf\"", "\"bsdf\""), &["line 5", "bsdf", "btdf"]),
        ("side", swap("\"outside\"", "\"above\""), &["line 6", "above", "outside"]),
        ("layout", swap("\"rings\"", "\"grid\""), &["line 7", "grid", "points"]),
        ("incidence", swap("tregenza-145", "tregenza"), &["line 9", "tregenza", "klems-145"]),
        ("symmetry", swap("incident_mean", "symmetry = \"left\"\nincident_mean"), &["line 10", "left-right"]),
        ("mean", swap("= false", "= 1"), &["line 10"]),
        ("no rings", swap("rings = [", "#"), &["rings"]),
        ("ring of two", swap("[90.0, 120.0, 20]", "[90.0, 120.0]"), &["line 8"]),
        ("falling ring", swap("[90.0, 120.0, 20]", "[120.0, 90.0, 20]"), &["line 8", "ring 1"]),
        ("wrong side", swap("[90.0, 120.0, 20]", "[80.0, 120.0, 20]"), &["line 8", "90…180"]),
        ("half a sector", swap("[90.0, 120.0, 20]", "[90.0, 120.0, 20.5]"), &["line 8", "20.5"]),
        ("no sectors", swap("[90.0, 120.0, 20]", "[90.0, 120.0, 0]"), &["line 8", "0 sectors"]),
        ("huge", swap("[90.0, 120.0, 20]", "[90.0, 120.0, 4000000000]"), &["line 8", "4000000000"]),
        ("nan limit", swap("[90.0, 120.0, 20]", "[nan, 120.0, 20]"), &["line 8"]),
        ("negative", swap(third, &third.replacen(" 0.2", " -0.2", 1)), &["line 14", "negative", "column 7"]),
        ("nan", swap(third, &third.replacen(" 0.2", " NaN", 1)), &["line 14", "NaN", "finite"]),
        ("infinite", swap(third, &third.replacen(" 0.2", " inf", 1)), &["line 14", "inf"]),
        ("overflow", swap(third, &third.replacen(" 0.2", " 1e300", 1)), &["line 14", "1e300"]),
        ("word", swap(third, &third.replacen(" 0.2", " dark", 1)), &["line 14", "dark", "not a number"]),
        ("comma", swap(third, &third.replacen(" 0.2", " 0,2", 1)), &["line 14", "0,2", "comma"]),
        ("too few", swap(third, &third.replacen(" 0.2", "", 1)), &["line 14", "44 values", "45"]),
        ("too many", swap(third, &third.replacen(" 0.2", " 0.2 0.2", 1)), &["line 14", "46 values", "45"]),
        ("only angles", swap(third, "84 24"), &["line 14", "0 values"]),
        ("one angle", swap(third, "84"), &["line 14", "φ"]),
        ("off the lattice", swap("84 24 ", "83 24 "), &["line 14", "83", "θ 84° φ 24°", "listed"]),
        ("other side", swap("84 24 ", "96 24 "), &["line 14", "96", "0…90"]),
        ("twice", swap("84 24 ", "84 12 "), &["line 14", "again", "line 13"]),
        ("a turn more twice", swap("84 24 ", "84 372 "), &["line 14", "again"]),
        ("bright", good.replace("0.2", "0.9"), &["line 12", "2.8"]),
        ("second header", format!("{good}---\nformat = \"cfs-btdf 1\"\n"), &["---"]),
        ("cut in a number", cut(good.len() / 2), &["values", "cut off"]),
        ("cut in the header", cut(120), &["header"]),
        ("no records", cut(good.find("84 0 ").unwrap()), &["no records"]),
    ];
    assert_eq!(records, 11 + 145);
    for (what, text, words) in cases {
        let error = read(text.as_bytes()).err().unwrap_or_else(|| panic!("{what} was read")).to_string();
        assert!(!error.contains('\n') && error.contains("; expected "), "{what}: {error}");
        for word in words {
            assert!(error.contains(word), "{what}: '{word}' not in: {error}");
        }
    }
    // Line ends of another system, other encodings and blank lines are no fault.
    let visible = read(good.as_bytes()).unwrap().visible;
    let latin = read(&[good.as_bytes(), b"# 30\xb0\n"].concat()).unwrap();
    assert_eq!((latin.visible, latin.findings[0].code), (visible.clone(), "encoding-repaired"));
    let wide: Vec<u8> = good.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let other = format!("\u{feff}{}", good.replace('\n', "\r\n").replace("84 24", "\r\n\t84   24"));
    let others = [[&[0xff, 0xfe][..], &wide].concat(), other.into_bytes(), good.replace('\n', "\r").into_bytes()];
    for other in others {
        assert_eq!(read(&other).unwrap().visible, visible);
    }
}

#[test]
fn any_cut_and_any_flipped_byte_is_data_or_one_line() {
    let mut file = File::new(Component::TransmissionFront);
    file.directions.truncate(40);
    let rings = file.text(uneven);
    file.directions.truncate(4);
    let points = file.points(&file.cells(), uneven);
    for text in [rings, points] {
        let mut state = 12345_u64;
        for _ in 0..600 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let at = (state >> 33) as usize % text.len();
            let mut bytes = text.clone().into_bytes();
            if state & 1 << 20 == 0 {
                bytes.truncate(at);
            } else {
                bytes[at] = (state >> 24) as u8;
            }
            if let Err(error) = read(&bytes) {
                let error = error.to_string();
                assert!(!error.is_empty() && !error.contains('\n'), "{error}");
            }
        }
    }
}
