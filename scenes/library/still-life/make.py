"""Writes the meshes and textures of the still life. Needs numpy.

    python3 make.py
"""
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
import workshop as ws  # noqa: E402


def mesh(name, m, uv=True):
    ws.save_ply(HERE / f"{name}.ply", m, uv)


def texture(name, rgb, levels=64):
    ws.save_png(HERE / f"{name}.png", rgb, levels)


# ---------------------------------------------------------------- table, cloth and wall

def planks():
    """The table: three planks along x, with gaps where the shadow sits."""
    out, z = [], -0.48
    for k, width in enumerate((0.30, 0.34, 0.30)):
        out.append(ws.place(ws.box((2.2, 0.036, width - 0.003), 0.004, 2, (0.31 * k, 0.27 * k)), (0, -0.018, z + width / 2)))
        z += width
    out.append(ws.place(ws.box((2.1, 0.10, 0.03), 0.003, 1, (0.5, 0.11)), (0, -0.09, z - 0.10)))
    return ws.join(out)


STANDING = [(-0.255, 0.02, 0.075), (-0.03, 0.20, 0.145), (-0.405, 0.19, 0.05)]  # x, z, radius: here the cloth lies flat


def cloth(u, v):
    """A linen runner, flung slantwise over the table's edge at z = 0.46; v runs towards the viewer."""
    edge, bend = 0.468, 0.022
    x0 = -0.50 + 0.66 * u
    s = -0.34 + 1.16 * v  # along the cloth
    x = x0 + 0.16 * (s - 0.1) + 0.012 * np.sin(9 * s + 3 * u)
    over = np.maximum(s - edge, 0)
    a = np.minimum(over / bend, np.pi / 2)
    z = np.minimum(s, edge) + bend * np.sin(a)
    y = -bend * (1 - np.cos(a)) - np.maximum(over - bend * np.pi / 2, 0)
    # Folds: ridges along the cloth that fade where something stands on it, and deepen where it hangs.
    flat = 1.0
    for cx, cz, r in STANDING:
        d = np.hypot(x - cx, z - cz) / r
        flat = flat * np.clip((d - 0.95) / 0.45, 0, 1) ** 1.5
    q = u * 24 + 1.8 * np.sin(3.1 * s + 1) + 1.1 * np.sin(7 * s + 4 * u)
    ridge = np.exp(2.2 * (np.sin(q) - 1)) + 0.6 * np.exp(4 * (np.sin(q * 0.62 + 5.2 * s + 2) - 1))
    ridge = ridge + 0.30 * np.exp(5 * (np.sin(21 * s - 9 * u + 2 * np.sin(9 * u)) - 1))
    hang = np.clip(over / 0.16, 0, 1)
    y = y + 0.0035 + (1 - hang) * 0.019 * ridge * flat * np.clip((u + 0.02) * 6, 0, 1)
    z = z + hang * (0.004 + 0.034 * (0.5 + 0.5 * np.sin(q * 0.8 + 0.5)))
    return x, y, z


def linen(h, w):
    """Plain weave with uneven threads and a blue stripe near both long edges."""
    y, x = np.mgrid[0:h, 0:w]
    warp, weft = np.sin(x * 2 * np.pi / 4), np.sin(y * 2 * np.pi / 4)
    weave = 0.5 + 0.25 * warp * weft
    slub = 0.5 * ws.noise(h, w, 3, 100, 1) + 0.5 * ws.noise(h, w, 100, 3, 2)
    c = ws.ramp(0.55 + 0.30 * (weave - 0.5) + 0.10 * slub, [(160, 148, 128), (202, 193, 175), (220, 213, 199)])
    u = x / w
    blue = sum(np.where(abs(abs(u - 0.5) - at) < width, 1.0, 0.0) for at, width in ((0.43, 0.018), (0.395, 0.005), (0.465, 0.005)))
    return ws.mix(c, c * np.array([0.36, 0.47, 0.66]), 0.92 * np.minimum(blue, 1))


