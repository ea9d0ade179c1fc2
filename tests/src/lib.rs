//! Tests that cross crates stand in `tests/`; this library holds what they share.
