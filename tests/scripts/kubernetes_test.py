#!/usr/bin/env python3
"""The YAML of 'svt city run --engine kubernetes --print': read by another reader, and what its shell lines do.

    kubernetes_test.py SVT
"""
import os
import pathlib
import subprocess
import sys
import tempfile

try:
    import yaml
except ImportError:
    print("skipped: python3-yaml is missing (scripts/setup.sh slurm)")
    sys.exit(77)

svt = os.path.abspath(sys.argv[1])


def run(*arguments, **options):
    return subprocess.run([svt, *arguments], capture_output=True, text=True, **options)


def check(condition, what):
    if not condition:
        sys.exit(f"kubernetes: {what}")


with tempfile.TemporaryDirectory() as folder:
    home = pathlib.Path(folder) / "it's: a #town"
    home.mkdir()
    os.chdir(home)
    check(run("sample", "city", "--buildings", "60", "-o", "files").returncode == 0, "no files")
    check(
        run(
            "city", "plan", "files", "-o", "town", "--spacing", "1", "--pack-seconds", "0.01", "--tasks", "3"
        ).returncode
        == 0,
        "no plan",
    )
    options = ["image=registry.example/svt:1", "--claim=disk", "namespace=maps", "cpu=2", "memory=3Gi", "parallelism=2"]
    printed = run("city", "run", "town", "--engine", "kubernetes", "--print", "--", *options)
    check(printed.returncode == 0, printed.stderr)
    tasks, merge = yaml.safe_load_all(printed.stdout)
    for job in tasks, merge:
        check(job["apiVersion"] == "batch/v1" and job["kind"] == "Job", "not a Job")
        name = job["metadata"]["name"]
        check(len(name) <= 63 and all(c.isalnum() and c == c.lower() or c == "-" for c in name), f"name {name}")
        check(job["metadata"]["namespace"] == "maps", "namespace")
        pod = job["spec"]["template"]["spec"]
        check(pod["restartPolicy"] == "Never", "restartPolicy")  # backoffLimitPerIndex needs it
        (container,) = pod["containers"]
        check(container["image"] == options[0][6:], "image")
        check(
            container["resources"] == {"requests": {"cpu": "2", "memory": "3Gi"}, "limits": {"memory": "3Gi"}},
            "resources",
        )
        check(container["volumeMounts"] == [{"name": "data", "mountPath": str(home)}], "mount")
        check(pod["volumes"] == [{"name": "data", "persistentVolumeClaim": {"claimName": "disk"}}], "claim")
        check(container["command"][:2] == ["/bin/sh", "-c"] and len(container["command"]) == 3, "command")
    spec = tasks["spec"]
    check(spec["completionMode"] == "Indexed", "completionMode")
    count = spec["completions"]
    check(1 <= count <= 3 and spec["parallelism"] == min(2, count) and spec["maxFailedIndexes"] == count, "counts")
    check(spec["backoffLimitPerIndex"] == 3, "backoffLimitPerIndex")
    check(merge["spec"]["suspend"] is True, "the merge has to wait")

    # The lines that pods would run, here.
    environment = dict(os.environ, PATH=os.path.dirname(svt) + ":" + os.environ["PATH"])
    for index in range(count):
        subprocess.run(
            tasks["spec"]["template"]["spec"]["containers"][0]["command"],
            check=True,
            env=dict(environment, JOB_COMPLETION_INDEX=str(index)),
            stdout=subprocess.DEVNULL,
            cwd="/",
        )
    subprocess.run(
        merge["spec"]["template"]["spec"]["containers"][0]["command"],
        check=True,
        env=environment,
        stdout=subprocess.DEVNULL,
        cwd="/",
    )
    info = run("city", "info", "town")
    check(info.stdout.startswith("60 buildings"), info.stdout + info.stderr)

    for wrong in (["--", "colour=red"], ["--", "image="], ["--", "mount=/nowhere"], ["--", "parallelism=many"]):
        answer = run("city", "run", "town", "--engine", "kubernetes", "--print", *wrong)
        check(answer.returncode == 2 and "E904" in answer.stderr, f"{wrong}: {answer}")
    answer = run("city", "run", "town", "--engine", "kubernetes")
    check(answer.returncode == 2 and "--print" in answer.stderr, str(answer))
    answer = run("city", "run", "town", "--print")
    check(answer.returncode == 2, str(answer))
print("kubernetes: done")
