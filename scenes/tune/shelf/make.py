"""Writes the meshes and textures of the shelf. Needs numpy.

    python3 make.py

Objects stand at the origin, as in the still life; `scene.xml` places them.
"""
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent.parent / "library"))
import workshop as ws  # noqa: E402


def mesh(name, parts, uv=False):
    ws.save_ply(HERE / f"{name}.ply", ws.join(parts) if isinstance(parts, list) else parts, uv)


def boards():
    """Two shelves with a batten under each; the tops lie in y = 0 and y = 0.30."""
    out = []
    for k, y in enumerate((0.0, 0.30)):
        out.append(ws.place(ws.box((1.7, 0.026, 0.26), 0.004, 2, (0.4 * k, 0.13 * k)), (0, y - 0.013, 0)))
        for x in (-0.62, 0.62):
            out.append(ws.place(ws.box((0.022, 0.10, 0.20), 0.004, 1, (0.2, 0.3)), (x, y - 0.077, -0.02)))
    return out


def doll():
    """A nesting doll, 12 cm, with the seam around its waist."""
    return ws.lathe([
        [(0, 0.0), (0.024, 0.0)], [(0.024, 0.0), (0.027, 0.002), (0.031, 0.018), (0.0335, 0.040), (0.0318, 0.0595)], [(0.0318, 0.0595), (0.0312, 0.0602)],
        [(0.0312, 0.0602), (0.029, 0.070), (0.0225, 0.080), (0.0205, 0.084), (0.0225, 0.090), (0.0238, 0.100), (0.0205, 0.112), (0.011, 0.1195), (0, 0.1212)],
    ], n=32, steps=2)


def doll_paint(h, w):
    """u around (face at 0.25), v from foot to crown."""
    y, x = np.mgrid[0:h, 0:w]
    u, v = (x + 0.5) / w, (y + 0.5) / h
    rgb = lambda *c: np.broadcast_to(np.array(c) / 255, (h, w, 3))
    grain = 1 + 0.03 * ws.noise(h, w, 3, 40, 1)
    c = np.where((v < 0.46)[..., None], rgb(172, 44, 38), rgb(198, 150, 54)).copy()
    du = (u - 0.25) * 2.6
    put = lambda mask, *colour: c.__setitem__(mask, np.array(colour) / 255)
    put((v < 0.075) | (abs(v - 0.47) < 0.012), 42, 60, 50)
    put((abs(du) < 0.30 * np.clip((v - 0.06) / 0.2, 0, 1) ** 0.4) & (v > 0.08) & (v < 0.45), 222, 208, 176)
    for cu, cv, r in ((0.0, 0.27, 0.085), (-0.15, 0.17, 0.055), (0.15, 0.17, 0.055), (-0.16, 0.36, 0.05), (0.16, 0.36, 0.05)):
        a, d = np.arctan2(v - cv, du - cu), np.hypot(du - cu, v - cv)
        put(d < r * (0.78 + 0.22 * np.cos(5 * a)), 190, 58, 66), put(d < r * 0.3, 226, 176, 60)
        put((d > r * 0.85) & (d < r * 1.3) & (np.cos(4 * a + 1) > 0.6), 70, 104, 62)
    face = np.hypot(du / 0.24, (v - 0.795) / 0.085)
    put(face < 1.22, 92, 56, 34), put((face < 1) & (abs(du) + 0 * v < 0.24 - 0.9 * np.clip(v - 0.83, 0, 1)), 232, 198, 164)
    for s in (-1, 1):
        put(np.hypot((du - s * 0.085) / 0.030, (v - 0.805) / 0.012) < 1, 48, 44, 52)
        blush = np.exp(-(((du - s * 0.12) / 0.05) ** 2 + ((v - 0.770) / 0.016) ** 2))
        c = ws.mix(c, rgb(226, 120, 104), 0.7 * blush * (face < 1))
        put((abs(v - 0.825 + 0.6 * (du - s * 0.085) ** 2 * 4) < 0.004) & (abs(du - s * 0.085) < 0.045), 92, 56, 34)
    put(np.hypot(du / 0.040, (v - 0.752) / 0.009) < 1, 176, 44, 48)
    dots = (np.hypot(((u * 14) % 1 - 0.5), ((v * 22) % 1 - 0.5)) < 0.22) & (v > 0.49) & (face > 1.35)
    put(dots, 158, 46, 40)
    return np.clip(c * grain[..., None], 0, 0.92)


