"""Makes the tables of docs/dev/performance.md from the benchmark figures. Used by bench.py."""

HOUSE = "FZK-Haus"
GRID = "800x700x400"
OPAQUE, TRANSLUCENT = "1280x720-pixels", "1920x1080-pixels"
ORDER = ["read", "ifc", "voxelize", "render", "stages", "scaling", "commands", "page", "profile"]


def all_rows(figures):
    return [row for part in ORDER for row in figures["parts"].get(part, {}).get("results", [])]


def ratio(rows, row, name):
    """Ratio of another program's time to ours."""
    return next(b["ratio"] for b in rows[row]["beside"] if b["name"].startswith(name))


def stage(rows, name, house, key):
    row = rows[f"{name}/{house}/{GRID}"]
    return row["ours"]["median_s"] if key == "time" else row["result_bytes"] / 1e6


def only(house, value):
    """Of what is measured on one input alone; None for the other column."""
    return value() if house == "fzk-haus" else None


def largest(rows, house, key):
    return rows[f"scaling/{house}/4000x3500x2000"][key]


def page_row(rows, house, read):
    return only(house, lambda: read(rows["page/fzk-haus"]))


# Goal, source of the figure, format, required value (or one for each house), ideal value, whether more is better.
GOALS = [
    (
        "voxelize, 800 x 700 x 400: times faster than VTK's stencils with their images",
        lambda r, h: ratio(r, f"voxelize/{h}/{GRID}", "VTK stencils + images"),
        "{:.1f} x",
        (80, 60),
        150,
        True,
    ),
    (
        "the same beside the stencils alone",
        lambda r, h: next(b["ratio"] for b in r[f"voxelize/{h}/{GRID}"]["beside"] if b["name"] == "VTK stencils"),
        "{:.1f} x",
        None,
        None,
        True,
    ),
    (
        "model file to `.svt` on disk",
        lambda r, h: stage(r, "model-file-to-.svt", h, "time"),
        "{:.3f} s",
        (0.07, 0.09),
        0.05,
        False,
    ),
    (
        "ready to draw from a `.svt`, as `svt render` does: opened, bricks made",
        lambda r, h: stage(r, "ready-to-draw", h, "time"),
        "{:.3f} s",
        (0.05, 0.08),
        0.02,
        False,
    ),
    (
        "`svt render` of a `.svt` with voxels, the whole command, 1280 x 720, one ray a pixel",
        lambda r, h: only(h, lambda: r["command/svt-render"]["ours"]["median_s"]),
        "{:.3f} s",
        0.10,
        0.05,
        False,
    ),
    ("size on disk, lossless", lambda r, h: stage(r, "write-.svt", h, "size"), "{:.2f} MB", 1, 0.1, False),
    ("size in memory, ready to cast", lambda r, h: stage(r, "make-bricks", h, "size"), "{:.2f} MB", 2, 1, False),
    (
        "opaque frame, 1280 x 720, lit: times faster than VTK's CPU ray caster, unlit",
        lambda r, h: ratio(r, f"opaque-frame/{h}/{GRID}-{OPAQUE}", "VTK fixed-point"),
        "{:.1f} x",
        15,
        25,
        True,
    ),
    (
        "the same beside the paper's method on the CPU",
        lambda r, h: ratio(r, f"opaque-frame/{h}/{GRID}-{OPAQUE}", "dense texture"),
        "{:.1f} x",
        None,
        None,
        True,
    ),
    (
        "fully translucent frame, 1920 x 1080",
        lambda r, h: 1 / r[f"translucent-frame/{h}/{GRID}-{TRANSLUCENT}"]["ours"]["median_s"],
        "{:.1f} fps",
        20,
        30,
        True,
    ),
    (
        "1000 x 1200 x 600 instead of 800 x 700 x 400: times as long an opaque frame",
        lambda r, h: r[f"opaque-frame/{h}/1000x1200x600-{OPAQUE}"]["times_smaller_grid"],
        "{:.2f}",
        1.1,
        1.0,
        False,
    ),
    (
        "a section plane moved before each frame: times as long a frame (1: nothing is rebuilt)",
        lambda r, h: ratio(r, f"section-frame/{h}/{GRID}-{OPAQUE}", "SVT, plane moved"),
        "{:.2f}",
        1.1,
        1.0,
        False,
    ),
    (
        "a style changed before each frame: times as long a frame (1: nothing is rebuilt)",
        lambda r, h: ratio(r, f"section-frame/{h}/{GRID}-{OPAQUE}", "SVT, a style"),
        "{:.2f}",
        1.1,
        1.0,
        False,
    ),
    (
        "an S-Lens moved before each frame: times as long a frame (1: nothing is rebuilt)",
        lambda r, h: ratio(r, f"lens-frame/{h}/{GRID}-{OPAQUE}", "SVT, lens moved"),
        "{:.2f}",
        1.1,
        1.0,
        False,
    ),
    (
        "another object highlighted before each frame: times as long a frame (1: nothing is rebuilt)",
        lambda r, h: ratio(r, f"highlight-frame/{h}/{GRID}-{OPAQUE}", "SVT, another object"),
        "{:.2f}",
        1.1,
        1.0,
        False,
    ),
    (
        "the S-Lens: times as long as the frame without it",
        lambda r, h: 1 / ratio(r, f"lens-frame/{h}/{GRID}-{OPAQUE}", "SVT, plain"),
        "{:.2f}",
        None,
        None,
        False,
    ),
    (
        "all feature edges inside the volume: times as long as the frame without lines",
        lambda r, h: 1 / ratio(r, f"wireframe/{h}/{GRID}-{OPAQUE}", "SVT, without lines"),
        "{:.2f}",
        1.2,
        1.0,
        False,
    ),
    ("bricks of 4000 x 3500 x 2000: time", lambda r, h: largest(r, h, "bricks_s"), "{:.2f} s", 0.5, 0.1, False),
    (
        "bricks of 4000 x 3500 x 2000: memory",
        lambda r, h: largest(r, h, "bricks_bytes") / 1e6,
        "{:.0f} MB",
        40,
        40,
        False,
    ),
    (
        "district of 24,694 objects: voxelizing",
        lambda r, h: only(h, lambda: next(row for row in r.values() if row["stage"] == "district")["voxelize_s"]),
        "{:.2f} s",
        1.5,
        0.5,
        False,
    ),
    (
        "house with patterns at 2 cm, `svt build`: time",
        lambda r, h: only(h, lambda: r["command/svt-build---patterns"]["ours"]["median_s"]),
        "{:.2f} s",
        1,
        0.2,
        False,
    ),
    (
        "house with patterns at 2 cm: size on disk",
        lambda r, h: only(h, lambda: r["command/svt-build---patterns"]["result_bytes"] / 1e6),
        "{:.2f} MB",
        0.5,
        0.5,
        False,
    ),
    (
        "page, browser that has not seen it: first image",
        lambda r, h: page_row(r, h, lambda p: p["first_image_s"]),
        "{:.2f} s",
        0.7,
        0.3,
        False,
    ),
    ("the same: finest picture", lambda r, h: page_row(r, h, lambda p: p["finest_s"]), "{:.2f} s", 1.5, 0.6, False),
    (
        "page turning, software only: frames a second",
        lambda r, h: page_row(r, h, lambda p: p["turning_fps"]),
        "{:.1f} fps",
        25,
        60,
        True,
    ),
    (
        "the same: share of the picture's width that is cast",
        lambda r, h: page_row(r, h, lambda p: p["turning_share"]),
        "{:.2f}",
        0.5,
        1.0,
        True,
    ),
    ("page, still picture", lambda r, h: page_row(r, h, lambda p: p["still_s"]), "{:.2f} s", 0.2, 0.1, False),
]


