# SPDX-License-Identifier: Apache-2.0
"""Starts a sub-command: python3 tools/keel prove --unit queue."""

import sys
from pathlib import Path

# Started by its folder, Python looks for modules there, where rooms bear names of the standard
# library's modules.
sys.path[0] = str(Path(__file__).resolve().parents[1])

from keel.cli.commands import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
