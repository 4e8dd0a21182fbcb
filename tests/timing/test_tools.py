# SPDX-License-Identifier: Apache-2.0
"""The analyser as a whole: command line, C table, synthesis, phases, kernel's limits, fuzzing."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest
from fuzz_taskset import fuzz

from keel.config import ConfigError
from keel.install import Toolchain
from keel.timing import ctable, taskset
from keel.timing.analysis import NOT_SHOWN, analyse
from keel.timing.board import for_capacity
from keel.timing.command import main
from keel.timing.phases import spread, without_phases
from keel.timing.report import plot_responses, plot_utilisation, verdict
from keel.timing.scheduler_bounds import collisions, declared, needs, promotion_wait
from keel.timing.synthesis import LADDER, SynthesisError, keeps_limits, synthesize, with_periods
from keel.timing.taskset import Costs, Task, TaskSet, parse, read
from keel.timing.textbook_tests import hyperperiod

ROOT = Path(__file__).resolve().parents[2]
URPILOT = ROOT / "specs/tasksets/urpilot.toml"


@pytest.fixture(autouse=True)
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Reports go to a folder of the test's own."""
    monkeypatch.setattr("keel.timing.command.ROOT", tmp_path)


@pytest.fixture(scope="module")
def urpilot() -> TaskSet:
    """The paper's table 2."""
    return read(URPILOT)


def changed(tmp_path: Path, old: str, new: str) -> Path:
    """A copy of the shipped set with one change."""
    text = URPILOT.read_text(encoding="utf-8")
    assert old in text
    path = tmp_path / "changed.toml"
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    return path


# --- Limits shared with the kernel ---------------------------------------------------------------


def defined(header: str, name: str) -> int:
    """The number that a header defines."""
    text = (ROOT / "include/keel/rtos" / header).read_text(encoding="utf-8")
    match = re.search(rf"#define +{name} +(0x[0-9A-F]+|\d+)u", text)
    assert match is not None
    return int(match[1], 0)


def test_limits_are_the_kernels() -> None:
    assert defined("priority.h", "KEEL_PERIOD_LIMIT_US") == taskset.PERIOD_LIMIT_US
    assert defined("queue.h", "KEEL_QUEUE_CAPACITY") == taskset.QUEUE_CAPACITY
    header = (ROOT / "include/keel/rtos/queue.h").read_text(encoding="utf-8")
    assert f"#if KEEL_QUEUE_CAPACITY > {taskset.CAPACITY_LIMIT}u" in header
    assert defined("priority.h", "KEEL_PRIORITY_REALTIME") == taskset.PRIORITY_MAX
    for name, symbol in ctable.PRIORITIES.items():
        assert defined("priority.h", symbol) == taskset.CLASSES[name]


def test_promotion_wait_by_hand() -> None:
    """priority.h: low after 15 periods of age, high after 3.75; a release is at age 1."""
    assert promotion_wait(Task("a", "a", "low", 20_000, 1)) == 280_000
    assert promotion_wait(Task("a", "a", "high", 2_000, 1)) == 5_500
    assert promotion_wait(Task("a", "a", "high", 3, 1)) == 12 - 3  # 11.25, rounded up.


# --- Verdicts ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new", "status", "told"),
    [
        ("budget_us = 355", "budget_us = 355", 0, "urpilot: schedulable"),
        (
            "budget_us = 355",
            "budget_us = 930",
            1,
            "not admitted: the kernel refuses it: GPS needs 962 us with the guard, and "
            "Background IMU leaves 931 us",
        ),
        (
            "budget_us = 83",
            "budget_us = 900",
            1,
            "not admitted: the kernel refuses it: real-time budgets and twice the guard",
        ),
        (
            "reaction_limit_us = 10000",
            "reaction_limit_us = 3102",
            1,
            "not shown to be schedulable: path IMU, rate: E = 3103 us of 3102 us",
        ),
        (
            "budget_us = 71",
            "budget_us = 700",
            1,
            "urpilot: not shown to be schedulable: Background magnetometer has no bound within its "
            "period of 10000 us: it would be ",
        ),
        (
            "period_us = 2000\nbudget_us = 71\nphase_us = 249",
            "period_us = 80\nbudget_us = 72",
            1,
            "NOT schedulable: utilisation is 108.99 %, above 100 % (eq. 11)",
        ),
        ("budget_us = 355", "budget_us = 0", 2, ""),
    ],
)
def test_exit_status_and_first_reason(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], old: str, new: str, status: int, told: str
) -> None:
    path = changed(tmp_path, old, new)
    assert main(["analyze", str(path)]) == status
    output = capsys.readouterr()
    if status == 2:
        line = path.read_text(encoding="utf-8").split("budget_us = 0\n")[0].count("\n") + 1
        assert output.err.startswith(f"{path}:{line}: task GPS: budget_us")
    else:
        assert told in output.out.splitlines()[-1]