def seconds(value):
    if value >= 1:
        return f"{value:.2f} s"
    return (
        f"{1e3 * value:.0f} ms"
        if value >= 0.1
        else f"{1e3 * value:.1f} ms"
        if value >= 0.01
        else f"{1e3 * value:.2f} ms"
    )


def size(value):
    if not value:
        return "-"
    if value >= 1e9:
        return f"{value / 1e9:.3g} GB"
    return (
        f"{value / 1e6:.0f} MB"
        if value >= 1e8
        else f"{value / 1e6:.1f} MB"
        if value >= 1e7
        else f"{value / 1e6:.2f} MB"
    )


def times(value):
    return f"{value:.0f} x" if value >= 10 else f"{value:.1f} x" if value >= 1 else f"{value:.2f} x"


def table(head, lines):
    text = [head, ["---"] * len(head)] + lines
    return "\n".join("| " + " | ".join(cells) + " |" for cells in text)


def goal_cell(value, style, must, moonshot, more):
    """The figure, and which of its limits it reaches."""
    if value is None or must is None:
        return "-" if value is None else style.format(value)

    def reaches(limit):
        return value >= limit * 0.995 if more else value <= limit * 1.005

    reached = "moonshot" if reaches(moonshot) else "must" if reaches(must) else "**no**"
    return f"{style.format(value)}, {reached}"


