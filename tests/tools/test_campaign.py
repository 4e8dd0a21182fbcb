# SPDX-License-Identifier: Apache-2.0
"""Tests of tools/keel campaign: what it makes of flights."""

from __future__ import annotations

import unittest

from keel.timing import campaign


def flight(fault: str, latched_s: float, worst: float) -> campaign.Flight:
    """A flight as the program writes it."""
    return {
        "fault": fault,
        "first_latch_s": latched_s,
        "all_latched_s": latched_s,
        "worst_a": worst,
    }


class Table(unittest.TestCase):
    """The table of faults."""

    def test_latency_is_a_range_of_milliseconds(self) -> None:
        flights = [flight("stuck", 0.199, 0.1), flight("stuck", 0.25, 0.1)]
        self.assertEqual("199 to 250", campaign.latency(flights, "first_latch_s"))

    def test_flights_without_a_latch_are_told(self) -> None:
        self.assertEqual("never", campaign.latency([flight("bias", -1.0, 0.1)], "first_latch_s"))
        flights = [flight("drift", 0.1, 0.1), flight("drift", -1.0, 0.1)]
        self.assertEqual("100 to 100 (1 of 2)", campaign.latency(flights, "first_latch_s"))

    def test_an_error_beyond_the_bound_is_told(self) -> None:
        groups = campaign.by_fault([flight("stuck", 0.1, 0.5), flight("bias", 0.1, 0.6)])
        lines = campaign.table(groups, 0.5)
        self.assertTrue(lines[1].endswith("within"))
        self.assertTrue(lines[2].endswith("EXCEEDED"))

    def test_flights_are_told_apart_by_the_density_rule(self) -> None:
        flights = [{**flight("stuck", 0.1, 0.1), "density_limit": limit} for limit in (0, 100, 0)]
        groups = campaign.by_limit(flights)
        self.assertEqual([0, 100], list(groups))
        self.assertEqual([2, 1], [len(group) for group in groups.values()])

    def test_two_faulty_units_have_no_bound(self) -> None:
        lines = campaign.table(campaign.by_fault([flight("two equal", -1.0, 10.0)]), 0.5)
        self.assertTrue(lines[1].endswith("outvotes the healthy one"))
