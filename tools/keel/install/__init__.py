# SPDX-License-Identifier: Apache-2.0
"""Finds, installs and pins the tools Keel is proved, tested and built with.

A proof is worth what its prover is worth, so toolchain.lock.json names for every tool the
versions that may be used. What decides a verdict and does not come from the host's own suite is
pinned by SHA-256 as well and unpacked into a cache outside the repository. The host's package
manager installs the rest; its libc and its /etc/apt are never touched.

lock             what is wanted
found, findings  what is there, and remembering it
apt, mirror      Debian packages
python_packages  what pip brings
unpack, cache    the folder of unpacked tools
provers          how provers are started for the target: verdicts depend on it
tools            all together: the class Toolchain
command          what python3 tools/keel tools takes
"""

from keel.install.found import Found
from keel.install.lock import ToolchainError
from keel.install.provers import MACHDEP_FILE, TARGET_FLAGS, small_environment
from keel.install.tools import Toolchain

__all__ = [
    "MACHDEP_FILE",
    "TARGET_FLAGS",
    "Found",
    "Toolchain",
    "ToolchainError",
    "small_environment",
]
