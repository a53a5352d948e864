//! Readers and writers of datasets and luminaires, and the data doctor.

mod beams;
mod btdf_text;
mod budgets;
#[path = "../common/mod.rs"]
mod common;
mod doctor;
mod doctor_made;
mod formats_bsdf_xml;
mod formats_btdf_text;
mod formats_files;
mod formats_material;
mod formats_tensor_xml;
mod luminaire;
mod luminaire_checks;
#[path = "../readers/mod.rs"]
mod readers;
mod readers_mended;
mod readers_replay;
mod weather;
