//! Clear systems under the numerical goniophotometer: panes, laser-cut and prismatic panels, profiles between panes,
//! against closed forms, conservation laws and the reference kit.

#[path = "glass/kit.rs"]
mod kit;

use cfs::compute::basis::{AzimuthMap, RingBasis};
use cfs::compute::dielectric::Material;
use cfs::compute::dielectric::prism::Prisms;
use cfs::compute::estimate::Silent;
use cfs::compute::goniophotometer::beams::SharpBeams;
use cfs::compute::goniophotometer::panels::CutPanel;
use cfs::compute::goniophotometer::panes::Panes;
use cfs::compute::goniophotometer::{Measured, Setting, Specimen};
use cfs::compute::system::coated::Layer;
use cfs::compute::system::glazing::Pane;
use cfs::compute::system::laser_cut::LaserCutPanel;

fn klems() -> RingBasis {
    RingBasis::klems_full(AzimuthMap::KLEMS_FRONT)
}

fn measure(specimen: &dyn Specimen) -> Measured {
    let basis = klems();
    let setting = Setting { incident: &basis, emergent: &basis, error: 0.01, seed: 1 };
    specimen.measure(&setting, &Silent).unwrap()
}

const PANE: Pane = Pane { index: 1.52, thickness: 0.004, absorption: 10.0 };

fn cut_panel() -> CutPanel {
    let sheet = Pane { index: 1.49, thickness: 0.006, absorption: 0.0 };
    CutPanel { panel: LaserCutPanel { sheet, spacing: 0.004 }, cut_loss: 0.0 }
}

fn prisms() -> Prisms {
    let material = Material { index: 1.49, absorption: 0.0 };
    Prisms { material, angles: [42.0, 5.0].map(f64::to_radians), pitch: 0.001, base: 0.001, flipped: false }
}

#[test]
fn cases_of_the_reference_kit() {
    if kit::folder().is_none() {
        return;
    }
    let specimens: [(&str, Box<dyn Specimen>); 4] = [
        ("pane1", Box::new(Panes::equal(Layer::Clear(PANE), 1))),
        ("pane2", Box::new(Panes::equal(Layer::Clear(PANE), 2))),
        ("lcp", Box::new(SharpBeams(cut_panel()))),
        ("prism", Box::new(prisms().section().unwrap().specimen())),
    ];
    let mut wrong = vec![];
    for (name, specimen) in specimens {
        let start = std::time::Instant::now();
        let measured = measure(specimen.as_ref());
        let seconds = start.elapsed().as_secs_f64();
        let (found, quality) = (kit::compare(name, &measured), measured.quality());
        println!("{name}: {found:?} {quality:?} {seconds:.3} s");
        let near = found.worst.iter().all(|worst| *worst <= 0.003);
        let patches = found.patches.iter().flatten().all(|error| *error <= 0.03);
        let balanced = quality.balance < 1e-6 && quality.reciprocity.is_some_and(|error| error < 0.01);
        if !(near && patches && balanced) {
            wrong.push(name);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}
