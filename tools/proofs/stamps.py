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

from toolchain import Found

OWN = Path(__file__).resolve().parent
# What reads C, its parser being pinned, and how provers are started: for which target, under which
# environment, with which limits.
READERS = ("csource.py", "syntax.py", "requirements.txt", "../toolchain/provers.py")
# What asks one engine, and reads its answers.
SERVANTS = {
    "wp": (
        "wp.py", "wplog.py", "verdict.py", "targets.py", "frama_modules.py", "ask_recorded.ml",
        "find_contradictions.ml", "find_assumptions.ml", "linear.py", "../toolchain/limits.py",
    ),
    "cbmc": ("cbmc.py", "cbmc_answers.py", "cbmc_build.py", "harness.py"),
    "gappa": ("gappa.py",),
}
# The tools that an engine never starts. The compiler preprocesses for all of them; Z3 solves for
# CBMC, too.
NOT_STARTED = {
    "wp": ("cbmc", "cadical"),
    "cbmc": ("ocamlfind", "frama-c", "why3", "alt-ergo", "cvc4", "gappa", "machdep"),
    "gappa": (
        "ocamlfind", "frama-c", "why3", "alt-ergo", "cvc4", "z3", "machdep", "cbmc", "cadical"
    ),
}  # fmt: skip
# What judges a mutant: how each engine is asked, how its answers are read, what follows. What finds
# functions and harnesses, makes mutants or prints is none of these: the key of a verdict has what
# it finds, and a report its list of mutants.
JUDGES = {
    "cbmc": ("mutation.py", "mutant_small.py", "cbmc.py", "cbmc_answers.py", "cbmc_build.py"),
    "wp": (*SERVANTS["wp"], "../toolchain/provers.py"),
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


def own_digest(engine: str, folder: Path = OWN) -> str:
    """SHA-256 over the judges of an engine's verdicts."""
    return _digest_of(folder / name for name in (*READERS, *SERVANTS[engine]))


def judges_digest(engine: str, folder: Path = OWN) -> str:
    """SHA-256 over what judges mutants by an engine."""
    return _digest_of(folder / name for name in JUDGES[engine])


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
