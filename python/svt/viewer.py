"""The interactive page for volumes, served by the command."""
from __future__ import annotations

import atexit
import html
import os
import shutil
import subprocess
import tempfile
import weakref
from typing import TYPE_CHECKING

from .command import find_command
from .errors import Error, Place

if TYPE_CHECKING:
    from .volume import Volume


def _stop(process: subprocess.Popen, folder: str | None) -> None:
    if process.poll() is None:
        process.terminate()
        try:
            process.wait(5)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
    for pipe in (process.stdout, process.stderr):
        if pipe is not None:
            pipe.close()
    if folder is not None:
        shutil.rmtree(folder, ignore_errors=True)


class View:
    """A page that shows a volume until it is closed, this object is deleted, or Python ends. Notebooks embed the page.

    Attributes
    ----------
    address : str
        An address that only this machine can reach, such as 'http://127.0.0.1:41234/'.
    """

    def __init__(self, volume: Volume, height: int = 600, browser: bool = False) -> None:
        command = find_command()
        folder = tempfile.mkdtemp(prefix="svt-view-")
        path = os.path.join(folder, "volume.svt")
        self.height = height
        try:
            volume.save(path)
            arguments = [command, "view", path] + ([] if browser else ["--no-browser"])
            process = subprocess.Popen(
                arguments, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
            )
        except BaseException:
            shutil.rmtree(folder, ignore_errors=True)
            raise
        # The first line is the address; the command ends without one if it cannot serve.
        assert process.stdout is not None and process.stderr is not None
        self.address = process.stdout.readline().strip()
        if not self.address:
            said = process.stderr.read().strip().splitlines()
            _stop(process, folder)
            raise Error("E101", "CannotOpen", said[-1] if said else "svt view ended without a message", Place())
        self._end = weakref.finalize(self, _stop, process, folder)
        atexit.register(self._end)

    def close(self) -> None:
        """End the server."""
        self._end()
        atexit.unregister(self._end)

    def __enter__(self) -> View:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _repr_html_(self) -> str:
        return (
            f'<iframe src="{html.escape(self.address)}" width="100%" height="{self.height}" style="border:0" '
            'title="SVT viewer"></iframe>'
        )

    def __repr__(self) -> str:
        return f"<svt.View at {self.address}>"
