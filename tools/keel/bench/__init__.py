# SPDX-License-Identifier: Apache-2.0
"""What Keel costs.

budget     which figures there are, and what they may be: bench/budget.toml
kinds      what was counted, by kind of pass
callgrind  instructions of passes and steps in a host build, from what callgrind wrote
assembly   what the Cortex-M7's objects must not have in a step
emulated   instructions on the emulated Cortex-M7
tables     what is printed
"""
