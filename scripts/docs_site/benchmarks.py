"""The page of benchmarks, from the figures that scripts/bench.py stores in bench/baseline.json."""
import dataclasses
import html
import json
import math
import pathlib
import re
import subprocess

INPUTS = {
    "fzk-haus": "FZK-Haus",
    "fzk-haus-turned": "FZK-Haus, turned by 30 degrees",
    "tower": "generated tower",
    "tower-citygml-2.0": "generated tower, CityGML 2.0",
    "sig3d-house-citygml-2.0": "SIG3D house, CityGML 2.0",
    "berlin-citygml-1.0": "Berlin, CityGML 1.0",
}
STAGES = {
    "read": "Reading a file",
    "voxelize": "Voxelizing",
    "opaque-frame": "A picture of opaque components",
    "translucent-frame": "A picture of translucent components",
}
METHODS = {
    "read": "The time to read a file into the tree of the library.",
    "voxelize": "The time from triangle meshes to a labelled volume.",
    "opaque-frame": "The time of a picture with 1280 x 720 pixels. SVT computes light; VTK does not. The machine has no graphics "
    "card, so that VTK's ray caster for graphics cards runs in the software of Mesa.",
    "translucent-frame": "The time of a picture with 1920 x 1080 pixels, in which each component absorbs 30 % of the light per "
    "metre.",
}
RATIO = re.compile(r"^([\w-]+)/([\w.-]+)/([\w.-]+): times faster than (.+)$")
BYTES = re.compile(r"^([\w.-]+)/([\w.-]+)/([\w.-]+): bytes$")
SIZES = {
    "voxelize-to-columns": "volume in memory",
    "make-bricks": "ready to draw, in memory",
    "write-.svt": "file (.svt)",
}

INTRODUCTION = """# Benchmarks

The charts show how many times faster SVT is than another program at the same work, on the same machine in the same run. Longer
bars are better for SVT; the scale is logarithmic. `make bench` measures, and `scripts/bench.py --update-baseline` stores the
figures in [bench/baseline.json](bench/baseline.json), from which this page is made.

| | |
|---|---|
{machine}

[Performance](docs/dev/performance.md) has the times, the method, the agreement of the results voxel by voxel and pixel by pixel,
and the goals that SVT does not reach. [Comparison with other programs](docs/comparison.md) has figures of other projects.
"""


@dataclasses.dataclass
class Bar:
    input: str
    size: str
    peer: str
    ratio: float


def benchmarks(root: pathlib.Path) -> str:
    """The page as Markdown; links are paths from the top of the tree."""
    file = root / "bench" / "baseline.json"
    baseline = json.loads(file.read_text(encoding="utf-8"))
    text = [INTRODUCTION.format(machine=_machine(root, file, baseline))]
    for stage, title in STAGES.items():
        bars = _bars(baseline["watched"], stage)
        if not bars:
            raise SystemExit(f"site: {file} has no figures of '{stage}'")
        text.append(f"## {title}\n\n{METHODS[stage]}\n\n{chart(bars, title)}\n\n{_table(bars)}\n")
    text.append("## Sizes\n\n" + _sizes(baseline["watched"]))
    return "\n".join(text)


def _machine(root: pathlib.Path, file: pathlib.Path, baseline: dict) -> str:
    machine = baseline["machine"]
    command = ["git", "log", "-1", "--format=%cs", "--", str(file)]
    dated = subprocess.run(command, cwd=root, capture_output=True, text=True).stdout.strip()
    rows = {
        "machine": f"{machine['cores']} cores, {machine['processor']}, {machine['simd']}, {machine['memory_gib']:.0f} GiB",
        "graphics card": "none",
        "compiler": f"{machine['compiler']}, {machine['build']}",
        "commits": baseline["commit"],
        "stored on": dated or "unknown",
    }
    return "\n".join(f"| {name} | {value} |" for name, value in rows.items())


def _bars(watched: dict[str, float], stage: str) -> list[Bar]:
    bars = []
    for key, value in watched.items():
        found = RATIO.match(key)
        if found and found[1] == stage:
            size = re.sub(r"-(\d+x\d+)-pixels$", "", found[3]).replace("x", " x ").replace("-mb", " MB")
            bars.append(Bar(INPUTS.get(found[2], found[2]), size, found[4], value))
    return bars


def chart(bars: list[Bar], title: str) -> str:
    """Horizontal bars on a logarithmic scale as inline SVG, in the colours of the page."""
    left, width, height, top = 400, 820, 26, 24
    most = math.log10(max(10.0, max(bar.ratio for bar in bars)))
    scale = (width - left - 60) / most
    total = top + height * len(bars) + 6
    lines = [
        f'<svg class="svt-chart" viewBox="0 0 {width} {total}" role="img" '
        f'aria-label="{html.escape(title)}: times faster, table below">'
    ]
    for decade in range(int(most) + 1):
        x = left + decade * scale
        lines.append(f'<line x1="{x:.0f}" y1="{top - 4}" x2="{x:.0f}" y2="{total - 6}" class="svt-chart__grid"/>')
        lines.append(f'<text x="{x:.0f}" y="14" text-anchor="middle">{10**decade} x</text>')
    for number, bar in enumerate(bars):
        y = top + number * height
        length = max(2.0, math.log10(max(1.0, bar.ratio)) * scale)
        label = f"{_short(bar.peer)}, {bar.input.replace(', turned by 30 degrees', ' turned')}, {bar.size}"
        lines.append(f'<text x="{left - 8}" y="{y + 17}" text-anchor="end">{html.escape(label)}</text>')
        lines.append(f'<rect x="{left}" y="{y + 4}" width="{length:.0f}" height="{height - 8}" rx="2"/>')
        lines.append(f'<text x="{left + length + 6:.0f}" y="{y + 17}">{figure(bar.ratio)} x</text>')
    return "".join(lines) + "</svg>"


def _short(peer: str) -> str:
    names = {"dense texture": "the paper's method", "VTK fixed": "VTK, CPU", "VTK GPU": "VTK, GL", "OpenVDB": "OpenVDB"}
    return next((short for begin, short in names.items() if peer.startswith(begin)), peer)


def figure(value: float) -> str:
    """Three significant digits."""
    return f"{value:.0f}" if value >= 100 else f"{value:.1f}" if value >= 10 else f"{value:.2f}"


def _table(bars: list[Bar]) -> str:
    rows = [f"| {bar.input} | {bar.size} | {bar.peer} | {figure(bar.ratio)} |" for bar in bars]
    return "\n".join(["| input | size | compared with | times faster |", "|---|---|---|---|", *rows])


def _sizes(watched: dict[str, float]) -> str:
    rows = []
    for key, value in watched.items():
        found = BYTES.match(key)
        if found and found[1] in SIZES:
            samples = [int(number) for number in found[3].split("x")]
            dense = 2 * samples[0] * samples[1] * samples[2]
            share = f"{value / dense:.3%}"
            rows.append(
                f"| {INPUTS[found[2]]} | {found[3].replace('x', ' x ')} | {SIZES[found[1]]} | {value / 1e6:.2f} MB | {share} |"
            )
    header = [
        "| input | samples | representation | size | share of a dense volume of 16 bits |",
        "|---|---|---|---|---|",
    ]
    return "\n".join(header + rows) + "\n"
