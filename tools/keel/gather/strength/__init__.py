# SPDX-License-Identifier: Apache-2.0
"""What the part `strength` is put together from, one kind of fact in each module."""
