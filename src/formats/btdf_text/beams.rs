//! Extension of the header with the system description that the data were computed from, see [`crate::formats::beams`].
//!
//! ```toml
//! beams = "cfs-beams 1"        # version of the addition
//! system = '''…'''             # text of a .system.toml that names no other files
//! system_state = "45"          # key of the state in it; without: the file's own `state`
//! fingerprint = "…"            # of the numbers, of what they stand for, and of the description
//! ```

use super::header::{Header, Layout, Split, split};
use super::quote::{lines, quoted};
use crate::compute::btdf::{Dataset, DescribedState};
use crate::formats::beams::{Fingerprint, NAME, VERSION};
use crate::formats::location::FormatError;

/// Returns the fingerprint of a file's records, of the header keys that define their meaning, and of the system
/// description.
pub(super) fn fingerprint(header: &Header, body: &str, described: &DescribedState) -> String {
    let mut print = Fingerprint::new(described);
    print.word(header.component.key());
    print.word(match header.layout {
        Layout::Rings => "rings",
        Layout::Points => "points",
    });
    for number in header.rings.iter().flat_map(|(rings, _)| rings).flatten() {
        print.number(*number);
    }
    print.word(header.incidence.word());
    print.word(if header.incident_mean { "mean" } else { "centre" });
    print.word(header.symmetry.map_or("", |symmetry| symmetry.word()));
    for line in body.lines() {
        print.text(line.split_once('#').map_or(line, |(numbers, _)| numbers));
    }
    print.finish()
}

/// Returns the file with the system description of its dataset added to its header.
pub(super) fn added(mut text: String, dataset: &Dataset) -> Result<String, FormatError> {
    let Some(described) = &dataset.described else { return Ok(text) };
    let Split { header, body, .. } = split(&text)?;
    let fingerprint = fingerprint(&header, body, described);
    let mut block = format!("beams = \"{NAME} {VERSION}\"\nsystem = {}\n", lines(&described.text));
    if described.state != dataset.state {
        block.push_str(&format!("system_state = {}\n", quoted(&described.state)));
    }
    block.push_str(&format!("fingerprint = \"{fingerprint}\"\n"));
    let end_of_header = text.len() - body.len() - "---\n".len();
    text.insert_str(end_of_header, &block);
    Ok(text)
}
