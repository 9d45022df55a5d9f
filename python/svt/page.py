"""The viewer with a volume in one HTML text, for notebooks and local files."""
from __future__ import annotations

import base64
import gzip
import hashlib
import html
import json
import os
import pathlib
import re
import subprocess
import tempfile
from typing import TYPE_CHECKING

from .command import find_command
from .errors import Error, Place
from .model import PathLike

if TYPE_CHECKING:
    from .volume import Volume

#: Files of a published page that one without a server does not use: threads need headers of the server, the compressed
#: copies need its content encoding, and comparisons and quantities would add a third to the size.
_UNUSED = re.compile(
    r"index\.html|preview\.png|sbom\.cdx\.json|languages/template\.json|.*_threads.*|.*svt_reports.*|.*\.(br|gz)"
)


def _publish(volume: Volume, folder: str) -> pathlib.Path:
    """The folder that `svt publish` writes for the volume."""
    path, site = os.path.join(folder, "volume.svt"), os.path.join(folder, "site")
    volume.save(path)
    command = find_command()
    try:
        done = subprocess.run(
            [command, "publish", path, "-o", site, "--quiet"], stdin=subprocess.DEVNULL, capture_output=True
        )
    except OSError as error:
        raise Error("E101", "CannotOpen", f"{error.strerror}; set SVT_COMMAND", Place(command)) from None
    if done.returncode != 0:
        said = done.stderr.decode(errors="replace").strip().splitlines() or ["svt publish ended without a message"]
        found = re.fullmatch(r"(?:svt: )?error (E\d+) (\w+): (.*)", said[-1])
        code, name, message = found.groups() if found else ("E101", "CannotOpen", said[-1])
        raise Error(code, name, message, Place())
    return pathlib.Path(site)


def _hash(text: str) -> str:
    return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"


def _one_text(site: pathlib.Path) -> str:
    """A published page with all its files in one HTML text. It can neither load nor send anything."""
    index = (site / "index.html").read_text(encoding="utf-8")
    script = re.search(r'<script type="module"[^>]* src="\./([^"]+)"', index)
    style = re.search(r'<link rel="stylesheet"[^>]* href="\./([^"]+)"', index)
    if script is None or style is None:
        raise Error("E101", "CannotOpen", "the page of the command has another structure; use equal versions", Place())
    paths = [path for path in sorted(site.rglob("*")) if path.is_file()]
    files = {
        name: base64.b64encode(gzip.compress(path.read_bytes(), mtime=0)).decode()
        for path in paths
        if not _UNUSED.fullmatch(name := path.relative_to(site).as_posix()) and name != style.group(1)
    }
    loader = pathlib.Path(__file__).with_name("page_loader.js").read_text(encoding="utf-8")
    styles = (site / style.group(1)).read_text(encoding="utf-8")
    policy = (
        f"default-src 'none'; script-src {_hash(loader)} blob: 'wasm-unsafe-eval'; worker-src blob:; "
        f"style-src {_hash(styles)}; img-src data: blob:; connect-src blob:; base-uri 'none'; form-action 'none'"
    )
    return f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1, viewport-fit=cover">
<meta name="color-scheme" content="light dark">
<title>SVT viewer</title>
<style>{styles}</style>
<script type="application/json" id="svt-files">{json.dumps({"main": script.group(1), "files": files})}</script>
</head>
<body>
<noscript>This page needs JavaScript.</noscript>
<script>{loader}</script>
</body>
</html>
"""


class Page:
    """A volume with the interactive page, in one HTML text. Made by :meth:`svt.Volume.page`.

    It needs the command `svt` with its page when it is made, and nothing later. The text contains the volume with the
    names, ids and attributes of the model: publish only data that may be public. The page runs in a sandboxed frame,
    which can neither load nor send anything.
    """

    def __init__(self, volume: Volume, height: int = 600, limit: int = 24_000_000) -> None:
        self._volume = volume
        self._content: str | None = None
        self.height = height
        self.limit = limit

    def _frame(self, size: str) -> str:
        """The frame with the page; its content is made once."""
        if self._content is None:
            with tempfile.TemporaryDirectory(prefix="svt-page-") as folder:
                self._content = html.escape(_one_text(_publish(self._volume, folder)))
        return (
            f'<iframe srcdoc="{self._content}" sandbox="allow-scripts allow-downloads" {size} style="border:0" '
            f'title="SVT viewer"></iframe>'
        )

    @property
    def html(self) -> str:
        """The text: a whole HTML document. Raises svt.Error if the command or its page is missing."""
        frame = self._frame('width="100%" height="100%"')
        title = html.escape(self._volume.name or self._volume.source or "SVT viewer")
        return (
            f'<!doctype html>\n<html lang="en">\n<head><meta charset="utf-8"><title>{title}</title>'
            "<style>html,body{margin:0;height:100%;overflow:hidden}iframe{display:block}</style></head>\n"
            f"<body>{frame}</body>\n</html>\n"
        )

    def save(self, path: PathLike) -> int:
        """Write the text to a file that browsers open; returns the number of bytes."""
        data = self.html.encode()
        temporary = f"{os.fspath(path)}.part"
        try:
            with open(temporary, "wb") as file:
                file.write(data)
            os.replace(temporary, path)
        except BaseException:
            if os.path.exists(temporary):
                os.unlink(temporary)
            raise
        return len(data)

    def _repr_html_(self) -> str:
        """The frame; a picture and the reason if the page cannot be made or is too large."""
        try:
            frame = self._frame(f'width="100%" height="{self.height}"')
        except Error as error:
            return self._picture(str(error))
        if len(frame) > self.limit:
            reason = f"the page has {len(frame) / 1e6:.1f} MB, over the limit of {self.limit / 1e6:.1f} MB"
            return self._picture(f"{reason}; show v.part(level=1).page(), or write a file with save()")
        return frame

    def _picture(self, reason: str) -> str:
        png = base64.b64encode(self._volume.frame(size=(800, 500))._repr_png_()).decode()
        return (
            f"<figure style='margin:0'><img alt='The volume' width='800' height='500' src='data:image/png;base64,{png}'>"
            f"<figcaption>No interactive page: {html.escape(reason)}</figcaption></figure>"
        )

    def __repr__(self) -> str:
        return f"<svt.Page of '{self._volume.name or self._volume.source}'>"
