//! Panics of the program on the command line: one sentence on standard error, a report file, and a separate exit
//! status.

use crate::study::fault::{self, Fault, Report, without_folders};
use crate::study::files;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// Maximum size of a scene or description that a report repeats. \[bytes\]
const LARGEST: u64 = 1 << 16;

/// Internal error (panic) that stopped the program; contains the sentence that reports it.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Stopped(String);

/// Runs `work` and converts a panic in it, in any thread, into an error. Incomplete output files are removed, and a
/// report is written to the folder `reports`, if there is one.
///
/// # Errors
/// Returns the error of `work`, or [`Stopped`] after a panic.
pub fn guarded(reports: Option<&Path>, work: impl FnOnce() -> anyhow::Result<()>) -> anyhow::Result<()> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| {
        let fault = fault::caught(&*panic);
        Err(Stopped(sentence(&fault, left(&fault, reports))).into())
    })
}

/// Returns the part of the message that names the report about a panic: the report of the window if it has written one,
/// else a new one.
fn left(fault: &Fault, reports: Option<&Path>) -> String {
    if let Some(report) = &fault.report {
        return format!(
            "the session is kept for the next start, and a report that can be sent is in {}",
            report.display()
        );
    }
    let arguments: Vec<String> =
        std::env::args_os().skip(1).map(|one| without_folders(&one.to_string_lossy())).collect();
    let doing = if arguments.is_empty() { "the window".to_owned() } else { format!("cfs {}", arguments.join(" ")) };
    let report = Report { doing: &doing, open: &inputs(), ..Report::default() };
    match reports.map(|folder| fault::write(folder, fault, &report)) {
        Some(Ok(path)) => format!("a report that can be sent is in {}", path.display()),
        Some(Err(error)) => format!("the report could not be written: {error}"),
        None => "no report is written, since the system names no folder for user data".to_owned(),
    }
}

/// Returns name and text of the scenes and system descriptions that were read, for the report; without those above
/// `LARGEST`.
fn inputs() -> Vec<(String, String)> {
    let small = |path: &Path| std::fs::metadata(path).is_ok_and(|meta| meta.is_file() && meta.len() <= LARGEST);
    let texts = files::inputs()
        .into_iter()
        .filter(|path| path.extension().is_some_and(|ending| ending == "toml") && small(path));
    texts
        .filter_map(|path| {
            let name = path.file_name()?.to_string_lossy().into_owned();
            // Bytes that are not text may be the cause of the fault.
            Some((name, String::from_utf8_lossy(&std::fs::read(&path).ok()?).into_owned()))
        })
        .collect()
}

fn sentence(fault: &Fault, left: String) -> String {
    let place = if fault.place.is_empty() { String::new() } else { format!(" at {}", fault.place) };
    format!("internal error{place}: {}; {left}", fault.message)
}
