# SPDX-License-Identifier: Apache-2.0
"""The line with which `make` refuses a name: which, the nearest right one, and all there are.

python3 tools/keel names variable UNTI -- UNIT BOARD ARGS
"""

import sys
from collections.abc import Sequence

from keel.base.errors import CANNOT, unknown


def main(arguments: Sequence[str]) -> int:
    """Entry point."""
    if "--" not in arguments[2:]:
        print("names: expected KIND WORD [WORD...] -- NAME [NAME...]", file=sys.stderr)
        return CANNOT
    kind, word, *others = arguments
    print(unknown(kind, word, others[others.index("--") + 1 :]))
    return 0