def goals(figures):
    rows = {row["id"]: row for row in all_rows(figures)}
    lines, measured = [], False
    for text, read, style, must, moonshot, more in GOALS:
        musts = must if isinstance(must, tuple) else (must, must)
        cells = []
        for house, limit in zip(("fzk-haus", "fzk-haus-turned"), musts):
            try:
                cells.append(goal_cell(read(rows, house), style, limit, moonshot, more))
            except (KeyError, StopIteration):
                cells.append("not measured")
        measured = measured or any(cell not in ("not measured", "-") for cell in cells)
        limits = [
            " / ".join(dict.fromkeys(style.format(one) for one in musts)) if must else "-",
            style.format(moonshot) if moonshot else "-",
        ]
        lines.append([text, *limits, *cells])
    return (
        table(["goal", "must", "moonshot", HOUSE, "turned by 30 degrees"], lines)
        if measured
        else "The goals are about the large grid, which this run leaves out."
    )


def beside(row, name):
    return next((b for b in row.get("beside", []) if b["name"].startswith(name)), None)


def peers(row):
    return [b for b in row.get("beside", []) if b["is_peer"]]


def missing(rows):
    """The reasons without duplicates."""
    return list(dict.fromkeys(reason for row in rows for reason in row.get("missing", [])))


def reading(rows):
    lines = []
    for row in rows:
        peer = next(iter(peers(row)), None)
        one = beside(row, "SVT, one thread")
        lines.append(
            [
                row["input"],
                row["size"],
                seconds(row["ours"]["median_s"]),
                seconds(one["median_s"]),
                f"{row['mb_per_s']:.0f} MB/s",
                str(row["polygons"]),
            ]
            + ([seconds(peer["median_s"]), times(peer["ratio"]), str(peer["polygons"])] if peer else ["-"] * 3)
        )
    return table(
        ["file", "size", "SVT", "one thread", "speed", "polygons", "libcitygml", "ratio", "its polygons"], lines
    )


def ifc(rows):
    lines = []
    for row in rows:
        peer = next(iter(peers(row)), None)
        own = row["ours"]
        lines.append(
            [
                row["input"],
                size(row["input_bytes"]),
                str(own["products"]),
                seconds(own["median_s"]),
                f"{row['input_bytes'] / 1e6 / own['median_s']:.0f} MB/s",
                seconds(own["whole_s"]),
                size(own["peak_bytes"]),
            ]
            + ([seconds(peer["median_s"]), times(peer["ratio"]), size(peer["peak_bytes"])] if peer else ["-"] * 3)
        )
    return table(
        [
            "file",
            "size",
            "products",
            "SVT reads",
            "speed",
            "whole command",
            "its memory",
            "web-ifc",
            "ratio",
            "its memory",
        ],
        lines,
    )


def voxels(rows):
    lines = []
    for row in rows:
        for peer in peers(row):
            agreement = peer.get("agreement")
            differ = (
                "-"
                if agreement is None
                else f"{agreement['differing'] - agreement['differing_on_border']} ({agreement['differing_percent']:.4f} %)"
            )
            lines.append(
                [
                    row["input"],
                    row["size"],
                    seconds(row["ours"]["median_s"]),
                    seconds(beside(row, "SVT, one thread")["median_s"]),
                    peer["name"],
                    seconds(peer["median_s"]),
                    times(peer["ratio"]),
                    size(row["ours"].get("peak_bytes")),
                    size(peer.get("peak_bytes")),
                    differ,
                ]
            )
    return table(
        [
            "input",
            "samples",
            "SVT",
            "one thread",
            "beside it",
            "its time",
            "ratio",
            "memory",
            "its memory",
            "voxels that differ",
        ],
        lines,
    )


def agreement_of_pictures(peer):
    pictures = peer.get("pictures")
    if not pictures:
        return "-"
    first, last = pictures[0], pictures[-1]
    if "same_label_percent" in first:
        return (
            f"same label: {first['same_label_percent']:.1f} % of pixels, "
            f"{last['same_label_percent']:.1f} % at {last['samples_per_voxel']} samples a voxel"
        )
    colors = first["colors"]
    return (
        f"colors: {sum(colors['mean']) / 3:.1f} of 255 off on average, {colors['largest']} at most; "
        f"{colors['over_2_percent']:.1f} % of pixels by more than 2, {colors['over_8_percent']:.1f} % by more than 8"
    )


