# SPDX-License-Identifier: Apache-2.0
"""What verdicts depend on besides the text that they are about: tools, and the driver itself.

A verdict of an engine depends on the tools that the engine may start, and on the sources of the
driver but for those that serve other engines alone. Where it is not plain whom a source serves, it
counts for all.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from pathlib import Path

from toolchain import Found

OWN = Path(__file__).resolve().parent
# Makes mutants, or tells what others found: no verdict depends on it.
NO_JUDGES = ("muta", "explain", "counterexample", "sequents", "exports", "report", "times")
# What asks one engine, and reads its answers.
SERVANTS = {
    "wp": (
        "wp.py", "wplog.py", "verdict.py", "frama_modules.py", "ask_recorded.ml",
        "find_contradictions.ml", "linear.py",
    ),
    "cbmc": ("cbmc.py", "cbmc_answers.py", "cbmc_build.py", "harness.py", "wrong.py"),
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


def verdict_stamp(engine: str, tools: Mapping[str, str]) -> dict[str, str]:
    """What a verdict of the engine depends on: tools and driver."""
    return {**started(engine, tools), "driver": own_digest(engine)}


def own_digest(engine: str, folder: Path = OWN) -> str:
    """SHA-256 over the sources of the driver that may change a verdict of the engine. How the
    provers are installed does not matter, how they are started does."""
    # The parser of C is pinned there: another one may see other functions.
    others = (folder / "requirements.txt", folder.parent / "toolchain/provers.py")
    own = [*folder.glob("*.py"), *folder.glob("*.ml"), *others]
    strangers = [name for other, names in SERVANTS.items() if other != engine for name in names]
    return _digest_of(
        path
        for path in sorted(own)
        if not path.stem.startswith(NO_JUDGES) and path.name not in strangers
    )


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
