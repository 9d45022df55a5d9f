"""The command `svt`: where it is, and `python -m svt`."""
from __future__ import annotations

import importlib.metadata
import os
import re
import shutil
import subprocess
import sys
from typing import Any, Mapping, Sequence

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


def arguments_of(options: Mapping[str, Any], own: set[str], caller: str) -> list[str]:
    """Keywords as options of the command: spacing=0.2 is --spacing=0.2. `own` are those that the caller sets."""
    arguments = []
    for name, value in options.items():
        if name in own:
            raise TypeError(f"{caller} has no keyword '{name}'")
        option = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            arguments.append(option)
        elif isinstance(value, (str, os.PathLike, int, float)):
            arguments.append(f"{option}={os.fspath(value) if isinstance(value, os.PathLike) else value}")
        else:
            arguments.append(f"{option}={','.join(str(part) for part in value)}")
    return arguments


def _error_of(done: subprocess.CompletedProcess[bytes], caller: str) -> Error:
    """The error that the command printed."""
    said = done.stderr.decode(errors="replace").strip().splitlines() or [f"{caller} ended without a message"]
    for line in said:
        found = re.fullmatch(r"(?:svt: )?error (E\d+) (\w+): (.*)", line)
        if found:
            code, name, message = found.groups()
            return Error(code, name, message, Place())
    return Error("E904", "BadArgument", said[0].removeprefix("svt: "), Place())


def run_command(arguments: Sequence[str], accepted: Sequence[int] = (0,)) -> bytes:
    """Runs the command and returns its standard output.

    Raises svt.Error with the error that the command printed for other exit codes, E101 if it cannot be started.
    """
    command = find_command()
    try:
        done = subprocess.run([command, *arguments], stdin=subprocess.DEVNULL, capture_output=True)
    except OSError as error:
        raise Error("E101", "CannotOpen", f"{error.strerror}; set SVT_COMMAND", Place(command)) from None
    if done.returncode not in accepted:
        raise _error_of(done, f"svt {arguments[0]}")
    return done.stdout


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
