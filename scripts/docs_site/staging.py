"""Lays out the pages of the site from the Markdown of the tree. Links keep working: their targets move with the pages.

    docs/README.md          index.md              docs/user/build.md     user/build.md
    docs/errors/E101.md     errors/E101.md        CONTRIBUTING.md        dev/contributing.md
    svt/volume/README.md    source/svt/volume/index.md
    svt/core/error.hpp      source/svt/core/error.hpp.md, a page with the source

Files outside docs/ become pages if a page links to them.
"""
import dataclasses
import os
import pathlib
import posixpath
import re
from typing import Optional

from . import live, markdown_text, pictures, runs

PICTURES = (".png", ".webp", ".svg", ".jpg")
NAMES = {
    "README.md": "overview.md",
    "CONTRIBUTING.md": "dev/contributing.md",
    "CHANGELOG.md": "changelog.md",
    "docs/README.md": "index.md",
}
LANGUAGES = {
    ".hpp": "cpp",
    ".cpp": "cpp",
    ".py": "python",
    ".pyi": "python",
    ".sh": "bash",
    ".json": "json",
    ".cmake": "cmake",
}
RUN_PAGES = ("docs/tutorials/", "docs/explanation/", "docs/gallery.md")


@dataclasses.dataclass
class Page:
    source: str  # path in the tree; "" for a page that the site makes
    target: str  # path among the staged pages
    title: str


