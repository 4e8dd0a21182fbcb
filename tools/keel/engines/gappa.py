# SPDX-License-Identifier: Apache-2.0
"""Proves bounds of rounding errors with Gappa: proofs/UNIT/*.g, and the wrong ones in wrong/.

Directives stand in the first comment lines of a file:

    # goals: 6                              how many goals it has
    # rounds: proofs/common/mean.h mean     the roundings are those of this function (see below)

and in a file of wrong/:

    # expect: VOT_016_p0_v1                 a goal that must not be proved

A goal is a part |NAME| <= BOUND of the conclusion, BOUND in C's hexadecimal form. Gappa is asked
for the enclosure of each NAME; the verdict is the comparison of what it answers with the bound.

A function of `rounds` divides a sum of products by a sum, one operation per constant; its text says
which roundings each product and each term of the divisor goes through. The formulas of the goals
must be just those that follow from it, and the hypotheses must bound each rounding by 2^-24.
"""

from __future__ import annotations

import re
import time
from dataclasses import asdict, dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any

from keel.base.jobs import Runner
from keel.c import source as csource
from keel.c.project import ProjectError

KEYS = frozenset("goals rounds expect".split())
DIRECTIVE = re.compile(r"^# ?(\w+): *(.*?)\s*$")
DEFINITION = re.compile(r"^(\w+) = ([^;]*);", re.MULTILINE)
BOUND = re.compile(r"^\|(\w+)\| <= (0x[0-9a-f.]+p[+-]?\d+)$")
PROPERTY = re.compile(r"\{(.*?)->(.*?)\}", re.DOTALL)
NUMBER = r"(-?\d+)(?:b(-?\d+))?"
ANSWER = re.compile(rf"^ *\|(\w+)\| in \[{NUMBER}[^,]*, {NUMBER}", re.MULTILINE)
OPERATION = re.compile(r"const float (\w+) = (\w+|0\.0f) ([-+*/]) (\w+);")
UNIT_ROUNDOFF = Fraction(1, 2**24)
PATIENCE = 60.0


@dataclass
class Result:
    """What became of a file."""

    goals: list[dict[str, str]] = field(default_factory=list)
    problems: list[str] = field(default_factory=list)
    seconds: float = 0.0

    def as_dict(self) -> dict[str, Any]:
        """For the cache."""
        return asdict(self)


@dataclass(frozen=True)
class Statement:
    """A .g file: its directives and its parts."""

    path: Path
    directives: dict[str, list[str]]
    definitions: dict[str, str]
    hypotheses: dict[str, Fraction]
    goals: dict[str, Fraction]
    head: str
    hints: str

    def asking(self, name: str) -> str:
        """The file with one question in the place of its goals."""
        return f"{self.head}-> |{name}| in ? }}\n{self.hints}"


def _bounds(path: Path, text: str) -> dict[str, Fraction]:
    """The bounds in a conjunction."""
    found: dict[str, Fraction] = {}
    for part in text.split("/\\"):
        match = BOUND.match(part.strip())
        if not match:
            raise ProjectError(f"{path}: not of the form |NAME| <= 0x...p...: {part.strip()}")
        if match[1] in found:
            raise ProjectError(f"{path}: {match[1]} is bounded twice")
        found[match[1]] = Fraction(float.fromhex(match[2]))
    return found


def read_statement(path: Path) -> Statement:
    """Read a .g file."""
    text = path.read_text(encoding="utf-8")
    directives: dict[str, list[str]] = {}
    for line in text.splitlines():
        if not line.startswith("#"):
            break
        match = DIRECTIVE.match(line)
        if match and match[1] in KEYS:
            directives.setdefault(match[1], []).append(match[2])
    code = re.sub(r"#[^\n]*", "", text)
    properties = list(PROPERTY.finditer(code))
    if len(properties) != 1 or code.count("{") != 1 + code.count("<>"):
        raise ProjectError(f"{path}: needs one {{ hypotheses -> goals }}")
    only = properties[0]
    definitions = {match[1]: " ".join(match[2].split()) for match in DEFINITION.finditer(code)}
    return Statement(
        path,
        directives,
        definitions,
        _bounds(path, only[1]),
        _bounds(path, only[2]),
        code[: only.start(2) - len("->")],
        code[only.end() :],
    )


def _factors(names: tuple[str, ...]) -> str:
    return " * ".join(f"(1 + {name})" for name in names)


