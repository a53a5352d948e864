//! Execution of repairs of datasets. The given dataset is not changed; a repaired copy is returned.

use super::derive::by_reciprocity;
use super::repair::{BandScope, Repair, RepairKind, record};
use crate::compute::basis::{AzimuthMap, Cell, RingBasis, disk_from_square};
use crate::compute::btdf::{
    Band, Btdf, CellMatrix, Component, Dataset, Indicatrices, Scattered, TensorTree, TreeAxes, TreeNode, TreeRank,
    resample_matrix,
};
use crate::compute::direction::{Dir, Facade, Incident};
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::Arc;

/// Reason why a repair of a dataset cannot be made.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RepairError {
    /// Dataset that has none of the functions to be repaired.
    #[error("{0}: the dataset has no such function")]
    Nothing(Repair),
    /// Function to be derived by reciprocity whose counterpart of the other side is missing.
    #[error("{0}: the counterpart that it would be made from is missing")]
    NoCounterpart(Repair),
    /// Kind of data (e.g. a tensor tree) that does not allow the repair.
    #[error("{repair}: {what}")]
    Form {
        /// Requested repair.
        repair: Repair,
        /// Obstacle to the repair, as text.
        what: &'static str,
    },
}

/// Returns a repaired copy of a dataset. The repair is recorded in its description, see [`record`]; the findings remain
/// those of the source file.
///
/// # Errors
/// Returns an error if the dataset lacks the functions or their counterpart, or if the kind of its data does not allow
/// the repair.
pub fn repaired(dataset: &Dataset, repair: Repair) -> Result<Dataset, RepairError> {
    let mut out = dataset.clone();
    let mut done = false;
    if repair.bands != BandScope::Solar {
        done |= repair_band(&mut out.visible, repair)?;
        for component in &dataset.derived {
            rederive(&mut out.visible, *component, repair);
        }
        if matches!(repair.kind, RepairKind::DropBlock) {
            out.derived.retain(|component| out.visible.get(*component).is_some());
        }
        if let (RepairKind::DeriveByReciprocity, super::BlockScope::One(component)) = (repair.kind, repair.blocks)
            && !out.derived.contains(&component)
        {
            out.derived.push(component);
        }
        if repair.kind == RepairKind::SwapSides {
            for component in &mut out.derived {
                *component = component.other_side();
            }
        }
    }
    if repair.bands != BandScope::Visible
        && let Some(solar) = &mut out.solar
    {
        done |= repair_band(solar, repair)?;
    }
    if !done {
        return Err(RepairError::Nothing(repair));
    }
    if repair == Repair::whole(RepairKind::SwapSides) {
        // The whole product is turned round, its coatings with it.
        out.thermal = out.thermal.swapped();
    }
    out.description = record(&out.description, &[repair]);
    // Repaired data are no longer those of the description.
    out.described = None;
    Ok(out)
}

/// Derives a transmission by reciprocity again if the repair changed the transmission of the other side that it was
/// derived from: factors of emergent angles do not apply to the light in the reverse direction.
fn rederive(band: &mut Band, component: Component, repair: Repair) {
    let factor = matches!(
        repair.kind,
        RepairKind::RemoveCosine
            | RepairKind::MultiplyCosine
            | RepairKind::RemoveSolidAngle
            | RepairKind::MultiplySolidAngle
    );
    let alone = !repair.blocks.holds(component);
    let whole = matches!(repair.kind, RepairKind::DropBlock | RepairKind::DeriveByReciprocity | RepairKind::SwapSides);
    let origin = component.other_side();
    if repair.blocks.holds(origin)
        && !whole
        && (factor || alone)
        && let Some((made, _)) = band.get(origin).and_then(|origin| by_reciprocity(origin, component.is_front()))
    {
        band.set(component, made);
    }
}

