# SPDX-License-Identifier: Apache-2.0
"""Filling a folder of the cache with what was downloaded and is, byte for byte, as pinned."""

from __future__ import annotations

import os
import shlex
import shutil
import sys
import tarfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from keel.base.files import sha256_of
from keel.install.apt import Log, Suite
from keel.install.lock import LOCK_FILE, Spec, ToolchainError


@dataclass
class Tree:
    """A folder being filled: what it holds becomes visible all at once, or not at all."""

    spec: Spec
    root: Path
    scratch: Path
    log: Log
    parts: list[dict[str, str]] = field(default_factory=list)

    def add_part(self, name: str, version: str, source: str, file: Path) -> None:
        """Record a downloaded file in the manifest."""
        entry = {"name": name, "version": version, "source": source, "sha256": sha256_of(file)}
        self.parts.append(entry)

    def check_pin(self, file: Path) -> None:
        """Refuse a download that is not, byte for byte, the one that was reviewed."""
        actual = sha256_of(file)
        if actual != self.spec.sha256:
            raise ToolchainError(
                f"{self.spec.name}: {file.name} is not the pinned file: SHA-256 is {actual}, "
                f"{LOCK_FILE.name} wants {self.spec.sha256}; nothing was kept"
            )


def unpack_deb(tree: Tree, suite: Suite) -> None:
    """A Debian package of another suite, with the libraries it runs on if the host's are older."""
    spec = tree.spec
    suite.update()
    package = suite.download(spec.package, spec.pin, tree.scratch / spec.package)
    tree.check_pin(package)
    tree.add_part(spec.package, spec.pin, f"Debian {suite.name}, pinned", package)
    _extract_deb(tree, package)
    for library in spec.libraries:
        file = suite.download(library, "", tree.scratch / library)
        version = file.name.split("_")[1].replace("%3a", ":")
        tree.add_part(library, version, f"Debian {suite.name}", file)
        _extract_deb(tree, file)
    for command in spec.commands:
        write_starter(tree, command)


def _extract_deb(tree: Tree, package: Path) -> None:
    if tree.log.run(["dpkg-deb", "-x", str(package), str(tree.root)]) != 0:
        raise ToolchainError(f"{tree.spec.name}: cannot unpack {package.name}:{tree.log.tail()}")


def write_starter(tree: Tree, command: str, start: str = "") -> None:
    """A script that starts the program from wherever the tree lies, on the tree's own libc if any.

    Only this one process runs on that libc: the host's compiler, which it calls, does not.
    """
    program = tree.spec.started(command)
    if not start and not (tree.root / program).is_file():
        raise ToolchainError(f"{tree.spec.name}: the package holds no {program}")
    start = start or _filtered(tree, f'"$root/{program}"')
    if tree.spec.loader:
        libraries = ":".join(f"$root/{part}" for part in tree.spec.library_path)
        start = (
            f'exec "$root/{tree.spec.loader}" --argv0 "$0" \\\n'
            f'    --library-path "{libraries}" "$root/{program}" "$@"'
        )
    target = tree.root / "bin" / command
    target.parent.mkdir(exist_ok=True)
    target.write_text(f"#!/bin/sh\nroot=${{0%/*}}/..\n{start}\n")
    target.chmod(0o755)


def _filtered(tree: Tree, program: str) -> str:
    """How a program is started behind the filter that it has, if any; the tree holds a copy."""
    source = tree.spec.filter
    if not source:
        return f'exec {program} "$@"'
    shutil.copyfile(source, tree.root / source.name)
    python = shlex.quote(sys.executable)
    return f'exec {python} -S -E "$root/{source.name}" {program} "$@"'


def extract(archive: Path, place: Callable[[str], Path | None]) -> None:
    """Write those files of a tar archive for which there is a place; its one folder is left off."""
    with tarfile.open(archive) as tar:
        for member in tar:
            target = place(member.name.partition("/")[2]) if member.isfile() else None
            stream = tar.extractfile(member) if target else None
            if target and stream:
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(stream.read())


def unpack_source(tree: Tree, suite: Suite) -> None:
    """One folder of the upstream archive of a Debian source package."""
    spec = tree.spec
    suite.update()
    archive = suite.download_source(spec.package, spec.archive, tree.scratch / "source")
    tree.check_pin(archive)
    tree.add_part(spec.archive, spec.pin, f"Debian {suite.name} source, pinned", archive)

    def place(inner: str) -> Path | None:
        path = Path(inner)
        return tree.root / path.name if path.parent.as_posix() == spec.folder else None

    extract(archive, place)


def unpack_crate(tree: Tree, cargo: Sequence[str]) -> None:
    """Parts of a Rust crate, as data; cargo fetches it, as it is configured here."""
    spec = tree.spec
    package = tree.scratch / "fetch"
    (package / "src").mkdir(parents=True)
    (package / "src" / "lib.rs").touch()
    (package / "Cargo.toml").write_text(
        '[package]\nname = "fetch"\nversion = "0.0.0"\nedition = "2018"\n[dependencies]\n'
        f'{spec.package} = {{ version = "={spec.pin}", default-features = false }}\n'
    )
    if tree.log.run([*cargo, "fetch"], package) != 0:
        raise ToolchainError(
            f"{spec.name}: cargo does not get {spec.package} {spec.pin}; it says:{tree.log.tail()}"
        )
    home = Path(os.environ.get("CARGO_HOME") or "~/.cargo").expanduser()
    archives = sorted(home.glob(f"registry/cache/*/{spec.package}-{spec.pin}.crate"))
    if not archives:
        raise ToolchainError(
            f"{spec.name}: cargo left no {spec.package}-{spec.pin}.crate in {home}"
        )
    tree.check_pin(archives[0])
    tree.add_part(spec.package, spec.pin, "Rust package registry, pinned", archives[0])

    def place(inner: str) -> Path | None:
        wanted = inner.startswith((spec.file, *spec.keep)) and ".." not in inner.split("/")
        return tree.root / inner if wanted else None

    extract(archives[0], place)
