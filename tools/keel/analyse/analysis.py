# SPDX-License-Identifier: Apache-2.0
"""One run of Frama-C with Eva: what was found, and how far it reached.

Eva computes, for every statement that it reaches, a superset of the values that there can be. An
alarm is a place at which it cannot exclude undefined behaviour. From computes a superset of what a
function writes, and compares it with the clause `assigns`.
"""

from __future__ import annotations

import csv
import re
import shutil
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from keel.base.errors import ToolError
from keel.base.run import run
from keel.install import MACHDEP_FILE, Toolchain

TIMEOUT_S = 1200.0
PRECISION = 2
ANALYSIS = (
    "-eva",
    "-eva-no-print",
    "-eva-precision",
    str(PRECISION),
    "-from-verify-assigns",
    "-no-calldeps-print",
    "-metrics-eva-cover",
)
# Arguments that point to objects of their own, whose contents are unknown.
ANY_CONTEXT = ("-lib-entry", "-eva-context-valid-pointers", "-eva-context-width", "1")
# The compiler's own stddef.h, as in the proofs, instead of Frama-C's beside it.
OWN_STDDEF = ("-include stddef.h", "-D__FC_STDDEF", "-D__FC_DEFINE_SIZE_T", "-D__FC_DEFINE_WCHAR_T")

STATEMENTS = re.compile(r"^ +(\w+): (\d+) stmts out of (\d+) ", re.MULTILINE)
ANALYZED = re.compile(r"^ +(\d+) functions? analyzed \(out of (\d+)\)", re.MULTILINE)
WARNING = re.compile(r"^\[(?!eva:alarm|from)([\w:-]+)\](.*Warning: .*(?:\n  .*)?)", re.MULTILINE)
KNOWN_WARNING = "has no registered macro"  # Of our machdep: Frama-C's own headers get one's of its.
COPY = re.compile(r"_\d+$")  # An inline function is there once for each file.
GOOD = ("Valid", "Considered valid")
CLAUSES = ("assigns clause", "from clause")


@dataclass(frozen=True)
class Property:
    """What Frama-C says of one property."""

    file: str
    line: int
    function: str
    kind: str
    status: str
    text: str


@dataclass(frozen=True)
class Reach:
    """How many statements of a function Eva reached, of how many."""

    reached: int
    of: int

    @property
    def share(self) -> float:
        """From 0 to 1."""
        return self.reached / self.of if self.of else 0.0


@dataclass(frozen=True)
class Analysis:
    """What came out of one entry."""

    properties: tuple[Property, ...]
    reach: dict[str, Reach]
    analyzed: int
    functions: int
    warnings: tuple[str, ...]

    @property
    def alarms(self) -> list[Property]:
        """What is not known to hold, but for what is assigned."""
        return [
            one for one in self.properties if one.status not in GOOD and one.kind not in CLAUSES
        ]

    def assigns(self, function: str) -> str:
        """Whether what a function writes is within its clause; "" if it was not reached."""
        found = {
            one.status
            for one in self.properties
            if one.kind == CLAUSES[0] and COPY.sub("", one.function) == function
        }
        return "" if not found else "Valid" if found <= {"Valid"} else "Unknown"

    def share(self, function: str) -> float:
        """How much of a function was reached, in its copy of which most was."""
        return max(
            (one.share for name, one in self.reach.items() if COPY.sub("", name) == function),
            default=0.0,
        )


def read_properties(text: str) -> tuple[Property, ...]:
    """The rows of Frama-C's report."""
    rows = csv.DictReader(text.splitlines(), delimiter="\t", quoting=csv.QUOTE_NONE)
    return tuple(
        Property(
            f"{row['directory']}/{row['file']}".removeprefix("./"),
            int(row["line"] or 0),
            row["function"],
            row["property kind"],
            row["status"],
            row["property"],
        )
        for row in rows
    )


def read_log(log: str, report: str) -> Analysis:
    """What one entry's part of the log and its report say."""
    analyzed = ANALYZED.findall(log)
    if not analyzed:
        raise ToolError(f"frama-c: the analysis did not end:\n{log[-1000:].strip()}")
    warnings = [
        f"{kind}: {' '.join(text.split())}"
        for kind, text in WARNING.findall(log)
        if KNOWN_WARNING not in text
    ]
    return Analysis(
        read_properties(report),
        {name: Reach(int(reached), int(of)) for name, reached, of in STATEMENTS.findall(log)},
        int(analyzed[-1][0]),
        int(analyzed[-1][1]),
        tuple(dict.fromkeys(warnings)),
    )


class Eva:
    """Frama-C with Eva for the target, in a folder with the reduced source."""

    def __init__(self, tools: Toolchain, folder: Path) -> None:
        self.tools = tools
        self.folder = folder

    def command(self, files: Iterable[str], include: Iterable[str]) -> list[str]:
        """What every run begins with."""
        command = self.tools.frama_c(libc_specifications=True)
        # Frama-C compiles a script beside its source, where two processes would collide.
        script = self.folder / MACHDEP_FILE.name
        shutil.copyfile(MACHDEP_FILE, script)
        command[command.index(str(MACHDEP_FILE))] = str(script)
        words = [*OWN_STDDEF, *(f"-I{folder}" for folder in include)]
        return [*command, f"-cpp-extra-args={' '.join(words)}", *files]

    def analyse(
        self,
        files: Sequence[str],
        include: Sequence[str],
        entries: Sequence[str],
        options: Sequence[str] = (),
    ) -> dict[str, Analysis]:
        """Each entry in a context of its own."""
        command = [*self.command(files, include), *options, *ANALYSIS]
        reports = {entry: self.folder / f"{entry}.csv" for entry in entries}
        for number, (entry, report) in enumerate(reports.items()):
            report.unlink(missing_ok=True)
            command += ["-then"] if number else []
            command += ["-main", entry, "-report-csv", report.name]
        variables = {"PWD": str(self.folder), "LC_ALL": "C", "TMPDIR": str(self.folder)}
        done = run(command, TIMEOUT_S, cwd=self.folder, environment=variables)
        if not done.good:
            raise ToolError(f"frama-c: {done.how}\n{done.evidence}")
        return {
            entry: read_log(log, reports[entry].read_text(encoding="utf-8"))
            for entry, log in self.parts(done.output, reports)
        }

    @staticmethod
    def parts(output: str, reports: dict[str, Path]) -> list[tuple[str, str]]:
        """The log of each entry: what stands before its report."""
        logs = []
        for entry, report in reports.items():
            log, told, output = output.partition(f"Dumping properties in '{report.name}'")
            if not told:
                raise ToolError(f"frama-c: no report on {entry}:\n{log[-1000:].strip()}")
            logs.append((entry, log))
        return logs
