#!/usr/bin/env python3
"""Runs a test module of this folder for ctest. Exits with 77 and a message if a requirement is missing.

    run.py MODULE [NEEDED...]     such as: run.py test_examples scipy
"""
import importlib.util
import os
import pathlib
import sys
import sysconfig
import unittest


GROUPS = {"numpy": "python", "scipy": "python"}  # of scripts/setup.sh; all others are in `readers`


def missing(needed):
    for name in ["numpy", *needed]:
        if importlib.util.find_spec(name) is None:
            return f"no {name} (scripts/setup.sh {GROUPS.get(name, 'readers')} installs it)"
    folder = pathlib.Path(os.environ.get("PYTHONPATH", "").split(os.pathsep)[0])
    if not (folder / "svt" / f"_native{sysconfig.get_config_var('EXT_SUFFIX')}").is_file():
        return "the module is not built (make python)"
    return None


def main():
    module, *needed = sys.argv[1:]
    why = missing(needed)
    if why is not None:
        print(f"SKIPPED: {why}")
        return 77
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    result = unittest.main(module=None, argv=["run.py", module], exit=False).result
    for test, reason in result.skipped:
        print(f"SKIPPED: {test}: {reason}")
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
