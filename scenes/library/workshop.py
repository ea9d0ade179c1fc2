"""What the `make.py` of each scene is built from: meshes, textures and the files they go to. Needs numpy only.

A mesh is a tuple (P, N, UV, F): positions and unit normals [n, 3], texture coordinates [n, 2], triangles [m, 3].
World space has +y up; lengths are metres. A texture is an array [h, w, 3] of display-encoded (sRGB) values in [0, 1].
"""
import struct
import zlib

import numpy as np

TAU = 2 * np.pi


# ---------------------------------------------------------------- meshes

def finish(P, N, UV, F):
    """Normalises the normals, drops triangles without area and turns the others to the side of their normals."""
    P, N, UV, F = (np.asarray(a, float) for a in (P, N, UV, F))
    F = F.astype(int).reshape(-1, 3)
    N = N / np.maximum(np.linalg.norm(N, axis=1, keepdims=True), 1e-30)
    g = np.cross(P[F[:, 1]] - P[F[:, 0]], P[F[:, 2]] - P[F[:, 0]])
    area = np.linalg.norm(g, axis=1)
    keep = area > 1e-9 * area.max()
    F, g = F[keep], g[keep]
    wrong = (g * N[F].sum(1)).sum(1) < 0
    F[wrong] = F[wrong][:, ::-1]
    return P, N, UV, F


def grid(f, nu, nv, u=(0, 1), v=(0, 1), flip=False, normals=True):
    """The surface f(u, v) -> (x, y, z) over nu x nv cells, with normals dP/dv x dP/du (so y up for x = u, z = v)."""
    uu, vv = np.meshgrid(np.linspace(*u, nu + 1), np.linspace(*v, nv + 1))
    uu, vv = uu.ravel(), vv.ravel()
    at = lambda a, b: np.stack(np.broadcast_arrays(*f(a, b)), -1).astype(float)
    e, d = 1e-4 * (u[1] - u[0]), 1e-4 * (v[1] - v[0])
    N = np.cross(at(uu, vv + d) - at(uu, vv - d), at(uu + e, vv) - at(uu - e, vv)) * (-1 if flip else 1)
    i = (np.arange(nv)[:, None] * (nu + 1) + np.arange(nu)).ravel()
    F = np.concatenate([np.stack([i, i + 1, i + nu + 2], -1), np.stack([i, i + nu + 2, i + nu + 1], -1)])
    return finish(at(uu, vv), N, np.stack([uu, vv], -1), F)


def quad(a, b, c, d):
    """Counter-clockwise from the visible side."""
    P = np.array([a, b, c, d], float)
    N = np.tile(np.cross(P[1] - P[0], P[3] - P[0]), (4, 1))
    return finish(P, N, [(0, 1), (1, 1), (1, 0), (0, 0)], [(0, 1, 2), (0, 2, 3)])  # v = 0 is a picture's top


def spline(points, steps):
    """Catmull-Rom through the points, `steps` pieces between two of them."""
    p = np.asarray(points, float)
    if len(p) < 3 or steps == 1:
        return p
    q = np.concatenate([[2 * p[0] - p[1]], p, [2 * p[-1] - p[-2]]])
    t = np.linspace(0, 1, steps, endpoint=False)[:, None]
    out = []
    for a, b, c, d in zip(q, q[1:], q[2:], q[3:]):
        out.append(0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2 + (3 * b - a - 3 * c + d) * t**3))
    return np.concatenate(out + [p[-1:]])


