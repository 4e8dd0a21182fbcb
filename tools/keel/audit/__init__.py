# SPDX-License-Identifier: Apache-2.0
"""What must hold of the proofs as a whole, besides that they succeed. Looked at in each run.

Nothing left out, nothing assumed, nothing that makes a contract or a harness say less than it seems
to. No kept verdict rests on it."""
