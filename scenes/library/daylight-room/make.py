"""Writes the meshes, textures and sky of the daylight room. Needs numpy.

    python3 make.py

The room spans x from -2.6 (windows) to 2.6, y from 0 to 2.75, z from -2.4 (back wall) to 3.4. Furniture is placed here;
`scene.xml` only says what it is made of.
"""
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
import workshop as ws  # noqa: E402

X, H, BACK, FRONT = 2.6, 2.75, -2.4, 3.4
WINDOWS = [(-1.95, -0.95), (-0.35, 0.65), (1.25, 2.25)]  # along z
SILL, HEAD, REVEAL = 0.45, 2.40, 0.22


def mesh(name, parts, uv=False):
    ws.save_ply(HERE / f"{name}.ply", ws.join(parts) if isinstance(parts, list) else parts, uv)


def texture(name, rgb, levels=48):
    ws.save_png(HERE / f"{name}.png", rgb, levels)


# ---------------------------------------------------------------- shell

def window_wall():
    """The left wall as a grid with holes, and the reveals of the holes: watertight, no T-junctions inside the room."""
    zs = sorted([BACK, FRONT] + [z for w in WINDOWS for z in w])
    ys, out = [0, SILL, HEAD, H], []
    for z0, z1 in zip(zs, zs[1:]):
        for y0, y1 in zip(ys, ys[1:]):
            if y0 != SILL or (z0, z1) not in WINDOWS:
                out.append(ws.quad((-X, y0, z1), (-X, y0, z0), (-X, y1, z0), (-X, y1, z1)))
    o = -X - REVEAL
    for z0, z1 in WINDOWS:
        out.append(ws.quad((-X, SILL, z0), (o, SILL, z0), (o, SILL, z1), (-X, SILL, z1)))
        out.append(ws.quad((-X, HEAD, z1), (o, HEAD, z1), (o, HEAD, z0), (-X, HEAD, z0)))
        out.append(ws.quad((o, SILL, z0), (-X, SILL, z0), (-X, HEAD, z0), (o, HEAD, z0)))
        out.append(ws.quad((-X, SILL, z1), (o, SILL, z1), (o, HEAD, z1), (-X, HEAD, z1)))
    return out


def casement(z0, z1):
    """Frame, a mullion and two transoms, in the middle of the reveal."""
    x, out, mid = -X - 0.13, [], (z0 + z1) / 2
    bar = lambda y, z, h, w, d: out.append(ws.place(ws.box((d, h, w), 0.006, 1), (x, y, z)))
    tall, wide = HEAD - SILL, z1 - z0
    for z in (z0 + 0.027, z1 - 0.027):
        bar((SILL + HEAD) / 2, z, tall - 0.004, 0.050, 0.07)
    for y in (SILL + 0.032, HEAD - 0.032):
        bar(y, mid, 0.060, wide - 0.106, 0.068)
    bar((SILL + HEAD) / 2, mid, tall - 0.126, 0.058, 0.060)
    for y in (SILL + 0.68, SILL + 1.30):
        for s in (-1, 1):
            bar(y, mid + s * wide / 4, 0.026, wide / 2 - 0.086, 0.036)
    out.append(ws.place(ws.box((0.20, 0.03, wide + 0.10), 0.008, 2), (-X + 0.045, SILL + 0.0155, mid)))
    return out


def moulding(profile, path):
    """Extrudes a profile (distance from the wall, height) along a wall line on the floor plan, corner to corner."""
    (x0, z0), (x1, z1) = path
    d = np.array([x1 - x0, z1 - z0]) / np.hypot(x1 - x0, z1 - z0)
    inward = np.array([-d[1], d[0]])
    c = ws.spline(profile, 1)
    out = []
    for a, b in zip(c, c[1:]):
        corner = lambda end, p: (end[0] + inward[0] * p[0], p[1], end[1] + inward[1] * p[0])
        out.append(ws.quad(corner(path[0], a), corner(path[0], b), corner(path[1], b), corner(path[1], a)))
    return ws.join(out)


SKIRTING = [(0.018, 0.0), (0.018, 0.09), (0.012, 0.102), (0.010, 0.112), (0.0, 0.116)]
CORNICE = [(0.0, H - 0.13), (0.012, H - 0.125), (0.018, H - 0.11), (0.022, H - 0.085), (0.040, H - 0.055), (0.062, H - 0.035), (0.068, H - 0.018), (0.085, H - 0.014), (0.085, H)]
WALLS = [((-X, FRONT), (-X, BACK)), ((-X, BACK), (X, BACK)), ((X, BACK), (X, FRONT)), ((X, FRONT), (-X, FRONT))]