def plaster(h, w):
    """Old lime wash: broad stains and a few scratches of the float."""
    n = 0.6 * ws.noise(h, w, 3, 3, 11, 1.3) + 0.3 * ws.noise(h, w, 14, 14, 12) + 0.10 * ws.noise(h, w, 4, 60, 13)
    return ws.ramp(0.5 + 0.17 * n, [(84, 82, 72), (124, 120, 104), (150, 146, 128), (168, 162, 144)])


mesh("table", planks())
mesh("cloth", ws.grid(cloth, 64, 84))
texture("wood", ws.wood(512, 1024, 5, [(46, 26, 15), (96, 56, 31), (134, 84, 48), (166, 112, 68)], rings=6), 48)
texture("linen", linen(512, 512), 24)
texture("plaster", plaster(384, 512), 24)

# ---------------------------------------------------------------- vessels

def jug():
    """A stoneware ewer: lip drawn into a spout towards +x, handle on the other side."""
    body = [
        [(0, 0.0), (0.050, 0.0)],
        [(0.050, 0.0), (0.0545, 0.002), (0.0555, 0.008), (0.053, 0.013)],
        [(0.053, 0.013), (0.074, 0.045), (0.0905, 0.095), (0.088, 0.140), (0.062, 0.185), (0.041, 0.220), (0.0385, 0.255), (0.047, 0.292),
         (0.0520, 0.304), (0.0535, 0.3075), (0.0525, 0.3100), (0.0500, 0.3095), (0.0470, 0.304), (0.0435, 0.29), (0.035, 0.255), (0.0365, 0.225), (0.058, 0.18)],
    ]

    def spout(P, angle):
        t = np.clip((P[:, 1] - 0.255) / 0.055, 0, 1) ** 1.5
        pull = np.exp(-((angle / 0.42) ** 2))
        P = P.copy()
        P[:, 0] += 0.030 * t * pull
        P[:, 1] += 0.010 * t * pull
        P[:, 2] *= 1 - 0.12 * t
        return P

    handle = ws.tube([(-0.043, 0.286, 0), (-0.078, 0.300, 0), (-0.118, 0.275, 0), (-0.130, 0.225, 0), (-0.116, 0.170, 0), (-0.082, 0.125, 0)],
                     [0.0095, 0.0095, 0.0090, 0.0085, 0.0085, 0.0105], n=10, steps=4)
    handle = ws.place(handle, scale=(1, 1, 1.35))
    handle = ws.retexture(handle, lambda u, v: (0 * u + 0.5, 0.9 + 0 * v))
    return ws.join([ws.lathe(body, n=48, steps=2, warp=spout), handle])


def glaze(h, w):
    """Cream glaze, thin at the foot, with a brushed cobalt band and sprigs."""
    v, u = (k[0] for k in (np.mgrid[0:h, 0:w][:1] / h, np.mgrid[0:h, 0:w][1:] / w))
    c = ws.ramp(0.6 + 0.12 * ws.noise(h, w, 5, 5, 31) + 0.03 * ws.noise(h, w, 60, 60, 32), [(196, 182, 150), (222, 212, 188), (234, 228, 212)])
    ink = np.zeros((h, w))
    for at, width in ((0.345, 0.006), (0.36, 0.0025), (0.615, 0.0045), (0.63, 0.002)):
        ink = np.maximum(ink, np.clip(1.4 - abs(v - at + 0.002 * np.sin(u * 25)) / width, 0, 1))
    for k in range(5):  # a sprig: a stem and paired leaves
        cu, cv = (k + 0.5) / 5, 0.487
        du, dv = (u - cu) * 2.3, v - cv
        ink = np.maximum(ink, np.where(abs(dv) < 0.085, np.clip(1.3 - abs(du - 0.02 * np.sin(dv * 30)) / 0.005, 0, 1), 0))
        for j, (ly, s) in enumerate((y, s) for y in (-0.06, -0.02, 0.02, 0.06) for s in (-1, 1)):
            a, b = (du - s * 0.042) * s, dv - ly + 0.3 * (du * s)
            ink = np.maximum(ink, np.clip(2.2 - 2.2 * ((a / 0.038) ** 2 + (b / (0.011 * (1.15 - a / 0.06))) ** 2), 0, 1))
        ink = np.maximum(ink, np.clip(2 - 2 * ((du / 0.02) ** 2 + ((dv + 0.095) / 0.02) ** 2), 0, 1))
    return ws.mix(c, np.broadcast_to(np.array([40, 62, 120]) / 255, c.shape), ink * (0.78 + 0.10 * ws.noise(h, w, 30, 30, 33)))


