"""Pictures for the site: small enough for a page of 300 kB, the same bytes for the same input."""
import pathlib
import re
import shutil
import subprocess
import tempfile

from PIL import Image, ImageSequence

WIDTH = 1200  # pixels; twice the width of the column of text, for screens with a high density
STILL_BYTES = 60_000
FILM_BYTES = 110_000
PAGE_BYTES = 165_000  # of all pictures of a page, which stays below 300 kB with styles, scripts and text


def still(source: pathlib.Path, target: pathlib.Path, width: int = WIDTH, most_bytes: int = STILL_BYTES) -> None:
    """Writes a PNG or WebP as WebP with at most `width` pixels across; its quality falls until its size fits."""
    with Image.open(source) as opened:
        picture = opened.convert("RGBA" if "A" in opened.getbands() or "transparency" in opened.info else "RGB")
    for quality, share in (
        *((quality, 1.0) for quality in (85, 75, 65, 55)),
        (60, 0.8),
        (50, 0.8),
        (50, 0.65),
        (40, 0.65),
        (40, 0.5),
        (40, 0.4),
    ):
        across = min(picture.width, round(width * share))
        size = (across, max(1, round(picture.height * across / picture.width)))
        picture.resize(size, Image.Resampling.LANCZOS).save(target, "WEBP", quality=quality, method=6)
        if target.stat().st_size <= most_bytes:
            return


def limits(stills: int, films: int) -> tuple[int, int]:
    """The most bytes of a still picture and of a film on a page with these numbers of them."""
    of_film = FILM_BYTES if films + stills == 1 else FILM_BYTES // 2
    return min(STILL_BYTES, (PAGE_BYTES - films * of_film) // max(1, stills)), of_film


def film(source: pathlib.Path, target: pathlib.Path, most_bytes: int = FILM_BYTES) -> None:
    """Writes a film (WebP) with fewer and smaller pictures until its size fits."""
    with Image.open(source) as opened:
        pictures = [frame.convert("RGB") for frame in ImageSequence.Iterator(opened)]
        milliseconds = opened.info.get("duration", 0) or 67
    for step, width, quality in ((2, 480, 50), (2, 480, 35), (3, 480, 35), (3, 400, 30), (4, 400, 20), (5, 320, 15)):
        chosen = pictures[::step]
        height = round(chosen[0].height * width / chosen[0].width)
        small = [picture.resize((width, height), Image.Resampling.LANCZOS) for picture in chosen]
        small[0].save(
            target,
            "WEBP",
            save_all=True,
            append_images=small[1:],
            duration=milliseconds * step,
            loop=0,
            quality=quality,
            method=4,
        )
        if target.stat().st_size <= most_bytes:
            return


def is_film(path: pathlib.Path) -> bool:
    if path.suffix != ".webp":
        return False
    with Image.open(path) as opened:
        return getattr(opened, "n_frames", 1) > 1


def drawing(source: pathlib.Path, target: pathlib.Path, width: int) -> None:
    """Draws an SVG as a PNG on white."""
    command = ["rsvg-convert", "--width", str(width), "--keep-aspect-ratio", "--background-color", "white"]
    subprocess.run([*command, "--output", str(target), str(source)], check=True)


def for_site(source: pathlib.Path, target: pathlib.Path, most: tuple[int, int] = (STILL_BYTES, FILM_BYTES)) -> None:
    """A picture of the tree as the site shows it: SVG unchanged, everything else as WebP with the most bytes of limits()."""
    target.parent.mkdir(parents=True, exist_ok=True)
    if source.suffix == ".svg" and target.suffix == ".svg":
        shutil.copyfile(source, target)
    elif source.suffix == ".svg":
        with tempfile.TemporaryDirectory() as folder:
            drawn = pathlib.Path(folder) / "drawn.png"
            drawing(source, drawn, WIDTH)
            still(drawn, target, most_bytes=most[0])
    elif is_film(source):
        film(source, target, most[1])
    else:
        still(source, target, most_bytes=most[0])


def for_tree(source: pathlib.Path, target: pathlib.Path) -> None:
    """A picture that a page of the tree shows: 640 pixels across and below 30 kB."""
    target.parent.mkdir(parents=True, exist_ok=True)
    if is_film(source):
        film(source, target)
        return
    with tempfile.TemporaryDirectory() as folder:
        drawn = source
        if source.suffix == ".svg":
            drawn = pathlib.Path(folder) / "drawn.png"
            drawing(source, drawn, 1280)
        still(drawn, target, 640, 28_000)


def size_of(path: pathlib.Path) -> tuple[int, int]:
    """Width and height in pixels. A drawing in millimetres is as wide as the column of text."""
    if path.suffix != ".svg":
        with Image.open(path) as opened:
            return opened.size
    root = (re.findall(r"<svg[^>]*>", path.read_text(encoding="utf-8")) or [""])[0]
    pixels = re.search(r'width="([\d.]+)(?:px)?" height="([\d.]+)(?:px)?"', root)
    box = re.search(r'viewBox="[-\d.e]+ [-\d.e]+ ([\d.]+) ([\d.]+)"', root)
    if pixels:
        return round(float(pixels[1])), round(float(pixels[2]))
    if not box:
        raise SystemExit(f"site: {path} has neither a size in pixels nor a viewBox")
    return 1000, round(1000 * float(box[2]) / float(box[1]))