def test_a_bound_that_fails_is_told_with_its_numbers() -> None:
    """By hand: the other task takes 12, a pass 2 and a dispatch 1; before it, a pass and a tick;
    a run of the real-time task, 7 and 2 and 1 and a tick; and 3 + 15 us before its release, in
    which the other does not fit, with the pass at the release."""
    costs = Costs(guard_us=3, pass_us=2, dispatch_us=1)
    pair = Task("rt", "rt", "real-time", 40, 7), Task("o", "o", "low", 40, 12)
    analysis = analyse(TaskSet("pair", pair, (), costs))
    assert (analysis.standing, analysis.schedulable) == (NOT_SHOWN, False)
    assert verdict(analysis) == (
        "pair: not shown to be schedulable: o has no bound within its period of 40 us: it would be "
        "49 us or more, 15 its own, 3 for what began before it, 11 for real-time tasks, 0 for "
        "tasks that may come first, 20 for gaps that are too short for it (1 more)"
    )


def many(count: int, capacity: str = "") -> str:
    """A set of that many tasks, which take 5 us every 20 ms each."""
    task = '[[task]]\nname = "t{0}"\nclass = "low"\nperiod_us = 20000\nbudget_us = 5\n'
    return f'name = "many"\n[scheduler]\n{capacity}\n' + "".join(map(task.format, range(count)))


def test_the_queue_holds_what_the_set_says() -> None:
    assert len(parse(many(32)).tasks) == 32
    with pytest.raises(ConfigError, match=r"task t32: name: expected at most 32 tasks"):
        parse(many(33))
    found = parse(many(40, "capacity = 40"))
    assert analyse(found).schedulable
    assert for_capacity(found) == ["-DKEEL_QUEUE_CAPACITY=40u"]
    assert not for_capacity(parse(many(32)))
    assert len(parse(many(255, "capacity = 255")).tasks) == 255
    for text in (many(41, "capacity = 40"), many(1, "capacity = 0"), many(1, "capacity = 256")):
        with pytest.raises(ConfigError):
            parse(text)


def test_the_report_and_the_plots(urpilot: TaskSet, tmp_path: Path) -> None:
    analysis = analyse(urpilot)
    report = json.loads(json.dumps(analysis.report()))
    assert report["schedulable"] and report["jeffay"]["slack"] == 589
    plot_utilisation(analysis, tmp_path / "u.svg")
    plot_responses(analysis, tmp_path / "r.svg")
    first = (tmp_path / "r.svg").read_bytes()
    plot_responses(analysis, tmp_path / "r.svg")
    assert (tmp_path / "r.svg").read_bytes() == first and b"Angle rate control" in first
    assert b"real-time" in (tmp_path / "u.svg").read_bytes()


def use(tasks: TaskSet) -> None:
    """What a user does with a set."""
    verdict(analyse(tasks))
    ctable.table(tasks, "fuzzed.toml")


def test_whatever_is_accepted_can_be_analysed() -> None:
    """KEEL_FUZZ_FILES sets how many files are tried."""
    files = int(os.environ.get("KEEL_FUZZ_FILES", "1000"))
    assert fuzz(files, use, first=1_000_000).accepted > files / 10


# --- The C table ---------------------------------------------------------------------------------


def test_the_committed_table_is_not_stale(urpilot: TaskSet) -> None:
    files = ctable.table(urpilot, URPILOT.name)
    assert not ctable.stale(files, ROOT / "examples/urpilot")


