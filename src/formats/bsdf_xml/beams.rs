//! System description from which the data of a BSDF XML file were computed (see [`crate::formats::beams`]), as a
//! processing instruction.
//!
//! `<?cfs-system version="1" state="45" fingerprint="…" text="…"?>`, at the beginning of the root element. The standard
//! has no processing instructions, so that its readers ignore them (Radiance's ezxml separates instructions from
//! elements, and schemas do not mention them). A comment would be possible too, but comments of this format are texts
//! for people, and are read as such. In the values everything that could end them or look like markup is written as `%`
//! and two hexadecimal digits per byte of UTF-8.

use super::document::children;
use crate::compute::btdf::{Dataset, DescribedState, Finding};
use crate::formats::beams::{Fingerprint, StoredDescription, VERSION, not_restored};
use roxmltree::{Document, Node};

/// Target of the processing instruction.
const TARGET: &str = "cfs-system";

/// Returns the fingerprint of the description and of all optical data: the bases and the values of every block, of both
/// bands.
fn fingerprint(root: Node<'_, '_>, described: &DescribedState) -> String {
    let mut print = Fingerprint::new(described);
    let parts = root.descendants().filter(|node| {
        let name = node.tag_name().name();
        node.is_element() && ["DataDefinition", "WavelengthData"].iter().any(|known| name.eq_ignore_ascii_case(known))
    });
    for text in parts.flat_map(|part| part.descendants()).filter(|node| node.is_text()).filter_map(|node| node.text()) {
        print.text(text);
    }
    print.finish()
}

/// Returns the description in a file from which its data were computed, or a finding if it does not belong to them.
/// `None` if the file has no description.
pub(super) fn described(root: Node<'_, '_>) -> Option<Result<DescribedState, Finding>> {
    let instruction = root.children().filter_map(|node| node.pi()).find(|pi| pi.target == TARGET)?;
    let value = |key: &str| value(instruction.value.unwrap_or_default(), key);
    let version = value("version").unwrap_or_default();
    if version != VERSION.to_string() {
        let newer = version.parse::<u32>().is_ok_and(|version| version > VERSION);
        let by = if newer { "was written by a newer version of cfs" } else { "has no known version" };
        return Some(Err(not_restored(&format!(
            "<?{TARGET} version=\"{version}\"?> {by}; this program reads {VERSION}"
        ))));
    }
    let stored = (|| {
        let described = DescribedState { text: value("text")?, state: value("state")? };
        Some(StoredDescription { described, fingerprint: value("fingerprint")? })
    })();
    let Some(stored) = stored else { return Some(Err(not_restored("its instruction is not whole"))) };
    let now = fingerprint(root, &stored.described);
    Some(stored.restored(&now))
}

/// Returns the file with the system description of its dataset inserted.
pub(super) fn added(mut xml: String, dataset: &Dataset) -> String {
    let Some(described) = &dataset.described else { return xml };
    // Read as any reader will, so that both count the same numbers.
    let Ok(document) = Document::parse(&xml) else { return xml };
    let root = document.root_element();
    let Some(first) = children(root, "WindowElementType").next() else { return xml };
    let (at, fingerprint) = (first.range().start, fingerprint(root, described));
    let instruction = format!(
        "<?{TARGET} version=\"{VERSION}\" state=\"{}\" fingerprint=\"{fingerprint}\" text=\"{}\"?>\n\t",
        escaped(&described.state),
        escaped(&described.text)
    );
    xml.insert_str(at, &instruction);
    xml
}

/// Whether the dataset's state is that of its system description; BSDF XML itself cannot store the key of a state.
pub(super) fn describes_state(dataset: &Dataset) -> bool {
    dataset.described.as_ref().is_some_and(|described| described.state == dataset.state)
}

fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        // Line ends stay: the text can be read where it stands.
        if (c.is_control() && c != '\n') || "%?<>&\"'".contains(c) || ('\u{fffe}'..='\u{ffff}').contains(&c) {
            let mut bytes = [0; 4];
            c.encode_utf8(&mut bytes).bytes().for_each(|byte| out.push_str(&format!("%{byte:02X}")));
        } else {
            out.push(c);
        }
    }
    out
}

/// Returns the value of a key in the processing instruction, unescaped; `None` if it is missing or malformed.
fn value(instruction: &str, key: &str) -> Option<String> {
    let quoted = instruction.split_once(&format!("{key}=\""))?.1;
    let (text, _) = quoted.split_once('"')?;
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.bytes().filter(|byte| *byte != b'\r');
    while let Some(byte) = rest.next() {
        if byte == b'%' {
            let digits = [rest.next()?, rest.next()?];
            bytes.push(u8::from_str_radix(std::str::from_utf8(&digits).ok()?, 16).ok()?);
        } else {
            bytes.push(byte);
        }
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_text_goes_through_an_instruction() {
        for text in
            ["", "a = \"b\"\n[x]\n", "?> <a> & %3F --> ]]> '", "ψ = 45°\t\r\n\u{1}\u{fffe}", "state=\"0\" text=\"\""]
        {
            let xml = format!("<a><?{TARGET} state=\"{0}\" text=\"{0}\"?></a>", escaped(text));
            let document = Document::parse(&xml).unwrap();
            let pi = document.root_element().first_child().unwrap().pi().unwrap();
            for key in ["state", "text"] {
                assert_eq!(value(pi.value.unwrap(), key).as_deref(), Some(text), "{xml}");
            }
        }
    }
}
