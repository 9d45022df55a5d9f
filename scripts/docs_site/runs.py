"""Runs the commands of a page, as its reader would, and keeps the files that they write: the pictures of the page.

Blocks ```json NAME, ```csv NAME and ```python NAME are files; lines of ```sh blocks are commands. The tests run the same
blocks and compare their output with the page (tests/cli/documents_test.cpp).
"""
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys

from . import markdown_text

FILE_BLOCK = re.compile(r"^(?:json|csv|python) (\S+)$")
COMMANDS = ("svt ", "python3 ")
SERVERS = ("svt view ", "svt serve ")  # they run until somebody stops them


def steps_of(text: str) -> list[tuple[str, str]]:
    """The files and commands of a page in their order: (name, content) or ("", command)."""
    steps: list[tuple[str, str]] = []
    for is_code, block in markdown_text.blocks(text):
        if not is_code:
            continue
        first, *lines = block.splitlines()
        kind = first.strip().lstrip("`").strip()
        file = FILE_BLOCK.match(kind)
        if file:
            steps.append((file[1], "\n".join(lines[:-1]) + "\n"))
        elif kind == "sh":
            for command in re.split(r"(?<!\\)\n", "\n".join(lines[:-1])):
                if command.startswith(COMMANDS) and not command.startswith(SERVERS):
                    steps.append(("", command))
    return steps


class Runner:
    """Runs pages with a build of the program; a page whose steps have run with the same program is not run again."""

    def __init__(self, build: pathlib.Path, work: pathlib.Path) -> None:
        self._build = build
        self._work = work
        program = (build / "bin" / "svt").stat()
        self._program = f"{program.st_mtime_ns} {program.st_size}"

    def files_of(self, name: str, text: str) -> pathlib.Path:
        """The folder with the files that the page's commands wrote."""
        steps = steps_of(text)
        digest = hashlib.sha256(repr((steps, self._program)).encode()).hexdigest()
        folder = self._work / name
        stamp = folder / ".stamp"
        if stamp.exists() and stamp.read_text() == digest:
            return folder
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for file, content in steps:
            if file:
                (folder / file).write_text(content, encoding="utf-8")
            else:
                self._run(name, folder, content)
        stamp.write_text(digest)
        return folder

    def _run(self, page: str, folder: pathlib.Path, command: str) -> None:
        expected = int((re.findall(r"# exit (\d+)$", command) or ["0"])[0])
        python = str(self._build / "python")
        environment = {
            **os.environ,
            "PATH": f"{self._build / 'bin'}:/usr/bin:/bin",
            "PYTHONPATH": python,
            "PYTHONDONTWRITEBYTECODE": "1",
        }
        done = subprocess.run(["sh", "-c", command], cwd=folder, env=environment, capture_output=True, text=True)
        if done.returncode != expected:
            sys.exit(f"site: {page}: '{command}' ended with {done.returncode}:\n{done.stdout}{done.stderr}")
