# SPDX-License-Identifier: Apache-2.0
"""Which flags of the compiler the proofs rest on, and which would take their ground away."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from keel.install import TARGET_FLAGS

PROCESSOR = "the processor whose data model the proofs have"
COMPILED_AS_PROVED = {
    **dict.fromkeys(TARGET_FLAGS, PROCESSOR),
    "-std=c99": "the language that Frama-C and CBMC read",
    "-ffreestanding": "the headers that the proofs read, and no meaning for names of the library",
    "-ffp-contract=off": "a fused multiplication and addition rounds once, where the proofs and "
    "the host round twice",
}

REASSOCIATES = "changes floating-point results"
LAYOUT = "gives types another size or layout than the proofs"
FORBIDDEN = {
    r"-Ofast": REASSOCIATES,
    r"-ffast-math": REASSOCIATES,
    r"-funsafe-math-optimizations": REASSOCIATES,
    r"-fassociative-math": REASSOCIATES,
    r"-freciprocal-math": REASSOCIATES,
    r"-ffinite-math-only": "takes NaN and infinity for impossible, which refusals look for",
    r"-fno-signed-zeros": REASSOCIATES,
    r"-frounding-math": "leaves the rounding open, which is to the nearest in the proofs",
    r"-fsingle-precision-constant": "rounds constants twice",
    r"-fexcess-precision=.*": "keeps results in more bits than the proofs",
    r"-ffp-contract=(?!off$).*": "rounds once where the proofs round twice",
    r"-mfp16-format=.*": LAYOUT,
    r"-fno-short-enums": LAYOUT,
    r"-fshort-wchar": LAYOUT,
    r"-fpack-struct.*": LAYOUT,
    r"-fsigned-char": "char is unsigned in the proofs",
    r"-m(big-endian|be8|be32)": "the proofs read words as little-endian",
    r"-m(cpu|arch|fpu|float-abi)=.*": "another processor than the one of the proofs",
    r"-marm": "another instruction set than the one of the proofs",
    r"-std=(?!c99$).*": "another language than the one of the proofs",
    r"-flto.*": "optimises across units, where nothing was compared",
    r"-D(?!KEEL_BOARD_)KEEL_.*": "changes a constant of the kernel that was proved",
    r"-U.*": "takes a macro away that the proofs have",
}


def flag_problems(flags: Sequence[str]) -> Iterator[str]:
    """Flags that the proofs need and that are missing, and flags that they cannot bear."""
    for flag, why in COMPILED_AS_PROVED.items():
        if flag not in flags:
            yield f"the flag {flag} is missing: {why}"
    for flag in flags:
        for pattern, why in FORBIDDEN.items():
            if flag not in COMPILED_AS_PROVED and re.fullmatch(pattern, flag):
                yield f"the flag {flag} is forbidden: {why}"
                break
