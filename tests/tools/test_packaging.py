# SPDX-License-Identifier: Apache-2.0
"""Tests of packaging/: what package managers make of Keel, by their own programs where these can be
had (Conan, ESP-IDF's component manager), with stand-ins for the functions of vcpkg and of ESP-IDF.
"""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree

from consumer import ROOT, ConsumerTest, answer, version

VERSION = ".".join(map(str, version()))
SOURCES = sorted(str(path.relative_to(ROOT)) for path in (ROOT / "src").rglob("*.c"))
FIND = "find_package(Keel REQUIRED)"
RECKLESS = "-O2 -ffast-math"
CONANFILE = f"[requires]\nkeel/{VERSION}\n[generators]\nCMakeDeps\nCMakeToolchain\n"
NUMBERS = ("-o", "keel/*:queue_capacity=8", "-o", "keel/*:voter_sensors=3")
IDF = """\
macro(idf_component_register)
  cmake_parse_arguments(IDF "" "" "SRCS;INCLUDE_DIRS" ${{ARGN}})
  add_library(idf_keel STATIC ${{IDF_SRCS}})
  target_include_directories(idf_keel PUBLIC ${{IDF_INCLUDE_DIRS}})
  set(COMPONENT_LIB idf_keel)
endmacro()
add_compile_definitions(KEEL_QUEUE_CAPACITY=8u)
add_subdirectory({root}/packaging/esp-idf/keel idf)
"""
# Each function of vcpkg does the part of its work that the port relies on.
VCPKG = """\
function(run)
  execute_process(COMMAND ${{ARGN}} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
endfunction()
function(vcpkg_check_linkage)
endfunction()
function(vcpkg_cmake_configure)
  cmake_parse_arguments(given "" SOURCE_PATH "" ${{ARGN}})
  run(cmake -S ${{given_SOURCE_PATH}} -B built -DCMAKE_INSTALL_PREFIX=${{CURRENT_PACKAGES_DIR}})
endfunction()
function(vcpkg_cmake_install)
  run(cmake --build built --target install)
endfunction()
function(vcpkg_cmake_config_fixup)
  cmake_parse_arguments(given "" "PACKAGE_NAME;CONFIG_PATH" "" ${{ARGN}})
  if(NOT IS_DIRECTORY ${{CURRENT_PACKAGES_DIR}}/${{given_CONFIG_PATH}})
    message(FATAL_ERROR "there is no ${{given_CONFIG_PATH}}")
  endif()
endfunction()
function(vcpkg_fixup_pkgconfig)
endfunction()
function(vcpkg_install_copyright)
  cmake_parse_arguments(given "" "" FILE_LIST ${{ARGN}})
  file(INSTALL ${{given_FILE_LIST}} DESTINATION ${{CURRENT_PACKAGES_DIR}}/share/keel)
endfunction()
set(CURRENT_PACKAGES_DIR {packages})
file(MAKE_DIRECTORY {packages}/share)
include({root}/packaging/vcpkg/keel/portfile.cmake)
"""


class PackagingTest(ConsumerTest):
    """With the programs of the group `packaging`."""

    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        cls.tools.ensure("packaging", say=lambda _: None)

    def program(self, module: str, *words: str | Path) -> subprocess.CompletedProcess[str]:
        """Run a package manager, whose home is the test's folder."""
        homes = {"CONAN_HOME": "conan", "IDF_TOOLS_PATH": "idf"}
        home = {name: str(self.folder / place) for name, place in homes.items()}
        packages = self.tools.command("packaging-packages")[0]
        command: Sequence[str | Path] = [sys.executable, "-m", module, *words]
        return self.attempt(command, PYTHONPATH=packages, **home)

    def must(self, module: str, *words: str | Path) -> str:
        """Run one that must succeed; what it wrote."""
        done = self.program(module, *words)
        self.assertEqual(done.returncode, 0, f"{module} {words}\n{done.stdout}{done.stderr}")
        return done.stdout


class ConanTest(PackagingTest):
    """conan create, and a project that requires what it made."""

    def test_a_project_requires_it_with_numbers_of_its_own(self) -> None:
        self.must("conans.conan", "profile", "detect")
        self.must("conans.conan", "create", ROOT / "packaging/conan", *NUMBERS)
        self.project(FIND)
        (self.folder / "conanfile.txt").write_text(CONANFILE)
        self.must("conans.conan", "install", ".", "--output-folder", "conan-build", *NUMBERS)
        toolchain = f"-DCMAKE_TOOLCHAIN_FILE={self.folder}/conan-build/conan_toolchain.cmake"
        program = self.build(toolchain, "-DCMAKE_BUILD_TYPE=Release")
        self.assertEqual(self.attempt([program]).returncode, answer(8, 3))
        [licence] = (self.folder / "conan/p").rglob("p/share/licenses/keel/LICENSE")
        self.assertEqual(licence.read_bytes(), (ROOT / "LICENSE").read_bytes())

    def test_a_number_out_of_range_is_refused(self) -> None:
        self.must("conans.conan", "profile", "detect")
        wrong = ("-o", "keel/*:queue_capacity=256")
        done = self.program("conans.conan", "create", ROOT / "packaging/conan", *wrong)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("'256' is not a valid 'options.queue_capacity' value", done.stderr)


