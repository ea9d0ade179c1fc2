"""Sum a folder of per-sample records to the picture they belong to.

    python3 records.py FOLDER OUT.npy        needs only numpy

Each file is one tile in safetensors form: the header's length (64 bits, little endian), a JSON header,
raw data. Tensors are f32 of shape [sample, channel, y, x]. Here the radiance of all samples is added up
in double precision; the result is [height, width, 3], linear Rec. 709.
"""

import json
import pathlib
import sys

import numpy as np


def read_tile(path):
    """The tensors of one file by name, and its description (x, y, width, height, spp, film size, units)."""
    data = path.read_bytes()
    start = 8 + int.from_bytes(data[:8], "little")
    header = json.loads(data[8:start])
    description = json.loads(header.pop("__metadata__")["limpid"])
    tensors = {}
    for name, tensor in header.items():
        begin, end = tensor["data_offsets"]
        tensors[name] = np.frombuffer(data[start + begin : start + end], "<f4").reshape(tensor["shape"])
    return tensors, description


def main(folder, out):
    picture = None
    for path in sorted(pathlib.Path(folder).glob("tile_*.safetensors")):
        tensors, tile = read_tile(path)
        if picture is None:
            picture = np.zeros((tile["film_height"], tile["film_width"], 3), np.float32)
        parts = ("radiance.diffuse", "radiance.specular", "radiance.emission")
        samples = sum(tensors[name].astype(np.float64) for name in parts)
        mean = samples.sum(axis=0) / tile["spp"]  # [channel, y, x]
        rows = slice(tile["y"], tile["y"] + tile["height"])
        columns = slice(tile["x"], tile["x"] + tile["width"])
        picture[rows, columns] = mean.transpose(1, 2, 0)
    if picture is None:
        sys.exit(f"{folder}: no tile_*.safetensors in it")
    np.save(out, picture)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2])