def bottle():
    """One closed surface of glass, 2.5 mm thick."""
    return ws.lathe([
        [(0, 0.004), (0.020, 0.002), (0.029, 0.0003), (0.0335, 0.0025), (0.0350, 0.008), (0.0352, 0.06), (0.0348, 0.105), (0.031, 0.126), (0.019, 0.142), (0.0135, 0.152), (0.0125, 0.175),
         (0.0128, 0.181), (0.0150, 0.183), (0.0156, 0.188), (0.0150, 0.193), (0.0120, 0.1945), (0.0100, 0.1925), (0.0098, 0.175), (0.0108, 0.153), (0.0165, 0.140), (0.0282, 0.124),
         (0.0322, 0.104), (0.0327, 0.06), (0.0325, 0.012), (0.030, 0.0075), (0.018, 0.0070), (0, 0.0085)],
    ], n=32, steps=2)


def tin():
    """A turned canister: brushed around, so u is the direction of the scratches."""
    return ws.lathe([
        [(0, 0.0), (0.045, 0.0)], [(0.045, 0.0), (0.0475, 0.0008), (0.0485, 0.003)], [(0.0485, 0.003), (0.0485, 0.098)], [(0.0485, 0.098), (0.0478, 0.0990)],
        [(0.0478, 0.0990), (0.0495, 0.0995), (0.0502, 0.1015), (0.0502, 0.1240)], [(0.0502, 0.1240), (0.0494, 0.1268), (0.047, 0.1278)], [(0.047, 0.1278), (0.012, 0.1300), (0.006, 0.1302)],
        [(0.006, 0.1302), (0.0045, 0.134), (0.0080, 0.139), (0.0085, 0.143), (0.006, 0.147), (0, 0.148)],
    ], n=44, steps=1)


def mug():
    body = ws.lathe([
        [(0, 0.002), (0.026, 0.002)], [(0.026, 0.002), (0.028, 0.0), (0.031, 0.001), (0.0365, 0.010), (0.040, 0.035), (0.0405, 0.065), (0.0398, 0.086), (0.0392, 0.0885), (0.0380, 0.0885), (0.0372, 0.086),
         (0.0378, 0.065), (0.0370, 0.035), (0.032, 0.012), (0.02, 0.007), (0, 0.006)],
    ], n=32, steps=2)
    handle = ws.place(ws.tube([(0.036, 0.072, 0), (0.055, 0.076, 0), (0.068, 0.062, 0), (0.066, 0.042, 0), (0.052, 0.028, 0), (0.036, 0.024, 0)], 0.0046, n=8, steps=3), scale=(1, 1, 1.4))
    return [body, handle]


def cactus():
    def ribs(P, angle):
        swell = np.clip(P[:, 1] / 0.02, 0, 1) * np.clip((0.098 - P[:, 1]) / 0.02, 0, 1)
        r = 1 + 0.13 * swell * np.cos(11 * angle)
        return P * np.stack([r, 1 + 0 * r, r], -1)

    return ws.lathe([[(0.020, 0.0), (0.033, 0.018), (0.040, 0.045), (0.036, 0.075), (0.020, 0.095), (0.006, 0.0975), (0, 0.096)]], n=88, steps=2, warp=ribs)


