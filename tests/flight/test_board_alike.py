# SPDX-License-Identifier: Apache-2.0
"""The image of FMUv5 flies on a model of its chip as the host's copter does."""

from __future__ import annotations

import pytest
from board_alike import check_alike
from test_board_flight import flown, made
from test_copter_image import tools

from keel.flight.board import BoardCopter
from keel.flight.library import Copter

__all__ = ["flown", "made", "tools"]  # Fixtures.


@pytest.mark.parametrize("name", ["hover", "sticks", "return_and_land"])
def test_it_flies_as_the_hosts_copter_does(copter: Copter, flown: BoardCopter, name: str) -> None:
    check_alike(copter, flown, name)
    # The bursts of both units alone are 34 bytes of 8 bits at 6.75 MHz: 40.3 us.
    assert next(it for it in flown.timed() if it.name == "Background IMU").longest_us > 40
