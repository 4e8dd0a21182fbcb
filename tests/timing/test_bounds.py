# SPDX-License-Identifier: Apache-2.0
"""The textbook tests, against examples with known answers."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

from keel.timing.analysis import Gaps, analyse, gaps_of
from keel.timing.phases import without_phases
from keel.timing.report import verdict
from keel.timing.scheduler_bounds import bounds_of, followed, path_bound
from keel.timing.taskset import Costs, Task, TaskSet, read
from keel.timing.textbook_tests import (
    conventional,
    fixed_priority,
    freshness,
    hyperbolic,
    hyperperiod,
    jeffay,
    liu_layland,
    reaction,
    response,
    utilisation,
)

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def urpilot() -> TaskSet:
    """The paper's table 2."""
    return read(ROOT / "specs/tasksets/urpilot.toml")


def tasks_of(*pairs: tuple[int, int]) -> list[Task]:
    """Tasks from (C, T)."""
    return [
        Task(f"t{i}", f"t{i}", "low", period, budget) for i, (budget, period) in enumerate(pairs)
    ]


def test_liu_layland_bound() -> None:
    """Liu and Layland 1973: 0.83 for two tasks, ln 2 for many; 0.7798 and 0.7047 by hand."""
    assert liu_layland(1) == 1.0
    assert round(liu_layland(2), 3) == 0.828
    assert round(liu_layland(3), 4) == 0.7798
    assert round(liu_layland(21), 4) == 0.7047
    assert round(liu_layland(10**6), 4) == 0.6931


def test_hyperbolic_bound_is_exact_for_two_tasks_at_its_edge() -> None:
    """Bini and Buttazzo 2003: U1 = 1/3 and U2 = 1/2 lie on the bound, above Liu and Layland's."""
    pair = tasks_of((1, 3), (1, 2))
    assert hyperbolic(pair) == pytest.approx(2.0)
    assert float(utilisation(pair)) > liu_layland(2)


def test_response_times_of_can_messages() -> None:
    """Davis, Burns, Bril and Lukkien 2007, "CAN schedulability analysis: refuted, revisited and
    revised", section 3: A, B, C of 1 ms each with periods 2.5, 3.5 and 3.5 ms. The original
    analysis finds 3 ms for C, but its second message of the busy period takes 3.5 ms."""
    messages = tasks_of((1000, 2500), (1000, 3500), (1000, 3500))
    assert fixed_priority(messages, 0) == [2000, 3000, 3500]


def test_a_single_task_responds_after_its_blocking() -> None:
    (task,) = tasks_of((10, 100))
    assert response(task, [], 35) == 45
    assert response(task, tasks_of((90, 100)), 0) is None


def test_jeffay_by_hand() -> None:
    """(C, T) = (1, 3), (2, 4), (2, 12): at L = 4 the demand is C of the longest, 2, and one run of
    the first, 1: slack 1. At L = 5: 2 + 1 + 2, slack 0. At L = 7: 2 + 2 + 2, slack 1; at 9:
    2 + 2 + 4, slack 1; at 10: 2 + 3 + 4, slack 1. Utilisation 1/3 + 1/2 + 1/6 is 1: it holds."""
    found = jeffay(tasks_of((1, 3), (2, 4), (2, 12)))
    assert (found.holds, found.slack, found.interval, found.blocker) == (True, 0, 5, "t2")


def test_jeffay_refuses_a_long_blocker_at_any_utilisation() -> None:
    """A task longer than another's period less its budget can always be in its way."""
    edge = jeffay(tasks_of((1, 4), (4, 10_000)))
    assert (edge.holds, edge.slack, edge.interval, edge.blocker) == (True, 0, 5, "t1")
    worse = jeffay(tasks_of((1, 4), (5, 10_000)))
    assert (worse.holds, worse.slack, worse.interval, worse.blocker) == (False, -1, 5, "t1")


def test_jeffay_gives_up_in_words_rather_than_for_ever() -> None:
    found = jeffay(tasks_of((1, 2), (2**30, 2**31 - 1)))
    assert not found.holds


