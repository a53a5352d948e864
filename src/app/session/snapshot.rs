//! Session of a window: scene, selection, import and settings as stored on disk while the window is open, and restored
//! at the next start.

use super::error::SessionError;
use crate::app::goniophotometer::Goniophotometer;
use crate::app::import::Imports;
use crate::app::import::proposal::KeptImport;
use crate::app::scene::Selection;
use crate::app::state::{Settings, Sheet, State};
use crate::app::tiles::TILES;
use crate::study::scene_file::SceneFile;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Version of the file layout of a stored session. Sessions of a newer version are not read.
const VERSION: u32 = 1;

/// Internal error that ended the program while this session was open.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct KeptFault {
    /// Number of consecutive times that the program ended so, each soon after the session had been restored.
    pub times: u32,
    /// Path of the report on the last of these errors.
    pub report: Option<PathBuf>,
}

/// System file that is being typed in the editor of the virtual goniophotometer.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct KeptSystem {
    /// Text of the system file.
    pub text: String,
    /// Folder to which file names in the text are relative.
    pub base: PathBuf,
}

/// Parts of a window that a session stores.
#[derive(Clone, Copy)]
pub struct Content<'a> {
    /// State of the window.
    pub state: &'a State,
    /// Imports, with drafts.
    pub imports: &'a Imports,
    /// Virtual goniophotometer, with the text that is being typed.
    pub goniophotometer: &'a Goniophotometer,
}

/// Parts of a new window in which a session is restored.
pub struct ContentMut<'a> {
    /// State of the window.
    pub state: &'a mut State,
    /// Imports.
    pub imports: &'a mut Imports,
    /// Virtual goniophotometer.
    pub goniophotometer: &'a mut Goniophotometer,
}

/// Snapshot of the session of a window.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Snapshot {
    scene: SceneText,
    selection: Selection,
    scene_path: Option<PathBuf>,
    maximised: Option<&'static str>,
    import: Option<KeptImport>,
    drafts: Vec<KeptImport>,
    system: KeptSystem,
    sheet: Option<&'static str>,
    settings: Settings,
}

/// Scene of a snapshot, which is converted to text only when it is written.
#[derive(Debug, Clone, PartialEq, Default)]
struct SceneText(Option<Box<SceneFile>>);

/// Side panels that are opened again with a session, with their keys in the file.
const SHEETS: [(Sheet, &str); 2] = [(Sheet::Import, "import"), (Sheet::Goniophotometer, "goniophotometer")];

fn sheet_word(sheet: Option<Sheet>) -> Option<&'static str> {
    SHEETS.iter().find(|(known, _)| Some(*known) == sheet).map(|(_, word)| *word)
}

impl Snapshot {
    /// Creates a snapshot of the current content of a window.
    pub fn of(Content { state, imports, goniophotometer }: Content<'_>) -> Self {
        let document = &state.document;
        Self {
            scene: SceneText(Some(Box::new(document.scene.clone()))),
            selection: document.selection.clone(),
            scene_path: state.scene_path.clone(),
            maximised: state.maximised.map(|tile| tile.title),
            // What is being stored is open no more, and not yet safe.
            import: imports.under_way().cloned().or_else(|| imports.open().map(KeptImport::of)),
            drafts: imports.drafts().to_vec(),
            system: KeptSystem { text: goniophotometer.text().to_owned(), base: goniophotometer.base().to_owned() },
            sheet: sheet_word(state.sheet),
            settings: state.settings.clone(),
        }
    }

    /// Whether the snapshot equals the current content of the window. Called in every frame, so it compares without
    /// copying.
    pub fn is_of(&self, Content { state, imports, goniophotometer }: Content<'_>) -> bool {
        let document = &state.document;
        self.scene.0.as_deref() == Some(&document.scene)
            && self.selection == document.selection
            && self.scene_path == state.scene_path
            && self.maximised == state.maximised.map(|tile| tile.title)
            && match (&self.import, imports.under_way(), imports.open()) {
                (kept, under_way @ Some(_), _) | (kept, under_way @ None, None) => kept.as_ref() == under_way,
                (Some(kept), None, Some(import)) => kept.is_of(import),
                (None, None, Some(_)) => false,
            }
            && self.drafts == imports.drafts()
            && self.system.text == goniophotometer.text()
            && self.system.base == goniophotometer.base()
            && self.sheet == sheet_word(state.sheet)
            && self.settings == state.settings
    }

    /// Returns the session as it is written to disk, with the time of writing `at`.
    pub fn kept(&self, at: String) -> Kept {
        Kept {
            version: VERSION,
            at,
            scene: self.scene.0.as_ref().and_then(|scene| toml::to_string(&**scene).ok()).unwrap_or_default(),
            product: self.selection.product.clone(),
            state: self.selection.state.clone(),
            scene_path: self.scene_path.clone(),
            maximised: self.maximised.map(str::to_owned),
            import: self.import.clone(),
            drafts: self.drafts.clone(),
            system: self.system.clone(),
            sheet: self.sheet.map(str::to_owned),
            settings: self.settings.clone(),
            fault: None,
        }
    }
}

