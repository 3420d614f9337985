//! A skeleton of a file's joints.
//!
//! Our skeletons rest with every rotation at identity, so that a joint's offset is the way from
//! its parent in the rest pose of the world. That pose is the one in which the mesh was bound,
//! not the one in which nodes happen to be; nodes between joints, rest rotations and scales
//! vanish in it. What else is made fit:
//!
//! * The root is the hips, since a motion moves the root alone: joints that the file has above the
//!   hips hang below them.
//! * A foot or hand that hangs elsewhere (on the root, for inverse kinematics) hangs on its shin or
//!   forearm.
//! * Hips that carry no vertices and are far from the thighs (a root on the ground or behind the
//!   body) turn about the point between these.
//! * Helpers (no part of the body, nothing bound to them, not below the hips) are left out.

use glam::{DAffine3, DMat4, DVec3, Vec3};
use motion_core::ids::JointIdx;
use motion_core::skeleton::{Joint, JointRole, RoleMap, Skeleton};

use super::bound;
use super::document::Document;
use super::nodes::Nodes;
use crate::diagnostic::{FileError, Warnings, quoted};
use crate::limits::{MAX_JOINT_DEPTH, MAX_JOINTS, MAX_NAME_BYTES};
use crate::roles_file::RoleOverrides;

/// Places of bound joints that differ by less than this share of the body are the same.
const SAME_SHARE: f64 = 1e-3;

/// A file's joints as a skeleton, in the file's units and axes.
pub(super) struct Body {
    /// Offsets are in the world of the rest pose; the root is at its origin.
    pub(super) skeleton: Skeleton,
    /// The node of every joint.
    pub(super) nodes: Vec<usize>,
    /// Where the node of every joint is in the world of the rest pose.
    pub(super) world_at_rest: Vec<DAffine3>,
    /// About which point of that world every joint turns: where its node is, but for hips that
    /// were moved between the thighs.
    pub(super) pivots: Vec<DVec3>,
    /// For every node its joint, where it has one.
    pub(super) joint_of_node: Vec<Option<usize>>,
}

/// A joint while the tree is being made.
struct Draft {
    node: usize,
    name: String,
    parent: Option<usize>,
    world: DAffine3,
    pivot: DVec3,
}

impl Body {
    /// The body of a file's skins; without a skin, of the nodes that are animated and all below
    /// them.
    ///
    /// `None` where there is neither.
    pub(super) fn new(
        document: &Document,
        nodes: &Nodes,
        overrides: &RoleOverrides,
        warnings: &mut Warnings,
    ) -> Result<Option<Self>, FileError> {
        let mut rest = nodes.world_at_rest();
        let mut is_joint = vec![false; rest.len()];
        if document.root.skins.is_empty() {
            mark_animated(document, nodes, &mut is_joint);
        } else {
            mark_bound(document, nodes, &mut rest, &mut is_joint)?;
        }
        if !is_joint.contains(&true) {
            return Ok(None);
        }
        let drafts = drafts(document, nodes, &rest, &is_joint)?;
        let skeleton = skeleton(document, &drafts)?;
        let skeleton = overrides.apply(skeleton, &document.path, warnings);
        let is_used = bound::used_nodes(document)?;
        let made = rearranged(document, drafts, skeleton.roles(), &is_used, warnings)?;
        Ok(Some(made))
    }
}

/// Marks the joints of all skins and gives them their places in the pose they were bound in.
fn mark_bound(
    document: &Document,
    nodes: &Nodes,
    rest: &mut [DAffine3],
    is_joint: &mut [bool],
) -> Result<(), FileError> {
    let by_default = rest.to_vec();
    for (idx, skin) in document.root.skins.iter().enumerate() {
        if skin.joints.is_empty() {
            return Err(document.error(format!("skin {idx} has no joints")));
        }
        if skin.joints.len() > MAX_JOINTS {
            let what =
                format!("skin {idx} has {} joints, more than {MAX_JOINTS}", skin.joints.len());
            return Err(document.error(what));
        }
        for joint in &skin.joints {
            if joint.value() >= rest.len() {
                let what = format!("skin {idx} has a joint {} that is no node", joint.value());
                return Err(document.error(what));
            }
        }
        let inverse_binds = inverse_binds(document, idx)?;
        let world_from_bind = world_from_bind(document, nodes, &by_default, idx, &inverse_binds);
        for (joint, inverse_bind) in skin.joints.iter().zip(&inverse_binds) {
            let joint = joint.value();
            let was_known = std::mem::replace(&mut is_joint[joint], true);
            let bind = world_from_bind * inverse_bind.inverse();
            // Matrices that are left out are all one, and say nothing about where joints are.
            if !was_known && skin.inverse_bind_matrices.is_some() && is_sound(&bind) {
                rest[joint] = bind;
            }
        }
    }
    Ok(())
}

