# SPDX-License-Identifier: Apache-2.0
"""What tests of flights share."""

from __future__ import annotations

import pytest
import shared_builds

from keel.flight.library import Copter
from keel.install import Toolchain


@pytest.fixture(scope="module")
def copter() -> Copter:
    """The library."""
    return Copter(shared_builds.copter_library(Toolchain()))
