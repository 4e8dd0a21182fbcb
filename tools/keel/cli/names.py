# SPDX-License-Identifier: Apache-2.0
"""The line with which `make` refuses a name: which, the nearest right one, and all there are.

python3 tools/keel names variable UNTI -- UNIT BOARD ARGS
"""

from collections.abc import Sequence

from keel.base.errors import unknown


def main(arguments: Sequence[str]) -> int:
    """Entry point."""
    kind, word, *others = arguments
    print(unknown(kind, word, others[others.index("--") + 1 :]))
    return 0
