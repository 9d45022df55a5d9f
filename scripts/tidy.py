#!/usr/bin/env python3
"""clang-tidy over all sources, with the checks of .clang-tidy; a finding is a failure.

    scripts/tidy.py [--only PATTERN] [--analyzer]

It reads what the preset `tidy` compiles: several sources of a folder at once, with precompiled headers of clang, so that
what they share is read once. Units without findings are remembered for all checkouts of the user, in
$XDG_CACHE_HOME/svt/tidy, by the digest of their preprocessed text, command and checks.
  --only PATTERN  only units with a source whose path matches the regular expression
  --analyzer      clang's path-sensitive analyzer instead, source by source, over all but the tests
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
INCLUDED = re.compile(r'#include "([^"]+\.cpp)"')
# Tests may be slow, build texts by parts and leave results unused.
CLEAN = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "svt" / "tidy"
NOT_IN_TESTS = (
    "-performance-*,-modernize-use-nodiscard,-bugprone-suspicious-missing-comma,-bugprone-string-constructor,"
    "-bugprone-macro-parentheses,-bugprone-integer-division"
)
FINDING = re.compile(r"^(\S+?):(\d+):\d+: (warning|error): ")


def sources_of(unit: pathlib.Path) -> list[pathlib.Path]:
    """The sources of the project that a unit compiles: itself, or those that a unity source includes."""
    if "Unity" not in unit.parts:
        return [unit]
    return [pathlib.Path(path) for path in INCLUDED.findall(unit.read_text(encoding="utf-8"))]


def units_of(build: pathlib.Path) -> list[tuple[pathlib.Path, str, list[pathlib.Path]]]:
    """(unit, its command, its sources) of all that is compiled from sources of the project."""
    units = []
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        unit = pathlib.Path(entry["file"])
        sources = sources_of(unit)
        if sources and all(path.is_relative_to(ROOT) and not path.is_relative_to(ROOT / "build") for path in sources):
            units.append((unit, entry["command"], sources))
    return units


def is_test(path: pathlib.Path) -> bool:
    return path.stem.endswith("_test") or path.is_relative_to(ROOT / "tests")


def precompiled_headers(build: pathlib.Path) -> list[str]:
    """The commands that compile headers for all units."""
    entries = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    return [entry["command"] for entry in entries if "cmake_pch.hxx" in pathlib.Path(entry["file"]).name]


def preprocessed(command: str, build: pathlib.Path) -> bytes:
    """Text that the compiler sees, without the path of the checkout; the error where it cannot be read."""
    words = [word for word in shlex.split(command.replace("-Xclang -emit-pch", "")) if word != "-c"]
    if "-o" in words:
        del words[words.index("-o") : words.index("-o") + 2]
    done = subprocess.run([*words, "-E", "-o", "-"], cwd=build, capture_output=True)
    return (done.stdout if done.returncode == 0 else done.stderr + os.urandom(16)).replace(str(ROOT).encode(), b"")


def forget_old() -> None:
    """Removes marks that no run has used for 60 days."""
    for mark in CLEAN.glob("*"):
        if time.time() - mark.stat().st_mtime > 60 * 86400:
            mark.unlink(missing_ok=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="")
    parser.add_argument("--analyzer", action="store_true")
    arguments = parser.parse_args()
    if shutil.which("clang-tidy") is None:
        sys.exit("tidy: clang-tidy is missing; scripts/setup.sh checks installs it")
    build = ROOT / "build" / "tidy"
    configure = ["cmake", "--preset", "tidy"]
    if arguments.analyzer:  # it looks only at functions of the file that it is given
        build = ROOT / "build" / "tidy-analyzer"
        configure += ["-B", str(build), "-DSVT_UNITY=OFF"]
    subprocess.run(configure, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    precompiled = ["svt_precompiled", "svt_precompiled_cold", "svt_precompiled_test", "svt_version"]
    # clang refuses a precompiled header that is older than a system header in it; ccache may hand one out that is.
    for path in build.glob("CMakeFiles/*/cmake_pch.hxx.pch"):
        path.unlink()
    subprocess.run(
        ["cmake", "--build", str(build), "--target", *precompiled],
        cwd=ROOT,
        check=True,
        stdout=subprocess.DEVNULL,
        env={**os.environ, "CCACHE_DISABLE": "1"},
    )

    common = hashlib.sha256((ROOT / ".clang-tidy").read_bytes())
    common.update(subprocess.run(["clang-tidy", "--version"], capture_output=True, check=True).stdout)
    for command in precompiled_headers(build):
        common.update(preprocessed(command, build))
    CLEAN.mkdir(parents=True, exist_ok=True)

    def check(unit: pathlib.Path, command: str, sources: list[pathlib.Path]) -> list[str]:
        digest = common.copy()
        digest.update(
            command.replace(str(ROOT), "").encode() + bytes([arguments.analyzer]) + preprocessed(command, build)
        )
        mark = CLEAN / digest.hexdigest()
        if mark.exists():
            mark.touch()
            return []
        tidy = ["clang-tidy", "-p", str(build), "--quiet"]
        if all(is_test(path) for path in sources):
            tidy.append(f"--checks={NOT_IN_TESTS}")
        if arguments.analyzer:
            tidy.append("--checks=-*,clang-analyzer-*,-clang-analyzer-optin.performance.Padding")
        done = subprocess.run([*tidy, str(unit)], cwd=ROOT, capture_output=True, text=True)
        findings = sorted({line.replace(f"{ROOT}/", "") for line in done.stdout.splitlines() if FINDING.match(line)})
        # A finding in a header of the system names no source of the tree.
        findings = [f"{line} (from {unit.name})" if line.startswith("/") else line for line in findings]
        if done.returncode != 0 and not findings:
            findings = [f"{unit}: clang-tidy failed: {done.stderr.strip()}"]
        if not findings:
            mark.touch()
        return findings

    units = [unit for unit in units_of(build) if any(re.search(arguments.only, str(path)) for path in unit[2])]
    if arguments.analyzer:
        units = [unit for unit in units if not all(is_test(path) for path in unit[2])]
    print(f"tidy: {len(units)} units, {sum(len(sources) for _, _, sources in units)} sources", flush=True)
    found = set()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for findings in pool.map(lambda unit: check(*unit), units):
            for finding in findings:
                if finding not in found:
                    print(finding, flush=True)
            found.update(findings)
    forget_old()
    print(f"tidy: {len(found)} findings")
    return 1 if found or not units else 0


if __name__ == "__main__":
    sys.exit(main())