def spines():
    """A tuft on every rib, eight high: three-sided needles."""
    rng, out = np.random.default_rng(6), []
    for k in range(11):
        for j in range(7):
            y = 0.016 + 0.0115 * j
            r = 1.13 * np.interp(y, [0, 0.018, 0.045, 0.075, 0.095], [0.020, 0.033, 0.040, 0.036, 0.020])
            a = 2 * np.pi * k / 11
            for _ in range(4):
                b, e = a + rng.normal(0, 0.5), rng.normal(0.2, 0.5)
                d = np.array([np.cos(b) * np.cos(e), np.sin(e), np.sin(b) * np.cos(e)])
                p = np.array([r * np.cos(a), y, r * np.sin(a)])
                side = np.cross(d, [0.2, 1, 0.1])
                side /= np.linalg.norm(side)
                P = np.array([p + 0.0005 * side, p - 0.0005 * side, p + 0.010 * d])
                out.append(ws.finish(P, np.tile(np.cross(side, d), (3, 1)), np.zeros((3, 2)), [(0, 1, 2)]))
    return out


def pot():
    return ws.lathe([
        [(0, 0.001), (0.026, 0.001)], [(0.026, 0.001), (0.028, 0.003), (0.036, 0.044)], [(0.036, 0.044), (0.041, 0.045), (0.0415, 0.047), (0.0415, 0.060), (0.040, 0.062), (0.037, 0.062), (0.036, 0.058)],
        [(0.036, 0.058), (0, 0.057)],
    ], n=36, steps=1)


def cup():
    """A little trophy: foot, knop, bowl and two ears."""
    body = ws.lathe([
        [(0, 0.020), (0.030, 0.020)], [(0.030, 0.020), (0.032, 0.022), (0.026, 0.030), (0.010, 0.040), (0.007, 0.050), (0.012, 0.056), (0.007, 0.062), (0.012, 0.070), (0.030, 0.085), (0.038, 0.110), (0.041, 0.145),
         (0.0435, 0.150), (0.0430, 0.152), (0.0405, 0.151), (0.0365, 0.110), (0.028, 0.090), (0, 0.078)],
    ], n=36, steps=2)
    ears = [ws.tube([(s * x, y, 0) for x, y in ((0.039, 0.135), (0.058, 0.148), (0.068, 0.130), (0.056, 0.104), (0.034, 0.098))], [0.0030, 0.0032, 0.0034, 0.0032, 0.0026], n=8, steps=3) for s in (-1, 1)]
    return [body] + ears


def clock():
    """A travelling clock: drum on two feet, tilted a little by `scene.xml`; the dial lies in z = 0.02."""
    drum = ws.lathe([
        [(0, -0.022), (0.052, -0.022)], [(0.052, -0.022), (0.0555, -0.020), (0.057, -0.016), (0.057, 0.016)], [(0.057, 0.016), (0.0595, 0.018), (0.0605, 0.022), (0.0585, 0.026), (0.055, 0.026), (0.0525, 0.0205)],
    ], n=44, steps=1)
    drum = ws.place(drum, tilt=90)
    feet = [ws.tube([(s * 0.030, -0.048, 0.0), (s * 0.038, -0.060, 0.004), (s * 0.042, -0.066, 0.006)], [0.006, 0.0045, 0.006], n=10, steps=2) for s in (-1, 1)]
    knob = ws.place(ws.lathe([[(0, 0.055), (0.004, 0.055), (0.004, 0.064), (0.009, 0.066), (0.009, 0.074), (0.006, 0.077), (0, 0.077)]], n=20, steps=1))
    return [drum, knob] + feet


def hands():
    out = []
    for angle, length, width in ((-52, 0.027, 0.0034), (60, 0.041, 0.0024)):
        out.append(ws.place(ws.place(ws.box((width, length, 0.0012), 0.0004, 1), (0, length * 0.40, 0)), (0, 0, 0.0225 + 0.0008 * (width < 0.003)), roll=angle))
    return out + [ws.place(ws.ball(2), (0, 0, 0.0232), scale=(0.003, 0.003, 0.0015))]


