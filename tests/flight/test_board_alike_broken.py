# SPDX-License-Identifier: Apache-2.0
"""The image of FMUv5 meets what fails in flight as the host's copter does."""

from __future__ import annotations

import pytest
from board_alike import check_alike
from test_board_flight import flown, made
from test_copter_image import tools

from keel.flight import judge
from keel.flight.board import BoardCopter
from keel.flight.library import Copter

__all__ = ["flown", "made", "tools"]  # Fixtures.


def test_it_loses_the_radio_as_the_hosts_copter_does(copter: Copter, flown: BoardCopter) -> None:
    asked, own = check_alike(copter, flown, "radio_loss_position")
    assert judge.is_good(asked, own, judge.judged(asked, own, None))


@pytest.mark.parametrize("name", ["imu_freeze", "imu_silent"])
def test_one_of_two_units_fails_as_on_the_host(
    copter: Copter, flown: BoardCopter, name: str
) -> None:
    """These scenarios' own limits are for three units."""
    check_alike(copter, flown, name)
