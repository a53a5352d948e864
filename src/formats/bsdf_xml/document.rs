//! Parsing of XML files into trees of limited size and depth: encodings, junk before the declaration, positions of
//! errors.

use crate::compute::btdf::Finding;
use crate::formats::encoding::{self, Encoding, NotText};
use crate::formats::location::{FormatError, Location, excerpt};
use roxmltree::{Document, Node, ParsingOptions};

/// Maximum nesting of elements; makers' files have 7 levels.
const MAX_DEPTH: usize = 64;
/// Maximum number of XML nodes, more than any dataset needs, few enough to stay small in memory.
const MAX_NODES: u32 = 200_000;
/// Maximum number of attributes on one element, more than any file has; their names are compared pair by pair.
const MAX_ATTRIBUTES: usize = 64;
/// Number of bytes at the beginning of a file that are searched for an XML declaration.
const MAX_JUNK: usize = 65_536;

/// Text of an XML file, from the beginning of the XML on.
pub(super) struct Source {
    text: String,
    /// Number of line breaks in the junk that was cut off.
    lines_before: usize,
}

impl Source {
    /// Decodes a file and removes junk before the XML; refuses a web page and anything that is not XML or is nested too
    /// deeply.
    pub(super) fn new(bytes: &[u8], findings: &mut Vec<Finding>) -> Result<Self, FormatError> {
        if bytes.is_empty() {
            return Err(FormatError::new(Location::file(), "an empty file", "a BSDF XML file"));
        }
        let text = decode(bytes, findings)?;
        let Some(start) = start_of_xml(&text) else {
            return Err(FormatError::new(
                Location::byte(0),
                format!("not XML (begins with '{}')", excerpt(text.get(..80).unwrap_or(&text))),
                "'<?xml' or '<WindowElement'",
            ));
        };
        let junk = &text[..start];
        if !junk.trim().is_empty() {
            findings.push(Finding::info(
                "junk-before-xml",
                format!("{start} bytes before the XML declaration were skipped ('{}').", excerpt(junk)),
            ));
        }
        let lines_before = junk.matches('\n').count();
        let text = if start == 0 { text } else { text[start..].to_owned() };
        let source = Self { text, lines_before };
        source.check_depth()?;
        Ok(source)
    }

    /// Parses the text into an XML tree.
    pub(super) fn parse(&self) -> Result<Document<'_>, FormatError> {
        let options = ParsingOptions { allow_dtd: false, nodes_limit: MAX_NODES, ..ParsingOptions::default() };
        Document::parse_with_options(&self.text, options).map_err(|error| {
            let at = error.pos();
            let at = Location::line_column(at.row as usize + self.lines_before, at.col as usize);
            match error {
                roxmltree::Error::DtdDetected => FormatError::new(
                    Location::line(1 + self.lines_before),
                    "a document type declaration (entities are not expanded)",
                    "XML without <!DOCTYPE …>",
                ),
                roxmltree::Error::NodesLimitReached => FormatError::new(
                    Location::file(),
                    format!("more than {MAX_NODES} XML nodes"),
                    "a BSDF file, which has some hundred",
                ),
                roxmltree::Error::UnexpectedEndOfStream | roxmltree::Error::UnclosedRootNode => FormatError::new(
                    Location::line(self.text.lines().count() + self.lines_before),
                    "unexpected end of the XML (truncated file)",
                    "closing tags up to </WindowElement>",
                ),
                other => FormatError::new(at, format!("not well-formed XML ({other})"), "well-formed XML"),
            }
        })
    }

    /// Returns the position of a node in the file: line, column and name.
    pub(super) fn place(&self, node: Node<'_, '_>) -> Location {
        self.line_of(node.range().start).in_element(format!("<{}>", node.tag_name().name()))
    }

    /// Returns the line of a byte offset of the text.
    fn line_of(&self, byte: usize) -> Location {
        let before = self.text.as_bytes().get(..byte).unwrap_or_default();
        Location::line(1 + before.iter().filter(|b| **b == b'\n').count() + self.lines_before)
    }

    /// Checks the depth of nesting before the text is given to a recursive parser.
    fn check_depth(&self) -> Result<(), FormatError> {
        let bytes = self.text.as_bytes();
        let (mut depth, mut at) = (0_usize, 0);
        while let Some(found) = bytes[at..].iter().position(|b| *b == b'<') {
            let open = at + found;
            let rest = &bytes[open + 1..];
            // Comments and CDATA may hold tags that are none.
            let skip_to: Option<&[u8]> = if rest.starts_with(b"!--") {
                Some(b"-->")
            } else if rest.starts_with(b"![CDATA[") {
                Some(b"]]>")
            } else {
                None
            };
            let end: &[u8] = skip_to.unwrap_or(b">");
            let length = match skip_to {
                Some(end) => rest.windows(end.len()).position(|window| window == end),
                None => {
                    let (end, attributes) = end_of_tag(rest);
                    if attributes > MAX_ATTRIBUTES {
                        return Err(FormatError::new(
                            self.line_of(open),
                            format!("an element with more than {MAX_ATTRIBUTES} attributes"),
                            "the few attributes of a BSDF file",
                        ));
                    }
                    end
                }
            };
            let Some(length) = length else {
                return Ok(()); // Unclosed: the parser says so with its place.
            };
            if skip_to.is_none() {
                match rest.first() {
                    Some(b'/') => depth = depth.saturating_sub(1),
                    Some(b'?' | b'!') => {}
                    _ if length > 0 && rest[length - 1] == b'/' => {}
                    _ => depth += 1,
                }
                if depth > MAX_DEPTH {
                    return Err(FormatError::new(
                        self.line_of(open),
                        format!("elements nested more than {MAX_DEPTH} deep"),
                        "the 7 levels of a BSDF file",
                    ));
                }
            }
            at = open + 1 + length + end.len();
        }
        Ok(())
    }
}

