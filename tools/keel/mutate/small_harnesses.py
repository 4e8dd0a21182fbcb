# SPDX-License-Identifier: Apache-2.0
"""Smaller questions to CBMC, which are asked first: most mutants fail there, in a second or two.

A small harness is the harness at smaller capacities, for assertions alone. It looks at fewer
executions than the harness, with the same assumptions and the same assertions: an execution in
which one fails is a counterexample to the same contract. That none is found says nothing, and the
harness itself is asked. Nor does a failure count when the small harness fails on the unchanged
code, too, or when all that it says is that a loop goes on beyond its unwinding.
"""

from __future__ import annotations

import re
import threading
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from keel.engines.cbmc import Cbmc
from keel.judge.harness import Harness
from keel.mutate.harnesses import in_tree

# The capacities that a build may choose, and those of a small harness.
CAPACITIES = {"KEEL_QUEUE_CAPACITY": 2, "KEEL_VOTER_SENSORS": 3}
MARGIN = 2  # how often at most a loop over a whole capacity is unwound beyond it
BEYOND = "unwinding assertion"  # what CBMC says of a loop that goes on
TIME = 20.0  # seconds of processor time, for a question that is meant to be easy
# How much longer than its processor time a question may take where other programs run, too.
WALL = 6.0
# Seconds for the unchanged code, once: where small is no easier, asking is not worth it.
PATIENT = 240.0
# After so many questions without an answer, and none that killed, a harness is not asked any more.
UNANSWERED = 3


def small(harness: Harness, files: Iterable[Path]) -> Harness:
    """The harness for fewer objects, and for assertions alone."""
    texts = [path.read_text(encoding="utf-8") for path in files]
    defines = {word.partition("=")[0]: word for word in harness.defines}
    options = harness.options
    for name, least in CAPACITIES.items():
        usual = _usual(name, texts)
        if usual is None:
            continue
        given = re.fullmatch(r"-D\w+=(\d+)[uU]?", defines.get(f"-D{name}", ""))
        if min(usual, int(given[1]) if given else usual) > least:
            defines[f"-D{name}"] = f"-D{name}={least}u"
        options = _unwound(options, usual, least)
    options = _built_in(options)
    return replace(
        harness,
        defines=tuple(defines.values()),
        options=options,
        assertions_only=True,
        timeout=min(TIME, harness.timeout),
    )


def _built_in(options: tuple[str, ...]) -> tuple[str, ...]:
    """Options without the external SAT solver: on small formulas the one in CBMC is faster."""
    if "--external-sat-solver" not in options:
        return options
    place = options.index("--external-sat-solver")
    return options[:place] + options[place + 2 :]


def _usual(name: str, texts: Iterable[str]) -> int | None:
    """The capacity that a header gives where nobody chooses one."""
    found = (re.search(rf"^#define {name} (\d+)[uU]?$", text, re.M) for text in texts)
    return next((int(match[1]) for match in found if match), None)


def _unwound(options: tuple[str, ...], usual: int, least: int) -> tuple[str, ...]:
    """Options that unwind loops over a whole capacity less, as it is less, and others as before.

    A bound further above the capacity than MARGIN is not the capacity's, but that of other loops.
    """
    if "--unwind" not in options:
        return options
    place = options.index("--unwind") + 1
    bound = int(options[place])
    if not usual < bound <= usual + MARGIN:
        return options
    return (*options[:place], str(bound - usual + least), *options[place + 1 :])


class Small:
    """The small harnesses of a unit: which of them can be used, and which notice most."""

    def __init__(self, files: Mapping[str, Iterable[Path]], unchanged: Callable[[], Cbmc]) -> None:
        self._files = files
        self._unchanged = unchanged
        self._usable: dict[str, bool] = {}
        self._kills: Counter[tuple[str, str]] = Counter()
        self._unanswered: Counter[str] = Counter()
        self._lock = threading.Lock()

    def ranked(self, function: str, harnesses: Sequence[Harness]) -> list[Harness]:
        """The harnesses worth asking, first those that killed most mutants of a function.

        A solver of equations is not: where floats differ, it finds no example.
        """
        searching = [one for one in harnesses if "--z3" not in one.options]
        return sorted(searching, key=lambda one: -self._kills[function, one.name])

    def kills(self, original: Harness, function: str, checker: Cbmc, root: Path) -> str:
        """What the small harness says against a mutant of a function in a tree; or nothing."""
        if self._usable.get(original.name) is False or self._is_hopeless(original.name):
            return ""
        harness = small(in_tree(original, root), self._files[original.name])
        failure = _failure(checker, replace(harness, timeout=WALL * harness.timeout))
        self._unanswered[original.name] += failure is None
        if not failure or not self._passes_unchanged(original):
            return ""
        self._kills[function, original.name] += 1
        others = [word[2:] for word in harness.defines if word not in original.defines]
        sizes = f" ({', '.join(others)})" if others else ""
        return f"killed: {original.name}: {failure}{sizes}"

    def _is_hopeless(self, name: str) -> bool:
        """Whether a small harness gave no answer so far, as often as it was asked."""
        killed = any(harness == name for _, harness in list(self._kills))
        return not killed and self._unanswered[name] >= UNANSWERED

    def _passes_unchanged(self, original: Harness) -> bool:
        """Whether the small harness finds nothing in what is unchanged, in a time that pays."""
        with self._lock:
            if original.name not in self._usable:
                harness = small(original, self._files[original.name])
                patient = replace(harness, timeout=min(PATIENT, original.timeout))
                self._usable[original.name] = _failure(self._unchanged(), patient) == ""
            return self._usable[original.name]


def _failure(checker: Cbmc, harness: Harness) -> str | None:
    """What fails in a small harness; nothing if nothing does, None if that is not known."""
    binary, complaint = checker.build(harness, f"{harness.name}-small")
    if complaint:
        return None
    answer = checker.check(harness, binary, ["--stop-on-fail"])
    if not answer.complete or answer.first_failure.startswith(BEYOND):
        return None
    return answer.first_failure
