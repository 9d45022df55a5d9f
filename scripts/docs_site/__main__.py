"""Builds the documentation site into build/site. Called by scripts/site.sh."""
import argparse
import pathlib
import shutil

from . import benchmarks, cpp_api, live, python_api, runs, site_build, staging

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORK = ROOT / "build" / "site-work"
TARGET = ROOT / "build" / "site"


def main() -> None:
    parser = argparse.ArgumentParser(prog="scripts/site.sh", description=__doc__)
    parser.add_argument("--repository", default="", help="address of the repository on the web, for edit links")
    parser.add_argument("--branch", default="main", help="branch of the repository that edit links lead to")
    parser.add_argument(
        "--update-pictures", action="store_true", help="only renew the pictures of the pages in the tree"
    )
    parser.add_argument(
        "--build", type=pathlib.Path, default=ROOT / "build" / "release", help="folder of the built program"
    )
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    viewer = build / "share" / "svt" / "viewer"
    for needed, remedy in (
        (build / "bin" / "svt", "build"),
        (viewer / "index.html", "viewer"),
        (build / "python" / "svt", "python"),
    ):
        if not needed.exists():
            raise SystemExit(f"site: {needed} is missing; 'make {remedy}' builds it")

    pages = WORK / "pages"
    shutil.rmtree(pages, ignore_errors=True)
    staged = staging.Staging(ROOT, pages, runs.Runner(build, WORK / "runs"))
    staged.add_all()
    if arguments.update_pictures:
        staged.update_tree()
        return
    staged.add("python/api.md", python_api.python_api(ROOT / "python" / "svt"))
    staged.add("reference/cpp.md", cpp_api.page(ROOT))
    staged.add("benchmarks/index.md", benchmarks.benchmarks(ROOT))
    (pages / "assets").mkdir(exist_ok=True)
    shutil.copyfile(ROOT / "docs" / "images" / "logo.svg", pages / "assets" / "logo.svg")

    fresh = WORK / "site"
    shutil.rmtree(fresh, ignore_errors=True)
    site_build.build_site(staged, fresh, arguments.repository, arguments.branch)
    headers = cpp_api.cpp_api(ROOT, WORK / "cpp", fresh / "cpp")
    live.publish(build / "bin" / "svt", viewer, WORK / "models", fresh / "live")
    shutil.rmtree(TARGET, ignore_errors=True)
    fresh.rename(TARGET)
    print(f"site: {len(staged.pages)} pages and the C++ API of {headers} headers in build/site; try it with")
    print("      'python3 -m http.server --directory build/site'")


main()
