"""Long work: progress, Ctrl-C, other threads; the page; the stubs."""
import ast
import os
import pathlib
import signal
import subprocess
import sys
import textwrap
import threading
import unittest
import urllib.request

import numpy as np

import svt
from common import COMMAND, house, house_file, needs_command, path


def run_python(text, *arguments, **options):
    return subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(text), *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        **options,
    )


class Work(unittest.TestCase):
    def test_progress_is_told_on_the_calling_thread(self):
        told, threads = [], set()

        def report(stage, fraction):
            told.append((stage, fraction))
            threads.add(threading.get_ident())

        svt.build(house_file(), spacing=0.1, progress=report)
        stages = [stage for stage, _ in told]
        self.assertIn("voxelize", stages)
        self.assertTrue(all(0 <= fraction <= 1 for _, fraction in told))
        self.assertEqual(threads, {threading.get_ident()})

    def test_exception_of_progress_stops_and_comes_out(self):
        class Enough(Exception):
            pass

        def report(stage, fraction):
            raise Enough(stage)

        with self.assertRaises(Enough):
            svt.build(house_file(), spacing=0.02, progress=report)
        self.assertEqual(house().shape, house().dense().shape)  # nothing is left in disorder

    def test_ctrl_c_ends_long_work(self):
        # Fine enough to take seconds; the signal comes when the voxels begin.
        child = run_python(
            """
            import sys, svt
            stages = []

            def report(stage, fraction):
                if stage not in stages:
                    stages.append(stage)
                    print(stage, flush=True)

            try:
                svt.build(sys.argv[1], spacing=0.0025, vectors="none", progress=report)
            except KeyboardInterrupt:
                print("stopped", flush=True)
            """,
            house_file(),
        )
        try:
            for stage in child.stdout:
                if stage == "voxelize\n":
                    break
            child.send_signal(signal.SIGINT)
            out, err = child.communicate(timeout=900)
            # And none of the stages that come after the voxels.
            self.assertEqual(out, "stopped\n", err)
        finally:
            child.kill()
            child.communicate()

    def test_other_threads_run_meanwhile(self):
        turns, is_done = 0, threading.Event()

        def work():
            svt.build(house_file(), spacing=0.03)
            is_done.set()

        thread = threading.Thread(target=work)
        thread.start()
        while not is_done.wait(0.002):
            turns += 1
        thread.join()
        self.assertGreater(turns, 10)

    def test_threads_may_share_a_volume(self):
        v = svt.build(house_file(), spacing=0.1)
        points = v.box[0] + np.random.default_rng(1).random((20000, 3)) * (v.box[1] - v.box[0])
        expected = [
            v.sample(points),
            v.render(size=(80, 60)),
            v.rays(points[:100], (0, 0, 1)).all,
            v.section("z=1.2").area,
        ]
        fresh = svt.build(house_file(), spacing=0.1)
        wrong: list = []

        def work():
            for _ in range(3):
                found = [
                    fresh.sample(points),
                    fresh.render(size=(80, 60)),
                    fresh.rays(points[:100], (0, 0, 1)).all,
                    fresh.section("z=1.2").area,
                ]
                wrong.extend(n for n in range(4) if not np.array_equal(found[n], expected[n]))

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_import_sets_nothing_of_the_process(self):
        child = run_python(
            """
            import resource, signal
            before = [resource.getrlimit(r) for r in (resource.RLIMIT_DATA, resource.RLIMIT_AS)], signal.getsignal(signal.SIGINT)
            import sys, svt
            v = svt.build(sys.argv[1], spacing=0.2)
            v.render(size=(16, 16))
            print(before == ([resource.getrlimit(r) for r in (resource.RLIMIT_DATA, resource.RLIMIT_AS)],
                             signal.getsignal(signal.SIGINT)))
            """,
            house_file(),
        )
        out, err = child.communicate(timeout=900)
        self.assertEqual(out, "True\n", err)
        self.assertEqual(err, "")


class Page(unittest.TestCase):
    @needs_command
    def test_view_serves_the_page_until_it_is_closed(self):
        # The page is built by another target: here a word stands for it.
        os.makedirs(path("page"), exist_ok=True)
        with open(path("page/index.html"), "w") as file:
            file.write("<html>the page</html>")
        with open(path("svt.sh"), "w") as file:
            file.write(f'#!/bin/sh\nexec "{COMMAND}" "$@" --viewer "{path("page")}"\n')
        os.chmod(path("svt.sh"), 0o755)
        os.environ["SVT_COMMAND"] = path("svt.sh")
        try:
            with house().view(height=321) as view:
                self.assertIn(view.address, view._repr_html_())
                self.assertIn('height="321"', view._repr_html_())
                with urllib.request.urlopen(view.address, timeout=300) as reply:
                    self.assertIn(b"the page", reply.read())
            with self.assertRaises(OSError):
                urllib.request.urlopen(view.address, timeout=2)
            os.rename(path("page/index.html"), path("page/gone.html"))
            with self.assertRaises(svt.Error) as caught:
                house().view()
            self.assertIn("index.html", caught.exception.message)
        finally:
            os.environ["SVT_COMMAND"] = COMMAND

    def test_missing_command_is_told(self):
        old = os.environ.pop("SVT_COMMAND", None)
        path_before, os.environ["PATH"] = os.environ["PATH"], ""
        try:
            with self.assertRaises(svt.Error) as caught:
                house().view()
            self.assertIn("svt", caught.exception.message)
        finally:
            os.environ["PATH"] = path_before
            if old is not None:
                os.environ["SVT_COMMAND"] = old


class Stubs(unittest.TestCase):
    def test_stub_of_the_native_module_has_all_of_it(self):
        from svt import _native

        stub = ast.parse(pathlib.Path(svt.__file__).with_name("_native.pyi").read_text(encoding="utf-8"))
        told: dict = {}
        for node in stub.body:
            if isinstance(node, ast.ClassDef):
                told[node.name] = {n.name for n in node.body if isinstance(n, ast.FunctionDef)}
            elif isinstance(node, ast.FunctionDef):
                told[node.name] = None
            elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
                told[node.target.id] = None
        real = {
            name: {m for m in vars(value) if not m.startswith("_")} if isinstance(value, type) else None
            for name, value in vars(_native).items()
            if not name.startswith("_")
        }
        self.assertEqual(
            {
                name: members and {m for m in members if not m.startswith("_")}
                for name, members in told.items()
                if not name.startswith("_")
            },
            real,
        )

    def test_public_names_have_docstrings(self):
        for name in svt.__all__:
            value = getattr(svt, name)
            self.assertTrue(value.__doc__, name)
            if isinstance(value, type):
                for member, thing in vars(value).items():
                    if not member.startswith("_") and callable(thing) and name not in ("Place", "Finding", "Axes"):
                        self.assertTrue(thing.__doc__, f"{name}.{member}")


if __name__ == "__main__":
    unittest.main()