def pot():
    """A copper pot with a rolled rim and two ring handles of brass."""
    return ws.lathe([
        [(0, 0.001), (0.090, 0.001)],
        [(0.090, 0.001), (0.103, 0.004), (0.110, 0.014), (0.1145, 0.05), (0.1175, 0.11), (0.1190, 0.150)],
        [(0.1190, 0.150), (0.1215, 0.1515), (0.1225, 0.1545), (0.1215, 0.1575), (0.1185, 0.1585), (0.1160, 0.157), (0.1150, 0.153)],
        [(0.1150, 0.153), (0.1140, 0.11), (0.111, 0.05), (0.106, 0.017), (0.095, 0.008), (0, 0.007)],
    ], n=64, steps=2)


def handles():
    out = []
    for side in (-1, 1):
        arc = [(side * (0.119 + 0.030 * np.sin(a)), 0.128 + 0.008 * np.sin(a), 0.040 * np.cos(a)) for a in np.linspace(0.05, np.pi - 0.05, 9)]
        out.append(ws.tube(arc, 0.0055, n=10, steps=2))
        for z in (-0.042, 0.042):
            rivet = ws.place(ws.ball(2), (side * 0.1135, 0.128, z), scale=(0.009, 0.012, 0.012))
            out.append(rivet)
    return ws.join(out)


def bowl():
    return ws.lathe([
        [(0, 0.002), (0.044, 0.002)],
        [(0.044, 0.002), (0.0455, 0.0), (0.048, 0.001), (0.0485, 0.006), (0.047, 0.014)],
        [(0.047, 0.014), (0.075, 0.024), (0.104, 0.044), (0.126, 0.072), (0.1305, 0.0800), (0.1300, 0.0825), (0.1275, 0.0820), (0.122, 0.074), (0.100, 0.048), (0.072, 0.029), (0.04, 0.020), (0, 0.018)],
    ], n=64, steps=2)


def plate():
    return ws.lathe([
        [(0, 0.004), (0.095, 0.004)],
        [(0.095, 0.004), (0.0965, 0.0), (0.099, 0.0005), (0.108, 0.006), (0.118, 0.010), (0.155, 0.0155), (0.1575, 0.0165), (0.1580, 0.0185), (0.1560, 0.0198), (0.1530, 0.0190)],
        [(0.1530, 0.0190), (0.1490, 0.0182), (0.120, 0.0145), (0.113, 0.0120), (0.106, 0.0085), (0.095, 0.0078), (0, 0.0078)],
    ], n=72, steps=2)


def goblet():
    """A wine glass: one closed surface, glass 1.2 mm thick at the bowl."""
    return ws.lathe([
        [(0, 0.0015), (0.020, 0.0012), (0.034, 0.0003), (0.0365, 0.0012), (0.0366, 0.0022), (0.034, 0.0036), (0.020, 0.0054), (0.009, 0.0085), (0.0055, 0.016), (0.0046, 0.035),
         (0.0044, 0.060), (0.0050, 0.080), (0.0085, 0.091), (0.0200, 0.1005), (0.0325, 0.116), (0.0385, 0.138), (0.0380, 0.165), (0.0345, 0.1940),
         (0.03405, 0.1956), (0.0334, 0.1960), (0.0328, 0.1950), (0.0366, 0.165), (0.0371, 0.138), (0.0310, 0.1175), (0.0190, 0.1035), (0.0080, 0.0965), (0, 0.0950)],
    ], n=40, steps=2)


def wine():
    """Red wine in the goblet, kept a little off the glass: a plain opaque body reads better than nested dielectrics."""
    return ws.lathe([
        [(0, 0.0965), (0.0078, 0.0980), (0.0186, 0.1047), (0.0304, 0.1182), (0.0363, 0.137), (0.0362, 0.149)],
        [(0.0362, 0.149), (0.0355, 0.1486), (0.02, 0.1486), (0, 0.1486)],
    ], n=40, steps=2)