def test_jeffay_of_table_2(urpilot: TaskSet) -> None:
    """By hand: at L = 1001 us GPS, 355, and one run of the background IMU, 57: 589 are left."""
    found = jeffay(urpilot.tasks)
    assert found.holds and (found.slack, found.interval, found.blocker) == (589, 1001, "GPS")


def test_realtime_response_times_of_table_2(urpilot: TaskSet) -> None:
    """By hand: 355 + 57, + 37, + 83 without a guard; 57 + 83, and 57 + 37 + 83 twice with one."""
    analysis = analyse(urpilot)
    assert [row.unguarded for row in analysis.realtime_rows] == [412, 449, 532]
    assert [row.guarded for row in analysis.realtime_rows] == [140, 177, 177]


def test_utilisation_of_table_2(urpilot: TaskSet) -> None:
    """The paper's review: 0.117 real-time, 0.108368 for the others, 22.54 % in all."""
    assert utilisation(urpilot.realtime) == Fraction(117, 1000)
    assert utilisation(urpilot.others) == Fraction(108368, 1_000_000)
    assert hyperperiod(urpilot.tasks) == 1_000_000


@pytest.mark.parametrize(
    ("labels", "limit"),
    [
        ("τ11 τ12 τ18", 3103),
        ("τ11 τ12 τ19 τ18", 5103),
        ("τ8 τ9 τ19 τ18", 14362),
        ("τ8 τ9 τ17 τ20 τ19 τ18", 44372),
        ("τ15 τ16 τ21 τ19 τ18", 33991),
    ],
)
def test_reaction_of_paths_of_table_2(urpilot: TaskSet, labels: str, limit: int) -> None:
    """Worked out by hand from eq. 5 and 6."""
    by_label = {task.label: task for task in urpilot.tasks}
    path = [by_label[label] for label in labels.split()]
    assert reaction(path) == limit
    assert any(
        [task.label for task in urpilot.path(chain)] == labels.split() for chain in urpilot.chains
    )


def test_eq_5_to_7_by_hand() -> None:
    slow, fast = tasks_of((3, 100), (2, 10))
    assert reaction([slow, fast]) == 10 + 3  # T^C < T^P: T^C + C^P.
    assert reaction([fast, slow]) == 10 + 2  # Otherwise T^P + C^P.
    assert freshness([slow, fast]) == 200  # 2 T^P.
    assert freshness([fast, slow]) == 10 + 3  # T^P + C^C.
    assert reaction([slow, fast, slow]) == 13 + (10 - 2 + 3)
    assert conventional([slow, fast], [7, 5]) == 122
    assert conventional([slow, fast], [7, None]) is None


def test_the_verdict_on_table_2(urpilot: TaskSet) -> None:
    analysis = analyse(urpilot)
    assert analysis.schedulable and analysis.promotion_excluded
    advice = [row.name for row in analysis.chains if not row.within]
    assert advice == ["Magnetometer, position", "Radio, state machine"]


COSTS = Costs(guard_us=3, pass_us=2, dispatch_us=1)  # A budget C is declared as C + 3.


def gap_set(*realtime: Task) -> TaskSet:
    """Real-time tasks, and others that need 11, 13 and 93 with the guard."""
    others = [Task(f"o{c}", f"o{c}", "low", 10_000, c) for c in (5, 7, 87)]
    return TaskSet("gaps", (*realtime, *others), (), COSTS)


def test_gaps_by_hand() -> None:
    """A (T = 40, declared 10) and B (T = 60, declared 20), in 120 us.

    Together at 0: 0 to 30, then 40 to 50, 60 to 80, 80 to 90: gaps of 10, 10, 0 and 30. With B 25
    later: 0 to 10, 25 to 45 (A due at 40) to 55, 80 to 90 (B due at 85) to 110: gaps of 15, 25 and
    10. min T less all budgets would be 10 and 10.
    """
    first, second = Task("A", "A", "real-time", 40, 7), Task("B", "B", "real-time", 60, 17)
    together, apart = gap_set(first, second), gap_set(first, replace(second, phase=25))
    assert gaps_of(together) == Gaps(10, 30, 30)
    assert gaps_of(apart) == Gaps(10, 25, 30)
    assert [row.fits for row in analyse(together).other_rows] == ["some", "some", "none"]


