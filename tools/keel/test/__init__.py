# SPDX-License-Identifier: Apache-2.0
"""Suites of tests, whatever they are written in and wherever they run.

needs     which tools suites of the host need, and which of them take long
outcomes  how a suite went, from what its program wrote
running   running suites side by side, telling how they went, and the reports
"""
