#!/usr/bin/env python3
"""Arrays that zarr-python writes with each of its compressors and layouts, read by `svt build` and held against numpy: every
sample, spacing and place. And those that must be refused.

    zarr_of_others.py SVT FOLDER     exit code 77 where zarr-python is not installed
"""
import json
import os
import subprocess
import sys

try:
    import numcodecs
    import numpy as np
    import zarr
except ImportError as error:
    print(error)
    sys.exit(77)

SVT, FOLDER = (os.path.abspath(argument) for argument in sys.argv[1:3])
SHAPE = (23, 41, 70)


def labels(kind, shape=SHAPE):
    """Boxes of values in which no two axes are alike."""
    z, y, x = np.indices(shape)
    values = (x // 9 + 7 * (y // 11) + 40 * (z // 6)) * (x + y > 20)
    largest = min(2**31 - 1, int(np.iinfo(kind).max)) if kind != "bool" else 1
    if kind == "bool":
        return values % 3 == 1
    return (values * (largest // 300) if largest > 300 else values % (largest + 1)).astype(kind)


def build(path):
    result = subprocess.run([SVT, "build", path, "-o", path + ".svt"], capture_output=True, text=True, timeout=900)
    if result.returncode != 0:
        return None, result.stderr
    subprocess.run([SVT, "convert", path + ".svt", path + ".nrrd", "--encoding", "raw"], check=True)
    head, data = open(path + ".nrrd", "rb").read().split(b"\n\n", 1)
    fields = dict(line.split(": ", 1) for line in head.decode().split("\n")[1:] if ": " in line and ":=" not in line)
    sizes = [int(n) for n in fields["sizes"].split()]
    return (np.frombuffer(data, fields["type"]).reshape(sizes[::-1]), fields), ""


def expect(path, values):
    found, said = build(path)
    assert found is not None, (path, said)
    # Each value becomes a scalar of its own, and 0 stays.
    assert found[0].shape == values.shape, path
    pairs = np.unique(np.stack([values.ravel(), found[0].ravel().astype("i8")]), axis=1)
    assert len(np.unique(pairs[0])) == len(np.unique(pairs[1])) == pairs.shape[1], path
    assert ((values == 0) == (found[0] == 0)).all(), path
    return found[1]


def refuse(path, word):
    found, said = build(path)
    assert found is None and word in said and "error E" in said, (path, said)


def main():
    blosc = numcodecs.Blosc
    compressors = {
        "none": None,
        "zlib": numcodecs.Zlib(),
        "gzip": numcodecs.GZip(),
        "zstd": numcodecs.Zstd(),
        "lz4": numcodecs.LZ4(),
        **{
            f"{inner}{shuffle}": blosc(inner, shuffle=shuffle)
            for inner in ("lz4", "lz4hc", "zlib", "zstd")
            for shuffle in (blosc.NOSHUFFLE, blosc.SHUFFLE, blosc.BITSHUFFLE)
        },
        "blocks": blosc("lz4", shuffle=blosc.SHUFFLE, blocksize=4096),
        "incompressible": blosc("lz4", clevel=0),
    }
    for name, compressor in compressors.items():
        for kind in (
            ("u1", "<u2", "<i4")
            if name != "none"
            else ("u1", "i1", "<u2", ">u2", ">i2", "<i4", ">u4", "<i8", ">u8", "bool")
        ):
            path = os.path.join(FOLDER, f"{name}-{kind.strip('<>')}-{kind[0] == '>'}.zarr")
            values = labels(kind)
            zarr.save_array(path, values, chunks=(7, 16, 33), compressor=compressor)
            expect(path, values.astype("i8"))

    # Fortran's order, names with '/', chunks that are missing, a fill value that is none of the background.
    for n, options in enumerate(
        ({"order": "F"}, {"dimension_separator": "/"}, {"order": "F", "dimension_separator": "/"})
    ):
        path, values = os.path.join(FOLDER, f"layout{n}.zarr"), labels("<u2")
        array = zarr.open_array(path, mode="w", shape=SHAPE, chunks=(10, 20, 30), dtype="<u2", fill_value=9, **options)
        values[10:20] = 9
        array[:10], array[20:] = values[:10], values[20:]
        expect(path, values.astype("i8"))

    # An image of OME-NGFF 0.4 with five axes, millimetres, a second level, and labels.
    path = os.path.join(FOLDER, "ome.zarr")
    group = zarr.open_group(path, mode="w")
    values = labels("<u4")
    group.create_dataset("fine/0", data=values[None, None], chunks=(1, 1, 8, 16, 16), dimension_separator="/")
    axes = [{"name": "t", "type": "time"}, {"name": "c", "type": "channel"}]
    axes += [{"name": a, "type": "space", "unit": "millimeter"} for a in "zyx"]
    steps = [
        {"type": "scale", "scale": [1, 1, 30, 20, 10]},
        {"type": "translation", "translation": [0, 0, 3000, 2000, 1000]},
    ]
    group.attrs["multiscales"] = [
        {
            "version": "0.4",
            "axes": axes,
            "coordinateTransformations": [{"type": "scale", "scale": [1, 1, 2, 2, 2]}],
            "datasets": [{"path": "fine/0", "coordinateTransformations": steps}],
        }
    ]
    value = int(values.max())
    group.attrs["image-label"] = {
        "colors": [{"label-value": value, "rgba": [255, 128, 0, 255]}],
        "properties": [{"label-value": value, "class": "Wall", "name": "K\u00fcche"}],
    }
    fields = expect(path, values.astype("i8"))
    assert (
        fields["space origin"] == "(2,4,6)" and fields["space directions"] == "(0.02,0,0) (0,0.04,0) (0,0,0.06)"
    ), fields
    table = open(path + ".nrrd", "rb").read().split(b"\n\n", 1)[0].decode()
    assert '"class":"Wall","name":"K\\\\u00fcche"' in table, table[:3000]

    # What cannot be read, or leads out of the folder.
    for name, options, word in (
        ("bz2", {"compressor": numcodecs.BZ2()}, "bz2"),
        ("blosclz", {"compressor": blosc("blosclz")}, "BloscLZ"),
        ("filters", {"filters": [numcodecs.Delta("<u2")]}, "filters"),
        ("float", {"dtype": "<f4"}, "cannot be labels"),
        ("flat", {"shape": (40, 70), "chunks": (20, 20)}, "three sizes"),
    ):
        path = os.path.join(FOLDER, name + ".zarr")
        usual = {"shape": SHAPE, "chunks": (8, 16, 16), "dtype": "<u2"}
        array = zarr.open_array(path, mode="w", **{**usual, **options})
        array[:] = 3
        refuse(path, word)
    text = open(os.path.join(FOLDER, "ome.zarr/.zattrs")).read()
    for n, name in enumerate(("../none-u1-False.zarr", "/etc", "fine/../../layout0.zarr", ".", "")):
        path = os.path.join(FOLDER, f"path{n}.zarr")
        zarr.open_group(path, mode="w")
        open(os.path.join(path, ".zattrs"), "w").write(text.replace('"fine/0"', json.dumps(name)))
        refuse(path, "not a folder in this one")
    path = os.path.join(FOLDER, "link.zarr")
    zarr.open_group(path, mode="w")
    open(os.path.join(path, ".zattrs"), "w").write(text)
    os.symlink(os.path.join(FOLDER, "ome.zarr/fine"), os.path.join(path, "fine"))
    refuse(path, "leads out of the folder")
    zarr.save_array(os.path.join(FOLDER, "store.zarr.zip"), labels("u1"))
    refuse(os.path.join(FOLDER, "store.zarr.zip"), "unpack it")
    print("same", len(compressors), "compressors")


main()
