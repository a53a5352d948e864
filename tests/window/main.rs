//! The window without a display: found by name, operated by mouse and keyboard, looked at.

mod about;
mod accuracy_view;
mod app;
mod app_engine;
mod arranging;
mod bodies;
mod catalogue_panel;
mod choose_engine;
mod choose_view;
#[path = "../common/mod.rs"]
mod common;
mod compare_view;
mod control_view;
mod driven;
mod faults;
mod files_view;
mod gallery_view;
mod goniophotometer_view;
mod hand_on_view;
mod import_view;
mod keyboard;
mod languages;
mod legible;
mod outside_view;
mod product_sheet;
mod rearranging;
mod room_view;
mod scene_panel;
mod scripts;
mod tiles_view;
mod tour_view;
mod truth;
mod undo;
mod views;
mod year_view;
