# SPDX-License-Identifier: Apache-2.0
"""Mistakes in the boards' code, each of which a trial on the model of the chip must notice.

The table, tests/target/mistakes.toml, says what is replaced in which file, and in which trial it
shows. The image with a mistake differs in one object from the right one, which must pass the trial.
"""

from __future__ import annotations

import multiprocessing
import re
import signal
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

from keel.base.build import BuildError
from keel.base.errors import ROOT
from keel.base.files import read_text, sha256_of, write_text
from keel.base.source import digest_of_tree
from keel.base.verdict_cache import Cache, digest
from keel.boards.board import read_board
from keel.boards.firmware import Builder
from keel.config import Mistake as Slip
from keel.config import Table, Text, read_toml
from keel.emulator.chip import ModelError
from keel.install import Toolchain
from keel.qualify.board_trials import PROGRAMS, TRIALS

TABLE = "tests/target/mistakes.toml"
BOARD = "fmuv5"
TOOL = "unicorn"
GROUPS = ("firmware", "fatfs", "model")
# An image and its trial depend on these, besides the tools.
SOURCES = ("bsp", "examples", "include", "src", PROGRAMS, "tools/keel/boards")
FILES = (
    "specs/outputs.toml",
    "tools/keel/base/build.py",
    "tools/keel/flight/device_frames.py",
    "tools/keel/install/provers.py",
    "tools/keel/qualify/board_trials.py",
    "tools/keel/qualify/mistakes.py",
)


class Mistake(Table):
    """A mistake."""

    trial: Text
    file: Text
    old: Text
    new: str

    @property
    def fault(self) -> str:
        """In one line."""
        return " ".join(f"{self.file}: {self.old} -> {self.new or 'nothing'}".split())

    def text(self) -> str:
        """The file, without the mistake; however it is laid out, as no two blanks follow."""
        return re.sub(r" +", " ", read_text(ROOT / self.file))


class Mistakes(Table):
    """The table."""

    mistake: list[Mistake]


def slips(table: Mistakes) -> Iterator[Slip]:
    """What types cannot say."""
    for number, one in enumerate(table.mistake):
        if one.trial not in TRIALS:
            yield ("mistake", number, "trial"), f"there is none; there are {', '.join(TRIALS)}"
        if (count := one.text().count(one.old)) != 1:
            yield ("mistake", number, "old"), f"stands {count} times in {one.file}, and not once"
        if one in table.mistake[:number]:
            yield ("mistake", number, "new"), "stands twice"


def read_mistakes(path: Path = ROOT / TABLE) -> list[Mistake]:
    """All mistakes, each of which can be put into its file."""
    return read_toml(path, Mistakes, slips).mistake


Asked = tuple[str, Mistake | None]  # A trial, of the right code where there is no mistake.
Made = Mapping[tuple[str, ...], Path]


def tried(folder: Path, made: Made, asked: Asked) -> str:
    """What is wrong with the answer of a trial; "" if it passes the right code and no mistake."""
    trial, mistake = asked
    tools = Toolchain()
    builder = Builder(tools, read_board(ROOT, BOARD), folder, ROOT)
    builder.build.made.update(made)
    with tempfile.TemporaryDirectory(dir=folder) as own:
        try:
            if mistake:
                builder.build.made[(mistake.file,)] = mistaken(builder, mistake, Path(own))
            TRIALS[trial].run(tools, builder, f"{Path(own).name}/keel")
        except (AssertionError, ModelError) as error:
            return "" if mistake else f"the right code fails: {error}"
        except BuildError as error:
            return f"cannot be built: {error}"
    return "is not noticed" if mistake else ""


def mistaken(builder: Builder, mistake: Mistake, folder: Path) -> Path:
    """The object of a file with a mistake; its headers are found where the right one lies."""
    file = folder / mistake.file
    write_text(file, mistake.text().replace(mistake.old, mistake.new))
    target = file.with_suffix(".o")
    beside = f"-iquote{Path(mistake.file).parent}"
    builder.build.compile([*builder.build.flags, beside, "-c", str(file), "-o", str(target)])
    return target


def answers(tools: Toolchain, asked: Sequence[Asked]) -> Iterator[str]:
    """What is wrong with each answer, several at a time; all that is right is built once."""
    if not asked:
        return
    with tempfile.TemporaryDirectory(prefix="keel-mistakes-") as name:
        builder = Builder(tools, read_board(ROOT, BOARD), Path(name), ROOT)
        builder.objects(builder.board.sources)
        for trial in dict.fromkeys(trial for trial, _ in asked):
            TRIALS[trial].objects(builder)
        # Ctrl-C is for the process that asks.
        leave = (signal.signal, (signal.SIGINT, signal.SIG_IGN))
        with ProcessPoolExecutor(None, multiprocessing.get_context("spawn"), *leave) as pool:
            yield from pool.map(partial(tried, Path(name), dict(builder.build.made)), asked)


def rows(tools: Toolchain, mistakes: Sequence[Mistake], cache: Cache) -> list[dict[str, str]]:
    """What became of each mistake; those that were noticed before by the same trial are known."""
    if not mistakes:
        return []
    tools.ensure(*GROUPS)
    found = tools.versions(*GROUPS)
    versions = {name: [one.version, one.sha256, one.parts] for name, one in found.items()}
    how = [digest_of_tree(ROOT, SOURCES), *(sha256_of(ROOT / name) for name in FILES)]

    def key_of(asked: Asked) -> str:
        mistake = asked[1].model_dump() if asked[1] else asked[0]
        return digest({"mistake": mistake, "tools": versions, "how": how})

    right: list[Asked] = [(trial, None) for trial in dict.fromkeys(one.trial for one in mistakes)]
    asked = [*right, *((one.trial, one) for one in mistakes)]
    new = [one for one in asked if cache.get(key_of(one)) is None]
    wrong: dict[Asked, str] = {}
    for one, answer in zip(new, answers(tools, new), strict=True):
        trial, mistake = one
        wrong[one] = wrong.get((trial, None), "") or answer.replace("\n", " ")
        if not wrong[one]:
            cache.put(key_of(one), {"detected": True})
        if mistake:
            print(f"{TOOL}: {mistake.fault}: {wrong[one] or 'detected'}", flush=True)
    return [
        {
            "tool": TOOL,
            "fault": one.fault,
            "how": one.trial,
            "version": found[TOOL].version,
            "wrong": wrong.get((one.trial, one), ""),
        }
        for one in mistakes
    ]