def frames(rows):
    lines = []
    for row in rows:
        grid = row["size"].split(",")[0]
        unlit = beside(row, "SVT, unlit")
        for other in row.get("beside", []):
            if other["is_peer"] or other["name"].startswith("SVT at"):
                lines.append(
                    [
                        row["stage"].split()[0],
                        row["input"],
                        grid,
                        seconds(row["ours"]["median_s"]),
                        seconds(unlit["median_s"]),
                        other["name"],
                        seconds(other["median_s"]),
                        times(other["ratio"]),
                        size(row["ours"].get("peak_bytes")),
                        size(other.get("peak_bytes")),
                        agreement_of_pictures(other),
                    ]
                )
    return table(
        [
            "frame",
            "input",
            "samples",
            "SVT",
            "unlit",
            "beside it",
            "its time",
            "ratio",
            "memory",
            "its memory",
            "pictures",
        ],
        lines,
    )


def edits(rows):
    lines = [
        [row["input"], row["size"].split(",")[0], seconds(row["ours"]["median_s"])]
        + [seconds(beside(row, name)["median_s"]) for name in ("SVT, plane moved", "SVT, a style")]
        for row in rows
    ]
    return table(
        [
            "input",
            "samples",
            "frame with a section plane",
            "the plane moved before each frame",
            "a style changed before each frame",
        ],
        lines,
    )


def illustrations(rows):
    lines = [
        [row["stage"].split()[0], row["input"], row["size"].split(",")[0], seconds(row["ours"]["median_s"])]
        + [seconds(row["beside"][n]["median_s"]) for n in (0, 1)]
        for row in rows
    ]
    return table(["frame", "input", "samples", "time", "changed before each frame", "plain frame"], lines)


def wireframes(rows):
    lines = [
        [
            row["input"],
            row["size"].split(",")[0],
            f"{row['edges']}",
            seconds(row["ours"]["median_s"]),
            f"{row['room_edges']}",
            seconds(beside(row, "SVT, edges of rooms")["median_s"]),
            seconds(beside(row, "SVT, without lines")["median_s"]),
        ]
        for row in rows
    ]
    return table(
        ["input", "samples", "edges", "frame with all of them", "of rooms", "frame with these", "without"], lines
    )


def stages(rows):
    inputs = list(dict.fromkeys(row["input"] for row in rows))
    names = list(dict.fromkeys(row["stage"] for row in rows))
    cells = {(row["stage"], row["input"]): row for row in rows}
    lines = []
    for name in names:
        line = [name]
        for one in inputs:
            row = cells[name, one]
            line.append(f"{seconds(row['ours']['median_s'])}, {size(row['ours'].get('peak_bytes'))}")
        sizes = [size(cells[name, one].get("result_bytes")) for one in inputs]
        lines.append(line + ["-" if set(sizes) == {"-"} else " / ".join(sizes)])
    return table(["stage", *(f"{one}: time, memory" for one in inputs), "result: " + " / ".join(inputs)], lines)


def scaling(rows):
    lines = []
    for row in rows:
        lines.append(
            [
                row["input"],
                row["size"],
                size(row["dense_bytes"]),
                seconds(row["voxelize_s"]),
                size(row["columns_bytes"]),
                seconds(row["bricks_s"]),
                size(row["bricks_bytes"]),
                seconds(row["frame_s"]),
                size(row["peak_bytes"]),
            ]
        )
    text = table(
        [
            "input",
            "samples",
            "dense, 16 bit",
            "voxelize",
            "columns",
            "make bricks",
            "bricks",
            "opaque frame",
            "most memory",
        ],
        lines,
    )
    for row in rows:
        if row["stage"] == "district":
            text += (
                f"\n\nThe district: a file of {size(row['file_bytes'])} with {row['objects']} objects and "
                f"{row['triangles']} triangles; file to volume {seconds(row['build_s'])} (reading "
                f"{seconds(row['read_s'])}, meshes {seconds(row['mesh_s'])}, voxelizing {seconds(row['voxelize_s'])})."
            )
    return text


def profile(rows):
    lines = [
        [
            row["piece"] + (" frame" if row["unit"] == "ray" else ""),
            row["input"],
            f"{row['units']} {row['unit']}s",
            f"{row['instructions']:.0f}",
            f"{max(0, row['l1_misses']):.2f}",
            f"{max(0, row['last_level_misses']):.2f}",
        ]
        for row in rows
    ]
    return table(
        [
            "work, one thread",
            "input",
            "units",
            "instructions per unit",
            "misses of the first level",
            "of the last level",
        ],
        lines,
    )


def commands(rows):
    lines = [[f"`{row['command']}`", seconds(row["ours"]["median_s"]), size(row["result_bytes"])] for row in rows]
    return table(["command, from outside", "time", "its file"], lines)