/// Returns a copy of a dataset with several repairs made, one after the other.
///
/// # Errors
/// Returns the error of the first repair that cannot be made.
pub fn repaired_all(dataset: &Dataset, repairs: &[Repair]) -> Result<Dataset, RepairError> {
    repairs.iter().try_fold(dataset.clone(), |dataset, repair| repaired(&dataset, *repair))
}

/// Repairs one band in place, and returns whether it has any of the functions to be repaired.
fn repair_band(band: &mut Band, repair: Repair) -> Result<bool, RepairError> {
    let meant: Vec<Component> = Component::ALL.into_iter().filter(|c| repair.blocks.holds(*c)).collect();
    match repair.kind {
        RepairKind::DropBlock => {
            let dropped = meant.iter().map(|component| band.place(*component).take().is_some());
            Ok(dropped.fold(false, |any, one| any | one))
        }
        RepairKind::DeriveByReciprocity => {
            for component in &meant {
                let front = match component {
                    Component::TransmissionFront => true,
                    Component::TransmissionBack => false,
                    Component::ReflectionFront | Component::ReflectionBack => continue,
                };
                let given = band.get(component.other_side()).ok_or(RepairError::NoCounterpart(repair))?;
                let (made, _) = by_reciprocity(given, front).ok_or(RepairError::Form {
                    repair,
                    what: "single incident directions have no reverse; give them as a matrix",
                })?;
                band.set(*component, made);
                return Ok(true);
            }
            Ok(false)
        }
        RepairKind::SwapSides => {
            let mut done = false;
            for (front, back) in [
                (Component::TransmissionFront, Component::TransmissionBack),
                (Component::ReflectionFront, Component::ReflectionBack),
            ] {
                if !repair.blocks.holds(front) && !repair.blocks.holds(back) {
                    continue;
                }
                let (f, b) = (band.place(front).take(), band.place(back).take());
                done |= f.is_some() || b.is_some();
                *band.place(front) =
                    b.map(|btdf| relabelled(btdf, TreeAxes::Front)).transpose().map_err(form(repair))?;
                *band.place(back) = f.map(|btdf| relabelled(btdf, TreeAxes::Back)).transpose().map_err(form(repair))?;
            }
            Ok(done)
        }
        _ => {
            let mut done = false;
            for component in meant {
                if let Some(btdf) = band.place(component) {
                    *btdf = changed(btdf, repair.kind).map_err(form(repair))?;
                    done = true;
                }
            }
            Ok(done)
        }
    }
}

fn form(repair: Repair) -> impl Fn(&'static str) -> RepairError {
    move |what| RepairError::Form { repair, what }
}

/// Returns the same values as a function of the other side, for which files count azimuths from a direction 180°
/// further.
fn relabelled(btdf: Btdf, axes: TreeAxes) -> Result<Btdf, &'static str> {
    let scattered = match btdf.scattered {
        Some(Scattered::Tree(tree)) => {
            let tree = TensorTree::new(tree.rank(), axes, tree.nodes().to_vec());
            Some(Scattered::Tree(Box::new(tree.map_err(|_| "a damaged tree")?)))
        }
        Some(Scattered::Cells(matrix)) if is_klems(matrix.incident()) && is_klems(matrix.emergent()) => {
            let basis = |basis: &RingBasis| basis.clone().with_azimuth(axes.azimuth());
            let values = matrix.values().into_owned();
            let matrix = CellMatrix::new(basis(matrix.incident()), basis(matrix.emergent()), values);
            Some(Scattered::Cells(Box::new(matrix.expect("the same count as before"))))
        }
        other => turned(other, Mirror { x: true, y: true })?,
    };
    Ok(Btdf { regular: btdf.regular, scattered })
}

fn is_klems(basis: &RingBasis) -> bool {
    matches!(basis.azimuth(), AzimuthMap::KLEMS_FRONT | AzimuthMap::KLEMS_BACK)
}

