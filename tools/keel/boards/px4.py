# SPDX-License-Identifier: Apache-2.0
"""The .px4 container, and the upload of one through the PX4 boot loader's serial protocol.

    python3 tools/keel px4 pack IMAGE.bin OUT.px4 --board-id 50     # make a container
    python3 tools/keel px4 upload FILE.px4 --port /dev/ttyACM0      # write it to a board

A container is JSON: what the image is for, and the image itself, compressed with zlib and in
base64. It holds no time, so that the same image makes the same container.

The boot loader answers for some seconds after a reset or power-on: --wait says how long to look for
it. A command is a byte, its arguments and 0x20; an answer is its data, 0x12 and a status, of which
0x10 means done. The first word of an image is written last by the boot loader itself, so a broken
upload is never started. Nothing counts as written until the boot loader's own checksum over its
whole flash is that of the image.

Exit status: 0 when the image was written and checked, 2 when not.
"""

from __future__ import annotations

import base64
import binascii
import glob
import json
import struct
import time
import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from keel.base.arguments import Parser
from keel.base.errors import ToolError, program
from keel.base.files import write_text
from keel.boards.packages import load
from keel.install import Toolchain

MAGIC = "PX4FWv1"
PORTS = ("/dev/serial/by-id/*PX4_BL*", "/dev/serial/by-id/*PX4*BL*")
BAUD = 115_200

GET_SYNC, GET_DEVICE, CHIP_ERASE, PROG_MULTI, GET_CRC, BOOT = 0x21, 0x22, 0x23, 0x27, 0x29, 0x30
END, IN_SYNC = 0x20, 0x12
OK, FAILED, INVALID = 0x10, 0x11, 0x13
STATUS = {FAILED: "failed", INVALID: "does not know the command"}
REVISION, BOARD_ID, BOARD_REVISION, FLASH_SIZE = 1, 2, 3, 4
REVISIONS = range(4, 6)  # With GET_CRC, and as documented.
CHUNK = 252  # At most 255 in a command, whole words.

ANSWER_S = 1.0
ERASE_S = 60.0
CRC_S = 30.0


class Px4Error(ToolError):
    """A container or an upload is not as it must be; the message says what and why."""


# --- The container -------------------------------------------------------------------------------


@dataclass(frozen=True)
class Container:
    """An image, and the board that it is for."""

    board_id: int
    image: bytes
    description: str = ""
    room: int = 0  # Bytes of flash behind the boot loader; 0: not known.

    @property
    def padded(self) -> bytes:
        """The image in whole words; flash that is not written reads as ones."""
        return self.image + b"\xff" * (-len(self.image) % 4)

    def text(self) -> str:
        """The container's text."""
        content = {
            "magic": MAGIC,
            "board_id": self.board_id,
            "board_revision": 0,
            "description": self.description,
            "summary": "Keel",
            "version": "0",
            "git_identity": "",
            "build_time": 0,
            "image_size": len(self.image),
            "image_maxsize": self.room or len(self.image),
            "image": base64.b64encode(zlib.compress(self.image, 9)).decode(),
        }
        return json.dumps(content, indent=1) + "\n"

    def write(self, path: Path) -> None:
        """Write the container, whole or not at all."""
        write_text(path, self.text())

    @classmethod
    def read(cls, path: Path) -> Container:
        """Read and check a container."""
        try:
            raw = json.loads(path.read_text(encoding="utf-8"))
            if raw["magic"] != MAGIC:
                raise Px4Error(f"{path}: the magic word is {raw['magic']!r}, not {MAGIC!r}")
            image = zlib.decompress(base64.b64decode(raw["image"], validate=True))
            room = int(raw.get("image_maxsize", 0))
            found = cls(int(raw["board_id"]), image, str(raw.get("description", "")), room)
            size = int(raw["image_size"])
        except (OSError, ValueError, KeyError, TypeError, zlib.error, binascii.Error) as error:
            raise Px4Error(f"{path}: no container: {type(error).__name__}: {error}") from error
        if size != len(image):
            raise Px4Error(f"{path}: the image has {len(image)} bytes, not {size} as it says")
        return found


# --- The boot loader -----------------------------------------------------------------------------


class Port(Protocol):
    """What is used of a serial port."""

    timeout: float | None

    def write(self, data: bytes) -> int | None: ...
    def read(self, size: int) -> bytes: ...
    def reset_input_buffer(self) -> None: ...
    def close(self) -> None: ...


def checksum(data: bytes, size: int) -> int:
    """The boot loader's CRC-32 over its whole flash: no inversion, neither before nor after."""
    ones = zlib.crc32(data, 0xFFFF_FFFF)
    rest = size - len(data)
    while rest > 0:
        step = min(rest, 1 << 16)
        ones = zlib.crc32(b"\xff" * step, ones)
        rest -= step
    return ones ^ 0xFFFF_FFFF


