//! Writing of the compact binary format of datasets.

use super::{FIRST, MAGIC, VERSION, split_planes};
use crate::compute::basis::RingBasis;
use crate::compute::btdf::{
    AngularTransmittance, Band, Btdf, CellMatrix, Component, Dataset, Finding, Scattered, Severity, TensorTree,
    Thermal, TreeAxes, TreeNode, TreeRank,
};
use crate::compute::wavelet::CompactRows;
use crate::formats::compact_rows;
use std::borrow::Cow;

/// Returns a dataset in the binary format. Equal datasets always give equal bytes.
pub fn encode(dataset: &Dataset) -> Vec<u8> {
    with_words(dataset, words(dataset), &dataset.findings, &functions(dataset))
}

/// Returns a dataset in the binary format like [`encode`], and also the bytes of a copy without texts (names,
/// description, bases) and findings. The functions are compressed only once.
pub fn encode_with_wordless(dataset: &Dataset) -> [Vec<u8>; 2] {
    let functions = functions(dataset);
    [with_words(dataset, words(dataset), &dataset.findings, &functions), with_words(dataset, [""; 7], &[], &functions)]
}

fn words(dataset: &Dataset) -> [&str; 7] {
    [
        &dataset.name,
        &dataset.manufacturer,
        &dataset.description,
        &dataset.state,
        &dataset.format,
        &dataset.incident_basis,
        &dataset.emergent_basis,
    ]
}

fn functions(dataset: &Dataset) -> Writer {
    let mut out = Writer(Vec::new());
    out.byte(u8::from(dataset.thickness.is_some()));
    if let Some(thickness) = dataset.thickness {
        out.number(thickness);
    }
    out.band(&dataset.visible);
    out.byte(u8::from(dataset.solar.is_some()));
    if let Some(solar) = &dataset.solar {
        out.band(solar);
    }
    out.byte(mask(dataset.derived.iter().copied()));
    out
}

fn with_words(dataset: &Dataset, words: [&str; 7], findings: &[Finding], functions: &Writer) -> Vec<u8> {
    let mut out = Writer(MAGIC.to_vec());
    // Only where thermal data are known: other datasets keep the bytes, and with them the name, that they always had.
    let version = if dataset.thermal.is_empty() { FIRST } else { VERSION };
    out.byte(version);
    words.into_iter().for_each(|text| out.text(text));
    out.0.extend(&functions.0);
    out.findings(findings);
    if version > FIRST {
        out.thermal(&dataset.thermal);
    }
    // Only where it is known, for the same reason.
    if let Some(structure) = dataset.structure {
        out.number(structure);
    }
    out.0
}

/// Returns a bit mask of the given components, in the order of [`Component::ALL`].
fn mask(components: impl Iterator<Item = Component>) -> u8 {
    components.fold(0, |mask, component| {
        mask | 1 << Component::ALL.iter().position(|&one| one == component).expect("ALL holds every component")
    })
}

struct Writer(Vec<u8>);

impl Writer {
    fn byte(&mut self, byte: u8) {
        self.0.push(byte);
    }

    fn count(&mut self, count: usize) {
        let count = u32::try_from(count).expect("no part of a dataset in memory has 2³² items");
        self.0.extend(count.to_le_bytes());
    }

    fn number(&mut self, number: f64) {
        self.0.extend(number.to_le_bytes());
    }

    fn text(&mut self, text: &str) {
        self.count(text.len());
        self.0.extend(text.as_bytes());
    }

    /// Writes thermal data: kind of device, number of known values, and each value with its index in `ThermalKey::ALL`.
    fn thermal(&mut self, thermal: &Thermal) {
        self.text(&thermal.device);
        self.count(thermal.known().count());
        for (key, value) in thermal.known() {
            self.byte(key as u8);
            self.number(value);
        }
    }

    fn band(&mut self, band: &Band) {
        self.byte(mask(band.components().into_iter()));
        for component in band.components() {
            let btdf = band.get(component).expect("components() lists what is there");
            let turned = component == Component::TransmissionBack
                && band.transmission_front.as_ref().is_some_and(|front| is_front_turned(front, btdf));
            self.byte(u8::from(turned));
            if !turned {
                self.btdf(btdf);
            }
        }
    }

