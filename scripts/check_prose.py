#!/usr/bin/env python3
"""Checks the English of documents, comments and messages: idioms that a stranger has to translate, and long sentences.

The rules are those of docs/dev/english.md. Each finding names file, line, rule and the words. Markdown is read without
code and generated tables; C++ and TypeScript as comments and strings of at least four words.

  scripts/check_prose.py              all files
  scripts/check_prose.py FILE...      these files
  scripts/check_prose.py --count      the number of findings per file, largest first
"""

import argparse
import re
import subprocess
import sys
from pathlib import Path
from typing import Iterator, NamedTuple

ROOT = Path(__file__).resolve().parent.parent
MAX_WORDS = 35

VERBS = (
    r"(?:is|are|was|were|has|have|had|can|cannot|must|may|does|do|goes|gets|lies|stands|stays|comes"
    r"|counts|follows|fits|"
    r"takes?|refuses?|covers?|refers?)"
)
# Places where a clause begins: after a stop, or a conjunction.
CLAUSE = r"(?:^|[.:;,(] |\b(?:and|but|or|that|since|because|so|if|where|when) )"

# Name, what to write instead, pattern. Patterns see one sentence, without code and links.
RULES = [
    ("what", "name the thing", CLAUSE + r"[Ww]hat\b(?! (?:is|are|was|if|about)\b[^.;:]*\?)(?=[^?]*$)"),
    (
        "of-what",
        "name the thing",
        r"\bwhat of\b|\b(?:of|with|by|from|for|beside|behind|beyond|all|than|as|into|on|in|to) what\b",
    ),
    ("who", "name the subject", r"^[Ww]ho (?!\w+ \w+\?)[^?]*$"),
    ("which", "name the subject", r"^[Ww]hich (?![^.]*\?)"),
    ("of-first", "begin with the subject", r"^Of (?!course\b)"),
    (
        "participle-first",
        "name the subject",
        r"^(?:Looked|Told|Called|Kept|Drawn|Written|Taken|Asked|Left|Held) (?:for|by|from|in|with|of|at|to)\b",
    ),
    (
        "told",
        "report, list, print, warn",
        r"\b(?:is|are|be|was|were|been|being|it) told\b|\btold (?:apart|by|of|in|to)\b"
        r"|\b[Tt]ells? (?!apart)(?:of|that|what|which|how|where|whether|its|their|the)\b|\btells? apart\b",
    ),
    (
        "so-many",
        "the number of; up to",
        r"\bso (?:many|much)\b(?! (?:as|that|smaller|larger|faster|more)\b)|\bso (?:thick|wide|deep|high|long"
        r"|large) (?:may|might|must|can)\b|\beach so\b",
    ),
    (
        "is-no",
        "is not a; cannot be",
        r"(?<![Tt]here )\b(?:is|are|was|were|be) (?:no|none)\b(?! (?:longer|more|less|larger|smaller|later"
        r"|other|doubt|worse|better|finer|coarser))|\b(?:has|have) none\b",
    ),
    ("by-that", "therefore", r"\bby that\b"),
    (
        "per",
        "per",
        r"\b(?:bytes?|bits?|[kMG]B|ms|seconds?|minutes?|rows?|lines?|times|files?|samples?|voxels?|triangles?"
        r"|objects?|numbers?|labels?|values?|words?|points?|pixels?|features?|[Oo]ne \w+) an? (?!few\b|time\b"
        r"|part\b|single\b|second\b|third\b|half\b|quarter\b|day\b|little\b|lot\b|given\b|copy\b|list\b|set\b"
        r"|new\b|program\b|user\b|reader\b|person\b|query\b)(?:voxel|building|feature|label|sample|tile"
        r"|object|slice|member|line|row|column|room|root|class|pixel|file|page|vertex|triangle|point|ray"
        r"|brick|level|storey|component|core|thread|process|house|city|value|side|face|scalar|solid|second"
        r"|minute|hour|year|m2|m3|metre|kilometre|square)\b",
    ),
    ("alone", "only X", r"\balone\b"),
    ("wish", "by default, on request, optional", r"\b(?:by|at|on|no|the|every|own) wish\b|\bwish(?:es)?\b"),
    ("all-the-same", "nevertheless, or nothing", r"\ball the same\b|\bbut for\b|\beven so\b"),
    ("at-times", "sometimes", r"\bat times\b"),
    (
        "for-because",
        "because",
        r", for (?:(?:a|an|the|it|they|this|each|all|its|their|nobody|nothing|there|what|of|no|most|some|in"
        r"|where|by) )(?:[\w'-]+ ){0,6}?(?:is|are|lies|has|have|does|do|hangs|can|cannot|comes|stands|would"
        r"|needs)\b",
    ),
    (
        "beside-which",
        "next to it; no neighbour",
        r"\bbeside which\b|\bas long as when\b|\bgoes? on without\b|\bcan show\b|\bof that\b",
    ),
    ("leave-be", "ignore; tolerate", r"\bleaves? [\w ]{1,20} be\b|\blet be\b"),
    ("hangs", "depends on", r"\bhangs? (?:on|from|upon)\b"),
    ("kept", "an existing; a maintained", r"\ba kept\b|\bdone and\b|\bkept (?:set|views)\b"),
    ("both-cut", "state the condition", r"\bno \w+ across\b"),
    ("said", "state, list, print", r"\b(?:is|are|be|was|were) said\b|\bsays it\b|\bsaid so\b"),
    ("nothing-but", "only", r"\bnothing but\b|\bnone but\b"),
    (
        "stranger",
        "plain words",
        r"\bby and by\b|\bfor good\b|\bin turns\b|\bwherefore\b|\btherein\b|\bthereof\b|\bgives? out\b",
    ),
]
COMPILED = [(name, remedy, re.compile(pattern)) for name, remedy, pattern in RULES]

