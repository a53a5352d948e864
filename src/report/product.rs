//! Product sheet, for makers: system, figures, pictures of the light distribution, origin of the data.

use super::pages::{Figure, Pages};
use super::picture::Origin;
use super::table::Table;
use super::tender::{Fields, fill, spoken};
use super::tiles::{TileKind, draw, indicatrix, section};
use super::words::{origin_words, severity_words, thermal_words};
use super::{ReportError, picture};
use crate::catalogue::{Origin as From, Product, State, moving_part};
use crate::compute::btdf::{BandName, Btdf, LightFigures, Severity, SolarSource};
use crate::compute::direction::{Dir, Incident};
use crate::compute::system::SystemDescription;
use crate::drawing::chart;
use crate::drawing::colours::Inks;
use crate::drawing::plot::{Axis, Plot, Series, Unit};
use crate::drawing::ticks::{number, si, tick};
use crate::drawing::{Drawing, Frame};
use crate::study::comparison::{DataFacts, FIGURES, Facts, Value};
use crate::study::product_control::state_words;
use crate::study::subject::Subject;
use crate::texts::findings::words;
use crate::texts::{Text, export as texts, fixed};

/// Polar angles of the incident directions whose indicatrices are drawn, upwards from the normal. \[°\]
const INCIDENCES: [f64; 3] = [0.0, 30.0, 60.0];

/// Input of a product sheet.
pub struct Sheet<'a> {
    /// Product in a scene, in the state that the sheet describes, with its results.
    pub subject: &'a Subject,
    /// Template of the tender text; empty: the sheet has no tender text.
    pub tender: &'a str,
    /// Colours of the pictures, for screen or print.
    pub inks: &'a Inks,
}

/// Returns a share as text in percent.
fn percent(share: f64) -> String {
    format!("{} %", number(100.0 * share, 3))
}

fn optional(value: Option<f64>) -> String {
    value.map_or_else(|| "–".to_owned(), |value| number(value, 3))
}

/// Optical figures of the described state: from the product's catalogue entry or, for systems that are not products,
/// from the data.
struct StateFigures {
    tau_normal: Option<f64>,
    tau_hemispherical: Option<f64>,
    light: Option<LightFigures>,
}

impl StateFigures {
    fn of(subject: &Subject) -> Self {
        let own = &subject.scene.apertures[0].system.state;
        let state = subject.product.as_ref().and_then(|product| product.states.iter().find(|one| one.key == *own));
        let btdf = subject.transmission();
        let normal = Incident(Dir::from_unit(glam::DVec3::Z));
        Self {
            tau_normal: state.and_then(|one| one.tau_normal).or_else(|| btdf.map(|btdf| btdf.tau(normal))),
            tau_hemispherical: state
                .and_then(|one| one.tau_hemispherical)
                .or_else(|| btdf.map(Btdf::tau_hemispherical)),
            light: state.and_then(|one| one.light).or_else(|| btdf.map(LightFigures::of)),
        }
    }
}

fn states_words(count: usize) -> String {
    if count == 1 { texts::ONE_STATE.into() } else { texts::states_are(count) }
}

