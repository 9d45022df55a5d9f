#!/usr/bin/env python3
"""Tests of scripts/release and of the checks of scripts/release.sh, in a small copy of the tree.

tests/scripts/release_test.py [SVT]   with the command: also its bill of materials
"""

import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from typing import Optional

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts/release"))

import badges  # noqa: E402
import changelog  # noqa: E402
import version  # noqa: E402

COMMAND: Optional[Path] = None

LOG = """# Changelog

## Unreleased

### For users

- A change.

## 0.1.0 - 2026-01-02

- The first.
"""


def copy_of_tree(root: Path) -> None:
    """The files that state the version, and what scripts/release.sh needs before it builds."""
    files = [place.path for place in version.PLACES + version.npm_places(ROOT)]
    files += ["scripts/release.sh", "LICENSE", "tests/checks.json"]
    files += [str(path.relative_to(ROOT)) for path in (ROOT / "scripts/release").glob("*.py")]
    for file in files:
        (root / file).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / file, root / file)
    (root / "CHANGELOG.md").write_text(LOG, encoding="utf-8")
    (root / ".gitignore").write_text("__pycache__/\n", encoding="utf-8")


class Version(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        copy_of_tree(self.root)

    def test_the_tree_agrees(self) -> None:
        self.assertEqual(version.findings(ROOT), [])

    def test_each_file_with_another_number_is_found(self) -> None:
        for place in version.PLACES[1:] + version.npm_places(ROOT):
            path = self.root / place.path
            text = path.read_text(encoding="utf-8")
            number = version.numbers_of(self.root, place)[0]
            path.write_text(text.replace(number, "9.9" if place.isShort else "9.9.9"), encoding="utf-8")
            found = version.findings(self.root)
            self.assertTrue(found and found[0].startswith(place.path + ":"), found)
            path.write_text(text, encoding="utf-8")
            self.assertEqual(version.findings(self.root), [])

    def test_a_missing_number_is_found(self) -> None:
        (self.root / "CITATION.cff").write_text("title: x\n", encoding="utf-8")
        self.assertIn("CITATION.cff: no version", version.findings(self.root)[0])

    def test_set_changes_all_of_them_and_nothing_else(self) -> None:
        before = (self.root / "README.md").read_text(encoding="utf-8")
        old = version.version(self.root)
        version.write(self.root, "7.8.9")
        self.assertEqual(version.findings(self.root), [])
        self.assertEqual(version.version(self.root), "7.8.9")
        version.write(self.root, old)
        self.assertEqual((self.root / "README.md").read_text(encoding="utf-8"), before)


class Changelog(unittest.TestCase):
    def test_closes_the_open_section(self) -> None:
        text = changelog.closed(LOG, "0.2.0", "2026-11-28")
        self.assertEqual(changelog.section(text, "0.2.0"), ("2026-11-28", "### For users\n\n- A change."))
        self.assertEqual(changelog.section(text, "0.1.0"), ("2026-01-02", "- The first."))
        self.assertIn("## Unreleased\n\n## 0.2.0", text)

    def test_refuses_a_second_section_and_a_wrong_day(self) -> None:
        with self.assertRaises(ValueError):
            changelog.closed(LOG, "0.1.0", "2026-11-28")
        with self.assertRaises(ValueError):
            changelog.closed(LOG, "0.2.0", "28.11.2026")


class Badges(unittest.TestCase):
    def test_state_the_facts(self) -> None:
        texts = {path.stem: text for path, text in badges.badges().items()}
        self.assertIn(">Apache-2.0<", texts["licence"])
        self.assertIn(f">{version.version(ROOT)}<", texts["version"])
        result = json.loads((ROOT / "tests/checks.json").read_text(encoding="utf-8"))["test"]
        self.assertIn(f">{result['result']} {result['date'][:10]}<", texts["tests"])


class Release(unittest.TestCase):
    """scripts/release.sh ends before it builds anything."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        copy_of_tree(self.root)
        # A build would be an error of this test.
        (self.root / "Makefile").write_text("package:\n\t@echo built >&2; exit 1\n", encoding="utf-8")
        self.git("init", "--quiet")
        self.commit()
        self.number = version.version(self.root)

    def git(self, *words: str) -> None:
        own = ["-c", "user.name=a", "-c", "user.email=a@example.org", "-c", "commit.gpgsign=false"]
        subprocess.run(["git", *own, *words], cwd=self.root, check=True, capture_output=True)

    def commit(self) -> None:
        self.git("add", "--all")
        self.git("commit", "--quiet", "--allow-empty", "-m", "x")

    def refusal(self, *words: str) -> str:
        done = subprocess.run(
            ["scripts/release.sh", *words], cwd=self.root, capture_output=True, text=True, errors="replace"
        )
        self.assertIn(done.returncode, (1, 2), done.stdout + done.stderr)
        return done.stderr

    def test_refuses_what_is_no_version(self) -> None:
        self.assertIn("'1.2' is not a version", self.refusal("1.2"))
        self.assertIn("unknown option '--push'", self.refusal(self.number, "--push"))

    def test_refuses_another_version_than_that_of_the_tree(self) -> None:
        self.assertIn(f"the tree has version {self.number}", self.refusal("9.9.9"))

    def test_refuses_changes_that_are_not_committed(self) -> None:
        (self.root / "new.txt").write_text("x", encoding="utf-8")
        self.assertIn("not committed: ?? new.txt", self.refusal(self.number))

    def test_refuses_a_changelog_without_the_version(self) -> None:
        (self.root / "CHANGELOG.md").write_text("# Changelog\n\n## Unreleased\n", encoding="utf-8")
        self.commit()
        self.assertIn("CHANGELOG.md has no section of", self.refusal(self.number))

    def test_refuses_two_days(self) -> None:
        log = LOG.replace("## Unreleased", f"## Unreleased\n\n## {self.number} - 2020-01-01")
        (self.root / "CHANGELOG.md").write_text(log, encoding="utf-8")
        self.commit()
        self.assertIn("CITATION.cff has another day than CHANGELOG.md (2020-01-01)", self.refusal(self.number))

    def test_refuses_a_tag_elsewhere(self) -> None:
        subprocess.run(["scripts/release.sh", "7.8.9", "--prepare"], cwd=self.root, check=True, capture_output=True)
        self.commit()
        self.git("tag", "v7.8.9")
        (self.root / "new.txt").write_text("x", encoding="utf-8")
        self.commit()
        self.assertIn("the tag v7.8.9 is on another commit", self.refusal("7.8.9"))

    def test_a_prepared_tree_passes_all_checks(self) -> None:
        subprocess.run(["scripts/release.sh", "7.8.9", "--prepare"], cwd=self.root, check=True, capture_output=True)
        self.commit()
        self.assertIn("built", self.refusal("7.8.9"))


class BillOfMaterials(unittest.TestCase):
    def test_names_each_linked_library_with_licence_and_version(self) -> None:
        if COMMAND is None or shutil.which("dpkg-query") is None:
            self.skipTest("needs the command, and a system of Debian")
        script = ROOT / "scripts/release/sbom.py"
        done = subprocess.run([sys.executable, script, COMMAND], check=True, capture_output=True, text=True)
        bill = json.loads(done.stdout)
        self.assertEqual((bill["bomFormat"], bill["specVersion"]), ("CycloneDX", "1.5"))
        self.assertEqual(bill["metadata"]["component"]["version"], version.version(ROOT))
        names = {component["name"] for component in bill["components"]}
        self.assertLessEqual({"libc6", "libpng16-16", "libzstd1", "zlib1g", "libcli11-dev", "libproj25"}, names)
        for component in bill["components"]:
            self.assertTrue(component["version"] and component["licenses"] and component["purl"], component)
        refs = [component["bom-ref"] for component in bill["components"]]
        self.assertEqual(refs, sorted(set(refs)))
        self.assertEqual(bill["dependencies"][0]["dependsOn"], refs)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        COMMAND = Path(sys.argv.pop()).resolve()
    unittest.main()
