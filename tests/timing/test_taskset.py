# SPDX-License-Identifier: Apache-2.0
"""Tests of the task-set files: what is read, and how each error is told."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from fuzz_taskset import fuzz

from keel.base.errors import ToolError
from keel.base.toml_lines import line_index
from keel.config import ConfigError
from keel.timing.taskset import parse, read

ROOT = Path(__file__).resolve().parents[2]
URPILOT = ROOT / "specs/tasksets/urpilot.toml"

SMALL = """name = "small"

[scheduler]
guard_us = 10

[[task]]
name = "Gyro"
class = "real-time"
period_us = 1000
budget_us = 50

[[task]]
name = "Telemetry"
priority = 1
period_us = 20_000
budget_us = 300
phase_us = 5

[[chain]]
name = "Gyro, ground"
path = ["Gyro", "Telemetry"]
reaction_limit_us = 30000
freshness_limit_us = 30000
"""


ONE_CLASS = "expected one of class, priority (1 to 4) and realtime = true"


def problems(old: str, new: str) -> list[str]:
    """What is said of the small set with one piece of text replaced."""
    assert SMALL.count(old) >= 1
    with pytest.raises(ConfigError) as caught:
        parse(SMALL.replace(old, new, 1), "s.toml")
    return str(caught.value).splitlines()


def test_a_small_set_is_read() -> None:
    tasks = parse(SMALL)
    assert [task.name for task in tasks.realtime] == ["Gyro"]
    telemetry = tasks.others[0]
    assert (telemetry.class_name, telemetry.priority) == ("low", 1)
    assert (telemetry.period, telemetry.budget, telemetry.phase) == (20000, 300, 5)
    assert (tasks.costs.guard_us, tasks.costs.pass_us) == (10, 5)
    assert tasks.path(tasks.chains[0]) == list(tasks.tasks)


def test_realtime_can_be_said_without_a_class() -> None:
    tasks = parse(SMALL.replace('class = "real-time"', "realtime = true"))
    assert tasks.tasks[0].realtime and tasks.tasks[0].priority == 16


def test_the_shipped_set_is_table_2() -> None:
    """Sums of the columns of the paper's table 2."""
    tasks = read(URPILOT)
    assert len(tasks.tasks) == 21
    assert [task.label for task in tasks.realtime] == ["τ11", "τ12", "τ18"]
    assert sum(task.budget for task in tasks.tasks) == 1356
    assert sum(task.period for task in tasks.tasks) == 1_587_000
    assert round(sum(task.sigma or 0.0 for task in tasks.tasks), 2) == 49.43


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (
            "budget_us = 50",
            "budget = 50",
            "s.toml:10: task Gyro: budget: unknown key; did you mean budget_us?",
        ),
        (
            "[[task]]",
            "[[task]]\nperiod_ms = 1",
            "s.toml:7: task Gyro: period_ms: unknown key; did you mean period_us?",
        ),
        ("[[chain]]", "[chains]", "s.toml:19: chains: unknown key; did you mean chain?"),
        (
            "guard_us = 10",
            "gaurd_us = 10",
            "s.toml:4: scheduler: gaurd_us: unknown key; did you mean guard_us?",
        ),
        (
            "guard_us = 10",
            "guard_us = true",
            "s.toml:4: scheduler: guard_us: expected to be a valid integer, found True",
        ),
        (
            "period_us = 1000",
            "period_us = 1000.0",
            "s.toml:9: task Gyro: period_us: expected to be a valid integer, found 1000.0",
        ),
        (
            "period_us = 1000",
            "period_us = 0",
            "s.toml:9: task Gyro: period_us: expected to be greater than or equal to 1, found 0",
        ),
        (
            "period_us = 1000",
            "period_us = 2147483648",
            "s.toml:9: task Gyro: period_us: expected to be less than 2147483648, found 2147483648",
        ),
        (
            "budget_us = 50",
            "budget_us = 1001",
            "s.toml:10: task Gyro: budget_us: expected at most the period, 1000",
        ),
        (
            "phase_us = 5",
            "phase_us = 20_000",
            "s.toml:17: task Telemetry: phase_us: expected less than the period, 20000",
        ),
        ("priority = 1", 'priority = 1\nclass = "low"', f"s.toml:12: task Telemetry: {ONE_CLASS}"),
        ("priority = 1\n", "", f"s.toml:12: task Telemetry: {ONE_CLASS}"),
        (
            'path = ["Gyro",',
            'path = ["Giro",',
            's.toml:21: chain Gyro, ground: path: expected names of tasks; there is no "Giro"',
        ),
        (
            'path = ["Gyro",',
            'path = ["Telemetry",',
            "s.toml:21: chain Gyro, ground: path: expected each task at most once",
        ),
        (
            'name = "Telemetry"',
            'name = "gyro"',
            's.toml:13: task gyro: name: expected another than that of "Gyro" (as a C identifier)',
        ),
        ('name = "Gyro"\n', "", "s.toml:6: task number 1: name: is missing"),
        ('name = "small"', "name = small", "s.toml:1: no TOML: Invalid value"),
    ],
)
def test_an_error_names_file_line_field_and_what_was_expected(
    old: str, new: str, told: str
) -> None:
    assert told in problems(old, new)