mesh("wall-windows", window_wall())
mesh("wall-back", [ws.quad((-X, 0, BACK), (X, 0, BACK), (X, H, BACK), (-X, H, BACK))])
mesh("walls-other", [ws.quad((X, 0, BACK), (X, 0, FRONT), (X, H, FRONT), (X, H, BACK)), ws.quad((X, 0, FRONT), (-X, 0, FRONT), (-X, H, FRONT), (X, H, FRONT))])
mesh("ceiling", [ws.quad((-X, H, BACK), (X, H, BACK), (X, H, FRONT), (-X, H, FRONT))])
floor = ws.quad((-X, 0, FRONT), (X, 0, FRONT), (X, 0, BACK), (-X, 0, BACK))
mesh("floor", (floor[0], floor[1], floor[0][:, [0, 2]], floor[3]), uv=True)
mesh("joinery", [m for w in WINDOWS for m in casement(*w)] + [moulding(p, [(x, z) for x, z in w][::-1]) for w in WALLS for p in (SKIRTING, CORNICE)])


# ---------------------------------------------------------------- curtains, rug, picture

def curtain(z, width, seed):
    def f(u, v):  # u along z, v downwards
        tied = 1 - 0.35 * np.exp(-(((v - 0.62) / 0.22) ** 2))
        depth = 0.028 + 0.022 * v
        wave = np.sin(u * 7 * ws.TAU / 1.6 + seed + 0.6 * np.sin(3 * v + seed)) + 0.25 * np.sin(u * 29 + 2 * v + seed)
        return -X + 0.115 + depth * wave * (0.6 + 0.4 * tied), 2.55 - 2.53 * v, z + (u - 0.5) * width * tied
    return ws.grid(f, 40, 9, flip=True)


def rug(u, v):
    """A mat 12 mm thick with round edges that lies a little unevenly; v towards the viewer."""
    round_off = lambda t: np.sqrt(np.clip(1 - np.clip(1 - np.minimum(t, 1 - t) / 0.012, 0, 1) ** 2, 0, 1))
    y = 0.001 + 0.012 * np.minimum(round_off(u), round_off(v)) * (1 + 0.25 * np.sin(9 * u + 2 * v) * np.sin(5 * v))
    return -0.10 + 2.4 * (u - 0.5), y, 0.12 + 1.65 * (v - 0.5)