def formulas(body: str) -> tuple[list[str], set[str]]:
    """The relative errors of a quotient's terms, and its roundings, from the function's text."""
    routes: dict[str, list[tuple[str, ...]]] = {}
    roundings: set[str] = set()
    quotient: list[str] = []
    for name, left, operator, right in OPERATION.findall(body):
        exact = left == "0.0f" and operator == "+"
        own = () if exact else (name,)
        roundings.update(own)
        if operator == "*" and left not in routes and right not in routes:
            routes[name] = [own]
        elif operator == "+":
            terms = ([] if exact else routes.get(left, [()])) + routes.get(right, [()])
            routes[name] = [(*route, *own) for route in terms]
        elif operator == "/" and not quotient:
            for above in dict.fromkeys(routes[left]):
                for below in dict.fromkeys(routes[right]):
                    divisor = _factors(below)
                    divisor = f"({divisor})" if len(below) > 1 else divisor
                    quotient.append(f"{_factors((*above, *own))} / {divisor} - 1")
        else:
            raise ProjectError(f"{name} = {left} {operator} {right}: neither sum nor quotient")
    return quotient, roundings


def tie_problems(statement: Statement, root: Path) -> list[str]:
    """How the formulas differ from those that follow from the function they are about."""
    problems = []
    for line in statement.directives.get("rounds", []):
        file, _, function = line.partition(" ")
        body = csource.body_of(csource.read(root / file), function)
        if not OPERATION.search(body):
            problems.append(f"{file} defines no {function} with an operation per constant")
            continue
        expected, roundings = formulas(body)
        stated = [statement.definitions.get(name, "") for name in statement.goals]
        problems += [
            f"{function} leads to {text}, which no goal bounds"
            for text in expected
            if text not in stated
        ]
        problems += [
            f"{text or 'a goal without formula'} does not follow from {function}"
            for text in stated
            if text not in expected
        ]
        if statement.hypotheses != dict.fromkeys(roundings, UNIT_ROUNDOFF):
            problems.append(
                f"the hypotheses are not that each rounding of {function} is at most"
                f" 2^-24: {', '.join(sorted(roundings))}"
            )
    return problems


def enclosures(output: str) -> dict[str, Fraction]:
    """The upper ends in Gappa's answer; nothing when it complains."""
    if re.search(r"error|warning", output, re.IGNORECASE):
        return {}
    return {
        match[1]: Fraction(int(match[4])) * Fraction(2) ** int(match[5] or 0)
        for match in ANSWER.finditer(output)
    }


class Gappa:
    """Gappa, and where it may write."""

    def __init__(self, command: list[str], runner: Runner, root: Path, scratch: Path) -> None:
        self._command = command
        self._runner = runner
        self._root = root
        self._scratch = scratch

    def dependencies(self, path: Path) -> list[Path]:
        """All files of the project that a verdict depends on."""
        rounds = read_statement(path).directives.get("rounds", [])
        return [path, *(self._root / line.partition(" ")[0] for line in rounds)]

    def _ask(self, statement: Statement) -> list[dict[str, str]]:
        """Each goal with its verdict."""
        goals = []
        for name, bound in statement.goals.items():
            file = self._scratch / f"{statement.path.parent.name}-{statement.path.stem}-{name}.g"
            file.write_text(statement.asking(name), encoding="utf-8")
            done = self._runner.run([*self._command, str(file)], PATIENCE)
            upper = enclosures(done.output).get(name)
            proved = upper is not None and upper <= bound and done.status == 0
            shown = "no enclosure" if upper is None else f"{float(upper):.9g}"
            goals.append(
                {
                    "name": name,
                    "bound": f"{float(bound):.9g}",
                    "enclosure": shown,
                    "status": "Valid" if proved else "Unknown",
                }
            )
        return goals

    def prove(self, path: Path) -> Result:
        """Prove all goals of a file."""
        start = time.monotonic()
        statement = read_statement(path)
        result = Result(problems=tie_problems(statement, self._root))
        fixed = statement.directives.get("goals", ["none"])
        if fixed != [str(len(statement.goals))]:
            result.problems.append(f"has {len(statement.goals)} goals; `goals` says {fixed[0]}")
        result.goals = self._ask(statement)
        result.problems += [
            f"{goal['name']} is not proved: Gappa has {goal['enclosure']}, not {goal['bound']}"
            for goal in result.goals
            if goal["status"] != "Valid"
        ]
        shown = path.relative_to(self._root)
        result.problems = [f"{shown}: {text}" for text in result.problems]
        result.seconds = round(time.monotonic() - start, 1)
        return result

    def refute(self, path: Path) -> Result:
        """Show that what a wrong file states is not proved, in each goal that it expects."""
        start = time.monotonic()
        statement = read_statement(path)
        shown = path.relative_to(self._root)
        expected = statement.directives.get("expect", [])
        if not expected:
            raise ProjectError(f"{shown}: needs an `# expect:`")
        proved = {goal["name"]: goal["status"] == "Valid" for goal in self._ask(statement)}
        problems = [
            f"{shown}: {name} is {'proved' if name in proved else 'no goal of it'}"
            for name in expected
            if proved.get(name, True)
        ]
        return Result(problems=problems, seconds=round(time.monotonic() - start, 1))
