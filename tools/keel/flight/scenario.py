# SPDX-License-Identifier: Apache-2.0
"""Scenarios: what is flown, what breaks, and what a flight must keep to.

Times count from when the motors start; the pilot starts them as soon as the copter lets him. A
scenario may begin as another one (`like`), whose keys it replaces one by one.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal

from keel.base.errors import ROOT, ToolError, unknown
from keel.base.files import read_text
from keel.config import (
    ConfigError,
    Field,
    Mistake,
    Table,
    Text,
    checked,
    parse_toml,
    place_of,
    refusal,
)
from keel.plants.plants import Ground as Plane

FOLDER = ROOT / "examples/copter/scenarios"

Seconds = Annotated[float, Field(ge=0.0, le=600.0)]
Share = Annotated[float, Field(ge=0.0, le=1.0)]
Angle = Annotated[float, Field(ge=-360.0, le=360.0)]
Turn = Annotated[float, Field(ge=-1.0, le=1.0)]
Positive = Annotated[float, Field(gt=0.0, le=1e6)]
RISES = 0.75  # Of the greatest height that the pilot asks for.
Measure = Annotated[float, Field(ge=0.0, le=1e3)]
Milliseconds = Annotated[int, Field(ge=1, le=1000)]
Mode = Literal["acro", "land", "angle", "altitude", "position", "return"]
State = Literal["disarmed", "armed", "flying", "holding", "returning", "landing", "terminated"]
PlantName = Literal["jsbsim", "mujoco"]
StickName = Literal["roll", "pitch", "yaw", "throttle"]


class Gust(Table):
    """1 - cos, along the wind."""

    at_s: Seconds
    length_s: Positive
    speed: Annotated[float, Field(ge=-30.0, le=30.0)]


class Wind(Table):
    """In m/s; `from_deg` is where it comes from; `turbulence` the share of speed that gusts are."""

    speed: Annotated[float, Field(ge=0.0, le=30.0)] = 0.0
    from_deg: Angle = 0.0
    turbulence: Share = 0.0
    shear: Share = 0.0  # Speed is that at 10 m; elsewhere it goes with this power of the height.
    gust: list[Gust] = []


class Wave(Table):
    """A stick that swings."""

    stick: StickName
    amplitude: Share
    period_s: Positive


class Hand(Table):
    """What the pilot does from a time on; what is not named stays as it was. With `height_m` the
    throttle follows what the pilot sees; `lands` has it sink and switch off on the ground."""

    at_s: Seconds
    mode: Mode | None = None
    roll: Turn | None = None
    pitch: Turn | None = None
    yaw: Turn | None = None
    throttle: Turn | None = None
    height_m: Annotated[float, Field(ge=0.0, le=50.0)] | None = None
    arm: bool | None = None
    kill: bool | None = None
    lands: bool = False
    wave: list[Wave] = []
    still: bool = False  # No wave any more.


# What each fault needs beside its time, and what it may have.
FAULTS: dict[str, tuple[str, ...]] = {
    "imu_freeze": ("unit",),
    "imu_silent": ("unit",),
    "imu_silent_all": (),
    "imu_shout": ("unit",),
    "imu_drift": ("unit", "rate"),
    "imu_scale": ("unit", "share"),
    "imu_vibration": ("acceleration", "rate"),
    "radio_loss": (),
    "radio_failsafe": (),
    "radio_noise": ("share",),
    "gps_loss": (),
    "gps_jump": ("north_m", "east_m"),
    "gps_drift": ("north_m", "east_m"),
    "gps_noise": ("share",),
    "gps_wild": ("metres",),
    "barometer_spike": ("pascal",),
    "barometer_loss": (),
    "barometer_stuck": (),
    "magnetometer_current": ("microtesla_per_ampere",),
    "motor_weak": ("motor", "share"),
    "motor_stalls": ("motor",),
    "battery_low": ("share",),
    "task_overrun": ("task", "runs", "extra_us"),
    "imu_unplugged": ("unit",),
    "spi_low": ("bus",),
    "i2c_low": (),
    "gps_silent": (),
    "radio_unplugged": (),
    "radio_line_noise": ("share",),
    "card_busy": (),
    "card_gone": (),
    "oscillator_lost": (),
    "task_hangs": ("task",),
    "core_stops": (),
    "brown_out": (),
}
CARD_FAULTS = ("card_busy", "card_gone")
# The board's own: they are on the model of a board alone. The second ones are not mended.
BOARD_FAULTS = (
    "imu_unplugged",
    "spi_low",
    "i2c_low",
    "gps_silent",
    "radio_unplugged",
    "radio_line_noise",
    *CARD_FAULTS,
)
CHIP_FAULTS = ("oscillator_lost", "task_hangs", "core_stops", "brown_out")
# What it may have.
OPTIONAL: dict[str, tuple[str, ...]] = {
    "imu_vibration": ("alike",),
    "magnetometer_current": ("along",),
    "i2c_low": ("clocks",),
    "brown_out": ("saved_bytes",),
}
FaultKind = Literal[
    "imu_freeze",
    "imu_silent",
    "imu_silent_all",
    "imu_shout",
    "imu_drift",
    "imu_scale",
    "imu_vibration",
    "radio_loss",
    "radio_failsafe",
    "radio_noise",
    "gps_loss",
    "gps_jump",
    "gps_drift",
    "gps_noise",
    "gps_wild",
    "barometer_spike",
    "barometer_loss",
    "barometer_stuck",
    "magnetometer_current",
    "motor_weak",
    "motor_stalls",
    "battery_low",
    "task_overrun",
    "imu_unplugged",
    "spi_low",
    "i2c_low",
    "gps_silent",
    "radio_unplugged",
    "radio_line_noise",
    "card_busy",
    "card_gone",
    "oscillator_lost",
    "task_hangs",
    "core_stops",
    "brown_out",
]


class Fault(Table):
    """What breaks, from a time on and, unless for good, until another."""

    kind: FaultKind
    at_s: Seconds
    until_s: Seconds | None = None
    unit: Annotated[int, Field(ge=1, le=3)] | None = None
    rate: Positive | None = None  # Of a drift, in rad/s each second; of vibration, in rad/s.
    acceleration: Positive | None = None  # Of vibration: of each of two tones, in m/s^2.
    alike: bool | None = None  # Vibration is the same on all units.
    north_m: float | None = None  # Of a jump; of a drift, each second.
    east_m: float | None = None
    metres: Positive | None = None  # Each fix is off by up to so much, each by another way.
    pascal: float | None = None
    microtesla_per_ampere: float | None = None
    along: Annotated[list[float], Field(min_length=3, max_length=3)] | None = None  # Body axes.
    motor: Annotated[int, Field(ge=1, le=4)] | None = None
    share: Share | None = None
    task: Text | None = None
    runs: Annotated[int, Field(ge=1, le=1000)] | None = None
    extra_us: Annotated[int, Field(ge=1, le=1_000_000)] | None = None
    bus: Literal[1, 2, 4] | None = None  # Of inertial units, of the FRAM, of the barometer.
    clocks: Annotated[int, Field(ge=1, le=100)] | None = None  # After which SDA is let go.
    saved_bytes: Annotated[int, Field(ge=1, le=32768)] | None = None  # Into the FRAM, before it.

    @property
    def is_of_board(self) -> bool:
        """Whether only the model of a board has it."""
        return self.kind in (*BOARD_FAULTS, *CHIP_FAULTS)


class Options(Table):
    """How the copter is built for the flight."""

    costs_percent: Annotated[int, Field(ge=1, le=1000)] = 100
    plain_mean: bool = False
    imus: Annotated[int, Field(ge=2, le=3)] = 3


Factor = Annotated[float, Field(ge=0.25, le=4.0)]


class Shaking(Table):
    """Vibration while motors turn: two tones on every axis, by the motors' speed."""

    acceleration: Measure = 0.0  # Of each tone, in m/s^2.
    rate: Measure = 0.0  # In rad/s.
    alike: bool = False  # All units feel the same; else each at a phase of its own.


