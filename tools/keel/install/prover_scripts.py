# SPDX-License-Identifier: Apache-2.0
"""The scripts that start the provers: within their limits, which each counts in its own words.

When a prover gives up changes no proof that it finds, so no kept verdict rests on this file; it may
only give a prover as much time as keel/install/provers.py says, or more.
"""

from __future__ import annotations

from keel.install.prover_limits import within_limits


def script_of(program: str) -> str:
    """The script that starts a prover.

    CVC4 1.8 has it the wrong way round: with --cpu-time it counts the clock's time, and without it
    the processor's (measured beside endless programs; tests/tools/test_limits.py).
    """
    return within_limits(program).replace(" --cpu-time", "")
