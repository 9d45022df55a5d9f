"""Functions of all examples: the model, its volume, the folder of the results."""
import argparse
import os
import tempfile

import svt


def arguments(what, spacing):
    """The volume and the output folder of the command line: [MODEL] [-o FOLDER] [--spacing M]."""
    parser = argparse.ArgumentParser(description=what)
    parser.add_argument("model", nargs="?", help="a model or a .svt; the generated house where none is given")
    parser.add_argument("-o", "--output", default=".", help="folder for tables and pictures")
    parser.add_argument(
        "--spacing", type=float, default=spacing, help=f"metres between samples, {spacing} if not given"
    )
    given = parser.parse_args()
    os.makedirs(given.output, exist_ok=True)
    return volume_of(given.model, given.spacing), given.output


def volume_of(model, spacing):
    if model and model.endswith(".svt"):
        return svt.open(model)
    with tempfile.TemporaryDirectory() as folder:
        if not model:
            model = os.path.join(folder, "house.gml")
            svt.sample("house", model)
        return svt.build(model, spacing=spacing)