/// Returns the fields of a tender text with their values.
fn fields(subject: &Subject) -> Vec<(&'static str, String)> {
    let figures = StateFigures::of(subject);
    let dataset = subject.dataset();
    let product = subject.product.as_ref();
    let figure = |value: Option<f64>| value.map_or_else(String::new, |value| number(value, 3));
    let share = |value: Option<f64>| value.map_or_else(String::new, percent);
    let length = |value: Option<f64>| value.map_or_else(String::new, |metres| format!("{} mm", tick(1000.0 * metres)));
    let of = |text: fn(&Product) -> &str| product.map_or_else(String::new, |product| text(product).to_owned());
    let origin = product.map_or("", |product| match product.provenance.origin {
        From::Unknown => "",
        origin => origin_words(origin).get(),
    });
    vec![
        ("name", subject.scene.apertures[0].system.label.clone()),
        ("maker", product.map_or_else(|| dataset.manufacturer.clone(), |product| product.manufacturer.clone())),
        ("kind", of(|product| &product.kind)),
        ("states", states_words(product.map_or(1, |product| product.states.len()))),
        ("state", if subject.state.is_empty() { texts::SINGLE_STATE.into() } else { subject.state.clone() }),
        ("tau_normal", figure(figures.tau_normal)),
        ("tau_hemispherical", figure(figures.tau_hemispherical)),
        ("to_ceiling", share(figures.light.and_then(|light| light.to_ceiling))),
        ("sun_blocked", share(figures.light.map(|light| light.sun_blocked))),
        ("view", share(figures.light.map(|light| light.view))),
        ("thickness", length(dataset.thickness)),
        ("structure", length(dataset.structure)),
        ("origin", origin.to_owned()),
        ("method", of(|product| &product.provenance.method)),
        ("file", of(|product| &product.provenance.source_file)),
    ]
}

/// Returns the pages of a product sheet.
///
/// # Errors
/// Returns an error if the tender text is not a valid template, or the system has no data.
pub fn pages(sheet: &Sheet<'_>) -> Result<Vec<Drawing>, ReportError> {
    let (subject, inks) = (sheet.subject, sheet.inks);
    let name = &subject.scene.apertures[0].system.label;
    let product = subject.product.as_ref();
    let under = match product {
        Some(product) => {
            let parts = [product.manufacturer.clone(), product.kind.clone(), states_words(product.states.len())];
            parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(" · ")
        }
        None => texts::NOT_OF_CATALOGUE.into(),
    };
    let mut pages = Pages::new(texts::PRODUCT_SHEET.get(), name, &under, inks);
    let description = product.map_or(&*subject.dataset().description, |product| &product.description);
    if !description.is_empty() {
        pages.paragraph(description);
    }
    pages.heading(&in_state(subject, texts::FIGURES, |state| texts::figures_of(state)));
    let facts = DataFacts::of(subject.dataset());
    pages.figures(&figures(subject, facts.as_ref()));
    let stated = facts.is_some_and(|facts| facts.error.is_some());
    pages.note(if stated { texts::FIGURES_NOTE } else { texts::FIGURES_NOTE_UNSTATED }.get());
    pictures(&mut pages, subject, inks)?;
    if let Some(product) = product.filter(|product| product.states.len() > 1) {
        states(&mut pages, product);
    }
    in_use(&mut pages, subject, inks)?;
    tender(&mut pages, sheet.tender, &fields(subject))?;
    provenance(&mut pages, subject);
    Ok(pages.finish())
}

/// Returns a text that mentions the state, or the text without it if the system has no states.
fn in_state(subject: &Subject, plain: Text, with: fn(&str) -> String) -> String {
    if subject.state.is_empty() { plain.into() } else { with(&subject.state) }
}

