//! What goes around any method: components and their recombination, noise levels, features, repair.

pub(crate) mod components;
pub(crate) mod features;
pub(crate) mod noise;
pub(crate) mod repair;
