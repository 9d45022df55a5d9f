#!/usr/bin/env python3
"""Times of the Python module next to those of memory, as a table in Markdown: the figures of docs/python/README.md.

    PYTHONPATH=build/release/python python/tests/timing.py [MODEL]     default: the generated house
"""
import os
import sys
import tempfile
import time

import numpy as np

import svt


def best(work, times=7):
    """Elapsed seconds and processor seconds of all cores, the best of each."""
    seconds = []
    for _ in range(times):
        start, cores = time.perf_counter(), time.process_time()
        result = work()
        seconds.append((time.perf_counter() - start, time.process_time() - cores))
        del result
    return min(clock for clock, _ in seconds), min(cores for _, cores in seconds)


def main():
    with tempfile.TemporaryDirectory() as folder:
        model = sys.argv[1] if len(sys.argv) > 1 else os.path.join(folder, "house.gml")
        if len(sys.argv) < 2:
            svt.sample("house", model)
        volume = svt.build(model, dimension=(800, 700, 400))
        rows = []
        array = volume.dense()
        # The arrays are new each time: most of a copy is the kernel giving pages, for both.
        dense, copy, again = best(volume.dense), best(array.copy), best(lambda: np.copyto(array, array[::-1]))
        size = array.nbytes / 1e9
        for name, times in (
            (f"`dense()`, {volume.dtype} of 800 x 700 x 400 ({1000 * size:.0f} MB)", dense),
            ("`array.copy()` of the same by numpy", copy),
            ("the same into memory that is there already", again),
        ):
            rows.append((name, times, f"{size / times[0]:.1f} GB/s"))
        random = np.random.default_rng(1)
        points = volume.box[0] + random.random((1_000_000, 3)) * (volume.box[1] - volume.box[0])
        rows.append(("`sample()` of a million random points", best(lambda: volume.sample(points)), ""))
        order = points[np.lexsort(volume.index(points).astype(int).T[:2])]
        rows.append(("`sample()` of the same in order of columns", best(lambda: volume.sample(order)), ""))
        directions = random.normal(size=(100_000, 3))
        volume.rays(points[:1], directions[:1])
        rows.append(
            ("`rays()`, 100,000 random ones from inside", best(lambda: volume.rays(points[:100_000], directions)), "")
        )
        rows.append(
            (
                "`from_dense()` of the whole volume",
                best(lambda: svt.Volume.from_dense(array, volume.labels, like=volume), 3),
                "",
            )
        )
        rows.append(("`render(size=(1280, 720))`", best(lambda: volume.render(size=(1280, 720))), ""))
        rows.append(("`section('z=1.2')`, exact", best(lambda: volume.section("z=1.2")), ""))
    print("| call | by the clock | of one core | |\n|---|---|---|---|")
    for name, (clock, cores), note in rows:
        print(f"| {name} | {1000 * clock:.0f} ms | {1000 * cores:.0f} ms | {note} |")


if __name__ == "__main__":
    main()
