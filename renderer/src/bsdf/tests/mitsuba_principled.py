"""Prints f · cos θi of Mitsuba 3's principled models for random dials and directions: mitsuba_principled.txt.

A line: 1 for principledthin or 0; base_color, roughness, anisotropic, metallic, spec_trans, eta, spec_tint, sheen,
sheen_tint, flatness, clearcoat, clearcoat_gloss, diff_trans; wo, wi, value.

Sharp coats are left out: at clearcoat_gloss 1 Mitsuba's f32 loses up to 1 % to cancellation.
"""

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
rng = np.random.default_rng(17)


def unit(v):
    return v / np.linalg.norm(v)


def dial():
    return float(rng.choice([0.0, 1.0, rng.random()], p=[0.4, 0.2, 0.4]))


def pair(eta, is_sheet):
    """Directions, at times mirrored or refracted at a facet."""
    wo = unit(rng.normal(size=3))
    m = unit(np.append(0.2 * rng.normal(size=2), 1.0))
    cos = wo @ m
    kind = rng.integers(3)
    wi = 2.0 * cos * m - wo
    if kind == 0:
        wi = unit(rng.normal(size=3))
    elif kind == 1 and is_sheet:
        wi[2] = -wi[2]
    elif kind == 1:
        eta = eta if cos > 0.0 else 1.0 / eta
        cos2 = 1.0 - (1.0 - cos * cos) / eta**2
        if cos2 > 0.0:
            wi = (cos / eta - np.sign(cos) * np.sqrt(cos2)) * m - wo / eta
    return unit(wo.astype(np.float32)), unit(wi.astype(np.float32))


lines = 0
while lines < 120:
    is_sheet = lines % 2
    color = rng.random(3).round(3)
    names = "roughness anisotropic metallic spec_trans eta spec_tint sheen sheen_tint flatness clearcoat clearcoat_gloss diff_trans"
    dials = {name: round(dial(), 3) for name in names.split()}
    dials["roughness"] = round(float(rng.uniform(0.2, 1.0)), 3)
    dials["eta"] = float(rng.choice([1.5, 1.33, 0.75]))
    dials["clearcoat_gloss"] *= 0.5
    dials["diff_trans"] *= 2.0
    if dials["spec_trans"] == 1.0:
        dials["sheen"] = 0.0  # which the scalar variants would drop
    left_out = ["metallic", "clearcoat", "clearcoat_gloss"] if is_sheet else ["diff_trans"]
    bsdf = mi.load_dict(
        {
            "type": "principledthin" if is_sheet else "principled",
            "base_color": {"type": "rgb", "value": color.tolist()},
            **{name: x for name, x in dials.items() if name not in left_out},
        }
    )
    si = mi.SurfaceInteraction3f()
    wo, wi = pair(dials["eta"], is_sheet)
    si.wi = mi.Vector3f(*map(float, wo))
    value = np.array(bsdf.eval(mi.BSDFContext(), si, mi.Vector3f(*map(float, wi))))
    if value.max() < 1e-4:
        continue
    lines += 1
    print(*[f"{float(x):.9g}" for x in [is_sheet, *color, *dials.values(), *wo, *wi, *value]])
