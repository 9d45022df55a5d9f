#!/usr/bin/env python3
"""Fails if a source of the library, the programs or the bindings calls what depends on the locale of the process, maps a
file that others may shorten, makes an object per thread, or uses an algorithm that the tool chain of the page lacks.

    scripts/check_banned_calls.py [ROOT]

A host may set a locale with a decimal comma: Qt programs do, and Python after locale.setlocale(). The C functions that read
or print numbers then expect or write "1,5". A mapped file that another program shortens ends the process with SIGBUS. Tests
may call them.
"""
import re
import sys
from pathlib import Path

from findings import report

FOLDERS = ["svt", "apps", "python/binding", "web/wasm"]
ENDINGS = {".cpp", ".hpp", ".h"}
READS = "reads numbers by the locale of the process, and stops silently at the first wrong character"
PRINTS = "prints numbers by the locale of the process"
LETTERS = "depends on the locale of the process"
MAPS = "maps a file, whose bytes end the process with SIGBUS where another program shortens it"
PARSE = "call parseNumber() or parseInteger() of svt/core/text.hpp"
# What is banned, why, and what to do instead.
BANNED = [
    (r"\bstrto(d|f|ld|l|ll|ul|ull|imax|umax)\s*\(", READS, PARSE),
    (r"\bsto(d|f|ld|i|l|ll|ul|ull)\s*\(", READS, PARSE),
    (r"\bato(f|i|l|ll)\s*\(", READS, PARSE),
    (r"\bv?[fs]?w?scanf\s*\(", READS, PARSE),
    (
        r"""printf\s*\([^;]*?"[^"]*%[-+ #0]*[\d*]*(\.[\d*]+)?[lL]?[aAeEfFgG]""",
        PRINTS,
        "call fmt::format() or fmt::print()",
    ),
    (r"\bto_string\s*\(\s*(double|float|-?\d*\.\d|static_cast<\s*(double|float)\s*>)", PRINTS, "call fmt::format()"),
    (r"\bo?stringstream\b", PRINTS, "call fmt::format()"),
    (
        r"\bsetlocale\s*\(|\blocale::global\s*\(|\.imbue\s*\(",
        "changes the locale of the host",
        "leave the locale alone",
    ),
    (r"""\{[^{}"]*:[^{}"]*L\}(?=[^"\n]*"\s*[,)])""", PRINTS, "leave the L out of the format"),
    (r"\.as_(double|float)\s*\(", READS, PARSE),  # of pugixml
    (
        r"\bstd::is(alpha|alnum|digit|xdigit|space|upper|lower|punct|print)\s*\(",
        LETTERS,
        "call isLetter(), isDigit() or isBlank() of svt/core/text.hpp",
    ),
    (r"\bstd::to(lower|upper)\s*\(", LETTERS, "call lowerAscii() of svt/core/text.hpp"),
    (r"#include <(cctype|clocale|locale)>", LETTERS, "include svt/core/text.hpp"),
    (
        r"\bFileBytes\s*::\s*map\b|\bmmap(64)?\s*\(|#include <sys/mman\.h>",
        MAPS,
        "call FileBytes::read(), or PartFile::read() for parts of a large file",
    ),
    (
        r"\bthread_local\s+(?!(bool|int|double)\b)",
        "makes an object per thread, which ends the WebAssembly modules without threads",
        "pass the object on, or share it behind a mutex",
    ),
]
# The algorithms std::ranges::NAME that the tool chain of the page has: those of this header.
RANGES = "web/wasm/libcxx.hpp"
# Who may map, and why.
MAY_MAP = {
    "svt/core/file/file.cpp": "defines FileBytes::map()",
    "apps/cli/options/site_options.cpp": "maps a file of its own PrivateFolder, which is removed before others can find it",
}
COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.S)


def without_comments(text: str) -> str:
    """The text with comments blanked, so that lines keep their numbers."""

    def blank(match: re.Match) -> str:
        return match[0] if match[0].startswith('"') else re.sub(r"[^\n]", " ", match[0])

    return COMMENT.sub(blank, text)


def findings_in(name: str, text: str) -> list[str]:
    code = without_comments(text)
    found = []
    for pattern, reason, remedy in BANNED:
        if reason == MAPS and name in MAY_MAP:
            continue
        for match in re.finditer(pattern, code):
            line = code.count("\n", 0, match.start()) + 1
            call = " ".join(match[0].split())[:40]
            found.append(f"{name}:{line}: '{call}' {reason}; {remedy}")
    return found


def ranges_in(name: str, text: str, known: set[str]) -> list[str]:
    code = without_comments(text)
    return [
        f"{name}:{code.count(chr(10), 0, match.start()) + 1}: '{match[0]}' is not in the library of the page; "
        f"call the algorithm with two iterators, or add it to {RANGES}"
        for match in re.finditer(r"\bstd::ranges::(\w+)", code)
        if match[1] not in known
    ]


def findings(root: Path) -> list[str]:
    found = []
    header = root / RANGES
    known = set(re.findall(r"^\w+ (\w+)\(", header.read_text(encoding="utf-8"), re.M)) if header.exists() else set()
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in ENDINGS and not path.stem.endswith("_test"):
                name, text = path.relative_to(root).as_posix(), path.read_text(encoding="utf-8")
                found += findings_in(name, text) + ranges_in(name, text, known)
    return found


if __name__ == "__main__":
    sys.exit(report(findings))
