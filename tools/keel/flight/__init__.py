# SPDX-License-Identifier: Apache-2.0
"""Flies examples/copter in models of an aircraft that others wrote, and judges the flights.

A plant (keel.plants) moves in steps of 1 ms; sensors makes of its truth what devices would say;
library is the copter as a shared library; loop joins them. scenario reads what is to be flown,
pilot moves the sticks, faults breaks things, judge holds the trace against the limits, tables
tells. montecarlo varies all of it over seeds.
"""
