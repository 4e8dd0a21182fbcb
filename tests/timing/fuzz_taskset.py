# SPDX-License-Identifier: Apache-2.0
"""Mutates task-set files: most come out broken in one way or another, many still parse.

    python3 tools/keel with timing tests/timing/fuzz_taskset.py 100000

Every file must end in a task set, which the analyser then takes, or in problems that name file,
line, key and reason: never in a traceback. The seed of each file is its number.
"""

from __future__ import annotations

import random
import re
import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path

from keel.base.files import write_json
from keel.config import ConfigError
from keel.timing.taskset import TaskSet, parse

ROOT = Path(__file__).resolve().parents[2]
SEED_FILE = ROOT / "specs/tasksets/urpilot.toml"
PROBLEM = re.compile(r"fuzzed\.toml:(\d+): (?:no usable TOML|[^:].*: \S.*)")
WORDS = (
    "[[task]]",
    "[[chain]]",
    "[task]",
    "[scheduler]",
    "[a.b]",
    '"""',
    "'''",
    "{",
    "}",
    "[",
    "]",
    "=",
    "name",
    "period_us",
    "budget_us",
    "phase_us",
    "class",
    '"real-time"',
    '"low"',
    "priority",
    "realtime",
    "true",
    "false",
    "0",
    "-1",
    "1",
    "2147483647",
    "2147483648",
    "9" * 30,
    "9" * 5000,
    "1e308",
    "nan",
    "inf",
    "1979-05-27",
    "07:32:00",
    "0x7f",
    '"\\u0000"',
    "\0",
    "\t",
    "\r\n",
    "\n",
    "#",
    ",",
    ".",
    '""',
    "ü",
    "τ",
    "path",
    "guard_us",
    "{a = 1, b = [1, 2]}",
    "[" * 2000,
    "0x" + "f" * 4000,
    "period_us = 0x" + "f" * 4000 + "\n",
    ".a" * 3000,
)


def replace_number(text: str, draw: random.Random) -> str:
    """Another number on one line."""
    lines = text.split("\n")
    numbered = [index for index, line in enumerate(lines) if " = " in line]
    index = draw.choice(numbered) if numbered else 0
    key = lines[index].split(" = ")[0]
    lines[index] = f"{key} = {draw.choice((0, 1, 7, 999, 10 ** draw.randrange(12), 2**31 - 1))}"
    return "\n".join(lines)


def move_line(text: str, draw: random.Random) -> str:
    """One line elsewhere, or twice, or gone."""
    lines = text.split("\n")
    line = lines.pop(draw.randrange(len(lines)))
    for _ in range(draw.randrange(3)):
        lines.insert(draw.randrange(len(lines) + 1), line)
    return "\n".join(lines)


def put_word(text: str, draw: random.Random) -> str:
    """A word of the language where it may not belong."""
    place = draw.randrange(len(text) + 1)
    gone = draw.choice((0, 0, 1, 5, 40))
    return text[:place] + draw.choice(WORDS) + text[place + gone :]


def cut(text: str, draw: random.Random) -> str:
    """A part of the text alone."""
    first, last = sorted((draw.randrange(len(text) + 1), draw.randrange(len(text) + 1)))
    return text[:first] + text[last:]


def garble(text: str, draw: random.Random) -> str:
    """A few characters changed."""
    characters = list(text)
    for _ in range(draw.randrange(1, 6)):
        if characters:
            characters[draw.randrange(len(characters))] = chr(draw.randrange(0x180))
    return "".join(characters)


MUTATIONS: tuple[Callable[[str, random.Random], str], ...] = (
    replace_number,
    replace_number,
    move_line,
    put_word,
    put_word,
    cut,
    garble,
)


def mutant(seed_text: str, number: int) -> str:
    """The mutant of that number."""
    draw = random.Random(number)
    text = seed_text
    if draw.random() < 0.7:  # A short file is changed in its heart more often.
        parts = text.split("[[task]]")
        text = "[[task]]".join([parts[0], *parts[1 : 2 + draw.randrange(4)]])
    for _ in range(draw.choice((1, 1, 1, 2, 3))):
        text = draw.choice(MUTATIONS)(text, draw) or "x"
    return text


@dataclass
class Tally:
    """What came of the files."""

    accepted: int = 0
    refused: int = 0


def check(text: str, use: Callable[[TaskSet], object]) -> bool:
    """Whether the text was accepted. Raises what must not be raised."""
    try:
        tasks = parse(text, "fuzzed.toml")
    except ConfigError as error:
        last = text.count("\n") + 1
        problems = str(error).split("\n")
        for problem in problems:
            told = PROBLEM.fullmatch(problem)
            assert told and 1 <= int(told[1]) <= last and len(problem) < 400, problem
        return False
    use(tasks)
    return True


def fuzz(files: int, use: Callable[[TaskSet], object], first: int = 0) -> Tally:
    """Try that many files."""
    seed_text = SEED_FILE.read_text(encoding="utf-8")
    tally = Tally()
    for number in range(first, first + files):
        try:
            accepted = check(mutant(seed_text, number), use)
        except BaseException:
            print(f"\nfile number {number} fails", file=sys.stderr)
            raise
        tally.accepted += accepted
        tally.refused += not accepted
        if number % 5000 == 4999:
            print(f"  {number + 1} of {first + files} files", file=sys.stderr, flush=True)
    return tally


def main() -> int:
    """Entry point."""
    files = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
    began = time.monotonic()
    tally = fuzz(files, lambda _: None)
    seconds = time.monotonic() - began
    report = {"files": files, **asdict(tally), "seconds": round(seconds, 1)}
    write_json(ROOT / "build/timing/fuzz.json", report)
    print(
        f"fuzz: {files} files, {tally.accepted} accepted and {tally.refused} refused in words, "
        f"no traceback ({seconds:.0f} s)"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