def dial(n):
    """Square picture of the dial; the mesh of the same name looks it up from the front."""
    y, x = (np.mgrid[0:n, 0:n] + 0.5) / n - 0.5
    r, a = np.hypot(x, y) * 2, np.arctan2(x, -y) / (2 * np.pi) * 60
    c = ws.ramp(0.75 + 0.08 * ws.noise(n, n, 4, 4, 2), [(206, 192, 160), (232, 222, 198)])
    near = lambda step, half: abs((a + step / 2) % step - step / 2) * r * np.pi / 60 < half
    ink = ((r > 0.84) & (r < 0.93) & near(1, 0.006)) | (abs(r - 0.84) < 0.006) | (abs(r - 0.93) < 0.006)
    ink |= (r > 0.60) & (r < 0.80) & near(5, 0.026) | (r > 0.56) & (r < 0.80) & near(15, 0.040)
    return ws.mix(c, np.broadcast_to(np.array([40, 34, 32]) / 255, c.shape), 0.9 * ink)


def blocks():
    """Three wooden bricks, one on two; each face shows the whole picture."""
    one = ws.box((0.044, 0.044, 0.044), 0.003, 2)
    one = ws.retexture(one, lambda u, v: (u / 0.044, (v - 0.37 * np.round((v - 0.022) / 0.37)) / 0.044))
    return [ws.place(one, p, turn=t) for p, t in (((-0.026, 0.0225, 0), 8), ((0.026, 0.0225, 0.004), -14), ((0.002, 0.067, 0.002), 28))]


def brick_paint(n):
    """A star in a ring on bare wood, red border."""
    y, x = (np.mgrid[0:n, 0:n] + 0.5) / n - 0.5
    c = ws.wood(n, n, 3, [(178, 138, 90), (206, 170, 122), (222, 192, 150)], rings=3)
    m = np.maximum(abs(x), abs(y))
    rgb = lambda *k: np.broadcast_to(np.array(k) / 255, c.shape)
    c = ws.mix(c, rgb(158, 48, 40), 0.92 * ((m > 0.36) & (m < 0.45)))
    r, a = np.hypot(x, y), np.arctan2(x, -y)
    k = np.cos(np.pi / 5) / np.cos((a % (2 * np.pi / 5)) - np.pi / 5)
    star = 0.27 * np.minimum(k, 0.42 + 0.58 * abs(((a / (2 * np.pi / 5)) % 1) * 2 - 1) ** 1.3)
    c = ws.mix(c, rgb(44, 78, 112), 0.92 * (abs(r - 0.30) < 0.018))
    return ws.mix(c, rgb(206, 150, 44), 0.92 * (r < star))


def bird():
    """A glazed wren: body, head, cocked tail."""
    body = ws.place(ws.ball(3), (0, 0.030, 0), roll=18, scale=(0.036, 0.027, 0.026))
    head = ws.place(ws.ball(3), (0.027, 0.055, 0), scale=(0.0175, 0.0165, 0.016))
    tail = ws.tube([(-0.020, 0.034, 0), (-0.040, 0.048, 0), (-0.056, 0.072, 0)], [0.012, 0.0075, 0.0045], n=14, steps=5)
    beak = ws.tube([(0.041, 0.055, 0), (0.047, 0.0545, 0), (0.054, 0.053, 0)], [0.0042, 0.0028, 0.0006], n=8, steps=2)
    return [body, head, ws.place(tail, scale=(1, 1, 1.0)), beak, ws.place(ws.lathe([[(0, 0.0), (0.014, 0.0)], [(0.014, 0.0), (0.016, 0.002), (0.014, 0.010), (0.010, 0.014)]], n=24, steps=2))]


def lying_book(w, h, t, at, turn):
    """(boards and spine, pages) of a book on its side: w along z, h along x, spine to the viewer."""
    cover = [ws.place(ws.box((h, 0.003, w), 0.0012, 1), (0, y, 0)) for y in (0.0015, t - 0.0015)]
    a = np.linspace(-np.pi / 2, np.pi / 2, 9)
    rail = lambda u, v: (h * (u - 0.5), t / 2 + t / 2 * np.sin((v - 0.5) * np.pi), w / 2 - 0.002 + 0.010 * np.cos((v - 0.5) * np.pi))
    spine = ws.grid(rail, 1, len(a), flip=True)
    pages = ws.box((h - 0.008, t - 0.0065, w - 0.006), 0.0008, 1)
    return [ws.place(m, at, turn=turn) for m in cover + [spine]], ws.place(ws.place(pages, (0, t / 2, -0.001)), at, turn=turn)


