//! Results to standard output, and how numbers read.

use anyhow::Context as _;
use std::io::Write as _;

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
