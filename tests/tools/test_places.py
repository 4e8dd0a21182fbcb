# SPDX-License-Identifier: Apache-2.0
"""Tests of which files and macros `make prove` refuses, as no audit would see through them."""

from __future__ import annotations

import tempfile
import unittest
from pathlib import Path

from keel.audit import disguises, macros, places
from keel.base.files import write_text
from keel.c.project import KEEL, ProjectError, find_units
from keel.install import Toolchain
from keel.prove.proof_run import Choice, Session
from keel.qualify.deceptions import BUILT

BOX = "include/keel/rtos/box.h"
HARNESS = "proofs/box/keel_box_harness.c"
MODEL = "specs/model/box.h"
INCLUDE = "#include <stdint.h>\n"


class Projects(unittest.TestCase):
    def setUp(self) -> None:
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        self.write(BOX, BUILT)
        self.write("include/keel/status.h", "typedef enum keel_status { KEEL_OK } keel_status_t;\n")
        self.write(MODEL, "unsigned box(unsigned x);\n")
        self.write(HARNESS, '#include "../../specs/model/box.h"\n#include "keel/rtos/box.h"\n')

    def write(self, name: str, text: str) -> None:
        write_text(self.root / name, text)

    def include(self, line: str, name: str = BOX) -> None:
        """Have a file include something more."""
        self.write(name, BUILT.replace(INCLUDE, f"{INCLUDE}{line}\n"))

    def link(self, name: str, target: str) -> None:
        (self.root / name).parent.mkdir(parents=True, exist_ok=True)
        (self.root / name).symlink_to(self.root / target)

    def refused(self, *parts: str) -> None:
        """Each part stands in a problem."""
        found = places.problems(self.root, find_units(self.root).values())
        for part in parts:
            self.assertTrue(any(part in text for text in found), found)

    def test_what_lies_where_it_belongs_is_fine(self) -> None:
        self.assertEqual(places.problems(self.root, find_units(self.root).values()), [])
        self.assertEqual(macros.problems(self.root), [])

    def test_the_kernel_is_fine(self) -> None:
        self.assertEqual(places.problems(KEEL, find_units().values()), [])
        self.assertEqual(macros.problems(KEEL), [])

    def test_only_headers_are_included_by_a_plain_name(self) -> None:
        for line in (
            '#include "keel/rtos/box.inc"',
            "#include <keel/*first.h>",
            '#include "keel//status.h"',
            '/* More. */ #include "keel/status.h"',
            '#include \\\n"keel/status.h"',
        ):
            with self.subTest(line):
                self.include(line)
                self.refused("box.h:5: an #include names one header")

    def test_no_file_beside_those_that_audits_see_is_included(self) -> None:
        self.write("docs/first.h", "")
        self.write("specs/model/more/first.h", "")
        for name in ("../../../docs/first.h", "../../../specs/model/more/first.h"):
            with self.subTest(name):
                self.include(f'#include "{name}"')
                self.refused(f"box.h:5: {name}: no audit looks at that file")

    def test_what_is_built_includes_what_is_built(self) -> None:
        self.include('#include "../../../specs/model/box.h"')
        self.refused("what is built includes headers below include/")
        self.include('#include "../status.h"')
        self.refused("what is built includes headers below include/")
        self.write("proofs/box/told.c", '// wp: theorem\n#include "../../specs/model/box.h"\n')
        self.refused("proofs/box/told.c:2: ../../specs/model/box.h: what is built includes")

    def test_nothing_is_a_link(self) -> None:
        self.write("docs/first.h", "")
        self.link("include/keel/more", "docs")
        self.link("proofs/box/first.h", "docs/first.h")
        self.refused("include/keel/more: a symbolic link", "proofs/box/first.h: a symbolic link")
        self.include('#include "keel/more/first.h"')
        self.refused("keel/more/first.h: no audit looks at that file")

    def test_nothing_hides_the_headers_of_the_kernel(self) -> None:
        self.write("specs/model/keel/rtos/box.h", BUILT)
        self.write(MODEL, '#include "keel/rtos/box.h"\n')
        self.refused(
            "specs/model/keel: a folder of this name hides",
            "specs/model/box.h:1: keel/rtos/box.h: a file of that name hides the one below",
        )
        self.write("proofs/box/keel/status.h", "")
        self.refused("proofs/box/keel: a folder of this name hides")

    def test_names_are_plain(self) -> None:
        self.write("include/keel/rtos/a box.h", "")
        self.write("include/keel/more*/first.h", "")
        self.refused("include/keel/rtos/a box.h: a name of more", "include/keel/more*: a name of")

    def test_a_header_of_no_unit_has_nothing_to_prove(self) -> None:
        for text, what in (
            ("static int one(int x) { return x; }", "the function one"),
            ("int one(int x);", "the function one"),
            ("/*@ ghost\nstatic int one(int x) { return x; } */", "the function one"),
            ("/*@ lemma none: 0 == 1; */", "the lemma none"),
            ("/*@ axiomatic None { axiom none: 0 == 1; } */", "`axiom`"),
        ):
            for name in ("include/keel/bounds.h", "include/keel/rtos/more/bounds.h"):
                with self.subTest(text, name=name):
                    self.write(name, f"\n{text}\n")
                    self.refused(f"{what}, in a header of no unit")
                    (self.root / name).unlink()
        self.write("proofs/box/bounds.h", "/*@ lemma none: 0 == 1; */\n")
        self.refused("proofs/box/bounds.h:1: the lemma none")

    def test_frama_c_is_given_no_module_of_the_projects(self) -> None:
        self.assertEqual(places.plug_ins(self.root), [])
        for name in ("rtegen.ml", "wp.cmxs", "Wp.mli"):
            self.write(name, "")
        self.assertEqual(len(places.plug_ins(self.root)), 3)
        unit = find_units(self.root)["box"]
        choice = Choice((unit,), False, ("wp",), 1, self.root / "verdicts")
        with self.assertRaisesRegex(ProjectError, "rtegen.ml: Frama-C would load it"):
            Session(self.root, Toolchain(), choice).run()

    def test_the_header_for_cpp_is_the_one_and_as_it_was(self) -> None:
        name = "include/keel/c_declarations.h"
        text = (KEEL / name).read_text(encoding="utf-8")
        self.write(name, text)
        self.assertEqual(disguises.problems(self.root, ()), [])
        more = "#ifdef __OPTIMIZE__\n#define KEEL_FIRST 1\n#endif\n\n#endif\n"
        self.write(name, text.removesuffix("#endif\n") + more)
        self.assertIn("another text than audits know", disguises.problems(self.root, ())[0])
        self.write(name, text)
        self.write("include/keel/rtos/c_declarations.h", more.replace("\n\n#endif", ""))
        found = disguises.problems(self.root, ())
        self.assertIn("rtos/c_declarations.h:1: `#ifdef __OPTIMIZE__`", found[0])

    def test_a_macro_is_no_function_and_takes_no_name(self) -> None:
        more = "#define KEEL_BOX_PUT keel_box\n#define KEEL_OK 1\n"
        self.write(BOX, BUILT.replace("static", f"{more}static"))
        self.write(HARNESS, "#define KEEL_BOX_SIZE 5u\n")
        found = "\n".join(macros.problems(self.root))
        self.assertIn("KEEL_BOX_PUT stands for the function keel_box", found)
        self.assertIn("KEEL_OK has the name of something that a text declares", found)
        self.assertIn("KEEL_BOX_SIZE is defined in a header already, box.h", found)

    def test_a_macro_has_no_name_of_a_predicate_a_field_or_a_parameter(self) -> None:
        more = (
            "/*@ predicate HOLDS(integer n) = n == 0;\n  @ lemma SAID: HOLDS(0); */\n"
            "struct box { int *FIELD[2]; };\ntypedef int (*CALLED)(int GIVEN);\n"
        )
        self.write(BOX, BUILT.replace("static", f"{more}static"))
        names = ("HOLDS", "SAID", "FIELD", "CALLED", "GIVEN")
        self.write(HARNESS, "".join(f"#define {name} 1\n" for name in names))
        found = "\n".join(macros.problems(self.root))
        for name in names:
            self.assertIn(f"the macro {name} has the name of something", found)

    def test_a_pointers_type_may_have_a_name(self) -> None:
        more = "typedef int *box_place_t;\n"
        text = BUILT.replace("static", f"{more}static")
        self.write(BOX, text.replace("    return", "    (void)(box_place_t)x;\n    return"))
        [problem] = disguises.problems(self.root, ())
        self.assertIn("`(box_place_t)`: a cast to a pointer", problem)

    def test_a_theorem_is_judged_as_what_is_built(self) -> None:
        text = "// wp: theorem\n#define WAIT while\nvoid (one)(void)\n{\n}\n"
        self.write("proofs/box/told.c", text)
        found = "\n".join(disguises.problems(self.root, ()))
        self.assertIn("told.c:2: the macro WAIT stands for `while`", found)
        self.assertIn("told.c:3: `(one)`: a name in parentheses", found)