GENERATED = re.compile(r"<!-- (BEGIN|END) \w+ -->|<!-- \w+: (begin|end) -->")


class Passage(NamedTuple):
    """Text that belongs together, and the line that it begins in."""

    line: int
    text: str


class Finding(NamedTuple):
    """A place that breaks a rule."""

    line: int
    rule: str
    remedy: str
    words: str


def plain(text: str) -> str:
    """The text without code, addresses and marks of Markdown."""
    text = re.sub(r"`[^`]*`", "X", text)
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"https?://\S+", "X", text)
    text = re.sub(r"\{[^}]*\}", "X", text)
    return re.sub(r"[*_]{1,3}(?=\S)|(?<=\S)[*_]{1,3}", "", text)


def sentences(text: str) -> list[str]:
    marked = re.sub(r"\b(e\.g|i\.e|etc|vs|cf|approx|Fig|No)\.", lambda match: match[0][:-1], plain(text))
    return [part.strip() for part in re.split(r"(?<=[.!?])[)\"']?\s+", marked) if part.strip()]


def findings_of(passage: Passage) -> Iterator[Finding]:
    for sentence in sentences(passage.text):
        words = len(re.findall(r"[A-Za-z][\w'-]*", sentence))
        if words > MAX_WORDS:
            yield Finding(passage.line, "long", f"{words} words; split it", " ".join(sentence.split()[:8]) + " ...")
        for name, remedy, pattern in COMPILED:
            match = pattern.search(sentence)
            if match:
                start = max(0, match.start() - 20)
                yield Finding(passage.line, name, remedy, sentence[start : match.end() + 30])


def markdown_passages(text: str) -> Iterator[Passage]:
    is_code = is_generated = False
    block: list[str] = []
    first = 0

    def flush() -> Iterator[Passage]:
        if block:
            yield Passage(first, " ".join(block))
            block.clear()

    for number, line in enumerate(text.splitlines(), 1):
        marker = GENERATED.search(line)
        if line.lstrip().startswith("```"):
            yield from flush()
            is_code = not is_code
        elif marker:
            yield from flush()
            is_generated = "BEGIN" in line or "begin" in line
        elif is_code or is_generated:
            continue
        elif not line.strip() or line.startswith("#"):
            yield from flush()
            if line.startswith("#"):
                yield Passage(number, line.lstrip("# "))
        elif line.startswith("|"):
            yield from flush()
            for cell in line.strip("| ").split("|"):
                yield Passage(number, cell.strip())
        else:
            if re.match(r"\s*(?:[-*]|\d+\.) ", line):
                yield from flush()
                line = re.sub(r"^\s*(?:[-*]|\d+\.) ", "", line)
            if not block:
                first = number
            block.append(line.strip())
    yield from flush()


