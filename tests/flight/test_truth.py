# SPDX-License-Identifier: Apache-2.0
"""No task sees the truth, or the future: the copter's only way to the plant are its devices."""

from __future__ import annotations

from typing import Any

import pytest

from keel.flight import loop, scenario
from keel.flight.library import Copter
from keel.flight.loop import Flight, Order
from keel.flight.scenario import Quality
from keel.plants import plants

HOVER = scenario.read("hover")
LENGTH_S = 6.0


class Watched:
    """A copter that is asked what its devices said before each run, and its motors after."""

    def __init__(self, copter: Copter) -> None:
        self._copter = copter
        self.said: list[Any] = []
        self.motors: list[list[float]] = []

    def __getattr__(self, name: str) -> Any:
        return getattr(self._copter, name)

    def run_until(self, now_us: int) -> int:
        """The same, and keeps what went in and out."""
        self.said.append(self._copter.sensors.copy())
        status = self._copter.run_until(now_us)
        self._copter.look()
        self.motors.append(self._copter.motor.tolist())
        return status


def hover(plant: str, quality: Quality) -> Order:
    """The first seconds of it."""
    short = HOVER.model_copy(update={"duration_s": LENGTH_S})
    return Order(short, plant, 7, quality=quality)


@pytest.mark.parametrize("plant", plants.NAMES)
def test_the_same_samples_without_a_plant_make_the_same_motors(copter: Copter, plant: str) -> None:
    """What devices said is kept, and said once more to a copter that no plant belongs to."""
    watched = Watched(copter)
    Flight(watched, hover(plant, Quality())).fly()
    assert any(any(motors) for motors in watched.motors)
    copter.start(HOVER.options.costs_percent, HOVER.options.plain_mean)
    for step, (said, motors) in enumerate(zip(watched.said, watched.motors, strict=True)):
        for name in said.dtype.names:
            copter.sensors[name] = said[name]
        copter.run_until(1000 * (step + 1))
        copter.look()
        assert copter.motor.tolist() == motors, f"after {step + 1} ms"


class Counted:
    """A plant that counts its steps, and notes in which step it was looked at."""

    def __init__(self, plant: Any) -> None:
        self._plant = plant
        self.steps = 0
        self.looked: list[int] = []
        self.inertials: list[list[float]] = []

    def __getattr__(self, name: str) -> Any:
        return getattr(self._plant, name)

    def step(self, motors: Any) -> None:
        self.steps += 1
        self._plant.step(motors)

    def inertial(self) -> list[float]:
        self.inertials.append(list(self._plant.inertial()))
        return self.inertials[-1]

    def field(self) -> list[float]:
        self.looked.append(self.steps)
        return list(self._plant.field())


@pytest.mark.parametrize("plant", plants.NAMES)
def test_no_sample_is_of_the_future(
    copter: Copter, plant: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A run of tasks begins when a millisecond begins: no sample is newer than that."""
    made: list[Counted] = []

    def counted(*words: Any) -> Counted:
        made.append(Counted(real(*words)))
        return made[-1]

    real = plants.make
    monkeypatch.setattr(loop.plants, "make", counted)
    quiet = Quality(noise=0.0, bias=0.0, vibration=0.0)
    flight = Flight(copter, hover(plant, quiet))
    for now_ms in range(1, 500):
        flight.step(now_ms)
        told = made[0].inertials[max(0, len(made[0].inertials) - 2)]
        said = copter.sensors["imu"][0]
        assert said["accelerometer"].tolist() == pytest.approx(told[:3], abs=1e-5)
        assert said["gyroscope"].tolist() == pytest.approx(told[3:], abs=1e-5)
        assert all(step < now_ms for step in made[0].looked[-1:])
    assert made[0].looked == [now_ms - 1 for now_ms in range(1, 500) if now_ms % 10 == 3]
