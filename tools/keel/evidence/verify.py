# SPDX-License-Identifier: Apache-2.0
"""Looks whether a package is as it was made: no file altered, missing or added, one source."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from keel.base.errors import ToolError
from keel.base.source import STAMP
from keel.evidence import attestation, measured
from keel.evidence.package import ATTESTATION, SUMS, digests, read_manifest

LINE = re.compile(r"([0-9a-f]{64})  (\S.*)")


def read_sums(path: Path) -> dict[str, str]:
    """The checksums that a package was sealed with, by the names of its files."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise ToolError(f"{path}: cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise ToolError(f"{path}: is not whole: expected UTF-8") from error
    found = {}
    for number, line in enumerate(lines, 1):
        match = LINE.fullmatch(line)
        if not match:
            raise ToolError(f"{path}:{number}: expected a SHA-256 and a name")
        found[match[2]] = match[1]
    return found


def differences(stated: Mapping[str, str], found: Mapping[str, str], by: str) -> Iterator[str]:
    """Each file that is not as it was stated to be."""
    for name in sorted({*stated, *found}):
        if name not in found:
            yield f"{name}: is missing, {by} has it"
        elif name not in stated:
            yield f"{name}: was added, {by} does not have it"
        elif stated[name] != found[name]:
            yield f"{name}: was altered, {by} has another digest"


def attested(folder: Path, found: Mapping[str, str]) -> Iterator[str]:
    """What the attestation says otherwise."""
    path = folder / ATTESTATION
    try:
        read = json.loads(path.read_text(encoding="utf-8"))
        stated, made = attestation.subjects(read), attestation.commit_stated(read)
    except (OSError, ValueError, KeyError, TypeError) as error:
        yield f"{ATTESTATION}: is missing or not whole: {type(error).__name__}: {error}"
        return
    others = {name: digest for name, digest in found.items() if name != ATTESTATION}
    yield from differences(stated, others, ATTESTATION)
    if made != read_manifest(folder)[STAMP]:
        yield f"{ATTESTATION}: names another source than the package"


def verify(folder: Path, stamp: Mapping[str, str]) -> list[str]:
    """All that is wrong with a package; the stamp is of the source that is here."""
    if not folder.is_dir():
        raise ToolError(f"{folder}: there is no such folder")
    made = read_manifest(folder).get(STAMP, {})
    found = digests(folder, without=(SUMS,))
    problems = [*differences(read_sums(folder / SUMS), found, SUMS), *attested(folder, found)]
    if made.get("commit") != stamp["commit"]:
        problems.append(f"made from commit {made.get('commit')}, here is {stamp['commit']}")
    elif made.get("tree") != stamp["tree"]:
        problems.append("the source here is not the one that the package was made from")
    return problems


def stated_in(folder: Path) -> dict[str, object]:
    """The attestation, but for the digests of what was measured."""
    path = folder / ATTESTATION
    try:
        read: dict[str, object] = json.loads(path.read_text(encoding="utf-8"))
        subjects = attestation.subjects(read)
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ToolError(f"{path}: is missing or not whole: {type(error).__name__}") from error
    return {**read, "subject": {**subjects, **dict.fromkeys(measured.FILES, "")}}


def reproduced(one: Path, other: Path) -> list[str]:
    """All in which two packages of one source differ, but for what was measured: its files, and
    their digests in the checksums and in the attestation."""
    if read_manifest(one)[STAMP] != read_manifest(other)[STAMP]:
        return [f"{other}: is of another source than {one}"]
    apart = (*measured.FILES, ATTESTATION, SUMS)
    found = [*differences(digests(one, apart), digests(other, apart), str(one))]
    sums = [
        {**read_sums(folder / SUMS), **dict.fromkeys((*measured.FILES, ATTESTATION), "")}
        for folder in (one, other)
    ]
    if sums[0] != sums[1] and not found:
        found.append(f"{SUMS}: states other digests than in {one}")
    if stated_in(one) != stated_in(other) and not found:
        found.append(f"{ATTESTATION}: states something else than in {one}")
    return found