/// Returns one function with a repair of the given kind made, for repairs that change functions one by one.
fn changed(btdf: &Btdf, kind: RepairKind) -> Result<Btdf, &'static str> {
    let mirror = |x, y| -> Result<Btdf, &'static str> {
        Ok(Btdf { regular: btdf.regular.clone(), scattered: turned(btdf.scattered.clone(), Mirror { x, y })? })
    };
    match kind {
        RepairKind::TurnUpsideDown => mirror(false, true),
        RepairKind::MirrorLeftRight => mirror(true, false),
        RepairKind::TurnHalfRound => mirror(true, true),
        RepairKind::Transpose => transposed(btdf),
        RepairKind::DivideBy100 => scaled(btdf, true, |_| 0.01),
        RepairKind::MultiplyBy100 => scaled(btdf, true, |_| 100.0),
        RepairKind::RemoveCosine => scaled(btdf, false, |cell| 1.0 / cell.theta().cos()),
        RepairKind::MultiplyCosine => scaled(btdf, false, |cell| cell.theta().cos()),
        RepairKind::RemoveSolidAngle => scaled(btdf, false, |cell| 1.0 / cell.projected_solid_angle()),
        RepairKind::MultiplySolidAngle => scaled(btdf, false, Cell::projected_solid_angle),
        RepairKind::ClampNegative => clamped(btdf),
        RepairKind::DropBlock | RepairKind::DeriveByReciprocity | RepairKind::SwapSides => Ok(btdf.clone()),
    }
}

/// Axes of the façade frame that are reversed: x (left and right), y (up and down).
#[derive(Clone, Copy)]
struct Mirror {
    x: bool,
    y: bool,
}

impl Mirror {
    fn of(self, d: Dir<Facade>) -> Dir<Facade> {
        let v = d.vector();
        Dir::from_unit(DVec3::new(if self.x { -v.x } else { v.x }, if self.y { -v.y } else { v.y }, v.z))
    }

    /// Returns the cells in the same order, each with its directions mirrored.
    fn basis(self, basis: &RingBasis) -> RingBasis {
        let own = basis.azimuth();
        let azimuth = match (self.x, self.y) {
            (false, false) => own,
            (true, true) => AzimuthMap { offset: own.offset + PI, ..own },
            (false, true) => AzimuthMap { sign: -own.sign, offset: -own.offset },
            (true, false) => AzimuthMap { sign: -own.sign, offset: PI - own.offset },
        };
        basis.clone().with_azimuth(azimuth)
    }
}

/// Returns scattered data with all incident and emergent directions mirrored.
fn turned(scattered: Option<Scattered>, mirror: Mirror) -> Result<Option<Scattered>, &'static str> {
    Ok(Some(match scattered {
        None => return Ok(None),
        Some(lambert @ Scattered::Lambert(_)) => lambert,
        Some(Scattered::Cells(matrix)) => {
            // Turned by name, then counted as before: exact where turned cells fall onto cells.
            let (incident, emergent) = (mirror.basis(matrix.incident()), mirror.basis(matrix.emergent()));
            let values = matrix.values().into_owned();
            let by_name = CellMatrix::new(incident, emergent, values).expect("the same count as before");
            Scattered::Cells(Box::new(resample_matrix(&by_name, matrix.incident(), matrix.emergent())))
        }
        Some(Scattered::Directions(data)) => {
            let emergent = mirror.basis(data.emergent());
            let turned: Vec<Incident> = data.incident().iter().map(|d| Incident(mirror.of(d.0))).collect();
            // In the order of the old list where the directions are the same ones, so that a lattice stays one.
            let order: Vec<usize> = data.incident().iter().map(|d| nearest(&turned, d.0)).collect();
            let same =
                order.iter().zip(data.incident()).all(|(k, d)| (turned[*k].0.vector() - d.0.vector()).length() < 2e-3);
            let (list, order) =
                if same { (data.incident().to_vec(), order) } else { (turned, (0..data.incident().len()).collect()) };
            let values = order.iter().flat_map(|k| data.row(*k).into_owned()).collect();
            Scattered::Directions(Arc::new(
                Indicatrices::new(list, emergent, values).ok_or("directions that coincide")?,
            ))
        }
        Some(Scattered::Tree(tree)) => {
            // Bit d of a child's number is the half of dimension d; a mirror exchanges the halves.
            let flip = match tree.rank() {
                TreeRank::Four => (if mirror.x { 0b0101 } else { 0 }) | (if mirror.y { 0b1010 } else { 0 }),
                // Rotationally symmetric: only the sense of rotation can change.
                TreeRank::Three => {
                    if mirror.x == mirror.y {
                        0
                    } else {
                        0b100
                    }
                }
            };
            let mut nodes = vec![TreeNode::Leaf(0.0)];
            copy_flipped(&tree, 0, 0, flip, &mut nodes);
            let tree = TensorTree::new(tree.rank(), tree.axes(), nodes).map_err(|_| "a damaged tree")?;
            Scattered::Tree(Box::new(tree))
        }
    }))
}

