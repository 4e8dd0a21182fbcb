# SPDX-License-Identifier: Apache-2.0
"""Conan's recipe of Keel, of the tree that it lies in: conan create keel/packaging/conan"""

import re
from pathlib import Path

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load

TREE = "../.."
# The components of find_package(Keel), and the number that structures of a component depend on.
COMPONENTS = {"rtos": "queue_capacity", "middleware": "voter_sensors", "flight": None}


class Keel(ConanFile):
    """Three static libraries."""

    name = "keel"
    license = "Apache-2.0"
    description = "Flight-control kernel whose guarantees are machine-checked"
    package_type = "static-library"
    languages = "C"
    settings = "os", "compiler", "build_type", "arch"
    options = {"queue_capacity": [*range(1, 256)], "voter_sensors": [2, 3, 4]}
    default_options = {"queue_capacity": 32, "voter_sensors": 4}

    def set_version(self):
        text = load(self, Path(self.recipe_folder, TREE, "include/keel/version.h"))
        self.version = ".".join(re.findall(r"KEEL_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", text))

    def export_sources(self):
        tree = Path(self.recipe_folder, TREE)
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "include/*", "src/*"):
            copy(self, pattern, tree, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["KEEL_QUEUE_CAPACITY"] = str(self.options.queue_capacity)
        toolchain.cache_variables["KEEL_VOTER_SENSORS"] = str(self.options.voter_sensors)
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "Keel")
        for name, number in COMPONENTS.items():
            part = self.cpp_info.components[name]
            part.set_property("cmake_target_name", f"Keel::{name}")
            part.libs = [f"keel_{name}"]
            if number:
                part.defines = [f"KEEL_{number.upper()}={self.options.get_safe(number)}u"]
        self.cpp_info.components["flight"].requires = ["middleware"]
