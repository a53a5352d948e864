//! Writing of BSDF XML as tensor trees (`TensorTree3`, `TensorTree4`), for Radiance and other readers of such trees.
//!
//! Tensor trees of the requested rank are written unchanged, leaf by leaf: numbers of at most ten digits, in the
//! shortest form that reads back the same. Every other function is averaged over a grid and pruned by [`tree_on`]; a
//! finding reports the loss. Functions that were derived when the dataset was read are left out unless they are
//! requested, since this program's reader derives them again: a file that is read and written again contains the same
//! blocks. Radiance does not derive them for rank 3. The Geometry element is empty.

use super::beams;
use super::material;
use super::write::opening;
use crate::compute::btdf::{
    Band, Btdf, Component, Dataset, Finding, Scattered, TensorTree, TreeAxes, TreeNode, TreeRank, TreeShape, tree_on,
};
use crate::formats::Written;
use crate::formats::location::{FormatError, Location};
use std::fmt::Write as _;

/// Options for writing tensor trees: rank, resolution, pruning and derived functions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TreeForm {
    /// Rank of the trees, 3 or 4.
    pub rank: TreeRank,
    /// Resolution: base-2 logarithm of the number of steps along each coordinate; `None`: that of the source, at most 6
    /// (64 steps).
    pub level: Option<u32>,
    /// Maximum share of the flux that pruning may misplace, 0 … 1; `None`: trees of the rank are written unchanged,
    /// other functions are pruned with [`TreeForm::TOLERANCE`].
    pub tolerance: Option<f64>,
    /// Whether functions that were derived by reciprocity when the dataset was read are written too.
    pub derived: bool,
}

impl TreeForm {
    /// Default maximum share of the flux that pruning may misplace.
    pub const TOLERANCE: f64 = 0.01;

    /// Creates the default options for trees of the given rank.
    pub const fn of_rank(rank: TreeRank) -> Self {
        Self { rank, level: None, tolerance: None, derived: false }
    }
}

/// Returns the rank of a dataset whose functions are all pure tensor trees of that rank, which can be written
/// unchanged; `None` for other datasets.
pub fn rank_of(dataset: &Dataset) -> Option<TreeRank> {
    let mut ranks = bands(dataset).flat_map(|(_, band)| {
        band.components().into_iter().filter_map(|component| band.get(component)).map(|btdf| {
            match (&btdf.regular, &btdf.scattered) {
                (None, Some(Scattered::Tree(tree))) => Some(tree.rank()),
                _ => None,
            }
        })
    });
    let first = ranks.next()??;
    ranks.all(|rank| rank == Some(first)).then_some(first)
}

fn bands(dataset: &Dataset) -> impl Iterator<Item = (&'static str, &Band)> {
    std::iter::once(("Visible", &dataset.visible)).chain(dataset.solar.iter().map(|band| ("Solar", band)))
}

/// Returns a BSDF XML file of a dataset, with tensor trees.
///
/// # Errors
/// Returns an error if the dataset has no visible function, or if [`tree_on`] refuses the options.
pub fn write_tree(dataset: &Dataset, form: TreeForm) -> Result<Written, FormatError> {
    if dataset.visible.components().is_empty() {
        return Err(FormatError::new(Location::file(), "a dataset without visible functions", "at least one to write"));
    }
    let mut findings = Vec::new();
    let mut xml = String::new();
    head(&mut xml, dataset, form.rank);
    for (name, band) in bands(dataset) {
        for component in band.components() {
            let Some(btdf) = band.get(component) else { continue };
            let title = component.key().replace('_', " ");
            if name == "Visible" && dataset.derived.contains(&component) {
                let (code, what) = if form.derived {
                    ("derived-written", "derived, written like a block of the source")
                } else {
                    ("derived-left-out", "derived and not written; programs that read the file can derive it")
                };
                findings.push(Finding::info(code, format!("{title}: {what}.")));
                if !form.derived {
                    continue;
                }
            }
            let tree = tree_of(btdf, component, form, &format!("{title} ({name})"), &mut findings)?;
            block(&mut xml, &tree, component, name);
        }
    }
    xml.push_str("\t\t</Layer>\n\t</Optical>\n</WindowElement>\n");
    if !dataset.state.is_empty() && !beams::describes_state(dataset) {
        findings.push(Finding::info(
            "state-not-written",
            format!("The state key '{}' has no place in the format.", dataset.state),
        ));
    }
    Ok(Written { bytes: beams::added(xml, dataset).into_bytes(), findings })
}

const fn axes_of(component: Component) -> TreeAxes {
    match component {
        Component::TransmissionFront | Component::ReflectionFront => TreeAxes::Front,
        Component::TransmissionBack | Component::ReflectionBack => TreeAxes::Back,
    }
}

