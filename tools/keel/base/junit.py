# SPDX-License-Identifier: Apache-2.0
"""Reports of tests as JUnit XML, which CI systems read."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree import ElementTree

from keel.base.files import write_bytes

FORBIDDEN = re.compile(r"[^\t\n\r\x20-\uD7FF\uE000-\uFFFD\U00010000-\U0010FFFF]")


@dataclass(frozen=True)
class JUnitSuite:
    """A suite: what each test that failed says, by its name; empty for one that passed."""

    tests: Mapping[str, str]
    seconds: float = 0.0
    properties: Mapping[str, str] = field(default_factory=dict)


def plain(text: str) -> str:
    """A text without the characters that XML has no way to write."""
    return FORBIDDEN.sub("?", text)


def suite_element(name: str, suite: JUnitSuite) -> ElementTree.Element:
    """One suite; a failure's first line is its message."""
    failed = sum(1 for text in suite.tests.values() if text)
    element = ElementTree.Element(
        "testsuite",
        {
            "name": name,
            "tests": str(len(suite.tests)),
            "failures": str(failed),
            "errors": "0",
            "skipped": "0",
            "time": f"{suite.seconds:.3f}",
        },
    )
    if suite.properties:
        group = ElementTree.SubElement(element, "properties")
        for key, value in suite.properties.items():
            ElementTree.SubElement(group, "property", {"name": key, "value": plain(value)})
    for test, text in suite.tests.items():
        case = ElementTree.SubElement(
            element, "testcase", {"classname": plain(name), "name": plain(test), "time": "0"}
        )
        if text:
            message = plain(text.splitlines()[0])
            ElementTree.SubElement(case, "failure", {"message": message}).text = plain(text)
    return element


def write_junit(path: Path, name: str, suites: Mapping[str, JUnitSuite]) -> None:
    """Write the report in one go."""
    elements = [suite_element(*item) for item in suites.items()]
    whole = ElementTree.Element(
        "testsuites",
        {
            "name": name,
            **{
                key: str(total(elements, key)) for key in ("tests", "failures", "errors", "skipped")
            },
            "time": f"{sum(suite.seconds for suite in suites.values()):.3f}",
        },
    )
    whole.extend(elements)
    ElementTree.indent(whole)
    write_bytes(path, ElementTree.tostring(whole, "utf-8", xml_declaration=True) + b"\n")


def total(elements: Iterable[ElementTree.Element], key: str) -> int:
    """The sum of a number of the suites."""
    return sum(int(element.get(key, "0")) for element in elements)
