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
    "SVT_TRY(bytes, FileBytes::map(input / file));",
    "auto map = &svt::FileBytes :: map;",
    "void* memory = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);",
    "void* memory = mmap64(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);",
    "#include <sys/mman.h>",
    "thread_local ZlibPacker packer(1);",
    "thread_local std::vector<int> seen;",
    "if (std::ranges::all_of(rows, isEmpty)) return;",
]
ALLOWED = [
    "// std::strtod() depends on the locale\n/* atoi(text) */",
    "const auto x = parseNumber(text);",
    "text += std::to_string(count);",
    'std::fprintf(stderr, "%s: 100 %% of %d\\n", name, n);',
    "std::istringstream lines(text);",
    'log("call atoi");',
    'text = fmt::format("{:.3f} {}", x, "L");',
    "// FileBytes::map() maps\nconst auto file = FileBytes::read(path);",
    "std::map<int, int> map(pairs.begin(), pairs.end());",
    "thread_local bool isInLoop = false;",
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

    def test_only_files_with_a_reason_may_map(self):
        call = "SVT_TRY(bytes, FileBytes::map(path));\n"
        for name, reason in check_banned_calls.MAY_MAP.items():
            self.assertTrue(reason)
            self.assertEqual(self.problems(name, call), [], name)
            self.assertTrue(self.problems(name, BANNED[0] + "\n"), name + " may do no more than map")
        self.assertTrue(self.problems("apps/cli/options/city_page.cpp", call))

    def test_each_file_that_may_map_does(self):
        for name in check_banned_calls.MAY_MAP:
            text = check_banned_calls.without_comments((ROOT / name).read_text(encoding="utf-8"))
            self.assertRegex(text, r"FileBytes::map\(", name)

    def test_the_tree_passes(self):
        self.assertEqual(check_banned_calls.findings(ROOT), [])


if __name__ == "__main__":
    unittest.main()
