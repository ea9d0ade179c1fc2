"""Renders passes of one scene with Mitsuba 3 for `limpid crosscheck`.

    python render.py JOB        JOB: {"scene", "variant", "size": [w, h] | null, "defines": [[name, value]], "threads"}

The scene is the user's own file. Only what the comparison needs is changed in it: the box filter and the
independent sampler make pixels independent, and the film has the size that was asked for.

Says one JSON object a line on standard output: first {"size", "version", "notes"}, then {} for every line
{"seed", "spp", "path"} read from standard input, once the pass lies at `path` as raw 32-bit floats [h, w, 3].
An {"error"} in their place ends it.
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
    scene = load(mi, job, notes)
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
    state = mi.parser.parse_file(config, path, **dict(job["defines"]))
    # Names of version 3 and plain references, so that the edits below meet one form only.
    mi.parser.transform_upgrade(config, state)
    mi.parser.transform_resolve(config, state)

    nodes, root = state.nodes, state.root
    if root.type != mi.ObjectType.Scene:
        raise ValueError("the file is no scene")

    def child(props, kind):
        """(name, node) of the first nested object of a kind."""
        for name, value in nested(mi, props):
            node = nodes[value.index()]
            if node.type == kind:
                return name, node
        return None, None

    def ensure(props, kind, name, plugin):
        """That object, made where there is none."""
        found = child(props, kind)[1]
        if found is None:
            found = mi.parser.SceneNode()
            found.type = kind
            found.props = mi.Properties(plugin)
            nodes.append(found)
            props[name] = mi.Properties.ResolvedReference(len(nodes) - 1)
            found = nodes[len(nodes) - 1]
        return found.props

    def reduce(props, plugin, keep):
        """Another plugin, with those of its properties that are named."""
        for name in list(props.keys()):
            if name not in keep:
                del props[name]
        props.set_plugin_name(plugin)

    types = mi.ObjectType
    sensor = child(root.props, types.Sensor)[1]
    if sensor is None:
        raise ValueError("the scene has no sensor")
    reduce(ensure(sensor.props, types.Sampler, "sampler", "independent"), "independent", ["sample_count"])
    film = ensure(sensor.props, types.Film, "film", "hdrfilm")
    reduce(ensure(film, types.ReconstructionFilter, "rfilter", "box"), "box", [])
    keep = [name for name, _ in nested(mi, film)] + ["width", "height"]
    if job["size"]:
        film["width"], film["height"] = job["size"]
    else:
        keep += ["crop_offset_x", "crop_offset_y", "crop_width", "crop_height"]
    reduce(film, "hdrfilm", keep)
    film["pixel_format"], film["component_format"] = "rgb", "float32"

    integrate(mi, root.props, child, reduce, notes)
    mi.parser.transform_all(config, state)
    return mi.parser.instantiate(config, state)


def nested(mi, props):
    """(name, reference) of the objects inside one."""
    return [(name, value) for name, value in props.items() if isinstance(value, mi.Properties.ResolvedReference)]


def integrate(mi, root, child, reduce, notes):
    """Leaves the scene's integrator where it traces paths, takes what is nested in one that writes layers, and puts
    `path` in the place of any other, as limpid does."""
    name, node = child(root, mi.ObjectType.Integrator)
    while node is not None and node.props.plugin_name() in ("aov", "moment"):
        outer = node.props.plugin_name()
        inner_name, inner = child(node.props, mi.ObjectType.Integrator)
        if inner is None:
            del root[name]
            return
        notes.append(f"of the integrator {outer} the one inside it is compared")
        root[name] = node.props[inner_name]
        node = inner
    if node is not None and node.props.plugin_name() not in ("path", "direct", "volpath", "volpathmis"):
        notes.append(f"both render the scene with path in the place of {node.props.plugin_name()}")
        reduce(node.props, "path", ["max_depth", "rr_depth", "hide_emitters"])


if __name__ == "__main__":
    try:
        main(json.loads(sys.argv[1]))
    except Exception as error:  # whatever it is, the caller says it better than a traceback
        answer(error=f"{error}" or type(error).__name__)
        sys.exit(1)