def test_a_stale_table_fails_and_is_regenerated(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = ["table", str(URPILOT), str(tmp_path)]
    assert main(arguments) == 0
    assert main([*arguments, "--check"]) == 0
    source = tmp_path / "urpilot_tasks.c"
    source.write_text(source.read_text().replace("355u", "354u"))
    assert main([*arguments, "--check"]) == 1
    assert f"{source}:1: stale" in capsys.readouterr().err
    assert main(arguments) == 0
    assert main([*arguments, "--check"]) == 0


def test_the_compiled_table_is_the_task_set(urpilot: TaskSet, tmp_path: Path) -> None:
    """Read back from a program, with a phase and every class."""
    tasks = parse(
        URPILOT.read_text(encoding="utf-8")
        .replace("phase_us = 1142", "phase_us = 1234")
        .replace("100.0", "69.3")
    )
    ctable.write(ctable.table(tasks, "set.toml"), tmp_path)
    (tmp_path / "print.c").write_text(
        '#include "urpilot_tasks.h"\n#include <stdio.h>\n'
        "static uint32_t ticks(void *c)\n{\n    return (uint32_t)(c != NULL);\n}\n"
        "static void body(void *c)\n{\n    (void)c;\n}\n"
        "int main(void)\n{\n"
        "    int here = 0;\n"
        "    const keel_scheduler_config_t s = urpilot_scheduler_config(ticks, &here);\n"
        "    for (unsigned i = 0u; i < URPILOT_TASK_COUNT; i++) {\n"
        "        const urpilot_task_t *const t = &urpilot_task[i];\n"
        "        const keel_task_config_t c = urpilot_task_config(i, body, &here);\n"
        '        printf("%s|%u|%u|%u|%u|%u|", t->name, t->priority, t->period_us, t->wcet_us,\n'
        "               t->budget_us, t->phase_us);\n"
        '        printf("%s|%u|%u|%u|%u|%d\\n", c.name, c.priority, c.period_us, c.budget_us,\n'
        "               c.phase_us, (c.run == body) && (c.context == &here));\n    }\n"
        '    printf("%d %u %u %d\\n", (int)URPILOT_GPS, s.guard_us, s.utilisation_limit_ppm,\n'
        "           (s.read_clock == ticks) && (s.clock_context == &here));\n"
        "    return 0;\n}\n"
    )
    command = [*Toolchain().command("gcc"), "-std=c99", "-Wall", "-Wextra", "-Werror"]
    command += [f"-I{ROOT / 'include'}", f"-I{tmp_path}", "print.c", "urpilot_tasks.c"]
    subprocess.run([*command, "-o", "print"], cwd=tmp_path, check=True)
    lines = subprocess.run(
        [tmp_path / "print"], capture_output=True, text=True, check=True
    ).stdout.splitlines()
    assert lines[:-1] == [
        f"{task.name}|{task.priority}|{task.period}|{task.budget}|{task.budget + 12}|{task.phase}|"
        f"{task.name}|{task.priority}|{task.period}|{task.budget + 12}|{task.phase}|1"
        for task in tasks.tasks
    ]
    assert lines[-1] == "13 20 693000 1"


PROGRAMS = ("board_check/main.c", "urpilot/demo.c", "urpilot_on_target/main.c")


@pytest.mark.parametrize("program", PROGRAMS)
def test_what_was_analysed_is_what_runs(program: str) -> None:
    """No application sets anything of a declaration or of the scheduler's settings itself."""
    text = (ROOT / "examples" / program).read_text(encoding="utf-8")
    fields = "period_us|budget_us|phase_us|priority|guard_us|utilisation_limit_ppm"
    assert not re.findall(rf"(?:\.|->)(?:{fields}) = ", text)
    assert text.count("urpilot_task_config(") == text.count("urpilot_scheduler_config(") == 1


def test_names_that_the_table_takes_are_refused() -> None:
    """Each macro of the header has its name there, as would a task's enumerator."""
    taken = set(re.findall(r"\{upper\}_([A-Z_]+)", ctable.HEADER + ctable.SOURCE))
    assert taken == taskset.TABLE_NAMES
    text = URPILOT.read_text(encoding="utf-8")
    for name in ("Task count", "guard us", "Utilisation limit ppm", "Tasks-h"):
        with pytest.raises(ConfigError, match=f"task {name}: name: expected a name other than"):
            parse(text.replace('name = "GPS"', f'name = "{name}"'))
    for set_name, name in (("int8", "Max"), ("uint_fast16", "max"), ("size", "max")):
        changed_set = text.replace('name = "urpilot"', f'name = "{set_name}"')
        with pytest.raises(ConfigError, match="stdint.h"):
            parse(changed_set.replace('name = "GPS"', f'name = "{name}"'))
    for set_name in ("keel", "keel_priority"):
        with pytest.raises(ConfigError, match="name: expected a name that does not begin"):
            parse(text.replace('name = "urpilot"', f'name = "{set_name}"'))


# --- Synthesis and phases ------------------------------------------------------------------------


def test_synthesis_keeps_every_limit_and_no_period_could_be_longer(urpilot: TaskSet) -> None:
    found = synthesize(urpilot)
    assert found.analysis.schedulable and keeps_limits(found.after)
    total = sum(task.utilisation for task in found.after.tasks)
    assert total < sum(task.utilisation for task in urpilot.tasks)
    judged = {name for chain in found.after.chains if not chain.advisory for name in chain.path}
    for name in judged:
        rung = LADDER.index(found.after.named(name).period)
        assert not keeps_limits(with_periods(found.after, {name: LADDER[rung + 1]})), name


def test_synthesis_never_slows_a_task_beside_the_paths(urpilot: TaskSet) -> None:
    """One that is faster than every task of the paths keeps its period."""
    base = min(task.period for task in synthesize(urpilot).after.tasks)
    fast = Task("Fast", "fast", "low", base - 1, 1)
    found = synthesize(replace(urpilot, tasks=(*urpilot.tasks, fast)))
    assert found.after.named("Fast").period == base - 1
    judged = {name for chain in urpilot.chains if not chain.advisory for name in chain.path}
    for task in urpilot.tasks:
        assert task.name in judged or found.after.named(task.name).period <= task.period


def test_synthesis_says_when_there_is_nothing_to_find(urpilot: TaskSet) -> None:
    with pytest.raises(SynthesisError, match="no path"):
        synthesize(TaskSet("x", urpilot.tasks))
    text = URPILOT.read_text(encoding="utf-8")
    tight = parse(text.replace("reaction_limit_us = 10000", "reaction_limit_us = 100"))
    with pytest.raises(SynthesisError, match="even the shortest"):
        synthesize(tight)


def crowded_releases(tasks: TaskSet) -> set[frozenset[str]]:
    """The neighbours that collide, by looking at every release of two hyperperiods, not at the
    congruence that found the phases."""
    length = 2 * hyperperiod(tasks.tasks)
    releases = sorted(
        (release, task.label)
        for task in tasks.tasks
        for release in range(task.phase, length, task.period)
    )
    by_label = {task.label: task for task in tasks.tasks}
    return {
        frozenset((one, two))
        for (first, one), (second, two) in pairwise(releases)
        if second - first < needs(tasks, by_label[one], by_label[two])
    }


def test_the_shipped_phases_are_those_that_the_analyser_finds(urpilot: TaskSet) -> None:
    """So the comment in the file, which says so, holds for its periods, budgets and costs."""
    assert spread(without_phases(urpilot)) == (urpilot, [])


def test_the_shipped_phases_keep_every_pair_apart(urpilot: TaskSet) -> None:
    assert not crowded_releases(urpilot) and not collisions(urpilot)


REALTIME = {"τ11", "τ12", "τ18"}


def realtime_collisions(tasks: TaskSet) -> set[frozenset[str]]:
    """The real-time tasks that collide, if only these run: from their windows in 2000 us."""
    assert {task.label for task in tasks.realtime} == REALTIME
    used: dict[int, str] = {}
    found = set()
    for task in tasks.realtime:
        for release in range(task.phase, task.phase + 2000, task.period):
            for at in range(release, release + declared(tasks, task)):
                if used.setdefault(at % 2000, task.label) != task.label:
                    found.add(frozenset((task.label, used[at % 2000])))
    return found


def test_the_realtime_tasks_that_ship_do_not_collide(urpilot: TaskSet) -> None:
    """τ11 every 1000 us, τ12 and τ18 every 2000 us, are apart as they fly; all at once they are
    not, nor is any of them when it is moved into another's time."""
    assert not realtime_collisions(urpilot)
    assert {label for pair in realtime_collisions(without_phases(urpilot)) for label in pair} == (
        REALTIME
    )
    # τ11 takes 69 us, τ12 49 and τ18 95, the scheduler's time included.
    for label, phase, other in (("τ12", 1068, "τ11"), ("τ18", 129, "τ12"), ("τ18", 906, "τ11")):
        moved = tuple(
            replace(task, phase=phase) if task.label == label else task for task in urpilot.tasks
        )
        pairs = realtime_collisions(replace(urpilot, tasks=moved))
        assert pairs == {frozenset((label, other))}


def test_the_analyser_tells_of_collisions(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["analyze", str(URPILOT)]) == 0
    assert "no two tasks ever want the processor at the same time" in capsys.readouterr().out
    # Of τ12: the rest of the file stays as it is.
    assert main(["analyze", str(changed(tmp_path, "phase_us = 81\n", ""))]) == 0
    assert "of real-time tasks: τ11 and τ12." in capsys.readouterr().out
    report = json.loads((tmp_path / "build/timing/urpilot/analysis.json").read_text())
    assert ["τ11", "τ12"] in report["collisions"]


def test_no_room_for_phases_is_told() -> None:
    """Each needs 30, 6 for the scheduler and 6 for the pass after it: three are 126 of 100 us."""
    full = TaskSet("full", tuple(Task(f"t{i}", f"t{i}", "real-time", 100, 30) for i in range(3)))
    assert spread(full)[1] == ["t2"]


def test_the_program_ends_in_words_for_a_wrong_command_line() -> None:
    done = subprocess.run(
        [sys.executable, str(ROOT / "tools/keel"), "timing", "analyze"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2 and "are required: taskset" in done.stderr