mesh("jug", jug())
mesh("pot", pot(), uv=False)
mesh("pot-handles", handles(), uv=False)
mesh("bowl", bowl(), uv=False)
mesh("plate", plate())
mesh("goblet", goblet(), uv=False)
mesh("wine", wine(), uv=False)
texture("glaze", glaze(512, 512), 40)

# ---------------------------------------------------------------- fruit

def apple():
    profile = [(0, 0.006), (0.006, 0.0035), (0.014, 0.0005), (0.023, 0.003), (0.034, 0.018), (0.0395, 0.038), (0.0375, 0.055), (0.028, 0.0685), (0.018, 0.0720), (0.010, 0.0690), (0.004, 0.0640), (0, 0.0625)]

    def lobes(P, angle):
        low = np.clip(1 - P[:, 1] / 0.05, 0, 1)
        r = 1 + 0.05 * low * np.cos(5 * angle) + 0.018 * np.cos(2 * angle + 1)
        return P * np.stack([r, 1 + 0.03 * np.cos(angle), r], -1)

    return ws.lathe([profile], n=32, steps=2, warp=lobes)


def stem(height, bend):
    return ws.tube([(0, 0, 0), (0.001, height * 0.5, 0), (bend, height, bend * 0.4)], [0.0013, 0.0012, 0.0019], n=8, steps=4)


def lemon():
    profile = [(0, -0.046), (0.0035, -0.0455), (0.0065, -0.0415), (0.012, -0.0355), (0.0225, -0.022), (0.0275, 0.0), (0.0235, 0.021), (0.0135, 0.034), (0.0085, 0.0395), (0.0070, 0.0425), (0.0030, 0.0440), (0, 0.0438)]
    return ws.lathe([profile], n=28, steps=3)


def pear():
    profile = [(0, 0.004), (0.008, 0.001), (0.018, 0.002), (0.032, 0.014), (0.0385, 0.034), (0.034, 0.056), (0.0235, 0.076), (0.0175, 0.092), (0.0140, 0.103), (0.008, 0.1085), (0.003, 0.1075), (0, 0.1065)]

    def lean(P, angle):
        P = P.copy()
        P[:, 0] += 0.10 * P[:, 1] ** 2 / 0.1
        return P * np.stack([1 + 0.03 * np.cos(2 * angle), 1 + 0 * angle, 1 + 0.03 * np.sin(3 * angle)], -1)

    return ws.lathe([profile], n=32, steps=2, warp=lean)


def grapes():
    """A bunch lying on the table: berries settle, in order, on the lowest free spot near the bunch's axis."""
    rng, done = np.random.default_rng(8), []
    for k in range(600):
        t = rng.random()
        r = rng.uniform(0.0098, 0.0118)
        x, z = -0.085 + 0.17 * t, rng.normal(0, 0.036 * (1 - 0.75 * t))
        y = r + 0.0005
        for q in done:
            d = np.hypot(x - q[0], z - q[2])
            reach = (r + q[3]) * 0.965
            if d < reach:
                y = max(y, q[1] + np.sqrt(reach**2 - d**2))
        if y < 0.050 - 0.036 * t and all(np.hypot(np.hypot(x - q[0], z - q[2]), y - q[1]) > 0.94 * (r + q[3]) for q in done):
            done.append((x, y, z, r))
        if len(done) == 58:
            break
    berries = [ws.place(ws.ball(2), q[:3], turn=rng.uniform(0, 360), tilt=rng.uniform(-40, 40), scale=q[3] * np.array([1, 1.06, 1])) for q in done]
    return ws.join(berries)


