"""The C++ API: Doxygen over the public headers, and changes of its HTML for screen readers."""
import pathlib
import re
import shutil
import subprocess

from . import markdown_text

PAGE = """# C++ API

`make install`, and the Debian package `libsvt-dev`, install static libraries with their public headers and a CMake package. The
pages of the headers have their own search:

<p><a class="md-button" href="../../cpp/index.html">Open the C++ API</a></p>

```cmake
find_package(svt 0.2 REQUIRED)
target_link_libraries(program PRIVATE svt::pipeline svt::illustrate)
```

[examples/cpp](examples/cpp) has three short programs: build and query, draw a section, draw a picture.
[Architecture](docs/dev/architecture.md) shows how the libraries depend on each other.

"""
HERE = pathlib.Path(__file__).resolve().parent

# Doxygen 1.9.4 writes HTML that readers of screens cannot use in these places.
CHANGES = [
    (
        re.compile(r'<iframe src="javascript:void\(0\)"[^>]*name="MSearchResults"'),
        '<iframe src="about:blank" title="Results of the search" name="MSearchResults"',
    ),
    (
        re.compile(r'<input type="text" id="MSearchField"'),
        '<input type="text" aria-label="Search the C++ API" id="MSearchField"',
    ),
    (re.compile(r'<a id="MSearchClose"'), '<a id="MSearchClose" aria-label="Close the search"'),
    (re.compile(r'(<img id="MSearchCloseImg"[^>]*) alt=""'), r'\1 alt="close"'),
    (re.compile(r"</div><!-- top -->"), "</div><!-- top --></header><main>"),
    (re.compile(r'<div class="title">(.*?)</div>', re.DOTALL), r'<h1 class="title">\1</h1>'),
    (re.compile(r'<div class="fragment">'), '<div class="fragment" tabindex="0" role="region" aria-label="Code">'),
    (re.compile(r'<pre class="fragment">'), '<pre class="fragment" tabindex="0" role="region" aria-label="Code">'),
]


def cpp_api(root: pathlib.Path, work: pathlib.Path, target: pathlib.Path) -> int:
    """Writes the pages into target. The number of headers."""
    headers = public_headers(root)
    work.mkdir(parents=True, exist_ok=True)
    (work / "mainpage.md").write_text(_main_page(root, headers, True), encoding="utf-8")
    shutil.rmtree(work / "cpp", ignore_errors=True)
    shutil.copytree(HERE / "cpp", work / "cpp")
    inputs = " ".join(f'"{path}"' for path in [*headers, work / "mainpage.md"])
    settings = (HERE / "cpp" / "Doxyfile").read_text(encoding="utf-8")
    settings += f'INPUT = {inputs}\nOUTPUT_DIRECTORY = "{target}"\n'
    settings += f'STRIP_FROM_PATH = "{root}" "{work}"\nSTRIP_FROM_INC_PATH = "{root}"\n'
    (work / "Doxyfile").write_text(settings, encoding="utf-8")
    shutil.rmtree(target, ignore_errors=True)
    target.mkdir(parents=True)
    done = subprocess.run(["doxygen", "Doxyfile"], cwd=work, capture_output=True, text=True)
    (work / "doxygen.log").write_text(done.stdout + done.stderr, encoding="utf-8")
    if done.returncode != 0:
        raise SystemExit(f"site: doxygen ended with {done.returncode}; see {work / 'doxygen.log'}")
    for page in target.rglob("*.html"):
        page.write_text(_changed(page.read_text(encoding="utf-8")), encoding="utf-8")
    return len(headers)


def page(root: pathlib.Path) -> str:
    """The page of the site that leads to the pages of Doxygen; links are paths from the top of the tree."""
    headers = public_headers(root)
    table = _main_page(root, headers, False).partition("| library |")
    return PAGE + table[1] + table[2]


def public_headers(root: pathlib.Path) -> list[pathlib.Path]:
    """The top of each folder of svt/, which is installed."""
    return [path for path in sorted(root.glob("svt/*/*.hpp")) if not path.name.endswith("_test.hpp")]


def _changed(html: str) -> str:
    for pattern, replacement in CHANGES:
        html = pattern.sub(replacement, html)
    if 'name="nested-classes"' not in html:  # private ones, which have no list
        html = re.sub(r'<a href="#nested-classes">Classes</a> &#124;\s*', "", html)
    if "<h1" not in html:  # indexes begin with a heading of level 3
        title = re.search(r"<title>(.*?)(?: - SVT C\+\+ API)?</title>", html)
        heading = f'<h1 class="title">{title[1]}</h1>' if title else ""
        html = html.replace('<div class="contents">', f'<div class="contents">\n{heading}', 1)
        html = re.sub(r"(</?)h3>", r"\1h2>", html)
    return html


def _main_page(root: pathlib.Path, headers: list[pathlib.Path], is_doxygen: bool) -> str:
    """The folders with their purpose and public headers; links only for Doxygen."""

    def link(path: pathlib.Path) -> str:
        return f'@ref {path.relative_to(root)} "{path.name}"' if is_doxygen else f"`{path.name}`"

    lines = [
        "# C++ API",
        "",
        "The public headers of the libraries of SVT. Each folder of `svt/` is a library `svt::FOLDER` of the CMake package.",
        "Functions that can fail return svt::Result. Lengths are metres, unless a name states another unit.",
        "",
        "| library | purpose | headers |",
        "|---|---|---|",
    ]
    for folder in sorted({path.parent for path in headers}):
        readme = folder / "README.md"
        purpose = markdown_text.description_of(readme.read_text(encoding="utf-8")) if readme.exists() else ""
        names = ", ".join(link(path) for path in headers if path.parent == folder)
        lines.append(f"| **{folder.name}** | {purpose.split('. ')[0].rstrip('.')} | {names} |")
    return "\n".join(lines) + "\n"
