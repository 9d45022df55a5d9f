"""Calls MkDocs with the staged pages. Completes its HTML: sizes of pictures, edit links, the order of the error pages."""
import logging
import pathlib
import posixpath
import re
from typing import Any

from mkdocs.commands.build import build
from mkdocs.config import load_config
from mkdocs.plugins import BasePlugin
from mkdocs.structure.files import Files
from mkdocs.structure.nav import Navigation

from . import pictures
from .navigation import navigation
from .staging import Staging

HERE = pathlib.Path(__file__).resolve().parent


class Hooks(BasePlugin):
    """Events of MkDocs while it builds."""

    def __init__(self, staging: Staging, repository: str, branch: str) -> None:
        self._staging = staging
        self._edit = f"{repository.rstrip('/')}/edit/{branch}/" if repository else ""

    def on_nav(self, nav: Navigation, config: Any, files: Files, **_: Any) -> Navigation:
        """Pages of errors are too many for the navigation; they follow each other below the list of all errors."""
        listed = next((page for page in nav.pages if page.file.src_uri == "errors/index.md"), None)
        if listed is None:
            return nav
        before = listed
        for file in sorted(files.documentation_pages(), key=lambda each: each.src_uri):
            if re.fullmatch(r"errors/E\d{3}\.md", file.src_uri):
                assert file.page
                file.page.parent, file.page.previous_page = listed.parent, before
                if before is not listed:
                    before.next_page = file.page
                before = file.page
        return nav

    def on_page_context(self, context: dict, page: Any, config: Any, **_: Any) -> dict:
        source = self._staging.pages[page.file.src_uri].source
        page.edit_url = self._edit + source if self._edit and source else None
        return context

    def on_page_content(self, html: str, page: Any, config: Any, **_: Any) -> str:
        folder = pathlib.Path(config["docs_dir"])

        def sized(found: re.Match) -> str:
            path = found[1]
            if re.match(r"[a-z]+:", path):
                return found[0]
            file = folder / posixpath.normpath(posixpath.join(posixpath.dirname(page.file.dest_uri), path))
            width, height = pictures.size_of(file)
            return found[0].replace("<img ", f'<img loading="lazy" decoding="async" width="{width}" height="{height}" ')

        html = re.sub(r'<img [^>]*?src="([^"]+)"[^>]*>', sized, html)
        html = re.sub(r"<thead>\s*<tr>(\s*<th[^>]*></th>)*\s*</tr>\s*</thead>", "", html)
        html = re.sub(r"<th([^>]*)></th>", r"<td\1></td>", html)
        html = html.replace("<table>", '<div class="svt-table"><table class="svt-grid">').replace(
            "</table>", "</table></div>"
        )
        kind = {"index.md": "svt-home", "gallery.md": "svt-gallery"}.get(page.file.src_uri, "")
        if page.file.src_uri.startswith("errors/"):
            kind = "svt-errors"
        return f'<div class="{kind}">{html}</div>' if kind else html


def build_site(staging: Staging, target: pathlib.Path, repository: str, branch: str) -> None:
    """Writes the site of the staged pages. Ends the program if MkDocs warns."""
    warnings: list[str] = []

    class Handler(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            if record.levelno >= logging.WARNING:
                warnings.append(record.getMessage())

    logging.getLogger("mkdocs").addHandler(Handler())
    config = load_config(
        str(HERE / "mkdocs.yml"),
        docs_dir=str(staging.folder),
        site_dir=str(target),
        nav=navigation(staging),
    )
    # Without `repo_url`: the theme would ask that host for numbers of stars.
    config["plugins"]["svt"] = Hooks(staging, repository, branch)
    build(config)
    if warnings:
        raise SystemExit("site: MkDocs warns:\n" + "\n".join(warnings))
