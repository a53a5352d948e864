//! Colours, gaps, strokes and fonts of the window, with separate colours for the light and the dark theme.

use crate::drawing::font::DEJAVU;
use crate::texts::{self, Text, commands, shell};
use egui::epaint::text::{FontInsert, FontPriority, InsertFontFamily};
use egui::style::NumberFormatter;
use egui::{Color32, Context, CornerRadius, FontData, FontFamily, FontId, Margin, Stroke, TextStyle, Theme, Vec2};

/// Theme of the window that the user chose.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub enum ThemeChoice {
    /// Theme of the desktop.
    #[default]
    System,
    /// Light theme.
    Light,
    /// Dark theme.
    Dark,
}

impl ThemeChoice {
    /// All themes, in the order of the menu.
    pub const ALL: [Self; 3] = [Self::System, Self::Light, Self::Dark];

    /// Returns the label of the theme.
    pub const fn word(self) -> Text {
        match self {
            Self::System => shell::AS_THE_DESKTOP,
            Self::Light => commands::LIGHT,
            Self::Dark => commands::DARK,
        }
    }

    /// Makes this the theme of egui.
    pub fn apply(self, ctx: &Context) {
        ctx.set_theme(match self {
            Self::System => egui::ThemePreference::System,
            Self::Light => egui::ThemePreference::Light,
            Self::Dark => egui::ThemePreference::Dark,
        });
    }
}

/// Colours of a theme in addition to those of egui.
#[derive(Debug, Clone, Copy)]
pub struct Palette {
    /// Background of the tile area.
    pub ground: Color32,
    /// Background of a tile or panel.
    pub surface: Color32,
    /// Background of a text field or a chip, and of a row under the pointer.
    pub raised: Color32,
    /// Colour of separating lines.
    pub line: Color32,
    /// Colour of text.
    pub text: Color32,
    /// Colour of secondary text.
    pub weak: Color32,
    /// Colour of selected and active elements.
    pub accent: Color32,
    /// Background of a selected row.
    pub chosen: Color32,
    /// Colour of warnings.
    pub warning: Color32,
    /// Colour of errors.
    pub error: Color32,
    /// Colour of success.
    pub good: Color32,
    /// Colour of the sun, and of the stars that mark favourites.
    pub sun: Color32,
}

impl Palette {
    /// Returns the background of a row or card of a list: selected, under the pointer or focused, or neither.
    pub fn behind(&self, chosen: bool, response: &egui::Response) -> Color32 {
        if chosen {
            self.chosen
        } else if response.hovered() || response.has_focus() {
            self.raised
        } else {
            self.surface
        }
    }
}

/// Colours of the light theme.
pub const LIGHT: Palette = Palette {
    ground: Color32::from_rgb(0xE9, 0xEA, 0xEC),
    surface: Color32::from_rgb(0xFB, 0xFB, 0xFA),
    raised: Color32::from_rgb(0xEF, 0xF0, 0xF2),
    line: Color32::from_rgb(0xD3, 0xD6, 0xDB),
    text: Color32::from_rgb(0x1C, 0x21, 0x28),
    weak: Color32::from_rgb(0x5A, 0x63, 0x6E),
    accent: Color32::from_rgb(0x0B, 0x5F, 0xA5),
    chosen: Color32::from_rgb(0xD6, 0xE6, 0xF5),
    warning: Color32::from_rgb(0x96, 0x5A, 0x00),
    error: Color32::from_rgb(0xB3, 0x26, 0x1E),
    good: Color32::from_rgb(0x1D, 0x74, 0x3C),
    sun: Color32::from_rgb(0xC7, 0x7D, 0x00),
};

/// Colours of the dark theme.
pub const DARK: Palette = Palette {
    ground: Color32::from_rgb(0x12, 0x15, 0x19),
    surface: Color32::from_rgb(0x1B, 0x1F, 0x25),
    raised: Color32::from_rgb(0x28, 0x2E, 0x36),
    line: Color32::from_rgb(0x36, 0x3D, 0x47),
    text: Color32::from_rgb(0xE3, 0xE7, 0xEC),
    weak: Color32::from_rgb(0x9C, 0xA7, 0xB4),
    accent: Color32::from_rgb(0x6C, 0xB6, 0xFF),
    chosen: Color32::from_rgb(0x1F, 0x3B, 0x57),
    warning: Color32::from_rgb(0xF0, 0xB4, 0x4C),
    error: Color32::from_rgb(0xFF, 0x8A, 0x80),
    good: Color32::from_rgb(0x7B, 0xD8, 0x97),
    sun: Color32::from_rgb(0xFF, 0xC9, 0x4D),
};

/// Returns the colours of the current theme.
pub fn palette(ui: &egui::Ui) -> &'static Palette {
    palette_of(ui.visuals())
}

/// Returns the colours for the theme of these egui visuals.
pub const fn palette_of(visuals: &egui::Visuals) -> &'static Palette {
    if visuals.dark_mode { &DARK } else { &LIGHT }
}

