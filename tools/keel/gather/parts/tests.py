# SPDX-License-Identifier: Apache-2.0
"""What was tested, on the host and on the emulated Cortex-M7, and how much of the code was reached:
from the reports of make test, test-target, coverage, coverage-target and contracts-run.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from keel.gather.part import Context, Item, Part, Table

HOST, TARGET = "on the host", "on the emulated Cortex-M7"
RUNS = {HOST: "test", TARGET: "test-target"}  # The folder of each run's reports below build/.
LABEL = re.compile(r"([A-Z]{3,4})_(\d{3})(?!\d)")
CONDITIONALS = {"branch": "branches", "IT block": "in IT blocks", "selection": "selections"}
METRICS = {"lines": "statements", "branches": "branches", "mcdc": "MC/DC"}

Report = Mapping[str, Any]
Verdicts = dict[tuple[str, str], dict[str, str]]  # By suite and test: verdict by run.

TEXT = """\
Unit tests compare with values that were worked out by hand; property tests with a reference \
model; reference tests with double precision. The unit tests run twice: on the host, with the \
sanitizers for addresses and undefined behaviour, and, built as firmware is, on a Cortex-M7 that \
QEMU emulates.

Structural coverage is that of the unit tests alone, by LLVM's source-based instrumentation: a \
statement counts by its line, a branch by each condition and each of its two outcomes, and MC/DC \
by each condition of a decision with more than one: two evaluations that differ in it, and in \
what C then does not evaluate, give the decision different values.

Coverage of the object code is that of the same tests, built as firmware is and run on the \
emulated Cortex-M7 one instruction at a time. Counted are the conditional instructions of src/ \
with the inlined functions of include/: branches (b<condition>, cbz, cbnz), instructions of IT \
blocks, and selections (vsel). Each has two outcomes, its condition true and false, evaluated on \
the registers and flags that the processor had.

Some contracts also run: Frama-C's E-ACSL turns their clauses into code, through which the unit \
tests of the file call. This asks whether a clause, proved or not, holds in what the tests do. \
E-ACSL supports part of ACSL only; what it leaves out is listed. Pointers are compared with null \
alone.

The emulator executes instructions; it models neither the processor's pipeline and caches nor the \
board's peripherals. No test of this package ran on hardware."""


# --- Tests ---------------------------------------------------------------------------------------


def read_run(context: Context, run: str, problems: list[str]) -> Report:
    """A run's report; whatever keeps it from being evidence is a problem."""
    folder = RUNS[run]
    report = context.report(f"{folder}/report.json", problems)
    if report.get("filter"):
        problems.append(
            f"build/{folder}/report.json: only the suites with "
            f"{report['filter']!r} in their names ran"
        )
    if left := report.get("left_out"):
        problems.append(
            f"build/{folder}/report.json: {len(left)} suites did not run: make test-all"
        )
    if report.get("sanitizers") is False:
        problems.append(f"build/{folder}/report.json: the sanitizers' libraries were missing")
    return report


def read_junit(context: Context, run: str, problems: list[str]) -> dict[tuple[str, str], str]:
    """What each test of a run says: empty if it passed, else why not."""
    shown = f"build/{RUNS[run]}/junit.xml"
    try:
        tree = ElementTree.parse(context.build / RUNS[run] / "junit.xml")
    except (OSError, ElementTree.ParseError) as error:
        problems.append(f"{shown}: is not whole: {error}")
        return {}
    found = {}
    for case in tree.iter("testcase"):
        failure = case.find("failure")
        said = "" if failure is None else failure.get("message", "") or "failed"
        found[case.get("classname", ""), case.get("name", "")] = said
    return found


def check_run(context: Context, run: str, report: Report, problems: list[str]) -> None:
    """Every test that failed is a problem, and the two reports of a run must say the same."""
    if not report:
        return
    told = read_junit(context, run, problems)
    verdicts = {
        (suite, test): verdict
        for suite, outcome in report["suites"].items()
        for test, verdict in outcome["tests"].items()
    }
    for (suite, test), verdict in verdicts.items():
        if verdict != "passed":
            reason = told.get((suite, test), "")
            problems.append(f"{suite}/{test} {verdict} {run}: {reason}")
    if told and {key: not said for key, said in told.items()} != {
        key: verdict == "passed" for key, verdict in verdicts.items()
    }:
        problems.append(f"build/{RUNS[run]}/junit.xml: has other tests than report.json")
    if not verdicts:
        problems.append(f"build/{RUNS[run]}/report.json: no test ran {run}")


def verdicts_of(reports: Mapping[str, Report]) -> Verdicts:
    """How each test ended where it ran."""
    found: Verdicts = {}
    for run, report in reports.items():
        for suite, outcome in report.get("suites", {}).items():
            for test, verdict in outcome["tests"].items():
                found.setdefault((suite, test), {})[run] = verdict
    return found


