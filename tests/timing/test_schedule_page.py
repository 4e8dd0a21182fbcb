# SPDX-License-Identifier: Apache-2.0
"""The page of a schedule in a real browser, from the file system: what it draws is found, moved and
zoomed by mouse, wheel and keys, and told in words."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from logged import LOOP, SAMPLE, run, task, written

from keel.base.errors import ROOT
from keel.install.packages import provide

provide("schedule")
from browser import Browser

from keel.timeline import page, runs

FAULTS = (ROOT / "tests/tools/page_faults.js").read_text(encoding="utf-8")
SHOTS = ROOT / "build/test/schedule-page"


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """A browser for all tests."""
    found = Browser()
    yield found
    found.close()


@pytest.fixture
def shown(browser: Browser, tmp_path: Path) -> Browser:
    """The log made by hand, all of it in sight."""
    path = tmp_path / "hand.html"
    page.write(path, runs.read(written(tmp_path / "hand.ulg", SAMPLE)), "Schedule: <hand>")
    browser.events.clear()
    browser.window(1300, 700)
    browser.open(path.as_uri())
    return browser


def text(browser: Browser, name: str) -> str:
    """What an element says."""
    return str(browser.evaluate(f"document.getElementById('{name}').textContent"))


def search(browser: Browser, words: str) -> str:
    """Type into the field of the search; what it has found."""
    browser.evaluate(
        "(() => { const one = document.getElementById('search'); one.value = ''; one.focus(); })()"
    )
    browser.type(words)
    return text(browser, "found")


def mouse(browser: Browser, kind: str, x: float, y: float, **more: float) -> None:
    """An event of the mouse on the timeline."""
    top = browser.evaluate("document.getElementById('canvas').getBoundingClientRect().top")
    button = {} if kind in ("mouseMoved", "mouseWheel") else {"button": "left", "clickCount": 1}
    held = {"buttons": 1} if kind == "mouseMoved" else {}
    browser.send("Input.dispatchMouseEvent", type=kind, x=x, y=top + y, **button, **held, **more)


def place(browser: Browser, task_number: int, time_us: int) -> tuple[float, float]:
    """Where a time is in a task's row."""
    at = browser.evaluate(f"[x({time_us}), rowTop({task_number}) + rowHeight() / 2]")
    return float(at[0]), float(at[1])


def test_nothing_fails_and_nothing_comes_from_elsewhere(shown: Browser) -> None:
    events = shown.events
    assert not [one for one in events if one.get("method") == "Runtime.exceptionThrown"]
    asked = [
        one["params"]["request"]["url"]
        for one in events
        if one.get("method") == "Network.requestWillBeSent"
    ]
    assert len(asked) == 1 and asked[0].startswith("file:")
    assert shown.evaluate("document.title") == "Schedule: <hand>"
    assert text(shown, "view") == "0.001000 s to 0.012080 s"


@pytest.mark.parametrize(
    ("words", "found"),
    [
        ("", ""),
        ("rate", "4 runs"),
        ("TELE", "2 runs"),
        ("realtime", "4 runs"),
        ("gps", "no run"),
        ("promoted", "1 run"),
        ("missed", "1 run"),
        ("skipped", "1 run"),
        ("over", "2 runs"),
        ("late>80", "2 runs"),
        ("late>79", "3 runs"),
        ("longer>350", "1 run"),
        ("rate late>5", "2 runs"),
    ],
)
def test_the_search(shown: Browser, words: str, found: str) -> None:
    assert search(shown, words) == found


def test_what_is_found_is_shown_one_after_the_other(shown: Browser) -> None:
    shown.click("#in")
    search(shown, "rate")
    seen = []
    for _ in range(5):
        shown.press("Enter")
        seen.append(text(shown, "found"))
    assert seen == [f"{number} of 4 runs" for number in (3, 4, 1, 2, 3)]  # From what is in sight.
    shown.click("#next")
    assert text(shown, "found") == "4 of 4 runs"
    assert text(shown, "run").startswith("Rate <loop> (realtime, every 1 ms): from 0.012000 s")
    shown.click("#previous")
    assert text(shown, "run") == (
        "Rate <loop> (realtime, every 1 ms): from 0.009100 s for 90 us of 100 us, 6100 us behind "
        "its release, slack 2900 us, guard 20 us, 6 periods skipped"
    )
    left, right = shown.evaluate("[from, to]")
    assert (left + right) / 2 == pytest.approx(9145.0)


