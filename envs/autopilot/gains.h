// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "envs/autopilot/level_throttle.h"

namespace skein {

// Feet, seconds and radians throughout; commands in [-1, 1] (throttle in [0, 1]).

constexpr double Radians(double degrees) { return degrees * 0.017453292519943295; }

/// Bandwidths of the estimator, rad/s: each estimate follows its kinematics at once and its
/// measurement as slowly as this.
struct EstimatorGains {
  double body_rate = 25;
  double air_angle = 4;
  double attitude = 2.5;  ///< also errors of pitch and yaw
  double altitude = 2;    ///< also altitude errors
  double speed = 3;       ///< of a second-order filter that knows the acceleration, too
  double position = 2;    ///< of the target, relative to the aircraft
  double wind = 1;        ///< of the wind that positions reveal
  double damping = 1.4142135623730951;  ///< twice the damping ratio of the second-order filters
};

/// Lateral guidance: ArduPilot's L1 controller holding a heading.
struct L1Gains {
  double period_s = 17;
};

/// Total energy control: ArduPilot's TECS with all of height on pitch, all of energy on throttle
/// (a speed weight of 0).
struct TecsGains {
  double height_bandwidth = 0.35;   ///< 1/s: climb rate per height error
  double height_deceleration = 40;  ///< ft/s^2, at which large height errors are brought to rest
  double max_climb_rate = 500;      ///< ft/s, up and down
  double max_climb_angle = Radians(30);
  double time_constant_s = 5;
  double max_acceleration = 25;   ///< ft/s^2 asked along the path
  double throttle_damping = 0.5;  ///< of the rate of the energy error, dimensionless
  double integrator_gain = 0.1;   ///< 1/s
  double integrator_limit = 0.3;  ///< of throttle
  LevelThrottle level_throttle = LevelThrottle::Everywhere(0.30);
  double max_energy_rate = 22000;       ///< ft^2/s^3 at full throttle
  double min_energy_rate = -9600;       ///< ft^2/s^3 at idle
  double bank_compensation = 400;       ///< ft^2/s^3 per unit of load factor squared beyond 1
  double speed_filter = 2;              ///< rad/s, of a second-order filter
  double damping = 1.4142135623730951;  ///< twice its damping ratio
};

/// From wanted accelerations to bank and load factor.
struct LiftGains {
  double flight_path_time_s = 1.2;          ///< in which a climb angle is brought about
  double pitch_time_s = 1.5;                ///< in which a pitch is
  double min_vertical_acceleration = -130;  ///< ft/s^2, beyond holding the path
  double max_vertical_acceleration = 180;
  double min_load_factor = -2, max_load_factor = 6.5;
  double vertical_share = 0.95;  ///< of the load factor that the vertical may take from a turn
  double max_bank = Radians(78);
  bool over_bank = false;  ///< rolls the lift to where it is wanted, beyond knife edge too
  double max_straight_bank = Radians(100);  ///< beyond it a roll goes the shorter way round
};

/// Roll error -> rate demand -> stick; load factor demand -> rate demand -> stick. Stick commands
/// ask the flight control system for a load factor and a roll rate.
struct InnerLoopGains {
  double roll_time_s = 0.5;
  double max_roll_rate = Radians(100);  ///< rad/s asked of the loop
  double full_stick_roll_rate = Radians(308);
  double roll_feedforward = 1.35;         ///< full_stick_roll_rate gets about 70 % of what it asks
  double roll_proportional = 0.5;         ///< stick per share of full_stick_roll_rate
  double roll_integral = 0.3;             ///< 1/s
  double roll_integrator_limit = 0.666;   ///< of stick
  double pitch_proportional = 0.3;        ///< g asked per g missing
  double pitch_integral = 0.3;            ///< 1/s
  double pitch_integrator_limit = 2.664;  ///< g
  double full_aft_load_factor = 8, full_forward_load_factor = 4;  ///< g beyond 1 at full stick
};

/// The order in which Control's targets are brought about.
struct SequencerGains {
  bool enabled = true;  ///< else the nose goes to its target at once
  /// Weight of the foresight of what gravity does to the speed while the nose moves.
  double speed_lead = 1.8;
  double pitch_rate = Radians(8);  ///< rad/s at which the nose is taken to move
  double pitch_per_speed = 0.004;  ///< rad per ft/s of speed to be gained
  double max_speed_pitch = Radians(25);
  double low_altitude = 8000, low_altitude_pitch = Radians(15);  ///< ft, least climb below it
  double yaw_tolerance = Radians(6), speed_tolerance = 15;       ///< when the nose may go
  double max_yaw_rate = Radians(25);                             ///< rad/s
  double patience_s = 9;                                         ///< of the nose at its target
  double lost_yaw = Radians(10), lost_speed = 40;                ///< what sends it back then
};

/// Pursuit of a point.
struct PursuitGains {
  double min_length = 300, max_length = 6000;  ///< ft, of L1
  double arrival_distance = 250;               ///< ft, at which nothing is corrected any more
};

/// Everything that an autopilot is made of but its structure.
struct AutopilotGains {
  EstimatorGains estimator;
  L1Gains l1;
  TecsGains tecs;
  LiftGains lift;
  InnerLoopGains inner_loop;
  SequencerGains sequencer;
  PursuitGains pursuit;
  double outer_interval_s = 0.1;  ///< 10 Hz for L1, TECS and the sequencer
};

/// How time passes for an autopilot.
struct AutopilotTiming {
  double dt = 0.02;  ///< of control steps, s
  /// From one step of the outer loops to the next.
  int control_steps_per_outer_step = 5;

  /// Of the outer loops, s.
  double outer_dt() const { return dt * control_steps_per_outer_step; }
};

enum class AutopilotVariant {
  kPublic,  ///< ArduPilot's limits to start from: 45 deg of bank, 15 deg of climb, no sequencer
  kTraditional,  ///< wings never beyond 78 deg
  kAggressive,   ///< points its lift anywhere, inverted too
  kParallel,     ///< kAggressive without sequencer: what a high-level policy of pitch and yaw wants
                 ///< under it
};

AutopilotGains GainsOf(AutopilotVariant variant);

/// "public", "traditional", "aggressive", "parallel".
std::vector<std::string> AutopilotNames();

/// Throws Error on an unknown name; the message lists the known ones.
AutopilotVariant AutopilotOf(const std::string& name);

}  // namespace skein
