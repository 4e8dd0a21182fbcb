# SPDX-License-Identifier: Apache-2.0
"""What is there: looking for tools on the host and in the cache."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypedDict

from keel.base.files import sha256_of
from keel.base.run import run
from keel.install.lock import Spec

PROBE_TIMEOUT_S = 120


@dataclass(frozen=True)
class Found:
    """A tool that is there, checked, with what identifies it in a report."""

    tool: str
    version: str
    origin: str
    location: str
    sha256: str
    size: int
    mtime_ns: int
    commands: dict[str, str]
    first_on_path: dict[str, str]
    parts: list[dict[str, str]]

    def still_there(self, path: str) -> bool:
        """True when the file is the same and PATH still leads to what it led to."""
        try:
            seen = os.stat(self.location)
        except OSError:
            return False
        if (seen.st_size, seen.st_mtime_ns) != (self.size, self.mtime_ns):
            return False
        return all(
            (shutil.which(name, path=path) or "") == at for name, at in self.first_on_path.items()
        )


class Fingerprint(TypedDict):
    """What identifies a file, and what quickly tells that it was changed."""

    location: str
    sha256: str
    size: int
    mtime_ns: int


def fingerprint(path: Path) -> Fingerprint:
    """The fingerprint of a file."""
    seen = path.stat()
    return Fingerprint(
        location=str(path), sha256=sha256_of(path), size=seen.st_size, mtime_ns=seen.st_mtime_ns
    )


def found(
    spec: Spec,
    version: str,
    origin: str,
    location: Path,
    commands: dict[str, str] | None = None,
    parts: list[dict[str, str]] | None = None,
) -> Found:
    """Build a Found for a file at `location`."""
    return Found(
        tool=spec.name,
        version=version,
        origin=origin,
        commands=commands or {},
        first_on_path={},
        parts=parts or [],
        **fingerprint(location),
    )


def answer(command: Sequence[str], environment: Mapping[str, str] | None = None) -> str:
    """What a short command says, on both streams."""
    return run(command, PROBE_TIMEOUT_S, environment=environment).output


def matched_version(spec: Spec, text: str) -> str:
    """The version in a tool's answer: the groups of the pattern, joined by dots; "" if none."""
    match = re.search(spec.version, text, re.MULTILINE)
    return ".".join(match.groups()) if match else ""


class Finder:
    """Looks for tools that are there already; remembers where it looked, for the error message."""

    def __init__(self, cache: Path) -> None:
        self.looked: dict[str, list[str]] = {}
        self.path = path_outside(cache)
        self._directories = [Path(name) for name in self.path.split(os.pathsep) if name]

    def system(self, spec: Spec) -> Found | None:
        """A tool of the host: on PATH, in an admitted version, with all its commands."""
        if spec.file:
            return self._file(spec, Path(spec.path), "found")
        if not spec.commands:
            return self._located(spec)
        for directory in self._directories:
            candidate = self._in_directory(spec, directory)
            if candidate:
                return candidate
        self._note(spec, f"no suitable {' '.join(spec.commands)} in {self.path}")
        return None

    def tree(self, spec: Spec, root: Path, parts: list[dict[str, str]]) -> Found | None:
        """A tool unpacked into a folder of the cache."""
        if spec.file:
            return self._file(spec, root, "cache", parts)
        finding = self._in_directory(spec, root / "bin", "cache", parts)
        # What identifies the tool is the program, not the script that starts it.
        # With a filter before it, that filter: of the program the manifest has the package.
        program = spec.filter.name if spec.filter else spec.started(spec.commands[0])
        return finding and replace(finding, **fingerprint(root / program))

    def _note(self, spec: Spec, text: str) -> None:
        self.looked.setdefault(spec.name, []).append(text)

    def _accept(self, spec: Spec, text: str, where: str) -> str:
        """The admitted version in an answer, or "" with the reason noted."""
        version = matched_version(spec, text)
        if not version:
            answer = text.strip().splitlines()[-1:] or ["nothing"]
            self._note(spec, f"{where} answers no version, but: {answer[0][:200]}")
        elif not spec.admits(version):
            self._note(spec, f"{where} is version {version}")
        else:
            return version
        return ""

    def _in_directory(
        self,
        spec: Spec,
        directory: Path,
        origin: str = "found",
        parts: list[dict[str, str]] | None = None,
    ) -> Found | None:
        """The tool, when this directory holds all its commands and the probe is satisfied."""
        commands = {name: str(directory / name) for name in spec.commands}
        if not all(os.access(path, os.X_OK) for path in commands.values()):
            return None
        probe = [commands[spec.probe[0]], *spec.probe[1:]]
        version = self._accept(spec, answer(probe), probe[0])
        if not version:
            return None
        location = directory / spec.commands[0]
        parts = host_packages(spec, location) if parts is None else parts
        finding = found(spec, version, origin, location, commands, parts)
        first = {name: shutil.which(name, path=self.path) or "" for name in commands}
        return replace(finding, first_on_path=first)

    def _located(self, spec: Spec) -> Found | None:
        """A library: a compiler answers its version and where it lies."""
        version = self._accept(spec, answer(spec.probe), spec.probe[0])
        location = Path(answer(spec.locate).strip())
        if version and location.is_file():
            parts = host_packages(spec, location.resolve())
            return found(spec, version, "found", location.resolve(), parts=parts)
        if version:
            self._note(spec, f"{spec.locate[0]} does not find {location}")
        return None

    def _file(
        self, spec: Spec, root: Path, origin: str, parts: list[dict[str, str]] | None = None
    ) -> Found | None:
        """A library of sources: a header tells its version."""
        header = root / spec.file
        if not header.is_file():
            self._note(spec, f"no file {header}")
            return None
        version = self._accept(spec, header.read_text(errors="replace"), str(header))
        if not version:
            return None
        parts = host_packages(spec, header) if parts is None else parts
        return found(spec, version, origin, header, commands={spec.name: str(root)}, parts=parts)


def host_packages(spec: Spec, location: Path) -> list[dict[str, str]]:
    """The host's packages behind a tool, with their exact versions, if it came from packages."""
    if not str(location).startswith("/usr/") or str(location).startswith("/usr/local/"):
        return []
    query = ["dpkg-query", "-W", "-f", "${db:Status-Abbrev}${Package} ${Version}\n"]
    text = answer([*query, *spec.packages]) if spec.packages else ""
    installed = re.findall(r"^ii +(\S+) (\S+)$", text, re.MULTILINE)
    return [{"name": name, "version": version, "source": "host"} for name, version in installed]


def path_outside(cache: Path) -> str:
    """PATH without the folders that we put there ourselves: a driver may call another driver."""
    names = os.environ.get("PATH", os.defpath).split(os.pathsep)
    kept = [name for name in dict.fromkeys(names) if name and cache not in Path(name).parents]
    return os.pathsep.join(kept)
