#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Find, install and pin the tools Keel is proved, tested and built with: see tools/toolchain.

    python3 tools/toolchain.py ensure prove test
"""

import sys

from toolchain.command_line import main  # The package of the same name, not this file.

if __name__ == "__main__":
    sys.exit(main())
