"""Errors and findings: the stable codes of docs/errors, with the place in the input."""
from __future__ import annotations

from typing import NamedTuple


class Place(NamedTuple):
    """A place in the input. Unknown members are empty or 0."""

    file: str = ""
    line: int = 0
    column: int = 0
    id: str = ""

    def __str__(self) -> str:
        text = self.file
        if self.line:
            text += f":{self.line}"
            if self.column:
                text += f":{self.column}"
        if self.id:
            text += f" (id '{self.id}')" if text else f"id '{self.id}'"
        return text


class Error(Exception):
    """An error of the library.

    Attributes
    ----------
    code : str
        Stable, such as 'E901'. docs/errors has a page for each code: cause, example and remedy.
    name : str
        The code in words, such as 'BadQuery'.
    message : str
        The found and the expected value, and the remedy.
    place : Place
        The place in the input.
    page : str
        The page of the code in the documentation.
    """

    def __init__(self, code: str, name: str, message: str, place: Place = Place()) -> None:
        super().__init__(code, name, message, place)
        self.code = code
        self.name = name
        self.message = message
        self.place = place

    @property
    def page(self) -> str:
        return f"docs/errors/{self.code}.md"

    def __str__(self) -> str:
        place = str(self.place)
        return f"{self.code} {self.name}: {place + ': ' if place else ''}{self.message}"


class Finding(NamedTuple):
    """A problem that did not stop the work: a dangling link, an open shell, a face that was left out."""

    severity: str  #: 'note', 'warning' or 'error'
    code: str  #: such as 'E207'
    name: str  #: the code in words, such as 'ShellNotClosed'
    message: str
    place: Place

    def __str__(self) -> str:
        place = str(self.place)
        return f"{self.severity} {self.code} {self.name}: {place + ': ' if place else ''}{self.message}"
