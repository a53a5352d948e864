//! Reading of files, folders and archives that were opened or dropped into the window, each by its type.

use super::arranging::{Arranging, of_package};
use super::proposal::{Import, KeptImport};
use crate::app::catalogue::shelf::Shelf;
use crate::app::results::work::{Outcome, ReadDataset};
use crate::app::shell::disk::read_bytes;
use crate::app::shell::error::AppError;
use crate::catalogue::Grouping;
use crate::compute::estimate::Progress;
use crate::formats::control_curve::read_control_curve;
use crate::formats::encoding::decode;
use crate::study::intake::{Single, import_files};
use crate::study::scene_file::SceneFile;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Request to read files.
pub struct Asked {
    /// Paths of the files, folders and archives to read.
    pub paths: Vec<PathBuf>,
    /// Grouping of the files into products.
    pub grouping: Grouping,
    /// Function that reads a dataset file.
    pub read: ReadDataset,
    /// Catalogue in which products with equal data are looked up; `None` before it is open.
    pub shelf: Option<Arc<dyn Shelf>>,
    /// Texts and repairs stored for an earlier import of these files, to be applied again.
    pub kept: Option<KeptImport>,
}

fn text_of(path: &Path, what: &'static str) -> Result<String, AppError> {
    let bytes = read_bytes(path)?;
    let text = decode(&bytes).map_err(|error| AppError::NotText(error, what).about(path.display()))?;
    Ok(text.into_owned())
}

/// Reads a file that is opened directly instead of being imported: a scene, system, weather file or control curve.
fn read_single(single: Single, path: &Path) -> Outcome {
    let about = |error: AppError| error.about(path.display());
    match single {
        Single::System => {
            // Files that the system names are found from its own folder.
            let base = path.parent().map(PathBuf::from).unwrap_or_default();
            Outcome::ReadSystem(text_of(path, "a system").map(|text| (text, base)))
        }
        Single::Scene => {
            let parse = |text: String| SceneFile::parse(&text).map(Box::new).map_err(|error| about(error.into()));
            Outcome::ReadScene(path.to_owned(), text_of(path, "a scene").and_then(parse))
        }
        // Read when it is the scene's: what is wrong with it is said there.
        Single::Weather => Outcome::OpenedWeather(path.to_owned()),
        Single::Curve => Outcome::ReadCurve(
            read_bytes(path).and_then(|bytes| read_control_curve(&bytes).map_err(|error| about(error.into()))),
        ),
    }
}

/// Reads files for the window: datasets and packages become products of an import; of scenes, systems and control
/// curves the first of each is opened; other files are reported.
pub fn read_files(asked: &Asked, progress: &dyn Progress) -> Outcome {
    let taken = import_files(&asked.paths, asked.read, progress);
    // Restored with a session, files opened by themselves are open already: reading them again would undo later
    // changes.
    let singles = taken.singles.iter().filter(|_| asked.kept.is_none());
    let mut list: Vec<Outcome> = singles.map(|(single, path)| read_single(*single, path)).collect();
    let by_hand = asked.kept.as_ref().and_then(|kept| kept.by_hand.clone());
    let answered = asked.kept.as_ref().map(|kept| kept.answered.clone()).unwrap_or_default();
    let mut import = Import {
        paths: asked.paths.clone(),
        grouping: asked.grouping,
        by_hand,
        answered,
        sources: taken.sources.into_iter().map(Arc::new).collect(),
        failures: taken.failures,
        left_out: taken.left_out,
        ..Import::default()
    };
    let packed =
        taken.packed.into_iter().map(|one| of_package(&one.package, one.datasets, one.meta)).collect::<Vec<_>>();
    let arranging = Arranging { shelf: asked.shelf.as_deref(), before: Vec::new(), kept: asked.kept.as_ref() };
    arranging.products(&mut import, packed, progress);
    if list.is_empty() || !(import.products.is_empty() && import.failures.is_empty() && import.left_out.is_empty()) {
        list.push(Outcome::Read(Box::new(import)));
    }
    Outcome::Several(list)
}
