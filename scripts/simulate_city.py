#!/usr/bin/env python3
"""A city that nobody has built: the plan, the run on a cluster, the index and the first view of 10^6 or 10^7 buildings, by
simulation from a measured small one. Prints a row of the table in docs/dev/city.md.

    simulate_city.py CITY BUILDINGS [--nodes 64] [--core-seconds SECONDS] [--seed 1]

CITY is the folder of a merged city, whose tiles (buildings, bytes of each detail) are the sample. --core-seconds is what its
run took (user time); else 1.3 ms a building. Nothing of it is random beyond the seed.
"""
import argparse
import heapq
import json
import math
import os
import random
import struct


def varint(data, at):
    value = shift = 0
    while True:
        byte = data[at]
        at += 1
        value |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            return value, at


def unzigzag(value):
    return (value >> 1) ^ -(value & 1)


def read_index(path):
    """Entries of index.bin, read as docs/formats/city.md says: (detail, level, pack, offset, size, buildings)."""
    data = open(path, "rb").read()
    assert data[:8] == b"svtindx\0"
    count, size = struct.unpack_from("<IQ", data, 12)
    start, entries, pages = 32 + size, [], []

    def refs(block):
        for at in range(0, len(block), 56):
            detail, inner, _, length, offset = struct.unpack_from("<BBHIQ", block, at)
            page = data[start + offset : start + offset + length]
            pages.append((detail, length, inner))
            if inner:
                refs(page)
                continue
            (rows,) = struct.unpack_from("<H", page, 2)
            here, pack = 4, 0
            for _ in range(rows):
                numbers = []
                for _ in range(8):
                    number, here = varint(page, here)
                    numbers.append(number)
                pack += unzigzag(numbers[2])
                entries.append((page[0], numbers[1], pack, numbers[3] * 8, numbers[4], numbers[7]))
            assert here == len(page)

    assert size == 56 * count
    refs(data[32:start])
    return entries, pages, len(data)


def first_view(city, entries, pages, screen=1080):
    """Requests and bytes until all of the city is drawn at most a pixel a column, as seen from above."""
    across = max(city["box"][3] - city["box"][0], city["box"][4] - city["box"][1])
    top = city["top"]["detail"]
    detail = next(d for d in range(top, -1, -1) if d == 0 or city["details"][d]["spacing"] <= across / screen)
    detail = max(detail, 2)  # buildings are fetched when one comes nearer
    while True:
        ranges = sorted((e[2], e[3], e[4]) for e in entries if e[0] == detail)
        requests, last = 0, None
        for pack, offset, size in ranges:
            if last is None or last[0] != pack or offset > last[1] + 4096:
                requests += 1
            last = (pack, offset + size)
        page_bytes = sum(p[1] for p in pages if p[0] >= detail)
        first = os.path.getsize("city.json") + 32 + 56 * len(pages) + city["top"]["bytes"]
        everything = first + page_bytes + sum(r[2] for r in ranges) * (detail != top)
        requests = 3 + 1 + requests * (detail != top)
        if everything <= 4e6 and requests <= 32 or detail == top:
            pixels = city["details"][detail]["spacing"] / (across / screen)
            return first, requests, everything, detail, pixels
        detail += 1  # a cap grows the pixel error, nothing fails


def makespan(costs, nodes, start=0.5):
    """Seconds until all tasks ended; a free core takes the next one after `start` seconds."""
    free = [0.0] * nodes
    for cost in costs:
        heapq.heappush(free, heapq.heappop(free) + start + cost)
    return max(free)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("city")
    parser.add_argument("buildings", type=int)
    parser.add_argument("--nodes", type=int, default=64)
    parser.add_argument("--core-seconds", type=float)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    os.chdir(given.city)
    city = json.load(open("city.json"))
    entries, pages, index_bytes = read_index("index.bin")
    first, requests, everything, detail, pixels = first_view(city, entries, pages)
    print(
        f"measured: {city['buildings']} buildings, {city['tiles']} tiles, index {index_bytes / 1e3:.1f} kB, ids "
        f"{os.path.getsize('ids.bin') / 1e6:.2f} MB; first picture 3 requests, {first / 1e3:.0f} kB; first view "
        f"{requests} requests, {everything / 1e6:.2f} MB, detail {detail}, {pixels:.2f} pixels a column"
    )
    for d in city["details"]:
        print(f"  detail {d['detail']}: {d['spacing']} m, {d['tiles']} tiles, {d['bytes'] / 1e3:.0f} kB")

    dice = random.Random(given.seed)
    scale = given.buildings / city["buildings"]
    seconds = given.core_seconds or 0.0013 * city["buildings"]
    sample = [e for e in entries if e[0] == 0]
    tiles = [dice.choice(sample)[5] for _ in range(int(city["tiles"] * scale))]
    # Of a tile: log-normal around its buildings, as neighbours and caches are; one of a thousand takes a minute more.
    each = seconds / city["buildings"]
    costs = [n * each * dice.lognormvariate(-0.08, 0.4) + (60 if dice.random() < 0.001 else 0) for n in tiles]
    packs, cost, expected = [], 0.0, 0.0
    for n, c in zip(tiles, costs):
        if expected + n * each > 5:  # squares are half full on average
            packs.append(cost)
            cost = expected = 0.0
        cost += c
        expected += n * each
    packs.append(cost)
    tasks = max(1, min(1000, len(packs), int(sum(tiles) * each / 300) + 1))
    elements = [sum(packs[len(packs) * t // tasks : len(packs) * (t + 1) // tasks]) for t in range(tasks)]
    failed = [c for c in elements if dice.random() < 0.1]
    leaf = sum(p[1] for p in pages if p[0] <= 1) * scale
    print(
        f"simulated: {given.buildings} buildings, {len(tiles)} tiles, {len(packs)} packs, {tasks} tasks; "
        f"{sum(costs) / 3600:.1f} core hours; 2 cores {makespan(packs, 2) / 3600:.2f} h; {given.nodes} cores "
        f"{makespan(elements, given.nodes) / 60:.1f} min, with 10 % failed and run again "
        f"{(makespan(elements, given.nodes) + makespan(failed, given.nodes)) / 60:.1f} min; requests to the scheduler 2, "
        f"again 2; index {(leaf * 1.1 + 20e3) / 1e6:.2f} MB in {math.ceil(leaf / 16e3)} leaves, ids "
        f"{given.buildings * 24.2 / 1e6:.0f} MB; plan: features {given.buildings * 32 / 1e6:.0f} MB, tiles "
        f"{len(tiles) * 40 / 1e6:.2f} MB; packs {city['packs']['bytes'] * scale / 1e9:.1f} GB"
    )


main()
