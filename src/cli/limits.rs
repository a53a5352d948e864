//! `cfs limits`: table of the limits of files, scenes and computations.

use super::output::print;
use crate::compute::limits::TABLE;
use std::fmt::Write as _;

/// Prints one line per limit: its value with unit, and what it limits.
///
/// # Errors
/// Returns an error if standard output cannot be written.
pub(super) fn run() -> anyhow::Result<()> {
    let mut text = String::new();
    for limit in TABLE {
        writeln!(text, "{limit}")?;
    }
    print(&text)
}
