"""Pictures that open in the viewer: the published page with the models of the gallery, and links to views in it.

A comment after a picture in the Markdown names the model and the state of the page:

    ![A section](images/gallery/section.webp)

    <!-- live: house {"hide": ["class=BuildingRoom"], "sections": [{"axis": "y", "at": 4.3, "flip": true}]} -->

The state has the members of ViewState in web/viewer/src/state/view_state.ts; absent ones have their defaults.
"""
import base64
import html
import json
import pathlib
import re
import subprocess
import zlib

LIVE = re.compile(r"(!\[[^\]]*\]\([^)]*\))\s*\n<!-- live: (\S+) (\{.*?\}) -->", re.DOTALL)
SECTION = {"axis": "z", "at": 0, "flip": False, "turn": 0, "tilt": 0}

# The models of the gallery: name, commands that make it. The last word of the last command is the volume to publish.
MODELS = {
    "house": [
        "svt sample house -o house.gml",
        "svt build house.gml --spacing 0.03 --vectors edges,meshes -o house.svt",
    ],
    "tower": ["svt sample tower -o tower.gml --storeys 4", "svt build tower.gml --spacing 0.05 -o tower.svt"],
    "town": [
        "svt sample city --profile berlin --buildings 300 --files 4 -o files",
        "svt city plan files -o town --spacing 0.25",
        "svt city run town",
        "svt city extract town --box=384800,5811900,0,385400,5812500,200 -o town.svt",
    ],
}


def packed(value: object) -> str:
    """JSON as the viewer's links have it: deflated, base64url (web/viewer/src/state/link.ts)."""
    deflate = zlib.compressobj(9, zlib.DEFLATED, -15)
    data = deflate.compress(json.dumps(value, separators=(",", ":")).encode()) + deflate.flush()
    return base64.urlsafe_b64encode(data).decode().rstrip("=")


def address(model: str, state: dict) -> str:
    """The address of a view, from the root of the site."""
    state = {**state, "sections": [{**SECTION, **section} for section in state.get("sections", [])]}
    return f"live/?model={model}#view={packed(state)}"


def with_live_pictures(text: str, page: str) -> str:
    """Replaces the comments by links that assets/site.js turns into buttons over the pictures."""
    depth = len(pathlib.PurePosixPath(page).with_suffix("").parts) - (1 if page.endswith("index.md") else 0)

    def opened(found: re.Match) -> str:
        if found[2] not in MODELS:
            raise SystemExit(
                f"site: {page}: there is no live model '{found[2]}'; scripts/docs_site/live.py has the models"
            )
        where = html.escape("../" * depth + address(found[2], json.loads(found[3])))
        name = re.sub(r"[`*]", "", re.findall(r"!\[([^\]]*)\]", found[1])[0])
        link = (
            f'<a class="svt-live__link" href="{where}">Open in the viewer<span class="svt-hidden">: {name}</span></a>'
        )
        return f'<div class="svt-live" markdown="1">\n\n{found[1]}\n\n{link}\n\n</div>\n'

    return LIVE.sub(opened, text)


def publish(svt: pathlib.Path, viewer: pathlib.Path, work: pathlib.Path, target: pathlib.Path) -> None:
    """Writes the viewer with the models into target."""
    work.mkdir(parents=True, exist_ok=True)
    models = []
    for commands in MODELS.values():
        model = work / commands[-1].split()[-1]
        models.append(model.name)
        if model.exists() and model.stat().st_mtime > svt.stat().st_mtime:
            continue
        for command in commands:
            run(svt, command.split()[1:], work)
        model.touch()
    run(svt, ["publish", *models, "-o", str(target), "--viewer", str(viewer), "--force", "--quiet"], work)


def run(svt: pathlib.Path, words: list[str], folder: pathlib.Path) -> None:
    done = subprocess.run([str(svt), *words], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"site: svt {' '.join(words)} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