def walnut():
    def f(u, v):
        a, b = u * ws.TAU, (v - 0.5) * np.pi
        d = np.stack([np.cos(b) * np.cos(a), np.sin(b) + 0 * a, np.cos(b) * np.sin(a)], -1)
        wrinkle = 0.035 * np.sin(5 * d[..., 0] + 4 * np.sin(6 * d[..., 1])) * np.sin(9 * d[..., 2] + 3 * np.sin(5 * d[..., 0] + 2))
        seam = 0.09 * np.exp(-((d[..., 2] / 0.10) ** 2))
        r = 1 + wrinkle + seam
        return 0.0175 * d[..., 0] * r * 1.12, 0.0160 * d[..., 1] * r, 0.0160 * d[..., 2] * r

    return ws.grid(f, 36, 24, v=(0.002, 0.998))


def peel(h, w, seed, colours, blush=None, specks=None):
    """Skin of a fruit: u around, v from flower to stem."""
    v, u = np.mgrid[0:h, 0:w][0] / h, np.mgrid[0:h, 0:w][1] / w
    c = ws.ramp(0.5 + 0.14 * ws.noise(h, w, 4, 4, seed) + 0.06 * ws.noise(h, w, 6, 60, seed + 1), colours)
    if blush is not None:
        streak = 0.35 * ws.noise(h, w, 2, 40, seed + 2) + 0.35 * ws.noise(h, w, 3, 3, seed + 3)
        c = ws.mix(c, ws.ramp(0.5 + 0.2 * streak, blush), 0.62 + 0.45 * np.cos(u * ws.TAU) + 0.5 * streak - 1.6 * (v - 0.80).clip(0) / 0.2)
    if specks is not None:
        n = ws.noise(h, w, h / 5, w / 5, seed + 4)
        c = ws.mix(c, np.broadcast_to(np.array(specks) / 255, c.shape), (n - 2.0) * 1.2)
    return c


mesh("apple", apple())
mesh("pear", pear())
mesh("lemon", lemon())
mesh("stems", ws.join([ws.place(stem(0.024, 0.006), (0, 0.060, 0))]), uv=False)
mesh("pear-stem", ws.place(stem(0.026, -0.007), (0.0106, 0.104, 0)), uv=False)
mesh("grapes", grapes(), uv=False)
mesh("grape-stalk", ws.tube([(-0.10, 0.055, 0.005), (-0.075, 0.045, 0), (-0.03, 0.036, 0.004), (0.0, 0.025, 0)], [0.0024, 0.0018, 0.0016, 0.0012], n=8, steps=5), uv=False)
mesh("walnut", walnut(), uv=False)
texture("apple", peel(192, 256, 41, [(168, 142, 52), (196, 172, 74), (214, 192, 100)], [(104, 16, 18), (150, 28, 24), (186, 62, 40)], (214, 190, 120)), 40)
texture("pear", peel(192, 256, 51, [(132, 128, 42), (168, 158, 62), (196, 180, 84)], [(150, 92, 40), (178, 118, 54)], (96, 72, 34)), 40)
texture("lemon", peel(128, 128, 61, [(206, 160, 22), (224, 182, 34), (234, 200, 60)], None, (190, 140, 24)), 40)

# ---------------------------------------------------------------- knife

def blade(u, v):
    """A table knife's blade in the plane y = 0, edge towards +z; u along, v across one turn of its section."""
    a = v * ws.TAU
    width = 0.0115 * np.sqrt(np.clip(1 - np.clip((u - 0.80) / 0.2, 0, 1) ** 2, 1e-4, 1)) * (0.82 + 0.18 * np.sin(u * 2.6))
    return 0.15 * u, 0.0010 * np.sin(a), width * np.cos(a)


mesh("blade", ws.grid(blade, 24, 16, u=(0.0, 0.9995), flip=True), uv=False)
mesh("hilt", ws.join([
    ws.tube([(-0.098, 0.0, 0), (-0.085, 0, 0), (-0.05, 0, 0), (-0.014, 0, 0)], [0.0085, 0.0095, 0.0080, 0.0068], n=20, steps=5),
]), uv=False)
mesh("ferrule", ws.place(ws.lathe([[(0, -0.016), (0.0072, -0.016)], [(0.0072, -0.016), (0.0080, -0.014), (0.0070, -0.008), (0.0062, 0.0)], [(0.0062, 0.0), (0, 0.0)]], n=24, steps=3), roll=-90), uv=False)
