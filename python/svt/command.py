"""The command `svt`: where it is, and `python -m svt`."""
from __future__ import annotations

import importlib.metadata
import os
import shutil
import sys

from .errors import Error, Place

#: Name of the package in indexes.
DISTRIBUTION = "semantic-volume-texture"


def _installed_command() -> str | None:
    """The command that the wheel of this package has installed."""
    try:
        files = importlib.metadata.files(DISTRIBUTION) or []
    except importlib.metadata.PackageNotFoundError:
        return None
    places = [str(file.locate()) for file in files if file.name == "svt" and file.parent.name == "bin"]
    # `pip install --target` lists another place than this one, beside the package.
    places.append(os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "bin", "svt"))
    return next((os.path.normpath(place) for place in places if os.path.isfile(place)), None)


def find_command() -> str:
    """The path of the `svt` command: $SVT_COMMAND, that of the wheel of this package, or the first one in PATH.

    Raises svt.Error E101 if there is none.
    """
    command = os.environ.get("SVT_COMMAND") or _installed_command() or shutil.which("svt")
    if not command:
        raise Error(
            "E101",
            "CannotOpen",
            "the command svt is missing; install the package svt, add its folder to PATH, or set SVT_COMMAND",
            Place(),
        )
    return command


def main() -> None:
    """Replaces this process by the command, with the same arguments. If it cannot be started: exit code 127, as of
    shells."""
    try:
        command = find_command()
        os.execv(command, [command, *sys.argv[1:]])
    except Error as error:
        print(f"svt: error {error}", file=sys.stderr)
    except OSError as error:
        print(f"svt: error E101 CannotOpen: {command}: {error.strerror}; set SVT_COMMAND", file=sys.stderr)
    raise SystemExit(127)