def comment_passages(text: str) -> Iterator[Passage]:
    """Comments of whole lines, those behind code, and strings of at least four words."""
    block: list[str] = []
    first = 0
    for number, line in enumerate(text.splitlines(), 1):
        whole = re.match(r"\s*//[/!]?<?\s?(.*)$", line) or re.match(r"\s*/?\*+ ?(.*?)(?:\*/)?$", line)
        if whole:
            words = whole[1]
            if (
                re.match(r"\\(?:param|return|tparam|file)|@\w+| - |Cost:|Threads:|Errors:|Memory:", words.strip())
                or not words.strip()
            ):
                if block:
                    yield Passage(first, " ".join(block))
                block = []
            words = re.sub(r"\\(?:param|tparam) \w+(?:, \w+)*|\\(?:return|file)|@\w+", "", words).strip()
            if words and re.match(r"[\w`(\"'<#-]", words):
                if not block:
                    first = number
                block.append(words)
            continue
        if block:
            yield Passage(first, " ".join(block))
            block = []
        behind = re.search(r";?\s+///?<?\s(.*)$", re.sub(r'"(?:[^"\\]|\\.)*"', '""', line))
        if behind:
            yield Passage(number, behind[1])
    if block:
        yield Passage(first, " ".join(block))
    one = r'"(?:[^"\\\n]|\\.)*"'
    for match in re.finditer(rf"{one}(?:\s*\n\s*{one})*", text):
        words = re.sub(r'"\s*\n\s*"', "", match[0])[1:-1].replace("\\n", " ").replace('\\"', "'")
        if len(re.findall(r"[A-Za-z]{2,}", words)) >= 4 and "//" not in words:
            yield Passage(text.count("\n", 0, match.start()) + 1, words)


def passages_of(path: Path, text: str) -> Iterator[Passage]:
    return markdown_passages(text) if path.suffix == ".md" else comment_passages(text)


# Documents, and the sources that ship; comments of tests are free.
PATTERNS = [
    "*.md",
    "svt/*.[ch]pp",
    "apps/*.[ch]pp",
    "python/*.[ch]pp",
    "python/svt/*.py",
    "web/wasm/*.[ch]pp",
    "web/viewer/src/*.ts",
]


def is_checked(name: str) -> bool:
    # The text of the Contributor Covenant is quoted.
    return not re.search(r"_test\.[ch]pp$|\.test\.ts$|^CODE_OF_CONDUCT\.md$", name) and (ROOT / name).is_file()


def all_files() -> list[Path]:
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard", *PATTERNS],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    ).stdout.split("\n")
    return [ROOT / name for name in sorted(set(listed)) if name and is_checked(name)]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--count", action="store_true")
    arguments = parser.parse_args()
    total = 0
    counts = []
    for path in arguments.files or all_files():
        found = [
            finding
            for passage in passages_of(path, path.read_text(encoding="utf-8"))
            for finding in findings_of(passage)
        ]
        total += len(found)
        counts.append((len(found), path))
        if not arguments.count:
            for line, rule, remedy, words in found:
                print(f"{path}:{line}: {rule} ({remedy}): {words}")
    if arguments.count:
        for count, path in sorted(counts, reverse=True, key=lambda row: row[0]):
            if count:
                print(f"{count:5} {path}")
    if total:
        print(f"prose: {total} places; the rules: docs/dev/english.md", file=sys.stderr)
    return 1 if total else 0


if __name__ == "__main__":
    sys.exit(main())
