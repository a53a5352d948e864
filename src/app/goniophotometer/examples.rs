//! Example system files for the sheet of the virtual goniophotometer.

use crate::texts::{Text, goniophotometer as texts};

/// Example of a system file with its label.
pub struct Example {
    /// Label of the example's button.
    pub name: Text,
    /// Text of the system file.
    pub text: &'static str,
}

/// Examples: at least one of every kind of system that the virtual goniophotometer supports.
pub const EXAMPLES: [Example; 12] = [
    Example {
        name: texts::VENETIAN,
        text: r#"name = "Venetian blind, 80 mm, curved"
kind = "venetian"

[venetian]            # lengths in metres
width = 0.080
spacing = 0.072
rise = 0.006          # of the arc; 0 = flat
angles = { from = -30, to = 75, step = 15 }   # outer edge lowered: > 0
upper = { reflectance = 0.70 }
lower = { reflectance = 0.50 }
"#,
    },
    Example {
        name: texts::LOUVRES,
        text: r#"name = "Vertical louvres, 127 mm"
kind = "venetian"
upright = true        # what was up points to the right, seen from outside

[venetian]
width = 0.127
spacing = 0.110
angles = [0, 30, 60]
upper = { reflectance = 0.60 }
lower = { reflectance = 0.60 }
"#,
    },
    Example {
        name: texts::LASER_CUT,
        text: r#"name = "Laser-cut panel, 6 mm acrylic"
kind = "laser-cut-panel"

[laser-cut-panel]
index = 1.49
spacing = 0.004       # from cut to cut
depth = 0.006         # thickness of the sheet
cut_loss = 0.02       # share lost at every reflection at a cut
"#,
    },
    Example {
        name: texts::PRISMATIC,
        text: r#"name = "Prismatic panel 45/90"
kind = "prismatic"

[prismatic]
index = 1.49
angles = [45, 90]     # degrees, upper and lower flank against the sheet
pitch = 0.004
base = 0.002          # of the sheet under the prisms
"#,
    },
    Example {
        name: texts::REDIRECTING,
        text: r#"name = "Acrylic bars between panes"
kind = "redirecting-glass"

[redirecting-glass]
index = 1.49
spacing = 0.006
bodies = [[[0.0, 0.0], [0.012, 0.0], [0.012, 0.004], [0.0, 0.005]]]   # outward, upward
outer = { index = 1.52, thickness = 0.004, absorption = 5 }
inner = { index = 1.52, thickness = 0.004, absorption = 5 }
"#,
    },
    Example {
        name: texts::PANES,
        text: r#"name = "Double glazing, clear"
kind = "pane"

[pane]
index = 1.52
thickness = 0.004
transmittance_normal = 0.89   # of one pane
panes = 2
"#,
    },
    Example {
        name: texts::COATED,
        text: r#"name = "Solar control pane"
kind = "pane"

[pane]
index = 1.52
thickness = 0.006
transmittance_normal = 0.50
reflectance_normal = 0.15
reflectance_normal_back = 0.12
"#,
    },
    Example {
        name: texts::DIFFUSER,
        text: r#"name = "Opal acrylic"
kind = "diffuser"

[diffuser]
model = "opal"        # or "lambertian", "spreading"
index = 1.49
transmittance = 0.50
reflectance = 0.40
"#,
    },
    Example {
        name: texts::WOVEN,
        text: r#"name = "Woven screen, 5 % open"
kind = "woven"

[woven]
openness = 0.05
reflectance = 0.45    # of the yarn, diffuse
transmittance = 0.05
"#,
    },
    Example {
        name: texts::PERFORATED,
        text: r#"name = "Perforated sheet, 23 % open"
kind = "perforated"

[perforated]
hole = "round"
width = 0.005         # diameter
pitch = [0.0131, 0.0131]
staggered = true
thickness = 0.001
reflectance = 0.50
"#,
    },
    Example {
        name: texts::EXPANDED,
        text: r#"name = "Expanded metal"
kind = "perforated"

[perforated]
hole = "rhombus"
width = 0.040         # diagonals
height = 0.014
pitch = [0.047, 0.018]
staggered = true
thickness = 0.002
rise = 0.006          # the strands rise inwards
reflectance = 0.50
"#,
    },
    Example {
        name: texts::STACK,
        text: r#"name = "Clear pane before an opal sheet"
kind = "stack"

[stack]               # from outside to inside
layers = [
  { catalogue = "clear-single" },
  { catalogue = "opal-light" },
]
"#,
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compute::system::SystemKind;
    use crate::formats::system_toml;

    #[test]
    fn every_example_is_read_and_drawn_in_every_state() {
        for example in EXAMPLES {
            let system = system_toml::read(example.text.as_bytes()).unwrap_or_else(|e| panic!("{}: {e}", example.name));
            let system = system.system;
            if matches!(system.kind, SystemKind::Stack(_)) {
                continue;
            }
            let period = system.family().drawing_period().unwrap_or(1.0);
            assert!(period > 0.0);
            for state in system.states() {
                let drawing = system.family().drawing(&state);
                assert!(!drawing.is_empty(), "{} {state}: no drawing", example.name);
                assert!(drawing.iter().all(|polygon| polygon.len() >= 3), "{} {state}", example.name);
                assert!(drawing.iter().flatten().flatten().all(|x| x.is_finite()), "{} {state}", example.name);
            }
        }
    }
}
