//! Writes luminaire files with a known distribution, to find out how a lighting program places and rotates them.
//!
//! `cargo run --example luminaire_probes FOLDER`
//!
//! One aperture is Lambertian (1.2 m × 1.0 m, 1000 cd/m²), the other emits only upwards and to the right, seen from
//! outside. Both are written as EULUMDAT and as IES (LM-63-2002 and LM-63-2019), mounted as on the façade and aimed
//! down. Import the files into the lighting program and look at the direction of the light.

use cfs::compute::direction::{Dir, Facade, Surface};
use cfs::compute::lid::c_gamma::{Aim, CGammaTable, Step};
use cfs::compute::lid::{EmergentLuminance, Lid};
use cfs::formats::luminaire::{Description, Luminaire};
use cfs::formats::{eulumdat, ies};
use std::path::PathBuf;
use std::sync::Arc;

fn main() -> anyhow::Result<()> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| ".".to_owned()));
    let up_right = |twin: Dir<Facade>| {
        let goes = twin.reversed().vector();
        if goes.x > 0.0 && goes.y > 0.0 { 1000.0 } else { 0.0 }
    };
    let probes = [
        ("lambert", EmergentLuminance::Uniform(1000.0)),
        ("up_right", EmergentLuminance::Function(Arc::new(up_right))),
    ];
    for (name, part) in probes {
        let lid = Lid { surface: Surface::Facade, size: [1.2, 1.0], parts: vec![part], beams: Vec::new() };
        for (suffix, aim) in [("mounted", Aim::Mounted), ("down", Aim::Down)] {
            let text = Description {
                report: "orientation probe".to_owned(),
                laboratory: "computed".to_owned(),
                manufacturer: "cfs".to_owned(),
                name: format!("{name}, {suffix}"),
                ..Description::default()
            };
            let table = CGammaTable::new(&lid, aim, Step::NORMAL);
            let luminaire = Luminaire::from_table(&table, lid.size, text);
            let base = folder.join(format!("{name}_{suffix}"));
            std::fs::write(base.with_extension("ldt"), eulumdat::write(&luminaire))?;
            std::fs::write(base.with_extension("ies"), ies::write(&luminaire, ies::IesEdition::Lm63_2002))?;
            let path = folder.join(format!("{name}_{suffix}_2019.ies"));
            std::fs::write(path, ies::write(&luminaire, ies::IesEdition::Lm63_2019))?;
        }
    }
    Ok(())
}
