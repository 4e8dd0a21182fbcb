# SPDX-License-Identifier: Apache-2.0
"""The same aircraft for MuJoCo: another integrator, other contacts, other frames, other authors.

MuJoCo's world is east, north, up here, and its body forward, left, up: what leaves this file is
turned. The Earth's field is that of JSBSim's home.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import mujoco
import numpy as np

from keel.plants.plants import (
    EAST_M,
    HOME_ALTITUDE_M,
    HOME_LATITUDE,
    HOME_LONGITUDE,
    NORTH_M,
    STEP_S,
    THRUST_POWER,
    Airframe,
    Ground,
    Truth,
    standard_pressure,
)

MASS_KG = 1.4
INERTIA = (0.0190, 0.0190, 0.0252)  # In kg m^2.
ARM_M = 0.1651
THRUST_N = 15.4  # Of a motor at its nominal voltage.
TORQUE_M = 0.0197  # A motor's torque about its axis, for each N of its thrust.
MOTOR_S = 0.03
LEGS_M = 0.1524
AIR = 1.16  # In kg/m^3.
AREA = 0.5  # Of the box that MuJoCo takes the inertia for, 0.077 m^2: what the air meets.
FIELD_UT = (21.4, 1.2, -42.8)  # North, east, up.
# Front right, aft right, aft left, front left; a motor that turns counter-clockwise turns the body
# clockwise, which is to the right.
PLACES = ((1, -1), (-1, -1), (-1, 1), (1, 1))
TURNS = (-1, 1, -1, 1)  # Of the body, about its axis up.
UP = np.array([0.0, 0.0, 1.0])

MODEL = """
<mujoco model="quadrotor">
  <option timestep="{step}" integrator="implicitfast" density="{density}"
          viscosity="1.8e-5" gravity="0 0 -9.8066" magnetic="{east} {north} {up}"/>
  <worldbody>
    <body name="ground" mocap="true">
      <geom name="ground" type="plane" size="0 0 1" friction="0.8"/>
    </body>
    <body name="copter" pos="0 0 {legs}">
      <freejoint/>
      <inertial pos="{forward} {left} 0" mass="{mass}" diaginertia="{ixx} {iyy} {izz}"/>
      {legs_xml}
      {sites}
      <site name="imu"/>
    </body>
  </worldbody>
  <actuator>{motors}</actuator>
  <sensor><accelerometer site="imu"/><gyro site="imu"/><magnetometer site="imu"/></sensor>
</mujoco>
"""
LEG = '<geom type="sphere" size="0.02" pos="{x} {y} {z}" mass="0" solref="0.02 1"/>'
SITE = '<site name="motor{n}" pos="{x} {y} 0.025"/>'
MOTOR = (
    '<general site="motor{n}" gear="0 0 1 0 0 {k}" dyntype="filterexact" dynprm="{lag}"'
    ' gaintype="fixed" gainprm="{thrust}" ctrllimited="true" ctrlrange="0 1"/>'
)


def model_of(airframe: Airframe) -> str:
    """The model's text."""
    legs = [LEG.format(x=0.1016 * x, y=0.1016 * y, z=0.02 - LEGS_M) for x, y in PLACES]
    sites = [SITE.format(n=n, x=ARM_M * x, y=ARM_M * y) for n, (x, y) in enumerate(PLACES)]
    thrust = THRUST_N * airframe.motor_speed**2
    motors = [
        MOTOR.format(n=n, k=TORQUE_M * turn, lag=MOTOR_S * airframe.motor_lag, thrust=thrust)
        for n, turn in enumerate(TURNS)
    ]
    ixx, iyy, izz = (airframe.inertia * value for value in INERTIA)
    north, east, up = FIELD_UT
    return MODEL.format(
        step=STEP_S,
        north=north,
        east=east,
        up=up,
        legs=LEGS_M,
        mass=MASS_KG * airframe.mass,
        forward=airframe.forward_m,
        left=-airframe.right_m,
        ixx=ixx,
        iyy=iyy,
        izz=izz,
        density=AIR * AREA * airframe.drag,
        legs_xml="\n".join(legs),
        sites="\n".join(sites),
        motors="\n".join(motors),
    )


class MujocoPlant:
    """The model on its legs, its motors standing."""

    def __init__(
        self, airframe: Airframe, heading_deg: float, ground: Ground | None = None
    ) -> None:
        self._model = mujoco.MjModel.from_xml_string(model_of(airframe))
        self._data = mujoco.MjData(self._model)
        self._ground = ground or Ground()
        self._steps = 0
        self._lay_ground()
        heading = np.empty(4)
        mujoco.mju_axisAngle2Quat(heading, UP, math.radians(90.0 - heading_deg))
        mujoco.mju_mulQuat(self._data.qpos[3:7], self._data.mocap_quat[0], heading)
        self._data.qpos[:3] = LEGS_M * self._normal
        mujoco.mj_forward(self._model, self._data)
        self._position = self._data.qpos
        self._velocity = self._data.qvel
        self._sensors = self._data.sensordata
        self._control = self._data.ctrl

    def step(self, motors: Sequence[float]) -> None:
        """1 ms. Its actuators take a thrust, not a command."""
        self._control[:] = [motor**THRUST_POWER if motor > 0.0 else 0.0 for motor in motors]
        self._steps += 1
        if not self._ground.is_level:
            self._lay_ground()
        mujoco.mj_step(self._model, self._data)

    def _lay_ground(self) -> None:
        """Where the ground is now. It tilts about the level axis to the left of where it falls."""
        height, steep_deg = self._ground.at(self._steps * STEP_S)
        towards, steep = math.radians(self._ground.towards_deg), math.radians(steep_deg)
        axis = np.array([-math.cos(towards), math.sin(towards), 0.0])
        mujoco.mju_axisAngle2Quat(self._data.mocap_quat[0], axis, steep)
        self._data.mocap_pos[0] = (0.0, 0.0, height)
        flat = math.sin(steep)
        self._normal = np.array(
            [flat * math.sin(towards), flat * math.cos(towards), math.cos(steep)]
        )
        self._height = height

    def inertial(self) -> list[float]:
        """Its accelerometer and its gyroscope."""
        ax, ay, az, p, q, r = self._sensors[:6].tolist()
        return [ax, -ay, -az, p, -q, -r]

    def field(self) -> list[float]:
        """Its magnetometer."""
        x, y, z = self._sensors[6:9].tolist()
        return [x, -y, -z]

    def pressure(self) -> float:
        """MuJoCo has no atmosphere."""
        return standard_pressure(HOME_ALTITUDE_M + float(self._position[2]) - LEGS_M)

    def truth(self) -> Truth:
        """From east, north, up and forward, left, up."""
        east, north, up, w, x, y, z = self._position.tolist()
        v_east, v_north, v_up = self._velocity[:3].tolist()
        roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
        nose_down = math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))
        left_of_east = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
        yaw = (math.pi / 2 - left_of_east) % (2 * math.pi)
        out_east, out_north, out_up = self._normal.tolist()
        stands = self._height + (LEGS_M - east * out_east - north * out_north) / out_up
        return Truth(
            (north, east, up - LEGS_M),
            (v_north, v_east, v_up),
            (roll, -nose_down, yaw),
            HOME_LATITUDE + north / NORTH_M,
            HOME_LONGITUDE + east / EAST_M,
            stands - LEGS_M,
        )

    def blow(self, north: float, east: float, down: float) -> None:
        """Its medium's speed."""
        self._model.opt.wind[:] = (east, north, -down)