def lathe(parts, n=64, steps=6, warp=None):
    """Turns a profile around the y axis.

    `parts` are lists of (radius, y), each smooth in itself, with an edge between one and the next; they run from the
    bottom's centre up the outside and, for a vessel, down the inside, so that normals point out of the material.
    `warp(P, angle)` may move the points afterwards; normals are then taken from the triangles.
    """
    meshes, total = [], sum(len(p) for p in parts)
    done = 0
    for part in parts:
        c = spline(part, steps)
        c[:, 0] = np.maximum(c[:, 0], 0)
        tangent = np.gradient(c, axis=0)
        a = np.linspace(0, TAU, n + 1)
        P = np.stack([c[:, :1] * np.cos(a), c[:, 1:] + 0 * a, c[:, :1] * np.sin(a)], -1).reshape(-1, 3)
        N = np.stack([tangent[:, 1:] * np.cos(a), -tangent[:, :1] + 0 * a, tangent[:, 1:] * np.sin(a)], -1).reshape(-1, 3)
        v = (done + np.linspace(0, len(part), len(c))) / total
        done += len(part)
        UV = np.stack(np.broadcast_arrays(a / TAU, v[:, None]), -1).reshape(-1, 2)
        i = (np.arange(len(c) - 1)[:, None] * (n + 1) + np.arange(n)).ravel()
        F = np.concatenate([np.stack([i, i + 1, i + n + 2], -1), np.stack([i, i + n + 2, i + n + 1], -1)])
        mesh = finish(P, N, UV, F)
        if warp is not None:
            mesh = smooth((warp(mesh[0], np.arctan2(mesh[0][:, 2], mesh[0][:, 0])),) + mesh[1:])
        meshes.append(mesh)
    return join(meshes)


def smooth(mesh):
    """Normals anew from the triangles, shared by all vertices of the same place."""
    P, N, UV, F = mesh
    g = np.cross(P[F[:, 1]] - P[F[:, 0]], P[F[:, 2]] - P[F[:, 0]])
    size = np.ptp(P, axis=0).max()
    _, place_of = np.unique(np.round(P / size, 6), axis=0, return_inverse=True)
    place_of = place_of.ravel()
    total = np.zeros((place_of.max() + 1, 3))
    for k in range(3):
        np.add.at(total, place_of[F[:, k]], g)
    return finish(P, total[place_of], UV, F)


def tube(path, radius, n=12, steps=8, ends=True):
    """A round rod along a spline; `radius` is a number or one for each given point."""
    r = np.broadcast_to(np.asarray(radius, float), (len(path),))
    c = spline(np.concatenate([np.asarray(path, float), r[:, None]], 1), steps)
    c, r = c[:, :3], c[:, 3]
    if ends:  # a round cap: the radius falls along a quarter circle
        q = np.array([0, 0.3, 0.65, 0.9])
        t0, t1 = (c[0] - c[1]), (c[-1] - c[-2])
        t0, t1 = t0 / np.linalg.norm(t0), t1 / np.linalg.norm(t1)
        h = np.sqrt(1 - q**2)
        c = np.concatenate([c[0] + t0 * (r[0] * h)[:, None], c, (c[-1] + t1 * (r[-1] * h)[:, None])[::-1]])
        r = np.concatenate([r[0] * q, r, (r[-1] * q)[::-1]])
    t = np.gradient(c, axis=0)
    t /= np.linalg.norm(t, axis=1, keepdims=True)
    x = np.cross(t[0], [0.31, 0.87, 0.38])
    frames = []
    for d in t:  # parallel transport: the frame does not spin around the path
        x = x - d * (x @ d)
        x /= np.linalg.norm(x)
        frames.append((x, np.cross(d, x)))
    X, Y = (np.array([f[k] for f in frames])[:, None] for k in (0, 1))
    a = np.linspace(0, TAU, n + 1)[None, :, None]
    N = (X * np.cos(a) + Y * np.sin(a)).reshape(-1, 3)
    P = (c[:, None] + r[:, None, None] * N.reshape(len(c), n + 1, 3)).reshape(-1, 3)
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(c, axis=0), axis=1))])
    UV = np.stack(np.broadcast_arrays(np.linspace(0, 1, n + 1), length[:, None]), -1).reshape(-1, 2)
    i = (np.arange(len(c) - 1)[:, None] * (n + 1) + np.arange(n)).ravel()
    F = np.concatenate([np.stack([i, i + 1, i + n + 2], -1), np.stack([i, i + n + 2, i + n + 1], -1)])
    return finish(P, N, UV, F)


