"""The plot of docs/images/scaling.svg: time and memory against resolution, both axes logarithmic. Used by bench.py."""

import math

WIDTH, HEIGHT = 470, 400
LEFT, RIGHT, TOP, BOTTOM = 64, 104, 40, 52
# Line, its key, its color (Okabe and Ito, distinguishable by the color-blind).
TIMES = [
    ("voxelize", "voxelize_s", "#0072B2"),
    ("make bricks", "bricks_s", "#D55E00"),
    ("opaque frame", "frame_s", "#009E73"),
]
SIZES = [
    ("columns", "columns_bytes", "#0072B2"),
    ("bricks", "bricks_bytes", "#D55E00"),
    ("most memory", "peak_bytes", "#009E73"),
    ("dense, 16 bit", "dense_bytes", "#555555"),
]


class Panel:
    """One plot; values are powers of ten of the data."""

    def __init__(self, offset, title, rows, lines, unit):
        self.offset, self.title, self.lines, self.unit = offset, title, lines, unit
        self.inputs = list(dict.fromkeys(row["input"] for row in rows))
        self.rows = {
            one: sorted((r for r in rows if r["input"] == one), key=lambda r: r["samples_x"]) for one in self.inputs
        }
        xs = [row["samples_x"] for row in rows]
        ys = [row[key] for row in rows for _, key, _ in lines]
        self.x_range = math.log10(min(xs)) - 0.05, math.log10(max(xs)) + 0.05
        self.y_range = math.floor(math.log10(min(ys))), math.ceil(math.log10(max(ys)))
        self.xs = sorted(set(xs))

    def x(self, value):
        low, high = self.x_range
        return self.offset + LEFT + (math.log10(value) - low) / (high - low) * (WIDTH - LEFT - RIGHT)

    def y(self, value):
        low, high = self.y_range
        return HEIGHT - BOTTOM - (math.log10(value) - low) / (high - low) * (HEIGHT - TOP - BOTTOM)

    def axes(self):
        left, right, top, bottom = self.offset + LEFT, self.offset + WIDTH - RIGHT, TOP, HEIGHT - BOTTOM
        parts = [f'<text x="{(left + right) / 2:.1f}" y="22" class="title">{self.title}</text>']
        for power in range(self.y_range[0], self.y_range[1] + 1):
            y = self.y(10.0**power)
            parts.append(
                f'<path d="M{left} {y:.1f}H{right}" class="grid"/>'
                f'<text x="{left - 6}" y="{y + 4:.1f}" class="end">{self.unit(power)}</text>'
            )
        for value in self.xs:
            x = self.x(value)
            parts.append(
                f'<path d="M{x:.1f} {top}V{bottom}" class="grid"/>'
                f'<text x="{x:.1f}" y="{bottom + 18}" class="middle">{value}</text>'
            )
        parts.append(f'<path d="M{left} {top}V{bottom}H{right}" class="axis"/>')
        parts.append(f'<text x="{(left + right) / 2:.1f}" y="{bottom + 38}" class="middle">samples along x</text>')
        return parts

    def guides(self):
        """Reference slopes for surface and volume growth, at the lower right, where no curve is."""
        parts = []
        start, end = self.xs[-min(3, len(self.xs))], self.xs[-1]
        base = 10.0 ** (self.y_range[0] + 0.1)
        for power, name in ((2, "n²"), (3, "n³")):
            y = self.y(base * (end / start) ** power)
            parts.append(
                f'<path d="M{self.x(start):.1f} {self.y(base):.1f}L{self.x(end):.1f} {y:.1f}" class="guide"/>'
                f'<text x="{self.x(end) + 6:.1f}" y="{y + 4:.1f}" class="hint">{name}</text>'
            )
        return parts

    def curves(self):
        parts, labels = [], []
        for name, key, color in self.lines:
            for number, one in enumerate(self.inputs):
                if key == "dense_bytes" and number > 0:  # the same
                    continue
                points = [(self.x(row["samples_x"]), self.y(row[key])) for row in self.rows[one] if row[key] > 0]
                path = "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
                dash = ' stroke-dasharray="5 4"' if number else ""
                parts.append(f'<path d="M{path}" class="line" stroke="{color}"{dash}/>')
                parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.6" fill="{color}"/>' for x, y in points]
                if number == 0:
                    labels.append((points[-1][1], name, color))
        x, last = self.offset + WIDTH - RIGHT + 8, -math.inf
        for y, name, color in sorted(labels):  # names keep a line's distance
            last = max(y + 4, last + 15)
            parts.append(f'<text x="{x}" y="{last:.1f}" fill="{color}">{name}</text>')
        return parts

    def draw(self):
        return self.axes() + self.guides() + self.curves()


def seconds_unit(power):
    return {-4: "0.1 ms", -3: "1 ms", -2: "10 ms", -1: "0.1 s"}.get(
        power, f"{10 ** power} s" if power >= 0 else f"1e{power} s"
    )


def bytes_unit(power):
    name = ["B", "KB", "MB", "GB", "TB"][power // 3]
    return f"{10 ** (power % 3)} {name}"


def scaling_svg(rows):
    panels = [Panel(0, "time", rows, TIMES, seconds_unit), Panel(WIDTH, "memory", rows, SIZES, bytes_unit)]
    legend = "; ".join(f"{'dashed' if number else 'solid'}: {one}" for number, one in enumerate(panels[0].inputs))
    parts = [part for panel in panels for part in panel.draw()]
    return (
        "\n".join(
            [
                f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {2 * WIDTH} {HEIGHT + 24}" '
                f'width="{2 * WIDTH}" height="{HEIGHT + 24}" font-family="sans-serif" font-size="12">',
                "<title>Time and memory against resolution</title>",
                "<style>.grid{stroke:#e4e4e4}.axis{stroke:#333;fill:none}.line{fill:none;stroke-width:2}"
                ".guide{stroke:#999;stroke-width:1;stroke-dasharray:2 3;fill:none}.hint{fill:#777}.title{font-size:15px;"
                "font-weight:bold;text-anchor:middle}.middle{text-anchor:middle}.end{text-anchor:end}</style>",
                f'<rect width="{2 * WIDTH}" height="{HEIGHT + 24}" fill="white"/>',
                *parts,
                f'<text x="{WIDTH}" y="{HEIGHT + 12}" class="middle">{legend}; dotted: growth with the surface (n²) and the '
                "volume (n³)</text>",
                "</svg>",
            ]
        )
        + "\n"
    )
