# SPDX-License-Identifier: Apache-2.0
"""The image of FMUv5 meets what fails in flight as the host's copter does."""

from __future__ import annotations

import pytest
from board_alike import check_alike
from test_board_flight import flown, made
from test_copter_image import tools

from keel.flight.board import BoardCopter
from keel.flight.library import Copter

__all__ = ["flown", "made", "tools"]  # Fixtures.


@pytest.mark.parametrize("name", ["radio_loss_position", "imu_freeze", "imu_silent"])
def test_it_goes_on_as_the_hosts_copter_does(copter: Copter, flown: BoardCopter, name: str) -> None:
    """Of two inertial units, the second one fails."""
    check_alike(copter, flown, name)