    fn btdf(&mut self, btdf: &Btdf) {
        self.byte(u8::from(btdf.regular.is_some()));
        if let Some(regular) = &btdf.regular {
            self.angular(regular);
        }
        match &btdf.scattered {
            None => self.byte(0),
            Some(Scattered::Lambert(tau)) => {
                self.byte(1);
                self.angular(tau);
            }
            Some(Scattered::Cells(matrix)) => {
                let compact = matrix.compact_rows();
                self.byte(if compact.is_some() { 5 } else { 2 });
                self.basis(matrix.incident());
                self.basis(matrix.emergent());
                match compact {
                    Some(rows) => self.compact(rows),
                    None => self.values(matrix.incident().len(), matrix.emergent().len(), |row| matrix.row(row)),
                }
            }
            Some(Scattered::Directions(data)) => {
                let compact = data.compact_rows();
                self.byte(if compact.is_some() { 6 } else { 4 });
                self.count(data.incident().len());
                for direction in data.incident() {
                    direction.0.vector().to_array().into_iter().for_each(|x| self.number(x));
                }
                self.basis(data.emergent());
                match compact {
                    Some(rows) => self.compact(rows),
                    None => self.values(data.incident().len(), data.emergent().len(), |row| data.row(row)),
                }
            }
            Some(Scattered::Tree(tree)) => {
                self.byte(3);
                self.tree(tree);
            }
        }
    }

    fn angular(&mut self, tau: &AngularTransmittance) {
        match tau {
            AngularTransmittance::Constant(value) => {
                self.byte(0);
                self.number(*value);
            }
            AngularTransmittance::Table(values) | AngularTransmittance::Estimated { tau: values, .. } => {
                self.byte(1);
                self.count(values.len());
                values.iter().for_each(|value| self.number(*value));
            }
        }
    }

    fn basis(&mut self, basis: &RingBasis) {
        self.text(basis.name());
        self.number(basis.azimuth().sign);
        self.number(basis.azimuth().offset);
        self.count(basis.rings().len());
        for ring in basis.rings() {
            self.number(ring.theta_min);
            self.number(ring.theta_max);
            self.count(ring.sectors);
            self.number(ring.first_phi);
        }
    }

    fn compact(&mut self, rows: &CompactRows) {
        let bytes = compact_rows::write(rows);
        self.count(bytes.len());
        self.0.extend(bytes);
    }

    /// Writes `rows` rows of `columns` values each; `row` returns one of them, so that very large functions are never
    /// uncompressed as a whole.
    fn values<'a>(&mut self, rows: usize, columns: usize, row: impl Fn(usize) -> Cow<'a, [f64]>) {
        let values = (0..rows).flat_map(|k| row(k).into_owned());
        let planes = split_planes(rows * columns, values);
        let packed = zstd::bulk::compress(&planes, 1).expect("compression into memory does not fail");
        self.count(rows * columns);
        self.count(packed.len());
        self.0.extend(packed);
    }

    /// Writes a tensor tree, compressed: one byte per node for its kind, the indices of the branches' first children,
    /// then the values of the leaves.
    fn tree(&mut self, tree: &TensorTree) {
        self.byte(if tree.rank() == TreeRank::Three { 3 } else { 4 });
        self.byte(u8::from(tree.axes() == TreeAxes::Back));
        let mut plain: Vec<u8> =
            tree.nodes().iter().map(|node| u8::from(matches!(node, TreeNode::Branch(_)))).collect();
        let mut leaves = Vec::new();
        let mut branches = 0;
        for node in tree.nodes() {
            match node {
                TreeNode::Leaf(q) => leaves.push(*q),
                TreeNode::Branch(first) => {
                    plain.extend(first.to_le_bytes());
                    branches += 1;
                }
            }
        }
        plain.extend(split_planes(leaves.len(), leaves.iter().copied()));
        let packed = zstd::bulk::compress(&plain, 1).expect("compression into memory does not fail");
        self.count(tree.nodes().len());
        self.count(branches);
        self.count(packed.len());
        self.0.extend(packed);
    }

    fn findings(&mut self, findings: &[Finding]) {
        self.count(findings.len());
        for finding in findings {
            self.byte(match finding.severity {
                Severity::Info => 0,
                Severity::Warning => 1,
                Severity::Error => 2,
            });
            self.text(finding.code);
            self.text(&finding.message);
        }
    }
}

/// Whether the back transmission follows from the front one by reciprocity, so that it need not be stored.
fn is_front_turned(front: &Btdf, back: &Btdf) -> bool {
    let (Some(Scattered::Cells(f)), Some(Scattered::Cells(b))) = (&front.scattered, &back.scattered) else {
        return false;
    };
    // What is compact keeps its own bytes.
    if b.compact_rows().is_some() {
        return false;
    }
    let same_cells = f.incident() == b.emergent() && f.emergent() == b.incident();
    // As stored: what is read back is written the same again.
    let same = |a: f64, b: f64| (a as f32).to_bits() == (b as f32).to_bits();
    let turned = |f: &CellMatrix, b: &CellMatrix| {
        let (n, m) = (f.incident().len(), f.emergent().len());
        let (f, b) = (f.values(), b.values());
        (0..n).all(|i| (0..m).all(|o| same(f[i * m + o], b[o * n + i])))
    };
    front.regular == back.regular && same_cells && turned(f, b)
}
