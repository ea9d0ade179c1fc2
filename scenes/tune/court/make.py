"""Writes the meshes, textures and sky of the courtyard. Needs numpy.

    python3 make.py

Both arcades are one mesh: it runs along x from -4.8 to 4.8 with its front in z = 0, and `scene.xml` places it twice.
"""
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent.parent / "library"))
import workshop as ws  # noqa: E402

BAY, SPRING, RADIUS, THICK, TOP, BAYS = 1.6, 1.95, 0.62, 0.34, 3.35, 6
HALF = BAY * BAYS / 2


def mesh(name, parts, uv=False):
    ws.save_ply(HERE / f"{name}.ply", ws.join(parts) if isinstance(parts, list) else parts, uv)


def flat(m):
    """Texture coordinates from the plan: metres along x + z and up."""
    P, N, UV, F = m
    return P, N, np.stack([P[:, 0] + P[:, 2], -P[:, 1]], -1), F


def arcade():
    """Wall over round arches: front, back, the arches' undersides and the feet that rest on the capitals."""
    out, angles = [], np.linspace(np.pi, 0, 25)
    for k in range(BAYS):
        c = -HALF + BAY * (k + 0.5)
        xs, ys = c + RADIUS * np.cos(angles), SPRING + RADIUS * np.sin(angles)
        xs, ys = np.concatenate([[c - BAY / 2], xs, [c + BAY / 2]]), np.concatenate([[SPRING], ys, [SPRING]])
        for i in range(len(xs) - 1):
            a, b = (xs[i], ys[i]), (xs[i + 1], ys[i + 1])
            out.append(ws.quad((*a, 0), (*b, 0), (b[0], TOP, 0), (a[0], TOP, 0)))
            out.append(ws.quad((*b, -THICK), (*a, -THICK), (a[0], TOP, -THICK), (b[0], TOP, -THICK)))
        u = np.tile(angles, 2)
        P = np.stack([c + RADIUS * np.cos(u), SPRING + RADIUS * np.sin(u), np.repeat([0.0, -THICK], 25)], -1)
        N = np.stack([-np.cos(u), -np.sin(u), 0 * u], -1)
        F = [(i, i + 1, i + 26) for i in range(24)] + [(i, i + 26, i + 25) for i in range(24)]
        out.append(ws.finish(P, N, P[:, :2], F))
        for x0, x1 in ((c - BAY / 2, c - RADIUS), (c + RADIUS, c + BAY / 2)):
            out.append(ws.quad((x0, SPRING, -THICK), (x1, SPRING, -THICK), (x1, SPRING, 0), (x0, SPRING, 0)))
    out.append(ws.quad((-HALF, TOP, 0), (HALF, TOP, 0), (HALF, TOP + 0.15, 0), (-HALF, TOP + 0.15, 0)))  # up to the tiles
    return [flat(m) for m in out]


def trim():
    """Archivolts, a string course and the moulding under the eaves."""
    out = []
    for k in range(BAYS):
        c, a = -HALF + BAY * (k + 0.5), np.linspace(np.pi, 0, 29)
        profile = [(0.0, 0.0), (0.0, 0.028), (0.035, 0.036), (0.05, 0.024), (0.10, 0.024), (0.10, 0.0)]
        for (r0, z0), (r1, z1) in zip(profile, profile[1:]):
            P = np.concatenate([np.stack([c + (RADIUS + r) * np.cos(a), SPRING + (RADIUS + r) * np.sin(a), 0 * a + z], -1) for r, z in ((r0, z0), (r1, z1))])
            n, m = np.array([-(z1 - z0), r1 - r0]), np.tile(a, 2)
            N = np.stack([n[0] * np.cos(m), n[0] * np.sin(m), n[1] + 0 * m], -1)
            F = [(i, i + 1, i + 30) for i in range(28)] + [(i, i + 30, i + 29) for i in range(28)]
            out.append(ws.finish(P, N, P[:, :2], F))
    for y, h, d in ((TOP - 0.42, 0.05, 0.05), (TOP - 0.05, 0.10, 0.16), (TOP - 0.13, 0.06, 0.09)):
        out.append(ws.place(ws.box((2 * HALF, h, d), 0.012, 2), (0, y, d / 2 - 0.01)))
    return out


