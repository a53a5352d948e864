//! Internal errors in the window: the open session is saved first, then a report is written, then the error is shown.
//!
//! After an internal error in a job only its result is missing. One on the window's thread ends the program: the
//! session of the previous frame is on disk by then, and the next start shows a message with the path of the report.

use super::autosave::Autosave;
use super::{Content, Session};
use crate::app::shell::Shell;
use crate::app::shell::disk::read_bytes;
use crate::app::shell::error::AppError;
use crate::app::shell::jobs::JobView;
use crate::study::fault::{self, Fault, Report};
use crate::texts::shell;
use std::path::{Path, PathBuf};

/// Titles of sections in the report on an internal error, not translated.
const SCENE: &str = "scene";
const SYSTEM: &str = "system";

impl Session {
    /// Sets the folder to which reports on internal errors are written.
    pub fn report_faults(&mut self, folder: Option<&Path>) {
        self.faults.folder = folder.map(Path::to_path_buf);
    }

    /// Writes the report on an internal error, or finds an earlier report on the same one, and returns its path; `None`
    /// if there is no folder for reports. `doing`: action of the window at that time.
    pub fn report(&mut self, fault: &Fault, doing: &str, content: Content<'_>) -> Option<Result<PathBuf, AppError>> {
        let folder = self.faults.folder.clone()?;
        if let Some((_, path)) = self.faults.reported.iter().find(|(other, path)| other.is_same(fault) && path.exists())
        {
            return Some(Ok(path.clone()));
        }
        let mut open = Vec::new();
        if let Ok(scene) = toml::to_string(&content.state.document.scene) {
            open.push((SCENE.to_owned(), scene));
        }
        let system = content.goniophotometer.text();
        if !system.is_empty() {
            open.push((SYSTEM.to_owned(), system.to_owned()));
        }
        let report = Report { doing, steps: &self.steps.lines(), open: &open };
        let written = fault::write(&folder, fault, &report);
        if let Ok(path) = &written {
            self.faults.reported.push((fault.clone(), path.clone()));
        }
        Some(written.map_err(AppError::Study))
    }

    /// Handles an internal error on the window's thread, before the program ends: saves the session and writes the
    /// report. `jobs`: jobs that are running.
    pub fn end_at_fault(&mut self, jobs: &[JobView], content: Content<'_>) {
        let keeper = self.autosave.take();
        // What is open was kept when the last frame ended; what this one has made of it is not to be trusted.
        if let Some(keeper) = &keeper {
            keeper.write_now();
        }
        let fault = fault::newest().unwrap_or_default();
        let doing = jobs.iter().fold("window".to_owned(), |text, job| text + "; " + job.lane.word().english());
        let report = self.report(&fault, &doing, content).and_then(Result::ok);
        if let Some(path) = &report {
            fault::reported(&fault, path.clone());
        }
        if let Some(keeper) = keeper {
            Autosave::end_at_fault(keeper, report);
        }
    }
}

/// Copies a report to the clipboard, so that it can be sent.
pub fn copy_report(shell: &mut Shell, path: &Path) {
    match read_bytes(path) {
        Ok(bytes) => {
            shell.ctx.copy_text(String::from_utf8_lossy(&bytes).into_owned());
            shell.toasts.success(shell::REPORT_COPIED);
        }
        Err(error) => shell.report_error(&error),
    }
}
