//! Kinds of files that the program writes, recognised by their bytes, so that a file of another kind is not overwritten
//! by mistake.

use super::encoding::any_text;
use super::{Format, LuminaireFormat, dataset_blob, luminaire_index, package, weather};

/// Kind of file that the program writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// CSV table: values separated by commas, with a header line.
    Csv,
    /// Results in JSON.
    Json,
    /// Comparison of candidates as plain text.
    Comparison,
    /// Drawing as SVG.
    Svg,
    /// Drawing in pixels (PNG).
    Png,
    /// Report (PDF).
    Pdf,
    /// Luminaire file.
    Luminaire(LuminaireFormat),
    /// Scene (.toml).
    Scene,
    /// Dataset in one of the exchange formats.
    Dataset(Format),
    /// Dataset in compact form (.cfsd).
    Compact,
    /// Package of products (.cfsp).
    Package,
}

/// Number of bytes at the beginning of a file by which its kind is recognised.
pub const HEAD: u64 = 1 << 20;

impl FileKind {
    /// Returns the name of the kind with its article, for messages, e.g. "a CSV table".
    pub const fn words(self) -> &'static str {
        match self {
            Self::Csv => "a CSV table",
            Self::Json => "JSON",
            Self::Comparison => "a table of figures",
            Self::Svg => "an SVG picture",
            Self::Png => "a PNG picture",
            Self::Pdf => "a PDF document",
            Self::Luminaire(format) => format.words(),
            Self::Scene => "a scene",
            Self::Dataset(format) => format.name(),
            Self::Compact => "a compact dataset (.cfsd)",
            Self::Package => "a package (.cfsp)",
        }
    }

    /// Whether files of this kind are text, which can be shown in a terminal.
    pub const fn is_text(self) -> bool {
        !matches!(self, Self::Png | Self::Pdf | Self::Compact | Self::Package)
    }

    /// Whether bytes can be a file of this kind, judged by the first [`HEAD`] of them.
    pub fn may_be(self, head: &[u8]) -> bool {
        let holds = |word: &str| head.windows(word.len()).any(|window| window == word.as_bytes());
        match self {
            Self::Png => head.starts_with(b"\x89PNG"),
            Self::Pdf => head.starts_with(b"%PDF-"),
            Self::Compact => head.starts_with(dataset_blob::MAGIC),
            // Other archives have other entries.
            Self::Package => head.starts_with(package::MAGIC) && (holds("manifest.json") || holds("datasets/")),
            Self::Dataset(format) => Format::sniff("", head) == Some(format),
            Self::Luminaire(format) => format.may_be(head),
            Self::Svg => text(head).is_some_and(|text| text.contains("<svg")),
            Self::Json => text(head).is_some_and(is_json),
            Self::Csv => text(head).is_some_and(|text| !is_json(text) && is_csv(text)),
            Self::Scene => text(head).is_some_and(|text| text.lines().any(|line| line.trim() == "[[aperture]]")),
            Self::Comparison => text(head).is_some_and(|text| text.lines().any(|line| line.starts_with("figure "))),
        }
    }
}

/// Returns the file name extension, with its dot, for bytes from an input without a name; an empty text if they are not
/// of a kind that the program reads.
pub fn extension_of(bytes: &[u8]) -> &'static str {
    let head = &bytes[..bytes.len().min(HEAD as usize)];
    let of_kind = [
        (FileKind::Compact, ".cfsd"),
        (FileKind::Package, ".cfsp"),
        (FileKind::Dataset(Format::BsdfXml), ".xml"),
        (FileKind::Dataset(Format::BtdfText), ".btdf.txt"),
    ];
    if let Some((_, extension)) = of_kind.iter().find(|(kind, _)| kind.may_be(head)) {
        return extension;
    }
    if let Some(format) = LuminaireFormat::ALL.into_iter().find(|format| format.may_be(head)) {
        return format.extension();
    }
    if package::looks_like_package(bytes) {
        return ".zip";
    }
    let (text, _) = any_text(head);
    if let Some(extension) = weather::extension_of(&text) {
        return extension;
    }
    if luminaire_index::read(bytes).is_ok() {
        return ".index.csv";
    }
    match text.parse::<toml::Table>() {
        Ok(table) if table.contains_key("kind") => ".system.toml",
        Ok(table) if !table.is_empty() => ".toml",
        _ => "",
    }
}

