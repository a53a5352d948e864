//! What is kept from one start to the next, beside the session.

use super::hand_on::Choices;
use super::language::LanguageChoice;
use super::room_look::RoomLook;
use super::theme::ThemeChoice;
use crate::study::rank::Look as Choosing;
use crate::study::year::Look;
use std::path::PathBuf;

/// Kept from one start to the next.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Light, dark or as the desktop.
    pub theme: ThemeChoice,
    /// In which language the window speaks.
    pub language: LanguageChoice,
    /// Catalogue panel open?
    pub catalogue_open: bool,
    /// Scene panel open?
    pub scene_open: bool,
    /// The scene as older programs kept it here, in TOML; now it is in the session.
    pub last_scene: Option<String>,
    /// The folder that was written to or read from last.
    pub folder: Option<PathBuf>,
    /// What was handed on last, and in which form.
    pub hand_on: Choices,
    /// Where the tiles stand; `None`: as at a first start.
    pub layout: Option<String>,
    /// How the room is drawn.
    pub room: RoomLook,
    /// How the year is looked at.
    pub year: Look,
    /// How the ranking is looked at.
    pub choose: Choosing,
    /// How large text is, as a share of what the desktop wants.
    pub text_size: f32,
    /// Steps of the tour that were done.
    pub tour: usize,
    /// Products as a gallery of pictures?
    pub gallery: bool,
    /// Keys of the products that were shown last, the last first.
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
            hand_on: Choices::default(),
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
