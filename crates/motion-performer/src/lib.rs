//! A procedural performer: it walks, runs, turns, jumps and stands, from a foot plan, a path of
//! the hips and two-bone legs. It makes the built-in library, which needs no file.
//!
//! ```
//! use motion_performer::{Ease, Keys, Performance, builtin_clips, perform};
//!
//! // The library: every clip, ready for a graph.
//! let library = builtin_clips()?;
//! assert!(library.clips().len() >= 40);
//!
//! // Anything else: four cycles of walking with a quarter turn to the left in the middle.
//! let mut walk = Performance::straight(1.3, 4.0);
//! let quarter = std::f32::consts::FRAC_PI_2;
//! walk.heading_rad = Keys::new(Ease::Smooth, vec![(1.0, 0.0), (2.5, quarter)]);
//! let performed = perform(&walk)?;
//! assert!(performed.contacts.iter().any(|c| c.left) && performed.contacts.iter().any(|c| c.right));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The way of one performance
//!
//! 1. [`travel`](Performance): speed and heading over gait phase become samples over time.
//! 2. `foot_plan`: where each foot stands, and from when to when. Feet never slide because this
//!    is decided before anything else.
//! 3. `foot_pose`, `swing`: how a foot rolls over heel and toes on its print, and swings to the
//!    next one.
//! 4. `pelvis`: the hips' way between feet and path: weight over the foot that carries, lean
//!    into turns.
//! 5. `gait_curves` with `gait_figures`: what trunk and arms do at that speed and phase, measured
//!    on people; figures only, with credit in that file.
//! 6. `pose`: the whole body at an instant; hips come down where a leg would be too short; legs
//!    by [`motion_core::ik`].
//! 7. [`perform`](perform()): all of it in order. `idle` and `jump` make poses of their own, from
//!    and to the same `stand`.
//! 8. `repertoire`: the library's clips, as data.
//!
//! # What is promised, and held by tests
//!
//! A toe joint in contact moves less than 1e-5 m between frames, and so does the ankle of a flat
//! foot. Knees bend one way only, between 13° and 130°. Nothing is random and nothing is read.
//!
//! Known limits: the floor is level; one body; running is measured on few cycles; hands and
//! shoulders do little.

pub mod body;

mod foot_plan;
mod foot_pose;
mod gait_curves;
mod gait_figures;
mod idle;
mod jump;
mod pelvis;
mod perform;
mod pose;
mod repertoire;
mod signal;
mod stand;
mod swing;
mod travel;

pub use gait_curves::REST_PHASE;
pub use perform::{PerformError, Performed, perform};
pub use repertoire::{BuiltinError, builtin_clips};
pub use signal::{Ease, Keys};
pub use travel::{Edge, Performance, SpecError};