fn nearest(list: &[Incident], d: Dir<Facade>) -> usize {
    let cosine = |k: usize| list[k].0.dot(d);
    (1..list.len()).fold(0, |best, k| if cosine(k) > cosine(best) { k } else { best })
}

fn copy_flipped(tree: &TensorTree, from: usize, to: usize, flip: usize, nodes: &mut Vec<TreeNode>) {
    match tree.nodes()[from] {
        leaf @ TreeNode::Leaf(_) => nodes[to] = leaf,
        TreeNode::Branch(first) => {
            let (start, children) = (nodes.len(), tree.rank().children());
            nodes[to] = TreeNode::Branch(start as u32);
            nodes.resize(start + children, TreeNode::Leaf(0.0));
            for child in 0..children {
                copy_flipped(tree, first as usize + (child ^ flip), start + child, flip, nodes);
            }
        }
    }
}

fn transposed(btdf: &Btdf) -> Result<Btdf, &'static str> {
    let scattered = match &btdf.scattered {
        None => None,
        Some(lambert @ Scattered::Lambert(_)) => Some(lambert.clone()),
        Some(Scattered::Cells(matrix)) => Some(Scattered::Cells(Box::new(matrix.reversed()))),
        Some(Scattered::Tree(tree)) if tree.rank() == TreeRank::Four => {
            Some(Scattered::Tree(Box::new(tree.reversed())))
        }
        Some(Scattered::Tree(_)) => return Err("incident and emergent coordinates of a rank-3 tree differ"),
        Some(Scattered::Directions(_)) => return Err("single incident directions have no transpose"),
    };
    Ok(Btdf { regular: btdf.regular.clone(), scattered })
}

/// Returns a function with its values multiplied by a factor of the emergent cell; `all`: the regular part as well.
fn scaled(btdf: &Btdf, all: bool, factor: impl Fn(&Cell) -> f64) -> Result<Btdf, &'static str> {
    // With `all` the factor is the same for every cell.
    let anywhere = factor(&RingBasis::hemisphere().cell(0));
    // What a file's author did to the values was done to the emergent cells: every row takes the same factors.
    let rows = |basis: &RingBasis, values: &[f64]| -> Vec<f64> {
        let factors: Vec<f64> = basis.cells().map(|cell| factor(&cell)).collect();
        values.chunks_exact(factors.len()).flat_map(|row| row.iter().zip(&factors).map(|(q, f)| q * f)).collect()
    };
    let scattered = match &btdf.scattered {
        None => None,
        Some(Scattered::Lambert(tau)) if all => Some(Scattered::Lambert(tau.scaled(anywhere))),
        // A factor of the cell would make it something else than a diffuser.
        Some(Scattered::Lambert(_)) => return Err("an ideal diffuser has no value for every direction"),
        Some(Scattered::Cells(matrix)) => {
            let values = rows(matrix.emergent(), &matrix.values());
            let matrix = CellMatrix::new(matrix.incident().clone(), matrix.emergent().clone(), values);
            Some(Scattered::Cells(Box::new(matrix.expect("the same count as before"))))
        }
        Some(Scattered::Directions(data)) => {
            let given: Vec<f64> = (0..data.incident().len()).flat_map(|k| data.row(k).into_owned()).collect();
            let values = rows(data.emergent(), &given);
            let made = Indicatrices::new(data.incident().to_vec(), data.emergent().clone(), values);
            Some(Scattered::Directions(Arc::new(made.expect("the same directions as before"))))
        }
        Some(Scattered::Tree(tree)) => {
            // The factor varies within large leaves; the tree is kept as it is and each leaf takes it at its middle.
            let mut nodes = tree.nodes().to_vec();
            scale_leaves(tree, 0, [0.0; 2], 1.0, &factor, &mut nodes);
            let tree = TensorTree::new(tree.rank(), tree.axes(), nodes).map_err(|_| "values beyond all numbers")?;
            Some(Scattered::Tree(Box::new(tree)))
        }
    };
    // τ of unscattered light is not a density: cosines and solid angles were never in it, a factor of 100 may be.
    let regular = btdf.regular.as_ref().map(|tau| if all { tau.scaled(anywhere) } else { tau.clone() });
    Ok(Btdf { regular, scattered })
}

