# SPDX-License-Identifier: Apache-2.0
"""What is generated for the copter: tables of messages and parameters, the field of the Earth."""
