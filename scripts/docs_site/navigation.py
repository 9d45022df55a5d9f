"""The order of the pages: tutorials, how-to guides, reference, explanation, gallery, benchmarks, comparison, development.

Pages of docs/user, docs/dev and docs/tutorials that no list names follow the named ones, so that a new page has its place.
"""
from typing import Union

from .staging import Staging

Entry = Union[str, dict[str, Union[str, list]]]

TUTORIALS = ["cadastre", "architecture", "research", "city", "teaching"]
HOWTO = [
    *("viewer", "publish", "web-component", "sheets", "styles", "scenes", "regions", "coordinates", "ifc", "city"),
    *("cadastre-office", "configuration", "trouble"),
]
COMMANDS = [
    *(
        "sample",
        "sample-city",
        "build",
        "info",
        "check",
        "render",
        "section",
        "query",
        "quantities",
        "cadastre",
        "diff",
        "shell",
        "convert",
    ),
    *(
        "fields",
        "field-list",
        "field-add",
        "field-stats",
        "field-probe",
        "field-export",
        "field-remove",
        "simulate-heat",
        "simulate-spread",
    ),
    *(
        "serve",
        "view",
        "city-plan",
        "city-run",
        "city-task",
        "city-status",
        "city-merge",
        "city-info",
        "city-find",
        "city-extract",
    ),
    *("thumbnail", "doctor", "describe"),
]
LANGUAGES = ["query-language", "json", "exit-codes"]
EXPLANATION = ["a-walls-way", "closing", "exact-figures", "drawings", "spaces", "ifc", "city", "limits", "glossary"]
DEVELOPMENT = ["architecture", "building", "testing", "checking", "performance", "dependencies", "english", "site"]


def navigation(staging: Staging) -> list[Entry]:
    """The `nav` of MkDocs, of the pages that exist."""
    used: set[str] = set()

    def page(target: str, title: str = "") -> list[Entry]:
        if target not in staging.pages or target in used:
            return []
        used.add(target)
        return [{title or staging.pages[target].title: target}]

    def named(folder: str, names: list[str]) -> list[Entry]:
        return [entry for name in names for entry in page(f"{folder}/{name}.md")]

    def others(folder: str) -> list[Entry]:
        found = [target for target in sorted(staging.pages) if target.startswith(folder + "/") and target not in used]
        return [entry for target in found for entry in page(target)]

    tutorials = [*page("tutorials/index.md", "Tutorials"), *named("tutorials", TUTORIALS), *others("tutorials")]
    howto = [*page("howto/index.md", "How-to guides"), *named("user", HOWTO), *others("howto")]
    howto += page("python/index.md", "Python")
    languages = named("user", LANGUAGES)
    commands = [*page("user/index.md", "Commands"), *named("user", COMMANDS), *others("user")]
    formats = [*page("formats/svt.md"), *page("formats/city.md"), *page("formats/index.md"), *others("formats")]
    reference: list[Entry] = [
        *page("reference/index.md", "Reference"),
        {"Commands": commands},
        *languages,
        {"Formats": formats},
        *page("errors/index.md", "Errors"),
        *page("python/api.md", "Python API"),
        *page("reference/cpp.md", "C++ API"),
    ]
    explanation = [*page("explanation/index.md"), *others("explanation"), *named("dev", EXPLANATION)]
    development: list[Entry] = [*page("dev/contributing.md"), *named("dev", DEVELOPMENT)]
    development += [
        {"How to extend": others("dev/howto")},
        {"Tried": [*page("dev/tried/index.md"), *others("dev/tried")]},
    ]
    development += [*others("dev"), *page("changelog.md")]
    return [
        {"Home": "index.md"},
        {"Tutorials": tutorials},
        {"How-to guides": howto},
        {"Reference": reference},
        {"Explanation": explanation},
        *page("gallery.md", "Gallery"),
        {
            "Benchmarks": [
                *page("benchmarks/index.md", "Benchmarks"),
                *page("comparison.md", "Comparison with other programs"),
            ]
        },
        {"Development": development},
    ]
