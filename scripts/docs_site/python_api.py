"""The page of the Python API, from the docstrings and signatures of python/svt, without importing it."""
import ast
import inspect
import pathlib
import re
from typing import Optional, Union

Definition = Union[ast.ClassDef, ast.FunctionDef]

# Docstrings that the package completes with the options of a command when it is loaded.
COMPLETED = {
    "build": "The keywords are the options of [`svt build`](docs/user/build.md).",
    "render": "The keywords are the options of [`svt render`](docs/user/render.md).",
    "save": "The keywords are the options of [`svt convert`](docs/user/convert.md).",
}
INTRODUCTION = """# Python API

This page lists the public functions and classes of the module `svt`, from their docstrings.
[SVT in Python](docs/python/README.md) is the guide: installation, conventions, five examples. Lengths are metres, points are in
the coordinates of the model, and arrays of samples are indexed `[k, j, i]`.
"""


def python_api(package: pathlib.Path) -> str:
    """The page as Markdown; links are paths from the top of the tree."""
    names = _public_names(package / "__init__.py")
    definitions: dict[str, Definition] = {}
    sources: dict[str, list[str]] = {}
    docs: dict[str, str] = {}
    for path in [package / "_native.pyi", *sorted(package.glob("*.py"))]:
        source = path.read_text(encoding="utf-8")
        for node in ast.parse(source).body:
            is_private = path.suffix == ".pyi" and not (
                isinstance(node, ast.ClassDef) and node.name in ("Feature", "Label")
            )
            if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and node.name in names and not is_private:
                definitions[node.name] = node
                sources[node.name] = source.splitlines()
            elif isinstance(node, ast.Assign) and ast.unparse(node.targets[0]).endswith(".__doc__"):
                docs[ast.unparse(node.targets[0])[: -len(".__doc__")]] = _assigned(node.value)
    missing = [name for name in names if name not in definitions and name not in ("__version__",)]
    functions = [name for name in names if isinstance(definitions.get(name), ast.FunctionDef)]
    classes = [name for name in names if isinstance(definitions.get(name), ast.ClassDef)]
    text = [INTRODUCTION, "## Functions\n"]
    text += [_function(definitions[name], f"svt.{name}", docs.get(name)) for name in functions]
    text += [_class(definitions[name], docs, sources[name]) for name in classes]
    if missing:
        raise SystemExit(f"site: python/svt has no definition of {', '.join(missing)}, which its __init__.py lists")
    return "\n".join(text)


def _public_names(path: pathlib.Path) -> list[str]:
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            return list(ast.literal_eval(node.value))
    raise SystemExit(f"site: {path} has no __all__")


def _assigned(value: ast.expr) -> str:
    """A docstring that is an f-string, without its variable parts."""
    parts = value.values if isinstance(value, ast.JoinedStr) else [value]
    text = "".join(str(part.value) for part in parts if isinstance(part, ast.Constant))
    return inspect.cleandoc(re.sub(r"Options of `svt \w+`, as keywords[^:]*: *\n", "", text))


def _function(node: Definition, name: str, doc: Optional[str]) -> str:
    assert isinstance(node, ast.FunctionDef)
    body = _markdown(doc or ast.get_docstring(node) or "")
    if node.name in COMPLETED and doc:
        body += "\n\n" + COMPLETED[node.name]
    return f"### `{name}`\n\n```python\n{_signature(node, name.split('.')[-1])}\n```\n\n{body}\n"


def _signature(node: ast.FunctionDef, name: str) -> str:
    arguments = re.sub(r"^(self|cls)(, )?", "", ast.unparse(node.args).replace("_native.", ""))
    # With a type, a default has blanks around its sign.
    parts = [re.sub(r"^(\w+: [^=]+)=", r"\1 = ", part) for part in _split(arguments)] if arguments else []
    returns = f" -> {ast.unparse(node.returns)}".replace("_native.", "") if node.returns else ""
    line = f"{name}({', '.join(parts)}){returns}"
    if len(line) <= 90:
        return line
    return f"{name}(\n" + "".join(f"    {part},\n" for part in parts) + f"){returns}"


def _split(arguments: str) -> list[str]:
    """Splits at commas outside of brackets."""
    parts, depth, current = [], 0, ""
    for character in arguments:
        depth += (character in "([{") - (character in ")]}")
        if character == "," and depth == 0:
            parts.append(current.strip())
            current = ""
        else:
            current += character
    return [*parts, current.strip()]


def _class(node: Definition, docs: dict[str, str], source: list[str]) -> str:
    """A class: its docstring, a table of its attributes, its methods."""
    assert isinstance(node, ast.ClassDef)
    text = [f"## Class `svt.{node.name}`\n", _markdown(ast.get_docstring(node) or "") + "\n"]
    rows, methods = [], []
    for member in node.body:
        if isinstance(member, ast.AnnAssign) and isinstance(member.target, ast.Name):
            comment = source[member.lineno - 1].partition("#:")[2].strip()
            rows.append((member.target.id, ast.unparse(member.annotation), comment))
        elif isinstance(member, ast.FunctionDef) and not member.name.startswith("_"):
            decorators = [ast.unparse(decorator) for decorator in member.decorator_list]
            if any(decorator.endswith("property") for decorator in decorators):
                kind = ast.unparse(member.returns) if member.returns else ""
                rows.append((member.name, kind, _markdown(ast.get_docstring(member) or "")))
            elif not any(decorator.endswith(".setter") for decorator in decorators):
                methods.append(member)
    if rows:
        text.append("| attribute | type | meaning |\n|---|---|---|")
        text += [f"| `{name}` | `{_cell(kind)}` | {_cell(meaning)} |" for name, kind, meaning in rows]
        text.append("")
    for method in methods:
        name = f"{node.name}.{method.name}"
        text.append(_function(method, name, docs.get(name)))
    return "\n".join(text)


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("_native.", "").replace("|", r"\|")


def _markdown(doc: str) -> str:
    """A docstring in the style of numpy as Markdown."""
    doc = re.sub(r":(?:func|meth):`([^`]+)`", r"`\1()`", doc)
    doc = re.sub(r":\w+:`([^`]+)`", r"`\1`", doc).replace("``", "`")
    lines, result, index = doc.splitlines(), [], 0
    in_list = False
    while index < len(lines):
        line = lines[index]
        if index + 1 < len(lines) and re.fullmatch(r"-{3,}", lines[index + 1]):
            result += ["", f"**{line}**", ""]
            in_list, index = True, index + 2
            continue
        describes = index + 1 < len(lines) and lines[index + 1].startswith("    ")
        if in_list and line and not line.startswith(" ") and (describes or " : " in line):
            name, _, kind = line.partition(" : ")
            result.append(f"- `{name}`" + (f" ({kind})" if kind else "") + ":")
        elif in_list and line.startswith("    "):
            result.append("  " + line.strip())
        else:
            result.append(line)
        index += 1
    return "\n".join(result)
