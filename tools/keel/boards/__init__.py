# SPDX-License-Identifier: Apache-2.0
"""The boards: what their files say, what is in their images, and what those may do.

board              a board's file
built              the image that `make firmware` left, as its report vouches for it
elf, placement     what is in an image, and whether it lies where the board's file asks
rebuilt            whether an image depends on the folder that it was built in
semantics          the flags of the compiler that the proofs rest on
call_graph         who calls whom, and with which frame: from the compiler and from instructions
stack_bounds       the deepest paths, with what the compiler cannot know of calls
register_headers   the facts that the register headers state
register_databases the same facts in two independent databases
packages           modules of the Python packages that the toolchain has
"""