def column():
    """A Tuscan column, 1.95 m, with square plinth and abacus."""
    shaft = ws.lathe([
        [(0.150, 0.075), (0.166, 0.088), (0.170, 0.105), (0.164, 0.124), (0.148, 0.136)],
        [(0.148, 0.136), (0.138, 0.140), (0.133, 0.152), (0.130, 0.175), (0.131, 0.60), (0.126, 1.10), (0.112, 1.70)],
        [(0.112, 1.70), (0.122, 1.706), (0.125, 1.716), (0.122, 1.726), (0.112, 1.732)],
        [(0.112, 1.732), (0.112, 1.79), (0.120, 1.815), (0.142, 1.845), (0.152, 1.868)],
    ], n=32, steps=2)
    return [shaft, ws.place(ws.box((0.35, 0.076, 0.35), 0.008, 1), (0, 0.0385, 0)), ws.place(ws.box((0.33, 0.080, 0.33), 0.010, 1), (0, 1.908, 0))]


def roof():
    """Half-round tiles that slope up and away from the court; two roofs cross in a valley over the corner."""
    length = 2 * (HALF + 2.64)

    def f(u, v):
        x, back = length * (u - 0.5), 2.6 * v
        wave = np.sin(u * length / 0.24 * np.pi)
        return x, TOP + 0.05 + 0.42 * back + 0.062 * abs(wave), 0.24 - back
    return ws.grid(f, 496, 1, flip=True)


def gallery():
    """Behind the arches: back wall and ceiling, longer than the arcade so that two of them close the corner."""
    d, far = -2.3, HALF + 2.3
    return [flat(m) for m in (
        ws.quad((-far, 0, d), (far, 0, d), (far, 3.1, d), (-far, 3.1, d)),
        ws.quad((-far, 3.1, d), (HALF, 3.1, d), (HALF, 3.1, -THICK), (-far, 3.1, -THICK)),
    )]


def door():
    """Planks under a segment arch in a stone surround."""
    planks = [ws.place(ws.box((0.176, 2.06, 0.045), 0.008, 1, (0.3 * k, 0.2 * k)), (-0.45 + 0.18 * k, 1.04, 0)) for k in range(6)]
    return planks


def surround():
    return [ws.place(ws.box((0.16, 2.12, 0.09), 0.012, 2), (s * 0.64, 1.061, 0.0)) for s in (-1, 1)] + [ws.place(ws.box((1.56, 0.20, 0.12), 0.014, 2), (0, 2.222, 0.0))]


def fountain():
    basin = ws.lathe([
        [(1.16, 0.0), (1.16, 0.09)], [(1.16, 0.09), (1.145, 0.105), (1.06, 0.11)],
        [(1.06, 0.11), (1.00, 0.13), (0.985, 0.20), (0.99, 0.36), (1.02, 0.42), (1.07, 0.445), (1.085, 0.465), (1.085, 0.50), (1.07, 0.515), (1.04, 0.52)],
        [(1.04, 0.52), (0.93, 0.52)], [(0.93, 0.52), (0.91, 0.515), (0.90, 0.50), (0.89, 0.30)],
    ], n=48, steps=1)
    stem = ws.lathe([
        [(0.17, 0.30), (0.17, 0.52), (0.12, 0.56), (0.085, 0.64), (0.10, 0.74), (0.125, 0.82), (0.09, 0.92), (0.075, 0.98), (0.10, 1.03)],
        [(0.10, 1.03), (0.24, 1.06), (0.40, 1.13), (0.475, 1.21), (0.485, 1.235), (0.470, 1.245), (0.44, 1.235), (0.38, 1.17)],
    ], n=32, steps=2)
    top = ws.lathe([[(0.06, 1.14), (0.05, 1.22), (0.035, 1.30), (0.05, 1.36), (0.075, 1.42), (0.06, 1.47), (0.02, 1.52), (0.0, 1.53)]], n=24, steps=3)
    return [basin, stem, top]


def ripples(u, v):
    """Water: rings that run out from where the drops fall."""
    r, a = 0.02 + 0.87 * v, u * ws.TAU
    x, z = r * np.cos(a), r * np.sin(a)
    y = sum(0.0016 * np.sin(np.hypot(x - p, z - q) * 52 + s) for p, q, s in ((0.3, 0.35, 0), (-0.45, 0.1, 2), (0.1, -0.45, 4)))
    return x, 0.43 + y, z