/// Returns names and values of the optical figures of the described state, with the uncertainties that its data state.
fn figures(subject: &Subject, facts: Option<&DataFacts>) -> Vec<(String, String)> {
    let figures = StateFigures::of(subject);
    let dataset = subject.dataset();
    let mut list: Vec<(String, String)> = Vec::new();
    let mut add = |name: Text, value: String| list.push((name.into(), value));
    // The values come from the comparison's table, so that no figure appears in two forms.
    let all = Facts { data: facts.copied(), ..Facts::default() };
    let error = |key: &str| {
        let figure = FIGURES.iter().find(|figure| figure.key == key)?;
        (figure.of)(&all)?.error
    };
    let share = |key: &str, value: Option<f64>| match value {
        Some(value) => {
            let words = Value { value: 100.0 * value, error: error(key).map(|error| 100.0 * error) }.words();
            format!("{words} %")
        }
        None => "–".to_owned(),
    };
    let tau = |key: &str, value: Option<f64>| {
        value.map_or_else(|| "–".to_owned(), |value| Value { value, error: error(key) }.words())
    };
    add(texts::TAU_NORMAL, tau("tau_normal", figures.tau_normal));
    add(texts::TAU_DIFFUSE, tau("tau_hemispherical", figures.tau_hemispherical));
    // The solar figures appear only where the data have the solar band.
    let source = dataset.solar_source();
    if let Some(solar) = dataset.transmission_of(BandName::Solar).filter(|_| source != SolarSource::Visible) {
        for (name, value) in
            [(texts::SOLAR_NORMAL, solar.tau_normal()), (texts::SOLAR_DIFFUSE, solar.tau_hemispherical())]
        {
            let value = number(value, 3);
            add(name, if source == SolarSource::Partly { texts::solar_partly(value) } else { value });
        }
    }
    if let Some(light) = figures.light {
        add(texts::TO_CEILING, share("to_ceiling", light.to_ceiling));
        add(texts::SUN_KEPT_OUT, share("sun_blocked", Some(light.sun_blocked)));
        add(texts::VIEW, share("view", Some(light.view)));
    }
    if let Some(back) = dataset.room_side_reflectance() {
        add(texts::RHO_ROOM_SIDE, number(back, 3));
    }
    let length = |metres: f64| format!("{} mm", tick(1000.0 * metres));
    if let Some(thickness) = dataset.thickness {
        add(texts::DEPTH, length(thickness));
    }
    if let Some(structure) = dataset.structure {
        add(texts::SPACING, length(structure));
    }
    for (key, value) in dataset.thermal.known() {
        let unit = if key.json().ends_with("_m") { " m" } else { "" };
        add(thermal_words(key), format!("{}{unit}", number(value, 3)));
    }
    list
}

/// Adds pictures of the system's section and of the light distribution for three incident directions.
fn pictures(pages: &mut Pages, subject: &Subject, inks: &Inks) -> Result<(), ReportError> {
    let Some(btdf) = subject.transmission() else {
        return Err(ReportError::Nothing(texts::PRODUCT_SHEET, texts::NO_DATA.into()));
    };
    pages.heading(texts::WHERE_LIGHT_GOES.get());
    let incident = |degrees: f64| Incident(Dir::from_theta_phi(degrees.to_radians(), 0.5 * std::f64::consts::PI));
    let greatest =
        |degrees: &f64| btdf.indicatrix(incident(*degrees)).map_or(0.0, |one| one.q.into_iter().fold(0.0, f64::max));
    // One scale, so that the three can be compared.
    let max = INCIDENCES.iter().map(greatest).fold(0.0, f64::max);
    let mut row = Vec::new();
    for degrees in INCIDENCES {
        let mut drawing = Drawing::new(260.0, 290.0);
        let caption = if degrees > 0.0 { texts::from_above(fixed(degrees, 0)) } else { texts::FROM_NORMAL.into() };
        let frame = drawing.frame().inside([8.0; 4]);
        indicatrix(&mut drawing, frame, btdf, incident(degrees), (&caption, Some((max, 4))), inks);
        let tau = number(btdf.tau(incident(degrees)), 3);
        row.push(Figure { drawing, caption: texts::picture_tau(caption, tau) });
    }
    pages.pictures(&row, 190.0);
    pages.note(texts::INDICATRIX_NOTE.get());
    let described = subject.product.as_ref().and_then(|product| moving_part(&product.system));
    let curve = profile_curve(subject, inks);
    let mut row = Vec::new();
    if let Some(drawing) = described.and_then(|system| section_of(&system, subject, inks)) {
        row.push(Figure { drawing, caption: in_state(subject, texts::SECTION, |state| texts::section_of(state)) });
    }
    row.extend(curve.map(|drawing| Figure { drawing, caption: texts::PROFILE_CAPTION.into() }));
    pages.gap(6.0);
    pages.pictures(&row, 190.0);
    Ok(())
}

