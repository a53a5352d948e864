//! Pages of the figures: picture, table and key numbers of each, made from the numbers of the other modules.

use crate::Figure;
use crate::chart::{Disc, Line, Panel, discs, sheet};
use crate::indicatrices::{self as data, KERNELS};
use crate::{curves, outlines, rooms, systems};
use anyhow::{Context as _, Result};
use cfs::compute::basis::RingBasis;
use cfs::compute::direction::{Dir, Emergent, Facade};
use cfs::compute::incidence::grid::Grid;
use std::fmt::Write as _;
use std::sync::Arc;

/// Functions that make the figures, in the order of the report.
pub const ALL: [fn() -> Result<Figure>; 12] = [
    figure_7, figure_8, figure_9, figure_11, figure_12, figure_14, figure_19, figure_20, figure_21, figure_23,
    figure_24, figure_25,
];

/// CSV table with its header and rows.
struct Table(String);

impl Table {
    fn new(head: &str) -> Self {
        Self(format!("{head}\n"))
    }

    fn row(&mut self, words: &[&str], numbers: &[f64]) {
        let words = words.iter().map(|word| format!("\"{word}\""));
        let row: Vec<String> = words.chain(numbers.iter().map(|n| rounded(*n))).collect();
        let _ = writeln!(self.0, "{}", row.join(","));
    }
}