PAGE_FIGURES = [
    ("first image after navigation, in a browser that has not seen the page", "first_image_s", "{:.2f} s"),
    ("finest picture, the same", "finest_s", "{:.2f} s"),
    ("first image, loaded again", "again_s", "{:.2f} s"),
    ("turning: frames a second", "turning_fps", "{:.1f}"),
    ("turning: share of the picture's width that is cast", "turning_share", "{:.2f}"),
    ("still picture, 4 rays a pixel, by the CPU", "still_s", "{:.2f} s"),
    ("the same by WebGL2 on this machine's driver", "still_webgl2_s", "{:.2f} s"),
]


def viewer(rows):
    lines = [[text, f"{style.format(row[key])}"] for row in rows for text, key, style in PAGE_FIGURES if key in row]
    return table(["the page in Chromium, software graphics", "figure"], lines)


def machine(figures):
    """The machine of the first part that states it."""
    return next((part["machine"] for part in figures["parts"].values() if "machine" in part), None)


def commits(figures):
    """The commit, or the commits of the parts if they differ."""
    found = {name: part["commit"] for name, part in figures["parts"].items()}
    if len(set(found.values())) == 1:
        return next(iter(found.values()))
    return ", ".join(
        f"{commit} ({', '.join(n for n, c in found.items() if c == commit)})"
        for commit in dict.fromkeys(found.values())
    )


def machine_text(figures):
    m = machine(figures)
    text = (
        f"Commit {commits(figures)}."
        if m is None
        else (
            f"Machine: {m['cores']} cores, {m['processor']}, {m['simd']}, {m['memory_gib']:.0f} GiB; {m['compiler']}, "
            f"{m['build']}; commit {commits(figures)}."
        )
    )
    parts = [
        (part["others_cores"], part["stolen_cores"], name)
        for name, part in figures["parts"].items()
        if "others_cores" in part and name != "profile"
    ]
    if parts:
        others, _, name = max(parts)
        text += (
            f" Other programs used {others:.2f} cores at most while a part ran (part {name}), the machine's host "
            f"took away {max(stolen for _, stolen, _ in parts):.2f}."
        )
    return text


# Heading, part, which rows, how.
SECTIONS = [
    ("Reading", {"read"}, reading),
    ("Reading IFC", {"ifc"}, ifc),
    ("Voxelizing", {"voxelize"}, voxels),
    ("Frames", {"opaque frame", "translucent frame"}, frames),
    ("Edits", {"section frame"}, edits),
    ("Illustrations", {"lens frame", "highlight frame"}, illustrations),
    ("Wireframe", {"wireframe"}, wireframes),
    ("Stages", None, stages),
    ("Scaling", {"scaling", "district"}, scaling),
    ("Whole commands", {"command"}, commands),
    ("The page", {"page"}, viewer),
    ("Counted", {"profile"}, profile),
]


def page(figures, plot):
    rows = all_rows(figures)
    text = [machine_text(figures), goals(figures)]
    for heading, names, make in SECTIONS:
        chosen = [
            row
            for row in rows
            if (row.get("is_stage") if names is None else row["stage"] in names and not row.get("is_stage"))
        ]
        if not chosen:
            continue
        text += [f"### {heading}", make(chosen)]
        if heading == "Scaling":
            text.append(f"![Time and memory against samples along x]({plot})")
        text += [f"Missing: {reason}." for reason in missing(chosen)]
    text += [
        f"Skipped: {reason}."
        for reason in dict.fromkeys(r for part in figures["parts"].values() for r in part.get("skipped", []))
    ]
    return "\n\n".join(text)


def beside_the_paper(figures):
    """The small table of the README: what the paper measured of the same house, and the last run here."""
    rows = {row["id"]: row for row in all_rows(figures)}

    def rate(name, size=GRID):
        return f"{1 / rows[f'{name}/fzk-haus/{size}-{OPAQUE}']['ours']['median_s']:.0f}"

    return table(
        ["FZK-Haus, samples", "", "paper", "SVT"],
        [
            ["800 x 700 x 400", "memory", "214 MB", f"{stage(rows, 'make-bricks', 'fzk-haus', 'size'):.1f} MB"],
            ["", "frames a second", "42", rate("opaque-frame")],
            ["", "with the model's edges inside the volume", "10", rate("wireframe")],
            ["", "a lens that moves", "not stated", rate("lens-frame")],
            [
                "1000 x 1200 x 600",
                "frames a second",
                "1.1 (of a cadastral parcel, 687 MB)",
                rate("opaque-frame", "1000x1200x600"),
            ],
        ],
    )
