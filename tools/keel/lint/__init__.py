# SPDX-License-Identifier: Apache-2.0
"""What tools/keel lint checks.

texts  the project's files, and what a finding is
misra  MISRA C:2012 with Cppcheck, and the deviations from it
house  the rules of the house
record the report of a run
"""