/// Returns the position of a tag's '>', past quoted attribute values that may contain one, and the number of values
/// (counted only as far as needed to refuse them).
fn end_of_tag(rest: &[u8]) -> (Option<usize>, usize) {
    let (mut quote, mut attributes) = (None, 0);
    let end = rest.iter().position(|&byte| {
        match (quote, byte) {
            (None, b'>') => return true,
            (None, b'"' | b'\'') => {
                quote = Some(byte);
                attributes += 1;
            }
            (Some(open), _) if open == byte => quote = None,
            _ => {}
        }
        attributes > MAX_ATTRIBUTES
    });
    (end, attributes)
}

/// Decodes text, with a finding where a file that does not declare Latin-1 is not UTF-8.
fn decode(bytes: &[u8], findings: &mut Vec<Finding>) -> Result<String, FormatError> {
    let text = match encoding::decode(bytes) {
        Ok(text) => text.into_owned(),
        // Junk before the XML may be of any bytes.
        Err(NotText { encoding: Encoding::Binary, .. }) => encoding::any_text(bytes).0,
        Err(error) => return Err(error.into()),
    };
    let declaration = text.chars().take(200).collect::<String>().to_ascii_lowercase();
    if !["iso-8859-1", "windows-1252"].iter().any(|name| declaration.contains(name)) {
        findings.extend(encoding::repaired(bytes));
    }
    Ok(text)
}

fn start_of_xml(text: &str) -> Option<usize> {
    let mut limit = text.len().min(MAX_JUNK);
    while !text.is_char_boundary(limit) {
        limit -= 1;
    }
    let head = &text[..limit];
    if let Some(start) = head.find("<?xml").or_else(|| head.find("<WindowElement")) {
        return Some(start);
    }
    // Any other XML: let the parser and the check of the root element judge it.
    let trimmed = text.trim_start();
    let tag = trimmed.strip_prefix('<')?;
    tag.starts_with(|c: char| c.is_alphabetic() || c == '!' || c == '_').then(|| text.len() - trimmed.len())
}

/// Returns the first child element with the given name, in any namespace and any case.
pub(super) fn child<'a, 'd>(node: Node<'a, 'd>, name: &str) -> Option<Node<'a, 'd>> {
    children(node, name).next()
}

/// Returns the child elements with the given name, in any namespace and any case.
pub(super) fn children<'a, 'd>(node: Node<'a, 'd>, name: &str) -> impl Iterator<Item = Node<'a, 'd>> {
    let name = name.to_owned();
    node.children().filter(move |n| n.is_element() && n.tag_name().name().eq_ignore_ascii_case(&name))
}

/// Returns all text directly inside an element (with CDATA, without comments), trimmed.
pub(super) fn text(node: Node<'_, '_>) -> String {
    let parts: Vec<&str> = node.children().filter(|n| n.is_text()).filter_map(|n| n.text()).collect();
    parts.concat().trim().to_owned()
}

/// Returns the trimmed text of the first child element with the given name; empty when there is none.
pub(super) fn child_text(node: Node<'_, '_>, name: &str) -> String {
    child(node, name).map(text).unwrap_or_default()
}

/// Returns a text for use as the content of an XML element: without control characters, with markup escaped.
pub(super) fn escaped(text: &str) -> String {
    let clean: String = text.chars().filter(|c| !c.is_control()).collect();
    clean.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
