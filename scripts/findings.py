"""What scripts that check the tree have in common."""
import sys
from pathlib import Path
from typing import Callable


def report(findings: Callable[[Path], list[str]]) -> int:
    """Prints what `findings` says of the tree, by default this checkout, a line each. Returns the exit code."""
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent
    problems = findings(root)
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0
