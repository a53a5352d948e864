//! Results to files and standard output: whole or not at all.

use anyhow::Context as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// Writes beside the target and renames, so that a full disk or a break leaves no half file.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let mut partial = path.as_os_str().to_owned();
    partial.push(".part");
    let partial = PathBuf::from(partial);
    let result = std::fs::File::create(&partial)
        .and_then(|mut file| file.write_all(bytes))
        .and_then(|()| std::fs::rename(&partial, path));
    if result.is_err() {
        // The first error is the one to report; a part that cannot be removed was never made.
        std::fs::remove_file(&partial).ok();
    }
    result
}

/// [`write_whole`] with the file's name in the error.
pub(super) fn write_file(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    write_whole(path, bytes).map_err(|e| anyhow::anyhow!("{}: cannot be written: {e}", path.display()))
}

/// To standard output; a closed pipe is the reader's choice, not an error.
pub(super) fn print(text: &str) -> anyhow::Result<()> {
    match std::io::stdout().lock().write_all(text.as_bytes()) {
        Err(e) if e.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        other => other.context("standard output"),
    }
}

/// A number with nine significant digits and no trailing zeros.
pub(super) fn number(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}").replace("-0", "0");
    }
    let digits = (8 - value.abs().log10().floor() as i32).clamp(0, 17) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_nine_digits() {
        assert_eq!(number(0.5), "0.5");
        assert_eq!(number(1_234.567_891_23), "1234.56789");
        assert_eq!(number(0.0), "0");
        assert_eq!(number(1.0e-5), "0.00001");
    }
}
