#!/usr/bin/env python3
"""scripts/check_hardening.sh names what a program lacks, and takes one that lacks nothing: check_hardening_test.py COMPILER."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_hardening.sh"
COMPILER = sys.argv.pop(1) if len(sys.argv) > 1 else "c++"
SOURCE = """
#include <cstdio>
#include <cstring>
#include <vector>
const char* volatile path = PATH;
int main(int argc, char** argv) {
    char text[16];
    volatile char pages[20000];  // a frame of several pages
    pages[argc] = 1;
    std::strcpy(text, argv[argc - 1]);  // of unknown length: checked where _FORTIFY_SOURCE is defined
    const std::vector<int> numbers(2, pages[argc]);
    return std::printf("%s%s%d", text, path, numbers[argc]) == 0;
}
"""
# What makes a hardened program.
HARDENED: dict[str, list[str]] = {
    "pie": ["-fPIE", "-pie"],
    "relro": ["-Wl,-z,relro"],
    "now": ["-Wl,-z,now"],
    "protector": ["-fstack-protector-strong"],
    "fortify": ["-O2", "-U_FORTIFY_SOURCE", "-D_FORTIFY_SOURCE=2"],
    "stack": ["-Wl,-z,noexecstack"],
    "clash": ["-fstack-clash-protection"],
    "assertions": ["-D_GLIBCXX_ASSERTIONS"],
    "path": ['-DPATH="svt/core/file.cpp"'],
    "rpath": [],
}


class CheckHardening(unittest.TestCase):
    def check(self, **other: list[str]) -> tuple[str, int]:
        """What the script prints of a program that is built with other flags, and its exit code."""
        with tempfile.TemporaryDirectory() as folder:
            source, program = pathlib.Path(folder, "a.cpp"), pathlib.Path(folder, "a")
            source.write_text(SOURCE, encoding="utf-8")
            flags = [flag for group in (HARDENED | other).values() for flag in group]
            subprocess.run([COMPILER, *flags, "-w", source, "-o", program], check=True)
            done = subprocess.run([SCRIPT, program, "/home/builder/svt"], capture_output=True, text=True)
            return done.stdout, done.returncode

    def test_takes_a_hardened_program(self):
        self.assertEqual(self.check(), ("", 0))

    def test_names_what_is_missing(self):
        faults: list[tuple[dict[str, list[str]], str]] = [
            ({"pie": ["-fno-PIE", "-no-pie"]}, "not position independent"),
            ({"relro": ["-Wl,-z,norelro"]}, "no RELRO"),
            ({"now": ["-Wl,-z,lazy"]}, "no -z now"),
            ({"protector": ["-fno-stack-protector"]}, "no stack protector"),
            ({"fortify": ["-O2", "-U_FORTIFY_SOURCE"]}, "no checks of buffer sizes"),
            ({"stack": ["-Wl,-z,execstack"]}, "the stack is executable"),
            ({"clash": ["-fno-stack-clash-protection"]}, "large frames skip pages of the stack"),
            ({"assertions": []}, "no checks of the standard library"),
            ({"rpath": ["-Wl,-rpath,/home/builder/lib"]}, "RPATH or RUNPATH"),
            (
                {"path": ['-DPATH="/home/builder/svt/svt/core/file.cpp"']},
                "names paths of its build: /home/builder/svt/svt/core/file.cpp",
            ),
        ]
        for flags, fault in faults:
            text, code = self.check(**flags)
            self.assertIn(fault, text)
            self.assertEqual((code, len(text.splitlines())), (1, 1), text)

    def test_reads_the_paths_of_a_web_module(self):
        for text, code, said in [
            (b"svt/core/file.cpp", 0, ""),
            (b"/home/builder/svt-2/svt/core/file.cpp", 0, ""),
            (b"/home/builder/svt/build/web/a.cpp", 1, "names paths of its build: /home/builder/svt/build/web/a.cpp"),
        ]:
            with tempfile.TemporaryDirectory() as folder:
                module = pathlib.Path(folder, "a.wasm")
                module.write_bytes(b"\0asm\1\0\0\0" + text + b"\0")
                done = subprocess.run([SCRIPT, module, "/home/builder/svt"], capture_output=True, text=True)
                self.assertEqual(done.returncode, code, done.stdout + done.stderr)
                self.assertIn(said, done.stdout)

    def test_skips_what_is_not_built(self):
        done = subprocess.run([SCRIPT, "/nowhere/svt"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 77)


if __name__ == "__main__":
    if not shutil.which("readelf") or not shutil.which("nm"):
        print("skipped: readelf or nm is missing")
        sys.exit(77)
    unittest.main()
