//! Settings of the window that are stored between starts of the program, as a part of the session.

use crate::app::display::language::LanguageChoice;
use crate::app::display::theme::ThemeChoice;
use crate::app::export::choices::Choices;
use crate::app::scene::room_look::RoomLook;
use crate::study::rank::Look as Choosing;
use crate::study::year::Look;
use std::path::PathBuf;

/// A megabyte. \[bytes\]
pub const MEGABYTE: usize = 1_000_000;

/// Maximum memory of stored results at a first start. \[MB\] Chosen: cost only, no effect on results.
const STORE_LIMIT: usize = 256;

/// Settings of the window that are stored between starts of the program.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Theme: light, dark, or that of the desktop.
    pub theme: ThemeChoice,
    /// Language of the window.
    pub language: LanguageChoice,
    /// Whether the catalogue panel is open.
    pub catalogue_open: bool,
    /// Whether the scene panel is open.
    pub scene_open: bool,
    /// Text of the last scene in TOML, in settings of older program versions; now the session contains it.
    pub last_scene: Option<String>,
    /// Folder from which a file was last read or to which one was last written.
    pub folder: Option<PathBuf>,
    /// Content, format and options chosen for the last export.
    #[serde(rename = "hand_on")]
    pub export: Choices,
    /// Arrangement of the tiles as text; `None` for the arrangement of a first start.
    pub layout: Option<String>,
    /// Display settings of the room tile.
    pub room: RoomLook,
    /// Display settings of the tile of the annual simulation.
    pub year: Look,
    /// Display settings of the ranking tile.
    pub choose: Choosing,
    /// Text size as a factor on that of the desktop.
    pub text_size: f32,
    /// Maximum memory of stored results. \[MB\]
    pub store_limit: usize,
    /// Number of steps of the tour that the user has finished.
    pub tour: usize,
    /// Whether the catalogue shows products as a gallery of pictures instead of a list.
    pub gallery: bool,
    /// Keys of the recently selected products, newest first.
    pub recent: Vec<String>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            theme: ThemeChoice::System,
            language: LanguageChoice::System,
            catalogue_open: true,
            scene_open: true,
            last_scene: None,
            folder: None,
            export: Choices::default(),
            layout: None,
            room: RoomLook::default(),
            year: Look::default(),
            choose: Choosing::default(),
            text_size: 1.0,
            store_limit: STORE_LIMIT,
            tour: 0,
            gallery: false,
            recent: Vec::new(),
        }
    }
}
