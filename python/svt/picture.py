"""Pictures with the label and depth of each pixel, and PNG."""
from __future__ import annotations

import os

import numpy as np

from . import _native
from .model import PathLike


class Frame:
    """A picture of a volume with the scalar and depth of each pixel, from :meth:`svt.Volume.frame`. Row 0 is the top.

    Attributes
    ----------
    color : ndarray (height, width, 4) uint8
        Red, green, blue (sRGB) and alpha, not premultiplied.
    scalar : ndarray (height, width) uint32
        The first scalar that the ray through the pixel's centre meets, as in Volume.dense(); 0: background.
    depth : ndarray (height, width) float32
        Distance to that scalar along the view direction, metres; inf: background.
    notes : list of str
        Queries that selected nothing.

    The arrays are the memory of the picture, not copies.
    """

    def __init__(self, native: _native.Frame) -> None:
        self._native = native
        self.color: np.ndarray = native.color
        self.scalar: np.ndarray = native.scalar
        self.depth: np.ndarray = native.depth
        self.notes: list[str] = native.notes

    def save(self, path: PathLike) -> None:
        """Write the picture as PNG: the same bytes as `svt render -o`."""
        _native.write_png(os.fspath(path), self.color, self._native.dpi)

    def _repr_png_(self) -> bytes:
        return _native.encode_png(self.color, 0)

    def __repr__(self) -> str:
        return f"<svt.Frame {self.color.shape[1]} x {self.color.shape[0]}>"


def write_png(path: PathLike, pixels: np.ndarray, dpi: int = 0) -> None:
    """Write an array of uint8 as PNG: shape (height, width, 4), (height, width, 3), or (height, width) for gray.

    Parameters
    ----------
    dpi
        Pixels per inch to store in the file; 0: none.
    """
    _native.write_png(os.fspath(path), rgba_of(pixels), dpi)


def read_png(path: PathLike) -> np.ndarray:
    """Read a PNG of any kind as an array (height, width, 4) of uint8: red, green, blue (sRGB) and alpha."""
    return _native.read_png(os.fspath(path))


def rgba_of(pixels: np.ndarray) -> np.ndarray:
    pixels = np.asarray(pixels)
    if pixels.dtype != np.uint8:
        raise TypeError(f"pixels: expected uint8, found {pixels.dtype}")
    if pixels.ndim == 2:
        pixels = pixels[:, :, None].repeat(3, axis=2)
    if pixels.ndim == 3 and pixels.shape[2] == 3:
        pixels = np.dstack([pixels, np.full(pixels.shape[:2], 255, np.uint8)])
    return np.ascontiguousarray(pixels)