class EspIdfTest(PackagingTest):
    """idf_component.yml by ESP-IDF's own reader, and what its CMakeLists.txt registers."""

    def pack(self, folder: Path) -> subprocess.CompletedProcess[str]:
        words = ("component", "pack", "--name", "keel", "--dest-dir", self.folder / "packed")
        return self.program("idf_component_manager", *words, "--project-dir", folder)

    def test_the_manifest_is_read(self) -> None:
        here = Path(shutil.copytree(ROOT / "packaging/esp-idf/keel", self.folder / "keel"))
        done = self.pack(here)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue((self.folder / f"packed/keel_{VERSION}.tgz").is_file())
        manifest = here / "idf_component.yml"
        manifest.write_text(manifest.read_text().replace(f'"{VERSION}"', '"nine"'))
        done = self.pack(here)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("nine", done.stdout + done.stderr)

    def test_the_component_builds_with_its_flags_and_the_project_s_numbers(self) -> None:
        self.project(IDF.format(root=ROOT), "idf_keel")
        program = self.build("-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", flags=RECKLESS)
        self.assertEqual(self.attempt([program]).returncode, answer(8, 4))
        commands = json.loads((self.folder / "build/compile_commands.json").read_text())
        flagged = [one["file"] for one in commands if "-ffp-contract=off" in one["command"]]
        flagged = [str(Path(one).resolve().relative_to(ROOT)) for one in flagged]
        self.assertEqual(sorted(flagged), SOURCES)


class VcpkgTest(ConsumerTest):
    """The port, with stand-ins for vcpkg's functions."""

    def test_what_the_port_installs_is_found(self) -> None:
        packages = self.folder / "packages"
        (self.folder / "port.cmake").write_text(VCPKG.format(root=ROOT, packages=packages))
        self.good(["cmake", "-P", "port.cmake"])
        licence = packages / "share/keel/LICENSE"
        self.assertEqual(licence.read_bytes(), (ROOT / "LICENSE").read_bytes())
        self.project(FIND)
        program = self.build(f"-DCMAKE_PREFIX_PATH={packages}")
        self.assertEqual(self.attempt([program]).returncode, answer())

    def test_the_manifest(self) -> None:
        manifest = json.loads((ROOT / "packaging/vcpkg/keel/vcpkg.json").read_text())
        self.assertEqual((manifest["name"], manifest["version"]), ("keel", VERSION))
        port = (ROOT / "packaging/vcpkg/keel/portfile.cmake").read_text()
        helpers = {one["name"] for one in manifest["dependencies"]}
        needed = {
            "vcpkg-cmake-config" if "config" in name else "vcpkg-cmake"
            for name in re.findall(r"vcpkg_cmake_(\w+)\(", port)
        }
        self.assertEqual(helpers, needed)


class CmsisTest(ConsumerTest):
    """The pack's description, and a pack that is zipped as the documents say."""

    def test_a_project_builds_from_the_pack(self) -> None:
        described = ROOT / "packaging/cmsis/Keel.Keel.pdsc"
        package = ElementTree.parse(described).getroot()
        names = [package.findtext("vendor"), package.findtext("name"), "pdsc"]
        self.assertEqual(described.name.split("."), names)
        versions = {one.get("Cversion") for one in package.iter("component")}
        versions |= {one.get("version") for one in package.iter("release")}
        self.assertEqual(versions, {VERSION})
        with zipfile.ZipFile(self.folder / "keel.pack", "w") as pack:
            pack.write(described, described.name)
            for name in ("LICENSE", "include", "src"):
                for path in [ROOT / name, *(ROOT / name).rglob("*")]:
                    pack.write(path, path.relative_to(ROOT))
        with zipfile.ZipFile(self.folder / "keel.pack") as pack:
            pack.extractall(self.folder / "keel")
        files = [(one.get("category"), one.get("name")) for one in package.iter("file")]
        sources = [str(name) for category, name in files if category == "source"]
        self.assertEqual(sorted(sources), SOURCES)
        self.assertEqual({name for category, name in files if category == "include"}, {"include/"})
        self.assertTrue((self.folder / "keel" / str(package.findtext("license"))).is_file())
        self.project("")
        paths = [f"keel/{one}" for one in sources]
        self.good(["gcc", "-std=c99", "-Ikeel/include", "main.c", *paths, "-o", "aircraft"])
        self.assertEqual(self.attempt([self.folder / "aircraft"]).returncode, answer())