def test_phases_keep_gaps_apart() -> None:
    """Declared 10 of 40 each, at 0 and 20: two gaps of 10, though the two budgets leave 20."""
    pair = [Task(f"t{phase}", f"t{phase}", "real-time", 40, 7, phase) for phase in (0, 20)]
    assert gaps_of(gap_set(*pair)) == Gaps(10, 10, 30)
    wide = [Task("w", "w", "real-time", 40, 7)]
    assert [row.fits for row in analyse(gap_set(*wide)).other_rows] == ["every", "every", "none"]


def test_a_gap_is_never_claimed_without_a_look_at_the_releases() -> None:
    """Periods without a common divisor have their releases arbitrarily close together."""
    odd = gap_set(Task("A", "A", "real-time", 997, 7), Task("B", "B", "real-time", 1009, 7))
    assert gaps_of(odd) == Gaps(None, None, 987)
    assert {row.fits for row in analyse(odd).other_rows} == {"not known"}
    assert {row.fits for row in analyse(gap_set()).other_rows} == {"always"}
    full = gap_set(Task("A", "A", "real-time", 40, 37))
    assert gaps_of(full) == Gaps(0, 0, 0)


def test_paths_that_are_not_safe_are_told(urpilot: TaskSet) -> None:
    """Without phases: the magnetometer's periods alone, 10 + 20 + 2 + 2 ms, exceed its 25 ms; eq. 5
    and 6 do not see that. Rate control has 5 ms of periods, and no bound is above its 10 ms."""
    analysis = analyse(without_phases(urpilot))
    report = analysis.report()
    chains = {row["name"]: row for row in report["chains"]}
    assert (chains["IMU, rate"]["within"], chains["IMU, rate"]["safe_within"]) == (True, True)
    assert (chains["Magnetometer"]["within"], chains["Magnetometer"]["safe_within"]) == (
        True,
        False,
    )
    assert not chains["Radio, state machine"]["within"]
    assert any(line.startswith("path Magnetometer may take longer") for line in report["advice"])
    assert not any("IMU" in line for line in report["advice"])
    assert verdict(analysis) == (
        "urpilot: schedulable: every task meets its deadline; 4 judged paths keep their limits by "
        "eq. 5 to 7, which are no bounds; by a safe bound 2 do NOT: Magnetometer; Radio."
    )
    bare = replace(urpilot, chains=())
    assert verdict(analyse(bare)).endswith("meets its deadline; no path is judged.")


def test_the_paths_that_ship_are_safe(urpilot: TaskSet) -> None:
    """By hand, an event just after the magnetometer's run released at 10418: the next is released
    at 20418, τ9 reads it at 21081, τ19 at 22249, and τ18 at 24142 and takes 95 and a tick: 13820.
    After that of 418: the next, 10418, is read at 21081 alike: 10 ms more. Radio: 792; 10792,
    21521, 22249, 24142 + 96."""
    analysis = analyse(urpilot)
    rows = {row.name: row for row in analysis.chains}
    assert rows["Magnetometer"].followed == rows["Magnetometer"].safe == 23_820
    assert rows["Radio"].safe == 24_142 + 96 - 792
    assert rows["IMU, rate"].safe == 2142 + 96 - 0  # Missed at 0; at 1000, 2081, 2142.
    assert all(row.safe_within for row in analysis.chains if not row.advisory)
    assert verdict(analysis).endswith("keep their limits, by eq. 5 to 7 and by a safe bound.")


def test_what_has_too_many_samples_to_follow_keeps_the_sum(urpilot: TaskSet) -> None:
    path = tasks_of((1, 997), (1, 1009))
    assert followed(path, 5) is None
    path = tasks_of((1, 10), (1, 20))
    # Missed at 40, released next at 50, read at 60, done by 65; missed at 50: 60, then 80, 85.
    assert followed(path, 5) == 35
    pair = tuple(Task(name, name, "real-time", 100, 90) for name in "AB")
    late = TaskSet("late", pair)
    chain = urpilot.chains[0].model_copy(update={"path": ["A", "B"]})
    assert path_bound(late, chain, bounds_of(late)).least is None
