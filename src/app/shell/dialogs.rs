//! File dialogs behind a trait, so that tests can replace them. They run in a job, since some block until the user
//! answers.

use crate::app::shell::error::AppError;
use crate::app::state::PathUse;
use crate::formats::LuminaireFormat;
use crate::texts::{Text, shell};
use std::cell::Cell;
use std::path::{Path, PathBuf};

/// Dialogs that ask the user for paths.
pub trait FileDialogs: Send + Sync {
    /// Asks for files to open; returns an empty list if the user cancels, and an error if no dialog can be shown.
    fn open(&self) -> Result<Vec<PathBuf>, AppError>;
    /// Asks for folders to open; returns an empty list if the user cancels. `title`: title of the dialog.
    fn open_folder(&self, _title: Text) -> Result<Vec<PathBuf>, AppError> {
        Err(AppError::NoDialog)
    }
    /// Asks for a path to write to, with a proposed folder and name; returns `None` if the user cancels. The dialog
    /// asks before a file is replaced.
    fn save(&self, what: PathUse, start: &Path) -> Result<Option<PathBuf>, AppError>;
}

/// File dialogs of the desktop.
pub struct NativeDialogs(());

thread_local! {
    /// Whether the last dialog of this thread could not be shown.
    static REFUSED: Cell<bool> = const { Cell::new(false) };
}

/// Receiver of the dialog library's log messages: only there the library reports that no dialog could be shown; its
/// return value is the same as for a dialog that the user closed.
struct DialogLog;

impl log::Log for DialogLog {
    fn enabled(&self, what: &log::Metadata<'_>) -> bool {
        what.level() == log::Level::Error && what.target().starts_with("rfd")
    }

    fn log(&self, record: &log::Record<'_>) {
        if self.enabled(record.metadata()) && record.args().to_string().contains("zenity") {
            REFUSED.set(true);
        }
    }

    fn flush(&self) {}
}

impl NativeDialogs {
    /// Returns the dialogs of the desktop, and starts to receive the log of their library.
    pub fn listening() -> Self {
        // Where somebody else listens already, a dialog that cannot be shown looks closed.
        if log::set_logger(&DialogLog).is_ok() {
            log::set_max_level(log::LevelFilter::Error);
        }
        Self(())
    }

    /// Shows a dialog and returns the user's choice (`None` if cancelled), or an error if it could not be shown.
    fn shown<T>(dialog: impl FnOnce() -> Option<T>) -> Result<Option<T>, AppError> {
        REFUSED.set(false);
        let chosen = dialog();
        if REFUSED.get() { Err(AppError::NoDialog) } else { Ok(chosen) }
    }
}

impl FileDialogs for NativeDialogs {
    fn open(&self) -> Result<Vec<PathBuf>, AppError> {
        let dialog = rfd::FileDialog::new().set_title(shell::DIALOG_OPEN).add_filter(shell::ALL_FILES, &["*"]);
        Ok(Self::shown(|| dialog.pick_files())?.unwrap_or_default())
    }

    fn open_folder(&self, title: Text) -> Result<Vec<PathBuf>, AppError> {
        let dialog = rfd::FileDialog::new().set_title(title);
        Ok(Self::shown(|| dialog.pick_folders())?.unwrap_or_default())
    }

    fn save(&self, what: PathUse, start: &Path) -> Result<Option<PathBuf>, AppError> {
        let name = start.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let mut dialog = rfd::FileDialog::new().set_title(what.title()).set_file_name(name);
        if let Some(folder) = start.parent().filter(|folder| folder.is_dir()) {
            dialog = dialog.set_directory(folder);
        }
        let dialog = match what {
            PathUse::ExportLid => dialog
                .add_filter(shell::LUMINAIRE_FILES, &LuminaireFormat::ALL.map(|format| &format.extension()[1..]))
                .add_filter(shell::TABLE_OR_DIAGRAM, &["csv", "svg", "png"]),
            PathUse::ExportTile(tile) => {
                dialog.set_title(shell::export_titled(tile.name)).add_filter(shell::NUMBERS, &["csv"])
            }
            PathUse::ExportMeasured => dialog
                .add_filter(shell::PACKAGE_OF_ALL, &["cfsp"])
                .add_filter(shell::BSDF, &["xml"])
                .add_filter(shell::BTDF_TEXT, &["btdf.txt"]),
            PathUse::Export => match start.extension() {
                Some(ending) => dialog.add_filter(shell::EXPORTED_FILES, &[ending.to_string_lossy()]),
                None => dialog,
            },
            PathUse::SaveScene | PathUse::Open | PathUse::ReplaceState | PathUse::Subscribe => {
                dialog.add_filter(shell::SCENE, &["toml"])
            }
        };
        Self::shown(|| dialog.save_file())
    }
}

/// Dialogs that are never shown: the path field is used instead.
pub struct NoDialogs;

impl FileDialogs for NoDialogs {
    fn open(&self) -> Result<Vec<PathBuf>, AppError> {
        Err(AppError::NoDialog)
    }

    fn save(&self, _what: PathUse, _start: &Path) -> Result<Option<PathBuf>, AppError> {
        Err(AppError::NoDialog)
    }
}
