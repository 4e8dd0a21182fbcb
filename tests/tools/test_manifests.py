# SPDX-License-Identifier: Apache-2.0
"""Tests of what package managers read of Keel: PlatformIO's manifest, Zephyr's module, and that all
of them name the same version and numbers.

PlatformIO's platforms and Zephyr's tree are in no registry that the tests ask. The manifest is
judged, and packed, by PlatformIO itself; Zephyr's CMake functions have stand-ins of a line each.
"""

from __future__ import annotations

import json
import re
import tarfile
import unittest
from pathlib import Path

from consumer import CORTEX_M7, MAIN, ROOT, STRICT, ConsumerTest, answer, version

from keel.install import TARGET_FLAGS

VERSION = ".".join(map(str, version()))
RECKLESS = ("-O2", "-ffast-math", "-ffp-contract=fast")
# PlatformIO asks the network for the names of licences: here it is told the one that counts.
PIO = """\
import sys
from platformio.package.manifest.schema import ManifestSchema
ManifestSchema.load_spdx_licenses = staticmethod(
    lambda: {"licenses": [{"licenseId": "Apache-2.0"}]})
from platformio.__main__ import main
sys.exit(main(["pio", *sys.argv[1:]]))
"""
KCONFIG = """\
import sys
import kconfiglib
kconfig = kconfiglib.Kconfig(sys.argv[1])
for line in sys.argv[2:]:
    kconfig.syms[line.partition("=")[0]].set_value(line.partition("=")[2])
print({name: symbol.str_value for name, symbol in kconfig.syms.items()})
print(kconfig.warnings)
"""
ZEPHYR = """\
function(zephyr_library_named name)
  add_library(${{name}} STATIC)
  set(ZEPHYR_CURRENT_LIBRARY ${{name}} PARENT_SCOPE)
endfunction()
macro(zephyr_library_sources)
  target_sources(${{ZEPHYR_CURRENT_LIBRARY}} PRIVATE ${{ARGN}})
endmacro()
macro(zephyr_library_compile_options)
  target_compile_options(${{ZEPHYR_CURRENT_LIBRARY}} PRIVATE ${{ARGN}})
endmacro()
macro(zephyr_include_directories)
  include_directories(${{ARGN}})
  target_include_directories(${{ZEPHYR_CURRENT_LIBRARY}} PUBLIC ${{ARGN}})
endmacro()
macro(zephyr_compile_definitions)
  target_compile_definitions(${{ZEPHYR_CURRENT_LIBRARY}} PUBLIC ${{ARGN}})
endmacro()
set(CONFIG_KEEL {chosen})
set(CONFIG_KEEL_QUEUE_CAPACITY 8)
set(CONFIG_KEEL_VOTER_SENSORS 3)
add_subdirectory({root}/zephyr zephyr)
"""


class VersionTest(unittest.TestCase):
    """One version; version.h says it."""

    def test_changelog(self) -> None:
        """The newest release that the changelog tells of."""
        text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
        releases = re.findall(r"^## \[(\d\S*)\]", text, re.M)
        self.assertEqual(releases[0], VERSION)

    def test_platformio(self) -> None:
        manifest = json.loads((ROOT / "library.json").read_text())
        self.assertEqual(manifest["version"], VERSION)

    def test_documents(self) -> None:
        """What the integrator copies asks for the present version."""
        text = (ROOT / "docs/integration.md").read_text(encoding="utf-8")
        asked = set(re.findall(r"find_package\(Keel (\d+\.\d+)", text))
        self.assertEqual(asked, {VERSION.rpartition(".")[0]})


class PackageVersionTest(ConsumerTest):
    """What CMake and pkg-config say of the installed tree."""

    def test_installed(self) -> None:
        self.good(["cmake", "-S", ROOT, "-B", "build", f"-DCMAKE_INSTALL_PREFIX={self.folder}/to"])
        told = (self.folder / "build/KeelConfigVersion.cmake").read_text()
        self.assertIn(f'set(PACKAGE_VERSION "{VERSION}")', told)
        self.good(["cmake", "--build", "build", "--target", "install"])
        where = next((self.folder / "to").rglob("keel.pc")).parent
        said = self.good(["pkg-config", "--modversion", "keel"], PKG_CONFIG_PATH=str(where))
        self.assertEqual(said.strip(), VERSION)