class BootLoader:
    """A boot loader at a serial port."""

    def __init__(self, port: Port) -> None:
        self.port = port

    def _receive(self, count: int, seconds: float) -> bytes:
        self.port.timeout = seconds
        data = self.port.read(count)
        if len(data) != count:
            raise Px4Error(
                f"the boot loader does not answer: {len(data)} of {count} bytes in {seconds:g} s"
            )
        return data

    def command(self, words: Sequence[int], count: int = 0, seconds: float = ANSWER_S) -> bytes:
        """Send a command; the data of its answer."""
        self.port.write(bytes([*words, END]))
        answer = self._receive(count + 2, seconds)
        data, sync, status = answer[:count], answer[count], answer[count + 1]
        if sync != IN_SYNC:
            raise Px4Error(f"the boot loader answers 0x{sync:02x} where 0x{IN_SYNC:02x} must be")
        if status != OK:
            reason = STATUS.get(status, f"answers status 0x{status:02x}")
            raise Px4Error(f"the boot loader {reason} (command 0x{words[0]:02x})")
        return data

    def sync(self) -> None:
        """Find the boot loader at the beginning of a command."""
        self.port.reset_input_buffer()
        self.command([GET_SYNC], seconds=0.2)

    def device(self, what: int) -> int:
        """A number that describes the board."""
        value: int = struct.unpack("<I", self.command([GET_DEVICE, what], 4))[0]
        return value

    def check(self, container: Container) -> int:
        """Whether the image may be written; the size of the flash."""
        revision = self.device(REVISION)
        if revision not in REVISIONS:
            raise Px4Error(
                f"the boot loader speaks revision {revision} of its protocol; "
                f"{REVISIONS[0]} to {REVISIONS[-1]} are known"
            )
        board = self.device(BOARD_ID)
        if board != container.board_id:
            raise Px4Error(f"the board's id is {board}, the image is for {container.board_id}")
        size = self.device(FLASH_SIZE)
        if len(container.padded) > size:
            raise Px4Error(f"the image has {len(container.padded)} bytes, the flash {size}")
        return size

    def program(self, image: bytes, say: Callable[[str], None]) -> None:
        """Write the image, from the flash's first byte on."""
        told = 0
        for at in range(0, len(image), CHUNK):
            piece = image[at : at + CHUNK]
            self.command([PROG_MULTI, len(piece), *piece])
            percent = 100 * (at + len(piece)) // len(image)
            if percent >= told + 10 or percent == 100:
                told = percent
                say(f"  {percent:3d} % written")

    def upload(self, container: Container, say: Callable[[str], None]) -> None:
        """Write an image and check it; the board then starts it."""
        size = self.check(container)
        say(f"board id {container.board_id}, {size} bytes of flash; erasing …")
        self.command([CHIP_ERASE], seconds=ERASE_S)
        self.program(container.padded, say)
        answer: int = struct.unpack("<I", self.command([GET_CRC], 4, CRC_S))[0]
        wanted = checksum(container.padded, size)
        if answer != wanted:
            raise Px4Error(
                f"the flash does not hold the image: its checksum is 0x{answer:08x}, "
                f"not 0x{wanted:08x}"
            )
        try:
            self.command([BOOT])
        except (Px4Error, OSError):
            say("the board did not confirm its start; if it does not start, reset it")


# --- Finding it ----------------------------------------------------------------------------------


def open_port(tools: Toolchain, name: str) -> Port:
    """Open a serial port for this program alone."""
    serial = load(tools, "pyserial", "serial")
    port: Port = serial.Serial(name, BAUD, timeout=ANSWER_S, exclusive=True)
    return port


def candidates(name: str) -> list[str]:
    """The ports at which a boot loader may be."""
    if name:
        return [name] if Path(name).exists() else []
    return sorted({path for pattern in PORTS for path in glob.glob(pattern)})


def find(tools: Toolchain, name: str, wait_s: float) -> BootLoader:
    """The first boot loader that answers."""
    deadline = time.monotonic() + wait_s
    last = "no such port" if name else "no port of a PX4 boot loader"
    while True:
        for candidate in candidates(name):
            port: Port | None = None
            try:
                port = open_port(tools, candidate)
                loader = BootLoader(port)
                loader.sync()
                return loader
            except (Px4Error, OSError, ValueError) as error:
                last = f"{candidate}: {error}"
                if port:
                    port.close()
        if time.monotonic() >= deadline:
            raise Px4Error(
                f"no boot loader within {wait_s:g} s ({last}). Check that the board is connected "
                "by USB, that the cable carries data, that you may use the port (group dialout), "
                "and reset the board or plug it in again: its boot loader answers for some 5 s."
            )
        time.sleep(0.05)


def upload(
    tools: Toolchain, path: Path, port: str, wait_s: float, say: Callable[[str], None]
) -> None:
    """Write a container to a board."""
    container = Container.read(path)
    loader = find(tools, port, wait_s)
    try:
        loader.upload(container, say)
    except OSError as error:
        raise Px4Error(f"the port was lost: {error}") from error
    finally:
        loader.port.close()


def tell(line: str) -> None:
    print(line, flush=True)


def main(arguments: Sequence[str] | None = None) -> int:
    """Entry point."""
    parser = Parser("Make and upload .px4 containers.", "px4")
    commands = parser.add_subparsers(dest="command", required=True)
    pack = commands.add_parser("pack", help="make a container of a binary image")
    pack.add_argument("image", type=Path)
    pack.add_argument("output", type=Path)
    pack.add_argument("--board-id", type=int, required=True)
    send = commands.add_parser("upload", help="write a container to a board")
    send.add_argument("container", type=Path)
    send.add_argument("--port", default="", help="serial port (default: a PX4 boot loader's)")
    send.add_argument("--wait", type=float, default=30.0, metavar="SECONDS")
    options = parser.parse_args(arguments)

    def work() -> int:
        if options.command == "pack":
            container = Container(options.board_id, options.image.read_bytes())
            container.write(options.output)
            print(
                f"px4: {options.output}, {len(container.image)} bytes for board {options.board_id}"
            )
            return 0
        tools = Toolchain()
        tools.ensure("flash-px4")
        upload(tools, options.container, options.port, options.wait, tell)
        print("px4: written, and the checksum of the flash is that of the image")
        return 0

    return program("px4", work)
