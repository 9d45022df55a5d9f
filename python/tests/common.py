"""Shared by the tests: the command, the generated house, its volume."""
import functools
import importlib.util
import os
import subprocess
import tempfile
import unittest

import svt

FOLDER = tempfile.TemporaryDirectory(prefix="svt-python-")
COMMAND = os.environ.get("SVT_COMMAND", "")
DATA = os.environ.get("SVT_DATA_DIR", "")


def path(name):
    return os.path.join(FOLDER.name, name)


@functools.lru_cache(maxsize=None)
def house_file():
    """The model of the generated house."""
    svt.sample("house", path("house.gml"))
    return path("house.gml")


@functools.lru_cache(maxsize=None)
def house():
    """Its volume with samples 10 cm apart."""
    return svt.build(house_file(), spacing=0.1)


@functools.lru_cache(maxsize=None)
def house_svt():
    """The same volume, built by the command."""
    command("build", house_file(), "-o", path("house.svt"), "--spacing", "0.1")
    return path("house.svt")


def command(*arguments):
    """Runs svt, and returns what it prints."""
    done = subprocess.run([COMMAND, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def known_volume(label):
    """The volume of a label that has one, m3."""
    assert label.volume is not None, label
    return label.volume


def needs(module):
    """Skips a test with the reason where a package that adds functions is missing."""
    is_there = importlib.util.find_spec(module) is not None
    return unittest.skipUnless(is_there, f"no {module} (scripts/setup.sh readers installs it)")


needs_command = unittest.skipUnless(os.path.exists(COMMAND), "no command at SVT_COMMAND")