def pot():
    return ws.lathe([
        [(0, 0.002), (0.14, 0.002)], [(0.14, 0.002), (0.15, 0.01), (0.19, 0.15), (0.215, 0.27), (0.215, 0.29)],
        [(0.215, 0.29), (0.235, 0.295), (0.24, 0.31), (0.24, 0.345), (0.23, 0.36), (0.215, 0.36), (0.205, 0.345), (0.20, 0.31)], [(0.20, 0.31), (0, 0.305)],
    ], n=36, steps=2)


def shrub():
    """A clipped ball of leaves on a short trunk."""
    rng, leaves = np.random.default_rng(4), []
    for k in range(280):
        y = 1 - 2 * (k + 0.5) / 280
        a, r = k * 2.39996, np.sqrt(1 - y * y)
        q = 0.30 * rng.uniform(0.72, 1.0)
        size = rng.uniform(0.075, 0.115)
        leaf = ws.leaf(size, size * 0.5, rng.uniform(-0.2, 1.0), 4.0, 0.15, 3)
        leaves.append(ws.place(leaf, (q * r * np.cos(a), 0.72 + q * y, -q * r * np.sin(a)), turn=np.degrees(a) + rng.uniform(-50, 50), tilt=rng.uniform(-40, 40)))
    return leaves


mesh("arcade", arcade(), uv=True)
mesh("trim", trim())
mesh("column", column())
mesh("roof", roof())
mesh("gallery", gallery(), uv=True)
mesh("door", door(), uv=True)
mesh("surround", surround())
mesh("fountain", fountain())
mesh("water", ws.grid(ripples, 64, 14, flip=True))
mesh("pot", pot())
mesh("shrub", shrub())
mesh("trunk", ws.tube([(0, 0.29, 0), (0.01, 0.45, 0.01), (0, 0.72, 0)], [0.022, 0.018, 0.012], n=8, steps=2))


def paving(size):
    """Square flags of limestone, 8 x 8 to the picture, each with its own tone, worn edges and dirt in the joints."""
    n = size // 8
    rng = np.random.default_rng(2)
    y, x = np.mgrid[0:size, 0:size]
    tone = rng.normal(0, 1, (8, 8, 1))[y // n, x // n][..., 0]
    e = np.minimum(np.minimum(x % n, n - 1 - x % n), np.minimum(y % n, n - 1 - y % n)) / n + 0.010 * ws.noise(size, size, 50, 50, 3)
    t = 0.55 + 0.10 * tone + 0.06 * ws.noise(size, size, 10, 10, 4) + 0.05 * ws.noise(size, size, 90, 90, 5)
    c = ws.ramp(t, [(112, 98, 80), (160, 144, 120), (192, 176, 150), (208, 196, 172)])
    return c * np.clip(0.45 + e / 0.035, 0.45, 1)[..., None]


def stucco(h, w):
    """Ochre lime wash, bleached in clouds, stained below."""
    n = 0.6 * ws.noise(h, w, 4, 4, 21, 1.2) + 0.3 * ws.noise(h, w, 20, 20, 22) + 0.2 * ws.noise(h, w, 3, 12, 23)
    return ws.ramp(0.5 + 0.18 * n, [(164, 112, 62), (204, 152, 92), (220, 176, 118), (230, 198, 150)])


ws.save_png(HERE / "paving.png", paving(512), 20)
ws.save_png(HERE / "stucco.png", stucco(384, 384), 32)
ws.save_png(HERE / "door.png", ws.wood(128, 512, 31, [(34, 48, 44), (58, 82, 74), (76, 104, 92), (96, 122, 106)], rings=3), 24)
c = ws.sky(192, 384, (0.62, 0.70, 0.42), (9000, 7900, 6300), 0.9, (0.20, 0.42, 0.95), (0.75, 0.95, 1.25), (1.2, 1.05, 0.8), (0.24, 0.20, 0.15))
clouds = np.clip(ws.noise(192, 384, 7, 5, 44, 1.25) - 0.35, 0, 1.2) * np.clip(1 - abs(np.arange(192)[:, None] / 192 - 0.36) / 0.13, 0, 1)
ws.save_hdr(HERE / "sky.hdr", np.where(c.max(-1, keepdims=True) > 50, c, c + clouds[..., None] * np.array([1.25, 1.2, 1.15])))
