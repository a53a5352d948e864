//! The public reference cases of the numerical goniophotometer: system, table of τ and ρ, best matrices.

use cfs::compute::basis::{AzimuthMap, RingBasis, same_cells};
use cfs::compute::btdf::{Band, Btdf, Component, Scattered};
use cfs::compute::system::measure::Side;
use cfs::compute::system::slats::SlatProfile;
use cfs::compute::system::slats::{SlatArray, Surface};
use std::io::Read;
use std::path::{Path, PathBuf};

/// Folder of the cases in the public data.
pub const FOLDER: &str = "reference/cases/goniophotometer";

/// The cells of the tables, by index.
pub fn klems() -> RingBasis {
    RingBasis::klems_full(AzimuthMap::KLEMS_FRONT)
}

/// Cells of [`klems`] in the order of the tables' rows, which count the travelling light from either side.
pub fn rows(side: Side) -> Vec<usize> {
    let own = match side {
        Side::Front => klems(),
        Side::Back => klems().with_azimuth(AzimuthMap::KLEMS_BACK),
    };
    same_cells(&klems(), &own).unwrap()
}

/// One state of one venetian blind.
pub struct Case {
    pub name: String,
    pub array: SlatArray,
    /// Rows of the table by column name.
    pub header: Vec<String>,
    pub rows: Vec<Vec<f64>>,
    pub best: Band,
}

impl Case {
    /// A column of the table; `None` where the table lacks it or leaves it empty.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let k = self.header.iter().position(|column| column == name)?;
        let values: Vec<f64> = self.rows.iter().map(|row| row[k]).collect();
        values.iter().all(|x| x.is_finite()).then_some(values)
    }
}

fn number(table: &toml::Table, key: &str, default: f64) -> f64 {
    table.get(key).map_or(default, |v| v.as_float().or_else(|| v.as_integer().map(|i| i as f64)).unwrap())
}

fn surface(table: &toml::Table, key: &str) -> Surface {
    let table = table[key].as_table().unwrap();
    Surface {
        diffuse: number(table, "reflectance", 0.0),
        mirror: number(table, "specular", 0.0),
        spread: number(table, "roughness", 0.0).to_radians(),
    }
}

/// Bytes of a gzip file: its deflate stream in the shell of a zip archive, which a crate of the program reads.
pub fn gunzip(bytes: &[u8]) -> Vec<u8> {
    assert!(bytes[..3] == [0x1f, 0x8b, 8], "not gzip");
    let mut start = 10;
    if bytes[3] & 8 != 0 {
        start += bytes[start..].iter().position(|&b| b == 0).unwrap() + 1;
    }
    let (data, tail) = bytes[start..].split_at(bytes.len() - start - 8);
    let mut common = vec![20, 0, 0, 0, 8, 0, 0, 0, 33, 0];
    common.extend(&tail[..4]);
    common.extend((data.len() as u32).to_le_bytes());
    common.extend(&tail[4..]);
    common.extend([1, 0, 0, 0]);
    let mut zip = b"PK\x03\x04".to_vec();
    zip.extend(&common);
    zip.push(b'x');
    zip.extend(data);
    let directory = zip.len();
    zip.extend(b"PK\x01\x02\x14\x00");
    zip.extend(&common);
    zip.extend([0; 14]);
    zip.push(b'x');
    let size = zip.len() - directory;
    zip.extend(b"PK\x05\x06\0\0\0\0\x01\0\x01\0");
    zip.extend((size as u32).to_le_bytes());
    zip.extend((directory as u32).to_le_bytes());
    zip.extend([0, 0]);
    let mut archive = zip::ZipArchive::new(std::io::Cursor::new(zip)).unwrap();
    let mut out = vec![];
    archive.by_index(0).unwrap().read_to_end(&mut out).unwrap();
    out
}

/// All states of all venetian blinds.
pub fn venetians(folder: &Path) -> Vec<Case> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    files.sort();
    let mut list = vec![];
    for path in files.iter().filter(|p| p.to_string_lossy().ends_with(".system.toml")) {
        let system: toml::Table = std::fs::read_to_string(path).unwrap().parse().unwrap();
        if system["kind"].as_str() != Some("venetian") {
            continue;
        }
        let v = system["venetian"].as_table().unwrap();
        let profile = match v.get("profile").and_then(|p| p.as_array()) {
            Some(points) => SlatProfile::Polyline(
                points.iter().map(|p| [0, 1].map(|k: usize| p.as_array().unwrap()[k].as_float().unwrap())).collect(),
            ),
            None => SlatProfile::curved(number(v, "width", 0.0), number(v, "rise", 0.0)),
        };
        for angle in v["angles"].as_array().unwrap() {
            let angle = angle.as_float().unwrap();
            let name = format!("{}_{angle}", path.file_name().unwrap().to_str().unwrap().replace(".system.toml", ""));
            let table = folder.join(format!("{name}.tau.csv"));
            if !table.exists() {
                continue;
            }
            let text = std::fs::read_to_string(table).unwrap();
            let mut lines = text.lines().filter(|line| !line.starts_with('#'));
            let header = lines.next().unwrap().split(',').map(str::to_owned).collect();
            let rows =
                lines.map(|line| line.split(',').map(|x| x.trim().parse().unwrap_or(f64::NAN)).collect()).collect();
            let xml = gunzip(&std::fs::read(folder.join(format!("{name}.xml.gz"))).unwrap());
            let best = cfs::formats::bsdf_xml::read(&xml).unwrap().visible;
            let array = SlatArray::new(
                profile.clone(),
                number(v, "thickness", 0.0),
                number(v, "spacing", 0.0),
                angle.to_radians(),
                [surface(v, "upper"), surface(v, "lower")],
            );
            list.push(Case { name, array: array.unwrap(), header, rows, best });
        }
    }
    list
}

/// A function of a band as q on the cells of [`klems`], `[i · 145 + o]`.
pub fn matrix(band: &Band, component: Component) -> Vec<f64> {
    let Some(Btdf { scattered: Some(Scattered::Cells(m)), .. }) = band.get(component) else { panic!("no cells") };
    let klems = klems();
    let (rows, columns) = (same_cells(m.incident(), &klems).unwrap(), same_cells(m.emergent(), &klems).unwrap());
    rows.iter().flat_map(|&i| columns.iter().map(move |&o| m.value(i, o))).collect()
}

/// Σ |a − b| over the flux of b, weighted by projected solid angles; without flux the mean itself.
pub fn patch_error(a: &[f64], b: &[f64]) -> f64 {
    let weight = klems().projected_solid_angles();
    let n = weight.len();
    let (mut apart, mut flux) = (0.0, 0.0);
    for k in 0..n * n {
        let w = weight[k / n] * weight[k % n];
        apart += w * (a[k] - b[k]).abs();
        flux += w * b[k];
    }
    if flux > 1e-9 { apart / flux } else { apart / std::f64::consts::PI }
}
