# SPDX-License-Identifier: Apache-2.0
"""The log's ring between two threads that run at the same time, under the thread sanitizer."""

from __future__ import annotations

import shutil
import tempfile
import unittest
from pathlib import Path

from keel.base.run import run

ROOT = Path(__file__).resolve().parents[2]

ACQUIRE = "-DKEEL_LOG_RING_LOAD(index)=__atomic_load_n((index),__ATOMIC_ACQUIRE)"
RELEASE = "-DKEEL_LOG_RING_STORE(index,value)=__atomic_store_n((index),(value),__ATOMIC_RELEASE)"

# The writer numbers its records, of 5 to 36 bytes: length, number, and bytes that follow from it.
# The reader takes what is there, in pieces of any length, and looks whether records are whole and
# their numbers rise. In the end all numbers have come or were counted as lost.
PROGRAM = """\
#include "keel/middleware/log_ring.h"
#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <string.h>
#define RECORDS 60000u
static keel_log_ring_t ring;
static uint32_t lost;
static int done;
static unsigned turns; /* Of the reader. */
static uint8_t size_of(uint32_t n) { return (uint8_t)(5u + (n * 7u) % 32u); }
static void *write_all(void *unused)
{
    (void)unused;
    for (uint32_t n = 0u; n < RECORDS; n++) {
        uint8_t record[36];
        keel_log_ring_loss_t loss;
        record[0] = size_of(n);
        memcpy(&record[1], &n, 4u);
        for (uint32_t i = 5u; i < record[0]; i++) { record[i] = (uint8_t)(n + i); }
        if (!keel_log_ring_write(&ring, record, record[0], n) && (n % 8u == 0u)) {
            /* On a busy machine, too, the reader gets its turn. */
            const unsigned seen = __atomic_load_n(&turns, __ATOMIC_RELAXED);
            while (__atomic_load_n(&turns, __ATOMIC_RELAXED) == seen) { (void)sched_yield(); }
        }
        if (keel_log_ring_take_loss(&ring, 36u, &loss)) { lost += loss.records; }
    }
    lost += ring.loss.records;
    __atomic_store_n(&done, 1, __ATOMIC_RELEASE);
    return NULL;
}
int main(void)
{
    static uint8_t stream[RECORDS * 36u];
    uint32_t held = 0u, at = 0u, records = 0u, last = 0u;
    pthread_t writer;
    int over = 0;
    keel_log_ring_init(&ring);
    if (pthread_create(&writer, NULL, write_all, NULL) != 0) { return 2; }
    while (!over) {
        over = __atomic_load_n(&done, __ATOMIC_ACQUIRE);
        held += keel_log_ring_read(&ring, &stream[held],
                                   over ? sizeof stream - held : 1u + held % 97u);
        (void)__atomic_fetch_add(&turns, 1u, __ATOMIC_RELAXED);
    }
    (void)pthread_join(writer, NULL);
    while (at < held) {
        uint32_t n;
        memcpy(&n, &stream[at + 1u], 4u);
        if ((stream[at] != size_of(n)) || ((records > 0u) && (n <= last))) { return 3; }
        for (uint32_t i = 5u; i < stream[at]; i++) {
            if (stream[at + i] != (uint8_t)(n + i)) { return 4; }
        }
        at += stream[at];
        last = n;
        records++;
    }
    (void)printf("%u %u\\n", records, lost);
    return ((at == held) && (records + lost == RECORDS)) ? 0 : 5;
}
"""


@unittest.skipUnless(shutil.which("gcc"), "needs gcc")
class Threads(unittest.TestCase):
    """Records cross whole and in order."""

    def build(self, folder: Path, *flags: str) -> Path:
        source, built = folder / "threads.c", folder / "threads"
        source.write_text(PROGRAM, encoding="utf-8")
        made = run(
            [
                "gcc",
                "-std=c99",
                "-O2",
                "-pthread",
                "-DKEEL_LOG_RING_BYTES=256u",
                *flags,
                f"-I{ROOT / 'include'}",
                source,
                ROOT / "src/middleware/log_ring.c",
                "-o",
                built,
            ]
        )
        if not made.good and "tsan" in made.output:
            self.skipTest("gcc has no thread sanitizer")
        self.assertTrue(made.good, made.output)
        return built

    def test_records_cross_whole(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            for flags in ((ACQUIRE, RELEASE), (ACQUIRE, RELEASE, "-fsanitize=thread")):
                with self.subTest(flags):
                    done = run([self.build(Path(name), *flags)])
                    self.assertTrue(done.good, f"{done.how}: {done.output}")
                    records, lost = map(int, done.output.split())
                    self.assertGreater(records, 100)
                    self.assertEqual(records + lost, 60000)

    def test_without_the_order_the_sanitizer_complains(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            done = run([self.build(Path(name), "-fsanitize=thread")])
            self.assertFalse(done.good)
            self.assertIn("data race", done.output)