class PlatformioTest(ConsumerTest):
    """library.json."""

    def packed(self) -> Path:
        """The folder that PlatformIO would install."""
        (self.folder / "pio.py").write_text(PIO)
        home = {"PLATFORMIO_CORE_DIR": str(self.folder / "pio")}
        self.python("pio.py", "pkg", "pack", "-o", self.folder / "keel.tar.gz", ROOT, **home)
        with tarfile.open(self.folder / "keel.tar.gz") as archive:
            archive.extractall(self.folder / "keel")
        return self.folder / "keel"

    def test_the_package_holds_what_is_flown(self) -> None:
        packed = self.packed()
        names = {str(path.relative_to(packed)) for path in packed.rglob("*") if path.is_file()}
        kept = [path for name in ("src", "include") for path in (ROOT / name).rglob("*.[ch]")]
        others = {"CHANGELOG.md", "LICENSE", "README.md", "library.json"}
        self.assertEqual(names, others | {str(path.relative_to(ROOT)) for path in kept})

    def test_its_flags_keep_the_arithmetic(self) -> None:
        """The package's sources with a careless project's flags, and then with its own."""
        packed = self.packed()
        manifest = json.loads((packed / "library.json").read_text())["build"]
        for header in json.loads((packed / "library.json").read_text())["headers"]:
            self.assertTrue((packed / manifest["includeDir"] / header).is_file(), header)
        include = f"-I{packed / manifest['includeDir']}"
        sources = sorted((packed / manifest["srcDir"]).rglob("*.c"))
        self.assertGreater(len(sources), 10)
        for source in sources:
            code = []
            for flags in (["-std=c99", "-O2"], [*RECKLESS, *manifest["flags"]]):
                compiler = ["arm-none-eabi-gcc", *TARGET_FLAGS, include, *flags]
                self.good([*compiler, "-c", source, "-o", "unit.o"])
                self.good(["arm-none-eabi-objcopy", "-O", "binary", "unit.o", "unit.bin"])
                code.append((self.folder / "unit.bin").read_bytes())
            self.assertEqual(code[0], code[1], source.name)


class ZephyrTest(ConsumerTest):
    """zephyr/: what Kconfig and CMake make of it."""

    def kconfig(self, *settings: str) -> str:
        return self.python("-c", KCONFIG, ROOT / "zephyr/Kconfig", *settings)

    def test_module(self) -> None:
        read = "import json, sys, yaml; print(json.dumps(yaml.safe_load(open(sys.argv[1]))))"
        module = json.loads(self.python("-c", read, ROOT / "zephyr/module.yml"))
        self.assertEqual(module["name"], "keel")
        self.assertEqual(set(module), {"name", "build"})
        self.assertEqual(set(module["build"]), {"cmake", "kconfig"})
        self.assertTrue((ROOT / module["build"]["cmake"] / "CMakeLists.txt").is_file())
        self.assertTrue((ROOT / module["build"]["kconfig"]).is_file())

    def test_options(self) -> None:
        """Off unless asked for; then with the headers' numbers, within their ranges."""
        self.assertIn("'KEEL': 'n'", self.kconfig())
        chosen = self.kconfig("KEEL=y")
        self.assertIn("'KEEL_QUEUE_CAPACITY': '32'", chosen)
        self.assertIn("'KEEL_VOTER_SENSORS': '4'", chosen)
        self.assertTrue(chosen.endswith("[]\n"), chosen)
        told = self.kconfig("KEEL=y", "KEEL_QUEUE_CAPACITY=255")
        self.assertIn("'KEEL_QUEUE_CAPACITY': '255'", told)
        for number in ("0", "256"):
            told = self.kconfig("KEEL=y", f"KEEL_QUEUE_CAPACITY={number}")
            self.assertIn(f"user value {number} on the int symbol KEEL_QUEUE_CAPACITY", told)

    def test_library(self) -> None:
        self.project(ZEPHYR.format(root=ROOT, chosen="y"), "keel")
        self.assertEqual(self.attempt([self.build()]).returncode, answer(8, 3))
        flags = " ".join([*TARGET_FLAGS, STRICT])
        program = self.build(*CORTEX_M7, flags=flags, into="build-m7")
        self.assertEqual(program.read_bytes()[18], 40, "not a program for ARM")

    def test_nothing_unless_chosen(self) -> None:
        self.project(ZEPHYR.format(root=ROOT, chosen="n"), "m", MAIN)
        self.assertNotEqual(self.attempt(["cmake", "-B", "off"]).returncode, 1)
        self.assertNotIn("keel", self.good(["cmake", "--build", "off", "--target", "help"]))
