# SPDX-License-Identifier: Apache-2.0
"""The right code of the boards in each trial on the model of their chip; and what becomes of a
mistake that a trial does not notice."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from test_copter_image import BOARDS, tools

from keel.base.errors import ROOT
from keel.base.source import PRODUCT
from keel.boards.board import read_board
from keel.boards.firmware import Builder
from keel.install import Toolchain
from keel.qualify import command
from keel.qualify.board_trials import TRIALS
from keel.qualify.mistakes import Mistake

__all__ = ["tools"]  # A fixture.

# Those that any board can pass; in the others an FMUv5's devices take part.
ANYWHERE = ("outputs", "port")


@pytest.mark.parametrize("board", BOARDS)
def test_the_right_code_passes(tools: Toolchain, tmp_path: Path, board: str) -> None:
    builder = Builder(tools, read_board(ROOT, board), tmp_path)
    for name in TRIALS if board == "fmuv5" else ANYWHERE:
        TRIALS[name].run(tools, builder, name)


def test_a_mistake_that_is_not_noticed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Named with its file and text, as is one that does not compile; what was noticed is known."""
    file, old = "bsp/cortex_m7/reset.c", "keel_board_outputs_off();"
    seeded = [
        Mistake(trial="outputs", file=file, old=old, new=new)
        for new in ("", f"(void){old}", "keel_board_outputs_of();")
    ]
    for folder in PRODUCT:
        (tmp_path / folder).mkdir()
    known = tmp_path / "known"
    assert command.main([], tmp_path, [], known, seeded) == 1
    report = json.loads((tmp_path / command.REPORT).read_text())
    noticed, harmless, broken = report["runs"]
    assert noticed["wrong"] == ""
    told = f"unicorn: {file}: {old} -> (void){old}: is not noticed"
    assert report["problems"][0] == told
    assert harmless["how"] == "outputs"
    assert "implicit declaration" in broken["wrong"]
    said = capsys.readouterr().out
    assert f"FAILED {told}\n" in said
    assert said.endswith("qualify: 1 of 3 seeded faults detected\n")
    assert len(list(known.iterdir())) == 2  # The right code, and what was noticed.
    assert command.main([], tmp_path, [], known, seeded[:1]) == 0
    assert capsys.readouterr().out == "qualify: 1 of 1 seeded faults detected\n"
