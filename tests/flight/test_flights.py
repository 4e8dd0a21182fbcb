# SPDX-License-Identifier: Apache-2.0
"""Whole flights: equal ones are equal, reports are whole, seeds are flown once."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from short_flight import SHORT, short

from keel.base.errors import ROOT
from keel.flight import command as fly
from keel.flight import judge, library, loop, montecarlo, pilot, sensors, varied
from keel.flight.library import Copter
from keel.flight.loop import Order
from keel.install import Toolchain
from keel.install.groups import HASHES
from keel.plants import jsbsim_plant, mujoco_plant, plants


@pytest.mark.parametrize("plant", plants.NAMES)
def test_equal_seeds_make_equal_flights(copter: Copter, tmp_path: Path, plant: str) -> None:
    made = short(tmp_path)
    first, again, other = (loop.fly(copter, Order(made, plant, seed)) for seed in (1, 1, 2))
    assert not first.problem and not first.crash
    assert first.column("up").max() > 0.5
    assert first.digest == again.digest != other.digest


def test_nothing_is_undefined_and_the_compiler_does_not_matter(
    copter: Copter, tmp_path: Path
) -> None:
    flags = ("-O0", "-fsanitize=undefined", "-fno-sanitize-recover=all")
    strict = Copter(library.build(Toolchain(), tmp_path / "strict", more=flags))
    order = Order(short(tmp_path), "mujoco", 1)
    assert loop.fly(strict, order).digest == loop.fly(copter, order).digest


def test_the_names_are_those_of_the_headers() -> None:
    assert library.states() == [
        "disarmed",
        "armed",
        "flying",
        "holding",
        "returning",
        "landing",
        "terminated",
    ]
    assert library.modes() == ["acro", "land", "angle", "altitude", "position", "return", "none"]
    assert library.checks_of(0x0101) == ["gyroscope", "motors"]
    assert library.facts_of(0x2001) == ["rc_linked", "battery_empty"]
    assert len(library.facts_of(0xFFFFFFFF)) == 14


def test_declarations_lose_comments_and_keep_numbers() -> None:
    text = "/* a */\n#ifndef X\n#define N 3 /* three */\n#include <a.h>\nint f(int a[N]); /** b\n*/"
    assert " ".join(library.declarations(text).split()) == "#define N 3 int f(int a[N]);"


def test_a_copter_that_may_not_arm_is_told(copter: Copter, tmp_path: Path) -> None:
    made = short(tmp_path).model_copy(update={"battery_left": 0.0})
    trace = loop.fly(copter, Order(made, "mujoco", 1))
    assert trace.problem.startswith("not armed after 30 s") and "battery" in trace.problem


def test_a_flight_is_over_when_its_motors_have_stood(copter: Copter, tmp_path: Path) -> None:
    made = short(tmp_path).model_copy(update={"duration_s": 60.0, "over_s": 2.0})
    trace = loop.fly(copter, Order(made, "mujoco", 1))
    time, runs = trace.column("time"), trace.view["motors_on"].astype(bool)
    assert time[-1] - time[runs][-1] == pytest.approx(2.0, abs=0.02) and time[-1] < 30.0


def test_a_report_and_its_exit_status(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scenarios, build = tmp_path / "scenarios", tmp_path / "build"
    scenarios.mkdir()
    short(scenarios)
    words = ["--scenarios", str(scenarios), "--build", str(build), "--plant", "mujoco"]
    assert fly.main(words) == 0
    report = json.loads((build / "fly.json").read_text())
    assert report["good"] and report["flights"][0]["measured"]["tilt_max_deg"] < 20.0
    assert (build / "short-mujoco.svg").read_text().startswith("<?xml")
    assert capsys.readouterr().out.splitlines()[-1].startswith("fly: 1 flights, 1 good, 0 not; ")
    strict = SHORT.replace("tilt_max_deg = 20.0", "tilt_max_deg = 0.01")
    (scenarios / "short.toml").write_text(strict)
    assert fly.main([*words, "--no-pictures"]) == 1
    told = capsys.readouterr().out
    assert "short in mujoco: tilt_max_deg" in told and "wanted 0.01" in told
    (scenarios / "short.toml").write_text(strict.replace("duration_s", "duration"))
    assert fly.main(words) == 2


def test_a_seed_is_one_flight_and_seeds_differ() -> None:
    assert varied.order_of(7) == varied.order_of(7)
    flights = [varied.order_of(seed) for seed in range(1, 60)]
    assert {flight.plant for flight in flights} == set(plants.NAMES)
    assert len({flight.scenario.description for flight in flights}) > 8
    assert len({flight.airframe.mass for flight in flights}) > 50


def test_another_plant_pilot_or_judge_makes_another_flight(tmp_path: Path) -> None:
    """Kept flights are of the present tools: each file that flies or judges one counts."""
    for name in (*varied.TOOLS, "pyproject.toml", f"tools/{HASHES.name}"):
        for path in varied.below(ROOT / name):
            target = tmp_path / path.relative_to(ROOT)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, target)
    before = varied.digest_of(tmp_path)
    for module in (jsbsim_plant, mujoco_plant, pilot, judge, sensors, loop, varied):
        assert module.__file__
        path = tmp_path / Path(module.__file__).relative_to(ROOT)
        text = path.read_text(encoding="utf-8")
        path.write_text(f"{text}\n# Another one.\n", encoding="utf-8")
        assert varied.digest_of(tmp_path) != before, path
        path.write_text(text, encoding="utf-8")
    assert varied.digest_of(tmp_path) == before
    with pytest.raises(FileNotFoundError):
        varied.below(tmp_path / "tools" / "flight")


def answer(seed: int, digest: str = "d") -> dict[str, Any]:
    """A worker's, as it is kept."""
    return {
        "seed": seed,
        "digest": digest,
        "good": True,
        "name": f"seed {seed}",
        "fault": "no fault",
        "plant": "jsbsim",
        "measured": {"sink_max": 0.5},
        "limits": [],
    }


