# SPDX-License-Identifier: Apache-2.0
"""How long a prover may take: as it is told, and for a test for contradictions, in time, too."""

from __future__ import annotations

from keel.install.provers import CLOCK_PER_PROCESSOR, by_processor_time

# Of the processor, for a test for contradictions that has steps left: CVC4 spends most of its time
# between two of them where quantifiers are many. Seeded contradictions are found within 2 s there.
SMOKE_SECONDS = 10
SHELL = "#!/bin/sh\n"
OF_SMOKE_TESTS = f"""\
# WP tells the steps of a test for contradictions alone, and no time.
case " $* " in
    *" --rlimit="*) set -- "--tlimit={SMOKE_SECONDS * 1000 * CLOCK_PER_PROCESSOR}" "$@" ;;
esac
"""


def within_limits(program: str) -> str:
    """The script that starts a prover within its limits."""
    return SHELL + OF_SMOKE_TESTS + by_processor_time(program).removeprefix(SHELL)
