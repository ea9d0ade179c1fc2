//! Lights: the same contract as a BSDF's, seen from a point: draw a direction, give its density.
