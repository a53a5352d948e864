//! The command line from outside, as scripts see it.

mod accuracy_cli;
mod catalogue_cli;
mod cli;
#[path = "../common/mod.rs"]
mod common;
mod compare_cli;
mod control_cli;
mod doctor_cli;
mod documents;
mod examples;
mod fault_cli;
mod goniophotometer_cli;
mod info_cli;
mod keeping_cli;
mod names_cli;
mod program;
mod rank_cli;
mod report_cli;
#[path = "../scenes/rooms.rs"]
mod rooms;
mod safe_cli;
mod solar_cli;
mod streams_cli;
mod weather_cli;
mod year_cli;
mod year_kept_cli;