fn section_of(system: &SystemDescription, subject: &Subject, inks: &Inks) -> Option<Drawing> {
    let mut drawing = Drawing::new(400.0, 270.0);
    let frame = drawing.frame().inside([10.0; 4]);
    let state = &subject.scene.apertures[0].system.state;
    section(&mut drawing, frame, system, state, inks).then_some(drawing)
}

/// Returns up to five states, equally spaced in their order.
fn chosen(states: &[State]) -> Vec<&State> {
    const MOST: usize = 5;
    if states.len() <= MOST {
        return states.iter().collect();
    }
    (0..MOST).map(|k| &states[k * (states.len() - 1) / (MOST - 1)]).collect()
}

fn profile_curve(subject: &Subject, inks: &Inks) -> Option<Drawing> {
    use crate::catalogue::{PROFILE_ANGLES, profile_transmittances};
    let line = |name: String, tau: &[f64]| Series::line(name, PROFILE_ANGLES.iter().zip(tau).map(|(a, t)| [*a, *t]));
    let series: Vec<Series> = match &subject.product {
        Some(product) => chosen(&product.states)
            .into_iter()
            .filter(|state| state.tau_profile.len() == PROFILE_ANGLES.len())
            .map(|state| line(state_words(state), &state.tau_profile))
            .collect(),
        None => vec![line("τ".to_owned(), &profile_transmittances(subject.transmission()?))],
    };
    let top = series.iter().flat_map(|series| &series.points).map(|point| point[1]).fold(0.0, f64::max);
    if series.is_empty() {
        return None;
    }
    let plot = Plot {
        x: Axis::linear([-90.0, 90.0], texts::PROFILE_ANGLE, Unit::Degrees),
        y: Axis::linear([0.0, crate::drawing::ticks::fine_ceil(top.max(0.01))], "τ", Unit::Named("")),
        series,
        guides: Vec::new(),
    };
    let mut drawing = Drawing::new(400.0, 270.0);
    let high = if plot.series.len() > 1 || !plot.series[0].name.is_empty() {
        chart::names(&mut drawing, Frame::new(50.0, 2.0, 340.0, 40.0), &plot.series, inks)
    } else {
        0.0
    };
    chart::panel(&mut drawing, Frame::new(4.0, high, 392.0, 266.0 - high), &plot, inks);
    Some(drawing)
}

fn states(pages: &mut Pages, product: &Product) {
    pages.heading(texts::STATES.get());
    let heads = [
        texts::HEAD_STATE,
        texts::HEAD_TAU_NORMAL,
        texts::HEAD_TAU_DIFFUSE,
        texts::HEAD_TO_CEILING,
        texts::HEAD_SUN,
        texts::HEAD_VIEW,
    ];
    let mut table = Table::of(heads.map(Text::get));
    let share = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), |share| number(100.0 * share, 3));
    for state in &product.states {
        let words = state_words(state);
        table.row([
            if words.is_empty() { "–".to_owned() } else { words },
            optional(state.tau_normal),
            optional(state.tau_hemispherical),
            share(state.light.and_then(|light| light.to_ceiling)),
            share(state.light.map(|light| light.sun_blocked)),
            share(state.light.map(|light| light.view)),
        ]);
    }
    pages.table(&table);
}

/// Adds figures and pictures of the system in use in the scene.
fn in_use(pages: &mut Pages, subject: &Subject, inks: &Inks) -> Result<(), ReportError> {
    pages.heading(texts::IN_USE.get());
    let [width, height] = subject.file.aperture[0].size.map(tick);
    pages.note(&texts::in_use_note(picture::situation(&subject.file), width, height));
    let mut row = Vec::new();
    for tile in [TileKind::Lid, TileKind::Room] {
        let missing = match tile {
            TileKind::Lid => subject.lid.is_none(),
            _ => subject.room.is_none() || subject.scene.grid.is_none(),
        };
        if missing {
            continue;
        }
        let mut drawing = Drawing::new(400.0, 430.0);
        let frame = drawing.frame().inside([4.0; 4]);
        let text = draw(&mut drawing, frame, subject, tile, inks)?;
        row.push(Figure { drawing, caption: format!("{}: {text}", tile.words()) });
    }
    pages.pictures(&row, 260.0);
    Ok(())
}

