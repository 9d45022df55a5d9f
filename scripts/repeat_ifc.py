#!/usr/bin/env python3
"""Writes an IFC file that holds another one many times, side by side: input of any size for measurements.

  scripts/repeat_ifc.py IN.ifc OUT.ifc --megabytes 500 [--step 30]

Each copy has records and GlobalIds of its own; all hang below the project of the first one, which stays the only one. The
sites stand --step metres apart along x and y. The bytes depend on the input and the options alone.
"""
import argparse
import math
import re
import sys
from pathlib import Path

RECORD = re.compile(rb"#(\d+)\s*=\s*([A-Z0-9_]+)\s*\(", re.I)
REFERENCE = re.compile(rb"#(\d+)")
SHARED = {
    b"IFCPROJECT",
    b"IFCUNITASSIGNMENT",
    b"IFCSIUNIT",
    b"IFCCONVERSIONBASEDUNIT",
    b"IFCMEASUREWITHUNIT",
    b"IFCDIMENSIONALEXPONENTS",
    b"IFCGEOMETRICREPRESENTATIONCONTEXT",
    b"IFCGEOMETRICREPRESENTATIONSUBCONTEXT",
    b"IFCOWNERHISTORY",
    b"IFCPERSON",
    b"IFCORGANIZATION",
    b"IFCPERSONANDORGANIZATION",
    b"IFCAPPLICATION",
}
LETTERS = b"0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$"


def split_outside_texts(line):
    """Parts of a record: at even places what is no text."""
    return re.split(rb"('(?:[^']|'')*')", line)


def records_of(data):
    """(number, type, record) in the order of the file; records end at a semicolon outside of texts."""
    found, current = [], b""
    for i, part in enumerate(split_outside_texts(data)):
        if i % 2 == 1:
            current += part
            continue
        pieces = part.split(b";")
        for piece in pieces[:-1]:
            record = (current + piece).strip()
            current = b""
            head = RECORD.match(record)
            if head:
                found.append((int(head[1]), head[2].upper(), record + b";"))
        current += pieces[-1]
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("input", type=Path)
    parser.add_argument("output", type=Path)
    parser.add_argument("--megabytes", type=float, default=500)
    parser.add_argument("--step", type=float, default=30, help="distance of copies, in units of the file")
    arguments = parser.parse_args()
    text = arguments.input.read_bytes()
    begin, end = text.find(b"DATA;") + len(b"DATA;"), text.rfind(b"ENDSEC;")
    if begin < len(b"DATA;") or end < begin:
        sys.exit(f"{arguments.input}: no STEP file with a DATA section")
    records = records_of(text[begin:end])
    by_number = {number: (kind, record) for number, kind, record in records}

    def reference(record, place):
        values = re.findall(rb"#\d+|\$|\*|'(?:[^']|'')*'|[^,()]+|\([^()]*\)", record.split(b"(", 1)[1])
        return int(values[place][1:]) if place < len(values) and values[place].startswith(b"#") else None

    def follow(number, place):
        return reference(by_number[number][1], place) if number in by_number else None

    sites = [number for number, kind, _ in records if kind == b"IFCSITE"]
    moved = {point for site in sites if (point := follow(follow(follow(site, 5), 1), 0)) is not None}
    if not moved:
        sys.exit(f"{arguments.input}: no site with a place, so copies would lie in one another")
    shared = {number for number, kind, _ in records if kind in SHARED}
    # What shared records use is shared, but not what uses them.
    stack = list(shared)
    while stack:
        for other in map(int, REFERENCE.findall(b"".join(split_outside_texts(by_number[stack.pop()][1])[::2]))):
            if other in by_number and other not in shared:
                shared.add(other)
                stack.append(other)
    highest = max(by_number) + 1
    templates = []  # of a copy: parts of a record; None: the place of a site
    for number, _, record in records:
        if number in shared:
            continue
        if number in moved:
            templates.append((None, number))
            continue
        templates.append((split_outside_texts(record), number))
    size = len(text)
    count = max(1, math.ceil(arguments.megabytes * 1e6 / size))
    across = math.ceil(math.sqrt(count))
    with arguments.output.open("wb") as out:
        out.write(text[:end].rstrip() + b"\n")
        for copy in range(1, count):
            shift = copy * highest
            mark = bytes([LETTERS[copy // 4096 % 64], LETTERS[copy // 64 % 64], LETTERS[copy % 64]])
            lines = []
            for parts, number in templates:
                if parts is None:
                    x, y = copy % across * arguments.step, copy // across * arguments.step
                    lines.append(b"#%d=IFCCARTESIANPOINT((%.6f,%.6f,0.));" % (number + shift, x, y))
                    continue
                pieces = []
                for i, part in enumerate(parts):
                    if i % 2 == 0:
                        part = REFERENCE.sub(
                            lambda m: m[0] if int(m[1]) in shared else b"#%d" % (int(m[1]) + shift), part
                        )
                    elif i == 1 and len(part) == 24 and parts[0].rstrip().endswith(b"("):  # a GlobalId
                        part = b"'" + mark + part[4:]
                    pieces.append(part)
                lines.append(b"".join(pieces))
            out.write(b"\n".join(lines) + b"\n")
        out.write(text[end:])
    print(f"{arguments.output}: {count} times {arguments.input}, {arguments.output.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