def requirements(root: Path) -> set[str]:
    """The ids of all requirements."""
    files = sorted((root / "specs/requirements").glob("*.sdoc"))
    texts = [path.read_text(encoding="utf-8") for path in files]
    return {uid for text in texts for uid in re.findall(r"^UID: (\S+)$", text, re.MULTILINE)}


def test_items(verdicts: Verdicts, known: set[str]) -> Iterator[Item]:
    """An item for each test; its name leads to the requirement that it checks."""
    for (suite, test), ends in sorted(verdicts.items()):
        match = LABEL.match(test)
        uid = f"{match[1]}-{match[2]}" if match else ""
        good = all(verdict == "passed" for verdict in ends.values())
        yield Item(
            kind="test",
            id=f"{suite}/{test}",
            title=test.replace("_", " "),
            facts=ends,
            state="good" if good else "bad",
            links=(f"requirement:{uid}",) if uid in known else (),
        )


def suite_table(reports: Mapping[str, Report]) -> Table:
    """A row for each suite and run."""
    rows = [
        (suite, run, str(outcome["passed"]), str(outcome["failed"]), str(len(outcome["skipped"])))
        for run, report in reports.items()
        for suite, outcome in report.get("suites", {}).items()
    ]
    skipped = [
        f"{suite}: {test} ({why})"
        for report in reports.values()
        for suite, outcome in report.get("suites", {}).items()
        for test, why in outcome["skipped"].items()
    ]
    note = f"Skipped, and so no evidence: {'; '.join(skipped)}." if skipped else ""
    columns = ("suite", "where", "passed", "failed", "skipped")
    return Table(title="Suites of tests", columns=columns, rows=tuple(rows), note=note)


# --- Structural coverage on the host -------------------------------------------------------------


def shown_share(count: tuple[int, int]) -> str:
    """Covered of total; a dash where there is nothing to cover."""
    return f"{count[0]} of {count[1]}" if count[1] else "–"


def coverage_rows(report: Report) -> Iterator[tuple[str, ...]]:
    """A row for each file, and one for each of its functions."""
    for file, item in report["files"].items():
        yield (file, "all", *(shown_share(item[metric]) for metric in METRICS))
        for name, own in item["functions"].items():
            shown = f"function:{name}" if name.startswith("keel_") else name
            yield (file, shown, *(shown_share(own[metric]) for metric in METRICS))


def coverage_tables(report: Report) -> list[Table]:
    """The figures, and the gaps with their reasons."""
    if not report:
        return []
    columns = ("file", "function", *METRICS.values())
    figures = Table(
        title="Structural coverage by the unit tests, on the host",
        columns=columns,
        rows=tuple(coverage_rows(report)),
    )
    gaps = tuple(
        (f"{gap['file']}:{gap['line']}", gap["text"], gap["what"], gap["reason"])
        for gap in report["excluded"]
    )
    note = "" if gaps else "There is no gap."
    titles = ("place", "source", "gap", "reason")
    return [
        figures,
        Table(
            title="Gaps of structural coverage, with their reasons",
            columns=titles,
            rows=gaps,
            note=note,
        ),
    ]


def check_coverage(report: Report, problems: list[str]) -> None:
    """A gap without a reason is a problem, and a reason without a gap."""
    for gap in report.get("gaps", []):
        place = f"{gap['file']}:{gap['line']}"
        problems.append(f"{place}: {gap['what']}, and no reason is given: {gap['text']}")
    for item in report.get("unused_exclusions", []):
        problems.append(
            f"specs/coverage_exclusions.toml: excludes nothing: {item['file']}: {item['line']}"
        )


# --- Coverage of the object code -----------------------------------------------------------------


def object_rows(report: Report) -> Iterator[tuple[str, ...]]:
    """A row for each file, and one for each of its functions."""
    for file, item in report["files"].items():
        own = {"all": item, **item["functions"]}
        for name, counts in own.items():
            shown = f"function:{name}" if name.startswith("keel_") and "." not in name else name
            kinds = tuple(str(counts.get(kind, 0)) for kind in CONDITIONALS)
            yield (file, shown, *kinds, shown_share((counts["seen"], counts["outcomes"])))


def object_tables(report: Report) -> list[Table]:
    """The figures, and the outcomes that no test can show."""
    if not report:
        return []
    columns = ("file", "function", *CONDITIONALS.values(), "outcomes seen")
    untraced = ", ".join(f"unit/{name}" for name in report["untraced"])
    note = f"Of the unit tests this one did not run here, for it is too long: {untraced}."
    figures = Table(
        title="Conditional instructions of the object code, on the emulated Cortex-M7",
        columns=columns,
        rows=tuple(object_rows(report)),
        note=note,
    )
    gaps = tuple(
        (
            f"{gap['file']}:{gap['line']}",
            gap["text"],
            f"{gap['function']}+0x{gap['offset']:x} {gap['instruction']}",
            gap["never"],
            gap["reason"],
        )
        for gap in report["explained"]
    )
    titles = ("place", "source", "instruction", "never", "reason")
    return [
        figures,
        Table(
            title="Outcomes that no test can show, with their reasons", columns=titles, rows=gaps
        ),
    ]


