"""Reads a workbook (XLSX) by Python's own modules, for tests.

read_xlsx.py BOOK.xlsx OUT.json writes {sheet: {"rows": [[cell]], "frozen", "filter"}}; an empty cell is null.
"""
import json
import re
import sys
import xml.etree.ElementTree as tree
import zipfile

SPACE = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
LINK = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}id"


def given(element: tree.Element, name: str) -> str:
    """An attribute that the format requires."""
    value = element.get(name)
    assert value is not None, name
    return value


def column_of(reference: str) -> int:
    """0 of "A1", 27 of "AB7"."""
    number = 0
    for letter in re.sub("[^A-Z]", "", reference):
        number = 26 * number + ord(letter) - 64
    return number - 1


def read_sheet(page: tree.Element, texts: list) -> dict:
    rows: list = []
    for row in page.iter(SPACE + "row"):
        while len(rows) < int(given(row, "r")) - 1:
            rows.append({})
        cells = {}
        for cell in row:
            value = cell.find(SPACE + "v")
            if value is not None:
                text = value.text or ""
                cells[column_of(given(cell, "r"))] = texts[int(text)] if cell.get("t") == "s" else float(text)
        rows.append(cells)
    width = max([0] + [1 + column for cells in rows for column in cells])
    pane, kept = page.find(".//" + SPACE + "pane"), page.find(SPACE + "autoFilter")
    return {
        "rows": [[cells.get(column) for column in range(width)] for cells in rows],
        "frozen": pane is not None and pane.get("state") == "frozen" and pane.get("ySplit") == "1",
        "filter": None if kept is None else kept.get("ref"),
    }


def main() -> None:
    book = zipfile.ZipFile(sys.argv[1])
    assert book.testzip() is None

    def parse(name: str) -> tree.Element:
        return tree.fromstring(book.read(name))

    texts = ["".join(t.text or "" for t in item.iter(SPACE + "t")) for item in parse("xl/sharedStrings.xml")]
    parts = {given(each, "Id"): given(each, "Target") for each in parse("xl/_rels/workbook.xml.rels")}
    sheets = parse("xl/workbook.xml").iter(SPACE + "sheet")
    result = {sheet.get("name"): read_sheet(parse("xl/" + parts[given(sheet, LINK)]), texts) for sheet in sheets}
    with open(sys.argv[2], "w") as out:
        json.dump(result, out)


main()
