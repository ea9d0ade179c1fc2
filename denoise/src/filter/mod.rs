//! Filters: each output pixel is a weighted mean of noisy ones, and nothing was trained.

mod joint_nlm;
pub(crate) mod nlm;

pub use joint_nlm::JointNlm;

use crate::method::{Kind, Method};

/// Every filter, a row each.
pub(crate) const METHODS: &[Method] = &[Method {
    name: "joint-nlm",
    kind: Kind::Filter,
    source: "Rousselle, Manzi, Zwicker 2013, Robust Denoising using Feature and Color Information",
    summary: "nonlocal means with feature guides, per component; weights of one half applied to the other",
    parameters: joint_nlm::PARAMETERS,
    build: |values| Box::new(JointNlm::from_values(values)),
}];
