"""Write the reference from docstrings and from what fields say of themselves."""

import ast
import dataclasses
import inspect
import re
import textwrap
from pathlib import Path
from typing import Any

import numpy as np
from public_names import PARTS, THEORY, functions

from jdsmc import theory
from jdsmc.scenarios import AbstractScene
from jdsmc.scenarios.base import command_of

PAGE_NAME = re.compile(r"`?\bdocs/(\w+\.md)`?")
SECTION = re.compile(r"(Arguments|Returns|Raises):$")
ITEM = re.compile(r"    (\S[^:]*): (.*)")
CODE = re.compile(r"`[^`]*`")


def write(folder: Path) -> None:
    """One page a part, and one for all of the theory, into a folder."""
    folder.mkdir(exist_ok=True)
    for name, part in PARTS.items():
        body = [heading(1, part.title), prose(part.intro)]
        body += [entry(where, thing) for where, thing in part.things.items()]
        (folder / f"api_{name}.md").write_text("\n\n".join(body) + "\n", encoding="utf-8")
    body = [heading(1, "Theory"), prose(theory.__doc__ or "")]
    for name, module in THEORY.items():
        body += [heading(2, f"`jdsmc.theory.{name}`"), prose(module.__doc__ or "")]
        body += [entry(where, thing) for where, thing in functions(module).items()]
    (folder / "api_theory.md").write_text("\n\n".join(body) + "\n", encoding="utf-8")


def heading(level: int, text: str) -> str:
    """A heading of a page."""
    return f"{'#' * level} {text}"


def entry(where: str, thing: Any) -> str:
    """A function, or a class with its fields and methods."""
    if inspect.isfunction(thing):
        return directive("function", where + signature(thing), [prose(doc(thing))])
    body = [prose(doc(thing))]
    if issubclass(thing, AbstractScene) and not inspect.isabstract(thing):
        body.append(f"On the command line: `jdsmc run {command_of(thing)}`.")
    arguments = ""
    if fields := own_fields(thing):
        arguments = f"({', '.join(as_argument(field) for field in fields)})"
        body.append(field_table(fields))
    if not issubclass(thing, AbstractScene) or inspect.isabstract(thing):
        body += [member(name, one) for name, one in members(thing)]
    return directive("class", where + arguments, [part for part in body if part], deep=True)


def directive(kind: str, words: str, body: list[str], deep: bool = False) -> str:
    """An entry that the index and the search find."""
    fence = "::::::" if deep else ":::::"
    return f"{fence}{{py:{kind}}} {words}\n\n" + "\n\n".join(body) + f"\n{fence}"


def doc(thing: Any) -> str:
    """Its own docstring; that of the class above says nothing of this one."""
    return inspect.cleandoc(thing.__doc__ or "")


def signature(function: Any, method: bool = False) -> str:
    """Arguments with types as they are written, and what is returned."""
    (tree,) = ast.parse(textwrap.dedent(inspect.getsource(function))).body
    assert isinstance(tree, ast.FunctionDef)
    if method:
        tree.args.args = tree.args.args[1:]
    returns = f" -> {ast.unparse(tree.returns)}" if tree.returns else ""
    words = f"({ast.unparse(tree.args)}){returns}"
    return re.sub(r" = REQUIRED\b", "", re.sub(r"(: |-> )'(\w+)'", r"\1\2", words))


def own_fields(thing: type) -> list[dataclasses.Field]:
    """The fields that are given to make one, with those of the classes above."""
    if not dataclasses.is_dataclass(thing) or inspect.isabstract(thing):
        return []
    return [f for f in dataclasses.fields(thing) if f.init and not f.metadata.get("derived")]


def as_argument(field: dataclasses.Field) -> str:
    """As in a signature."""
    missing = field.default is dataclasses.MISSING
    return field.name if missing else f"{field.name}={shown(field.default)}"


def shown(value: Any) -> str:
    """A value as it would be typed."""
    return f"{value:g}" if isinstance(value, float) else repr(value)


