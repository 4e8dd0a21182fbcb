# SPDX-License-Identifier: Apache-2.0
"""A schedule as it ran, from a log that has each run of a task.

console    a log out of what a board's console said
runs       reading it; slack and deadlines, worked out from the runs
pftrace    as a trace for Perfetto
page       as a page of HTML that needs nothing else
table      as a table of the tasks
picture    a part of it as a picture
"""
