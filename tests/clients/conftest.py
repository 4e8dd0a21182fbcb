# SPDX-License-Identifier: Apache-2.0
"""What tests of clients share."""

from __future__ import annotations

import pytest
import shared_builds

from keel.flight.library import Copter
from keel.install import Toolchain

FLAGS = ("-O1", "-fsanitize=undefined", "-fno-sanitize-recover=all")


@pytest.fixture(scope="module")
def copter() -> Copter:
    """The library; what is undefined ends it."""
    return Copter(shared_builds.copter_library(Toolchain(), FLAGS))