/// Formats a number with six significant digits.
fn rounded(n: f64) -> String {
    if n == 0.0 || !n.is_finite() {
        return format!("{n}");
    }
    let digits = (5 - n.abs().log10().floor() as i32).clamp(0, 12) as usize;
    let text = format!("{n:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

fn percent(x: f64) -> String {
    format!("{} %", rounded((1e5 * x).round() / 1e3))
}

/// Returns column `k` of the rows, each with the first column as x.
fn column<const N: usize>(rows: &[[f64; N]], k: usize) -> Vec<[f64; 2]> {
    rows.iter().map(|row| [row[0], row[k]]).collect()
}

fn on_cells(grid: &Grid, values: &[f64], d: Dir<Facade>) -> f64 {
    grid.basis().index(d).map_or(0.0, |k| values[k])
}

fn figure_7() -> Result<Figure> {
    let sections = data::sections()?;
    let (mut panels, mut spectra) = (Vec::new(), Vec::new());
    let mut table = Table::new("sky,quantity,angle_deg_or_per_deg,luminance,patch_mean,mean_within_6_deg");
    let mut key = Vec::new();
    for s in &sections {
        let axes = ["angle from the zenith towards the sun [°]", "L / L max"];
        let lines = vec![
            Line::new("luminance", 0, column(&s.points, 1)),
            Line::new("mean of its patch", 2, column(&s.points, 2)),
            Line::new("mean within 6°", 1, column(&s.points, 3)),
        ];
        panels.push(Panel::new(s.name, axes, lines));
        let lines = vec![
            Line::new("luminance", 0, column(&s.spectrum, 1)),
            Line::new("means of patches", 2, column(&s.spectrum, 2)),
        ];
        spectra.push(Panel::new("amplitudes", ["frequency [1/°]", "amplitude"], lines));
        s.points.iter().for_each(|p| table.row(&[s.name, "section"], p));
        s.spectrum.iter().for_each(|p| table.row(&[s.name, "spectrum"], p));
        key.push(format!("{}: {}", s.name, percent(s.lost)));
    }
    panels.extend(spectra);
    Ok(Figure {
        file: "fig07-outside",
        number: "7",
        shows: "section through the luminances outside, as seen from a roof, before and after averaging over Tregenza \
                patches, and amplitudes of its Fourier transform",
        key: format!("share of the variance at periods below 24°: {}", key.join("; ")),
        picture: ("svg", sheet(&panels, 3).to_svg().into_bytes()),
        table: table.0,
    })
}

fn figure_8() -> Result<Figure> {
    let mut panels = Vec::new();
    let mut table = Table::new("system,kernel,angle_deg,luminance_of_mean");
    let mut key = Vec::new();
    for (name, law) in [("clear glazing", systems::clear_2 as systems::Law), ("scattering pane", systems::scattering)] {
        let list = data::superposed(law, systems::UNIFORM)?;
        let mut lines = Vec::new();
        for (k, one) in list.iter().enumerate() {
            let mean = one.luminance.iter().sum::<f64>() / one.luminance.len() as f64;
            let section = outlines::section(|d| on_cells(&one.grid, &one.luminance, d) / mean, 1.0);
            section.iter().for_each(|p| table.row(&[name, one.name], p));
            lines.push(Line::new(one.name, k, section));
        }
        let words: Vec<String> = list.iter().map(|one| format!("{} {}", one.name, percent(one.unevenness))).collect();
        key.push(format!("{name}: {}", words.join(", ")));
        let filtered = lines.split_off(1);
        let mut unfiltered =
            Panel::new(format!("{name}, unfiltered"), ["angle from the normal [°]", "L / mean"], lines);
        unfiltered.y[1] = unfiltered.y[1].min(6.0);
        let mut panel = Panel::new(format!("{name}, filtered"), ["angle from the normal [°]", "L / mean"], filtered);
        panel.y[1] = 2.0;
        panels.extend([unfiltered, panel]);
    }
    Ok(Figure {
        file: "fig08-kernels",
        number: "8",
        shows: "indicatrices of 145 incident directions, superposed under uniform light: without filter, with the \
                kernels of the report (narrow, matched, wide), with kernels of the shape of the patches, and by \
                shift-and-weight, the method of the program",
        key: format!("standard deviation / mean of the luminance, which should be uniform: {}", key.join("; ")),
        picture: ("svg", sheet(&panels, 2).to_svg().into_bytes()),
        table: table.0,
    })
}

fn figure_9() -> Result<Figure> {
    let list = data::superposed(systems::clear_2, systems::OVERCAST)?;
    let mut table = Table::new("way,misplaced_flux,uneven_within_78_deg,darkest_cd_m2,mean_cd_m2,brightest_cd_m2");
    let mut pictures = Vec::new();
    let mut key = Vec::new();
    for one in list.iter().filter(|one| [KERNELS[0].0, KERNELS[2].0, KERNELS[4].0, KERNELS[5].0].contains(&one.name)) {
        let title = one.name.replace("12°", "");
        pictures.push(Disc::new(title.trim(), |d| on_cells(&one.grid, &one.luminance, d)));
        key.push(format!("{} {}", one.name, percent(one.misplaced)));
        let mean = one.luminance.iter().sum::<f64>() / one.luminance.len() as f64;
        let [low, high] = one.luminance.iter().fold([f64::INFINITY, 0.0], |[a, b], l| [l.min(a), l.max(b)]);
        table.row(&[one.name], &[one.misplaced, one.unevenness, low, mean, high]);
    }
    // One scale for all would show only the bright spots of the first.
    let rows: Vec<Vec<Disc>> = vec![pictures];
    Ok(Figure {
        file: "fig09-rooflight",
        number: "9",
        shows: "luminance of a clear rooflight under the CIE overcast sky, computed from its indicatrices at 145 \
                incident directions and seen along the normal",
        key: format!("misplaced flux compared with eq 20: {}", key.join(", ")),
        picture: ("png", discs_own_scale(rows)?),
        table: table.0,
    })
}

/// Draws rows of discs, each disc scaled by its 99th percentile.
fn discs_own_scale(rows: Vec<Vec<Disc>>) -> Result<Vec<u8>> {
    let scaled = rows.into_iter().map(|row| {
        let row = row.into_iter().map(|mut disc| {
            let mut lit: Vec<f64> = disc.values.iter().copied().filter(|v| v.is_finite()).collect();
            lit.sort_by(f64::total_cmp);
            let top = lit.get(lit.len().saturating_sub(1) * 99 / 100).copied().unwrap_or(1.0).max(1e-12);
            disc.values.iter_mut().for_each(|v| *v = if *v > top { 1.0 } else { *v / top });
            disc
        });
        row.collect::<Vec<Disc>>()
    });
    discs(&scaled.collect::<Vec<_>>(), 1.0)
}

fn figure_11() -> Result<Figure> {
    let mut table = Table::new("system,threshold,ratio,rms,misplaced_flux,largest_of_peak,tau_error");
    let mut key = Vec::new();
    let mut rows = Vec::new();
    for (name, set) in data::compressed_systems() {
        let (list, first) = data::compressions(name, &set)?;
        for one in &list {
            let r = &one.report;
            table.row(&[one.system, one.criterion], &[r.ratio(), r.rms, r.misplaced, r.largest, r.tau_error]);
        }
        let ratios: Vec<String> =
            list.iter().map(|one| format!("{} {:.1}", one.criterion, one.report.ratio())).collect();
        key.push(format!("{name}: {}", ratios.join(", ")));
        let grid = Grid::new(set.emergent());
        let given = set.row(0).into_owned();
        let ratio = list.first().map_or(0.0, |one| one.report.ratio());
        rows.push(vec![
            Disc::new("measured", |d| on_cells(&grid, &given, d)),
            Disc::new(format!("{ratio:.0} to 1"), |d| on_cells(&grid, &first, d)),
            Disc::new("difference x 5", |d| 5.0 * (on_cells(&grid, &given, d) - on_cells(&grid, &first, d)).abs()),
        ]);
    }
    Ok(Figure {
        file: "fig11-compression",
        number: "11",
        shows: "compression ratio (values in the data per value stored) at several thresholds, for data with 2 % \
                noise; pictures: incident direction θ 42°, φ 90°, original and with 1 % of the energy dropped (Σc², \
                which is 10 % rms); top: glass, bottom: diffuser",
        key: key.join("; "),
        picture: ("png", discs(&rows, 0.5)?),
        table: table.0,
    })
}

fn figure_12() -> Result<Figure> {
    let between = data::between();
    let mut table = Table::new("scheme,misplaced_flux,foretold_by_leaving_out");
    let disc = |title: &str, values: &[f64]| Disc::new(title, |d| on_cells(&between.grid, values, d));
    let mut first: Vec<Disc> =
        between.around.iter().map(|(weight, q)| disc(&format!("data, weight {weight:.2}"), q)).collect();
    first.push(disc("truth", &between.truth));
    let (mut rows, mut key) = (vec![first], Vec::new());
    let mut shown = Vec::new();
    for (name, q, error, predicted) in &between.schemes {
        table.row(&[name], &[*error, *predicted]);
        key.push(format!("{name} {} (predicted {})", percent(*error), percent(*predicted)));
        shown.push(disc(&name.replace('-', " "), q));
    }
    rows.push(shown);
    Ok(Figure {
        file: "fig12-sun-between",
        number: "12",
        shows: "light-redirecting glass with data at 145 incident directions, for a sun between three of them: the \
                data of these three, the exact distribution (truth), and the result of each interpolation scheme",
        key: format!("misplaced flux, in brackets predicted from the data alone: {}", key.join(", ")),
        picture: ("png", discs(&rows, 0.5)?),
        table: table.0,
    })
}

fn figure_14() -> Result<Figure> {
    let list = curves::all().context("the slats of the curves are sections")?;
    let mut table = Table::new("curve,kind,profile_angle_deg,tilt_deg");
    let (mut panels, mut key) = (Vec::new(), Vec::new());
    for (title, pair) in [("conventional blind, cut-off", &list[..2]), ("redirecting blind, two modes", &list[2..])] {
        let mut lines = Vec::new();
        for (k, curve) in pair.iter().enumerate() {
            curve.points.iter().for_each(|p| table.row(&[curve.name, "curve"], p));
            curve.steps.iter().for_each(|p| table.row(&[curve.name, "states of 5 deg"], p));
            // Both ends of every step, so that steps are drawn vertical.
            let upright =
                curve.steps.windows(2).flat_map(|w| [w[0], [w[1][0], w[0][1]]]).chain(curve.steps.last().copied());
            lines.push(Line::new(format!("{} in 5° steps", curve.name), 5 + k, upright.collect()));
            lines.push(Line::new(curve.name, 1 + k, curve.points.clone()));
            let words = match curve.section {
                Some(_) => format!(
                    "direct light passed by the states {}, by states 2° more open up to {}",
                    percent(curves::leak(curve, 0.0)),
                    percent(curves::leak(curve, 2.0))
                ),
                None => format!("states within {}° of the curve", rounded(curves::rounding(curve))),
            };
            key.push(format!("{}: {words}", curve.name));
        }
        let mut panel = Panel::new(title, ["profile angle [°]", "tilt [°]"], lines);
        (panel.x, panel.y) = ([0.0, 90.0], [-45.0, 90.0]);
        panels.push(panel);
    }
    Ok(Figure {
        file: "fig14-control",
        number: "14",
        shows: "slat angle over the profile angle of the sun (> 0°: outer edge lowered), as a curve and in states of \
                5°: cut-off of flat slats (80 mm every 72 mm) and of slats on an arc (crown 16 mm), rounded to the \
                more closed state for the whole solar disc; mirror slats that return the sun (90° − ψ), rounded to the \
                more closed state, or send it into the room at 30° elevation ((30° − ψ)/2), rounded to the nearest \
                state",
        key: key.join("; "),
        picture: ("svg", sheet(&panels, 2).to_svg().into_bytes()),
        table: table.0,
    })
}

fn figure_19() -> Result<Figure> {
    let mut table = Table::new("altitude_deg,beam,distance_m,share_of_full");
    let (mut panels, mut key) = (Vec::new(), Vec::new());
    for (altitude, reach) in [(20.0, 1.6), (60.0, 0.24)] {
        let mut lines = Vec::new();
        for (k, spread) in [None, Some(1.0), Some(2.5), Some(5.0)].into_iter().enumerate() {
            let profile = rooms::shadow(altitude, spread)?;
            if spread.is_none() {
                let off = rooms::shadow_deviation(altitude, &profile);
                key.push(format!(
                    "solar altitude {altitude}°: largest difference from the closed form {} of full sun",
                    percent(off)
                ));
            }
            key.push(format!("{} {:.3} m (closed form {:.3})", profile.name, profile.width, profile.expected));
            for [x, share] in &profile.points {
                table.row(&[], &[altitude, spread.unwrap_or(0.0), *x, *share]);
            }
            let mut points = vec![[-reach, 0.0]];
            points.extend(profile.points.iter().copied().filter(|p| p[0].abs() <= reach));
            lines.push(Line::new(profile.name, k, points));
        }
        let mut panel =
            Panel::new(format!("altitude {altitude}°"), ["distance from the edge [m]", "E / E full"], lines);
        panel.x = [-reach, reach];
        panels.push(panel);
    }
    Ok(Figure {
        file: "fig19-shadow-edge",
        number: "19",
        shows: "illuminance of a horizontal plane across the shadow of an edge 1 m above it: direct sun (disc of \
                0.533°) through an open aperture, and beams that a system spreads",
        key: format!("width of the transition from 10 to 90 %; {}", key.join("; ")),
        picture: ("svg", sheet(&panels, 2).to_svg().into_bytes()),
        table: table.0.replacen("beam", "spread_deg", 1),
    })
}

fn figure_20() -> Result<Figure> {
    let mut table = Table::new("period_m,distance_m,spots_over_even,closed_form,lines_over_even,closed_form");
    let (mut panels, mut key) = (Vec::new(), Vec::new());
    for period in [0.2, 0.1] {
        let lines = rooms::lines(period)?;
        for [d, spots, truth, wide, endless] in &lines.points {
            table.row(&[], &[period, *d, *spots, *truth, *wide, *endless]);
        }
        let at = |x: f64| {
            let row = lines.points.iter().find(|p| p[0] >= x).map_or(1.0, |p| p[1]);
            percent((row - 1.0).abs())
        };
        key.push(format!(
            "period {period} m, difference of the spots: {} at 0.1 m, {} at 0.3 m, {} at 1 m; uniform area valid from \
             {} m on",
            at(0.0999),
            at(0.299),
            at(0.999),
            rounded(lines.trusted)
        ));
        let drawn = vec![
            Line::new("spots, closed form", 5, column(&lines.points, 2)).wide(),
            Line::new("spots by the program", 2, column(&lines.points, 1)),
            Line::new("lines, closed form", 6, column(&lines.points, 4)).wide(),
            Line::new("lines by the program", 1, column(&lines.points, 3)),
            Line::new("even area", 0, lines.points.iter().map(|p| [p[0], 1.0]).collect()),
            Line::new("trusted from here", 3, vec![[lines.trusted, 0.0], [lines.trusted, 1.5]]),
        ];
        let title = format!("period {period} m, height 1 m");
        let mut panel = Panel::new(title, ["distance [m]", "E / E even"], drawn);
        (panel.x, panel.y) = ([0.0, 2.0], [0.6, 1.6]);
        for line in &mut panel.lines {
            line.points.retain(|p| p[0] <= 2.0);
        }
        panels.push(panel);
    }
    Ok(Figure {
        file: "fig20-lines",
        number: "20",
        shows: "illuminance at sill height in front of bright spots one above the other, and in front of bright lines, \
                relative to that in front of a uniform area of the same flux",
        key: key.join("; "),
        picture: ("svg", sheet(&panels, 2).to_svg().into_bytes()),
        table: table.0,
    })
}

fn figure_21() -> Result<Figure> {
    let lines = outlines::table()?;
    let mut table = Table::new("what,situation,data,angle_deg_or_misplaced,cd_per_1000_lm_or_transmittance");
    let mut key = Vec::new();
    for line in &lines {
        table.row(&["summary", line.situation, line.resolution], &[line.misplaced, line.transmittance]);
    }
    let mut panels = Vec::new();
    let klems = Arc::new(systems::open_cells(&RingBasis::klems_full(cfs::compute::basis::AzimuthMap::KLEMS_FRONT)));
    let diffuser = Arc::new(systems::diffuser());
    let measured = Arc::new(systems::open_measured(&RingBasis::tregenza(), 72, systems::clear_2));
    for (name, place) in outlines::situations() {
        let towards = if name.starts_with("roof") { -1.0 } else { 1.0 };
        let mut drawn = Vec::new();
        let truth = place.scene(&klems)?;
        let flux = outlines::illuminance(&truth.facing(0));
        let exact =
            outlines::section(|d| 1000.0 * outlines::outside(&truth.facing(0), d) * d.vector().z / flux, towards);
        drawn.push(Line::new("eq 20", 5, exact).wide());
        let even = outlines::section(|d| 1000.0 * d.vector().z / std::f64::consts::PI, towards);
        drawn.push(Line::new("eq 19", 6, even).wide());
        let sets = [("145 Klems cells", &klems, 2), ("145 directions", &measured, 1), ("diffuser", &diffuser, 0)];
        for (what, set, colour) in sets {
            let (_, light) = place.lid(set)?;
            let intensity =
                |d: Dir<Facade>| 1000.0 * light.lid.intensity(Emergent::from_undeviated(d)) / light.flux.value;
            drawn.push(Line::new(what, colour, outlines::section(intensity, towards)));
        }
        for line in &drawn {
            line.points.iter().for_each(|p| table.row(&["section", name, &line.name], p));
        }
        panels.push(Panel::new(name, ["angle from the normal towards the sun [°]", "cd / 1000 lm"], drawn));
        let off = |what: &str| {
            let line = lines.iter().find(|line| line.situation == name && line.resolution.contains(what));
            line.map_or(f64::NAN, |line| line.misplaced)
        };
        let series =
            ["145, cells of 3.7", "145, cells of 1.9", "145, cells of 1.2"].map(|what| percent(off(what))).join(" / ");
        let cells = ["quarter", "full", "2304"].map(|what| percent(off(what))).join(" / ");
        key.push(format!(
            "{name}: diffuser within {} of eq 19; open aperture, misplaced flux compared with eq 20: 145 directions \
             and cells of 3.7°/1.9°/1.2° {series}, 41/145/2304 cells {cells}, regular transmission {}",
            percent(outlines::diffuser_deviation(&place)?),
            percent(off("regular")),
        ));
    }
    let worst = lines.iter().map(|line| (line.transmittance - 1.0).abs()).fold(0.0, f64::max);
    key.push(format!("transmittance of the open aperture, all data and skies: within {} of 100 %", percent(worst)));
    Ok(Figure {
        file: "fig21-intensity",
        number: "21",
        shows: "luminous intensity of the ideal diffuser and the open aperture compared with eq 19 and eq 20, the open \
                aperture also from data of increasing resolution. Measured data are simulated with a beam of 2° \
                (standard deviation), which of 1° to 3.5° suits the finest cells best. Finer emergent cells improve \
                the result, more incident directions do not. On façades the beam extends across the horizon",
        key: key.join("; "),
        picture: ("svg", sheet(&panels, 2).to_svg().into_bytes()),
        table: table.0,
    })
}

fn figure_23() -> Result<Figure> {
    depth_figure(
        "fig23-direct",
        "23",
        "direct illuminance along the depth of the model rooms (4 × 6 × 3 m, 0.85 m above the floor), ideal clear \
         (transparent) and ideal diffuser (diffuse)",
        1,
    )
}

fn figure_24() -> Result<Figure> {
    depth_figure(
        "fig24-interreflected",
        "24",
        "illuminance in the rooms of figure 23 with interreflection (reflectance of floor 0.2, walls 0.5, ceiling 0.7)",
        2,
    )
}

fn depth_figure(file: &'static str, number: &'static str, shows: &'static str, of: usize) -> Result<Figure> {
    let depths = rooms::depths()?;
    let mut table = Table::new("situation,system,depth_m,direct_lx,total_lx,stated_error_lx");
    let (mut panels, mut key) = (Vec::new(), Vec::new());
    for pair in depths.chunks(2) {
        let lines = pair.iter().enumerate().map(|(k, d)| Line::new(d.system, k + 1, column(&d.points, of)));
        panels.push(Panel::new(pair[0].situation, ["depth [m]", "E [lx]"], lines.collect()));
        for one in pair {
            one.points.iter().for_each(|p| table.row(&[one.situation, one.system], p));
            let stated = one.points.iter().map(|p| p[3] / p[2]).fold(0.0, f64::max);
            let number = if of == 1 { percent(one.distance) } else { percent(stated) };
            key.push(format!("{}, {} {number}", one.situation, one.system));
        }
    }
    let what = if of == 1 { "mean difference from 200 × 200 point sources" } else { "largest relative uncertainty" };
    Ok(Figure {
        file,
        number,
        shows,
        key: format!("{what}: {}", key.join("; ")),
        picture: ("svg", sheet(&panels, 2).to_svg().into_bytes()),
        table: table.0,
    })
}

fn figure_25() -> Result<Figure> {
    let measured = rooms::tregenza_data();
    let mut table = Table::new("altitude_deg,depth_m,open_aperture_lx,closed_form_lx,from_145_directions_lx");
    let (mut panels, mut key) = (Vec::new(), Vec::new());
    for altitude in [24.0, 60.0] {
        let patch = rooms::sun_patch(altitude, &measured)?;
        for p in &patch.points {
            table.row(&[], &[altitude, p[0], p[1], p[2], p[3]]);
        }
        let full = patch.points.iter().map(|p| p[2]).fold(0.0, f64::max);
        let off = patch.points.iter().map(|p| (p[1] - p[2]).abs()).fold(0.0, f64::max) / full;
        key.push(format!(
            "solar altitude {altitude}°: largest difference of the open aperture from the closed form with penumbra {} \
             of full sun; data at 145 directions: edge blurred over {:.2} m by the lobe of {:.2}° in the data (closed \
             form {:.2} m), light {} of the open aperture's",
            percent(off),
            patch.blur[0],
            patch.data,
            patch.blur[1],
            percent(patch.light)
        ));
        let lines = vec![
            Line::new("closed form", 5, column(&patch.points, 2)).wide(),
            Line::new("open aperture", 0, column(&patch.points, 1)),
            Line::new("from 145 directions", 1, column(&patch.points, 3)),
        ];
        panels.push(Panel::new(format!("sun at {altitude}°"), ["depth [m]", "E [lx]"], lines));
    }
    Ok(Figure {
        file: "fig25-sun-patch",
        number: "25",
        shows: "direct sun through the open aperture of the side-lit room, 0.1 m above the floor; no interreflection",
        key: key.join("; "),
        picture: ("svg", sheet(&panels, 2).to_svg().into_bytes()),
        table: table.0,
    })
}