fn is_sound(place: &DAffine3) -> bool {
    place.is_finite() && place.matrix3.determinant().abs() > 1e-18
}

/// The inverse bind matrices of a skin, identities where they are left out.
pub(super) fn inverse_binds(document: &Document, skin: usize) -> Result<Vec<DAffine3>, FileError> {
    let skin_json = &document.root.skins[skin];
    let Some(accessor) = skin_json.inverse_bind_matrices else {
        return Ok(vec![DAffine3::IDENTITY; skin_json.joints.len()]);
    };
    let matrices = document.floats::<16>(accessor.value())?;
    if matrices.len() < skin_json.joints.len() {
        return Err(document.error(format!("skin {skin} has fewer matrices than joints")));
    }
    Ok(matrices
        .iter()
        .map(|m| DAffine3::from_mat4(DMat4::from_cols_array(&m.map(f64::from))))
        .collect())
}

/// What takes the space in which a skin was bound to the world.
///
/// Where nodes rest in the bound pose, all joints agree on it. Otherwise the mesh's own node says
/// it (its place has no part in skinning, but programs keep it true), unless its size is another
/// than the joints'.
fn world_from_bind(
    document: &Document,
    nodes: &Nodes,
    by_default: &[DAffine3],
    skin: usize,
    inverse_binds: &[DAffine3],
) -> DAffine3 {
    let joints = &document.root.skins[skin].joints;
    let all: Vec<DAffine3> =
        joints.iter().zip(inverse_binds).map(|(j, bind)| by_default[j.value()] * *bind).collect();
    let top = (0..joints.len()).min_by_key(|&at| nodes.depths[joints[at].value()]).unwrap_or(0);
    let first = all[top];
    let size = |place: &DAffine3| place.matrix3.determinant().abs().cbrt();
    let reach = inverse_binds.iter().map(|bind| bind.translation.length()).fold(0.0, f64::max);
    let tolerance = SAME_SHARE * size(&first) * reach.max(1e-9);
    let agrees = |place: &DAffine3| {
        let turned = (place.matrix3 - first.matrix3).to_cols_array();
        let turn = turned.iter().fold(0.0_f64, |worst, value| worst.max(value.abs()));
        turn < 10.0 * SAME_SHARE * size(&first)
            && place.translation.distance(first.translation) < 10.0 * tolerance
    };
    if all.iter().all(agrees) {
        return first;
    }
    let mesh = document.root.nodes.iter().position(|n| n.skin.is_some_and(|s| s.value() == skin));
    match mesh.map(|node| by_default[node]) {
        Some(mesh) if (size(&mesh) / size(&first) - 1.0).abs() < 0.05 => mesh,
        _ => first,
    }
}

/// Marks the nodes that channels turn or move, and all below them but meshes.
fn mark_animated(document: &Document, nodes: &Nodes, is_joint: &mut [bool]) {
    for channel in document.root.animations.iter().flat_map(|a| &a.channels) {
        if let Some(joint) = is_joint.get_mut(channel.target.node.value()) {
            *joint = true;
        }
    }
    for &node in &nodes.order {
        let below = nodes.parents[node].is_some_and(|parent| is_joint[parent]);
        let is_thing =
            document.root.nodes[node].mesh.is_some() || document.root.nodes[node].camera.is_some();
        is_joint[node] |= below && !is_thing;
    }
}

