#!/usr/bin/env python3
"""Runs the benchmark, compares it with bench/baseline.json and keeps docs/dev/performance.md up to date.

  scripts/bench.py                     run, print the tables, warn where a figure got more than 10 % worse
  scripts/bench.py --quick             the small grid alone, under two minutes
  scripts/bench.py --only render ...   these parts alone; the others keep the figures of their last run
  scripts/bench.py --profile           the same as --only profile: instructions and cache misses, counted by valgrind
  scripts/bench.py --no-run            the same with the figures of the last run
  scripts/bench.py --update-docs       also rewrite the tables and the plot of docs/dev/performance.md, and the README's table
  scripts/bench.py --update-baseline   also store the figures as the new baseline

Watched are ratios to the peers of the same run, times in units of a fixed piece of work of the same run, sizes in
bytes and counted instructions, so that a baseline of one machine means something on another. A warning does not fail;
--strict makes it.
"""

import argparse
import json
import os
import resource
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.dont_write_bytecode = True  # write no cache files into scripts/
import bench_commands
import bench_ifc
import bench_page
import bench_plot

ROOT = Path(__file__).resolve().parent.parent
BASELINE = ROOT / "bench" / "baseline.json"
PAGE = ROOT / "docs" / "dev" / "performance.md"
README = ROOT / "README.md"
PLOT = ROOT / "docs" / "images" / "scaling.svg"
DATA = Path(os.environ.get("SVT_DATA_DIR", ROOT / "../shared/data"))
ORACLES = Path(os.environ.get("SVT_ORACLES", ROOT / "build" / "oracles"))
BEGIN, END = "<!-- BEGIN bench -->", "<!-- END bench -->"
TOLERANCE = 0.10
BUSY = 0.1  # cores used by other processes during a part, above which its figures are marked as rough
PARTS = ["read", "ifc", "voxelize", "render", "stages", "scaling", "commands", "page", "profile"]
QUICK_PARTS = ["read", "ifc", "voxelize", "render", "stages", "scaling"]


def commit():
    def git(*arguments):
        return subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()

    try:
        return git("rev-parse", "--short", "HEAD") + ("+" if git("status", "--porcelain", "-uno") else "")
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


class Quiet:
    """Load from other processes between start and end: cores on average, and time stolen by a hypervisor."""

    def __init__(self):
        self.start = self.now()

    @staticmethod
    def now():
        try:
            ticks = [int(word) for word in Path("/proc/stat").read_text().split("\n", 1)[0].split()[1:9]]
        except (OSError, ValueError):
            return None
        user, nice, system, _, _, interrupts, soft_interrupts, stolen = ticks
        own = resource.getrusage(resource.RUSAGE_CHILDREN)
        hertz = os.sysconf("SC_CLK_TCK")
        busy = (user + nice + system + interrupts + soft_interrupts) / hertz
        return time.monotonic(), busy - own.ru_utime - own.ru_stime, stolen / hertz

    def end(self):
        now = self.now()
        if now is None or self.start is None:
            return {}
        wall, others, stolen = (b - a for a, b in zip(self.start, now))
        return {
            "seconds": round(wall, 1),
            "others_cores": round(max(0, others) / wall, 3),
            "stolen_cores": round(max(0, stolen) / wall, 3),
        }


def run_part(program, build, part, quick):
    """Runs one part in its own process, so that memory freed by another part does not affect it."""
    out = build / f"bench-{part}.json"
    command = [str(program), "--only", part, "--json", str(out)] + (["--quick"] if quick else [])
    if part == "render" and not os.environ.get("DISPLAY") and shutil.which("xvfb-run"):
        command = ["xvfb-run", "-a", "-s", "-screen 0 1920x1200x24 -noreset"] + command
    done = subprocess.run(command)
    if done.returncode != 0:
        sys.exit(f"bench: svt_bench failed with exit code {done.returncode}")
    return json.loads(out.read_text())


