# SPDX-License-Identifier: Apache-2.0
"""What verdicts depend on besides the text that they are about: tools, and the driver's judges.

A kept verdict of an engine rests on the tools that the engine may start, on what reads C, and on
what asks that engine and reads its answers. All else finds work, prints, or looks at the whole anew
in each run: a change of it voids nothing.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from pathlib import Path

from keel.install import Found
from keel.install.groups import PROJECT, requirements_of

PACKAGE = Path(__file__).resolve().parents[1]
# What every verdict rests on: what reads C, and how provers are started: for which target, under
# which environment, with which limits.
READERS = ("c/source.py", "c/syntax.py", "install/provers.py")
PARSER = "c-syntax"  # The group of Python packages whose versions count as well.
# And the room of what judges, whole.
JUDGE = "judge"
# What asks one engine.
ASKERS = {
    "wp": (
        "engines/wp.py",
        "engines/frama_modules.py",
        "engines/ask_recorded.ml",
        "engines/find_contradictions.ml",
        "engines/find_assumptions.ml",
        "engines/linear_filter.py",
    ),
    "cbmc": ("engines/cbmc.py", "engines/cbmc_build.py"),
    "gappa": ("engines/gappa.py",),
}
# The tools that an engine never starts. The compiler preprocesses for all of them; Z3 solves for
# CBMC, too.
NOT_STARTED = {
    "wp": ("cbmc", "cadical"),
    "cbmc": ("ocamlfind", "frama-c", "why3", "alt-ergo", "cvc4", "gappa", "machdep"),
    "gappa": (
        "ocamlfind",
        "frama-c",
        "why3",
        "alt-ergo",
        "cvc4",
        "z3",
        "machdep",
        "cbmc",
        "cadical",
    ),
}
# What judges a mutant: how each engine is asked, how its answers are read, what follows. What finds
# functions and harnesses, makes mutants or prints is none of these: the key of a verdict has what
# it finds, and a report its list of mutants.
MUTANT_JUDGES = {
    "cbmc": (
        "mutate/mutation.py",
        "mutate/small_harnesses.py",
        "judge/cbmc_answers.py",
        *ASKERS["cbmc"],
    ),
    "wp": (
        "judge/wp_log.py",
        "judge/wp_targets.py",
        "judge/wp_verdict.py",
        "install/provers.py",
        *ASKERS["wp"],
    ),
}


def tool_stamp(tools: Mapping[str, Found]) -> dict[str, str]:
    """What identifies the tools of a verdict: versions and hashes, no places."""
    stamp = {name: f"{tool.version} {tool.sha256}" for name, tool in tools.items()}
    for name, tool in tools.items():
        parts = [
            f"{part.get('name')} {part.get('version')} {part.get('sha256', '')}"
            for part in tool.parts
        ]
        stamp[name] += "".join(f"; {part.strip()}" for part in parts)
    # The configuration of why3 differs from host to host in its paths alone.
    stamp.pop("why3-config", None)
    return stamp


def started(engine: str, stamp: Mapping[str, str]) -> dict[str, str]:
    """The part of a stamp that a verdict of the engine depends on."""
    return {name: text for name, text in stamp.items() if name not in NOT_STARTED[engine]}


def verdict_stamp(engine: str, tools: Mapping[str, str], headers: str) -> dict[str, str]:
    """What a verdict of the engine depends on: tools, the compiler's headers, and the driver."""
    return {**started(engine, tools), "headers": headers, "driver": own_digest(engine)}


def headers_digest(folders: Iterable[Path]) -> str:
    """SHA-256 over all headers in the folders, each with its name."""
    state = hashlib.sha256()
    for folder in folders:
        for path in sorted(folder.rglob("*.h")):
            state.update(f"{path.relative_to(folder)}\0".encode())
            state.update(hashlib.sha256(path.read_bytes()).digest())
    return state.hexdigest()


def judges(engine: str, package: Path = PACKAGE) -> list[Path]:
    """The files of these tools that a kept verdict of an engine rests on."""
    room = sorted((package / JUDGE).glob("*.py"))
    return [*(package / name for name in (*READERS, *ASKERS[engine])), *room]


def own_digest(engine: str, package: Path = PACKAGE) -> str:
    """SHA-256 over what judges an engine's verdicts, the parser of C included."""
    parser = requirements_of(PARSER, package.parents[1] / PROJECT.name)
    return hashlib.sha256(f"{_digest_of(judges(engine, package))}\n{parser}".encode()).hexdigest()


def mutants_digest(engine: str, package: Path = PACKAGE) -> str:
    """SHA-256 over what judges mutants by an engine."""
    return _digest_of(package / name for name in MUTANT_JUDGES[engine])


def prover_answers(root: Path, stamp: Mapping[str, str]) -> Path:
    """Where provers' answers to WP are kept, apart for each set of tools; the driver does not
    matter."""
    tools = "\n".join(f"{name} {text}" for name, text in sorted(started("wp", stamp).items()))
    name = hashlib.sha256(tools.encode()).hexdigest()[:16]
    return root / "build" / "prove" / "answers" / name


def _digest_of(files: Iterable[Path]) -> str:
    state = hashlib.sha256()
    for path in files:
        state.update(path.read_bytes())
    return state.hexdigest()
