# SPDX-License-Identifier: Apache-2.0
"""JSBSim's F-16, flown by stick commands: with its own control system, or with Skein's laws on its airframe."""
import math
import os
import tempfile
import xml.etree.ElementTree as xml

import jsbsim

from jsbsim_flight.control_laws import ControlLaws, Surfaces, step_actuators
from jsbsim_flight.task import DT, State

SUBSTEPS = 3  # of JSBSim in a control step: 150 Hz, next to its usual 120
# Full deflections, rad, of the surfaces in JSBSim's model.
ELEVATOR_RAD, AILERON_RAD, RUDDER_RAD = 0.436, 0.375, 0.524
# Parts of the model's flight control that Skein's laws replace. Its trailing-edge flaps follow the ailerons and go too.
REPLACED_CHANNELS = {"Flaps", "Roll", "Pitch", "Yaw", "Leading Edge Flap"}
DIRECT_CHANNEL = f"""<channel name="Surfaces">
 <summer name="fcs/stick-and-trim"><input>fcs/elevator-cmd-norm</input><input>fcs/pitch-trim-cmd-norm</input></summer>
 <pure_gain name="fcs/direct-elevator"><input>fcs/stick-and-trim</input><gain>{ELEVATOR_RAD}</gain>
  <output>fcs/elevator-pos-rad</output></pure_gain>
 <pure_gain name="fcs/direct-aileron"><input>fcs/aileron-cmd-norm</input><gain>{AILERON_RAD}</gain>
  <output>fcs/aileron-pos-rad</output></pure_gain>
 <pure_gain name="fcs/direct-rudder"><input>fcs/rudder-cmd-norm</input><gain>{RUDDER_RAD}</gain>
  <output>fcs/rudder-pos-rad</output></pure_gain>
</channel>"""


class TrimError(RuntimeError):
    """JSBSim finds no steady flight."""


def power_command(throttle):
    """Engine power, 0 to 100, that a throttle of 0..1 asks for (Stevens and Lewis; military power at 0.77)."""
    return 64.94 * throttle if throttle <= 0.77 else 217.38 * throttle - 117.38


def lever_for_power(power):
    """JSBSim's throttle, 0 to 1 with military power at 0.5, at which thrust settles at the share that `power` means:
    below military power it grows with the square of the turbine's speed, and the speed with the throttle."""
    return 0.5 * math.sqrt(power / 50) if power < 50 else power / 100


def write_direct_model(folder):
    """Writes JSBSim's F-16 without the control system of its surfaces, which then follow the stick commands."""
    path = os.path.join(jsbsim.get_default_root_dir(), "aircraft", "f16", "f16.xml")
    tree = xml.parse(path)
    root = tree.getroot()
    for system in root.findall("system"):  # on the ground only
        root.remove(system)
    control = root.find("flight_control")
    for channel in control.findall("channel"):
        if channel.get("name") in REPLACED_CHANNELS:
            control.remove(channel)
    for name in ("fcs/lef-pos-rad", "fcs/flaperon-mix-rad"):
        xml.SubElement(control, "property", value="0").text = name
    control.append(xml.fromstring(DIRECT_CHANNEL))
    os.mkdir(os.path.join(folder, "f16"))
    tree.write(os.path.join(folder, "f16", "f16.xml"))


def load_direct_model(fdm):
    """Loads what write_direct_model writes."""
    with tempfile.TemporaryDirectory() as folder:
        write_direct_model(folder)
        fdm.set_aircraft_path(folder)
        fdm.load_model("f16")


