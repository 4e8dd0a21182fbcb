# SPDX-License-Identifier: Apache-2.0
"""Drives headless Chromium for tests, by its DevTools protocol over two pipes."""

from __future__ import annotations

import base64
import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from keel.install import Toolchain

ROOT = Path(__file__).resolve().parents[2]

FLAGS = (
    "--remote-debugging-pipe",
    "--disable-gpu",
    "--no-first-run",
    "--mute-audio",
    "--disable-background-networking",
    "--disable-dev-shm-usage",
)
# Chromium reads commands from descriptor 3 and writes answers to 4.
START = 'exec "$@" 3<&{} 4>&{}'
KEYS = {"Enter": (13, "\r")}  # Its code, and what it types.


class Browser:
    """One page of a browser of its own."""

    def __init__(self) -> None:
        tools = Toolchain()
        tools.ensure("browser", say=lambda line: print(line, file=sys.stderr))
        self._profile = tempfile.mkdtemp()
        told, self._commands = os.pipe()
        self._answers, answered = os.pipe()
        # Neither root nor a user in a container can have Chromium's sandbox.
        walled = os.geteuid() == 0 or os.environ.get("KEEL_CONTAINER") == "1"
        command = [
            *tools.command("chromium-headless-shell"),
            *FLAGS,
            *(("--no-sandbox",) if walled else ()),
            f"--user-data-dir={self._profile}",
            "about:blank",
        ]
        self._child = subprocess.Popen(
            ["bash", "-c", START.format(told, answered), "bash", *command],
            pass_fds=(told, answered),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(told)
        os.close(answered)
        self._rest = b""
        self._number = 0
        self._session = ""
        self.events: list[dict[str, Any]] = []
        target = self.send("Target.createTarget", url="about:blank")["targetId"]
        attached = self.send("Target.attachToTarget", targetId=target, flatten=True)
        self._session = attached["sessionId"]
        for domain in ("Page", "Runtime", "Network"):
            self.send(f"{domain}.enable")

    def close(self) -> None:
        """End the browser."""
        os.close(self._commands)
        self._child.kill()
        self._child.wait()
        os.close(self._answers)
        shutil.rmtree(self._profile, ignore_errors=True)

    def _read(self) -> dict[str, Any]:
        """The next message."""
        while b"\0" not in self._rest:
            more = os.read(self._answers, 1 << 16)
            if not more:
                raise AssertionError("the browser has ended")
            self._rest += more
        message, _, self._rest = self._rest.partition(b"\0")
        read: dict[str, Any] = json.loads(message)
        return read

    def send(self, method: str, **parameters: Any) -> dict[str, Any]:
        """A command's result; what happens meanwhile is kept in `events`."""
        self._number += 1
        message = {"id": self._number, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._commands, json.dumps(message).encode() + b"\0")
        while True:
            read = self._read()
            if read.get("id") == self._number:
                if "error" in read:
                    raise AssertionError(f"{method}: {read['error']['message']}")
                result: dict[str, Any] = read["result"]
                return result
            self.events.append(read)

    def _wait(self, event: str) -> None:
        while not any(one.get("method") == event for one in self.events):
            self.events.append(self._read())

    def open(self, address: str) -> None:
        """Load a page, until all of it is there."""
        self.do_and_load(lambda: self.send("Page.navigate", url=address))

    def do_and_load(self, action: Callable[[], Any]) -> None:
        """Do what leads to another page, and wait for it."""
        self.events = [one for one in self.events if one.get("method") != "Page.loadEventFired"]
        action()
        self._wait("Page.loadEventFired")

    def evaluate(self, script: str) -> Any:
        """The value of an expression on the page; of a promise what it ends with."""
        answer = self.send(
            "Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True
        )
        if "exceptionDetails" in answer:
            raise AssertionError(answer["exceptionDetails"])
        return answer["result"].get("value")

    def click(self, selector: str) -> None:
        """Click the middle of the first element that a selector finds, with the mouse."""
        box = self.evaluate(
            f"(() => {{ const one = document.querySelector({json.dumps(selector)});"
            " one.scrollIntoView({block: 'center', inline: 'center'});"
            " const box = one.getClientRects()[0];"
            " return [box.x + box.width / 2, box.y + box.height / 2]; })()"
        )
        for kind in ("mousePressed", "mouseReleased"):
            self.send(
                "Input.dispatchMouseEvent",
                type=kind,
                x=box[0],
                y=box[1],
                button="left",
                clickCount=1,
            )

    def type(self, text: str) -> None:
        """Type into what has the focus."""
        self.send("Input.insertText", text=text)

    def press(self, key: str) -> None:
        """Press a key that is no letter."""
        common = {"key": key, "code": key, "windowsVirtualKeyCode": KEYS[key][0]}
        self.send("Input.dispatchKeyEvent", type="keyDown", text=KEYS[key][1], **common)
        self.send("Input.dispatchKeyEvent", type="keyUp", **common)

    def window(self, width: int, height: int, dark: bool = False) -> None:
        """Set the page's size and its colours."""
        self.send(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=False,
        )
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.send("Emulation.setEmulatedMedia", features=[scheme])

    def screenshot(self, path: Path) -> None:
        """A picture of the whole page."""
        shot = self.send("Page.captureScreenshot", captureBeyondViewport=True)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(base64.b64decode(shot["data"]))
