# SPDX-License-Identifier: Apache-2.0
"""Fly examples/copter in JSBSim in real time, with MAVLink over UDP, until it is interrupted.

    python3 tools/keel sim [--address 127.0.0.1:14550] [--scenario NAME]

It stands on the ground, its pilot's sticks low and his arm switch off. A ground station arms it;
the pilot then climbs to 5 m and lets go of the sticks. With --scenario he arms and flies that
instead. Each --address is a link of its own, at most three. A line that is typed is a command for
the copter's console: "tasks" shows how each task has run, "help" what else there is. The flight's
log is build/sim/sim.ulg; with --trace it has each run of each task, and at the end stands beside
its two files of `make generate NAME=schedule`.

Exit status: 0 when it is interrupted, 1 when the aircraft crashes, 2 when it cannot be flown.
"""

from __future__ import annotations

import argparse
import re
import signal
import time
from collections.abc import Sequence
from pathlib import Path

from keel.base.arguments import Parser
from keel.base.errors import ROOT, ToolError, program
from keel.base.files import read_text, write_text
from keel.flight import library, scenario
from keel.flight.library import Copter, Key, Link
from keel.flight.live import Address, Line, Live, address_of
from keel.flight.loop import Crashed, NotFlown, Order
from keel.flight.pilot import Bystander, Pilot
from keel.install import Toolchain
from keel.plants import plants

BUILD = ROOT / "build/sim"
GROUND_STATIONS = "127.0.0.1:14550"
WARM_S = 12.0  # Until calibrations, estimates and the radio link have settled.
EPOCH_S = 1_420_070_400  # 2015 began (UTC).
TICKS_PER_S = 100_000  # Of the times in signatures.
SPARE_S = 61  # Frames of a new sender may be a minute old, but not from before the start.
MOST_BYTES_PER_S = 1_000_000


def parsed(arguments: Sequence[str] | None) -> argparse.Namespace:
    """The command line."""
    parser = Parser("Fly the copter in real time, with MAVLink over UDP.", "sim")
    parser.add_argument(
        "--address",
        action="append",
        metavar="HOST:PORT",
        help=f"where a ground station listens; {GROUND_STATIONS}",
    )
    parser.add_argument(
        "--listens", action="store_true", help="take no commands and no parameters from the links"
    )
    parser.add_argument(
        "--rate",
        type=int,
        default=20_000,
        metavar="BYTES",
        help="that each link carries in a second",
    )
    parser.add_argument(
        "--key",
        type=Path,
        metavar="FILE",
        help="sign, and take only what is signed; 64 hexadecimal digits",
    )
    parser.add_argument("--scenario", metavar="NAME", help="one of examples/copter/scenarios")
    parser.add_argument("--plant", choices=plants.NAMES, default="jsbsim")
    parser.add_argument("--cold", action="store_true", help="begin with the power-up")
    parser.add_argument(
        "--trace", action="store_true", help="log each run of each task, for Perfetto and as a page"
    )
    parser.add_argument("--build", type=Path, default=BUILD, metavar="FOLDER")
    found = parser.parse_args(arguments)
    found.address = [address_of(text) for text in found.address or [GROUND_STATIONS]]
    if not 1 <= found.rate <= MOST_BYTES_PER_S:
        raise ToolError(f"--rate: expected 1 to {MOST_BYTES_PER_S}, found {found.rate}")
    return found


def key_of(path: Path | None, kept: Path) -> Key | None:
    """The key in a file. Its time is later than any before, of which the last start's is kept."""
    if path is None:
        return None
    text = read_text(path).strip()
    if not re.fullmatch(r"[0-9A-Fa-f]{64}", text):
        raise ToolError(f"{path}: expected 64 hexadecimal digits")
    now = round((time.time() - EPOCH_S) * TICKS_PER_S)
    begun = max(now, last_begun(kept)) + SPARE_S * TICKS_PER_S
    write_text(kept, f"{begun}\n")
    return Key(bytes.fromhex(text), begun)


def last_begun(kept: Path) -> int:
    """When frames began to be signed at the last start."""
    if not kept.is_file():
        return 0
    text = read_text(kept).strip()
    if not re.fullmatch(r"[0-9]{1,15}", text):
        raise ToolError(f"{kept}: expected the time of the last start, found {text[:20]!r}")
    return int(text)


def order_of(options: argparse.Namespace) -> Order:
    """What is flown. Without a scenario: calm air, the mode switch at position."""
    found = scenario.read(options.scenario or "hover")
    if options.scenario is None:
        found = found.model_copy(update={"pilot": [], "mode": "position"})
    return Order(found, options.plant, found.seed)


def tell(addresses: Sequence[Address]) -> None:
    """How to connect."""
    print(
        f"MAVLink 2 goes to {', '.join(str(one) for one in addresses)}, by UDP. "
        "Its system id is MAV_SYS_ID."
    )
    print("QGroundControl listens at 14550 by itself. Others:")
    for one in addresses:
        print(f"    mavproxy.py --master=udpin:{one}")
        print(f'    pymavlink   mavutil.mavlink_connection("udpin:{one}")')
        print(f'    mavsdk      "udpin://{one}"')
    print('Type "tasks" to see how each task has run. Ctrl-C ends it.', flush=True)


def show_trace(log: Path) -> None:
    """The schedule of the flight that has ended."""
    from keel.timeline import command as schedule

    schedule.tell(log)


def fly(arguments: Sequence[str] | None) -> int:
    """Build, warm up, serve."""
    options = parsed(arguments)
    order, key = order_of(options), key_of(options.key, options.build / "signed_from")
    copter = Copter(library.build(Toolchain(), options.build))
    if len(options.address) > copter.links:
        raise ToolError(f"--address: at most {copter.links}")
    lines = [Line(one) for one in options.address]
    links = [Link(options.rate, not options.listens)] * len(lines)
    pilot: type[Pilot] = Pilot if options.scenario else Bystander
    log = options.build / "sim.ulg"
    copter.log(log, options.trace)
    live = Live(copter, order, pilot, links, lines, key, options.build / "parameters")
    signal.signal(signal.SIGINT, signal.default_int_handler)  # Also in a shell's background.
    try:
        if not options.cold:
            live.warm_up(WARM_S)
        tell(options.address)
        live.run()
    except KeyboardInterrupt:
        print("\nsim: ended")
        return 0
    except (Crashed, NotFlown) as error:
        print(f"sim: {error}")
        return 1
    finally:
        copter.log(None)
        for line in lines:
            line.close()
        if options.trace:
            show_trace(log)


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    return program("sim", lambda: fly(arguments))