def wallpaper(n):
    """Sprigs in a half drop on a pale green ground."""
    y, x = (np.mgrid[0:n, 0:n] + 0.5) / n
    c = ws.ramp(0.5 + 0.10 * ws.noise(n, n, 60, 60, 7) + 0.08 * ws.noise(n, n, 3, 3, 8), [(150, 160, 138), (178, 186, 164), (196, 202, 182)])
    ink, bloom = np.zeros((n, n)), np.zeros((n, n))
    for cu, cv in ((0.25, 0.25), (0.75, 0.75)):
        dx, dy = (x - cu + 0.5) % 1 - 0.5, (y - cv + 0.5) % 1 - 0.5
        ink = np.maximum(ink, (abs(dx - 0.03 * np.sin(dy * 12)) < 0.007) & (abs(dy) < 0.20))
        for k, ly in enumerate((-0.12, -0.04, 0.04, 0.12)):
            for s in (-1, 1):
                a, b = s * dx - 0.065, dy - ly + 0.55 * (s * dx) - 0.01
                ink = np.maximum(ink, (a / 0.062) ** 2 + (b / (0.020 * (1.2 - a / 0.09))) ** 2 < 1)
        a, r = np.arctan2(dy + 0.22, dx), np.hypot(dx, dy + 0.22)
        bloom = np.maximum(bloom, r < 0.060 * (0.8 + 0.2 * np.cos(6 * a)))
    c = ws.mix(c, np.broadcast_to(np.array([104, 124, 100]) / 255, c.shape), 0.8 * ink)
    return ws.mix(c, np.broadcast_to(np.array([206, 176, 150]) / 255, c.shape), 0.85 * bloom)


mesh("boards", boards(), uv=True)
mesh("doll", doll(), uv=True)
mesh("bottle", bottle())
mesh("tin", tin(), uv=True)
mesh("mug", mug())
mesh("cactus", cactus())
mesh("needles", spines())
mesh("pot", pot())
mesh("cup", cup())
mesh("plinth", ws.place(ws.box((0.066, 0.020, 0.066), 0.003, 2), (0, 0.0102, 0)))
mesh("clock", clock())
mesh("hands", hands())
face = ws.lathe([[(0.0535, 0), (0, 0)]], n=44, steps=1)
mesh("dial", ws.place(ws.retexture(face, lambda u, v: (0.5 + face[0][:, 0] / 0.107, 0.5 + face[0][:, 2] / 0.107)), (0, 0, 0.0212), tilt=90), uv=True)
mesh("blocks", blocks(), uv=True)
mesh("bird", bird())
stack = [lying_book(0.150, 0.215, 0.030, (0, 0.0003, 0), 3), lying_book(0.140, 0.195, 0.024, (0.004, 0.0308, 0.0), -6), lying_book(0.125, 0.175, 0.020, (-0.004, 0.0553, 0.002), 9)]
for k, (cover, _) in enumerate(stack):
    mesh(f"cover-{k + 1}", cover)
mesh("pages", [p for _, p in stack])
ws.save_png(HERE / "doll.png", doll_paint(256, 256), 48)
ws.save_png(HERE / "dial.png", dial(192), 24)
ws.save_png(HERE / "brick.png", brick_paint(128), 32)
ws.save_png(HERE / "wallpaper.png", wallpaper(224), 24)
ws.save_png(HERE / "pine.png", ws.wood(320, 640, 41, [(126, 84, 48), (172, 126, 78), (198, 154, 104), (214, 178, 130)], rings=5), 32)
