# SPDX-License-Identifier: Apache-2.0
"""Tests of the evidence package's site in a real browser, from the file system.

Headless Chromium opens every page of a small package. Its screenshots stay in
build/test/evidence-site, for people.
"""

from __future__ import annotations

import shutil
import tempfile
import unittest
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import unquote, urldefrag, urlsplit

from browser import Browser
from evidence_sample import LONG, SOURCE, assembled

from keel.evidence.package import write_package

ROOT = Path(__file__).resolve().parents[2]

FAULTS = (Path(__file__).parent / "page_faults.js").read_text(encoding="utf-8")
LINKS = (
    "[...document.querySelectorAll('a[href]')].map(a => a.href.baseVal === undefined ?"
    " a.href : new URL(a.href.baseVal, document.baseURI).href)"
)
IDS = "[...document.querySelectorAll('[id]')].map(one => one.id)"
DESKTOP, TABLET = (1440, 900), (820, 1180)
SHOTS = ROOT / "build/test/evidence-site"
FUNCTION = "keel_queue_init"
GOAL = "goal-queue.html#goal-queue-keel_queue_init_ensures_QUE_001_3"


class Site(unittest.TestCase):
    folder: Path
    browser: Browser
    place: Path

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.place = cls.folder / "evidence"
        write_package(cls.place, assembled(cls.folder), SOURCE, {})
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self) -> None:
        self.browser.events.clear()
        self.browser.window(*DESKTOP)

    def open(self, name: str) -> None:
        self.browser.open((self.place / name).as_uri())

    def pages(self) -> Iterator[str]:
        for path in sorted(self.place.rglob("*.html")):
            yield path.relative_to(self.place).as_posix()

    def shot(self, name: str) -> None:
        path = SHOTS / f"{name}.png"
        self.browser.screenshot(path)
        self.assertGreater(path.stat().st_size, 5000)


class Links(Site):
    def test_every_link_leads_to_a_file_and_a_place_that_are_there(self) -> None:
        links: set[tuple[str, str]] = set()
        ids: dict[str, set[str]] = {}
        for page in self.pages():
            self.open(page)
            ids[(self.place / page).as_uri()] = set(self.browser.evaluate(IDS))
            links |= {(page, link) for link in self.browser.evaluate(LINKS)}
        lost = sorted(f"{page}: {link}" for page, link in links if self.leads_nowhere(link, ids))
        self.assertEqual(lost, [])
        self.assertGreater(len(links), 500)

    @staticmethod
    def leads_nowhere(link: str, ids: dict[str, set[str]]) -> bool:
        page, anchor = urldefrag(link)
        there = Path(unquote(urlsplit(page).path)).is_file() and page.startswith("file:")
        return not there or bool(anchor and unquote(anchor) not in ids.get(page, {anchor}))

    def test_nothing_comes_from_elsewhere_and_no_script_fails(self) -> None:
        for page in ("index.html", "site/graph.html", f"site/function-{FUNCTION}.html"):
            self.open(page)
            self.browser.evaluate("document.getElementById('search').focus()")
        asked = [
            one["params"]["request"]["url"]
            for one in self.browser.events
            if one.get("method") == "Network.requestWillBeSent"
        ]
        self.assertEqual([url for url in asked if not url.startswith("file:")], [])
        self.assertGreater(len(asked), 3)
        self.assertEqual(
            [one for one in self.browser.events if one.get("method") == "Runtime.exceptionThrown"],
            [],
        )

    def test_a_link_to_nothing_is_found(self) -> None:
        broken = self.place / "site/broken.html"
        self.addCleanup(broken.unlink)
        broken.write_text('<a href="gone.html">x</a><a href="#gone">y</a>', encoding="utf-8")
        self.open("site/broken.html")
        ids = {broken.as_uri(): set[str]()}
        links = self.browser.evaluate(LINKS)
        self.assertEqual([self.leads_nowhere(link, ids) for link in links], [True, True])