def check_object(report: Report, problems: list[str]) -> None:
    """An outcome that was not seen and has no reason is a problem, and a reason that fits none."""
    for gap in report.get("gaps", []):
        problems.append(
            f"{gap['file']}:{gap['line']}: {gap['function']}+0x{gap['offset']:x} "
            f"{gap['instruction']}: never {gap['never']}, and no reason is given: {gap['text']}"
        )
    for item in report.get("stale_reasons", []):
        problems.append(
            f"specs/object_coverage.toml: fits another number of gaps than "
            f"{item['instructions']}: {item['function']}: never {item['never']}: "
            f"{item['line']}"
        )


# --- Contracts that run ---------------------------------------------------------------------------


def contract_tables(report: Report) -> list[Table]:
    """What ran, the clauses that did not, and the functions that did not."""
    if not report:
        return []
    rows = tuple(
        (f"function:{name}", unit, "no clause was violated" if not item["failures"] else "VIOLATED")
        for unit, item in report["units"].items()
        for name in item["functions"]
    )
    ignored = tuple(
        (
            f"function:{clause['function']}",
            f"{clause['file']}:{clause['line']}",
            clause["construct"],
        )
        for item in report["units"].values()
        for clause in item["ignored"]
    )
    absent = tuple((", ".join(item["functions"]), item["reason"]) for item in report["left_out"])
    return [
        Table(
            title="Contracts that ran with the unit tests",
            rows=rows,
            columns=("function", "file", "outcome"),
        ),
        Table(
            title="Clauses of these that E-ACSL leaves out",
            rows=ignored,
            columns=("function", "place", "construct that it does not support"),
        ),
        Table(title="Contracts that did not run", columns=("functions", "reason"), rows=absent),
    ]


def check_contracts(report: Report, problems: list[str]) -> None:
    """A clause that was violated is a problem."""
    for item in report.get("units", {}).values():
        problems.extend(f"contracts-run: {failure}" for failure in item["failures"])


# --- All of it -----------------------------------------------------------------------------------


def summary_of(
    reports: Mapping[str, Report], coverage: Report, code: Report, contracts: Report
) -> dict[str, str]:
    """The figures that a reader wants first."""
    found = {
        f"Tests {run}": f"{report['passed']} passed, {report['failed']} failed"
        for run, report in reports.items()
        if report
    }
    for metric, title in METRICS.items():
        if coverage:
            covered, total = coverage["total"][metric]
            found[f"{title[0].upper()}{title[1:]} covered"] = f"{covered} of {total}"
    if code:
        total = code["total"]
        found["Outcomes of conditional instructions seen"] = (
            f"{total['seen']} of {total['outcomes']}; {len(code['explained'])} cannot be"
        )
    if contracts:
        ran = sum(len(item["functions"]) for item in contracts["units"].values())
        absent = sum(len(item["functions"]) for item in contracts["left_out"])
        found["Contracts that ran with the unit tests"] = f"{ran}; {absent} did not"
    return found


def files_of(context: Context) -> dict[str, Path]:
    """The reports."""
    names = {
        f"{folder}-{file}": f"{folder}/{file}"
        for folder in RUNS.values()
        for file in ("report.json", "junit.xml")
    }
    names |= {
        f"{folder}-report.json": f"{folder}/report.json"
        for folder in ("coverage", "coverage-target", "contracts-run")
    }
    return {
        shown: context.build / name
        for shown, name in names.items()
        if (context.build / name).is_file()
    }


def make(context: Context) -> Part:
    """The part."""
    problems: list[str] = []
    reports = {run: read_run(context, run, problems) for run in RUNS}
    for run, report in reports.items():
        check_run(context, run, report, problems)
    coverage = context.report("coverage/report.json", problems)
    check_coverage(coverage, problems)
    code = context.report("coverage-target/report.json", problems)
    check_object(code, problems)
    contracts = context.report("contracts-run/report.json", problems)
    check_contracts(contracts, problems)
    return Part(
        name="tests",
        title="Tests and coverage",
        text=TEXT,
        summary=summary_of(reports, coverage, code, contracts),
        tables=(
            suite_table(reports),
            *coverage_tables(coverage),
            *object_tables(code),
            *contract_tables(contracts),
        ),
        items=tuple(test_items(verdicts_of(reports), requirements(context.root))),
        files=files_of(context),
        problems=tuple(problems),
    )
