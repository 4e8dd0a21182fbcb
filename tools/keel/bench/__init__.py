# SPDX-License-Identifier: Apache-2.0
"""What Keel costs.

callgrind  instructions of passes and steps in a host build, from what callgrind wrote
assembly   what the Cortex-M7's objects must not have in a step
emulated   instructions on the emulated Cortex-M7, and their budget
tables     what is printed
"""