fn tender(pages: &mut Pages, template: &str, fields: &Fields) -> Result<(), ReportError> {
    let lines = fill(spoken(template), fields)?;
    if lines.iter().all(|line| line.trim().is_empty()) {
        return Ok(());
    }
    pages.heading(texts::TENDER_TEXT.get());
    for line in lines {
        pages.paragraph(&line);
    }
    Ok(())
}

/// Adds the origin of the data and the findings of the data check.
pub(super) fn provenance(pages: &mut Pages, subject: &Subject) {
    pages.heading(texts::DATA_HEADING.get());
    let dataset = subject.dataset();
    let mut list: Vec<(String, String)> = Vec::new();
    let mut add = |name: Text, value: &str| {
        if !value.is_empty() {
            list.push((name.into(), value.to_owned()));
        }
    };
    match &subject.product {
        Some(product) => {
            let from = &product.provenance;
            add(texts::ORIGIN, origin_words(from.origin).get());
            add(texts::METHOD, &from.method);
            add(texts::AUTHOR, &from.author);
            add(texts::DATE, &from.date);
            add(texts::FILE, &from.source_file);
            add(texts::HASH, &from.source_hash);
            add(texts::LICENCE, &product.license);
            add(texts::INSIDE_FACE, &from.inside_face);
            add(texts::KEY, &product.key);
        }
        None => add(texts::ORIGIN, &Origin::words(subject)),
    }
    add(texts::FORMAT, &dataset.format);
    add(texts::INCIDENT_BASIS, &dataset.incident_basis);
    add(texts::EMERGENT_BASIS, &dataset.emergent_basis);
    for link in links(subject) {
        add(texts::LINK, &link);
    }
    pages.figures(&list);
    let findings: Vec<(Severity, String, String)> = match &subject.product {
        Some(product) => {
            let mut list = Vec::new();
            for finding in &product.findings {
                let one = (finding.severity, finding.code.clone(), finding.message.clone());
                if !list.contains(&one) {
                    list.push(one);
                }
            }
            list
        }
        None => {
            let own = dataset.findings.iter();
            own.map(|finding| (finding.severity, finding.code.to_owned(), finding.message.clone())).collect()
        }
    };
    if findings.is_empty() {
        pages.paragraph(texts::CHECKS_SILENT.get());
    }
    for (severity, code, message) in findings {
        let title = words(&code).map_or(&*code, |words| words.title.get());
        pages.paragraph(&texts::finding(severity_words(severity), title, message));
    }
}

/// Returns the web addresses that occur in the texts of the product.
fn links(subject: &Subject) -> Vec<String> {
    let Some(product) = &subject.product else { return Vec::new() };
    let from = &product.provenance;
    let words = [&product.description, &from.method, &from.author, &from.source_file, &product.license]
        .into_iter()
        .flat_map(|text| text.split_whitespace());
    let address = |word: &str| word.trim_matches(|c: char| "()<>,.;\"'".contains(c)).to_owned();
    let mut list: Vec<String> =
        words.map(address).filter(|word| word.starts_with("https://") || word.starts_with("http://")).collect();
    list.dedup();
    list
}

/// Returns the luminous flux of the subject's aperture with its uncertainty as text; `None` if it was not computed.
pub(super) fn flux(subject: &Subject) -> Option<String> {
    let (lid, _) = subject.lid.as_ref()?;
    Some(format!("{} ± {}", si(lid.flux.value, "lm"), si(lid.flux.error, "lm")))
}
