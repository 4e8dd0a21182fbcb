# SPDX-License-Identifier: Apache-2.0
"""Asks the provers: Frama-C/WP, CBMC and Gappa."""
