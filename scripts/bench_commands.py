"""Whole commands and the page, as a user waits for them: the parts "commands" and "page" of scripts/bench.py."""
import json
import shutil
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HOUSE = "fzk_haus_citygml3.gml"
GRID = "800,700,400"


def timed(command, repeat):
    """Median and least seconds of a whole process, which runs once before to warm up; stops with what it said if it fails."""
    found = []
    for _ in range(repeat + 1):
        begin = time.monotonic()
        done = subprocess.run(command, capture_output=True, text=True)
        found.append(time.monotonic() - begin)
        if done.returncode != 0:
            raise RuntimeError(
                f"{' '.join(map(str, command))}: exit code {done.returncode}: {done.stderr.strip()[-400:]}"
            )
    return {"median_s": statistics.median(found[1:]), "min_s": min(found[1:])}


def rows_of_commands(program, data, repeat):
    """Rows of the benchmark, and what was skipped."""
    if not program.exists():
        return [], [f"whole commands: {program} is missing; build the target svt there"]
    house = data / HOUSE
    if not house.exists():
        return [], [f"whole commands: {house} is missing"]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        volume, patterned, picture = (Path(folder) / name for name in ("house.svt", "patterned.svt", "house.png"))
        render = ["render", volume, "-o", picture, "--size", "1280x720", "--samples", "1"]
        for name, command, result, times in [
            ("svt build", ["build", house, "-o", volume, "--dimension", GRID], volume, repeat),
            ("svt render", [*render, "--surfaces", "voxels"], picture, repeat),
            ("svt render with faces", render, picture, repeat),
            (
                "svt build --patterns",
                ["build", house, "-o", patterned, "--spacing", "0.02", "--patterns"],
                patterned,
                3,
            ),
        ]:
            text = " ".join(part.name if isinstance(part, Path) else part for part in command)
            rows.append(
                {
                    "id": f"command/{name.replace(' ', '-')}",
                    "stage": "command",
                    "input": "FZK-Haus",
                    "command": f"svt {text}",
                    "ours": timed([program, *command], times),
                    "result_bytes": result.stat().st_size,
                }
            )
    return rows, []


def rows_of_page():
    """One row with the figures that `npm run bench` prints for programs, and what was skipped."""
    viewer = ROOT / "web" / "viewer"
    if not (viewer / "node_modules").is_dir() or not shutil.which("node"):
        return [], ["the page: web/viewer has no packages; `make viewer` makes it"]
    done = subprocess.run(["node", "bench/page.mjs", "--json"], cwd=viewer, capture_output=True, text=True)
    if done.returncode != 0:
        return [], [f"the page: bench/page.mjs ended with exit code {done.returncode}: {done.stderr.strip()[-400:]}"]
    return [{"id": "page/fzk-haus", "stage": "page", "input": "FZK-Haus", **json.loads(done.stdout)}], []