def counted(program, build, piece):
    """Instructions and cache misses of one piece of work, as simulated by cachegrind."""
    out = build / f"cachegrind-{piece}.out"
    done = subprocess.run(
        [
            "valgrind",
            "--tool=cachegrind",
            "--cache-sim=yes",
            f"--cachegrind-out-file={out}",
            str(program),
            "--profile",
            piece,
        ],
        capture_output=True,
        text=True,
    )
    if done.returncode != 0:
        sys.exit(f"bench: valgrind failed with exit code {done.returncode}:\n{done.stderr[-2000:]}")
    lines = out.read_text().splitlines()
    events = next(line for line in lines if line.startswith("events:")).split()[1:]
    totals = dict(zip(events, map(int, next(line for line in lines if line.startswith("summary:")).split()[1:])))
    return {
        "instructions": totals["Ir"],
        "l1_misses": totals["I1mr"] + totals["D1mr"] + totals["D1mw"],
        "last_level_misses": totals["ILmr"] + totals["DLmr"] + totals["DLmw"],
    }


def run_profile(program, build):
    """Cost of each piece beyond the common preparation, per unit of its work."""
    if not shutil.which("valgrind"):
        return {"results": [], "skipped": ["the counted piece: valgrind is not installed"]}
    units = json.loads(
        subprocess.run([str(program), "--profile", "count"], stdout=subprocess.PIPE, text=True, check=True).stdout
    )
    print("bench: profile, under valgrind", file=sys.stderr)
    pieces = {"voxelize": "crossings", "opaque": "rays", "translucent": "rays"}
    with ThreadPoolExecutor(2) as pool:  # counts do not depend on other load
        counts = dict(zip(["prepare", *pieces], pool.map(lambda p: counted(program, build, p), ["prepare", *pieces])))
    rows = []
    for piece, unit in pieces.items():
        per_unit = {name: (counts[piece][name] - counts["prepare"][name]) / units[unit] for name in counts[piece]}
        rows.append(
            {
                "id": f"profile/{piece}",
                "stage": "profile",
                "piece": piece,
                "input": units["input"],
                "unit": unit[:-1],
                "units": units[unit],
                **per_unit,
            }
        )
    return {"machine": units["machine"], "results": rows, "skipped": []}


def run_ifc(program, quick):
    """Reading IFC, in processes of their own."""
    if not program.exists():
        return {"results": [], "skipped": [f"reading IFC: {program} is missing; build the target svt there"]}
    print("bench: ifc", file=sys.stderr)
    rows, skipped = bench_ifc.rows_of(program, DATA, ORACLES, [] if quick else [45, 500], 3 if quick else 5)
    return {"results": rows, "skipped": skipped}


def run_from_outside(program, part):
    """Whole commands, or the page in a browser."""
    print(f"bench: {part}", file=sys.stderr)
    rows, skipped = (
        bench_commands.rows_of_commands(program, DATA, 7) if part == "commands" else bench_commands.rows_of_page()
    )
    return {"results": rows, "skipped": skipped}


def run(build, parts, quick, figures):
    program = build / "bin" / "svt_bench"
    if not program.exists():
        sys.exit(f"bench: {program} is missing; run `make bench`, or configure with -DSVT_BENCH=ON and build svt_bench")
    for part in parts:
        quiet = Quiet()
        if part == "profile":
            result = run_profile(program, build)
        elif part == "ifc":
            result = run_ifc(build / "bin" / "svt", quick)
        elif part in ("commands", "page"):
            result = run_from_outside(build / "bin" / "svt", part)
        else:
            result = run_part(program, build, part, quick)
        figures["parts"][part] = {"commit": commit(), **quiet.end(), **result}


def watched(figures):
    """Figures to monitor: name -> (value, whether more is better)."""
    values = {}
    for row in bench_page.all_rows(figures):
        for beside in row.get("beside", []):
            if beside["is_peer"]:
                values[f"{row['id']}: times faster than {beside['name']}"] = (beside["ratio"], True)
        for key, name in (
            ("yardsticks", "yardsticks"),
            ("result_bytes", "bytes"),
            ("bricks_bytes", "bytes of bricks"),
            ("instructions", "instructions per unit"),
            ("times_closed", "times as long as closed"),
        ):
            if key in row:
                values[f"{row['id']}: {name}"] = (row[key], False)
    return values


