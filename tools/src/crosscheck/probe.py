"""Whether a variant of Mitsuba works on this machine: renders 16x16 pixels with it, or dies."""

import sys

import mitsuba as mi
import numpy as np

mi.set_variant(sys.argv[1])
scene = mi.load_dict({
    "type": "scene",
    "integrator": {"type": "path"},
    "sensor": {"type": "perspective", "film": {"type": "hdrfilm", "width": 16, "height": 16}},
    "light": {"type": "constant"},
    "ball": {"type": "sphere", "center": [0, 0, 4], "bsdf": {"type": "roughplastic"}},
})
mean = float(np.array(mi.render(scene, spp=4)).mean())
sys.exit(0 if 0.1 < mean < 1.1 else 1)
