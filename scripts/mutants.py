#!/usr/bin/env python3
"""Changes sampled operators, constants and conditions of a folder's sources, one at a time, and lists the changes that
none of the folder's own tests notices.

    scripts/mutants.py FOLDER... | --changed [--count 30] [--seed 1] [--seconds 120] [--jobs 2] [--only PATTERN]

FOLDER is one of svt/ (volume, voxelize, ...); --changed takes the folders whose sources changed most in the last 30
commits, three at most. Works in copies of the checkout, build/mutants/0, 1, ..., one for each job,
with builds of their own (-O1); the checkout itself is not touched. A change that does not compile counts for nothing; a
test run that crashes or takes longer than --seconds has noticed. Tests end with the first that fails.
Changes that cannot matter are explained in tests/equivalent_mutants.txt and left out.
Exit code 1 if more than a tenth survive.
"""
import argparse
import concurrent.futures
import dataclasses
import hashlib
import os
import pathlib
import queue
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
COPIES = ROOT / "build" / "mutants"
EXPLAINED = ROOT / "tests" / "equivalent_mutants.txt"
# Each rule: what is changed, and into what. Applied to code alone: no comments, strings, includes or templates.
RULES = [
    (r" < ", [" <= ", " > "]),
    (r" <= ", [" < "]),
    (r" > ", [" >= ", " < "]),
    (r" >= ", [" > "]),
    (r" == ", [" != "]),
    (r" != ", [" == "]),
    (r" && ", [" || "]),
    (r" \|\| ", [" && "]),
    (r" \+ ", [" - "]),
    (r" - ", [" + "]),
    (r" \* ", [" / "]),
    (r" / ", [" * "]),
    (r"\btrue\b", ["false"]),
    (r"\bfalse\b", ["true"]),
    (r"\bstd::min\b", ["std::max"]),
    (r"\bstd::max\b", ["std::min"]),
    (r"(?<![\w.'x])1(?![\w.'])", ["2", "0"]),
    (r"(?<![\w.'x])0(?![\w.'x])", ["1"]),
    (r"(?<![\w.'x])2(?![\w.'])", ["3"]),
    (r"\bcontinue;", ["break;"]),
    (r"\+= ", ["-= "]),
    (r"\+\+(?=\w)", ["--"]),
]


@dataclasses.dataclass(frozen=True)
class Change:
    path: str  # below ROOT
    line: int  # from 0
    begin: int
    end: int
    by: str
    text: str  # the line as it is

    def changed(self) -> str:
        return self.text[: self.begin] + self.by + self.text[self.end :]

    def told(self) -> str:
        return f"{self.path}:{self.line + 1}: {self.text.strip()}  ->  {self.changed().strip()}"

    def key(self) -> str:
        """Without the line number, which changes with each edit above it."""
        return f"{self.path}: {self.text.strip()}  ->  {self.changed().strip()}"

    def rank(self, seed: int) -> str:
        """Orders changes by chance. An edit of other lines does not change the order, so a sample stays the same."""
        return hashlib.sha256(f"{seed} {self.begin} {self.key()}".encode()).hexdigest()


def code_of(line: str) -> str:
    """The line with strings, characters and comments blanked, at the same columns."""
    line = re.sub(r"\"(?:\\.|[^\"\\])*\"|'(?:\\.|[^'\\])'", lambda m: " " * len(m[0]), line)
    return re.sub(r"//.*", lambda m: " " * len(m[0]), line)


def changes_of(path: pathlib.Path) -> list[Change]:
    found = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines()):
        code = code_of(line)
        if (
            code.lstrip().startswith(("#", "template", "using", "namespace"))
            or "static_assert" in code
            or "SVT_CHECK" in code
        ):
            continue
        for pattern, replacements in RULES:
            for match in re.finditer(pattern, code):
                found += [Change(str(path.relative_to(ROOT)), number, *match.span(), by, line) for by in replacements]
    return found


def explained() -> set[str]:
    """The changes of tests/equivalent_mutants.txt: a line each, its reasons below it, indented."""
    lines = EXPLAINED.read_text(encoding="utf-8").splitlines() if EXPLAINED.exists() else []
    return {line.strip() for line in lines if line and not line.startswith((" ", "#"))}


def run(command: list[str], folder: pathlib.Path, seconds: float) -> str:
    """ "passed", "failed" or "slow"."""
    try:
        done = subprocess.run(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=seconds, cwd=folder
        )
    except subprocess.TimeoutExpired:
        return "slow"
    return "passed" if done.returncode == 0 else "failed"


