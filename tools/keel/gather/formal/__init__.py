# SPDX-License-Identifier: Apache-2.0
"""What the part `formal` is put together from, one kind of fact in each module."""