/// Gap between neighbouring tiles. \[points\]
pub const TILE_GAP: f32 = 6.0;
/// Height of a row in the list of products. \[points\]
pub const ROW_HEIGHT: f32 = 52.0;

/// Returns the frame (background and margins) of a panel.
pub fn panel_frame(ui: &egui::Ui) -> egui::Frame {
    egui::Frame::new().fill(palette(ui).surface).inner_margin(Margin::symmetric(10, 8))
}

/// Returns the frame (background and margins) of a bar at the top or bottom of the window.
pub fn bar_frame(ui: &egui::Ui) -> egui::Frame {
    egui::Frame::new().fill(palette(ui).surface).inner_margin(Margin::symmetric(10, 4))
}

/// Returns a font for egui that is used for characters missing in all other fonts.
pub fn fallback(name: &str, data: FontData) -> FontInsert {
    let family = |family| InsertFontFamily { family, priority: FontPriority::Lowest };
    FontInsert::new(name, data, vec![family(FontFamily::Proportional), family(FontFamily::Monospace)])
}

/// Sets fonts, colours of both themes, and spacing in egui. Called once, at the start.
pub fn install(ctx: &Context) {
    // Fills the gaps of the built-in fonts (arrows, triangles, primes, superscript minus).
    ctx.add_font(fallback("fallback", FontData::from_static(DEJAVU)));
    for (theme, palette) in [(Theme::Light, &LIGHT), (Theme::Dark, &DARK)] {
        ctx.style_mut_of(theme, |style| {
            style.text_styles = [
                (TextStyle::Small, FontId::proportional(13.0)),
                (TextStyle::Body, FontId::proportional(13.5)),
                (TextStyle::Button, FontId::proportional(13.5)),
                (TextStyle::Heading, FontId::proportional(16.0)),
                (TextStyle::Monospace, FontId::monospace(13.0)),
            ]
            .into();
            style.spacing.item_spacing = Vec2::new(6.0, 4.0);
            style.spacing.button_padding = Vec2::new(7.0, 3.0);
            style.spacing.interact_size.y = 22.0;
            style.spacing.indent = 12.0;
            // Room for the bar beside what is scrolled: floating over it, it would cut fields at the right edge.
            style.spacing.scroll.floating_allocated_width = 8.0;
            // Asked for every number: the language may change.
            style.number_formatter = NumberFormatter::new(|value, decimals| {
                texts::decimal(egui::emath::format_with_decimals_in_range(value, decimals))
            });
            style.animation_time = 0.09;
            // A tip is for who waits for it: not while the pointer passes, nor at once over the next thing.
            style.interaction.tooltip_delay = 0.8;
            style.interaction.tooltip_grace_time = 0.0;
            visuals(&mut style.visuals, palette);
        });
    }
}

/// Sets egui's colours and strokes of one theme.
fn visuals(visuals: &mut egui::Visuals, palette: &Palette) {
    visuals.panel_fill = palette.surface;
    visuals.window_fill = palette.surface;
    visuals.window_stroke = Stroke::new(1.0, palette.line);
    visuals.extreme_bg_color = palette.raised;
    visuals.faint_bg_color = palette.raised;
    visuals.code_bg_color = palette.raised;
    visuals.weak_text_color = Some(palette.weak);
    visuals.hyperlink_color = palette.accent;
    visuals.warn_fg_color = palette.warning;
    visuals.error_fg_color = palette.error;
    visuals.selection.bg_fill = palette.chosen;
    visuals.selection.stroke = Stroke::new(1.0, palette.accent);
    visuals.striped = false;
    visuals.slider_trailing_fill = true;
    visuals.indent_has_left_vline = false;
    let widgets = &mut visuals.widgets;
    for (widget, fill, line) in [
        (&mut widgets.noninteractive, palette.surface, palette.line),
        (&mut widgets.inactive, palette.raised, palette.raised),
        (&mut widgets.hovered, palette.line, palette.weak),
        (&mut widgets.active, palette.chosen, palette.accent),
        (&mut widgets.open, palette.raised, palette.line),
    ] {
        widget.bg_fill = fill;
        widget.weak_bg_fill = fill;
        widget.bg_stroke = Stroke::new(1.0, line);
        widget.fg_stroke = Stroke::new(1.0, palette.text);
        widget.corner_radius = CornerRadius::same(4);
        widget.expansion = 0.0;
    }
}

/// Lays out one line of text, cut with '…' if it is wider than `width` \[points\].
pub fn one_line(
    painter: &egui::Painter,
    text: &str,
    font: FontId,
    colour: Color32,
    width: f32,
) -> std::sync::Arc<egui::Galley> {
    let mut job = egui::text::LayoutJob::simple_singleline(text.to_owned(), font, colour);
    job.wrap = egui::text::TextWrapping::truncate_at_width(width.max(0.0));
    painter.layout_job(job)
}
