//! Statistical test tools.