/// Session as stored on disk.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Kept {
    /// Version of the file layout.
    pub version: u32,
    /// Time of writing, in UTC, as text.
    pub at: String,
    /// Text of the scene in TOML.
    pub scene: String,
    /// Key of the selected product.
    pub product: String,
    /// Key of the selected state.
    pub state: String,
    /// Path that the scene was opened from or saved to.
    pub scene_path: Option<PathBuf>,
    /// Title of the tile that fills the tile area.
    pub maximised: Option<String>,
    /// Open import, whose products are not yet in the catalogue.
    pub import: Option<KeptImport>,
    /// Drafts of imports.
    pub drafts: Vec<KeptImport>,
    /// System file that is being typed in the editor of the virtual goniophotometer.
    pub system: KeptSystem,
    /// Key of the side panel that was open.
    pub sheet: Option<String>,
    /// Settings of the window, such as theme, panels and folder.
    pub settings: Settings,
    /// Internal error that ended the program while the session was open, if there was one.
    pub fault: Option<KeptFault>,
}

impl Kept {
    /// Reads a stored session from the bytes of its file.
    ///
    /// # Errors
    /// Returns an error if the bytes are not a session or a newer program has written it.
    pub fn read(bytes: &[u8]) -> Result<Self, SessionError> {
        let kept: Self = serde_json::from_slice(bytes).map_err(SessionError::Text)?;
        match kept.version {
            1..=VERSION => Ok(kept),
            other => Err(SessionError::Newer(other, VERSION)),
        }
    }

    /// Restores the session in a new window. The import is restored later, when its files have been read
    /// again.
    ///
    /// # Errors
    /// Returns a message if the scene cannot be read; everything else is restored nevertheless.
    pub fn put_into(&self, ContentMut { state, imports, goniophotometer }: ContentMut<'_>) -> Result<(), String> {
        state.settings = self.settings.clone();
        imports.take_up(self.drafts.clone());
        state.maximised =
            TILES.iter().map(|entry| entry.tile).find(|tile| self.maximised.as_deref() == Some(tile.title));
        if !self.system.text.is_empty() {
            goniophotometer.take_up(self.system.text.clone(), self.system.base.clone());
        }
        let sheet = SHEETS.iter().find(|(_, word)| self.sheet.as_deref() == Some(*word)).map(|(sheet, _)| *sheet);
        state.sheet = sheet.filter(|sheet| *sheet != Sheet::Import);
        let scene = SceneFile::parse(&self.scene).map_err(|error| error.to_string())?;
        state.document.scene = scene;
        state.document.selection = Selection { product: self.product.clone(), state: self.state.clone() };
        state.scene_path.clone_from(&self.scene_path);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::scene::first_scene;

    fn window() -> (State, Imports, Goniophotometer) {
        (State::new(Settings::default()), Imports::default(), Goniophotometer::default())
    }

    const fn open((state, imports, goniophotometer): &(State, Imports, Goniophotometer)) -> Content<'_> {
        Content { state, imports, goniophotometer }
    }

    const fn put((state, imports, goniophotometer): &mut (State, Imports, Goniophotometer)) -> ContentMut<'_> {
        ContentMut { state, imports, goniophotometer }
    }

    #[test]
    fn what_is_kept_comes_back() {
        let mut window_of_before = window();
        let (state, _, goniophotometer) = &mut window_of_before;
        state.document.scene = first_scene();
        state.document.scene.site.azimuth = 123.0;
        state.document.selection = Selection { product: "blind".to_owned(), state: "30".to_owned() };
        state.scene_path = Some("/tmp/a.toml".into());
        state.maximised = Some(TILES[2].tile);
        goniophotometer.set_text("name = \"half typed".to_owned());
        state.sheet = Some(Sheet::Goniophotometer);
        state.settings.scene_open = false;
        let snapshot = Snapshot::of(open(&window_of_before));
        assert!(snapshot.is_of(open(&window_of_before)));
        let text = serde_json::to_vec(&snapshot.kept("2026-03-21T12:00:00Z".to_owned())).unwrap();
        let mut other = window();
        assert!(!snapshot.is_of(open(&other)));
        Kept::read(&text).unwrap().put_into(put(&mut other)).unwrap();
        assert!(snapshot.is_of(open(&other)));
    }

    #[test]
    fn what_is_half_or_newer_is_refused() {
        let kept = Snapshot::of(open(&window())).kept(String::new());
        let text = serde_json::to_string(&kept).unwrap();
        assert!(Kept::read(&text.as_bytes()[..text.len() / 2]).is_err());
        let newer = text.replace("\"version\":1", "\"version\":9");
        assert!(Kept::read(newer.as_bytes()).unwrap_err().to_string().contains("layout 9"));
        let damaged = Kept { scene: "room = 3".to_owned(), ..kept };
        assert!(damaged.put_into(put(&mut window())).is_err());
    }
}