class Ways(Site):
    def follow(self, selector: str) -> None:
        """Click a link, and wait for where it leads."""
        self.browser.do_and_load(lambda: self.browser.click(selector))

    def test_a_goal_is_reached_from_its_requirement_in_three_clicks(self) -> None:
        self.open("site/requirement-QUE-001.html")
        self.follow(f"main td a[href$='/function-{FUNCTION}.html']")
        self.browser.click("#goal + details summary")
        self.follow(f"td a[href$='{GOAL}']")
        self.assertTrue(self.browser.evaluate("location.href").endswith(GOAL))
        self.assertIn(
            "ensures_QUE_001_3",
            self.browser.evaluate("document.querySelector(':target').textContent"),
        )

    def test_the_matrix_and_the_graph_lead_to_the_proof(self) -> None:
        self.open("index.html")
        self.follow(".matrix a[href$='trace-queue.html']")
        self.follow(f"svg a[href$='function-{FUNCTION}.html'] rect")
        text = self.browser.evaluate("document.querySelector('main').innerText")
        for proof in (
            "@ ensures QUE_001_count",
            "61 goals",
            "periods: 5 bits",
            "completely",
            "8 mutants",
            "QUE-001",
        ):
            self.assertIn(proof, text)

    def test_the_search_finds_a_function(self) -> None:
        self.open("site/all-tests.html")
        self.browser.evaluate("document.getElementById('search').focus()")
        self.browser.type(FUNCTION)
        found = self.browser.evaluate(
            "new Promise(done => { const look = () => { const one ="
            " document.querySelector('#results a'); one ? done(one.firstChild.textContent) :"
            " setTimeout(look, 20); }; look(); })"
        )
        self.assertEqual(found, FUNCTION)
        self.browser.do_and_load(lambda: self.browser.press("Enter"))
        self.assertTrue(
            self.browser.evaluate("location.pathname").endswith(f"/site/function-{FUNCTION}.html")
        )

    def test_a_filter_leaves_the_rows_that_have_its_words(self) -> None:
        self.open("site/all-requirements.html")
        self.browser.evaluate("document.querySelector('.filter').focus()")
        self.browser.type("VOT-01")
        left = self.browser.evaluate(
            "[...document.querySelectorAll('tbody tr')].filter(row => !row.hidden).length"
        )
        self.assertEqual(left, 3)

    def test_a_box_of_the_graph_makes_its_lines_stand_out(self) -> None:
        self.open("site/trace-queue.html")
        self.browser.evaluate(
            f"document.querySelector('svg a[data-node=\"function:{FUNCTION}\"]').focus()"
        )
        on = self.browser.evaluate("document.querySelectorAll('svg path.on').length")
        every = self.browser.evaluate("document.querySelectorAll('svg path').length")
        self.assertTrue(2 <= on < every, (on, every))


class Looks(Site):
    def test_no_text_is_cut_or_hard_to_read_on_any_page(self) -> None:
        wrong = []
        for name, size, dark in (("desktop", DESKTOP, False), ("tablet", TABLET, True)):
            self.browser.window(*size, dark=dark)
            for page in self.pages():
                self.open(page)
                self.browser.evaluate(
                    "document.querySelectorAll('details').forEach(one => { one.open = true; })"
                )
                wrong += [f"{name}: {page}: {fault}" for fault in self.browser.evaluate(FAULTS)]
        self.assertEqual(wrong, [])

    def test_screenshots_for_people(self) -> None:
        for name, size in (("desktop", DESKTOP), ("tablet", TABLET)):
            for page in (
                "index.html",
                "site/graph.html",
                "site/trace-queue.html",
                *(f"site/function-{one}.html" for one in (FUNCTION, LONG)),
            ):
                self.browser.window(*size)
                self.open(page)
                self.shot(f"{name}-{Path(page).stem[:40]}")

    def test_cut_text_wide_pages_and_faint_text_are_found(self) -> None:
        page = self.folder / "cut.html"
        page.write_text(
            "<body><div style='width:3em;overflow:hidden;white-space:nowrap'>much too long a line"
            "</div><p style='color:#aaa'>faint</p><p style='margin-left:200vw'>far away</p>"
            "<svg class='graph'><a><rect width='9' height='9'/><text>wide</text></a></svg>",
            encoding="utf-8",
        )
        self.browser.open(page.as_uri())
        told = "\n".join(self.browser.evaluate(FAULTS))
        for fault in (
            "is cut: much",
            "contrast of 2.3: faint",
            "outside of the window: far",
            "wider than its box: wide",
            "the page is too wide",
        ):
            self.assertIn(fault, told)