/// Returns a function as a tensor tree by the options `form`; a finding reports the loss that this causes.
fn tree_of(
    btdf: &Btdf,
    component: Component,
    form: TreeForm,
    title: &str,
    findings: &mut Vec<Finding>,
) -> Result<TensorTree, FormatError> {
    let axes = axes_of(component);
    let own = match (&btdf.regular, &btdf.scattered) {
        (None, Some(Scattered::Tree(tree))) if tree.rank() == form.rank => Some(tree),
        _ => None,
    };
    if let (Some(tree), None, None) = (own, form.level, form.tolerance) {
        findings.push(Finding::info("tree-kept", format!("{title}: a tree of {} leaves, as it was.", tree.leaves())));
        return Ok(tree.with_axes(axes));
    }
    let level = form.level.unwrap_or_else(|| TreeShape::level_for(btdf));
    // A tree that is only to be coarser is not pruned unasked.
    let tolerance = form.tolerance.unwrap_or(if own.is_some() { 0.0 } else { TreeForm::TOLERANCE });
    let made = tree_on(btdf, axes, TreeShape { rank: form.rank, level, tolerance })
        .map_err(|error| FormatError::new(Location::file(), format!("{title}: {error}"), "a smaller tree"))?;
    findings.push(Finding::info(
        "tree-made",
        format!(
            "{title}: a tree of rank {}, level {level}, {} leaves; pruning misplaces {:.2} % of the light and changes τ by \
             {:.4} at most.",
            form.rank.dimensions(),
            made.tree.leaves(),
            100.0 * made.misplaced,
            made.tau_change
        ),
    ));
    if btdf.regular.is_some() {
        findings.push(Finding::info(
            "regular-in-cells",
            format!("{title}: regular transmission now fills its own cell of the tree."),
        ));
    }
    if made.turned > 0.02 {
        findings.push(Finding::warning(
            "not-rotational",
            format!(
                "{title}: rank 3 keeps the mean over all azimuths; single ones differ from it by {:.0} % of their light.",
                100.0 * made.turned
            ),
        ));
    }
    Ok(made.tree)
}

fn head(xml: &mut String, dataset: &Dataset, rank: TreeRank) {
    opening(xml, dataset);
    // Other programs than WINDOW read trees: nothing is invented for them.
    material::write(xml, dataset, false);
    xml.push_str("\t\t\t<Geometry></Geometry>\n");
    let _ = writeln!(
        xml,
        "\t\t\t<DataDefinition>\n\t\t\t\t<IncidentDataStructure>TensorTree{}</IncidentDataStructure>\n\
         \t\t\t</DataDefinition>",
        rank.dimensions()
    );
}

fn block(xml: &mut String, tree: &TensorTree, component: Component, band: &str) {
    let (title, kind) = (component.words(), if component.is_transmission() { "BTDF" } else { "BRDF" });
    let _ = write!(
        xml,
        "\t\t\t<WavelengthData>\n\t\t\t\t<LayerNumber>System</LayerNumber>\n\
         \t\t\t\t<Wavelength unit=\"Integral\">{band}</Wavelength>\n\t\t\t\t<WavelengthDataBlock>\n\
         \t\t\t\t\t<WavelengthDataDirection>{title}</WavelengthDataDirection>\n\
         \t\t\t\t\t<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>\n\
         \t\t\t\t\t<ScatteringDataType>{kind}</ScatteringDataType>\n\t\t\t\t\t<ScatteringData>\n"
    );
    node(xml, tree, 0);
    xml.push_str("\t\t\t\t\t</ScatteringData>\n\t\t\t\t</WavelengthDataBlock>\n\t\t\t</WavelengthData>\n");
}

/// Writes a node of a tensor tree and all nodes below it; no deeper than [`crate::compute::basis::MAX_LEVEL`].
fn node(xml: &mut String, tree: &TensorTree, index: usize) {
    let nodes = tree.nodes();
    let TreeNode::Branch(first) = nodes[index] else {
        xml.push_str("{ ");
        leaf(xml, nodes[index]);
        xml.push_str("}\n");
        return;
    };
    let (first, children) = (first as usize, tree.rank().children());
    if nodes[first..first + children].iter().all(|child| matches!(child, TreeNode::Leaf(_))) {
        // A grid of 2 a coordinate, the last coordinate running fastest.
        let dimensions = tree.rank().dimensions();
        xml.push_str("{ ");
        for place in 0..children {
            let child: usize = (0..dimensions).map(|d| (place >> (dimensions - 1 - d) & 1) << d).sum();
            leaf(xml, nodes[first + child]);
        }
        xml.push_str("}\n");
        return;
    }
    xml.push_str("{\n");
    for child in first..first + children {
        node(xml, tree, child);
    }
    xml.push_str("}\n");
}

/// Writes the value of a leaf, rounded to ten digits, in the shortest notation that reads back the same.
fn leaf(xml: &mut String, node: TreeNode) {
    let TreeNode::Leaf(q) = node else { return };
    let rounded = format!("{q:.9e}").parse::<f64>().unwrap_or(q);
    let _ = write!(xml, "{rounded:e} ");
}
