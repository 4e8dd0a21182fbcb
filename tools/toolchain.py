#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Find, install and pin the tools Keel is proved, tested and built with: see tools/toolchain.

    python3 tools/toolchain.py ensure prove test
"""

import sys

from keel.install.command import main

if __name__ == "__main__":
    sys.exit(main())