/// Returns the bytes as UTF-8 text, without a character that is cut off at the end; `None` if they are not UTF-8.
fn text(head: &[u8]) -> Option<&str> {
    let head = head.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(head);
    let text = match std::str::from_utf8(head) {
        Ok(text) => text,
        Err(error) if error.error_len().is_none() => std::str::from_utf8(&head[..error.valid_up_to()]).ok()?,
        Err(_) => return None,
    };
    (!text.contains('\0')).then_some(text)
}

fn is_json(text: &str) -> bool {
    let Some(rest) = text.trim_start().strip_prefix(['{', '[']) else { return false };
    // A table of TOML is a word in brackets.
    rest.trim_start().starts_with(['"', '{', '}', ']'])
}

/// Whether a text is CSV: several lines with as many fields as the first one.
fn is_csv(text: &str) -> bool {
    // The last line may be cut.
    let whole = text.rfind('\n').map_or(text, |end| &text[..end]);
    let named = |record: &csv::StringRecord| {
        record.len() > 1
            && record.iter().all(|name| !name.contains('='))
            && record.iter().any(|name| name.contains(char::is_alphabetic))
    };
    b",;".iter().any(|delimiter| {
        let mut builder = csv::ReaderBuilder::new();
        let mut reader = builder.has_headers(false).delimiter(*delimiter).from_reader(whole.as_bytes());
        let mut records = reader.records();
        records.next().is_some_and(|first| first.is_ok_and(|first| named(&first)))
            && records.take(100).all(|one| one.is_ok())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = "# office\n[site]\nlatitude = 48.0\n\n[[aperture]]\nsize = [1.0, 2.0]\n";
    const TABLE: &str = "x,y,\"E, lx\"\n1,2,3\n4,5,6\n";

    #[test]
    fn what_takes_the_place_of_what() {
        let files: [(FileKind, &[u8]); 8] = [
            (FileKind::Csv, TABLE.as_bytes()),
            (FileKind::Json, b"{\"a\": [1, 2]}\n"),
            (FileKind::Svg, b"<?xml version=\"1.0\"?>\n<svg xmlns=\"\"></svg>"),
            (FileKind::Png, b"\x89PNG\r\n\x1a\n"),
            (FileKind::Pdf, b"%PDF-1.7\n"),
            (FileKind::Luminaire(LuminaireFormat::ALL[1]), b"IESNA:LM-63-2002\n"),
            (FileKind::Dataset(Format::BsdfXml), b"<?xml version=\"1.0\"?>\n<WindowElement></WindowElement>"),
            (FileKind::Compact, b"CFSD...."),
        ];
        for (kind, _) in &files {
            let taken: Vec<FileKind> =
                files.iter().filter(|(_, bytes)| kind.may_be(bytes)).map(|(one, _)| *one).collect();
            assert_eq!(taken, [*kind]);
            assert!(!kind.may_be(SCENE.as_bytes()), "{kind:?}");
        }
    }

    #[test]
    fn input_without_a_name_is_recognised_by_its_content() {
        let index = b"file,x,y,z,width,height,flux_lm\na_1.ldt,1,0,2,1,1,500\n";
        let files: [(&[u8], &str); 9] = [
            (SCENE.as_bytes(), ".toml"),
            (b"# Opal\nname = \"Opal\"\nkind = \"diffuser\"\n", ".system.toml"),
            (b"LOCATION,Somewhere,-,Land", ".epw"),
            (b"\xef\xbb\xbfplace Somewhere\nlatitude 48", ".wea"),
            (index, ".index.csv"),
            (b"<?xml version=\"1.0\"?>\n<WindowElement></WindowElement>", ".xml"),
            (b"IESNA:LM-63-2002\n", ".ies"),
            (b"PK\x03\x04 another archive", ".zip"),
            (TABLE.as_bytes(), ""),
        ];
        for (bytes, extension) in files {
            assert_eq!(extension_of(bytes), extension, "{}", String::from_utf8_lossy(bytes));
        }
    }

    #[test]
    fn a_cut_table_is_one_and_prose_is_none() {
        assert!(FileKind::Csv.may_be(&TABLE.as_bytes()[..TABLE.len() - 3]));
        assert!(FileKind::Csv.may_be(&super::super::decimal_comma::with_decimal_commas(TABLE)));
        assert!(!FileKind::Csv.may_be(b"Dear colleague,\nhere are, as asked, the numbers.\n"));
        assert!(!FileKind::Csv.may_be(b"a = 1,2\n"));
        assert!(!FileKind::Csv.may_be(b""));
        assert!(!FileKind::Package.may_be(b"PK\x03\x04 another archive"));
    }
}
