# SPDX-License-Identifier: Apache-2.0
"""Writes the package: into a draft beside its place, which takes the place when it is whole."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from keel.base.errors import ToolError
from keel.base.files import sha256_of, write_bytes, write_json, write_text
from keel.base.git import git
from keel.evidence import attestation, measured
from keel.evidence.assemble import Assembled
from keel.evidence.pdf import summary_pdf
from keel.evidence.site import write_site
from keel.gather.part import Part

SCHEMA = 1  # Of part.json and evidence.json; a change of their form counts it up.
SUMS = "SHA256SUMS"
MANIFEST = "evidence.json"
ATTESTATION = "evidence.intoto.json"
PDF = "evidence.pdf"


@dataclass(frozen=True)
class Source:
    """The source that a package speaks of."""

    stamp: dict[str, str]
    seconds: int  # The commit's time since 1970; the only time in the package.
    changed: tuple[str, ...] = ()  # Files that are not as the commit has them.


def source_of(root: Path, stamp: dict[str, str]) -> Source:
    """What git says of the source; a release archive has no git, and no time."""
    if not stamp["commit"]:
        return Source(stamp, 0)
    seconds = int(git(root, "log", "-1", "--format=%ct"))
    status = git(root, "status", "--porcelain", "-z")
    changed = tuple(line[3:] for line in status.split("\0") if line)
    return Source(stamp, seconds, changed)


def files_of(folder: Path) -> Iterator[Path]:
    """All files of a folder, in order."""
    return (path for path in sorted(folder.rglob("*")) if path.is_file())


def digests(folder: Path, without: Sequence[str] = ()) -> dict[str, str]:
    """The SHA-256 of each file, by its name below the folder."""
    named = {path.relative_to(folder).as_posix(): path for path in files_of(folder)}
    return {name: sha256_of(path) for name, path in named.items() if name not in without}


def write_part(folder: Path, part: Part) -> measured.Measured:
    """A part's files, and what it says as JSON; gives what was measured, which is in neither."""
    found = dict(part.measured)
    for name, path in part.files.items():
        place = Path(os.path.normpath(folder / name))
        if not place.is_relative_to(folder):
            raise ToolError(f"{part.name}: {name}: leads out of the package")
        data, own = measured.copied(name, path)
        write_bytes(place, data)
        found |= own
    said = part.model_dump(mode="json", exclude={"files", "measured", "problems"})
    files = {name: sha256_of(folder / name) for name in sorted(part.files)}
    write_json(folder / "part.json", {"schema": SCHEMA, **said, "files": files})
    return found


def manifest(made: Assembled, source: Source) -> dict[str, Any]:
    """What the package is, for machines that read one file."""
    return {
        "schema": SCHEMA,
        "made_from": source.stamp,
        "source_time": source.seconds,
        "not_as_committed": list(source.changed),
        "problems": made.problems,
        "parts": [
            {
                "name": part.name,
                "title": part.title,
                "summary": part.summary,
                "items": len(part.items),
                "json": f"{part.name}/part.json",
            }
            for part in made.parts
        ],
    }


def write_content(folder: Path, made: Assembled, source: Source) -> None:
    """All that is for people and for machines to read."""
    seconds = {part.name: write_part(folder / part.name, part) for part in made.parts}
    write_json(folder / measured.FILE, {"schema": SCHEMA, "seconds": seconds})
    write_json(folder / MANIFEST, manifest(made, source))
    write_site(folder, made, source.stamp, source.seconds, seconds)
    summary_pdf(folder / PDF, made, source.stamp, source.seconds)


def seal(folder: Path, source: Source, tools: Mapping[str, str]) -> None:
    """The attestation of all files, then the checksums of all, it included."""
    statement = attestation.statement(digests(folder), source.stamp, tools)
    write_json(folder / ATTESTATION, statement)
    lines = [f"{digest}  {name}\n" for name, digest in digests(folder).items()]
    write_text(folder / SUMS, "".join(lines))


def replace(draft: Path, place: Path) -> None:
    """Put a whole draft where the package belongs."""
    old = place.with_name(f".{place.name}.old")
    shutil.rmtree(old, ignore_errors=True)
    if place.exists():
        place.rename(old)
    draft.rename(place)
    shutil.rmtree(old, ignore_errors=True)


def write_package(
    place: Path, made: Assembled, source: Source, tools: Mapping[str, str], sealed: bool = True
) -> None:
    """Write the package as a whole, or nothing."""
    draft = place.with_name(f".{place.name}.draft")
    shutil.rmtree(draft, ignore_errors=True)
    try:
        write_content(draft, made, source)
        if sealed:
            seal(draft, source, tools)
        replace(draft, place)
    except OSError as error:
        raise ToolError(f"cannot write {place}: {error}") from error
    finally:
        shutil.rmtree(draft, ignore_errors=True)


def read_manifest(folder: Path) -> dict[str, Any]:
    """The manifest of a package."""
    try:
        read: dict[str, Any] = json.loads((folder / MANIFEST).read_text(encoding="utf-8"))
    except OSError as error:
        raise ToolError(f"{folder} is no evidence package: {MANIFEST}: {error.strerror}") from error
    except ValueError as error:
        raise ToolError(f"{folder / MANIFEST}: is not whole: {error}") from error
    return read
