# SPDX-License-Identifier: Apache-2.0
"""Stands before Alt-Ergo: shows it no product, quotient or remainder of variables.

    python3 linear.py ALT-ERGO [OPTION...] GOAL.why    GOAL.why is overwritten

Alt-Ergo 2.0.0 proves what is false where integers are divided, with its reasoning on products
(its fault 248) and, differently, without. What it is not shown it cannot be wrong about: axioms,
definitions and hypotheses with such a term are left out, by which a goal can only become harder to
prove, and a goal that is about one is not asked at all.

why3 starts it for Alt-Ergo ("before" in tools/toolchain.lock.json), a copy in the cache: it stands
alone, and is one process with Alt-Ergo, so that who ends the one ends the other.
"""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path

COMMENT = re.compile(r"\(\*.*?\*\)", re.DOTALL)
DECLARATION = re.compile(r"^(?=(?:axiom|function|goal|logic|predicate|type)\b)", re.MULTILINE)
# why3 puts each product into parentheses of its own: a number beside the sign is the whole factor.
NUMBER = r"(?:\d+(?:\.\d+)?|\(- \d+(?:\.\d+)?\))"
BY_NUMBER = re.compile(rf"\({NUMBER} \*|\* {NUMBER}\)")
FRACTION = re.compile(r"\(\d+\.\d+ / \d*[1-9]\d*\.\d+\)")  # Of reals; integers are rounded.
NONLINEAR = re.compile(r"[*/%]|\b(?:div|mod)\b")
DEFINITION = re.compile(
    r"(?:predicate|function) (?P<name>\w+)\((?P<parameters>[^()]*(?:\([^()]*\)[^()]*)*)\)"
    r"(?: : (?P<result>[^=]+?))? =\s"
)
PARAMETER = re.compile(r"(?:^|,\s*)\w+\s*:\s*")
SEPARATE = re.compile(r",\s*(?=\w+\s*:)")
# In the words of Alt-Ergo, which why3 looks for.
NOT_ASKED = "I don't know (not asked: it is about variables multiplied or divided)"
# Where a formula may be taken apart, or parentheses change how deep it is.
MARK = re.compile(r"[()]|(?<!<)->| and\b")
BINDER = re.compile(r"\(\s*(?:exists|forall|if|let)\b")
QUANTIFIED = re.compile(r"\(\s*(?:forall\b[^.]*\.\s*)+")
GOAL = re.compile(r"goal \w+ :\s*")


def is_nonlinear(text: str) -> bool:
    """Whether a declaration has a product, quotient or remainder of what are no numbers."""
    return NONLINEAR.search(BY_NUMBER.sub("", FRACTION.sub("1.0", text))) is not None


def conjuncts(text: str) -> list[str]:
    """A formula in its parentheses, taken apart at each `and` that is outermost."""
    parts: list[str] = []
    waiting = [text.strip()]
    while waiting:
        formula = waiting.pop()
        place = split_at(formula, " and")
        if place:
            waiting += [formula[place[1] : -1].strip(), formula[1 : place[0]].strip()]
        else:
            parts.append(formula)
    return parts


def undefined(declaration: str) -> str | None:
    """A function or predicate without what defines it; None if it is neither.

    Of a predicate there is left, as an axiom each, what it implies and is linear.
    """
    found = DEFINITION.match(declaration)
    if not found:
        return None
    parameters = " ".join(found["parameters"].split())
    types = PARAMETER.sub(", ", parameters).removeprefix(", ")
    kept = [f"logic {found['name']} : {types} -> {found['result'] or 'prop'}\n\n"]
    if declaration.startswith("predicate"):
        names = [name.strip(" ,:") for name in PARAMETER.findall(parameters)]
        bound = "".join(f"forall {one}. " for one in SEPARATE.split(parameters))
        holds = f"{found['name']}({', '.join(names)})"
        kept += [
            f"axiom {found['name']}_{number} : ({bound}({holds} -> {part}))\n\n"
            for number, part in enumerate(conjuncts(declaration[found.end() :]))
            if not is_nonlinear(part)
        ]
    return "".join(kept)


def split_at(text: str, sign: str) -> tuple[int, int] | None:
    """Where a sign stands in the parentheses with which a text begins, not in inner ones."""
    depth = 0
    if BINDER.match(text):
        return None
    for mark in MARK.finditer(text):
        depth += {"(": 1, ")": -1}.get(mark[0], 0)
        if depth == 0:
            return None
        if mark[0] == sign and depth == 1:
            return mark.span()
    return None


def without_hypotheses(goal: str) -> str | None:
    """A goal without its nonlinear hypotheses; None if it has a nonlinear term left."""
    kept: list[str] = []
    rest = goal
    while True:
        if head := GOAL.match(rest) or QUANTIFIED.match(rest):
            kept.append(head[0])
            rest = rest[head.end() :]
        elif arrow := split_at(rest, "->"):
            kept.append("(" if is_nonlinear(rest[: arrow[0]]) else rest[: arrow[1]])
            rest = rest[arrow[1] :].lstrip()
        else:
            break
    left = "".join([*kept, rest])
    return None if is_nonlinear(left) else left


def linear_part(text: str) -> str | None:
    """What Alt-Ergo may be shown of its input; None if it is not to be asked."""
    kept: list[str | None] = []
    for declaration in DECLARATION.split(COMMENT.sub("", text)):
        if declaration.startswith(("logic", "type")) or not is_nonlinear(declaration):
            kept.append(declaration)
        elif declaration.startswith("goal"):
            kept.append(without_hypotheses(declaration))
        elif not declaration.startswith("axiom"):
            kept.append(undefined(declaration))
    return None if None in kept else "".join(map(str, kept))


def main(words: list[str]) -> int:
    """Ask Alt-Ergo, if it may be asked; the exit status."""
    program, *options = words
    file = Path(options[-1]) if options else Path()
    if file.is_file():
        shown = linear_part(file.read_text(encoding="utf-8"))
        if shown is None:
            print(f'File "{file}", line 1, characters 1-1:{NOT_ASKED}')
            return 0
        file.write_text(shown, encoding="utf-8")
    os.execv(program, [program, *options])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
