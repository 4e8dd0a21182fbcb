# SPDX-License-Identifier: Apache-2.0
"""The image of FMUv5 meets what fails in flight as the host's copter does. Of its two inertial
units the second one fails."""

from __future__ import annotations

import pytest
from test_board_flight import flown, made

from keel.flight import alike, scenario
from keel.flight.board import BoardCopter
from keel.flight.library import Copter

__all__ = ["flown", "made"]  # Fixtures.


@pytest.mark.parametrize("name", ["radio_loss_position", "imu_freeze", "imu_silent"])
def test_it_flies_as_the_hosts_copter_does(copter: Copter, flown: BoardCopter, name: str) -> None:
    found = alike.compared(copter, flown, scenario.read(name), "fmuv5")
    assert [one for one in found if not one.good] == []
    assert {"states", "roll", "pitch", "place", "skipped", "rises_m"} <= {one.name for one in found}
    assert next(one.number or 0.0 for one in found if one.name == "rises_m") > 2.5
