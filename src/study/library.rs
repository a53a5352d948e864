//! The library that programs use: ideal systems, dataset files (kept as long as they do not change), the catalogue.

use super::error::StudyError;
use super::scene_file::{ControlMode, SystemKeys};
use super::system::{System, SystemLibrary, ideal};
use crate::compute::lid::Facing;
use crate::formats::read_dataset;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::SystemTime;

/// Largest dataset file that is read. Makers' largest are tens of megabytes.
const LARGEST_FILE: u64 = 512 << 20;

/// Files and closed forms.
#[derive(Default)]
pub struct Library {
    files: Mutex<HashMap<PathBuf, (SystemTime, u64, Vec<Arc<System>>)>>,
}

impl Library {
    /// All states of a dataset file.
    pub fn load_file(&self, path: &Path) -> Result<Vec<Arc<System>>, StudyError> {
        let error = |message: String| StudyError::File { path: path.to_owned(), message };
        let meta = std::fs::metadata(path).map_err(|e| error(format!("cannot be read: {e}")))?;
        let stamp = (meta.modified().unwrap_or(SystemTime::UNIX_EPOCH), meta.len());
        let mut files = self.files.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((time, length, systems)) = files.get(path)
            && (*time, *length) == stamp
        {
            return Ok(systems.clone());
        }
        if meta.len() > LARGEST_FILE {
            return Err(error(format!(
                "{} MB; datasets of up to {} MB are read",
                meta.len() >> 20,
                LARGEST_FILE >> 20
            )));
        }
        let bytes = std::fs::read(path).map_err(|e| error(format!("cannot be read: {e}")))?;
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let systems: Vec<Arc<System>> = read_dataset(&name, &bytes)
            .map_err(|e| error(e.to_string()))?
            .into_iter()
            .map(|dataset| {
                let label = if dataset.name.is_empty() { name.clone() } else { dataset.name.clone() };
                Arc::new(System { label, state: dataset.state.clone(), dataset: Arc::new(dataset) })
            })
            .collect();
        files.insert(path.to_owned(), (stamp.0, stamp.1, systems.clone()));
        Ok(systems)
    }
}

impl SystemLibrary for Library {
    fn load(&self, keys: &SystemKeys, base: &Path) -> Result<Arc<System>, StudyError> {
        match keys {
            SystemKeys::Ideal { kind, transmittance } => ideal(*kind, *transmittance),
            SystemKeys::File { path, state } => {
                let systems = self.load_file(&base.join(path))?;
                pick(&systems, state.as_deref(), &path.display().to_string())
            }
            SystemKeys::Catalogue { key, .. } => Err(StudyError::Catalogue(format!("no product '{key}'"))),
        }
    }

    fn controlled_state(&self, product: &str, _mode: ControlMode, _facing: &Facing<'_>) -> Result<String, StudyError> {
        Err(StudyError::Catalogue(format!("no product '{product}'")))
    }
}

fn pick(systems: &[Arc<System>], state: Option<&str>, name: &str) -> Result<Arc<System>, StudyError> {
    let found = match state {
        None => systems.first(),
        Some(state) => systems.iter().find(|system| system.state == state),
    };
    found.cloned().ok_or_else(|| {
        let states: Vec<&str> = systems.iter().map(|system| system.state.as_str()).collect();
        StudyError::key(
            "system.state",
            format!("{name} has no state '{}'; it has: {}", state.unwrap_or_default(), states.join(", ")),
        )
    })
}
