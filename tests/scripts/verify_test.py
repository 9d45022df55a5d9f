#!/usr/bin/env python3
"""scripts/verify.py runs the heavy checks that fit into the time, and ends those that do not."""
import contextlib
import io
import pathlib
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True  # write no cache files into scripts/
sys.path.insert(0, str(ROOT / "scripts"))
import verify


class Turns(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = pathlib.Path(folder.name)
        verify.ROOT = self.work
        verify.WORK, verify.LOCAL = self.work / "verify", self.work / "verify" / "results.json"
        verify.SHARED, verify.TRACKED = self.work / "shared.json", self.work / "tracked.json"
        verify.git = lambda *words, **more: "1234"

    def turn(self, minutes: float, checks: dict) -> tuple[bool, str, dict]:
        verify.CHECKS = checks
        with contextlib.redirect_stdout(io.StringIO()) as said:
            passed = verify.take_turns(minutes, "tree")
        return passed, said.getvalue(), verify.results_in(verify.SHARED)

    def test_checks_that_do_not_fit_are_named_and_shorter_ones_run(self) -> None:
        passed, said, results = self.turn(1, {"long": verify.Check("false", 25), "short": verify.Check("true", 0.5)})
        self.assertTrue(passed)
        self.assertEqual(["short"], list(results))
        self.assertIn("no time was left for long", said)

    def test_a_check_that_still_runs_is_ended_with_its_processes_and_keeps_no_result(self) -> None:
        mark = self.work / "mark"
        start = time.monotonic()
        command = f"(sleep 3; touch {mark}) & setsid bash -c 'sleep 3; touch {mark}' & timeout 600 sleep 600"
        passed, said, results = self.turn(0.01, {"hangs": verify.Check(command, 0.001)})
        self.assertTrue(passed)
        self.assertLess(time.monotonic() - start, 300)
        self.assertEqual({}, results)
        self.assertIn("hangs was ended", said)
        self.assertIn("no time was left for hangs", said)
        time.sleep(4)
        self.assertFalse(mark.exists())

    def test_a_failed_check_fails_and_is_the_next(self) -> None:
        checks = {"good": verify.Check("true", 0.1), "bad": verify.Check("echo why; false", 0.1)}
        passed, said, results = self.turn(5, checks)
        self.assertFalse(passed)
        self.assertIn("why", said)
        self.assertEqual(
            {"good": "passed", "bad": "failed"}, {name: found["result"] for name, found in results.items()}
        )
        self.assertEqual("bad", verify.turns()[0])


if __name__ == "__main__":
    unittest.main()
