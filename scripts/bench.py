#!/usr/bin/env python3
"""Runs the benchmark, compares it with bench/baseline.json and keeps docs/dev/performance.md up to date.

  scripts/bench.py                     run, print the tables, warn where a figure got more than 10 % worse
  scripts/bench.py --quick             the small grid alone, about two minutes
  scripts/bench.py --no-run            the same with the figures of the last run
  scripts/bench.py --update-docs       also rewrite the tables of docs/dev/performance.md
  scripts/bench.py --update-baseline   also store the figures as the new baseline

Watched are ratios to the peers of the same run, times in units of a fixed piece of work of the same run, and sizes in
bytes, so that a baseline of one machine means something on another. A warning does not fail; --strict makes it.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BASELINE = ROOT / "bench" / "baseline.json"
PAGE = ROOT / "docs" / "dev" / "performance.md"
BEGIN, END = "<!-- BEGIN bench -->", "<!-- END bench -->"
TOLERANCE = 0.10

HOUSE = "fzk-haus/800x700x400"
# What is wanted, where it is read, how it is written, must, moonshot, whether more is better.
GOALS = [
    ("voxelize FZK-Haus, 800 x 700 x 400: times faster than VTK's stencils with their images",
     lambda r: ratio(r, f"voxelize/{HOUSE}", "VTK stencils + images"), "{:.1f} x", 30, 150, True),
    ("the same, model file to .svt on disk",
     lambda r: r[f"model-file-to-.svt/{HOUSE}"]["ours"]["median_s"], "{:.3f} s", 0.25, 0.05, False),
    ("size on disk, lossless",
     lambda r: r[f"write-.svt/{HOUSE}"]["result_bytes"] / 1e6, "{:.2f} MB", 1, 0.1, False),
    ("size in memory, ready to cast",
     lambda r: r[f"make-bricks/{HOUSE}"]["result_bytes"] / 1e6, "{:.2f} MB", 4, 1, False),
    ("opaque frame, 1280 x 720, lit: times faster than VTK's CPU ray caster, unlit",
     lambda r: ratio(r, f"opaque-frame/{HOUSE}-1280x720-pixels", "VTK fixed-point"), "{:.1f} x", 5, 15, True),
    ("fully translucent frame, 1920 x 1080",
     lambda r: 1 / r[f"translucent-frame/{HOUSE}-1920x1080-pixels"]["ours"]["median_s"], "{:.1f} fps", 10, 30, True),
    ("1000 x 1200 x 600 instead of 800 x 700 x 400: times as long a frame",
     lambda r: r["larger-grid-opaque-frame/fzk-haus/1000x1200x600-1280x720-pixels"]["times_smaller_grid"],
     "{:.2f}", 1.3, 1.0, False),
    ("a section plane moved before each frame: times as long a frame (1: nothing is rebuilt)",
     lambda r: ratio(r, f"section-frame/{HOUSE}-1280x720-pixels", "SVT, plane moved"), "{:.2f}", 1.1, 1.0, False),
    ("a style changed before each frame: times as long a frame (1: nothing is rebuilt)",
     lambda r: ratio(r, f"section-frame/{HOUSE}-1280x720-pixels", "SVT, a style"), "{:.2f}", 1.1, 1.0, False),
]


def ratio(results, row, name):
    """Time of what stands beside ours, over ours."""
    return next(b["ratio"] for b in results[row]["beside"] if b["name"].startswith(name))


def commit():
    def git(*arguments):
        return subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()

    try:
        return git("rev-parse", "--short", "HEAD") + ("+" if git("status", "--porcelain", "-uno") else "")
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def run(build, quick):
    program = build / "bin" / "svt_bench"
    if not program.exists():
        sys.exit(f"bench: {program} is missing; run `make bench`, or configure with -DSVT_BENCH=ON and build svt_bench")
    command = [str(program), "--json", str(build / "bench.json"), "--commit", commit()] + (["--quick"] if quick else [])
    if not os.environ.get("DISPLAY") and shutil.which("xvfb-run"):
        command = ["xvfb-run", "-a", "-s", "-screen 0 1920x1200x24 -noreset"] + command
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"bench: svt_bench failed with exit code {done.returncode}")
    (build / "bench.md").write_text(done.stdout)


def goal_table(figures):
    results = {row["id"]: row for row in figures["results"]}
    lines = ["| goal | measured | must | moonshot | reached |", "|---|---|---|---|---|"]
    for text, read, style, must, moonshot, more in GOALS:
        try:
            value = read(results)
        except (KeyError, StopIteration):
            lines.append(f"| {text} | not measured in this run | {style.format(must)} | {style.format(moonshot)} | - |")
            continue

        def reaches(limit):
            return value >= limit * 0.995 if more else value <= limit * 1.005

        reached = "moonshot" if reaches(moonshot) else "must" if reaches(must) else "**no**"
        lines.append(f"| {text} | {style.format(value)} | {style.format(must)} | {style.format(moonshot)} | {reached} |")
    return "\n".join(lines)


def machine_text(figures):
    m = figures["machine"]
    return (f"Machine: {m['cores']} cores, {m['processor']}, {m['simd']}, {m['memory_gib']:.0f} GiB; {m['compiler']}, {m['build']}; "
            f"commit {figures['commit']}; load before the run {m['load_before']:.1f}.")


def watched(figures):
    """What may not get worse: name -> (value, whether more is better)."""
    values = {}
    for row in figures["results"]:
        for beside in row.get("beside", []):
            if beside["is_peer"]:
                values[f"{row['id']}: times faster than {beside['name']}"] = (beside["ratio"], True)
        if "yardsticks" in row:
            values[f"{row['id']}: yardsticks"] = (row["yardsticks"], False)
        if "result_bytes" in row:
            values[f"{row['id']}: bytes"] = (row["result_bytes"], False)
    return values


def compare(figures):
    if not BASELINE.exists():
        print("bench: no baseline yet; --update-baseline stores one")
        return 0
    stored = json.loads(BASELINE.read_text())["watched"]
    warnings = 0
    now = watched(figures)
    for name, (value, more) in now.items():
        if name not in stored or not stored[name] or not value:
            continue
        worse = stored[name] / value - 1 if more else value / stored[name] - 1
        if worse > TOLERANCE:
            warnings += 1
            print(f"bench: warning: {name}: {value:.4g}, was {stored[name]:.4g} ({100 * worse:.0f} % worse)")
    common = sum(name in stored for name in now)
    print(f"bench: {common} figures compared with the baseline, {warnings} more than {100 * TOLERANCE:.0f} % worse")
    return warnings


def update_docs(figures, tables):
    text = PAGE.read_text()
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        sys.exit(f"bench: {PAGE.relative_to(ROOT)} needs the marks {BEGIN} and {END}, once each")
    head, rest = text.split(BEGIN)
    tail = rest.split(END)[1]
    block = f"{machine_text(figures)}\n\n{goal_table(figures)}\n\n{tables.strip()}\n"
    PAGE.write_text(f"{head}{BEGIN}\n{block}{END}{tail}")
    print(f"bench: {PAGE.relative_to(ROOT)} rewritten")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "bench", help="build directory with bin/svt_bench")
    parser.add_argument("--quick", action="store_true", help="the small grid alone, fewer runs")
    parser.add_argument("--no-run", action="store_true", help="use the figures of the last run")
    parser.add_argument("--update-baseline", action="store_true", help="store the figures as the new baseline")
    parser.add_argument("--update-docs", action="store_true", help="rewrite the tables of docs/dev/performance.md")
    parser.add_argument("--strict", action="store_true", help="exit 1 where a figure got worse")
    arguments = parser.parse_args()
    if not arguments.no_run:
        run(arguments.build, arguments.quick)
    figures = json.loads((arguments.build / "bench.json").read_text())
    tables = (arguments.build / "bench.md").read_text()
    if figures["quick"] and (arguments.update_docs or arguments.update_baseline):
        sys.exit("bench: the page and the baseline want a full run, not a quick one")
    print(tables)
    print(goal_table(figures))
    print()
    print(machine_text(figures))
    if figures["machine"]["load_before"] > 0.5:
        print("bench: warning: the machine was busy before the run; the figures are rough")
    warnings = compare(figures)
    if arguments.update_baseline:
        stored = {"machine": figures["machine"], "commit": figures["commit"],
                  "watched": {name: float(f"{value:.4g}") for name, (value, _) in watched(figures).items()}}
        BASELINE.write_text(json.dumps(stored, indent=1) + "\n")
        print(f"bench: {BASELINE.relative_to(ROOT)} rewritten")
    if arguments.update_docs:
        update_docs(figures, tables)
    return 1 if arguments.strict and warnings else 0


if __name__ == "__main__":
    sys.exit(main())
