#!/usr/bin/env python3
"""Compares `svt diff` with the known answers of `svt sample house --change SEED`, and prints a table by kind of edit.

    scripts/check_diff.py --svt build/release/bin/svt [--format ifc] [--seeds 200] [--first 0]

Exit code 1 if an edit is missed, if a row is false, or if a volume is off by more than 0.1 % of the known one.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from pathlib import Path

LARGEST_SHARE = 0.001  # of the known volume by which a reported volume may be off
LARGEST_VECTOR_ERROR = 1e-5  # metres
ENDINGS = {"citygml3": ".gml", "cityjson": ".json", "ifc": ".ifc"}  # of files, by format of `svt sample`


def run(svt, arguments, allowed=(0,)):
    done = subprocess.run([svt, *arguments], capture_output=True, text=True, check=False)
    if done.returncode not in allowed:
        sys.exit(f"svt {' '.join(arguments)}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def is_different(row):
    """Whether a row reports a difference; other ids do not count."""
    return row["change"] != "same" or bool(row["attributes"]) or any(key != "id" for key in row["properties"])


def share_off(known, row):
    """The largest error of the two volumes as a share of the known changed volume; infinite for an unknown volume."""
    total = known["added"] + known["removed"]
    if not total:
        return 0.0
    if row["added"] is None or row["removed"] is None:
        # Added and removed objects have one volume.
        pairs = [(known[key], row[key] or 0.0) for key in ("added", "removed")]
    else:
        pairs = [(known[key], row[key]) for key in ("added", "removed")]
    return max(abs(a - b) for a, b in pairs) / total


def is_turn(known, found):
    """Whether the angles agree. A shape that half a turn makes of itself has a quarter turn in both senses."""
    if known is None or found is None:
        return known is None and found is None
    return abs(found - known) < 0.01 or (known < 0 and abs(found + known) < 0.01)


def compare_rows(answer, rows):
    """Yields (edit, problem or None, error of the volume as a share), and then ("false", row, 0) for false rows."""
    # Edits change the boundary surfaces of rooms, too. The answers do not list them; only a move is certainly false.
    found = {
        json.dumps([row["old"], row["new"]]): row
        for row in rows
        if is_different(row) and (not row["class"].endswith("Surface") or row["change"] == "moved")
    }
    for known in answer["rows"]:
        row = found.pop(json.dumps([known["old"], known["new"]]), None)
        if row is None:
            yield known["edit"], "missed", 0.0
            continue
        problem, share = None, share_off(known, row)
        if row["change"] != known["change"]:
            problem = f"{row['change']} instead of {known['change']}"
        elif share > LARGEST_SHARE:
            problem = f"volume off by {100 * share:.3f} %"
        elif (known["vector"] is None) != (row["vector"] is None):
            problem = f"vector {row['vector']} instead of {known['vector']}"
        elif known["vector"] and max(abs(a - b) for a, b in zip(known["vector"], row["vector"])) > LARGEST_VECTOR_ERROR:
            problem = f"vector {row['vector']} instead of {known['vector']}"
        elif not is_turn(known["rotation"], row["rotation"]):
            problem = f"rotation {row['rotation']} instead of {known['rotation']}"
        elif known["properties"].get("name") != row["properties"].get("name"):
            problem = "name missed"
        elif ("class" in known["properties"]) != ("class" in row["properties"]):
            problem = "class missed"
        yield known["edit"], problem, share
    for row in found.values():
        yield "false", f"{row['change']} {row['old']} {row['new']} {row['properties']} {list(row['attributes'])}", 0.0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--svt", default="build/release/bin/svt")
    parser.add_argument("--seeds", type=int, default=200)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--spacing", default="0.3")
    parser.add_argument("--format", default="citygml3", choices=sorted(ENDINGS))
    arguments = parser.parse_args()
    counts: defaultdict[str, int] = defaultdict(int)
    worst: defaultdict[str, float] = defaultdict(float)
    bad = []
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        ending = ENDINGS[arguments.format]
        old, new, answer = (str(Path(folder) / name) for name in ("old" + ending, "new" + ending, "answer"))
        sample = ["sample", "house", "-q", "--format", arguments.format]
        run(arguments.svt, [*sample, "-o", old])
        run(
            arguments.svt,
            ["build", old, "-o", old + ".svt", "-q", "--spacing", arguments.spacing, "--vectors", "meshes"],
        )
        for seed in range(arguments.first, arguments.first + arguments.seeds):
            run(arguments.svt, [*sample, "-o", new, "--change", str(seed), "--change-list", answer])
            known = json.loads(Path(answer).read_text(encoding="utf-8"))
            options = ["--json", "-q", "--tolerance", "0.002"]
            result = json.loads(run(arguments.svt, ["diff", old + ".svt", new, *options], allowed=(0, 7)))
            for edit, problem, share in compare_rows(known, result["rows"]):
                counts[edit] += 1
                worst[edit] = max(worst[edit], share)
                if problem:
                    bad.append((seed, edit, problem))
    for seed, edit, problem in bad:
        print(f"seed {seed}: {edit}: {problem}")
    print(f"{'edit':<10} {'count':>6} {'bad':>4} {'largest error of m3':>20}")
    for edit in sorted(counts):
        bads = sum(1 for entry in bad if entry[1] == edit)
        print(f"{edit:<10} {counts[edit]:>6} {bads:>4} {100 * worst[edit]:>18.5f} %")
    print(f"{arguments.seeds} seeds in {time.monotonic() - begin:.1f} s")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