class Staging:
    """The staged pages: their folder, and where each comes from."""

    def __init__(self, root: pathlib.Path, folder: pathlib.Path, runner: runs.Runner) -> None:
        self.root = root
        self.folder = folder
        self.pages: dict[str, Page] = {}  # by target
        self._runner = runner
        self._waiting: list[str] = []
        self._known: set[str] = set()
        self._files: Optional[pathlib.Path] = None  # of the commands of the current page

    def add_all(self) -> None:
        """All pages of docs/ and at the top, and the files they link to."""
        for path in sorted((self.root / "docs").rglob("*.md")):
            self._want(path.relative_to(self.root).as_posix())
        for name in NAMES:
            self._want(name)
        self._stage_waiting()

    def add(self, target: str, text: str) -> None:
        """A page that the site makes. Its links are paths from the top of the tree."""
        self._files = None
        page = Page("", target, markdown_text.title_of(text))
        self._write(page, self._moved(text, "made.md", target), markdown_text.description_of(text))
        self._stage_waiting()

    def _stage_waiting(self) -> None:
        while self._waiting:
            self._stage(self._waiting.pop())

    def target_of(self, source: str) -> str:
        """The staged path of a file or folder of the tree."""
        if source in NAMES:
            return NAMES[source]
        path = self.root / source
        inside = source.removeprefix("docs/") if source.startswith("docs/") else f"source/{source}"
        inside = inside.replace("/.", "/dot.")  # MkDocs ignores hidden files
        if path.is_dir():
            return f"{inside}/index.md"
        if path.suffix == ".md":
            return posixpath.join(posixpath.dirname(inside), "index.md") if path.name == "README.md" else inside
        if path.suffix in PICTURES:
            return inside if path.suffix == ".svg" else posixpath.splitext(inside)[0] + ".webp"
        return inside + ".md"

    def _want(self, source: str) -> None:
        if source not in self._known and (self.root / source).exists():
            self._known.add(source)
            self._waiting.append(source)

    def _stage(self, source: str) -> None:
        path = self.root / source
        target = self.target_of(source)
        if path.is_dir():
            if (path / "README.md").exists():
                self._want(f"{source}/README.md")
            else:
                self._write(Page(source, target, source), self._listing(path))
        elif path.suffix == ".md":
            self._stage_markdown(source, target)
        elif path.suffix in PICTURES:
            pictures.for_site(path, self.folder / target)  # a link to a picture
        else:
            text = path.read_text(encoding="utf-8", errors="replace").replace("\t", "    ")
            fence = "`" * max(3, 1 + max((len(run) for run in re.findall(r"`+", text)), default=0))
            language = LANGUAGES.get(path.suffix, "text")
            self._write(
                Page(source, target, path.name), f"# {path.name}\n\n`{source}`\n\n{fence}{language}\n{text}\n{fence}\n"
            )

    def _listing(self, path: pathlib.Path) -> str:
        entries = []
        for entry in sorted(path.iterdir()):
            if entry.is_file():
                entries.append(f"- [{entry.name}]({entry.name})")
                self._want(entry.relative_to(self.root).as_posix())
        name = path.relative_to(self.root).as_posix()
        return self._moved(f"# {name}\n\n" + "\n".join(entries) + "\n", f"{name}/README.md", self.target_of(name))

    def _stage_markdown(self, source: str, target: str) -> None:
        text = (self.root / source).read_text(encoding="utf-8")
        self._files = None
        if source.startswith(RUN_PAGES) and runs.steps_of(text):
            self._files = self._runner.files_of(posixpath.splitext(target)[0].replace("/", "-"), text)
        page = Page(source, target, markdown_text.title_of(text))
        self._write(page, self._moved(text, source, target), markdown_text.description_of(text))

    def _moved(self, text: str, source: str, target: str) -> str:
        """Links of a page of the tree as links of the staged page."""

        most = pictures.limits(*self._numbers_of_pictures(text, source, target))

        def move(is_picture: bool, link: str) -> str:
            if re.match(r"[a-z]+:|#", link):
                return link
            path, hash_mark, anchor = link.partition("#")
            wanted = posixpath.normpath(posixpath.join(posixpath.dirname(source), path))
            if is_picture:
                moved = self._stage_picture(wanted, target, most)
            elif wanted.startswith("..") or not (self.root / wanted).exists():
                raise SystemExit(f"site: {source} links to {link}, which does not exist")
            else:
                self._want(wanted)
                moved = self.target_of(wanted)
            return posixpath.relpath(moved, posixpath.dirname(target) or ".") + hash_mark + anchor

        return markdown_text.change_links(text, move)

    def _numbers_of_pictures(self, text: str, source: str, target: str) -> tuple[int, int]:
        """Still pictures and films of a page, each once; drawings are small."""
        files: set[pathlib.Path] = set()

        def collect(is_picture: bool, link: str) -> str:
            if is_picture and not re.match(r"[a-z]+:", link):
                files.add(self._file_of(posixpath.normpath(posixpath.join(posixpath.dirname(source), link)), target))
            return link

        markdown_text.change_links(text, collect)
        films = sum(pictures.is_film(file) for file in files)
        return sum(file.suffix != ".svg" for file in files) - films, films

    def _file_of(self, picture: str, page: str) -> pathlib.Path:
        """The file of a picture. One that the page's commands drew replaces the smaller one of the tree: images/PAGE/NAME.webp is
        NAME.png or NAME.svg."""
        if self._files is not None and posixpath.basename(posixpath.dirname(picture)) == pathlib.Path(page).stem:
            for suffix in (".svg", ".png", ".webp"):
                file = self._files / (pathlib.Path(picture).stem + suffix)
                if file.exists():
                    return file
        if not (self.root / picture).exists():
            raise SystemExit(f"site: the page {page} shows {picture}, which does not exist")
        return self.root / picture

    def _stage_picture(self, picture: str, page: str, most: tuple[int, int]) -> str:
        """Writes a picture as the page shows it; its path among the staged files."""
        file = self._file_of(picture, page)
        stem = posixpath.splitext(self.target_of(picture))[0]
        target = stem + ".svg" if file.suffix == ".svg" else f"{stem}-{most[pictures.is_film(file)] // 1000}k.webp"
        if not (self.folder / target).exists():
            pictures.for_site(file, self.folder / target, most)
        return target

    def _write(self, page: Page, text: str, description: str = "") -> None:
        self.pages[page.target] = page
        path = self.folder / page.target
        path.parent.mkdir(parents=True, exist_ok=True)
        header = f"title: {quoted(page.title)}\n" + (f"description: {quoted(description)}\n" if description else "")
        if page.target == "index.md":
            header += "hide:\n  - navigation\n  - toc\n"
        text = live.with_live_pictures(markdown_text.for_mkdocs(text), page.target)
        path.write_text(f"---\n{header}---\n\n{text}", encoding="utf-8")

    def update_tree(self) -> None:
        """Renews the small pictures of the tree from those that the commands of the pages draw."""
        for source in sorted(self._known):
            if not source.startswith(RUN_PAGES) or not source.endswith(".md"):
                continue
            text = (self.root / source).read_text(encoding="utf-8")
            if not runs.steps_of(text):
                continue
            stem = posixpath.splitext(self.target_of(source))[0]
            files = self._runner.files_of(stem.replace("/", "-"), text)
            for name in re.findall(rf"\]\((\S*images/{pathlib.Path(stem).name}/\S+)\)", text):
                found = [files / (pathlib.Path(name).stem + suffix) for suffix in (".svg", ".png", ".webp")]
                drawn = next((file for file in found if file.exists()), None)
                if drawn is not None:
                    pictures.for_tree(drawn, self.root / posixpath.dirname(source) / name)
                    print(os.path.relpath(self.root / posixpath.dirname(source) / name, self.root))


def quoted(text: str) -> str:
    """A YAML string."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'
