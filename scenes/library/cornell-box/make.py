"""Writes the Cornell box's meshes from its published measurements (millimetres).

    python3 make.py

Source: "The Cornell Box", Cornell University Program of Computer Graphics, the data of January 1998. The room is
not quite a box: its red wall leans outwards, so that floor, back wall and ceiling differ in width.
"""
from pathlib import Path

HERE = Path(__file__).parent

# Corners in the published order, turned so that each face is counter-clockwise from inside the room.
FLOOR = [(552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2)]
BACK = [(549.6, 0, 559.2), (0, 0, 559.2), (0, 548.8, 559.2), (556, 548.8, 559.2)]
RED = [(552.8, 0, 0), (549.6, 0, 559.2), (556, 548.8, 559.2), (556, 548.8, 0)]
GREEN = [(0, 0, 559.2), (0, 0, 0), (0, 548.8, 0), (0, 548.8, 559.2)]
LIGHT = [(343, 548.8, 227), (343, 548.8, 332), (213, 548.8, 332), (213, 548.8, 227)]

# The four upper corners of each block, counter-clockwise from above.
SHORT = [(130, 165, 65), (82, 165, 225), (240, 165, 272), (290, 165, 114)]
TALL = [(423, 330, 247), (265, 330, 296), (314, 330, 456), (472, 330, 406)]


def ceiling():
    """The ceiling with the light's hole, as a 3 x 3 grid without its middle: no T-junctions, nothing coplanar on top."""
    xs, zs = (0, 213, 343, 556), (0, 227, 332, 559.2)
    cells = [(i, k) for i in range(3) for k in range(3) if (i, k) != (1, 1)]
    return [
        [(xs[i + 1], 548.8, zs[k]), (xs[i + 1], 548.8, zs[k + 1]), (xs[i], 548.8, zs[k + 1]), (xs[i], 548.8, zs[k])]
        for i, k in cells
    ]


def block(top):
    """Lid and sides; the bottom would lie in the floor and is left out."""
    down = [(x, 0, z) for x, _, z in top]
    sides = [[top[i], down[i], down[(i + 1) % 4], top[(i + 1) % 4]] for i in range(4)]
    return [top] + sides


def write(name, quads):
    lines = []
    for quad in quads:
        lines += ["v %g %g %g" % p for p in quad]
    for i in range(len(quads)):
        a = 4 * i + 1
        lines += [f"f {a} {a + 1} {a + 2}", f"f {a} {a + 2} {a + 3}"]
    (HERE / name).write_text("\n".join(lines) + "\n")


write("white.obj", [FLOOR, BACK] + ceiling())
write("red.obj", [RED])
write("green.obj", [GREEN])
write("light.obj", [LIGHT])
write("short-block.obj", block(SHORT))
write("tall-block.obj", block(TALL))
