"""Renders passes of one scene with Mitsuba 3 for `limpid crosscheck`.

    python render.py JOB        JOB: {"scene", "variant", "camera", "size": [w, h] | null, "defines": [[name, value]], "threads"}

The scene is the user's own file. Only what the comparison needs is changed in it: the box filter and the
independent sampler make pixels independent, and the film has the size that was asked for.

Says one JSON object a line on standard output: first {"size", "version", "notes"}, or {"refused"} where it cannot load
the scene; then {} for every line {"seed", "spp", "path"} read from standard input, once the pass lies at `path` as raw
32-bit floats [h, w, 3], or {"failed"}, which ends it.
"""

import json
import os
import sys

# Mitsuba logs to standard output, which is for answers only.
answers = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)


def answer(**what):
    answers.write(json.dumps(what) + "\n")
    answers.flush()


def main(job):
    import mitsuba as mi

    mi.set_variant(job["variant"])
    mi.set_log_level(mi.LogLevel.Error)
    if job["threads"]:
        import drjit as dr

        dr.set_thread_count(job["threads"])

    notes = []
    try:
        scene = load(mi, job, notes)
    except Exception as error:  # whatever it is, the caller says it better than a traceback
        answer(refused=f"{error}" or type(error).__name__)
        sys.exit(1)
    width, height = (int(v) for v in scene.sensors()[0].film().crop_size())
    answer(size=[width, height], version=mi.__version__, notes=notes)
    # Without just-in-time compilation the pixels of a pass draw from the streams seed * pixels + i, where i counts the
    # pixels of whole blocks of 32x32: neighbouring seeds would share streams.
    stride = -(-(-(-width // 32) * -(-height // 32) * 1024) // (width * height))

    import numpy as np

    for line in sys.stdin:
        order = json.loads(line)
        image = mi.render(scene, sensor=0, seed=order["seed"] * stride % 2**32, spp=order["spp"])
        np.asarray(image, dtype="<f4")[..., :3].tofile(order["path"])
        answer()


def load(mi, job, notes):
    """The scene with box filter, independent sampler and the size of the job."""
    path = os.path.abspath(job["scene"])
    mi.file_resolver().prepend(os.path.dirname(path))
    config = mi.parser.ParserConfig(job["variant"])
    # What Mitsuba doesn't know is limpid's to warn about, too.
    config.unused_properties = mi.LogLevel.Debug
    config.unused_parameters = mi.LogLevel.Debug
    # Mitsuba 3.9.1 refuses some scenes of which it could merge two meshes ("incompatible"); it changes no picture.
    config.merge_meshes = False
    state = mi.parser.parse_file(config, path, **dict(job["defines"]))
    # Names of version 3 and plain references, so that the edits below meet one form only.
    mi.parser.transform_upgrade(config, state)
    mi.parser.transform_resolve(config, state)

    if state.root.type != mi.ObjectType.Scene:
        raise ValueError("the file is no scene")
    tree = Tree(mi, state)
    types = mi.ObjectType
    sensors = [(name, child) for name, child in tree.nested(0) if state.nodes[child].type == types.Sensor]
    if len(sensors) <= job["camera"]:
        raise ValueError(f"the scene has {len(sensors)} sensors there" if sensors else "the scene has no sensor")
    _, sensor = sensors.pop(job["camera"])
    for name, _ in sensors:  # so that no doubt is left which one it renders
        del tree.props(0)[name]
    tree.reduce(tree.ensure(sensor, types.Sampler, "sampler"), "independent", ["sample_count"])
    film = tree.ensure(sensor, types.Film, "film")
    tree.reduce(tree.ensure(film, types.ReconstructionFilter, "rfilter"), "box", [])
    keep = [name for name, _ in tree.nested(film)] + ["width", "height"]
    if not job["size"]:
        keep += ["crop_offset_x", "crop_offset_y", "crop_width", "crop_height"]
    tree.reduce(film, "hdrfilm", keep)
    changes = {"pixel_format": "rgb", "component_format": "float32"}
    if job["size"]:
        changes["width"], changes["height"] = job["size"]
    for name, value in changes.items():
        tree.props(film)[name] = value

    integrate(mi, tree, notes)
    mi.parser.transform_all(config, state)
    return mi.parser.instantiate(config, state)


class Tree:
    """The parsed scene, its objects by number: adding one moves the others in memory, so that nothing else may be kept
    of them. The scene itself is number 0."""

    def __init__(self, mi, state):
        self.mi, self.state = mi, state

    def props(self, i):
        return self.state.nodes[i].props

    def nested(self, i):
        """(name, number) of the objects inside one."""
        reference = self.mi.Properties.ResolvedReference
        return [(name, value.index()) for name, value in self.props(i).items() if isinstance(value, reference)]

    def child(self, i, kind):
        """The first object of a kind inside one, or None."""
        return next((child for _, child in self.nested(i) if self.state.nodes[child].type == kind), None)

    def ensure(self, i, kind, name):
        """That object, added where there is none."""
        found = self.child(i, kind)
        if found is None:
            node = self.mi.parser.SceneNode()
            node.type = kind
            self.state.nodes.append(node)
            found = len(self.state.nodes) - 1
            self.put(i, name, found)
        return found

    def put(self, i, name, child):
        self.props(i)[name] = self.mi.Properties.ResolvedReference(child)

    def reduce(self, i, plugin, keep):
        """Another plugin, with those of its properties that are named."""
        props = self.props(i)
        for name in list(props.keys()):
            if name not in keep:
                del props[name]
        props.set_plugin_name(plugin)


def integrate(mi, tree, notes):
    """Leaves the scene's integrator where it traces paths, takes what is nested in one that writes layers, and puts
    `path` in the place of any other, as limpid does."""
    kind = mi.ObjectType.Integrator
    made = tree.child(0, kind) is None
    node = tree.ensure(0, kind, "integrator")
    name = next(name for name, child in tree.nested(0) if child == node)
    while (plugin := tree.props(node).plugin_name()) in ("aov", "moment"):
        inner = tree.child(node, kind)
        if inner is None:
            break
        notes.append(f"of the integrator {plugin} the one inside it is compared")
        tree.put(0, name, inner)
        node = inner
    if plugin not in ("path", "direct", "volpath", "volpathmis"):
        why = "as the file names no integrator" if made else f"in the place of {plugin}"
        notes.append(f"both render the scene with path {why}")
        tree.reduce(node, "path", ["max_depth", "rr_depth", "hide_emitters"])


if __name__ == "__main__":
    try:
        main(json.loads(sys.argv[1]))
    except Exception as error:
        answer(failed=f"{error}" or type(error).__name__)
        sys.exit(1)
