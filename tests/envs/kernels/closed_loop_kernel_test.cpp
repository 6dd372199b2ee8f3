// SPDX-License-Identifier: Apache-2.0
// Properties of the whole aircraft as the kernels fly it (flight control, actuators, engine, RK4 in
// float32) over the flight envelope. The same properties of the float64 aircraft are in
// closed_loop_test.cpp.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "base/denormals.h"
#include "base/error.h"
#include "envs/aircraft/engine.h"
#include "envs/aircraft/f16.h"
#include "envs/kernels/flight_control_kernel.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/reference/closed_loop.h"
#include "envs/reference/trim.h"
#include "envs/state/attitude.h"
#include "tests/envs/test_tile.h"
#include "tests/extremes.h"
#include "tests/scoped_target.h"

namespace skein {
namespace {

constexpr double kInterval = 0.02;
constexpr AtmosphereModel kAtmosphere = AtmosphereModel::kStevensLewis;

/// One flight to be tested: where it begins.
struct GridPoint {
  double altitude_ft, mach;
  TrimPoint trim;
};

/// 5,000 to 40,000 ft by Mach 0.3 to 1.4, where level flight needs less than 22 degrees of alpha.
std::vector<GridPoint> TrimmableGrid(const Plant& plant) {
  constexpr double kLargestAlpha = 22 / kDegPerRad;
  std::vector<GridPoint> grid;
  for (int row = 1; row <= 8; ++row) {
    const double altitude_ft = 5000 * row;
    const double sound = AirAt(kAtmosphere, altitude_ft).sound_speed_ft_s;
    // From fast to slow: behind the first speed that cannot be flown there is no slower one.
    for (int column = 14; column >= 3; --column) {
      const double mach = 0.1 * column;
      try {
        const TrimPoint trim = Trim(plant, {altitude_ft, mach * sound, 0, 0});
        if (trim.alpha_rad < kLargestAlpha) grid.push_back({altitude_ft, mach, trim});
      } catch (const Error&) {
        break;
      }
    }
  }
  return grid;
}

struct Sticks {
  double pitch = 0, roll = 0, yaw = 0;
};

/// What happened to one aircraft. Degrees, deg/s.
struct Flight {
  double largest_alpha = 0, largest_beta = 0, largest_p = 0;
  double largest_nz = -1e9, smallest_nz = 1e9;
  bool finite = true;
  std::vector<double> p, q, r;

  bool departed() const {
    return !finite || largest_alpha > 35 || largest_beta > 20 || largest_p > 500;
  }
};

class Envelope {
 public:
  explicit Envelope(double cg) {
    Aircraft aircraft = F16();
    aircraft.airframe.cg = cg;
    plant_ = std::make_unique<Plant>(aircraft, kAtmosphere);
    kernel_ = MakeKernelAircraft(aircraft, kAtmosphere);
    grid_ = TrimmableGrid(*plant_);
    EXPECT_EQ(grid_.size(), 93u) << "with the centre of gravity at " << cg;
  }

  const std::vector<GridPoint>& grid() const { return grid_; }

  /// Flies every grid point for `seconds` with sticks by time, after adding `disturbance` [rad/s]
  /// to p, q, r.
  std::vector<Flight> Fly(const std::function<Sticks(double)>& sticks, double seconds,
                          const Eigen::Vector3d& disturbance = Eigen::Vector3d::Zero()) const {
    const DenormalsFlushed flushed;
    const int count = static_cast<int>(grid_.size());
    TestTile tile(count);
    std::vector<float> throttle(tile.stride()), pitch(throttle), roll(throttle), yaw(throttle);
    for (int i = 0; i < count; ++i) {
      const TrimPoint& trim = grid_[static_cast<std::size_t>(i)].trim;
      const ClosedLoop start(*plant_, trim, FlightControlMode::kFull, kInterval);
      for (int column = 0; column < kNumRigidBody; ++column) {
        tile.at(column, i) = static_cast<float>(start.state()[column]);
      }
      for (int k = 0; k < 3; ++k) tile.at(kP + k, i) += static_cast<float>(disturbance[k]);
      tile.at(kPower, i) = tile.at(kPowerCommand, i) = static_cast<float>(start.power());
      tile.at(kElevator, i) = static_cast<float>(start.surfaces().elevator_deg);
      tile.at(kAileron, i) = static_cast<float>(start.surfaces().aileron_deg);
      tile.at(kRudder, i) = static_cast<float>(start.surfaces().rudder_deg);
      tile.at(kLeadingEdgeFlap, i) = static_cast<float>(start.surfaces().leading_edge_flap_deg);
      tile.at(kNz, i) = static_cast<float>(start.nz());
      tile.at(kNy, i) = static_cast<float>(start.ny());
      for (int k = 0; k < kNumFlightControlStates; ++k) {
        tile.at(kAlphaFilter + k, i) =
            static_cast<float>(start.flight_control_state()[static_cast<std::size_t>(k)]);
      }
      throttle[static_cast<std::size_t>(i)] =
          static_cast<float>(ThrottleForPower(plant_->aircraft().throttle_gearing, start.power()));
    }
    std::vector<Flight> flights(grid_.size());
    for (int step = 0; step * kInterval < seconds; ++step) {
      const Sticks now = sticks(step * kInterval);
      std::fill(pitch.begin(), pitch.end(), static_cast<float>(now.pitch));
      std::fill(roll.begin(), roll.end(), static_cast<float>(now.roll));
      std::fill(yaw.begin(), yaw.end(), static_cast<float>(now.yaw));
      ControlTile(*kernel_, tile.tile(), {throttle.data(), pitch.data(), roll.data(), yaw.data()},
                  FlightControlMode::kFull, kInterval);
      StepTile(*kernel_, tile.tile(), kInterval, 1);
      for (int i = 0; i < count; ++i) Watch(&tile, i, &flights[static_cast<std::size_t>(i)]);
    }
    return flights;
  }

