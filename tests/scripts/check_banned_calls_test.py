#!/usr/bin/env python3
"""scripts/check_banned_calls.py finds each banned call, and leaves other text alone."""
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True  # write no cache files into scripts/
sys.path.insert(0, str(ROOT / "scripts"))
import check_banned_calls

BANNED = [
    "const double x = std::strtod(at, &rest);",
    "x = strtoull(text, nullptr, 10);",
    'double shortest(float v) { return std::stod(fmt::format("{}", v)); }',
    "const int n = std::stoi(text);",
    "const int n = std::atoi(text.c_str());",
    'std::sscanf(color.c_str(), "#%2x", &red);',
    'std::snprintf(buffer, sizeof buffer, "%s: %.3f m", name, x);',
    'std::printf("%-10g",\n            x);',
    "text += std::to_string(1.5);",
    "text += std::to_string(static_cast<double>(n));",
    "std::ostringstream out;",
    "std::stringstream both;",
    'std::setlocale(LC_ALL, "");',
    'std::locale::global(std::locale(""));',
    'text = fmt::format("{:.2Lf} {:L}", x, y);',
    'const double x = node.attribute("x").as_double();',
    "while (std::isspace(static_cast<unsigned char>(*at))) ++at;",
    "c = std::tolower(c);",
    "#include <cctype>",
]
ALLOWED = [
    "// std::strtod() depends on the locale\n/* atoi(text) */",
    "const auto x = parseNumber(text);",
    "text += std::to_string(count);",
    'std::fprintf(stderr, "%s: 100 %% of %d\\n", name, n);',
    "std::istringstream lines(text);",
    'log("call atoi");',
    'text = fmt::format("{:.3f} {}", x, "L");',
]


class CheckBannedCalls(unittest.TestCase):
    def problems(self, name, text):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / name
            path.parent.mkdir(parents=True)
            path.write_text(text, encoding="utf-8")
            return check_banned_calls.findings(pathlib.Path(folder))

    def test_each_banned_call_is_found_with_place_and_remedy(self):
        for text in BANNED:
            problems = self.problems("svt/core/text/bad.cpp", "\n\n" + text + "\n")
            self.assertTrue(problems, text)
            self.assertTrue(problems[0].startswith("svt/core/text/bad.cpp:3: '"), problems)
            self.assertIn("; ", problems[0])

    def test_other_text_is_left_alone(self):
        for text in ALLOWED:
            self.assertEqual(self.problems("apps/cli/good.cpp", text + "\n"), [], text)

    def test_tests_may_call_them(self):
        self.assertEqual(self.problems("svt/core/text/text_test.cpp", BANNED[0] + "\n"), [])

    def test_the_tree_passes(self):
        self.assertEqual(check_banned_calls.findings(ROOT), [])


if __name__ == "__main__":
    unittest.main()
