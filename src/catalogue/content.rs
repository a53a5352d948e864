//! Content of a dataset without its texts: identifies the same data under other names and in other files.

use crate::compute::btdf::Dataset;
use crate::formats::dataset_blob::{content_hash, encode_with_wordless};

/// Returns the hash of a dataset's BSDF data and figures, without any of its texts, so that renamed data have the same
/// hash: 64 hexadecimal digits.
pub fn content_of(dataset: &Dataset) -> String {
    let [_, wordless] = encode_with_wordless(dataset);
    content_hash(&wordless)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::btdf::Btdf;

    #[test]
    fn words_do_not_count_and_values_do() {
        let mut sheet = Dataset { name: "A".to_owned(), ..Dataset::default() };
        sheet.visible.transmission_front = Some(Btdf::ideal_diffuse(0.25));
        let renamed = Dataset { name: "B".to_owned(), state: "30".to_owned(), format: "x".to_owned(), ..sheet.clone() };
        assert_eq!(content_of(&sheet), content_of(&renamed));
        let mut darker = sheet.clone();
        darker.visible.transmission_front = Some(Btdf::ideal_diffuse(0.2));
        let mut other_side = sheet.clone();
        other_side.visible.transmission_back = other_side.visible.transmission_front.take();
        assert_ne!(content_of(&sheet), content_of(&darker));
        assert_ne!(content_of(&sheet), content_of(&other_side));
    }
}
