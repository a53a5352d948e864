//! Internal errors in the window: the open session is saved first, then a report is written, then the error is shown.
//!
//! After an internal error in a job only its result is missing. One on the window's thread ends the program: the
//! session of the previous frame is on disk by then, and the next start shows a message with the path of the report.

use super::autosave::Autosave;
use super::error::{AppError, JobError};
use super::lane::Lane;
use super::window::App;
use crate::study::fault::{self, Fault, Report};
use crate::texts::shell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

/// Titles of sections in the report on an internal error, not translated.
const SCENE: &str = "scene";
const SYSTEM: &str = "system";

impl App {
    /// Sets the folder to which reports on internal errors are written.
    pub fn report_faults(&mut self, folder: Option<&Path>) {
        self.faults.folder = folder.map(Path::to_path_buf);
    }

    /// Shows a message about a job that ended without a result because of an internal error, and writes a report.
    /// `stage`: stage of the job at its end.
    pub(super) fn take_failure(&mut self, lane: Lane, stage: &'static str, error: JobError) {
        let text = format!("{}: {error}", lane.word());
        match &error {
            JobError::Panic(fault) => {
                self.save_now();
                match self.report(fault, &format!("{}, {stage}", lane.word().english())) {
                    Some(Ok(path)) => self.toasts.fault(shell::reported(&text, path.display()), path),
                    Some(Err(error)) => self.toasts.error(shell::not_reported(&text, error)),
                    None => self.toasts.error(text.clone()),
                }
            }
            JobError::NoThread(_) => self.toasts.error(text.clone()),
        }
        match lane {
            Lane::Lid => self.results.lid.error = Some(text),
            Lane::Room => self.results.room.error = Some(text),
            Lane::Surfaces => self.results.surfaces.error = Some(text),
            Lane::DataForm => self.results.form.error = Some(text),
            Lane::Schemes => self.results.schemes.error = Some(text),
            Lane::Accuracy => self.results.accuracy.error = Some(text),
            Lane::Obstructions => self.results.obstructions.error = Some(text),
            Lane::Goniophotometer => self.state.goniophotometer.failure = Some(text),
            Lane::Year => self.results.year.error = Some(text),
            Lane::Catalogue => self.state.search_error = Some(text),
            Lane::Scene => self.state.dataset.error = Some(text),
            Lane::Product => {
                self.state.computing = None;
                self.state.dataset.error = Some(text);
            }
            Lane::Compare => self.compare.fail(text),
            Lane::Arrange => self.stop_arranging(),
            Lane::Import => self.state.under_way = None,
            Lane::Preview => {
                self.state.export.revision += 1;
                self.state.export.shown = Some(Err(text));
            }
            // Only where nothing else waits is it sure whose fault it was.
            Lane::Store if self.pending_changes.is_empty() => {
                self.state.under_way = None;
                let numbers: Vec<usize> = self.adding.iter().copied().collect();
                if !numbers.is_empty() {
                    self.take_not_added(&numbers, &AppError::Job(error));
                }
            }
            // What asks in every frame would fail in every frame.
            Lane::Findings => self.state.sheet = None,
            Lane::Gallery => self.state.settings.gallery = false,
            _ => {}
        }
    }

    /// Saves the session at once; returns when it is on disk or cannot be written.
    fn save_now(&mut self) {
        self.keep_session();
        if let Some(keeper) = &self.autosave {
            keeper.write_now();
        }
    }

    /// Writes the report on an internal error, or finds an earlier report on the same one, and returns its path; `None`
    /// if there is no folder for reports. `doing`: action of the window at that time.
    fn report(&mut self, fault: &Fault, doing: &str) -> Option<Result<PathBuf, AppError>> {
        let folder = self.faults.folder.clone()?;
        if let Some((_, path)) = self.faults.reported.iter().find(|(other, path)| other.is_same(fault) && path.exists())
        {
            return Some(Ok(path.clone()));
        }
        let mut open = Vec::new();
        if let Ok(scene) = toml::to_string(&self.state.document.scene) {
            open.push((SCENE.to_owned(), scene));
        }
        if !self.state.goniophotometer.text.is_empty() {
            open.push((SYSTEM.to_owned(), self.state.goniophotometer.text.clone()));
        }
        let report = Report { doing, steps: &self.steps.lines(), open: &open };
        let written = fault::write(&folder, fault, &report);
        if let Ok(path) = &written {
            self.faults.reported.push((fault.clone(), path.clone()));
        }
        Some(written.map_err(AppError::Study))
    }

    /// Handles an internal error on the window's thread, before the program ends: saves the session and writes the
    /// report.
    fn end_at_fault(&mut self) {
        let keeper = self.autosave.take();
        // What is open was kept when the last frame ended; what this one has made of it is not to be trusted.
        if let Some(keeper) = &keeper {
            keeper.write_now();
        }
        let fault = fault::newest().unwrap_or_default();
        let doing =
            self.jobs.views().iter().fold("window".to_owned(), |text, job| text + "; " + job.lane.word().english());
        let report = self.report(&fault, &doing).and_then(Result::ok);
        if let Some(path) = &report {
            fault::reported(&fault, path.clone());
        }
        if let Some(keeper) = keeper {
            Autosave::end_at_fault(keeper, report);
        }
    }

    /// Copies a report to the clipboard, so that it can be sent.
    pub(super) fn copy_report(&mut self, path: &Path) {
        match super::disk::read_bytes(path) {
            Ok(bytes) => {
                self.ctx.copy_text(String::from_utf8_lossy(&bytes).into_owned());
                self.toasts.success(shell::REPORT_COPIED);
            }
            Err(error) => self.report_error(&error),
        }
    }
}

impl Drop for App {
    fn drop(&mut self) {
        if std::thread::panicking() {
            // A second fault here would end the program before it has said anything.
            drop(catch_unwind(AssertUnwindSafe(|| self.end_at_fault())));
        }
    }
}