def field_table(fields: list[dataclasses.Field]) -> str:
    """Meaning, unit and range of the described fields; nothing if none is described."""
    rows = []
    for field in fields:
        facts = field.metadata
        if "meaning" in facts:
            words = facts["meaning"].replace("|", "\\|")
            unit = facts.get("unit", "")
            rows.append(f"| `{field.name}` | {escaped(words)} | {unit} | {allowed(facts)} |")
    head = "| number | meaning | unit | allowed |\n|---|---|---|---|"
    return "\n".join([head, *rows]) if rows else ""


def allowed(facts: Any) -> str:
    """What a field may hold."""
    if "choices" in facts:
        return ", ".join(f'`"{one}"`' for one in facts["choices"])
    if "least" in facts:
        return f"whole, at least {facts['least']}"
    found = facts.get("range")
    if not found:
        return ""
    low, high = (
        f"{found[end]:g}".replace("-inf", "-∞").replace("inf", "∞") for end in ("low", "high")
    )
    left = "[" if found["low_included"] and np.isfinite(found["low"]) else "("
    right = "]" if found["high_included"] and np.isfinite(found["high"]) else ")"
    names = "".join(f', or `"{name}"`' for name in facts["names"])
    return f"{left}{low}, {high}{right}{names}"


def members(thing: type) -> list[tuple[str, Any]]:
    """Public methods and properties that a class itself explains."""
    return [
        (name, one)
        for name, one in vars(thing).items()
        if not name.startswith("_")
        and (inspect.isfunction(one) or isinstance(one, property))
        and one.__doc__
    ]


def member(name: str, one: Any) -> str:
    """A method or a property."""
    if isinstance(one, property):
        return directive("property", name, [prose(doc(one))])
    return directive("method", name + signature(one, method=True), [prose(doc(one))])


def prose(text: str) -> str:
    """A docstring as Markdown: sections become lists, indented blocks code, stars stay stars."""
    lines, out, k = inspect.cleandoc(text).splitlines(), [], 0
    while k < len(lines):
        line = lines[k]
        if SECTION.match(line):
            block, k = indented(lines, k + 1)
            out += [f"**{line[:-1]}**", "", *items(block), ""]
        elif line.startswith("    ") and (k == 0 or not lines[k - 1]):
            block, k = indented(lines, k)
            kind = (
                "python"
                if re.search(r"^\s*(def|class|import) ", "\n".join(block), re.M)
                else "text"
            )
            out += [f"```{kind}", *textwrap.dedent("\n".join(block)).splitlines(), "```", ""]
        else:
            out.append(escaped(line.strip() if line.startswith("    ") else line))
            k += 1
    return "\n".join(out).strip()


def indented(lines: list[str], start: int) -> tuple[list[str], int]:
    """The indented block that begins there, and where it ends."""
    end = start
    while end < len(lines) and (not lines[end] or lines[end].startswith("    ")):
        end += 1
    while end > start and not lines[end - 1]:
        end -= 1
    return lines[start:end], end


def items(block: list[str]) -> list[str]:
    """`name: meaning` as a list; a line that goes on belongs to the item above."""
    out: list[str] = []
    for line in block:
        found = ITEM.match(line)
        if found:
            names = ", ".join(f"`{name.strip(' `')}`" for name in found[1].split(","))
            out.append(f"- {names}: {escaped(found[2])}")
        else:
            out.append(("  " if out else "") + escaped(line.strip()))
    return out


def escaped(text: str) -> str:
    """Text that Markdown shows as it is, pages being linked and code being left alone."""
    text = PAGE_NAME.sub(r"[](../\1)", text)
    parts, last = [], 0
    for code in CODE.finditer(text):
        parts += [plain(text[last : code.start()]), code[0]]
        last = code.end()
    return "".join([*parts, plain(text[last:])])


def plain(text: str) -> str:
    """Without stars, angles and dollars that would mean something, nor a line that quotes."""
    return re.sub(r"([*<$]|^>)", r"\\\1", text)
