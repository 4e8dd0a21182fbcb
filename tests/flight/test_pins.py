# SPDX-License-Identifier: Apache-2.0
"""What is said of a board's outputs, by changes of pins that are made up: each mistake is seen."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from keel.flight import pins
from keel.flight.pins import ARMED, EVENT, FLOATS, HIGH, LOW, RESET

KIND = np.dtype([("at", "<u8"), ("line", "<u4"), ("level", "<u4")])
SUPPLY, SOFTWARE, WATCHDOG = RESET, RESET + 1, RESET + 2
ARMS_US, OFF_US, END_US = 100_000.0, 200_000.0, 400_000.0
Change = tuple[float, int, int]


def start(at_us: float = 0.0, cause: int = SUPPLY) -> list[Change]:
    """A reset, behind which all outputs are low within 30 us."""
    floats = [(at_us, line, FLOATS) for line in range(8)]
    lows = [(at_us + 30.0, line, LOW) for line in range(8)]
    return [(at_us, EVENT, cause), (at_us, ARMED, HIGH), *floats, *lows]


def pulses(
    output: int, from_us: float, to_us: float, width_us: float = 1500.0, period_us: float = 2500.0
) -> list[Change]:
    """Of an output, the last one whole."""
    begins = np.arange(from_us, to_us - width_us, period_us).tolist()
    return [it for at in begins for it in ((at, output, HIGH), (at + width_us, output, LOW))]


def flight(*more: list[Change]) -> list[Change]:
    """From power-up to switching off, with two outputs that turn motors."""
    return [
        *start(),
        (ARMS_US, ARMED, LOW),
        *pulses(0, ARMS_US + 300.0, OFF_US),
        *pulses(1, ARMS_US + 300.0, OFF_US, 1000.0),
        (OFF_US, ARMED, HIGH),
        *(it for changes in more for it in changes),
    ]


def edges(changes: list[Change]) -> Any:
    """As the board has them."""
    ordered = sorted(changes, key=lambda change: change[0])
    return np.array([(round(432 * at), line, level) for at, line, level in ordered], dtype=KIND)


def told(changes: list[Change]) -> str:
    """What is wrong."""
    return " | ".join(pins.measured(edges(changes), END_US).mistakes)


def test_a_good_flight() -> None:
    found = pins.measured(edges(flight()), END_US)
    assert not found.mistakes
    assert (found.pulses, found.cut) == (2 * 40, 0)  # In 0.1 s, 400 a second.
    assert found.width_us == pytest.approx((1000.0, 1500.0), abs=0.01)
    assert found.period_us == pytest.approx((2500.0, 2500.0), abs=0.01)
    assert found.low_after_us == {"reset by supply": pytest.approx(30.0, abs=0.01)}
    assert "80 pulses of 1000.0 to 1500.0 us; 400.00 to 400.00 Hz" in str(found)


def test_the_last_pulse_may_be_cut_but_none_before() -> None:
    cut = [(OFF_US - 400.0, 0, HIGH), (OFF_US - 2.0, 0, LOW)]
    good = flight()
    last = [it for it in good if it[1] != 0 or it[0] < OFF_US - 3000.0]
    found = pins.measured(edges([*last, *cut]), END_US)
    assert [words for words in found.mistakes if "pulse" in words] == []
    assert found.cut == 1
    assert "has a pulse of 398.0 us" in told([*last, *((at - 1000.0, *it) for at, *it in cut)])


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (pulses(3, 50_000.0, 53_000.0), "output 4 rises at 0.0500 s, while it is not armed"),
        (pulses(3, OFF_US + 1.0, OFF_US + 2000.0), "output 4 rises at 0.2000 s"),
        (pulses(3, 150_000.0, 160_000.0, 999.9), "output 4 has a pulse of 999.9 us"),
        (pulses(3, 150_000.0, 160_000.0, 2000.1), "output 4 has a pulse of 2000.1 us"),
        (pulses(3, 150_000.0, 160_000.0, 1500.0, 2497.0), "output 4 has a period of 2497.0 us"),
        (pulses(3, 150_000.0, 160_000.0, 1500.0, 2503.0), "output 4 has a period of 2503.0 us"),
        ([(150_000.0, 7, FLOATS), (150_010.0, 7, LOW)], "output 8 floats from 0.1500 s on"),
        ([(300_000.0, EVENT, pins.NMI), (300_000.0, 7, HIGH)], "output 8 is not low"),
        ([(300_000.0, 7, HIGH)], "output 8 rises at 0.3000 s"),
    ],
)
def test_what_is_wrong(changes: list[Change], words: str) -> None:
    assert words in told(flight(changes))


def test_a_fault_in_flight() -> None:
    """An exception at 0.15 s; the pulse of 1500 us that it meets would have ended 0.7 ms later."""
    until = [it for it in flight() if it[0] < 150_000.0]
    begun = [(149_200.0, 2, HIGH)]
    fault = [(150_000.0, EVENT, pins.NMI), (150_003.0, ARMED, HIGH), (150_002.0, 2, LOW)]
    behind = start(170_000.0, SOFTWARE)
    good = pins.measured(edges([*until, *begun, *fault, *behind]), END_US)
    assert [words for words in good.mistakes if "output 3" in words] == []
    assert good.low_after_us["NMI"] == pytest.approx(2.0, abs=0.01)
    assert good.low_after_us["reset by software"] == pytest.approx(30.0, abs=0.01)
    late = [(150_000.0, EVENT, pins.NMI), (151_101.0, 2, LOW), (151_105.0, ARMED, HIGH)]
    assert "output 3 is not low 1101 us after NMI at 0.1500 s" in told([*until, *begun, *late])


def test_a_reset_behind_which_a_pin_floats_for_too_long() -> None:
    behind = [it for it in start(300_000.0, WATCHDOG) if (it[1], it[2]) != (5, LOW)]
    words = "output 6 is not low 1100 us after reset by watchdog at 0.3000 s"
    assert words in told([*flight(), *behind, (301_100.0, 5, LOW)])
    never = "output 6 is not low 100000 us after reset by watchdog"
    assert never in told([*flight(), *behind])