class Quality(Table):
    """How good the devices are: factors of what is usual, unless a unit is said."""

    noise: Measure = 1.0
    bias: Measure = 1.0
    vibration: Measure = 1.0  # White, beside what shakes.
    gps_noise: Measure = 1.0
    gps_wander: Measure = 1.0  # Of what the place does in minutes.
    field_noise: Measure = 1.0
    field_per_ampere: Measure = 1.0
    scale: Share = 0.0  # Of each inertial unit's axes, off by up to this share.
    cross_axis: Share = 0.0  # Each of their axes feels up to this share of each other one.
    iron: Annotated[list[float], Field(min_length=3, max_length=3)] = [0.0, 0.0, 0.0]  # In uT.
    # An ampere adds this to the magnetometer's field, in uT, beside the small share above.
    wires: Annotated[list[float], Field(min_length=3, max_length=3)] = [0.0, 0.0, 0.0]
    wash: Measure = 0.0  # In Pa: more in front of the barometer, at full thrust on the ground.
    warmth: Measure = 0.0  # What gyroscopes' bias changes by as they get warm, in rad/s.
    gps_delay_ms: Milliseconds = 120
    imu_delay_ms: Milliseconds = 1
    baro_delay_ms: Milliseconds = 10
    shaking: Shaking = Shaking()


