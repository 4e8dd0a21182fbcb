# SPDX-License-Identifier: Apache-2.0
"""What tests of flights share."""

from __future__ import annotations

import pytest

from keel.flight import library
from keel.flight.library import Copter
from keel.install import Toolchain


@pytest.fixture(scope="module")
def copter(tmp_path_factory: pytest.TempPathFactory) -> Copter:
    """The library."""
    return Copter(library.build(Toolchain(), tmp_path_factory.mktemp("copter")))
