#!/usr/bin/env python3
"""Changes sampled operators, constants and conditions of a folder's sources, one at a time, and lists the changes that
none of the folder's own tests notices.

    scripts/mutants.py FOLDER... [--count 30] [--seed 1] [--seconds 120]

FOLDER is one of svt/ (volume, voxelize, ...); its test program is built and run for each change, in build/release. A
change that does not compile counts for nothing. A test run that takes longer than --seconds, or crashes, has noticed.
The sources are restored in the end, also after Ctrl-C. Exit code 1 if more than a tenth survive.
"""
import argparse
import pathlib
import random
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "release"
# Each rule: what is changed, and into what. Applied to code alone: no comments, strings, includes or templates.
RULES = [
    (r" < ", [" <= ", " > "]), (r" <= ", [" < "]), (r" > ", [" >= ", " < "]), (r" >= ", [" > "]),
    (r" == ", [" != "]), (r" != ", [" == "]), (r" && ", [" || "]), (r" \|\| ", [" && "]),
    (r" \+ ", [" - "]), (r" - ", [" + "]), (r" \* ", [" / "]), (r" / ", [" * "]),
    (r"\btrue\b", ["false"]), (r"\bfalse\b", ["true"]),
    (r"\bstd::min\b", ["std::max"]), (r"\bstd::max\b", ["std::min"]),
    (r"(?<![\w.'x])1(?![\w.'])", ["2", "0"]), (r"(?<![\w.'x])0(?![\w.'x])", ["1"]), (r"(?<![\w.'x])2(?![\w.'])", ["3"]),
    (r"\bcontinue;", ["break;"]), (r"\+= ", ["-= "]), (r"\+\+(?=\w)", ["--"]),
]


def code_of(line: str) -> str:
    """The line with strings, characters and comments blanked, at the same columns."""
    line = re.sub(r"\"(?:\\.|[^\"\\])*\"|'(?:\\.|[^'\\])'", lambda m: " " * len(m[0]), line)
    return re.sub(r"//.*", lambda m: " " * len(m[0]), line)


def mutations(path: pathlib.Path) -> list[tuple[pathlib.Path, int, int, int, str]]:
    """(file, line number, first and last column, replacement) of all changes that the rules allow."""
    found = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines()):
        code = code_of(line)
        if code.lstrip().startswith(("#", "template", "using", "namespace")) or "static_assert" in code or "SVT_CHECK" in code:
            continue
        for pattern, replacements in RULES:
            for match in re.finditer(pattern, code):
                found += [(path, number, match.start(), match.end(), by) for by in replacements]
    return found


def run(command: list[str], seconds: float) -> str:
    """"passed", "failed" or "slow"."""
    try:
        done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=seconds, cwd=ROOT)
    except subprocess.TimeoutExpired:
        return "slow"
    return "passed" if done.returncode == 0 else "failed"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--count", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=120)
    arguments = parser.parse_args()
    killed, survivors = 0, []
    for folder in arguments.folders:
        target = f"svt_{folder}_test"
        test = [str(BUILD / "bin" / target)]
        if run(["ninja", "-C", str(BUILD), target], 3600) != "passed" or run(test, 3600) != "passed":
            sys.exit(f"mutants: {target} does not build, or fails as it is")
        sources = [path for path in sorted((ROOT / "svt" / folder).rglob("*.cpp")) if not path.stem.endswith("_test")]
        choices = [mutation for path in sources for mutation in mutations(path)]
        random.Random(arguments.seed).shuffle(choices)
        tried = 0
        for path, number, begin, end, by in choices:
            if tried == arguments.count:
                break
            original = path.read_text(encoding="utf-8")
            lines = original.splitlines(keepends=True)
            old = lines[number]
            lines[number] = old[:begin] + by + old[end:]
            try:
                path.write_text("".join(lines), encoding="utf-8")
                if run(["ninja", "-C", str(BUILD), target], 600) != "passed":
                    continue
                outcome = run(test, arguments.seconds)
            finally:
                path.write_text(original, encoding="utf-8")
            tried += 1
            killed += outcome != "passed"
            if outcome == "passed":
                survivors.append(f"{path.relative_to(ROOT)}:{number + 1}: {old.strip()}  ->  {lines[number].strip()}")
                print(f"survived: {survivors[-1]}", flush=True)
        run(["ninja", "-C", str(BUILD), target], 3600)
    total = killed + len(survivors)
    print(f"mutants: {killed} of {total} noticed ({100 * killed / max(total, 1):.0f} %)")
    return 1 if total and len(survivors) * 10 > total else 0


if __name__ == "__main__":
    sys.exit(main())
