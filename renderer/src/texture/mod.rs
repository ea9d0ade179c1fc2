//! Texture look-ups.
