# SPDX-License-Identifier: Apache-2.0
"""The line with which `make` refuses a name: which, the nearest right one, and all there are.

python3 tools/make_names.py variable UNTI -- UNIT BOARD ARGS
"""

import sys

from keel.base.errors import unknown

if __name__ == "__main__":
    kind, word, *others = sys.argv[1:]
    print(unknown(kind, word, others[others.index("--") + 1 :]))
