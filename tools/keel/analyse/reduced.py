# SPDX-License-Identifier: Apache-2.0
"""The source as Eva reads it: of all annotations only what each contract says is assigned.

Eva cannot judge the other clauses, which are proved by others, and an annotation that it takes for
false would end its analysis. Lines stay where they are.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

ANNOTATION = re.compile(r"/\*@.*?\*/|//@[^\n]*", re.DOTALL)
BEHAVIOR = re.compile(r"\bbehavior\b")
ASSIGNS = re.compile(r"\bassigns\b[^;]*;")
LINE_START = re.compile(r"\n\s*@")
INDEX = re.compile(r"\[[^][]*\]")
FIELD = re.compile(r"(\[\.\.\]|\))(?:\.\w+)+")
MACRO = re.compile(r"\b([A-Z][A-Z_]+)\(")
DEFINITION = re.compile(r"^#define (\w+)\([^)]*\)(?:[^\n]*\\\n)*[^\n]*", re.MULTILINE)
NO_CONTRACT = re.compile(
    r"/\*@\s*(?:ghost|loop|for|predicate|logic|lemma|assert|inductive|calls)\b"
)
# It stands for the scheduler that runs, and exists as a ghost only.
GHOST = "running_scheduler"
PUBLIC = re.compile(r"/\*@ assigns (?:(?!\*/).)*\*/\s*(?:static inline )?[\w ]+?[ *](keel_\w+)\(")


def widened(clause: str) -> str:
    """A clause with every index left open: the whole array instead of an element, or of one of its
    fields, which From cannot name."""
    before = ""
    while before != clause:
        before, clause = clause, INDEX.sub("<>", clause)
    return FIELD.sub(r"\1", clause.replace("<>", "[..]"))


def lists(texts: Iterable[str]) -> frozenset[str]:
    """The macros that stand for lists of locations: those with arguments in an `assigns`."""
    every = " ".join(one for text in texts for one in ASSIGNS.findall(text))
    return frozenset(MACRO.findall(every))


def reduced(text: str, wide: bool = False) -> str:
    """A text whose contracts have nothing but their `assigns`, beside those of behaviours."""

    def kept(match: re.Match[str]) -> str:
        lines = "\n" * match[0].count("\n")
        if match[0].startswith("//") or NO_CONTRACT.match(match[0]):
            return lines
        own = BEHAVIOR.split(match[0])[0]
        clauses = [LINE_START.sub(" ", one) for one in ASSIGNS.findall(own) if GHOST not in one]
        told = " ".join(widened(one) if wide else one for one in clauses)
        return f"/*@ {told} */{lines}" if told else lines

    return ANNOTATION.sub(kept, text)


def widened_lists(text: str, names: frozenset[str]) -> str:
    """A text in which these macros name whole arrays."""
    return DEFINITION.sub(lambda match: widened(match[0]) if match[1] in names else match[0], text)


def write_tree(root: Path, folders: Iterable[str], target: Path, wide: bool = False) -> None:
    """The C files of some folders, reduced, below another folder."""
    paths = [path for folder in folders for path in sorted((root / folder).rglob("*.[ch]"))]
    texts = {path: path.read_text(encoding="utf-8") for path in paths}
    names = lists(texts.values()) if wide else frozenset()
    for path, text in texts.items():
        copy = target / path.relative_to(root)
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_text(widened_lists(reduced(text, wide), names), encoding="utf-8")


def public_functions(root: Path) -> dict[str, str]:
    """The functions of the kernel's headers that have a contract, each with its header."""
    found = {}
    for path in sorted((root / "include").rglob("*.h")):
        for name in PUBLIC.findall(reduced(path.read_text(encoding="utf-8"))):
            found[name] = path.relative_to(root).as_posix()
    return found