class Frame(Table):
    """The aircraft: factors of what the F450's authors describe, where no unit is said."""

    mass: Factor = 1.0
    inertia: Factor = 1.0
    motor_speed: Factor = 1.0  # Turns per volt.
    motor_lag: Factor = 1.0
    drag: Factor = 1.0
    motors: Annotated[list[Factor], Field(min_length=4, max_length=4)] = [1.0, 1.0, 1.0, 1.0]
    forward_m: Annotated[float, Field(ge=-0.1, le=0.1)] = 0.0  # Where its centre of mass is.
    right_m: Annotated[float, Field(ge=-0.1, le=0.1)] = 0.0
    esc_ms: Annotated[int, Field(ge=0, le=100)] = 0  # Speed controllers begin so late.


class Ground(Table):
    """A plane through the start; one that moves swings about this place, as a deck does."""

    slope_deg: Annotated[float, Field(ge=0.0, le=30.0)] = 0.0
    towards_deg: Angle = 0.0  # Where it falls to; also the direction in which a deck rolls.
    heave_m: Annotated[float, Field(ge=0.0, le=2.0)] = 0.0  # Up and down by so much.
    roll_deg: Annotated[float, Field(ge=0.0, le=20.0)] = 0.0  # To both sides by so much.
    period_s: Annotated[float, Field(ge=2.0, le=60.0)] = 6.0
    from_s: Seconds = 0.0  # Since power-up; it begins to move, and ...
    until_s: Seconds = 0.0  # ... stands level again.


class Place(Table):
    """Where on Earth it is flown, in degrees, and the magnetic field there, in microtesla."""

    latitude: Annotated[float, Field(ge=-79.0, le=79.0)]
    longitude: Annotated[float, Field(ge=-180.0, le=180.0)]
    north: Annotated[float, Field(ge=-70.0, le=70.0)]
    east: Annotated[float, Field(ge=-70.0, le=70.0)]
    down: Annotated[float, Field(ge=-70.0, le=70.0)]


class FirstFix(Table):
    """Until this time since power-up the satellite receiver is wrong by so much."""

    until_s: Seconds
    north_m: float = 0.0
    east_m: float = 0.0


class Reach(Table):
    """A state or mode that must be seen between two times."""

    state: State | None = None
    mode: Mode | None = None
    from_s: Seconds = 0.0
    by_s: Seconds


class End(Table):
    """How the flight ends."""

    on_ground: bool = True
    upright: bool = True
    motors_on: bool = False
    state: State | None = None
    home_m: Positive | None = None


