# SPDX-License-Identifier: Apache-2.0
"""What is wanted: the lock file."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable
from dataclasses import dataclass, fields, replace
from pathlib import Path

from keel.base.errors import ToolError, unknown
from keel.install.groups import TOOLS_DIR, GroupError, requirements_of

LOCK_FILE = TOOLS_DIR / "toolchain.lock.json"


class ToolchainError(ToolError):
    """A tool is missing or could not be installed; the message says which and why."""


@dataclass(frozen=True)
class Spec:
    """One tool of the lock file."""

    name: str
    kind: str
    commands: tuple[str, ...] = ()
    probe: tuple[str, ...] = ()
    version: str = ""
    file: str = ""
    path: str = ""
    locate: tuple[str, ...] = ()
    at_least: str = ""
    below: str = ""
    packages: tuple[str, ...] = ()
    suite: str = ""
    package: str = ""
    pin: str = ""
    sha256: str = ""
    archive: str = ""
    folder: str = ""
    program: str = ""
    keep: tuple[str, ...] = ()
    before: str = ""
    group: str = ""
    libraries: tuple[str, ...] = ()
    loader: str = ""
    library_path: tuple[str, ...] = ()
    provers: tuple[str, ...] = ()
    note: str = ""

    @property
    def wanted(self) -> str:
        """The admitted versions, in words."""
        return f"{self.at_least} or later, before {self.below}" if self.at_least else "any"

    @property
    def source(self) -> str:
        """Where it can be had, in words."""
        if self.packages:
            return f"Debian package {' '.join(self.packages)}"
        if self.kind == "wheel":
            return f"{self.package} {self.pin} of the Python package index"
        if self.kind == "crate":
            return f"{self.package} {self.pin} of the Rust package registry"
        if self.kind == "packages":
            return f"Python packages of group {self.group} in pyproject.toml"
        if self.cached:
            return f"{self.package} {self.pin} of Debian {self.suite}"
        return "made from the others"

    @property
    def cached(self) -> bool:
        """True when the tool is unpacked into the cache rather than installed on the host."""
        return self.kind in {"deb", "source", "wheel", "crate", "packages"}

    @property
    def derived(self) -> bool:
        """True when the tool is made from the others, and so can only be had after them."""
        return self.kind in {"why3-config", "machdep"}

    @property
    def filter(self) -> Path | None:
        """The program of ours, below tools/, that stands before its command."""
        return TOOLS_DIR / self.before if self.before else None

    def started(self, command: str) -> str:
        """The program behind a command of an unpacked tool, relative to its tree."""
        if self.group:
            return f"bin/{command}"
        return self.program or f"usr/bin/{command}"

    def admits(self, version: str) -> bool:
        """True when this version may be used."""
        if not self.at_least:
            return True
        found = version_key(version)
        return version_key(self.at_least) <= found < version_key(self.below)


def version_key(version: str) -> tuple[int, ...]:
    """The leading numbers of a version, comparable ("25.0-beta" counts as 25.0)."""
    match = re.match(r"\d+(?:\.\d+)*", version)
    return tuple(int(part) for part in match.group().split(".")) if match else ()


def read_spec(name: str, raw: dict[str, object]) -> Spec:
    """Build a Spec; an unknown or mistyped key is an error, not a wish ignored."""
    known = {item.name: item.type for item in fields(Spec)}
    values: dict[str, str | tuple[str, ...]] = {}
    for key, value in raw.items():
        if key not in known or key == "name":
            raise ToolchainError(f"{LOCK_FILE.name}: tool {name}: unknown key {key!r}")
        if isinstance(value, list):
            values[key] = tuple(str(part) for part in value)
        else:
            values[key] = str(value)
        if isinstance(values[key], tuple) != str(known[key]).startswith("tuple"):
            raise ToolchainError(f"{LOCK_FILE.name}: tool {name}: {key!r} has the wrong type")
    spec = Spec(name=name, **values)  # type: ignore[arg-type]
    return pinned(spec) if spec.kind == "packages" else spec


def pinned(spec: Spec) -> Spec:
    """Packages, with the digest of all that pip is to install of them."""
    try:
        text = requirements_of(spec.group)
    except GroupError as error:
        raise ToolchainError(f"{LOCK_FILE.name}: tool {spec.name}: {error}") from error
    return replace(spec, pin="1", sha256=hashlib.sha256(text.encode()).hexdigest())


@dataclass(frozen=True)
class Lock:
    """The lock file: which tools make up a group, and what each must be."""

    groups: dict[str, tuple[str, ...]]
    tools: dict[str, Spec]
    digest: str

    @classmethod
    def read(cls, path: Path = LOCK_FILE) -> Lock:
        """Read and check the lock file."""
        text = path.read_bytes()
        raw = json.loads(text)
        tools = {name: read_spec(name, value) for name, value in raw["tools"].items()}
        groups = {name: tuple(value) for name, value in raw["groups"].items()}
        for group, names in groups.items():
            for name in names:
                if name not in tools:
                    raise ToolchainError(f"{path.name}: group {group} names no such tool: {name}")
        return cls(groups, tools, hashlib.sha256(text).hexdigest())

    def of_groups(self, groups: Iterable[str]) -> list[Spec]:
        """The tools of the groups, each once, in the order in which they must be had."""
        names: dict[str, None] = {}
        for group in groups:
            if group not in self.groups:
                raise ToolchainError(unknown("group", group, sorted(self.groups)))
            names.update(dict.fromkeys(self.groups[group]))
        specs = [self.tools[name] for name in names]
        return sorted(specs, key=lambda spec: (spec.derived, spec.cached))

    def providing(self, tool: str) -> Spec:
        """The tool of that name, or the one that brings the command of that name."""
        if tool in self.tools:
            return self.tools[tool]
        for spec in self.tools.values():
            if tool in spec.commands:
                return spec
        raise ToolchainError(unknown("tool", tool, sorted(self.tools)))
