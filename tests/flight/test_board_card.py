# SPDX-License-Identifier: Apache-2.0
"""A card in the slot of an FMUv5 that flies: what others' file system and reader of logs find on
it afterwards, and what its faults cost."""

from __future__ import annotations

import dataclasses
import io
import mmap
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from pyulog import ULog
from test_board_faults import Result, check_flown
from test_board_flight import READY_MS, flown, made, rest
from test_copter_image import tools

from keel.base.errors import ROOT
from keel.base.files import write_json
from keel.boards import firmware
from keel.boards.board import application_of, read_board
from keel.flight import board as flying_board
from keel.flight import loop, scenario
from keel.flight.board import BoardCopter
from keel.flight.card import SIZE, log_of, new_card
from keel.flight.loop import Flight, Order, state_names
from keel.install import Toolchain
from keel.qualify.mistakes import Mistake, mistaken

__all__ = ["flown", "made", "tools"]  # Fixtures.
ENDS_S = 9.5
FAULT_S = 5.0  # Both scenarios'.
RING_MS = 89  # So much of the log the ring holds (docs/copter.md).
CHIP, BASE = "bsp/stm32f767/target/chip.c", "bsp/stm32f767/time_base.c"


@dataclasses.dataclass(frozen=True)
class Recorded(Result):
    """A flight, and the log that it left."""

    log: ULog

    def at_us(self, flight_s: float) -> float:
        """A time of the flight, in that of the log: both know when it began to fly."""
        (flying_us,) = (it.timestamp for it in self.log.logged_messages if it.message == "flying")
        flies = self.trace.view["state"] == loop.states().index("flying")
        return float(flying_us + 1e6 * (flight_s - self.trace.column("time")[flies][0]))


def record(copter: BoardCopter, tools: Toolchain, name: str) -> Recorded:
    """Fly a scenario with a new card, up to a time."""
    card = new_card(tools)
    copter.insert(card)
    found = scenario.read(name).model_copy(update={"duration_s": ENDS_S})
    trace = Flight(copter, Order(found, "jsbsim", found.seed)).fly()
    text = copter.text()
    copter.insert(None)
    return Recorded(trace, text, ULog(io.BytesIO(log_of(tools, card))))


@pytest.fixture(scope="module")
def builder(tools: Toolchain, tmp_path_factory: pytest.TempPathFactory) -> firmware.Builder:
    """All that is right is built once."""
    return firmware.Builder(tools, read_board(ROOT, "fmuv5"), tmp_path_factory.mktemp("card"))


@pytest.fixture
def copter(flown: BoardCopter) -> Iterator[BoardCopter]:
    """With an empty slot afterwards."""
    yield flown
    flown.insert(None)


def test_a_busy_card_costs_what_the_ring_cannot_hold(copter: BoardCopter, tools: Toolchain) -> None:
    """Half a second, in which the log has a gap, and says so."""
    found = record(copter, tools, "board_card_busy")
    check_flown(found)
    assert state_names(found.trace)[-1] == "flying"
    assert [task.name for task in copter.timed() if not task.fits] == []
    assert not found.log.file_corruption
    lost_ms = sum(gap.duration for gap in found.log.dropouts)
    assert 500 - 4 * RING_MS <= lost_ms <= 500
    from_us, to_us = found.at_us(FAULT_S), found.at_us(FAULT_S + 0.5)
    for gap in found.log.dropouts:
        assert from_us <= gap.timestamp <= to_us + 1e6 * RING_MS / 1000
    (vote,) = (it for it in found.log.data_list if it.name == "vote")
    assert float(vote.data["timestamp"][-1]) >= found.at_us(ENDS_S - 1.0)


def test_a_card_that_is_pulled_out_ends_the_log_alone(
    copter: BoardCopter, tools: Toolchain
) -> None:
    found = record(copter, tools, "board_card_gone")
    check_flown(found)
    assert state_names(found.trace)[-1] == "flying"
    assert not found.log.file_corruption
    (vote,) = (it for it in found.log.data_list if it.name == "vote")
    last_us = float(vote.data["timestamp"][-1])
    assert found.at_us(FAULT_S - 1.0) <= last_us <= found.at_us(FAULT_S + 0.1)


