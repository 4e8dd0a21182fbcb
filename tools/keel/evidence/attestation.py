# SPDX-License-Identifier: Apache-2.0
"""The in-toto statement of a package: these files, by their digests, were made from this source.

Its form is in-toto's Statement, version 1, with SLSA's provenance, version 1, as predicate. It is
not signed: whoever vouches for a package signs it with a key of theirs (docs/evidence.md).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

STATEMENT = "https://in-toto.io/Statement/v1"
PREDICATE = "https://slsa.dev/provenance/v1"
BUILD = "urn:keel:evidence:1"


def source(stamp: Mapping[str, str]) -> dict[str, Any]:
    """The tree that the package was made from; its commit, where there is one."""
    commit = {"gitCommit": stamp["commit"]} if stamp["commit"] else {}
    return {"uri": "urn:keel:source", "digest": {**commit, "sha256": stamp["tree"]}}


def statement(
    digests: Mapping[str, str], stamp: Mapping[str, str], tools: Mapping[str, str]
) -> dict[str, Any]:
    """What is stated of the files with these digests; the tools are named with their versions."""
    return {
        "_type": STATEMENT,
        "subject": [
            {"name": name, "digest": {"sha256": digest}} for name, digest in sorted(digests.items())
        ],
        "predicateType": PREDICATE,
        "predicate": {
            "buildDefinition": {
                "buildType": BUILD,
                "externalParameters": {"command": "make evidence"},
                "internalParameters": {"made_from": dict(stamp), "tools": dict(tools)},
                "resolvedDependencies": [source(stamp)],
            },
            "runDetails": {"builder": {"id": BUILD}},
        },
    }


def subjects(read: Mapping[str, Any]) -> dict[str, str]:
    """The digests that a statement has, by the names of the files."""
    return {one["name"]: one["digest"]["sha256"] for one in read["subject"]}


def commit_stated(read: Mapping[str, Any]) -> Mapping[str, str]:
    """The source that a statement names."""
    made: Mapping[str, str] = read["predicate"]["buildDefinition"]["internalParameters"][
        "made_from"
    ]
    return made
