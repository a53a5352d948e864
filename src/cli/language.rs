//! Language of exported pictures and reports (`--language`); all other output of the command line is English.

use crate::texts::Language;
use std::str::FromStr;

/// Language of an exported picture or report, `en` or `de` on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ReportLanguage(pub Language);

impl FromStr for ReportLanguage {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "en" => Ok(Self(Language::English)),
            "de" => Ok(Self(Language::German)),
            _ => Err("no language of reports; expected en or de".to_owned()),
        }
    }
}
