//! How much each term of the score counts.

use motion_core::score::Weights;
use motion_io::project_file::Project;

/// The project's weights. A name that no term has is said.
pub(super) fn weights(project: &Project, remarks: &mut Vec<String>) -> Weights {
    let mut weights = Weights::default();
    for (name, value) in &project.search.weights {
        let weight = match name.as_str() {
            "continuity" => &mut weights.continuity,
            "length" => &mut weights.length,
            "body" => &mut weights.body,
            "joint" => &mut weights.joint,
            "style" => &mut weights.style,
            "path" => &mut weights.path,
            "environment" => &mut weights.environment,
            _ => {
                remarks.push(format!("the weight {name:?} is of no term of the score"));
                continue;
            }
        };
        *weight = *value as f32;
    }
    weights
}