def compare(figures):
    if not BASELINE.exists():
        print("bench: no baseline yet; --update-baseline stores one")
        return 0
    stored = json.loads(BASELINE.read_text())["watched"]
    warnings = 0
    now = watched(figures)
    for name, (value, more) in now.items():
        if not stored.get(name) or not value:
            continue
        worse = stored[name] / value - 1 if more else value / stored[name] - 1
        if worse > TOLERANCE:
            warnings += 1
            print(f"bench: warning: {name}: {value:.4g}, was {stored[name]:.4g} ({100 * worse:.0f} % worse)")
    common = sum(name in stored for name in now)
    print(f"bench: {common} figures compared with the baseline, {warnings} more than {100 * TOLERANCE:.0f} % worse")
    return warnings


def warn_of_noise(figures):
    for name, part in figures["parts"].items():
        if name != "profile" and part.get("others_cores", 0) + part.get("stolen_cores", 0) > BUSY:
            print(
                f"bench: warning: {name}: others used {part['others_cores']} cores during it, the host took "
                f"{part['stolen_cores']}; its figures are rough"
            )


def update_baseline(figures):
    stored = {
        "machine": bench_page.machine(figures),
        "commit": bench_page.commits(figures),
        "watched": {name: float(f"{value:.4g}") for name, (value, _) in watched(figures).items()},
    }
    BASELINE.write_text(json.dumps(stored, indent=1) + "\n")
    print(f"bench: {BASELINE.relative_to(ROOT)} rewritten")


def replace_marked(path, tables):
    """Replaces what stands between the marks of a page."""
    text = path.read_text()
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        sys.exit(f"bench: {path.relative_to(ROOT)} needs the marks {BEGIN} and {END}, once each")
    head, rest = text.split(BEGIN)
    path.write_text(f"{head}{BEGIN}\n{tables}\n{END}{rest.split(END)[1]}")
    print(f"bench: {path.relative_to(ROOT)} rewritten")


def update_docs(figures):
    replace_marked(PAGE, bench_page.page(figures, "../images/scaling.svg"))
    replace_marked(README, bench_page.beside_the_paper(figures))
    rows = [row for row in bench_page.all_rows(figures) if row["stage"] == "scaling"]
    if rows:
        PLOT.write_text(bench_plot.scaling_svg(rows))
        print(f"bench: {PLOT.relative_to(ROOT)} rewritten")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "--build", type=Path, default=ROOT / "build" / "bench", help="build directory with bin/svt_bench"
    )
    parser.add_argument("--quick", action="store_true", help="the small grid alone, fewer runs")
    parser.add_argument("--only", nargs="+", choices=PARTS, metavar="PART", help=f"of {', '.join(PARTS)}")
    parser.add_argument("--profile", action="store_true", help="the same as --only profile")
    parser.add_argument("--no-run", action="store_true", help="use the figures of the last run")
    parser.add_argument("--update-baseline", action="store_true", help="store the figures as the new baseline")
    parser.add_argument("--update-docs", action="store_true", help="rewrite tables and plot of docs/dev/performance.md")
    parser.add_argument("--strict", action="store_true", help="exit 1 where a figure got worse")
    arguments = parser.parse_args()
    if arguments.quick and (arguments.update_docs or arguments.update_baseline):
        sys.exit("bench: the page and the baseline want a full run, not a quick one")
    parts = arguments.only or (["profile"] if arguments.profile else QUICK_PARTS if arguments.quick else PARTS)
    store = arguments.build / ("bench-quick.json" if arguments.quick else "bench.json")
    keep = arguments.no_run or arguments.only or arguments.profile
    figures = json.loads(store.read_text()) if keep and store.exists() else {}
    figures.setdefault("parts", {})
    if not arguments.no_run:
        run(arguments.build, parts, arguments.quick, figures)
        store.write_text(json.dumps(figures, indent=1) + "\n")
    if not figures["parts"]:
        sys.exit(f"bench: {store} is missing; run without --no-run")
    print(bench_page.page(figures, "../images/scaling.svg"))
    print()
    warn_of_noise(figures)
    warnings = compare(figures)
    if arguments.update_baseline:
        update_baseline(figures)
    if arguments.update_docs:
        update_docs(figures)
    return 1 if arguments.strict and warnings else 0


if __name__ == "__main__":
    sys.exit(main())
