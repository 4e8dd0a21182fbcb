# SPDX-License-Identifier: Apache-2.0
"""The parts, in the order in which a reviewer reads them."""
