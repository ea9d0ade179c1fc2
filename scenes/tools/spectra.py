"""Writes src/spectrum/{cie,metals}.rs from what Mitsuba 3 computes: run in scenes/ as
`python tools/spectra.py` with the package `mitsuba` 3.9 installed, then `cargo fmt`."""

import pathlib

import mitsuba as mi

OUT = pathlib.Path("src/spectrum")

mi.set_variant("scalar_spectral")
mi.set_log_level(mi.LogLevel.Error)
d65 = mi.load_dict({"type": "d65"})


def array(values):
    """A Rust array of floats."""
    digits = [f"{v:.7g}" for v in values]
    return "[" + ", ".join(d if "." in d or "e" in d else d + ".0" for d in digits) + "]"


def d65_at(wavelength):
    si = mi.SurfaceInteraction3f()
    si.wavelengths = [wavelength] * 4
    return d65.eval(si)[0]


wavelengths = [360.0 + 5.0 * i for i in range(95)]
rows = [list(mi.cie1931_xyz(w)) + [d65_at(w)] for w in wavelengths]
text = """//! Colour-matching functions and daylight. Written by `tools/spectra.py`; facts, not code.

/// CIE 1931 2° observer (x̄, ȳ, z̄), and CIE illuminant D65 scaled so that white has Y = 1, every 5 nm from 360 to 830 nm.
pub(super) const XYZ_AND_D65: [[f32; 4]; 95] = [
"""
text += "".join(f"    {array(row)},\n" for row in rows)
(OUT / "cie.rs").write_text(text + "];\n")

mi.set_variant("scalar_rgb")
mi.set_log_level(mi.LogLevel.Error)
names = sorted(p.name.removesuffix(".eta.spd") for p in pathlib.Path(mi.__file__).parent.rglob("ior/*.eta.spd"))
text = """//! Metals. Written by `tools/spectra.py`; facts, not code.

/// Names as files write them, with η and k for linear Rec. 709: the measured spectra under D65, as Mitsuba 3's RGB mode has them.
pub(super) const METALS: &[(&str, [f32; 3], [f32; 3])] = &[
"""
for name in names:
    try:
        params = mi.traverse(mi.load_dict({"type": "conductor", "material": name}))
    except RuntimeError as error:
        print(f"{name}: left out: {error}")
        continue
    triples = [[float(v) for v in params[k + ".value"]] for k in ("eta", "k")]
    text += f'    ("{name}", {array(triples[0])}, {array(triples[1])}),\n'
(OUT / "metals.rs").write_text(text + "];\n")
print(f"{len(rows)} wavelengths, {len(names)} metals")
