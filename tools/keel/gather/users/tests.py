# SPDX-License-Identifier: Apache-2.0
"""The part `tests` of a project: what its unit tests say."""

from __future__ import annotations

from keel.gather.part import Context, Item, Part
from keel.gather.users.labels import links_of


def make(context: Context) -> Part:
    """All tests."""
    problems: list[str] = []
    suites = context.report("test/report.json", problems).get("suites", {})
    items = tuple(
        Item(
            kind="test",
            id=f"unit/{suite}/{test}",
            title=why or test.replace("_", " "),
            state="bad" if why else "good",
            links=links_of(test),
        )
        for suite, ran in suites.items()
        for test, why in ran.items()
    )
    return Part(
        name="tests",
        title="Tests",
        items=items,
        problems=tuple(problems),
        summary={"tests": str(len(items))},
    )
