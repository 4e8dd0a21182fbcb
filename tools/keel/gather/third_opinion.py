# SPDX-License-Identifier: Apache-2.0
"""Ask ESBMC, a third engine, about some of the harnesses, and of each about a wrong body.

    python3 tools/keel opinion             # specs/third_opinion.toml says which
    python3 tools/keel opinion --fresh     # believe no answer that is kept

Answers are kept under a digest of all that they depend on; build/opinion/report.json has them.

Exit status: 0 when ESBMC proves each harness and refutes each wrong body, 1 when not, 2 when it
could not be asked.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from keel.base.errors import ROOT, program
from keel.base.jobs import Runner, end_as_by_ctrl_c
from keel.base.source import write_report
from keel.base.verdict_cache import Cache, digest
from keel.gather.formal import bounds, esbmc, opinion
from keel.install import Toolchain, small_environment


def key_of(question: esbmc.Question, tool: str) -> str:
    """All that an answer depends on."""
    own = Path(esbmc.__file__).read_text("utf-8")
    return digest(
        {
            "opinion": tool,
            "own": own,
            "texts": esbmc.texts_of(question),
            "unwind": question.unwind,
            "defines": question.defines,
            "harness": question.harness.name,
        }
    )


def answer(question: esbmc.Question, asked: esbmc.Esbmc, cache: Cache, tool: str) -> dict[str, Any]:
    """ESBMC's answer, or the one that is kept; only agreement is kept."""
    key = key_of(question, tool)
    found = cache.get(key)
    if found is None:
        start = time.monotonic()
        found = {**asked.ask(question), "seconds": 0.0}
        found["seconds"] = round(time.monotonic() - start, 1)
        if opinion.good(found):
            cache.put(key, found)
    words = [f"unwound {question.unwind} times", *question.defines]
    wrong = question.wrong.name if question.wrong else ""
    return {**found, "bounds": " ".join(words), "wrong_body": wrong}


def ask_all(root: Path, tools: Toolchain, fresh: bool) -> dict[str, dict[str, Any]]:
    """The answers on all harnesses that the file names, by harness."""
    harnesses = bounds.read_all(root)
    questions = opinion.questions(opinion.read_opinions(root), harnesses)
    cache = Cache(tools.cache.folder / "opinions", fresh)
    tool = tools.versions("opinion")["esbmc"]
    answers: dict[str, dict[str, Any]] = {}
    with tempfile.TemporaryDirectory(prefix="keel-opinion-") as scratch:
        runner = Runner(small_environment({**tools.environment(), "TMPDIR": scratch}), root)
        try:
            headers = esbmc.headers_of(tools.command("gcc"), runner)
            asked = esbmc.Esbmc(tools.command("esbmc"), headers, runner, root, Path(scratch))
            for question in questions:
                one = answer(question, asked, cache, f"{tool.version} {tool.sha256}")
                name = f"{question.harness.unit.name}/{question.harness.name}"
                answers[name] = one
                wrong = f", wrong body {one['wrong']}" if one["wrong"] else ""
                print(f"{name:<56} {one['verdict']}{wrong}  {one['seconds']:.0f} s", flush=True)
        finally:
            runner.stop()
    return answers


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    end_as_by_ctrl_c()
    return program("opinion", lambda: run(arguments))


def run(arguments: Sequence[str] | None = None, root: Path = ROOT) -> int:
    """Ask, and report; the exit status."""
    parser = argparse.ArgumentParser(prog="third_opinion", description="Ask ESBMC.")
    parser.add_argument("--fresh", action="store_true", help="believe no answer that is kept")
    options = parser.parse_args(arguments)
    report = root / "build" / opinion.REPORT
    report.unlink(missing_ok=True)
    tools = Toolchain()
    tools.ensure("opinion")
    answers = ask_all(root, tools, options.fresh)
    tool = tools.versions("opinion")["esbmc"]
    agreed = sum(opinion.good(one) for one in answers.values())
    good = agreed == len(answers)
    write_report(
        report,
        {"esbmc": {"version": tool.version, "sha256": tool.sha256}, "harnesses": answers},
        root,
        good=good,
    )
    print(f"ESBMC agrees on {agreed} of {len(answers)} harnesses")
    return 0 if good else 1
