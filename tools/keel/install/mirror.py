# SPDX-License-Identifier: Apache-2.0
"""The Debian mirrors: the one that the host uses, as its apt tells it, or a user's choice."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence

from keel.install.found import answer
from keel.install.lock import ToolchainError

DEBIAN_SUITES = frozenset(
    "bullseye bookworm trixie forky sid oldoldstable oldstable stable testing unstable".split()
)
# A line of it: the archive, the suite, the component, and who says that it is theirs.
FORMAT = "$(REPO_URI) $(RELEASE) $(COMPONENT) $(ORIGIN)"
LINE = re.compile(r"^(?!cdrom:)(\S+)/ (\S+) main (.*)$", re.MULTILINE)


def archives(settings: Sequence[str], *options: str) -> list[tuple[str, str]]:
    """Archives of which apt has a suite of Debian's with its component main, and their owners."""
    command = ["env", "LC_ALL=C", "apt-get", *settings, "indextargets", *options]
    output = answer([*command, "--format", FORMAT, "Created-By: Packages"])
    return [(uri, owner) for uri, suite, owner in LINE.findall(output) if suite in DEBIAN_SUITES]


def debian_mirrors(settings: Sequence[str] = ()) -> list[str]:
    """The mirrors that have Debian's suites: those that the environment names, the first that has
    the suite wins; else the one from which the host takes Debian.

    Third parties use the names of Debian's suites, too. Who is who apt knows where it has read the
    lists; where not, an archive counts first that is called debian. `settings` are apt's.
    """
    if chosen := os.environ.get("KEEL_DEBIAN_MIRROR"):
        return chosen.split()
    if read := [uri for uri, owner in archives(settings) if owner == "Debian"]:
        return read[:1]
    configured = [uri for uri, _ in archives(settings, "--no-release-info")]
    if not configured:
        raise ToolchainError(
            "no Debian mirror: apt-get indextargets lists no Debian suite with component main "
            "(KEEL_DEBIAN_MIRROR=<uri> sets one)"
        )
    return [min(configured, key=lambda uri: not uri.endswith("/debian"))]
