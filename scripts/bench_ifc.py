#!/usr/bin/env python3
"""Reading IFC beside web-ifc, in the same run: the part "ifc" of scripts/bench.py, and a table of its own.

  scripts/bench_ifc.py COMMAND [--data FOLDER] [--oracles FOLDER] [--megabytes 45 500] [--repeat 5]

COMMAND is the program svt. Read are the four shared files and the FZK house many times over (repeat_ifc.py), as large as
--megabytes says. Ours are seconds of one process each that reads, with all shapes and openings; web-ifc runs in node, where
--oracles holds it (npm install --prefix build/oracles web-ifc), reading and meshing in one warm process; memory is the peak of
the process. Voxels are not counted: the grid is coarse, and its time is reported apart.
"""
import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True  # write no cache files into scripts/
ROOT = Path(__file__).resolve().parent.parent
FILES = ["fzk_haus.ifc", "openhouse.ifc", "samplehouse.ifc", "largebuilding.ifc"]


def measured(command):
    """Output, peak memory in bytes and exit code of a process of its own."""
    with tempfile.TemporaryFile() as out:
        process = subprocess.Popen(command, stdout=out, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        return out.read(), usage.ru_maxrss * 1024, process.returncode


def ours(program, path, folder, repeat):
    """Seconds for reading, those of the whole command, peak memory and count of products; None where it fails."""
    reads, peaks, wholes, products = [], [], [], 0
    for _ in range(repeat):
        begin = time.monotonic()
        out, peak, code = measured(
            [
                str(program),
                "build",
                str(path),
                "-o",
                str(folder / "m.svt"),
                "--dimension",
                "40,40,20",
                "--vectors",
                "none",
                "--json",
            ]
        )
        if code != 0:
            return None
        wholes.append(time.monotonic() - begin)
        report = json.loads(out)
        reads.append(report["seconds"]["read"])
        peaks.append(peak)
        products = report.get("products", {}).get("read", 0)
    return {
        "median_s": statistics.median(reads),
        "min_s": min(reads),
        "whole_s": statistics.median(wholes),
        "peak_bytes": max(peaks),
        "products": products,
    }


def theirs(oracles, path, repeat):
    """The same of web-ifc; a text where it is missing or fails."""
    if not shutil.which("node"):
        return "node is not installed"
    out, peak, code = measured(
        ["node", str(ROOT / "bench/peers/web_ifc.mjs"), str(oracles / "node_modules"), str(path), str(repeat)]
    )
    if code == 77:
        return f"web-ifc is not in {oracles}: npm install --prefix {oracles} web-ifc"
    if code != 0:
        return f"web-ifc ends with exit code {code} on {path.name}"
    result = json.loads(out)
    return {"name": f"web-ifc {result['version']}", "median_s": statistics.median(result["times"]), "peak_bytes": peak}


def rows_of(program, data, oracles, megabytes, repeat):
    """Rows of the benchmark, and what was skipped."""
    rows, skipped = [], []
    with tempfile.TemporaryDirectory(prefix="svt-bench-ifc-") as name:
        folder = Path(name)
        inputs = [(data / file, file, repeat) for file in FILES if (data / file).exists()]
        skipped += [f"reading {file}: it is not in {data}" for file in FILES if not (data / file).exists()]
        for size in megabytes:
            if not (data / FILES[0]).exists():
                break
            large = folder / f"{size:g}.ifc"
            subprocess.run(
                [
                    sys.executable,
                    str(ROOT / "scripts/repeat_ifc.py"),
                    str(data / FILES[0]),
                    str(large),
                    "--megabytes",
                    f"{size:g}",
                ],
                check=True,
                stdout=subprocess.DEVNULL,
            )
            inputs.append((large, f"{FILES[0]} repeated to {size:g} MB", 1 if size > 100 else min(3, repeat)))
        for path, label, times in inputs:
            own = ours(program, path, folder, times)
            if own is None:
                skipped.append(f"reading {label}: the command fails")
                continue
            row = {
                "id": f"ifc/{label}",
                "stage": "ifc",
                "input": label,
                "input_bytes": path.stat().st_size,
                "ours": own,
                "beside": [],
            }
            peer = theirs(oracles, path, times)
            if isinstance(peer, str):
                skipped.append(f"{label} beside web-ifc: {peer}")
            else:
                row["beside"].append({**peer, "is_peer": True, "ratio": peer["median_s"] / own["median_s"]})
            rows.append(row)
            if path.parent == folder:
                path.unlink()
    return rows, skipped


def main():
    import bench_page

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--data", type=Path, default=ROOT / "../shared/data")
    parser.add_argument("--oracles", type=Path, default=ROOT / "build/oracles")
    parser.add_argument("--megabytes", type=float, nargs="*", default=[45, 500])
    parser.add_argument("--repeat", type=int, default=5)
    arguments = parser.parse_args()
    rows, skipped = rows_of(arguments.program, arguments.data, arguments.oracles, arguments.megabytes, arguments.repeat)
    print(bench_page.ifc(rows))
    for why in skipped:
        print(f"Skipped: {why}.")


if __name__ == "__main__":
    main()
