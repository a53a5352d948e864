//! The command line from outside, as scripts see it.

mod accuracy_cli;
mod catalogue_cli;
mod cli;
#[path = "../common/mod.rs"]
mod common;
mod control_cli;
mod doctor_cli;
mod examples;
mod goniophotometer_cli;
mod program;
#[path = "../scenes/rooms.rs"]
mod rooms;
mod weather_cli;
