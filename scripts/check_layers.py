#!/usr/bin/env python3
"""Checks who includes whom. The table is the architecture: change it only with the reason in the commit."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
ALLOWED = {
    "core": set(),
    "model": {"core"},
    "readers": {"core", "model"},
    "mesh": {"core", "model"},
    "volume": {"core"},
    "voxelize": {"core", "mesh", "volume"},
    "render": {"core", "volume"},
    "render_gl": {"core", "volume", "render"},
    "illustrate": {"core", "model", "volume", "render"},
    "writers": {"core", "model", "volume", "illustrate"},
    "samples": {"core"},
    "serve": {"core"},
    "pipeline": {"core", "model", "readers", "mesh", "volume", "voxelize", "render", "illustrate", "writers"},
}
# Tests may reach one layer further where they compare whole chains.
ALLOWED_IN_TESTS = {"pipeline": {"samples"}, "render_gl": {"pipeline", "readers", "samples"}}
THIRD_PARTY = ("pugixml", "simdjson", "nlohmann", "fmt/", "tbb/", "GL/", "png.h", "zlib.h", "CLI/", "zip.h", "zstd", "ft2build", "EGL/", "GLES3/", "polyclipping")


def main() -> int:
    problems = []
    # A header is public once another folder includes it; the others are a folder's own business.
    public = set()
    for path in [*(ROOT / "svt").rglob("*.[ch]pp"), *(ROOT / "apps").rglob("*.[ch]pp"), *(ROOT / "bench").rglob("*.[ch]pp")]:
        for name in re.findall(r'#\s*include\s*[<"](svt/[^">]+)', path.read_text(encoding="utf-8")):
            if pathlib.Path(name).parent != path.parent.relative_to(ROOT):
                public.add(ROOT / name)
    folders = {path.name for path in (ROOT / "svt").iterdir() if path.is_dir()}
    for folder in sorted(folders - ALLOWED.keys()):
        problems.append(f"svt/{folder}: a new layer; add it to {pathlib.Path(__file__).name}")
    for path in sorted((ROOT / "svt").rglob("*.[ch]pp")):
        folder = path.parent.name
        is_test = path.stem.endswith("_test")
        allowed = ALLOWED.get(folder, set()) | {folder}
        if is_test:
            allowed |= ALLOWED_IN_TESTS.get(folder, set())
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = re.match(r'\s*#\s*include\s*[<"]([^">]+)', line)
            if not match:
                continue
            name = match.group(1)
            place = f"{path.relative_to(ROOT)}:{number}"
            if name.startswith("svt/"):
                layer = name.split("/")[1]
                if layer not in allowed:
                    problems.append(f"{place}: {folder} may not include {layer} ({name})")
                if not is_test and name.endswith("_test.hpp"):
                    problems.append(f"{place}: includes a test header ({name})")
            elif path in public and name.startswith(THIRD_PARTY):
                problems.append(f"{place}: third-party include in a public header ({name})")
        # Those of SIMD kernels are included once for each set of instructions, with a guard that knows which.
        guard = "HWY_TARGET_TOGGLE" if path.name.endswith("-inl.hpp") else "#pragma once"
        if path.suffix == ".hpp" and guard not in path.read_text(encoding="utf-8"):
            problems.append(f"{path.relative_to(ROOT)}: no {guard}")
    for problem in problems:
        print(f"layers: {problem}", file=sys.stderr)
    if not problems:
        print(f"layers: {len(folders)} folders, all includes one way")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