class Limits(Table):
    """What must hold, between two times where not said otherwise. Each is an upper limit, but for
    rises_m."""

    from_s: Seconds = 0.0
    to_s: Seconds = 600.0
    attitude_rms_deg: Positive | None = None  # Of roll and of pitch: estimate less truth.
    attitude_max_deg: Positive | None = None
    heading_max_deg: Positive | None = None
    tracking_rms_deg: Positive | None = None  # Of roll and of pitch: truth less what was asked.
    turning_rms_dps: Positive | None = None  # Of the nose: truth less what was asked.
    tilt_max_deg: Positive | None = None
    hold_rms_m: Positive | None = None  # From where it was at from_s, horizontally.
    hold_max_m: Positive | None = None
    away_max_m: Positive | None = None  # From home, to the north, south, east or west.
    place_max_m: Positive | None = None  # Estimate less truth, horizontally.
    height_max_m: Positive | None = None  # From where it was at from_s.
    height_error_max_m: Positive | None = None  # Estimate less truth.
    sink_max: Positive | None = None  # When it touches the ground, in m/s.
    skipped_max: Annotated[int, Field(ge=0)] | None = None  # Runs of real-time tasks left out.
    without_fault_deg: Positive | None = None  # Of roll and pitch: from the same flight unbroken.
    # So high it is at some time, at least; if it is not given, RISES of what the pilot asks for.
    rises_m: Annotated[float, Field(ge=0.0, le=1e6)] | None = None
    stays: list[State] = []  # In one of these, if any are named.
    reach: list[Reach] = []
    end: End = End()


class Scenario(Table):
    """The whole file."""

    description: Text
    like: Text | None = None
    plants: Annotated[list[PlantName], Field(min_length=1)] = ["jsbsim", "mujoco"]
    duration_s: Annotated[float, Field(gt=0.0, le=600.0)]
    seed: Annotated[int, Field(ge=0)] = 1
    heading_deg: Angle = 30.0
    mode: Mode = "angle"
    radio: Literal["sbus", "crsf", "ibus"] = "sbus"
    radio_hz: Literal[50, 111] = 50
    battery_left: Share = 0.95
    battery_resistance: Factor = 1.0  # Of the new and warm one: cold doubles it, age, too.
    stick_way: Annotated[float, Field(ge=0.5, le=1.2)] = 1.0  # Of the way that sticks should have.
    over_s: Positive = 3.0  # So long after the motors have stopped it is over, or at duration_s.
    wind: Wind = Wind()
    airframe: Frame = Frame()
    ground: Ground = Ground()
    devices: Quality | None = None  # Those of the flight, else.
    place: Place | None = None
    first_fix: FirstFix | None = None
    pilot: list[Hand] = []
    fault: list[Fault] = []
    options: Options = Options()
    parameters: dict[Text, float] = {}  # Of the copter, as a ground station sets them; bool: 0, 1.
    limits: Limits = Limits()
    expects_failure: bool = False  # The limits must be broken: what is compared with is worse.

    @property
    def needs_card(self) -> bool:
        """Whether a board flies it with a card in its slot."""
        return any(fault.kind in CARD_FAULTS for fault in self.fault)

    @property
    def plane(self) -> Plane:
        """The ground as a plant takes it."""
        return Plane(**self.ground.model_dump())

    @property
    def rises_m(self) -> float:
        """How high it must be at some time: upper limits hold on the ground, too."""
        if self.limits.rises_m is not None:
            return self.limits.rises_m
        return RISES * max((hand.height_m or 0.0 for hand in self.pilot), default=0.0)


def mistakes(scenario: Scenario) -> Iterator[Mistake]:
    """What types cannot say."""
    for number, fault in enumerate(scenario.fault):
        yield from fault_mistakes(number, fault)
    times = [hand.at_s for hand in scenario.pilot]
    for key, begins in (("pilot", times), ("fault", [fault.at_s for fault in scenario.fault])):
        for number, at_s in enumerate(begins):
            if at_s > scenario.duration_s:
                yield (key, number, "at_s"), f"is after duration_s, {scenario.duration_s}"
    if "jsbsim" in scenario.plants and not scenario.plane.is_level:
        yield ("plants",), 'JSBSim has level ground only: say plants = ["mujoco"]'
    for number, (before, after) in enumerate(zip(times, times[1:], strict=False)):
        if after < before:
            yield ("pilot", number + 1, "at_s"), f"is before the one above, {before}"
    yield from limit_mistakes(scenario)