def test_no_name_is_given_twice_however_short() -> None:
    """CPython shares strings of one character: two such names are one object."""
    for name, again in (("A", "A"), ("A", "a"), ("Gyro", "Gyro")):
        text = SMALL.replace('"Gyro"', f'"{name}"').replace('"Telemetry"', f'"{again}"')
        with pytest.raises(ConfigError) as caught:
            parse(text, "s.toml")
        expected = f'expected another than that of "{name}" (as a C identifier)'
        assert f"s.toml:13: task {again}: name: {expected}" in str(caught.value)
    text = SMALL.replace('class = "real-time"', 'class = "real-time"\nlabel = "a"')
    with pytest.raises(ConfigError, match='label: expected another than that of "Gyro"'):
        parse(text.replace("priority = 1", 'priority = 1\nlabel = "a"'))


def test_every_problem_is_told_in_the_order_of_lines() -> None:
    lines = problems("period_us = 1000\nbudget_us = 50", "period_us = 0\nbudget_us = -1")
    assert [line.split(":")[1] for line in lines] == ["9", "10"]


def in_task(line: str) -> str:
    """A text whose task has this line."""
    return f'[[task]]\nname = "A"\n{line}\n'


@pytest.mark.parametrize(
    "text",
    [
        "a = " + "[" * 5000,
        "a = " + "9" * 5000,
        "\0",
        "",
        "[",
        in_task("period_us = 0x" + "f" * 4000),
        in_task("period_us" + ".a" * 4000 + " = 1"),
        in_task("period_us = " + "[" * 150 + "]" * 150),
        in_task('"a' + "b" * 4000 + '" = 1'),
    ],
)
def test_hostile_texts_are_refused_in_words(text: str) -> None:
    with pytest.raises(ConfigError) as caught:
        parse(text)
    assert str(caught.value).startswith("task set")
    assert all(len(line) < 400 for line in str(caught.value).splitlines())


def test_a_key_of_many_parts_costs_no_memory_for_each_of_them() -> None:
    """Kept with all that it lies in, a key of n parts would take n^2 / 2."""
    assert len(line_index("a" + ".b" * 4000 + " = 1")) < 100


def test_files_that_cannot_be_read_are_refused_in_words(tmp_path: Path) -> None:
    bad = tmp_path / "latin1.toml"
    bad.write_bytes(b'name = "x"\n# \xfc\n')
    for path, told in (
        (tmp_path / "none.toml", "none.toml: cannot be read"),
        (bad, "latin1.toml:2: expected UTF-8"),
    ):
        with pytest.raises(ToolError) as caught:
            read(path)
        assert told in str(caught.value)


def test_lines_are_found_through_strings_and_brackets() -> None:
    text = '# c\na = """\n[x]\nb = 1\n"""\n[t]  # c\n"k y".z = [\n "]", # ]\n 2]\n[[u]]\nv={w=1}\n'
    assert line_index(text + "[[u]]\nv = '#'\n") == {
        ("a",): 2,
        ("t",): 6,
        ("t", "k y"): 7,
        ("t", "k y", "z"): 7,
        ("u",): 10,
        ("u", 0): 10,
        ("u", 0, "v"): 11,
        ("u", 1): 12,
        ("u", 1, "v"): 13,
    }


def test_fuzzed_files_never_end_in_a_traceback() -> None:
    """KEEL_FUZZ_FILES sets how many; `make check NAME=fuzztasks` tries 100 000."""
    files = int(os.environ.get("KEEL_FUZZ_FILES", "2000"))
    tally = fuzz(files, lambda tasks: None)
    assert tally.accepted > files / 10 and tally.refused > files / 10
