"""Packages that add functions, loaded on first use: `import svt` needs only numpy."""
from __future__ import annotations

import importlib
from typing import Any

#: Module -> extra of this package, package of Debian 12 ('' if it has none).
_PACKAGES = {
    "xarray": ("xarray", "python3-xarray"),
    "pandas": ("tables", "python3-pandas"),
    "vtkmodules": ("vtk", "python3-vtk9"),
    "pyvista": ("pyvista", ""),
}


def load(name: str, user: str) -> Any:
    """The module `name`, such as 'vtkmodules.vtkCommonDataModel'.

    Parameters
    ----------
    user
        The function that needs it, for the message of the ImportError.
    """
    try:
        return importlib.import_module(name)
    except ImportError as error:
        top = name.partition(".")[0]
        extra, debian = _PACKAGES[top]
        remedy = f"pip install 'semantic-volume-texture[{extra}]'" + (f", or apt install {debian}" if debian else "")
        raise ImportError(f"{user} needs {extra if top == 'vtkmodules' else top}: {remedy} ({error})") from error