def kilim(h, w):
    """Borders, stepped diamonds and small crosses on madder red, woven in visible rows."""
    y, x = np.mgrid[0:h, 0:w]
    step = 6  # a knot: patterns move in whole knots
    i, j = (x // step) - w // step / 2 + 0.5, (y // step) - h // step / 2 + 0.5
    hi, hj = w // step / 2, h // step / 2
    edge = np.minimum(hi - abs(i), hj - abs(j))
    red, blue, cream, gold, dark = (np.array(c) / 255 for c in ((136, 52, 42), (50, 70, 94), (208, 190, 156), (184, 136, 72), (62, 40, 36)))
    c = np.broadcast_to(red, (h, w, 3)).copy()
    put = lambda mask, colour: c.__setitem__(mask, colour)
    d = abs(((i + 11) % 22) - 11) * 1.0 + abs(((j + 11) % 22) - 11)  # diamonds, 22 knots apart
    put((d < 9), blue), put((d < 7), cream), put((d < 5.5), red), put((d < 3), gold), put((d < 1.6), dark)
    d2 = abs(i % 22 - 11) + abs(j % 22 - 11)
    put((d2 < 2.6), cream)
    put(edge < 11, dark), put(edge < 10, cream)
    k = np.where(hi - abs(i) < hj - abs(j), j, i)
    zig = abs((k % 8) - 4)
    put((edge < 9) & (edge >= 3), blue), put((edge < 9) & (edge >= 3) & (abs(edge - 4 - zig) < 1.2), gold)
    put(edge < 3, red), put(edge < 1.2, dark)
    abrash = 0.07 * ws.noise(h, w, 3, 1, 71) + 0.05 * ws.noise(h, w, 120, 20, 72) + 0.06 * np.cos(y * ws.TAU / 3)
    return np.clip(c * (0.97 + abrash)[..., None], 0, 0.9)


def landscape(h, w):
    """The picture on the wall: a river plain at dusk, in flat planes and brush strokes."""
    y, x = np.mgrid[0:h, 0:w]
    v, u = y / h, x / w
    stroke = ws.noise(h, w, 40, 6, 81)
    c = ws.ramp(v * 1.55 + 0.02 * stroke + 0.03 * ws.noise(h, w, 5, 2, 82), [(92, 124, 150), (150, 168, 172), (222, 196, 150), (236, 170, 110), (226, 140, 90)])
    cloud = ws.noise(h, w, 7, 2, 83, 1.4) - 0.5 + 0.6 * np.sin(v * 11)
    c = ws.mix(c, np.broadcast_to(np.array([240, 214, 184]) / 255, c.shape), 0.55 * np.clip(cloud, 0, 1) * (v < 0.6))
    sun = np.hypot((u - 0.66) * w / h, v - 0.50)
    c = ws.mix(c, np.broadcast_to(np.array([252, 232, 190]) / 255, c.shape), 3 * (1 - sun / 0.062))
    hills = [(0.56, 0.05, 91, (124, 120, 140)), (0.62, 0.045, 92, (86, 96, 104)), (0.70, 0.04, 93, (66, 82, 70)), (0.83, 0.05, 94, (54, 60, 36))]
    for base, height, seed, colour in hills:
        line = base + height * np.repeat(ws.noise(1, w, 1, 3, seed, 1.5), h, 0) * 0.6 + 0.003 * stroke
        shade = 1 + 0.10 * stroke + 0.8 * (v - base)
        c = np.where((v > line)[..., None], np.array(colour) / 255 * shade[..., None], c)
    river = abs(u - (0.60 - 0.9 * (v - 0.72) + 0.05 * np.sin(v * 40))) < 0.012 + 0.35 * np.clip(v - 0.70, 0, 1)
    c = np.where((river & (v > 0.70))[..., None], ws.ramp((v - 0.7) * 3 + 0.06 * stroke, [(232, 176, 120), (160, 150, 140), (96, 118, 134)]), c)
    canvas = 0.025 * np.sin(x * ws.TAU / 4) * np.sin(y * ws.TAU / 4)
    return np.clip(c * 0.93 + canvas[..., None], 0, 0.93)


def picture(x, y, w, h, bar, depth):
    z = BACK + depth / 2 + 0.002
    out = [ws.place(ws.box((w + 2 * bar, bar, depth), 0.009, 2), (x, y + s * (h + bar) / 2, z)) for s in (-1, 1)]
    return out + [ws.place(ws.box((bar, h, depth), 0.009, 2), (x + s * (w + bar) / 2, y, z)) for s in (-1, 1)]


mesh("curtains", [curtain(z, w, s) for z, w, s in ((-2.13, 0.36, 0), (-0.78, 0.30, 2), (-0.52, 0.30, 3), (0.82, 0.30, 5), (1.08, 0.30, 1), (2.42, 0.36, 4))])
mesh("curtain-rod", [ws.tube([(-X + 0.115, 2.575, -2.36), (-X + 0.115, 2.575, 0), (-X + 0.115, 2.575, 2.8)], 0.012, n=16, steps=1)])
mesh("rug", ws.grid(rug, 44, 36), uv=True)
texture("kilim", kilim(492, 696), 24)
texture("landscape", landscape(288, 416), 48)
mesh("picture-frame", picture(-0.30, 1.62, 1.04, 0.72, 0.055, 0.045))
mesh("canvas", [ws.quad((-0.82, 1.26, BACK + 0.02), (0.22, 1.26, BACK + 0.02), (0.22, 1.98, BACK + 0.02), (-0.82, 1.98, BACK + 0.02))], uv=True)


# ---------------------------------------------------------------- wood

def parquet(size, unit, n, seed):
    """Herringbone of 1 x n blocks; the picture holds two periods (4n units) a side."""
    cells = 4 * n
    grain = ws.wood(512, 1024, seed, [(134, 94, 58), (180, 136, 90), (206, 164, 114), (222, 186, 138)], rings=8, levels=30)
    y, x = (k.ravel() for k in np.mgrid[0:size, 0:size] * cells / size)
    i, j = np.floor(x).astype(int), np.floor(y).astype(int)
    d = (i - j) % (2 * n)
    flat = d < n
    along = np.where(flat, x - i + d, y - j + (2 * n - 1 - d))
    across = np.where(flat, y - j, x - i)
    block = np.where(flat, ((i - d) % cells) * cells + j % cells, 7919 + (i % cells) * cells + (j - (2 * n - 1 - d)) % cells)
    rng = np.random.default_rng(seed)
    table = rng.random((8000 + cells * cells, 4))[block]
    c = grain[((across * 44 + table[:, 0] * 512) % 512).astype(int), ((along * 44 + table[:, 1] * 1024) % 1024).astype(int)]
    c = c * (0.80 + 0.26 * table[:, 2:3]) * (1 + (table[:, 3:] - 0.5) * np.array([0.04, 0.0, -0.08]))
    gap = np.minimum(np.minimum(across, 1 - across), np.minimum(along, n - along))
    c = c * np.clip(0.35 + gap / 0.030, 0.35, 1)[:, None]
    return c.reshape(size, size, 3)


texture("parquet", parquet(1008, 0.09, 6, 3), 24)
texture("walnut", ws.wood(384, 768, 17, [(52, 30, 18), (92, 56, 34), (122, 78, 48), (150, 102, 66)], rings=6), 40)
texture("oak", ws.wood(384, 768, 23, [(128, 88, 50), (170, 126, 78), (194, 152, 102), (212, 176, 128)], rings=7), 40)


def slab(at, size, bevel=0.004, steps=1, turn=0.0, tilt=0.0, shift=0.0):
    return ws.place(ws.box(size, bevel, steps, (shift, shift * 1.7)), at, turn=turn, tilt=tilt)


def bookshelf(x0, x1, depth, height, levels):
    z, t, out = BACK + 0.021 + depth / 2, 0.028, []
    for k, x in enumerate((x0 + t / 2, x1 - t / 2)):
        out.append(slab((x, height / 2, z), (t, height - 0.002, depth), shift=0.3 * k))
    for k, y in enumerate(levels):
        out.append(slab(((x0 + x1) / 2, y, z), (x1 - x0 - 2 * t - 0.001, 0.024, depth - 0.01), shift=0.21 * k))
    out.append(slab(((x0 + x1) / 2, height + 0.0165, z + 0.008), (x1 - x0 + 0.05, 0.032, depth + 0.03), 0.008, 2, shift=0.7))
    out.append(slab(((x0 + x1) / 2, height / 2, BACK + 0.026), (x1 - x0 - 2 * t - 0.002, height - 0.01, 0.006), 0.001, shift=0.9))
    return out


SHELVES = [0.10, 0.50, 0.88, 1.24, 1.58]
SHELF_X = (0.86, 2.22)


def book(width, height, depth, cell):
    """Boards with a rounded spine towards +z; standing, the origin at the middle of its foot. Returns (cover, pages)."""
    a = np.linspace(-1, 1, 7)
    bulge = min(0.012, 0.35 * width)
    px, pz = a * width / 2, depth / 2 - bulge * a**2
    P = np.stack([np.tile(px, 2), np.repeat([0.0, height], 7), np.tile(pz, 2)], -1)
    N = np.stack([np.tile(2 * bulge * a / (width / 2), 2), 0 * np.tile(a, 2), np.ones(14)], -1)
    cu, cv = (cell % 8) / 8, (cell // 8) / 8
    UV = np.stack([np.tile(cu + (0.06 + 0.88 * (a + 1) / 2) / 8, 2), np.repeat([cv + 0.12, cv + 0.005], 7)], -1)
    F = [(i, i + 1, i + 8) for i in range(6)] + [(i, i + 8, i + 7) for i in range(6)]
    cover = [ws.finish(P, N, UV, F)]
    back, e = -depth / 2, (depth / 2 - bulge)
    plain = lambda m: ws.retexture(m, lambda u, v: (0 * u + cu + 0.03 / 8, 0 * v + cv + 0.06))
    board = min(0.003, width / 6)
    for s in (-1, 1):
        x, xi = s * width / 2, s * (width / 2 - board)
        sides = [[(x, 0, e), (x, 0, back), (x, height, back), (x, height, e)], [(xi, height, e), (x, height, e), (x, height, back), (xi, height, back)],
                 [(xi, 0, back), (xi, 0, e), (xi, height, e), (xi, height, back)]]
        cover += [plain(ws.quad(*(q if s > 0 else q[::-1]))) for q in sides]
    w, h = width / 2 - board, height - 0.005
    pages = [ws.quad((-w, h, e), (w, h, e), (w, h, back + 0.004), (-w, h, back + 0.004))]
    return ws.join(cover), ws.join(pages)


def shelf_of_books(x0, x1, y, seed, lean=True):
    rng, x, covers, pages = np.random.default_rng(seed), x0, [], []
    tall = rng.uniform(0.20, 0.25)
    while x < x1 - 0.06:
        w = rng.uniform(0.016, 0.048)
        h = np.clip(tall + rng.normal(0, 0.022), 0.15, 0.29)
        d = np.clip(rng.normal(0.17, 0.015), 0.13, 0.20)
        roll = 0.0
        if lean and rng.random() < 0.05:
            roll, x = -9.0, x + 0.035
        c, p = book(w, h, d, int(rng.integers(64)))
        at = (x + w / 2, y + (0.5 * w * np.sin(np.radians(abs(roll))) + 0.0005), BACK + 0.05 + d / 2 + rng.uniform(0, 0.02) + 0.06)
        covers.append(ws.place(c, at, roll=roll)), pages.append(ws.place(p, at, roll=roll))
        x += w + 0.0012
        if rng.random() < 0.10:
            tall = rng.uniform(0.19, 0.26)
    return covers, pages


def spines(size):
    """8 x 8 bindings: cloth or leather, bands, a label with lines of gilt."""
    rng, c, n = np.random.default_rng(9), np.zeros((size, size, 3)), size // 8
    palette = [(122, 40, 34), (42, 62, 88), (58, 78, 58), (176, 142, 92), (92, 58, 38), (204, 190, 160), (36, 38, 44), (140, 92, 48), (78, 92, 104), (150, 66, 44), (88, 44, 60), (190, 172, 128), (62, 96, 98)]
    y, x = np.mgrid[0:n, 0:n] / n
    for k in range(64):
        base = np.array(palette[rng.integers(len(palette))]) / 255 * rng.uniform(0.85, 1.1)
        gilt = np.array([206, 172, 96]) / 255 if base.mean() < 0.55 else np.array([70, 48, 36]) / 255
        t = np.broadcast_to(base, (n, n, 3)) * (1 + 0.05 * ws.noise(n, n, 30, 30, 100 + k) - 0.25 * (abs(x - 0.5) * 2)[..., None][..., 0] ** 4)[..., None]
        for at in rng.choice([0.08, 0.12, 0.20, 0.80, 0.88, 0.92], rng.integers(1, 5), replace=False):
            t = np.where((abs(y - at) < 0.010)[..., None], gilt, t)
        top = rng.uniform(0.24, 0.34)
        if rng.random() < 0.5:
            label = np.array(palette[rng.integers(len(palette))]) / 255 * 0.9
            t = np.where(((y > top) & (y < top + 0.24) & (abs(x - 0.5) < 0.42))[..., None], label, t)
        for line in range(rng.integers(2, 5)):
            half = rng.uniform(0.16, 0.34)
            letters = np.sin(x * 60 + line * 9 + k) > -0.4
            t = np.where(((abs(y - top - 0.05 - 0.048 * line) < 0.014) & (abs(x - 0.5) < half) & letters)[..., None], gilt, t)
        i, j = k // 8, k % 8
        c[i * n : (i + 1) * n, j * n : (j + 1) * n] = t
    return np.clip(c, 0, 0.92)


mesh("bookshelf", bookshelf(*SHELF_X, 0.29, 1.92, SHELVES), uv=True)
covers, pages = [], []
for k, (y, x0, x1) in enumerate([(SHELVES[0], 0.90, 1.80), (SHELVES[1], 0.90, 2.17), (SHELVES[2], 0.90, 1.62), (SHELVES[3], 1.22, 2.17), (SHELVES[4], 0.90, 1.75)]):
    a, b = shelf_of_books(x0, x1, y + 0.0125, 60 + k)
    covers, pages = covers + a, pages + b
for at, turn, k, size in (((-0.80, 0.8085, -2.16), 80, 5, (0.032, 0.25, 0.18)), ((-0.80, 0.8415, -2.16), 96, 9, (0.028, 0.22, 0.16)), ((-0.79, 0.8705, -2.15), 70, 2, (0.022, 0.20, 0.14)),
                          ((1.95, SHELVES[0] + 0.03, -2.2), 82, 12, (0.034, 0.26, 0.19)), ((1.96, SHELVES[0] + 0.066, -2.2), 95, 40, (0.030, 0.24, 0.17)),
                          ((1.94, SHELVES[2] + 0.031, -2.2), 86, 33, (0.034, 0.24, 0.18)), ((1.03, SHELVES[3] + 0.028, -2.2), 90, 21, (0.030, 0.23, 0.17)),
                          ((-1.32, 0.7585, -0.50), 114, 11, (0.024, 0.21, 0.15))):
    c, p = book(*size, k)
    for source, target in ((c, covers), (p, pages)):  # lying, its spine towards the room
        target.append(ws.place(ws.place(source, (size[1] / 2, 0, 0), roll=90), at, turn=turn - 90))
mesh("books", covers, uv=True)
mesh("pages", pages)
texture("spines", spines(384), 24)


# ---------------------------------------------------------------- furniture

def leg(top, foot, r0, r1):
    return ws.tube([foot, tuple((np.array(top) + foot) / 2), top], [r1, (r0 + r1) / 2, r0], n=10, steps=1)


def sideboard(x0, x1, depth, top):
    z, out, dark = BACK + 0.03 + depth / 2, [], []
    w, mid, base = x1 - x0, (x0 + x1) / 2, 0.20
    out.append(slab((mid, top - 0.014, z), (w, 0.028, depth), 0.006, 2))
    out.append(slab((mid, base + 0.011, z), (w - 0.03, 0.022, depth - 0.02), 0.004, 1, shift=0.4))
    for k, x in enumerate((x0 + 0.027, x1 - 0.027)):
        out.append(slab((x, (base + top) / 2 - 0.003, z - 0.004), (0.024, top - base - 0.054, depth - 0.03), 0.003, 1, shift=0.2 + k))
    out.append(slab((mid, (base + top) / 2, BACK + 0.045), (w - 0.08, top - base - 0.06, 0.012), 0.002, 1, shift=0.6))
    n, gap = 3, 0.004
    door = (w - 0.08) / n
    for k in range(n):
        x = x0 + 0.04 + door * (k + 0.5)
        out.append(slab((x, (base + top) / 2 - 0.003, z + depth / 2 - 0.028), (door - gap, top - base - 0.060, 0.020), 0.004, 2, shift=0.33 * k))
        dark.append(ws.place(ws.ball(2), (x + (0.40 if k < 2 else -0.40) * door, 0.56, z + depth / 2 - 0.004), scale=(0.013, 0.013, 0.013)))
    for x in (x0 + 0.10, x1 - 0.10):
        for s in (-1, 1):
            out.append(leg((x, base + 0.002, z + s * (depth / 2 - 0.07)), (x + (0.03 if x > mid else -0.03), 0.010, z + s * (depth / 2 - 0.05)), 0.022, 0.012))
    return out, dark


def round_table(x, z, r, height):
    top = ws.lathe([[(0, -0.03), (r - 0.05, -0.03)], [(r - 0.05, -0.03), (r - 0.012, -0.022), (r - 0.002, -0.012), (r - 0.001, -0.006), (r - 0.006, 0.0)], [(r - 0.006, 0.0), (0, 0.0)]], n=64, steps=2)
    P = top[0]
    top = ws.retexture(top, lambda u, v: (P[:, 0] + 0.55, P[:, 2] + 0.55 + 0.3 * P[:, 1]))
    column = ws.lathe([[(0.036, 0.16), (0.046, 0.20), (0.060, 0.26), (0.052, 0.33), (0.030, 0.38), (0.034, 0.40), (0.030, 0.42), (0.027, 0.52), (0.032, 0.62), (0.060, 0.69), (0.12, height - 0.0305)]], n=28, steps=3)
    out = [ws.place(top, (x, height, z)), ws.place(ws.retexture(column, lambda u, v: (0.7 * v, 0.4 * u)), (x, 0, z))]
    for k in range(3):
        a = np.radians(40 + 120 * k)
        foot = [(0.025, 0.20), (0.10, 0.19), (0.20, 0.12), (0.30, 0.045), (0.365, 0.021)]
        out.append(ws.tube([(x + q * np.cos(a), y, z + q * np.sin(a)) for q, y in foot], [0.030, 0.028, 0.024, 0.021, 0.021], n=8, steps=2))
    return out


def chair(at, turn):
    """A slat-back chair looking towards +z."""
    out = [ws.place(ws.box((0.42, 0.030, 0.40), 0.012, 3), (0, 0.455, 0.0))]
    for s in (-1, 1):
        out.append(leg((s * 0.17, 0.445, 0.16), (s * 0.19, 0.012, 0.18), 0.018, 0.012))
        out.append(ws.tube([(s * 0.19, 0.012, -0.21), (s * 0.172, 0.24, -0.185), (s * 0.168, 0.46, -0.175), (s * 0.175, 0.70, -0.205), (s * 0.185, 0.92, -0.275)], [0.012, 0.017, 0.018, 0.016, 0.012], n=8, steps=2))
        out.append(ws.tube([(s * 0.181, 0.20, 0.165), (s * 0.178, 0.20, 0.0), (s * 0.178, 0.20, -0.185)], 0.009, n=8, steps=2))
    out.append(ws.tube([(-0.176, 0.26, 0.0), (0, 0.255, 0.0), (0.176, 0.26, 0.0)], 0.009, n=8, steps=2))
    for y, z in ((0.60, -0.188), (0.72, -0.212), (0.84, -0.248)):
        def slat(u, v, y=y, z=z):
            a = v * ws.TAU
            return 0.345 * (u - 0.5), y + 0.030 * np.sin(a), z - 0.030 * (1 - (2 * u - 1) ** 2) - 0.006 * np.cos(a) - 0.008 * np.sin(a)
        out.append(ws.grid(slat, 6, 10, flip=True))
    return [ws.place(m, at, turn=turn) for m in out]


def armchair(at, turn):
    """Looks towards +z. Returns (upholstery, cushion, legs)."""
    soft = lambda at, size, bevel, tilt=0.0, steps=3: ws.place(puff(ws.box(size, bevel, steps), size), at, tilt=tilt)

    def puff(m, size):
        """Cushions swell in the middle of their faces."""
        P, N, UV, F = m
        q = 2 * P / np.asarray(size)
        s = 1 + 0.05 * (1 - np.clip(abs(q[:, [1, 2, 0]]), 0, 1) ** 2) * (1 - np.clip(abs(q[:, [2, 0, 1]]), 0, 1) ** 2)
        return ws.smooth((P * s, N, UV, F))

    cloth = [soft((0, 0.255, 0), (0.74, 0.15, 0.72), 0.03), soft((0, 0.395, 0.045), (0.525, 0.15, 0.62), 0.055), soft((0, 0.66, -0.275), (0.54, 0.60, 0.16), 0.065, -13)]
    cloth += [soft((s * 0.335, 0.43, 0.015), (0.135, 0.32, 0.72), 0.06) for s in (-1, 1)]
    cushion = [ws.place(pillow(0.40, 0.30), (0.05, 0.605, -0.115), tilt=-24, roll=6)]
    legs = [leg((x, 0.185, z), (x * 1.08, 0.012, z * 1.08), 0.022, 0.013) for x in (-0.30, 0.30) for z in (-0.28, 0.28)]
    return tuple([ws.place(m, at, turn=turn) for m in group] for group in (cloth, cushion, legs))


def pillow(w, h):
    def side(s):
        def f(u, v):
            x, y = 2 * u - 1, 2 * v - 1
            t = np.clip((1 - x**2) * (1 - y**2), 0, 1) ** 0.45
            pinch = 1 - 0.07 * (1 - abs(x) ** 2) * abs(y) - 0.07 * (1 - abs(y) ** 2) * abs(x)
            return w / 2 * x * pinch, h / 2 * y * pinch, s * 0.062 * t
        return ws.grid(f, 20, 16, flip=s > 0)
    return ws.join([side(1), side(-1)])


board, knobs = sideboard(-1.10, 0.50, 0.40, 0.79)
mesh("sideboard", board, uv=True)
mesh("knobs", knobs)
mesh("table", round_table(-1.30, -0.70, 0.53, 0.745), uv=True)
mesh("chairs", chair((-0.62, 0, -0.42), -70) + chair((-1.62, 0, -1.42), 22), uv=True)
upholstery, cushion, legs = armchair((1.22, 0, -0.72), -38)
mesh("armchair", upholstery, uv=True)
mesh("cushion", cushion, uv=True)
mesh("armchair-legs", legs)


def tweed(h, w):
    y, x = np.mgrid[0:h, 0:w]
    twill = 0.5 + 0.5 * np.sin((x + y) * ws.TAU / 8)
    return ws.ramp(0.45 + 0.20 * (twill - 0.5) + 0.12 * ws.noise(h, w, 60, 60, 5), [(142, 92, 28), (188, 130, 48), (214, 162, 78)])


def cushion_cloth(h, w):
    y, x = np.mgrid[0:h, 0:w]
    base = ws.ramp(0.5 + 0.12 * ws.noise(h, w, 60, 60, 6), [(196, 184, 160), (226, 216, 196)])
    zig = (y / h * 9 + abs((x / w * 8) % 2 - 1) * 0.9) % 1
    return ws.mix(base, np.broadcast_to(np.array([52, 84, 96]) / 255, base.shape), (zig < 0.38) * 0.9)


texture("tweed", tweed(128, 128), 32)
texture("cushion", cushion_cloth(192, 256), 32)


# ---------------------------------------------------------------- small things

def vase(profile, at, n=32, steps=2):
    return ws.place(ws.lathe(profile, n=n, steps=steps), at)


def plant(at, pot_top):
    rng, leaves, stems = np.random.default_rng(3), [], []
    for k in range(46):
        a = k * 2.39996 + rng.uniform(-0.3, 0.3)
        h = 0.10 + 1.0 * (k / 46) ** 0.9
        lean = 0.20 * (1 - 0.4 * k / 46) * rng.uniform(0.6, 1.2)
        root = np.array(at) + [0, pot_top, 0]
        tip = root + [lean * np.cos(a), h, -lean * np.sin(a)]
        if k % 2 == 0:
            stems.append(ws.tube([root + [0.03 * np.cos(a), -0.02, -0.03 * np.sin(a)], root + [0.5 * lean * np.cos(a), 0.6 * h, -0.5 * lean * np.sin(a)], tip], [0.006, 0.005, 0.003], n=5, steps=2, ends=False))
        else:
            tip = tip - [0, 0.04, 0]
            stems.append(ws.tube([root + [0, 0.3 * h, 0], (root + tip) / 2 + [0, 0.08, 0], tip], [0.004, 0.003, 0.002], n=5, steps=2, ends=False))
        size = rng.uniform(0.24, 0.36)
        leaves.append(ws.place(ws.leaf(size, size * 0.42, np.radians(rng.uniform(5, 40)), rng.uniform(1.2, 2.2), 0.18), tip, turn=np.degrees(a), tilt=rng.uniform(-15, 15)))
    return leaves, stems


leaves, stems = plant((-2.14, 0, -2.0), 0.36)
mesh("plant-leaves", leaves)
mesh("plant-stems", stems)
mesh("plant-pot", vase([[(0, 0.001), (0.13, 0.001)], [(0.13, 0.001), (0.145, 0.01), (0.17, 0.12), (0.182, 0.26), (0.180, 0.375)], [(0.180, 0.375), (0.182, 0.384), (0.176, 0.390), (0.168, 0.385), (0.166, 0.36)], [(0.166, 0.36), (0, 0.352)]], (-2.14, 0, -2.0), 48))

# A bunch of eucalyptus in a jug, a bowl of oranges and a cup on the table; lamp, jars and a dish elsewhere.
TABLE = 0.7455
twigs, sprays, rng = [], [], np.random.default_rng(12)
jug_at = np.array((-1.42, TABLE, -0.86))
for k in range(9):
    a, reach, h = k * 2.4 + 0.5, rng.uniform(0.10, 0.24), rng.uniform(0.30, 0.52)
    root = jug_at + [0, 0.12, 0]
    pts = [root, root + [0.3 * reach * np.cos(a), 0.45 * h, 0.3 * reach * np.sin(a)], root + [reach * np.cos(a), h, reach * np.sin(a)]]
    twigs.append(ws.tube(pts, [0.0026, 0.0022, 0.0012], n=6, steps=5, ends=False))
    way = ws.spline(pts, 10)
    for j in range(7, 21, 2):
        for s in (0, 1):
            w = rng.uniform(0.030, 0.048) * (1.15 - j / 40)
            sprays.append(ws.place(ws.leaf(w * 1.5, w, np.radians(rng.uniform(0, 50)), 3.0, 0.1, 4), way[min(j, len(way) - 1)], turn=rng.uniform(0, 360), tilt=rng.uniform(-30, 30)))
mesh("twigs", twigs)
mesh("sprays", sprays)
mesh("white-glaze", [
    vase([[(0, 0.0), (0.045, 0.0)], [(0.045, 0.0), (0.052, 0.004), (0.070, 0.05), (0.072, 0.10), (0.050, 0.155), (0.036, 0.185), (0.043, 0.215), (0.045, 0.219), (0.042, 0.219), (0.032, 0.185), (0.046, 0.15), (0.06, 0.10)]], jug_at),
    vase([[(0, 0.0), (0.022, 0.0)], [(0.022, 0.0), (0.026, 0.003), (0.038, 0.03), (0.041, 0.062), (0.0415, 0.068), (0.0395, 0.068), (0.036, 0.03), (0.02, 0.008), (0, 0.007)]], (-0.98, TABLE + 0.0085, -0.60), 36),
    vase([[(0, 0.001), (0.03, 0.0), (0.045, 0.004), (0.070, 0.012), (0.0715, 0.0145), (0.068, 0.014), (0.04, 0.0075), (0, 0.0065)]], (-0.98, TABLE, -0.60), 40),
    vase([[(0, 0.0), (0.06, 0.0)], [(0.06, 0.0), (0.068, 0.005), (0.098, 0.07), (0.100, 0.14), (0.064, 0.215), (0.030, 0.262), (0.022, 0.30), (0.020, 0.32)]], (0.26, 0.7905, -2.16), 40),
])
mesh("blue-glaze", [
    vase([[(0, 0.001), (0.05, 0.0)], [(0.05, 0.0), (0.056, 0.006), (0.10, 0.035), (0.150, 0.085), (0.152, 0.090), (0.147, 0.089), (0.096, 0.041), (0.04, 0.016), (0, 0.014)]], (-1.14, TABLE, -1.00 + 0.06), 56),
    vase([[(0, 0.0), (0.04, 0.0)], [(0.04, 0.0), (0.048, 0.006), (0.062, 0.06), (0.055, 0.12), (0.03, 0.17), (0.026, 0.20), (0.040, 0.235), (0.037, 0.236), (0.02, 0.20)]], (1.85, SHELVES[2] + 0.0125, -2.20), 36),
    vase([[(0, 0.0), (0.05, 0.0)], [(0.05, 0.0), (0.075, 0.05), (0.070, 0.10), (0.052, 0.125), (0.054, 0.140), (0.050, 0.141), (0.046, 0.12)]], (-0.42, 0.7905, -2.17), 40),
    vase([[(0, 0.0), (0.045, 0.0)], [(0.045, 0.0), (0.052, 0.01), (0.058, 0.08), (0.040, 0.15), (0.042, 0.17), (0.038, 0.17)]], (1.95, SHELVES[4] + 0.0125, -2.19), 36),
])
mesh("oranges", [ws.place(ws.ball(3), p, scale=r) for p, r in (((-1.19, TABLE + 0.058, -0.96), 0.040), ((-1.105, TABLE + 0.060, -0.975), 0.041), ((-1.13, TABLE + 0.059, -0.885), 0.040), ((-1.145, TABLE + 0.118, -0.94), 0.039))])
mesh("lamp-shade", [ws.place(ws.lathe([[(0.165, 0.0), (0.110, 0.235)], [(0.110, 0.235), (0.108, 0.235)], [(0.108, 0.235), (0.163, 0.0)]], n=48, steps=1), (0.26, 1.13, -2.16))])
mesh("globe", [ws.place(ws.ball(3), (1.04, SHELVES[3] + 0.155, -2.19), scale=0.085)])
mesh("brass", [
    ws.tube([(0.26, 1.105, -2.16), (0.26, 1.2, -2.16), (0.26, 1.30, -2.16)], 0.008, n=10, steps=1),
    ws.place(ws.lathe([[(0, 0.0), (0.05, 0.0)], [(0.05, 0.0), (0.052, 0.004), (0.04, 0.010), (0.012, 0.018), (0.008, 0.03), (0.010, 0.045), (0.006, 0.055)]], n=28, steps=3), (1.04, SHELVES[3] + 0.0445, -2.19)),
])


# ---------------------------------------------------------------- sky

def trees(c):
    """A far line of trees under the sky, so that the windows have something to show."""
    h, w, _ = c.shape
    theta = (np.arange(h) + 0.5) / h * 180
    line = 90 - 5.5 - 3.2 * ws.noise(1, w, 1, 9, 7, 1.0)[0] - 1.2 * ws.noise(1, w, 1, 60, 8, 1.0)[0]
    t = np.clip((theta[:, None] - line[None]) / 1.2, 0, 1) * (theta[:, None] < 92)
    shade = 1 + 0.25 * ws.noise(h, w, 40, 80, 9)
    return c * (1 - t[..., None]) + np.array([0.20, 0.27, 0.11]) * (shade * t)[..., None]


s = ws.sky(256, 512, (-0.78, 0.52, -0.32), (7600, 6700, 5300), 0.75, (0.55, 0.95, 1.75), (1.6, 1.9, 2.2), (2.6, 2.2, 1.6), (0.50, 0.47, 0.34))
s = trees(s)
# No window sees the half with x > 0, the left half of the picture: were it bright, half of the light samples would be lost.
s[:, 2:254] *= 0.01
ws.save_hdr(HERE / "sky.hdr", s)