 private:
  static void Watch(TestTile* tile, int i, Flight* flight) {
    const double u = tile->at(kU, i), v = tile->at(kV, i), w = tile->at(kW, i);
    const double alpha = std::atan2(w, u) * kDegPerRad;
    const double beta = std::atan2(v, std::hypot(u, w)) * kDegPerRad;
    flight->finite = flight->finite && std::isfinite(alpha) && std::isfinite(beta);
    flight->largest_alpha = Larger(flight->largest_alpha, std::abs(alpha));
    flight->largest_beta = Larger(flight->largest_beta, std::abs(beta));
    flight->p.push_back(tile->at(kP, i) * kDegPerRad);
    flight->q.push_back(tile->at(kQ, i) * kDegPerRad);
    flight->r.push_back(tile->at(kR, i) * kDegPerRad);
    flight->largest_p = Larger(flight->largest_p, std::abs(flight->p.back()));
    flight->largest_nz = Larger(flight->largest_nz, static_cast<double>(tile->at(kNz, i)));
    flight->smallest_nz = Smaller(flight->smallest_nz, static_cast<double>(tile->at(kNz, i)));
  }

  std::unique_ptr<Plant> plant_;
  std::shared_ptr<const KernelAircraft> kernel_;
  std::vector<GridPoint> grid_;
};

/// Standard deviation of the last two seconds after a parabola is taken off.
double Ringing(const std::vector<double>& rate) {
  constexpr Eigen::Index kSamples = 100;
  const Eigen::Map<const Eigen::VectorXd> y(rate.data() + rate.size() - kSamples, kSamples);
  Eigen::MatrixXd basis(kSamples, 3);
  for (Eigen::Index k = 0; k < kSamples; ++k) {
    const double t = static_cast<double>(k) / kSamples;
    basis.row(k) << 1, t, t * t;
  }
  const Eigen::VectorXd rest = y - basis * basis.colPivHouseholderQr().solve(y);
  return std::sqrt(rest.squaredNorm() / kSamples);
}

std::string Where(const GridPoint& point) {
  return std::to_string(point.altitude_ft) + " ft, Mach " + std::to_string(point.mach);
}

class ClosedLoopKernelTest : public testing::TestWithParam<simd::Target> {
 protected:
  ScopedTarget target_{GetParam()};
};

TEST_P(ClosedLoopKernelTest, HandsOffFlightSettlesEverywhere) {
  for (const double cg : {0.30, 0.35}) {
    const Envelope envelope(cg);
    const std::vector<Flight> flights =
        envelope.Fly([](double) { return Sticks(); }, 7, {0.05, 0.05, 0.02});
    for (std::size_t i = 0; i < flights.size(); ++i) {
      EXPECT_FALSE(flights[i].departed()) << Where(envelope.grid()[i]);
      EXPECT_LT(Ringing(flights[i].q), 0.3) << Where(envelope.grid()[i]);
      EXPECT_LT(Ringing(flights[i].r), 0.3) << Where(envelope.grid()[i]);
      EXPECT_LT(Ringing(flights[i].p), 1) << Where(envelope.grid()[i]);
    }
  }
}

TEST_P(ClosedLoopKernelTest, AbusedSticksDoNotMakeItDepart) {
  const Envelope envelope(0.30);
  const auto square = [](double t, double period) {
    return std::fmod(t, period) < period / 2 ? 1.0 : -1.0;
  };
  struct Input {
    const char* name;
    std::function<Sticks(double)> sticks;
    double largest_nz;  // of the verification in docs/explanation/flight-control.md, rounded up
  };
  const std::vector<Input> inputs = {
      {"full aft",
       [](double) {
         return Sticks{1, 0, 0};
       },
       9},
      {"full forward",
       [](double) {
         return Sticks{-1, 0, 0};
       },
       9},
      {"full roll",
       [](double) {
         return Sticks{0, 1, 0};
       },
       9},
      {"full left roll",
       [](double) {
         return Sticks{0, -1, 0};
       },
       9},
      {"full aft and roll",
       [](double) {
         return Sticks{1, 1, 0};
       },
       9},
      {"full pedal",
       [](double) {
         return Sticks{0, 0, 1};
       },
       9},
      {"all three",
       [](double) {
         return Sticks{1, 1, 1};
       },
       11},
      {"pitch square wave",
       [&](double t) {
         return Sticks{square(t, 2), 0, 0};
       },
       9},
      {"roll square wave",
       [&](double t) {
         return Sticks{0, square(t, 2), 0};
       },
       9},
      {"yaw square wave",
       [&](double t) {
         return Sticks{0, 0, square(t, 2)};
       },
       9},
  };
  for (const Input& input : inputs) {
    const std::vector<Flight> flights = envelope.Fly(input.sticks, 4);
    for (std::size_t i = 0; i < flights.size(); ++i) {
      const std::string where = std::string(input.name) + " at " + Where(envelope.grid()[i]);
      EXPECT_FALSE(flights[i].departed()) << where;
      EXPECT_LT(flights[i].largest_nz, input.largest_nz) << where;
      EXPECT_GT(flights[i].smallest_nz, -5) << where;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, ClosedLoopKernelTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return std::string(Name(test.param)); });

}  // namespace
}  // namespace skein
