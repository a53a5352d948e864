//! Settings that are kept from one start to the next, beside the session.

use super::export_choices::Choices;
use super::language::LanguageChoice;
use super::room_look::RoomLook;
use super::theme::ThemeChoice;
use crate::study::rank::Look as Choosing;
use crate::study::year::Look;
use std::path::PathBuf;

/// Settings that are kept from one start to the next.
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
    /// Scene in TOML, as older programs kept it here; now it is in the session.
    pub last_scene: Option<String>,
    /// Folder that was written to or read from last.
    pub folder: Option<PathBuf>,
    /// Choices of the last export.
    #[serde(rename = "hand_on")]
    pub export: Choices,
    /// Arrangement of the tiles; `None`: as at a first start.
    pub layout: Option<String>,
    /// Display settings of the room.
    pub room: RoomLook,
    /// Display settings of the annual simulation.
    pub year: Look,
    /// Display settings of the ranking.
    pub choose: Choosing,
    /// Text size relative to that of the desktop.
    pub text_size: f32,
    /// Number of finished steps of the tour.
    pub tour: usize,
    /// Whether products are shown as a gallery of pictures.
    pub gallery: bool,
    /// Keys of the products that were shown last, newest first.
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
            tour: 0,
            gallery: false,
            recent: Vec::new(),
        }
    }
}