def fault_mistakes(number: int, fault: Fault) -> Iterator[Mistake]:
    """Keys that this kind of fault needs or does not know."""
    given = fault.model_dump(exclude_none=True)
    needed = FAULTS[fault.kind]
    for key in needed:
        if key not in given:
            yield ("fault", number, key), f"is missing: {fault.kind} needs {', '.join(needed)}"
    for key in given:
        ends = () if fault.kind in CHIP_FAULTS else ("until_s",)
        if key not in ("kind", "at_s", *ends, *needed, *OPTIONAL.get(fault.kind, ())):
            yield ("fault", number, key), f"is nothing that {fault.kind} has"
    if fault.until_s is not None and fault.until_s <= fault.at_s:
        yield ("fault", number, "until_s"), "is not after at_s"


def limit_mistakes(scenario: Scenario) -> Iterator[Mistake]:
    """Limits that cannot be judged."""
    limits = scenario.limits
    if limits.from_s >= min(limits.to_s, scenario.duration_s):
        yield ("limits", "from_s"), "leaves nothing of the flight to be judged"
    if limits.without_fault_deg is not None and not scenario.fault:
        yield ("limits", "without_fault_deg"), "compares with the flight without [[fault]]: add one"
    for number, reach in enumerate(limits.reach):
        if (reach.state is None) == (reach.mode is None):
            yield ("limits", "reach", number), "takes a state or a mode"
        if reach.by_s <= reach.from_s:
            yield ("limits", "reach", number, "by_s"), "is not after from_s"


def of_board(scenario: Scenario) -> list[str]:
    """The kinds of its faults that only the model of a board has."""
    return [fault.kind for fault in scenario.fault if fault.is_of_board]


def names(folder: Path = FOLDER) -> list[str]:
    """All scenarios of a folder."""
    return sorted(path.stem for path in folder.glob("*.toml"))


def read(name: str, folder: Path = FOLDER) -> Scenario:
    """A scenario by its name."""
    if name not in names(folder):
        raise ToolError(unknown("scenario", name, names(folder)))
    path = folder / f"{name}.toml"
    text = read_text(path)
    shown = place_of(path)
    own = data_of(text)
    if "like" not in own:
        return parse_toml(text, Scenario, shown, mistakes)
    # Lines are those of this file; what the other one has wrong is told when it is read itself.
    whole = {**base_of(own["like"], name, shown, folder), **own}
    found = checked(whole, Scenario, shown, text)
    if wrong := list(mistakes(found)):
        raise refusal(whole, shown, text, wrong)
    return found


def with_units(found: Scenario, units: int) -> Scenario:
    """A scenario with fewer inertial units than its three: the last of them fails in the place of
    those that are not there. Two without one of them land, so what the flight would be without the
    fault is no limit then."""
    faults: list[Fault] = []
    for fault in found.fault:
        unit = fault.unit and min(fault.unit, units)
        here = fault if unit == fault.unit else fault.model_copy(update={"unit": unit})
        faults += [] if here in faults else [here]
    limits = found.limits
    if faults != found.fault:
        limits = limits.model_copy(update={"without_fault_deg": None})
    options = found.options.model_copy(update={"imus": units})
    return found.model_copy(update={"fault": faults, "limits": limits, "options": options})


def data_of(text: str) -> dict[str, Any]:
    """The keys of a text; none when it is no TOML, which its reader then tells."""
    try:
        return tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError, ValueError):
        return {}


def base_of(like: object, name: str, shown: str, folder: Path) -> dict[str, Any]:
    """What a scenario begins as; which must not begin as a third one."""
    known = [other for other in names(folder) if other != name]
    if not isinstance(like, str) or like not in known:
        raise ConfigError(f"{shown}: like: {unknown('scenario', str(like), known)}")
    read(like, folder)
    base = data_of(read_text(folder / f"{like}.toml"))
    if "like" in base:
        raise ConfigError(f"{shown}: like: {like} is itself like another one, {base['like']}")
    return base