def box(size, bevel, steps=2, uv_shift=(0, 0)):
    """A box around the origin with round edges. Texture coordinates are metres, u along the longest side of each face."""
    h = np.asarray(size, float) / 2
    angle = np.concatenate([np.linspace(-np.pi / 4, 0, steps + 1), np.linspace(0, np.pi / 4, steps + 1)])
    m = len(angle)
    side = np.repeat([-1, 1], steps + 1)
    meshes = []
    for axis in range(3):
        for sign in (-1, 1):
            a, b = [k for k in range(3) if k != axis]
            ia, ib = (k.ravel() for k in np.meshgrid(np.arange(m), np.arange(m)))
            N = np.zeros((m * m, 3))
            N[:, axis], N[:, a], N[:, b] = sign, np.tan(angle[ia]), np.tan(angle[ib])
            N /= np.linalg.norm(N, axis=1, keepdims=True)
            centre = np.zeros((m * m, 3))
            centre[:, axis], centre[:, a], centre[:, b] = sign * (h[axis] - bevel), side[ia] * (h[a] - bevel), side[ib] * (h[b] - bevel)
            P = centre + bevel * N
            if h[a] < h[b]:
                a, b = b, a
            UV = P[:, [a, b]] + [h[a] + uv_shift[0], h[b] + uv_shift[1] + axis * 0.37]
            i = (np.arange(m - 1)[:, None] * m + np.arange(m - 1)).ravel()
            F = np.concatenate([np.stack([i, i + 1, i + m + 1], -1), np.stack([i, i + m + 1, i + m], -1)])
            meshes.append(finish(P, N, UV, F))
    return join(meshes)