def test_it_is_ready_in_time_with_a_new_card(copter: BoardCopter, tools: Toolchain) -> None:
    """RST-004. The log's file is made before the first task runs: 512 sectors for 128 MiB, of which
    each keeps the card busy for 2 ms."""
    copter.insert(new_card(tools))
    copter.start(100, False)
    assert rest(copter, 0, READY_MS) == 0
    assert "card status 0\n" in copter.text()
    assert next(it for it in copter.timed() if it.name == "Log").runs > 0


def test_a_slot_without_a_card_has_no_faults(copter: BoardCopter) -> None:
    copter.start(100, False)
    for fault in scenario.CARD_FAULTS:
        with pytest.raises(Exception, match=f"fault {fault}: the board has no"):
            copter.breaks(fault, 0, 0, True)
    with pytest.raises(Exception, match="multiple of 512 KiB"):
        copter.insert(mmap.mmap(-1, SIZE + 4096))


@pytest.mark.parametrize(
    ("path", "old", "new", "why"),
    [
        (
            CHIP,
            "#define CARD_CLOCK_HZ 48000000u",
            "#define CARD_CLOCK_HZ 16000000u",
            "is 1200000 Hz",
        ),
        (CHIP, "keel_chip_give(slot->command, KEEL_PULL_UP);", "", "a pin is not its own"),
        (CHIP, "RCC_APB2ENR_SDMMC1EN);", "RCC_APB2ENR_ADC1EN);", "has no clock of 48 MHz"),
        ("bsp/stm32f767/sdmmc.c", "FOUR_LINES : 0u)", "0u : 0u)", "use other lines"),
        (BASE, "tim->PSC = prescaler;", "tim->PSC = prescaler + 1u;", "TIM 5 counts each 1009 ns"),
        (CHIP, "RCC_APB1ENR_TIM5EN);", "RCC_APB1ENR_TIM4EN);", "TIM 5 is used without its clock"),
        (
            BASE,
            "tim->CR1 = TIM_CR1_CEN;",
            "tim->CR1 = TIM_CR1_CEN; ((void (*)(void))0x20010001u)();",
            "executes the page",
        ),
    ],
)
def test_the_model_refuses(
    made: Path,
    builder: firmware.Builder,
    tools: Toolchain,
    tmp_path: Path,
    path: str,
    old: str,
    new: str,
    why: str,
) -> None:
    """A clock beyond the card's, a pin of its slot, its block's clock, and fewer lines than the
    card has; a wrong prescaler of the clock, or none of its bus; code where there are data."""
    mistake = Mistake(trial="lines", file=path, old=old, new=new)
    copter = wrong_image(made, builder, tmp_path, mistake)
    copter.insert(new_card(tools))
    copter.start(100, False)
    assert rest(copter, 0, 1500) == 1
    assert why in copter.why(0)


def test_who_listens_at_another_rate_reads_nothing(
    made: Path, builder: firmware.Builder, tmp_path: Path
) -> None:
    """The console's bits take the time that its divisor says: at 3 % more they are not read."""
    mistake = Mistake(
        trial="lines", file=CHIP, old="#define BAUD 115200u", new="#define BAUD 118700u"
    )
    copter = wrong_image(made, builder, tmp_path, mistake)
    copter.start(100, False)
    assert rest(copter, 0, 700) == 0
    assert set(copter.text()) == {"?"}


def wrong_image(
    made: Path, builder: firmware.Builder, tmp_path: Path, mistake: Mistake
) -> BoardCopter:
    """A copter whose image has a mistake."""
    assert mistake.text().count(mistake.old) == 1
    objects = builder.build.made
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(objects, (mistake.file,), mistaken(builder, mistake, tmp_path / "wrong"))
        parts = application_of(builder.board, "copter").application
        image = builder.link("keel", [*builder.objects(parts), *builder.fatfs()])
    told = {
        "elf": str(image.elf),
        "binary": str(image.binary),
        "address": builder.board.load_address,
    }
    write_json(tmp_path / flying_board.IMAGE, told)
    return BoardCopter(shutil.copy(made, tmp_path / made.name))
