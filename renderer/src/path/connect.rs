//! Light samples whose way is free.

use super::{Connection, Path};
use crate::film::Sample;

/// Adds a light sample to its path.
#[inline]
pub fn connect(path: &mut Path, connection: &Connection, blocked: bool, features: &mut Sample) {
    if connection.at_feature {
        features.set_visibility(!blocked);
    }
    if !blocked {
        path.gather(connection.through, connection.radiance);
    }
}