/// The joints, parents first, with names of their own.
fn drafts(
    document: &Document,
    nodes: &Nodes,
    rest: &[DAffine3],
    is_joint: &[bool],
) -> Result<Vec<Draft>, FileError> {
    let n_joints = is_joint.iter().filter(|&&joint| joint).count();
    if n_joints > MAX_JOINTS {
        return Err(document.error(format!("it has {n_joints} joints, more than {MAX_JOINTS}")));
    }
    let mut seen = std::collections::HashSet::new();
    let mut drafts: Vec<Draft> = Vec::with_capacity(n_joints);
    let mut draft_of = vec![None; is_joint.len()];
    for &node in nodes.order.iter().filter(|&&node| is_joint[node]) {
        let above = nodes.ancestor(node, |above| is_joint[above]);
        let named = document.root.nodes[node].name.as_deref().unwrap_or_default();
        let mut name = String::new();
        for c in named.chars().take_while({
            let mut n_bytes = 0;
            move |c| {
                n_bytes += c.len_utf8();
                n_bytes <= MAX_NAME_BYTES
            }
        }) {
            name.push(c);
        }
        if name.is_empty() || seen.contains(&name) {
            name = format!("{name}#{node}");
        }
        seen.insert(name.clone());
        draft_of[node] = Some(drafts.len());
        let parent = above.and_then(|above| draft_of[above]);
        let (world, pivot) = (rest[node], rest[node].translation);
        drafts.push(Draft { node, name, parent, world, pivot });
    }
    hang_on_one_root(&mut drafts);
    Ok(drafts)
}

/// Of several roots, the one with most joints below it carries the others.
fn hang_on_one_root(drafts: &mut [Draft]) {
    let mut n_below = vec![1_usize; drafts.len()];
    for idx in (0..drafts.len()).rev() {
        if let Some(parent) = drafts[idx].parent {
            n_below[parent] += n_below[idx];
        }
    }
    let roots = (0..drafts.len()).filter(|&idx| drafts[idx].parent.is_none());
    let main = roots.max_by_key(|&idx| (n_below[idx], std::cmp::Reverse(idx))).unwrap_or(0);
    for (idx, draft) in drafts.iter_mut().enumerate() {
        if idx != main && draft.parent.is_none() {
            draft.parent = Some(main);
        }
    }
}

/// The order in which parents come before children, from the root; depth is limited.
fn order_of(document: &Document, parents: &[Option<usize>]) -> Result<Vec<usize>, FileError> {
    let mut children = vec![Vec::new(); parents.len()];
    for (idx, parent) in parents.iter().enumerate() {
        if let Some(parent) = parent {
            children[*parent].push(idx);
        }
    }
    let roots = (0..parents.len()).filter(|&idx| parents[idx].is_none());
    let mut stack: Vec<(usize, usize)> = roots.map(|root| (root, 0)).collect();
    let mut order = Vec::with_capacity(parents.len());
    while let Some((idx, depth)) = stack.pop() {
        if depth > MAX_JOINT_DEPTH {
            let what = format!("joints hang more than {MAX_JOINT_DEPTH} deep");
            return Err(document.error(what));
        }
        order.push(idx);
        stack.extend(children[idx].iter().rev().map(|&child| (child, depth + 1)));
    }
    Ok(order)
}

/// The skeleton of drafts, in their own order as far as parents come first.
fn skeleton(document: &Document, drafts: &[Draft]) -> Result<Skeleton, FileError> {
    let parents: Vec<Option<usize>> = drafts.iter().map(|draft| draft.parent).collect();
    // Roots come in the order of nodes, and the one that carries the others may be a later one.
    let order = order_of(document, &parents)?;
    Skeleton::new(joints(drafts, &order)).map_err(|error| document.error(error.to_string()))
}

/// Joints in `order`, the root at the origin.
fn joints(drafts: &[Draft], order: &[usize]) -> Vec<Joint> {
    let mut place_of = vec![0; drafts.len()];
    for (place, &idx) in order.iter().enumerate() {
        place_of[idx] = place;
    }
    let at = |idx: usize| drafts[idx].pivot;
    let joint = |&idx: &usize| {
        let draft = &drafts[idx];
        Joint {
            name: draft.name.clone(),
            parent: draft.parent.map(|parent| JointIdx::from_idx(place_of[parent])),
            offset_m: draft.parent.map_or(Vec3::ZERO, |parent| (at(idx) - at(parent)).as_vec3()),
            end_site_m: None,
        }
    };
    order.iter().map(joint).collect()
}