def ball(level=2):
    """A unit sphere from a subdivided octahedron (8 * 4^level triangles)."""
    P = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1]], float)
    F = np.array([[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]])
    for _ in range(level):
        edges = np.sort(F[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        pairs, which = np.unique(edges, axis=0, return_inverse=True)
        which = which.reshape(-1, 3) + len(P)
        P = np.concatenate([P, P[pairs].sum(1)])
        P /= np.linalg.norm(P, axis=1, keepdims=True)
        a, b, c = which.T
        F = np.concatenate([np.stack(t, -1) for t in ((F[:, 0], a, c), (a, F[:, 1], b), (c, b, F[:, 2]), (a, b, c))])
    UV = np.stack([np.arctan2(P[:, 2], P[:, 0]) / TAU + 0.5, np.arccos(np.clip(P[:, 1], -1, 1)) / np.pi], -1)
    return finish(P, P.copy(), UV, F)


def leaf(length, width, rise, droop, fold, cells=8):
    """A pointed leaf from the origin along +x: raised by `rise` radians, drooping, folded along its middle."""
    def f(u, v):  # u along the leaf, v across
        s, x = u * length, width * np.sin(np.pi * np.clip(u, 0, 1) ** 0.75) ** 0.8 * (v - 0.5)
        return s * np.cos(rise) * (1 - 0.15 * u), s * np.sin(rise) - droop * s**2 + fold * abs(v - 0.5) * width * 2, x
    return grid(f, cells, 2, u=(0.0, 0.995), flip=True)


def place(mesh, at=(0, 0, 0), turn=0, tilt=0, roll=0, scale=1):
    """Scales, rolls around z, tilts around x, turns around y (degrees), then moves."""
    P, N, UV, F = mesh
    r, t, y = np.radians([roll, tilt, turn])
    Rz = np.array([[np.cos(r), -np.sin(r), 0], [np.sin(r), np.cos(r), 0], [0, 0, 1]])
    Rx = np.array([[1, 0, 0], [0, np.cos(t), -np.sin(t)], [0, np.sin(t), np.cos(t)]])
    Ry = np.array([[np.cos(y), 0, np.sin(y)], [0, 1, 0], [-np.sin(y), 0, np.cos(y)]])
    R, s = Ry @ Rx @ Rz, np.broadcast_to(np.asarray(scale, float), (3,))
    return finish((P * s) @ R.T + np.asarray(at, float), (N / s) @ R.T, UV, F)


def retexture(mesh, f):
    """New texture coordinates f(u, v) -> (u, v)."""
    P, N, UV, F = mesh
    return P, N, np.stack(np.broadcast_arrays(*f(UV[:, 0], UV[:, 1])), -1), F


def join(meshes):
    """One mesh of many."""
    start = np.cumsum([0] + [len(m[0]) for m in meshes])
    return tuple(np.concatenate([m[k] for m in meshes]) for k in range(3)) + (
        np.concatenate([m[3] + s for m, s in zip(meshes, start)]),
    )


def save_ply(path, mesh, uv=True):
    """Binary little-endian PLY with normals and, unless `uv` is false, texture coordinates."""
    P, N, UV, F = mesh
    data = np.concatenate([P, N, UV] if uv else [P, N], 1).astype("<f4")
    names = ["x", "y", "z", "nx", "ny", "nz"] + (["u", "v"] if uv else [])
    faces = np.zeros(len(F), [("n", "u1"), ("i", "<i4", 3)])
    faces["n"], faces["i"] = 3, F
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {len(P)}"]
    head += [f"property float {n}" for n in names]
    head += [f"element face {len(F)}", "property list uchar int vertex_indices", "end_header"]
    with open(path, "wb") as f:
        f.write(("\n".join(head) + "\n").encode() + data.tobytes() + faces.tobytes())
    print(f"{path}: {len(F)} triangles, {path.stat().st_size // 1024} KiB")


# ---------------------------------------------------------------- textures

def noise(h, w, fy, fx, seed, slope=1.0):
    """Periodic Gaussian noise of mean 0 and deviation 1: power flat up to fy, fx cycles a picture, then falling."""
    rng = np.random.default_rng(seed)
    ky, kx = np.fft.fftfreq(h, 1 / h)[:, None] / fy, np.fft.fftfreq(w, 1 / w)[None] / fx
    gain = (1 + ky**2 + kx**2) ** (-slope)
    gain[0, 0] = 0
    n = np.fft.ifft2(np.fft.fft2(rng.standard_normal((h, w))) * gain).real
    return n / n.std()


def ramp(t, colours):
    """Colours (display-encoded, 0 to 255) evenly spaced over t in [0, 1], linearly between."""
    c = np.asarray(colours, float) / 255
    x = np.clip(t, 0, 1) * (len(c) - 1)
    return np.stack([np.interp(x, np.arange(len(c)), c[:, k]) for k in range(3)], -1)


def mix(a, b, t):
    """a where t = 0, b where t = 1; t is [h, w]."""
    return a + (b - a) * np.clip(t, 0, 1)[..., None]


def wood(h, w, seed, colours, rings=7.0, levels=40):
    """Grain along the width: distorted growth rings, fibres, pores."""
    y = np.arange(h)[:, None] / h
    warp = noise(h, w, 2, 0.7, seed, 2.0)
    t = (rings * y + 0.55 * warp + 0.05 * noise(h, w, 8, 2, seed + 1)) % 1.0  # `rings` whole: it tiles
    ring = np.where(t < 0.8, t / 0.8, (1 - t) / 0.2)
    fibre = noise(h, w, h / 6, 3, seed + 2)
    pores = np.clip(noise(h, w, h / 3, 10, seed + 3) - 1.5, 0, 1)
    return ramp(np.round((0.42 + 0.30 * (ring - 0.5) + 0.10 * fibre + 0.06 * warp - 0.3 * pores) * levels) / levels, colours)


def save_png(path, rgb, levels=64):
    """8-bit RGB PNG. Values are rounded to `levels` steps: half the file, and no eye sees it under grain."""
    a = np.clip(rgb, 0, 1)
    a = np.round(np.round(a * (levels - 1)) / (levels - 1) * 255).astype(np.uint8)
    h, w, _ = a.shape
    x = a.reshape(h, w * 3).astype(int)
    left = np.pad(x, ((0, 0), (3, 0)))[:, :-3]
    up = np.pad(x, ((1, 0), (0, 0)))[:-1]
    best = None
    for kind, base in ((0, 0), (1, left), (2, up), (3, (left + up) // 2)):
        rows = np.concatenate([np.full((h, 1), kind), (x - base) & 255], 1).astype(np.uint8)
        z = zlib.compress(rows.tobytes(), 9)
        best = z if best is None or len(z) < len(best) else best

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", w, h, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", best) + chunk(b"IEND", b""))
    linear = np.where(a / 255 <= 0.04045, a / 255 / 12.92, ((a / 255 + 0.055) / 1.055) ** 2.4)
    print(f"{path}: {w}x{h}, mean albedo {linear.mean():.2f}, max {linear.max():.2f}, {path.stat().st_size // 1024} KiB")


# ---------------------------------------------------------------- skies

def save_hdr(path, rgb):
    """Linear [h, w, 3] as Radiance RGBE, run-length coded."""
    h, w, _ = rgb.shape
    top = rgb.max(-1)
    mantissa, exponent = np.frexp(np.maximum(top, 1e-30))
    scale = np.where(top > 1e-30, mantissa * 256 / np.maximum(top, 1e-30), 0)
    rgbe = np.concatenate([np.clip(rgb * scale[..., None], 0, 255), np.where(top > 1e-30, exponent + 128, 0)[..., None]], -1)
    rgbe = rgbe.astype(np.uint8)
    out = [f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {h} +X {w}\n".encode()]
    for row in rgbe:
        out.append(bytes([2, 2, w >> 8, w & 255]))
        for k in range(4):
            out.append(runs(row[:, k].tobytes()))
    path.write_bytes(b"".join(out))
    print(f"{path}: {w}x{h}, max {rgb.max():.0f}, {path.stat().st_size // 1024} KiB")


def runs(row):
    """One channel of a scanline: runs of 4 or more as (128 + length, value), the rest as (length, values)."""
    out, i, literal = bytearray(), 0, bytearray()

    def flush():
        for k in range(0, len(literal), 128):
            piece = literal[k : k + 128]
            out.extend([len(piece)]), out.extend(piece)
        literal.clear()

    while i < len(row):
        j = i
        while j < len(row) and row[j] == row[i] and j - i < 127:
            j += 1
        if j - i >= 4:
            flush()
            out.extend([128 + j - i, row[i]])
            i = j
        else:
            literal.append(row[i])
            i += 1
    flush()
    return bytes(out)


def sky(h, w, sun, sun_radiance, sun_deg, zenith, horizon, glow, ground):
    """A clear sky in lat-long form, centre column along +z, with a soft sun.

    `sun` is a direction; the sun is a Gaussian of deviation `sun_deg` whose peak is `sun_radiance`. Zenith, horizon,
    glow (around the sun) and ground are linear colours; the glow falls like the forward peak of a Perez sky.
    """
    theta = (np.arange(h) + 0.5)[:, None] / h * np.pi
    phi = ((np.arange(w) + 0.5)[None] / w - 0.5) * TAU
    # The centre column looks along +z; columns to its right turn towards -x, so that the picture is not mirrored.
    d = np.stack(np.broadcast_arrays(-np.sin(theta) * np.sin(phi), np.cos(theta), np.sin(theta) * np.cos(phi)), -1)
    s = np.asarray(sun, float) / np.linalg.norm(sun)
    cos = np.clip(d @ s, -1, 1)
    angle = np.degrees(np.arccos(cos))
    up = np.clip(d[..., 1:2], 0, 1)
    c = np.asarray(horizon) * (1 - up) ** 3 + np.asarray(zenith) * (1 - (1 - up) ** 3)
    c = c + np.asarray(glow) * (np.exp(-angle / 14) + 0.25 * np.exp(-angle / 45))[..., None]
    below = 1 / (1 + np.exp(d[..., 1:2] / 0.012))
    c = c * (1 - below) + np.asarray(ground) * (0.8 + 0.2 * (1 + d[..., 1:2])) * below
    return c + np.asarray(sun_radiance) * np.exp(-0.5 * (angle / sun_deg) ** 2)[..., None]
