# SPDX-License-Identifier: Apache-2.0
"""Tests of CMakeLists.txt: clean projects that contain Keel, on the host and for a Cortex-M7."""

from __future__ import annotations

from hashlib import sha256

from consumer import AS_FOLDER, ConsumerTest, answer, keel_archive


class FolderTest(ConsumerTest):
    """add_subdirectory and FetchContent."""

    def test_as_a_folder(self) -> None:
        self.project(AS_FOLDER)
        self.build_for_both()

    def test_in_a_project_of_cxx_alone(self) -> None:
        """CMake knows C in Keel's folder only: nothing that needs it may reach the project."""
        self.project(AS_FOLDER, language="CXX")
        self.assertEqual(self.attempt([self.build()]).returncode, answer())

    def test_fetched_by_a_project_of_cxx_alone(self) -> None:
        self.project(self.fetch(), language="CXX")
        program = self.build("-DCMAKE_POLICY_DEFAULT_CMP0135=NEW")
        self.assertEqual(self.attempt([program]).returncode, answer())

    def fetch(self) -> str:
        """The lines that fetch Keel as an archive."""
        archive = keel_archive(self.folder / "keel.tar.gz")
        digest = sha256(archive.read_bytes()).hexdigest()
        source = f"URL {archive} URL_HASH SHA256={digest}"
        lines = ["include(FetchContent)", f"FetchContent_Declare(keel {source})"]
        return "\n".join([*lines, "FetchContent_MakeAvailable(keel)"])

    def test_fetched_as_an_archive(self) -> None:
        self.project(self.fetch())
        self.build_for_both("-DCMAKE_POLICY_DEFAULT_CMP0135=NEW")

    def test_one_layer_alone(self) -> None:
        main = '#include "keel/rtos/scheduler.h"\nint main(void) { return KEEL_QUEUE_CAPACITY; }\n'
        self.project(AS_FOLDER, "Keel::rtos", main)
        self.assertEqual(self.attempt([self.build()]).returncode, 32)

    def test_a_layer_brings_those_below(self) -> None:
        """The controller's sources call the middleware."""
        main = '#include "keel/flight/pid.h"\nstatic keel_pid_t pid;\n'
        main += "int main(void) { keel_pid_reset(&pid); return 7; }\n"
        self.project(AS_FOLDER, "Keel::flight", main)
        self.assertEqual(self.attempt([self.build()]).returncode, 7)

    def test_numbers_reach_who_uses_the_library(self) -> None:
        self.project(f"set(KEEL_QUEUE_CAPACITY 8)\n{AS_FOLDER}")
        program = self.build("-DKEEL_VOTER_SENSORS=3")
        self.assertEqual(self.attempt([program]).returncode, answer(8, 3))

    def test_the_extreme_numbers_build(self) -> None:
        self.project(AS_FOLDER)
        for capacity, sensors in ((1, 2), (255, 4)):
            numbers = [f"-DKEEL_QUEUE_CAPACITY={capacity}", f"-DKEEL_VOTER_SENSORS={sensors}"]
            program = self.build(*numbers, into=f"build-{capacity}")
            self.assertEqual(self.attempt([program]).returncode, answer(capacity, sensors))

    def test_a_bad_number_is_refused_in_words(self) -> None:
        self.project(AS_FOLDER)
        for number in ("0", "256", "many", ""):
            done = self.attempt(["cmake", "-B", "bad", f"-DKEEL_QUEUE_CAPACITY={number}"])
            self.assertNotEqual(done.returncode, 0, number)
            wanted = f"KEEL_QUEUE_CAPACITY is '{number}', not a number from 1 to 255"
            self.assertIn(wanted, " ".join(done.stderr.split()))
