# SPDX-License-Identifier: Apache-2.0
"""Reads the copter's logs: plots, spectra, and the magnetic field that its motors make."""