class Vehicle:
    """One F-16 of JSBSim in trimmed flight, wings level, heading north; step() flies a control step."""

    def __init__(self, altitude_ft, airspeed_fps):
        jsbsim.FGJSBBase().debug_lvl = 0
        self.fdm = jsbsim.FGFDMExec(None)
        self.fdm.set_debug_level(0)
        self.load()
        self.fdm.disable_output()
        self.fdm.set_dt(DT / SUBSTEPS)
        self.trim(altitude_ft, airspeed_fps)

    def trim(self, altitude_ft, airspeed_fps):
        fdm = self.fdm
        fdm["ic/h-sl-ft"], fdm["ic/vt-fps"] = altitude_ft, airspeed_fps
        fdm["ic/gamma-deg"], fdm["ic/psi-true-deg"] = 0, 0
        fdm["gear/gear-cmd-norm"] = 0
        if not fdm.run_ic():
            raise TrimError("JSBSim cannot begin at its initial conditions")
        fdm["propulsion/set-running"] = -1
        try:
            fdm["simulation/do_simple_trim"] = 1
        except jsbsim.TrimFailureError as error:
            raise TrimError(f"JSBSim finds no trim at {altitude_ft:.0f} ft and {airspeed_fps:.0f} ft/s") from error

    def run(self, throttle):
        self.fdm["fcs/throttle-cmd-norm"] = lever_for_power(power_command(throttle))
        for _ in range(SUBSTEPS):
            self.fdm.run()

    def power(self):
        """The share of thrust on Skein's scale: of military over idle up to 50, of maximum over dry above."""
        dry = 50 * min(max((self.fdm["propulsion/engine/n2"] - 53) / 47, 0.0), 1.0) ** 2
        reheat = min(max(self.fdm["fcs/throttle-pos-norm"] - 1, 0.0), 1.0)
        return dry + (100 - dry) * reheat

    def state(self):
        get = self.fdm.get_property_value
        weight = get("inertia/weight-lbs")
        return State(
            altitude=get("position/h-sl-ft"), roll=get("attitude/phi-rad"), pitch=get("attitude/theta-rad"),
            yaw=get("attitude/psi-rad"), p=get("velocities/p-rad_sec"), q=get("velocities/q-rad_sec"),
            r=get("velocities/r-rad_sec"), alpha=get("aero/alpha-rad"), beta=get("aero/beta-rad"),
            airspeed=get("velocities/vt-fps"), mach=get("velocities/mach"), density_ratio=get("atmosphere/sigma"),
            dynamic_pressure=get("aero/qbar-psf"), static_pressure=get("atmosphere/P-psf"),
            nz=-get("forces/fbz-total-lbs") / weight, ny=get("forces/fby-total-lbs") / weight, power=self.power(),
            surfaces=self.surfaces())


class OwnControl(Vehicle):
    """With JSBSim's control system: stick and pedals go in, with its signs."""

    def load(self):
        self.fdm.load_model("f16")

    def surfaces(self):
        """As the aerodynamics of JSBSim's model see them."""
        get = self.fdm.get_property_value
        return Surfaces(math.degrees(get("fcs/elevator-pos-rad")), -math.degrees(get("fcs/aileron-pos-rad")),
                        math.degrees(get("fcs/rudder-pos-rad")), max(math.degrees(get("fcs/lef-pos-rad")), 0.0))

    def step(self, throttle, pitch, roll, yaw):
        fdm = self.fdm
        fdm["fcs/elevator-cmd-norm"], fdm["fcs/aileron-cmd-norm"], fdm["fcs/rudder-cmd-norm"] = -pitch, roll, -yaw
        self.run(throttle)


class SkeinControl(Vehicle):
    """With Skein's laws and actuators, whose surfaces JSBSim's airframe has."""

    def __init__(self, altitude_ft, airspeed_fps):
        super().__init__(altitude_ft, airspeed_fps)
        get = self.fdm.get_property_value
        self.positions = Surfaces(math.degrees(get("fcs/elevator-pos-rad")), -math.degrees(get("fcs/aileron-pos-rad")),
                                  math.degrees(get("fcs/rudder-pos-rad")))
        self.fdm["fcs/pitch-trim-cmd-norm"] = 0  # the laws hold the trim
        self.laws = ControlLaws(DT)
        self.laws.settle(self.state(), self.positions)

    def load(self):
        load_direct_model(self.fdm)

    def surfaces(self):
        return self.positions

    def step(self, throttle, pitch, roll, yaw):
        self.positions = step_actuators(self.positions, self.laws.step(pitch, roll, yaw, self.state()), DT)
        fdm = self.fdm
        fdm["fcs/elevator-cmd-norm"] = math.radians(self.positions.elevator) / ELEVATOR_RAD
        fdm["fcs/aileron-cmd-norm"] = -math.radians(self.positions.aileron) / AILERON_RAD
        fdm["fcs/rudder-cmd-norm"] = math.radians(self.positions.rudder) / RUDDER_RAD
        fdm["fcs/lef-pos-rad"] = math.radians(self.positions.leading_edge_flap)
        self.run(throttle)


CONTROLS = {"own": OwnControl, "skein": SkeinControl}