/// Roots the tree at the hips, hangs feet on shins and hands on forearms, leaves helpers out.
fn rearranged(
    document: &Document,
    mut drafts: Vec<Draft>,
    roles: &RoleMap,
    is_used: &[bool],
    warnings: &mut Warnings,
) -> Result<Body, FileError> {
    use JointRole as R;
    let parents: Vec<Option<usize>> = drafts.iter().map(|draft| draft.parent).collect();
    let order = order_of(document, &parents)?;
    let draft_of = |role: R| roles.joint(role).map(|joint| order[joint.idx()]);
    let was_below_hips = match draft_of(R::Hips) {
        Some(hips) => {
            let below = is_below(&drafts, &order, hips);
            root_at(&mut drafts, hips);
            if !is_used[drafts[hips].node] {
                let [thighs @ .., top] = [R::LeftUpLeg, R::RightUpLeg, R::Neck].map(draft_of);
                move_hips(&mut drafts, hips, thighs, top.or(draft_of(R::Head)));
            }
            below
        }
        None => vec![true; drafts.len()],
    };
    let ends = [
        (R::LeftLeg, R::LeftFoot),
        (R::RightLeg, R::RightFoot),
        (R::LeftForeArm, R::LeftHand),
        (R::RightForeArm, R::RightHand),
    ];
    for (from, to) in ends {
        let (Some(from), Some(to)) = (draft_of(from), draft_of(to)) else { continue };
        if !carries(&drafts, from, to) && !carries(&drafts, to, from) {
            let names = [to, from].map(|idx| quoted(drafts[idx].name.as_bytes()));
            let what = format!("joint {} hangs on {} here, as a body's does", names[0], names[1]);
            warnings.warn(&document.path, None, what);
            drafts[to].parent = Some(from);
        }
    }
    let has_role = |idx: usize| R::ALL.iter().any(|&role| draft_of(role) == Some(idx));
    let is_helper: Vec<bool> = (0..drafts.len())
        .map(|idx| !was_below_hips[idx] && !is_used[drafts[idx].node] && !has_role(idx))
        .collect();
    let parents: Vec<Option<usize>> = drafts.iter().map(|draft| draft.parent).collect();
    let order = order_of(document, &parents)?;
    let mut is_kept = vec![false; drafts.len()];
    for &idx in order.iter().rev() {
        is_kept[idx] |= !is_helper[idx];
        if let Some(parent) = drafts[idx].parent {
            is_kept[parent] |= is_kept[idx];
        }
    }
    let order: Vec<usize> = order.into_iter().filter(|&idx| is_kept[idx]).collect();
    let mut kept_roles = RoleMap::default();
    for &role in R::ALL {
        let place = draft_of(role).and_then(|draft| order.iter().position(|&idx| idx == draft));
        if let Some(place) = place {
            kept_roles.set(role, JointIdx::from_idx(place));
        }
    }
    let skeleton = Skeleton::new(joints(&drafts, &order))
        .map_err(|error| document.error(error.to_string()))?
        .with_roles(kept_roles);
    let nodes: Vec<usize> = order.iter().map(|&idx| drafts[idx].node).collect();
    let mut joint_of_node = vec![None; document.root.nodes.len()];
    for (joint, &node) in nodes.iter().enumerate() {
        joint_of_node[node] = Some(joint);
    }
    let world_at_rest = order.iter().map(|&idx| drafts[idx].world).collect();
    let pivots = order.iter().map(|&idx| drafts[idx].pivot).collect();
    Ok(Body { skeleton, nodes, world_at_rest, pivots, joint_of_node })
}

/// Puts hips that are further from the thighs than half of the back between these.
fn move_hips(drafts: &mut [Draft], hips: usize, thighs: [Option<usize>; 2], top: Option<usize>) {
    let ([Some(left), Some(right)], Some(top)) = (thighs, top) else { return };
    let between = 0.5 * (drafts[left].pivot + drafts[right].pivot);
    let back = between.distance(drafts[top].pivot);
    if between.distance(drafts[hips].pivot) > 0.5 * back {
        drafts[hips].pivot = between;
    }
}

/// Which drafts are `top` or below it.
fn is_below(drafts: &[Draft], order: &[usize], top: usize) -> Vec<bool> {
    let mut below = vec![false; drafts.len()];
    for &idx in order {
        below[idx] = idx == top || drafts[idx].parent.is_some_and(|parent| below[parent]);
    }
    below
}

/// Whether `above` carries `idx`, or is it.
fn carries(drafts: &[Draft], above: usize, idx: usize) -> bool {
    std::iter::successors(Some(idx), |&idx| drafts[idx].parent).any(|idx| idx == above)
}

/// Turns the way from the root to `root` around.
fn root_at(drafts: &mut [Draft], root: usize) {
    let mut below = None;
    let mut at = Some(root);
    while let Some(idx) = at {
        at = std::mem::replace(&mut drafts[idx].parent, below);
        below = Some(idx);
    }
}