class Closed:
    """A cluster that nobody may ask again."""

    def close(self) -> None:
        """Nothing is open."""


def test_what_was_flown_is_not_flown_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[list[int]] = []

    def fake(_: Any, seeds: list[int]) -> Any:
        asked.append(list(seeds))
        yield from (answer(seed) for seed in reversed(seeds))

    monkeypatch.setattr(montecarlo, "BUILD", tmp_path)
    monkeypatch.setattr(montecarlo, "library_of", lambda digest: tmp_path)
    monkeypatch.setattr(montecarlo, "cluster", lambda address, width: Closed())
    monkeypatch.setattr(montecarlo, "answers", fake)
    assert [kept["seed"] for kept in montecarlo.all_flown([1, 2], "d", 1)] == [1, 2]
    montecarlo.file_of(2).write_text("{")  # As no interruption leaves it.
    montecarlo.all_flown([1, 2, 3], "d", 1)
    montecarlo.all_flown([1, 2, 3], "d", 1)
    assert asked == [[1, 2], [2, 3]]
    with pytest.raises(montecarlo.ToolError, match="other sources"):
        montecarlo.all_flown([1], "another", 1)


def test_a_report_of_seeds_does_not_depend_on_their_order() -> None:
    flights = [answer(seed) for seed in (1, 2, 3)]
    report = montecarlo.report_of(flights, "d")
    assert report["good"] == 3 and report["not_good"] == []
    assert report["percentiles"] == {"sink_max": {"p50": 0.5, "p90": 0.5, "p99": 0.5, "p100": 0.5}}


@pytest.mark.parametrize("group", ["fly", "flights", "sim"])
def test_a_flight_alone_has_its_packages(group: str) -> None:
    """`make check NAME=flights SEED=7` flies as `make fly` does."""
    words = [sys.executable, "tools/keel", "with", group, "-c", "import keel.flight.command"]
    subprocess.run(words, cwd=ROOT, check=True)


def test_numbers_that_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert montecarlo.main(["--flights", "0"]) == 2
    assert "expected 1 or more" in capsys.readouterr().err


def heed_ctrl_c() -> None:
    """What a shell starts in its background ignores it, and so would what is started here."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


def test_an_interruption_ends_it_and_leaves_no_report(tmp_path: Path) -> None:
    words = [sys.executable, "tools/keel", "fly", "--build", str(tmp_path), "--no-pictures"]
    with subprocess.Popen(
        words,
        cwd=library.ROOT,
        stdout=subprocess.PIPE,
        text=True,
        stderr=subprocess.STDOUT,
        start_new_session=True,
        preexec_fn=heed_ctrl_c,
    ) as child:
        assert child.stdout is not None
        assert child.stdout.readline().startswith("[1/")
        os.killpg(child.pid, signal.SIGINT)  # As a terminal does: to all of them.
        told, _ = child.communicate(timeout=60.0)
    assert child.returncode == 130 and told.endswith("fly: interrupted\n")
    assert not list(tmp_path.glob("*.json"))
