# SPDX-License-Identifier: Apache-2.0
"""Suites of tests, whatever they are written in and wherever they run.

outcomes  how a suite went, from what its program wrote
running   running suites, telling how they went, and the reports
"""
