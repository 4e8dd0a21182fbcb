# SPDX-License-Identifier: Apache-2.0
"""What every tool needs, once: running programs, writing files, reading checked files, building.

errors     the one exception of a tool, exit statuses, and the nearest right name for a wrong one
arguments  a command line whose mistakes are told in one line
run        programs: time limits, clear errors, output kept
files      whole files or none, and errors that name the file
config     TOML and JSON checked by a model: file, line, key and reason of each mistake
build      C and C++ for the host and for the target
junit      reports of tests as CI systems read them
"""