def test_a_run_is_chosen_by_a_click(shown: Browser) -> None:
    x, y = place(shown, 1, 7000)
    for kind in ("mousePressed", "mouseReleased"):
        mouse(shown, kind, x, y)
    assert text(shown, "run") == (
        "Telemetry (low, every 4 ms): from 0.005100 s for 4000 us of 300 us, 100 us behind its "
        "release, slack 0 us, guard 20 us, promoted, deadline missed"
    )
    x, y = place(shown, 0, 7000)
    for kind in ("mousePressed", "mouseReleased"):
        mouse(shown, kind, x, y)
    assert text(shown, "run") == "Click a run to see its times."


def test_the_wheel_zooms_where_it_points_and_dragging_moves(shown: Browser) -> None:
    x, y = place(shown, 0, 5000)
    for _ in range(8):
        mouse(shown, "mouseWheel", x, y, deltaX=0, deltaY=-100)
    left, right = shown.evaluate("[from, to]")
    assert right - left == pytest.approx(11080 * 0.8**8)
    assert float(place(shown, 0, 5000)[0]) == pytest.approx(x, abs=4)  # A pixel, six times as wide.
    mouse(shown, "mousePressed", x, y)
    mouse(shown, "mouseMoved", x - 100, y)
    mouse(shown, "mouseReleased", x - 100, y)
    assert float(place(shown, 0, 5000)[0]) == pytest.approx(x - 100, abs=5)
    assert text(shown, "run") == "Click a run to see its times."
    shown.click("#all")
    assert text(shown, "view") == "0.001000 s to 0.012080 s"


def test_the_colours_of_what_matters(shown: Browser) -> None:
    drawn = {
        (task_number, time): shown.evaluate(
            "(() => { const one = document.getElementById('canvas'), at ="
            f" [x({time}), rowTop({task_number}) + rowHeight() / 2];"
            " const data = one.getContext('2d').getImageData(at[0], at[1], 1, 1).data;"
            " return [...data].slice(0, 3); })()"
        )
        for task_number, time in ((0, 12040), (1, 1250), (1, 7000), (1, 11500))
    }
    assert drawn[0, 12040] == [0x00, 0x72, 0xB2]  # Real time.
    assert drawn[1, 1250] == [0x00, 0x9E, 0x73]  # Another one.
    assert drawn[1, 7000] == [0xC0, 0x2A, 0x1D]  # A deadline was missed.
    assert drawn[1, 11500] == [0, 0, 0]  # Nothing.


def test_a_log_of_many_runs_is_drawn_soon(browser: Browser, tmp_path: Path) -> None:
    many = [task(*LOOP), *(run(0, 1000 * number, 0, 80) for number in range(200_000))]
    page.write(tmp_path / "many.html", runs.read(written(tmp_path / "many.ulg", many)), "many")
    browser.window(1300, 700)
    browser.open((tmp_path / "many.html").as_uri())
    browser.click("#all")
    assert text(browser, "view") == "0.000000 s to 199.999080 s"
    assert search(browser, "rate") == "200000 runs"
    spent_ms = browser.evaluate(
        "(() => { const then = performance.now(); draw(); return performance.now() - then; })()"
    )
    assert spent_ms < 1500


@pytest.mark.parametrize(("width", "dark"), [(1300, False), (800, True)])
def test_no_text_is_cut_or_hard_to_read(shown: Browser, width: int, dark: bool) -> None:
    shown.window(width, 700, dark=dark)
    assert shown.evaluate(FAULTS) == []
    shown.screenshot(SHOTS / f"{width}.png")
