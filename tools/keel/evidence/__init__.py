# SPDX-License-Identifier: Apache-2.0
"""Makes the evidence package of what was gathered: pages, PDF, checksums, attestation."""