/// Copies a subtree of a tensor tree to `nodes` with its leaves multiplied by the factor at the middle of their
/// emergent square, which is treated as a cell of the same size.
fn scale_leaves(
    tree: &TensorTree,
    node: usize,
    corner: [f64; 2],
    side: f64,
    factor: &impl Fn(&Cell) -> f64,
    nodes: &mut Vec<TreeNode>,
) {
    match tree.nodes()[node] {
        TreeNode::Leaf(q) => {
            let [x, y] = disk_from_square([corner[0] + 0.5 * side, corner[1] + 0.5 * side]);
            let theta = x.hypot(y).min(1.0).asin();
            // A thin ring at that angle whose projected solid angle is that of the square, π a side².
            let half = 1e-4_f64.min(theta).min(0.5 * PI - theta).max(1e-6);
            let (theta_min, theta_max) = ((theta - half).max(0.0), (theta + half).min(0.5 * PI));
            let span = (theta_max - theta_min).sin() * (theta_max + theta_min).sin();
            let width = 2.0 * PI * side * side / span;
            let cell = Cell { theta_min, theta_max, phi_own: 0.0, phi: 0.0, width: width.min(1.9 * PI) };
            nodes[node] = TreeNode::Leaf(q * factor(&cell));
        }
        TreeNode::Branch(first) => {
            let emergent = tree.rank().dimensions() - 2;
            for child in 0..tree.rank().children() {
                let half = 0.5 * side;
                let at = |d: usize| if child >> (emergent + d) & 1 == 1 { half } else { 0.0 };
                let corner = [corner[0] + at(0), corner[1] + at(1)];
                scale_leaves(tree, first as usize + child, corner, half, factor, nodes);
            }
        }
    }
}

/// Returns a function with negative values replaced by 0.
fn clamped(btdf: &Btdf) -> Result<Btdf, &'static str> {
    let scattered = match &btdf.scattered {
        Some(Scattered::Cells(matrix)) => {
            let values = matrix.values().iter().map(|q| q.max(0.0)).collect();
            let matrix = CellMatrix::new(matrix.incident().clone(), matrix.emergent().clone(), values);
            Some(Scattered::Cells(Box::new(matrix.expect("the same count as before"))))
        }
        Some(Scattered::Directions(data)) => {
            let values: Vec<f64> = (0..data.incident().len())
                .flat_map(|k| data.row(k).iter().map(|q| q.max(0.0)).collect::<Vec<_>>())
                .collect();
            let made = Indicatrices::new(data.incident().to_vec(), data.emergent().clone(), values);
            Some(Scattered::Directions(Arc::new(made.expect("the same directions as before"))))
        }
        other => other.clone(),
    };
    Ok(Btdf { regular: btdf.regular.clone(), scattered })
}