def prepare_copy(number: int, targets: list[str]) -> pathlib.Path:
    """A copy of the checkout in which the targets are built and their tests pass."""
    copy = COPIES / str(number)
    listed = subprocess.run(
        ["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    for name in listed.stdout.splitlines():
        source, target = ROOT / name, copy / name
        if not source.exists() or (target.exists() and target.read_bytes() == source.read_bytes()):
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
    build = copy / "build" / "mutants"
    environment = {**os.environ, "CCACHE_BASEDIR": str(copy)}  # what one copy compiled is found by the next
    configure = [
        "cmake",
        "-G",
        "Ninja",
        "-B",
        str(build),
        "-DCMAKE_BUILD_TYPE=Release",
        "-DCMAKE_CXX_FLAGS_RELEASE=-O1",
        "-DSVT_UNITY=OFF",
    ]
    for command in (configure, ["ninja", "-C", str(build), *targets]):
        if subprocess.run(command, cwd=copy, env=environment, stdout=subprocess.DEVNULL).returncode != 0:
            sys.exit(f"mutants: '{' '.join(command)}' failed in {copy}")
    return copy


def try_change(copy: pathlib.Path, change: Change, seconds: float) -> str:
    """ "passed" (nobody noticed), "failed", "slow", or "not compiled"."""
    target = f"svt_{change.path.split('/')[1]}_test"
    build = copy / "build" / "mutants"
    path = copy / change.path
    original = path.read_text(encoding="utf-8")
    lines = original.splitlines(keepends=True)
    lines[change.line] = change.changed() + "\n"
    try:
        path.write_text("".join(lines), encoding="utf-8")
        if run(["ninja", "-C", str(build), "-j1", target], copy, 900) != "passed":
            return "not compiled"
        return run([str(build / "bin" / target), "--gtest_fail_fast", "--gtest_brief=1"], build, seconds)
    finally:
        path.write_text(original, encoding="utf-8")


def changed_folders() -> list[str]:
    """The folders of svt/ with tests of their own that the last 30 commits changed most, three at most."""
    count = subprocess.run(
        ["git", "rev-list", "--count", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout
    base = f"HEAD~{min(30, int(count) - 1)}"
    listed = subprocess.run(
        ["git", "diff", "--numstat", base, "HEAD", "--", "svt/*.cpp"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    lines: dict[str, int] = {}
    for added, removed, path in (line.split("\t") for line in listed.splitlines()):
        folder = path.split("/")[1]
        if not path.endswith("_test.cpp") and any((ROOT / "svt" / folder).rglob("*_test.cpp")):
            lines[folder] = lines.get(folder, 0) + int(added) + int(removed)
    return sorted(lines, key=lambda folder: -lines[folder])[:3]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="*")
    parser.add_argument("--changed", action="store_true")
    parser.add_argument("--count", type=int, default=30, help="changes of each folder")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=120)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--only", default="", help="only sources whose path matches the regular expression")
    arguments = parser.parse_args()
    if arguments.changed:
        arguments.folders += changed_folders()
    if not arguments.folders:
        parser.error("name folders of svt/, or --changed")
    os.environ.setdefault("SVT_DATA_DIR", str(ROOT.parent / "shared" / "data"))
    equivalent = explained()
    chosen: list[Change] = []
    for folder in arguments.folders:
        sources = [
            path
            for path in sorted((ROOT / "svt" / folder).rglob("*.cpp"))
            if not path.stem.endswith("_test") and re.search(arguments.only, str(path.relative_to(ROOT)))
        ]
        choices = [change for path in sources for change in changes_of(path) if change.key() not in equivalent]
        chosen += sorted(choices, key=lambda change: change.rank(arguments.seed))[: arguments.count]

    targets = [f"svt_{folder}_test" for folder in arguments.folders]
    copies: queue.Queue[pathlib.Path] = queue.Queue()
    for number in range(arguments.jobs):
        copy = prepare_copy(number, targets)
        if number == 0:
            for target in targets:
                build = copy / "build" / "mutants"  # paths that ccache rewrote are seen from there
                if run([str(build / "bin" / target)], build, 3600) != "passed":
                    sys.exit(f"mutants: {target} fails as it is")
        copies.put(copy)

    def attempt(change: Change) -> str:
        copy = copies.get()
        try:
            return try_change(copy, change, arguments.seconds)
        finally:
            copies.put(copy)

    noticed, survived = 0, 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for change, outcome in zip(chosen, pool.map(attempt, chosen)):
            noticed += outcome in ("failed", "slow")
            survived += outcome == "passed"
            if outcome == "passed":
                print(f"survived: {change.told()}", flush=True)
    print(f"mutants: {noticed} of {noticed + survived} noticed ({100 * noticed / max(noticed + survived, 1):.0f} %)")
    return 1 if survived * 10 > noticed + survived else 0


if __name__ == "__main__":
    sys.exit(main())
