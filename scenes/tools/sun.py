"""Writes src/daylight/sun_table.rs from what Mitsuba 3 computes: run in scenes/ as
`python tools/sun.py` with the packages `mitsuba` 3.9 and `numpy` installed."""

import pathlib

import mitsuba as mi
import numpy as np

OUT = pathlib.Path("src/daylight/sun_table.rs")
# Mitsuba's own table has these elevations and whole turbidities, and is linear between them.
ELEVATIONS = np.radians(2.0 + 3.0 * np.arange(30))

# What Mitsuba holds constant is the irradiance: its radiance is that over a solid angle in single precision, 0.2 % too small.
HALF = np.radians(0.5358 / 2)
CONE = float(1 - np.cos(np.float32(HALF))) / (2 * np.sin(HALF / 2) ** 2)

mi.set_variant("scalar_rgb")
mi.set_log_level(mi.LogLevel.Error)


def radiance(turbidity, elevation):
    towards = [float(np.cos(elevation)), 0.0, float(np.sin(elevation))]
    sun = mi.load_dict({"type": "sunsky", "turbidity": float(turbidity), "sky_scale": 0.0, "sun_direction": towards})
    si = mi.SurfaceInteraction3f()
    si.wi = [-x for x in towards]
    return [v * CONE for v in sun.eval(si)]


def digits(value):
    text = f"{value:.5g}"
    return text if "." in text or "e" in text else text + ".0"


def row(turbidity):
    cells = ["[" + ", ".join(map(digits, radiance(turbidity, e))) + "]" for e in ELEVATIONS]
    return "    [\n" + "".join(f"        {', '.join(cells[i:i + 5])},\n" for i in range(0, 30, 5)) + "    ],\n"


OUT.write_text(f"""//! How bright the sun is. Written by `tools/sun.py` from Mitsuba 3.9.1; facts, not code.

/// Radiance of a sun of 0.5358 degrees, by turbidity from 1 and elevation from 2 degrees in steps of 3.
#[rustfmt::skip]
pub const RADIANCE: [[[f32; 3]; 30]; 10] = [
{"".join(row(t) for t in range(1, 11))}];
""")
