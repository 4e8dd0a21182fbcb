# SPDX-License-Identifier: Apache-2.0
"""The folder of unpacked tools, shared by every clone of the project."""

from __future__ import annotations

import contextlib
import fcntl
import hashlib
import json
import os
import shutil
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from keel.base.files import sha256_of
from keel.install.apt import Log
from keel.install.found import Finder, Found
from keel.install.lock import Spec, ToolchainError
from keel.install.unpack import Tree

Say = Callable[[str], None]


def default_cache() -> Path:
    """The cache folder, as the environment sets it."""
    if chosen := os.environ.get("KEEL_CACHE"):
        return Path(chosen).expanduser().absolute()
    base = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    return Path(base).expanduser().absolute() / "keel"


def _filter_of(spec: Spec) -> list[str]:
    """The program that stands before an unpacked tool, by its name and its text."""
    return [spec.filter.name, sha256_of(spec.filter)] if spec.filter else []


class Cache:
    """The folder of unpacked tools and findings, shared by every clone of the project."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.log = Log(folder / "log" / "install.log")

    @contextlib.contextmanager
    def locked(self, say: Say) -> Iterator[None]:
        """Only one installation at a time; what an interrupted one left is removed."""
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            stream = (self.folder / "lock").open("w")
        except OSError as error:
            reason = f"cannot write the cache {self.folder}: {error.strerror}"
            raise ToolchainError(reason) from error
        with stream:
            try:
                fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                say(f"waiting for another installation into {self.folder}")
                fcntl.flock(stream, fcntl.LOCK_EX)
            shutil.rmtree(self.folder / "tmp", ignore_errors=True)
            yield

    def tree(self, spec: Spec) -> Path:
        """Where an unpacked tool lies; the name holds its pin, so that two clones may differ."""
        tag = ""
        if spec.kind == "packages":  # Built for one version of Python.
            tag = f"-{sys.implementation.cache_tag}"
        elif chosen := [*spec.keep, *_filter_of(spec)]:
            tag = f"-{hashlib.sha256(' '.join(chosen).encode()).hexdigest()[:6]}"
        return self.folder / "tools" / f"{spec.name}-{spec.pin}-{spec.sha256[:12]}{tag}"

    def manifest(self, spec: Spec) -> list[dict[str, str]]:
        """Which files the tree was unpacked from; empty when there is no whole tree."""
        try:
            raw = json.loads((self.tree(spec) / "manifest.json").read_text())
        except (OSError, ValueError):
            return []
        return [{str(k): str(v) for k, v in part.items()} for part in raw]

    def find(self, spec: Spec, finder: Finder) -> Found | None:
        """The tool, if it was unpacked before and answers."""
        parts = self.manifest(spec)
        return finder.tree(spec, self.tree(spec), parts) if parts else None

    def unpack(self, spec: Spec, fill: Callable[[Tree], None], finder: Finder) -> Found:
        """Fill a new tree, try the tool in it, and only then move it to its place."""
        work = self.folder / "tmp" / spec.name
        shutil.rmtree(work, ignore_errors=True)
        tree = Tree(spec, work / "root", work / "scratch", self.log)
        try:
            tree.root.mkdir(parents=True)
            tree.scratch.mkdir()
            fill(tree)
            if not finder.tree(spec, tree.root, tree.parts):
                reasons = "; ".join(finder.looked.get(spec.name, ["a command is missing"]))
                raise ToolchainError(f"{spec.name} was unpacked but does not work: {reasons}")
            (tree.root / "manifest.json").write_text(json.dumps(tree.parts, indent=1))
            self._publish(tree)
        finally:
            shutil.rmtree(work, ignore_errors=True)
        result = self.find(spec, finder)
        assert result is not None
        return result

    def _publish(self, tree: Tree) -> None:
        place = self.tree(tree.spec)
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.rmtree(place, ignore_errors=True)
        tree.root.rename(place)
