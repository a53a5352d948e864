//! Reading of paths as users type and paste them.

use crate::app::export::start_path;
use crate::app::state::{PathUse, State};
use directories::UserDirs;
use std::path::PathBuf;

/// Returns the path that a text names. Blanks and quotation marks around it are removed; it may be the address of a
/// file (`file:///data/a%20b.xml`) or start from the home folder (`~/a.xml`).
pub fn typed_path(text: &str) -> PathBuf {
    let text = text.trim();
    let quoted = ['"', '\''].into_iter().find_map(|mark| text.strip_prefix(mark)?.strip_suffix(mark));
    let text = quoted.unwrap_or(text);
    if let Some(path) = text.strip_prefix("file://") {
        return of_address(path);
    }
    let rest = text.strip_prefix('~').filter(|rest| rest.is_empty() || rest.starts_with(['/', '\\']));
    match rest.and_then(|rest| Some((rest, UserDirs::new()?))) {
        Some((rest, folders)) => folders.home_dir().join(rest.trim_start_matches(['/', '\\'])),
        None => PathBuf::from(text),
    }
}

/// Returns the path in the address of a file (RFC 8089), given the part after `file://`; percent-encoded bytes are
/// decoded.
fn of_address(address: &str) -> PathBuf {
    let path = address.strip_prefix("localhost").unwrap_or(address);
    let mut bytes = Vec::with_capacity(path.len());
    let mut rest = path.as_bytes();
    while let Some((first, others)) = rest.split_first() {
        let written = others.get(..2).filter(|_| *first == b'%').and_then(|digits| str::from_utf8(digits).ok());
        match written.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = &others[2..];
            }
            None => {
                bytes.push(*first);
                rest = others;
            }
        }
    }
    let path = String::from_utf8_lossy(&bytes).into_owned();
    // A drive comes after the slash: /C:/data.
    let drive = path.strip_prefix('/').filter(|path| path.as_bytes().get(1) == Some(&b':'));
    PathBuf::from(drive.unwrap_or(&path))
}

/// Returns a path that a file is written to, with the extension of the proposed file name added if it has none; paths
/// to read are not changed.
pub fn with_ending(state: &State, what: PathUse, path: PathBuf) -> PathBuf {
    let reads = matches!(what, PathUse::Open | PathUse::ReplaceState | PathUse::Subscribe);
    let proposed = start_path(state, what);
    match proposed.extension() {
        Some(ending) if !reads && path.extension().is_none() && path.file_name().is_some() => {
            path.with_extension(ending)
        }
        _ => path,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::state::Settings;
    use std::path::Path;

    #[test]
    fn paths_are_read_as_they_are_typed_and_pasted() {
        for (text, path) in [
            (" /data/a.xml ", "/data/a.xml"),
            ("\"C:\\data\\my file.xml\"", "C:\\data\\my file.xml"),
            ("'/data/a b.xml'", "/data/a b.xml"),
            ("file:///data/a%20b%C3%A4.xml", "/data/a bä.xml"),
            ("file://localhost/data/100%.xml", "/data/100%.xml"),
            ("file:///C:/data/a.xml", "C:/data/a.xml"),
            ("~other/a.xml", "~other/a.xml"),
            ("it's", "it's"),
            ("\"", "\""),
            ("builtin:renton", "builtin:renton"),
        ] {
            assert_eq!(typed_path(text), Path::new(path), "{text}");
        }
        let home = UserDirs::new().unwrap().home_dir().to_owned();
        assert_eq!(typed_path("~/a.xml"), home.join("a.xml"));
        assert_eq!(typed_path(" \"~/a b.xml\" "), home.join("a b.xml"));
        assert_eq!(typed_path("~"), home);
    }

    #[test]
    fn a_name_to_write_to_gets_its_ending() {
        let state = State::new(Settings::default());
        let of = |what, path: &str| with_ending(&state, what, path.into());
        assert_eq!(of(PathUse::SaveScene, "/data/office"), Path::new("/data/office.toml"));
        assert_eq!(of(PathUse::ExportLid, "/data/office"), Path::new("/data/office.ldt"));
        assert_eq!(of(PathUse::ExportLid, "/data/office.ies"), Path::new("/data/office.ies"));
        assert_eq!(of(PathUse::Open, "/data/folder"), Path::new("/data/folder"));
        assert_eq!(of(PathUse::SaveScene, "/"), Path::new("/"));
    }
}
