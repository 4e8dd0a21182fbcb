# SPDX-License-Identifier: Apache-2.0
"""The Debian mirror that the host uses, from its apt configuration."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from toolchain.lock import ToolchainError

DEBIAN_SUITES = frozenset(
    "bullseye bookworm trixie forky sid oldoldstable oldstable stable testing unstable".split()
)


@dataclass(frozen=True)
class Source:
    """One binary entry of the host's apt configuration."""

    uri: str
    suite: str
    components: tuple[str, ...]
    signed_by: str = ""

    @property
    def rank(self) -> int:
        """How surely this is Debian's own archive: third parties use its suite names too."""
        if "debian-archive" in self.signed_by:
            return 0
        return 1 if self.uri.rstrip("/").endswith("/debian") else 2


def sources_of_list(text: str) -> Iterator[Source]:
    """Entries in the one-line format: deb [options] uri suite component…"""
    for line in text.splitlines():
        match = re.match(r"deb\s+(?:\[(.*?)\]\s+)?(\S+)\s+(\S+)\s+(.*)", line.split("#")[0].strip())
        if match:
            options, uri, suite, components = match.groups()
            signed = re.search(r"signed-by=(\S+)", options or "")
            yield Source(uri, suite, tuple(components.split()), signed.group(1) if signed else "")


def sources_of_deb822(text: str) -> Iterator[Source]:
    """Entries in the deb822 format of .sources files."""
    lines = (line for line in text.splitlines() if not line.startswith("#"))
    for stanza in re.split(r"\n\s*\n", "\n".join(lines)):
        pairs = re.findall(r"^(\S+):[ \t]*((?:.*)(?:\n[ \t]+.*)*)", stanza, re.MULTILINE)
        values = {key.lower(): value.split() for key, value in pairs}
        if "deb" not in values.get("types", []) or values.get("enabled") == ["no"]:
            continue
        signed = (values.get("signed-by") or [""])[0]
        for suite in values.get("suites", []):
            for uri in values.get("uris", [])[:1]:
                yield Source(uri, suite, tuple(values.get("components", [])), signed)


def host_sources(etc: Path) -> list[Source]:
    """All binary entries of an apt configuration."""
    parts = etc / "sources.list.d"
    entries: list[Source] = []
    for path in [etc / "sources.list", *sorted(parts.glob("*.list"))]:
        if path.is_file():
            entries += sources_of_list(path.read_text(errors="replace"))
    for path in sorted(parts.glob("*.sources")):
        entries += sources_of_deb822(path.read_text(errors="replace"))
    return entries


def debian_mirror(etc: Path = Path("/etc/apt")) -> str:
    """The mirror from which the host takes Debian, so that other suites come from there too."""
    if chosen := os.environ.get("KEEL_DEBIAN_MIRROR"):
        return chosen
    entries = [
        entry for entry in host_sources(etc)
        if entry.suite in DEBIAN_SUITES and "main" in entry.components
        and not entry.uri.startswith("cdrom:")
    ]  # fmt: skip
    if not entries:
        raise ToolchainError(
            f"no Debian mirror in {etc}: neither sources.list nor sources.list.d names a Debian "
            "suite with component main (KEEL_DEBIAN_MIRROR=<uri> sets one)"
        )
    return min(entries, key=lambda entry: entry.rank).uri
