// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/simd_agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <stdexcept>
#include <utility>

#include "base/error.h"
#include "envs/aircraft/registry.h"
#include "envs/kernels/plant_kernel.h"
#include "tests/envs/test_tile.h"
#include "tests/scoped_target.h"
#include "train/policy/recurrent_policy.h"

namespace skein {
namespace {

using simd::Target;

using Word = std::uint32_t;
constexpr Word kNan = ~Word{0}, kInfinity = kNan - 1, kUpperBound = kNan - 2;

struct Bounds {
  float low, high;
};

float Value(Word word, const Bounds& bounds) {
  if (word == kNan) return std::numeric_limits<float>::quiet_NaN();
  if (word == kInfinity) return std::numeric_limits<float>::infinity();
  const double share = static_cast<double>(word) / kUpperBound;
  return static_cast<float>(bounds.low + share * (bounds.high - bounds.low));
}

/// The rows of a file, or the first kMost of them.
class Records {
 public:
  /// A full vector of every target, and some more.
  static constexpr std::size_t kMost = 20;

  Records(const std::string& file, std::size_t words) : words_(words) {
    const std::size_t bytes = words * sizeof(Word);
    if (file.empty() || file.size() % bytes != 0) {
      throw Error("not records of " + std::to_string(bytes) + " bytes");
    }
    values_.resize(std::min(file.size() / bytes, kMost) * words);
    std::memcpy(values_.data(), file.data(), values_.size() * sizeof(Word));
  }

  int count() const { return static_cast<int>(values_.size() / words_); }
  Word at(int record, std::size_t word) const {
    return values_[static_cast<std::size_t>(record) * words_ + word];
  }

 private:
  std::size_t words_;
  std::vector<Word> values_;
};

std::string Whole(std::string file, std::size_t words) {
  file.resize(file.size() - file.size() % (words * sizeof(Word)));
  return file;
}

/// Records of random words.
std::string RandomRecords(std::size_t records, std::size_t words) {
  std::mt19937 random(7);
  std::string file;
  for (std::size_t i = 0; i < records * words; ++i) {
    const auto word = static_cast<Word>(random());
    file.append(reinterpret_cast<const char*>(&word), sizeof word);
  }
  return file;
}

/// Two of three records have a word of these, each in another place.
std::string WithSpecialWords(std::string file, std::size_t words) {
  for (std::size_t i = 0; i < file.size() / (words * sizeof(Word)); ++i) {
    if (i % 3 == 0) continue;
    const Word word = i % 3 == 1 ? kNan : kInfinity;
    std::memcpy(file.data() + (i * words + i % words) * sizeof(Word), &word, sizeof word);
  }
  return file;
}

std::vector<std::string> SeedsOf(std::size_t words) {
  return {RandomRecords(1, words), RandomRecords(5, words),
          WithSpecialWords(RandomRecords(Records::kMost, words), words)};
}

/// Rows of numbers, one per aircraft.
using Rows = std::vector<std::vector<float>>;

bool IsFinite(const std::vector<float>& row) {
  return std::all_of(row.begin(), row.end(), [](float value) { return std::isfinite(value); });
}

/// What rounding is a share of: the magnitude of each number of `rows`, at least its column's in
/// `scale`.
Rows SizesOf(Rows rows, const std::vector<float>& scale) {
  for (std::vector<float>& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) row[c] = std::max(std::abs(row[c]), scale[c]);
  }
  return rows;
}

/// The larger number of each place of two arrays of rows.
Rows Larger(const Rows& left, Rows right) {
  for (std::size_t i = 0; i < right.size(); ++i) {
    for (std::size_t c = 0; c < right[i].size(); ++c) {
      right[i][c] = std::max(std::abs(left[i][c]), right[i][c]);
    }
  }
  return right;
}

/// Where rows of a target are not finite as the scalar ones are, or farther apart than `tolerance`
/// of their `sizes`; empty if nowhere.
std::string Disagreement(const Rows& rows, const Rows& scalar, const Rows& sizes,
                         double tolerance) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string aircraft = " of aircraft " + std::to_string(i) + ": ";
    if (IsFinite(rows[i]) != IsFinite(scalar[i])) return aircraft + "finite on one of them alone";
    for (std::size_t c = 0; c < rows[i].size() && IsFinite(scalar[i]); ++c) {
      const double difference = std::abs(static_cast<double>(rows[i][c]) - scalar[i][c]);
      if (difference <= tolerance * sizes[i][c]) continue;
      return aircraft + "number " + std::to_string(c) + " is " + std::to_string(rows[i][c]) +
             " and " + std::to_string(scalar[i][c]);
    }
  }
  return "";
}

/// Throws std::logic_error if there is a `disagreement` of a target with the scalar one.
void RequireNone(const std::string& disagreement, Target target, const char* what) {
  if (disagreement.empty()) return;
  throw std::logic_error(std::string(Name(target)) + " and scalar, " + what + disagreement);
}

void Compare(Target target, const char* what, const Rows& rows, const Rows& scalar,
             const Rows& sizes, double tolerance) {
  RequireNone(Disagreement(rows, scalar, sizes, tolerance), target, what);
}

Rows RowsOf(TestTile& tile, int columns) {
  Rows rows(static_cast<std::size_t>(tile.count()));
  for (int i = 0; i < tile.count(); ++i) {
    std::vector<float>& row = rows[static_cast<std::size_t>(i)];
    row.reserve(static_cast<std::size_t>(columns));
    for (int c = 0; c < columns; ++c) row.push_back(tile.at(c, i));
  }
  return rows;
}

/// `share` of the largest number of each column.
std::vector<float> ScaleOf(const Rows& rows, float share) {
  std::vector<float> scale(rows.front().size());
  for (const std::vector<float>& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      scale[c] = std::max(scale[c], share * std::abs(row[c]));
    }
  }
  return scale;
}

constexpr float kPi = 3.14159265f;

enum PlantInput : std::size_t { kSpeed, kAlpha, kBeta, kFirstAngle = 9, kFirstControl = 12 };

// Speed, angles of attack and sideslip; angular rates; position; roll, pitch, yaw; thrust and
// surfaces; power and its command: in and beyond the flight envelope of the F-16.
constexpr Bounds kPlantBounds[] = {{150, 1500},    {-0.52f, 1.75f}, {-0.7f, 0.7f},   {-2, 2},
                                   {-2, 2},        {-2, 2},         {-3e4f, 3e4f},   {-3e4f, 3e4f},
                                   {-6e4f, 0},     {-kPi, kPi},     {-kPi, kPi},     {-kPi, kPi},
                                   {-3000, 28000}, {-27.5f, 27.5f}, {-21.5f, 21.5f}, {-30, 30},
                                   {0, 25},        {0, 100},        {0, 100}};
constexpr std::size_t kPlantWords = std::size(kPlantBounds);
constexpr int kControls = 5, kCoefficients = 6, kStepped = kPowerCommand + 1;

struct PlantRows {
  Rows rates, coefficients, stepped;
};

/// Without coefficients and rates of aircraft that are not finite after a step: tables take NaN for
/// one of their bounds, another one on each target.
PlantRows OfFiniteAircraft(PlantRows rows) {
  for (std::size_t i = 0; i < rows.stepped.size(); ++i) {
    if (IsFinite(rows.stepped[i])) continue;
    rows.rates[i].clear();
    rows.coefficients[i].clear();
  }
  return rows;
}

void SetVelocity(const std::array<float, kPlantWords>& input, TestTile& tile, int i) {
  const float alpha = input[kAlpha], beta = input[kBeta];
  tile.at(kU, i) = input[kSpeed] * std::cos(alpha) * std::cos(beta);
  tile.at(kV, i) = input[kSpeed] * std::sin(beta);
  tile.at(kW, i) = input[kSpeed] * std::sin(alpha) * std::cos(beta);
}

void SetAttitude(const std::array<float, kPlantWords>& input, TestTile& tile, int i) {
  std::array<float, 3> c{}, s{};
  for (std::size_t k = 0; k < 3; ++k) {
    c[k] = std::cos(input[kFirstAngle + k] / 2);
    s[k] = std::sin(input[kFirstAngle + k] / 2);
  }
  tile.at(kQ0, i) = c[0] * c[1] * c[2] + s[0] * s[1] * s[2];
  tile.at(kQx, i) = s[0] * c[1] * c[2] - c[0] * s[1] * s[2];
  tile.at(kQy, i) = c[0] * s[1] * c[2] + s[0] * c[1] * s[2];
  tile.at(kQz, i) = c[0] * c[1] * s[2] - s[0] * s[1] * c[2];
}

/// Aircraft of the records: all that the kernels read of them.
struct PlantInputs {
  explicit PlantInputs(const Records& records)
      : states(records.count()), controls(records.count(), kControls) {
    for (int i = 0; i < records.count(); ++i) Set(records, i);
  }

  void Set(const Records& records, int i) {
    std::array<float, kPlantWords> input{};
    for (std::size_t k = 0; k < kPlantWords; ++k) {
      input[k] = Value(records.at(i, k), kPlantBounds[k]);
    }
    SetVelocity(input, states, i);
    for (int k = 0; k < 6; ++k) states.at(kP + k, i) = input[3 + static_cast<std::size_t>(k)];
    SetAttitude(input, states, i);
    for (int k = 0; k < kControls; ++k) {
      controls.at(k, i) = input[kFirstControl + static_cast<std::size_t>(k)];
    }
    for (int k = 1; k < kControls; ++k) states.at(kPowerCommand + k, i) = controls.at(k, i);
    states.at(kPower, i) = input[kPlantWords - 2];
    states.at(kPowerCommand, i) = input[kPlantWords - 1];
  }

  TestTile states, controls;
};

PlantRows Fly(Target target, const PlantInputs& inputs) {
  static const auto aircraft =
      MakeKernelAircraft(LoadAircraft("f16"), AtmosphereModel::kStevensLewis);
  constexpr float kDt = 0.02f;
  const ScopedTarget scoped(target);
  PlantInputs flown = inputs;
  TestTile rates(flown.states.count(), kNumRigidBody);
  TestTile coefficients(flown.states.count(), kCoefficients);
  const Tile controls = flown.controls.tile();
  EvaluateTile(*aircraft, flown.states.tile(),
               {controls[0], controls[1], controls[2], controls[3], controls[4]}, rates.tile().base,
               coefficients.tile().base);
  StepTile(*aircraft, flown.states.tile(), kDt, 1);
  return OfFiniteAircraft({RowsOf(rates, kNumRigidBody), RowsOf(coefficients, kCoefficients),
                           RowsOf(flown.states, kStepped)});
}

/// Below this share of what random flights reach a number is held to the rounding of that.
constexpr float kScaleShare = 1e-2f;

struct PlantScale {
  std::vector<float> rates, coefficients, stepped;
};

PlantScale ScaleOfPlants() {
  const std::string file = RandomRecords(Records::kMost, kPlantWords);
  const PlantRows rows = Fly(Target::kScalar, PlantInputs(Records(file, kPlantWords)));
  return {ScaleOf(rows.rates, kScaleShare), ScaleOf(rows.coefficients, kScaleShare),
          ScaleOf(rows.stepped, kScaleShare)};
}

constexpr int kObservations = 22, kActions = 4, kUnits = 20;
constexpr std::size_t kNetworkWords = kObservations + kUnits;
constexpr Bounds kObservationBounds{-10, 10}, kStateBounds{-1, 1};

/// Made once for each target: that takes far longer than to act.
const RecurrentPolicy& PolicyOf(Target target) {
  static std::map<Target, RecurrentPolicy> policies;
  const auto found = policies.find(target);
  if (found != policies.end()) return found->second;
  NetworkConfig config;
  config.hidden_size = config.gru_size = kUnits;
  config.actor_head_scale = 1;
  auto policy = RecurrentPolicy::Untrained(config, kObservations, kActions, 1);
  return policies.emplace(target, std::move(policy)).first->second;
}

/// Of means and state, [record][kActions + kUnits]. The k-th observation is larger by
/// `rounding`(k), a share of it.
template <class Rounding>
Rows Act(Target target, const Records& records, const Rounding& rounding) {
  const ScopedTarget scoped(target);
  const RecurrentPolicy& policy = PolicyOf(target);
  const auto count = static_cast<std::size_t>(records.count());
  std::vector<float> observation, state, mean(count * kActions);
  for (int i = 0; i < records.count(); ++i) {
    for (std::size_t k = 0; k < kNetworkWords; ++k) {
      if (k < kObservations) {
        const float value = Value(records.at(i, k), kObservationBounds);
        observation.push_back(value * (1 + rounding(k)));
      } else {
        state.push_back(Value(records.at(i, k), kStateBounds));
      }
    }
  }
  policy.ActionMean(records.count(), observation.data(), state.data(), mean.data());
  Rows rows(count);
  for (std::size_t i = 0; i < count; ++i) {
    rows[i].assign(mean.begin() + static_cast<std::ptrdiff_t>(i * kActions),
                   mean.begin() + static_cast<std::ptrdiff_t>((i + 1) * kActions));
    rows[i].insert(rows[i].end(), state.begin() + static_cast<std::ptrdiff_t>(i * kUnits),
                   state.begin() + static_cast<std::ptrdiff_t>((i + 1) * kUnits));
  }
  return rows;
}

Rows Act(Target target, const Records& records) {
  return Act(target, records, [](std::size_t) { return 0.0f; });
}

/// `sizes`, or what of `tolerance` each number of `scalar`, which Act gives of the records, moves
/// by where two targets round observations, if that is more. Where few units of a layer are active,
/// and hardly, its normalisation makes much of the rounding of what came before.
Rows SizesWhereRounded(const Records& records, const Rows& scalar, Rows sizes, double tolerance) {
  constexpr std::uint32_t kTrials = 16;
  constexpr double kTargets = 2;  // each of the two that are compared rounds as much
  constexpr float kRounding = std::numeric_limits<float>::epsilon();
  for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
    std::mt19937 random(trial);
    std::array<float, kObservations> rounding{};
    for (float& share : rounding) share = random() % 2 == 0 ? kRounding : -kRounding;
    const Rows rows =
        Act(Target::kScalar, records, [&rounding](std::size_t k) { return rounding[k]; });
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      for (std::size_t c = 0; c < sizes[i].size(); ++c) {
        const double moved = kTargets * std::abs(rows[i][c] - scalar[i][c]);
        sizes[i][c] = std::max(sizes[i][c], static_cast<float>(moved / tolerance));
      }
    }
  }
  return sizes;
}

}  // namespace

std::vector<std::string> PlantSeeds() { return SeedsOf(kPlantWords); }

std::string WholePlantRecords(std::string file) { return Whole(std::move(file), kPlantWords); }

void ComparePlants(const std::string& file) {
  // Each is within 2e-4 of the float64 plant, a step within 2e-5 (plant_kernel_test).
  constexpr double kPoint = 4e-4, kStep = 4e-5;
  static const PlantScale scale = ScaleOfPlants();
  PlantInputs inputs(Records(file, kPlantWords));
  const PlantRows scalar = Fly(Target::kScalar, inputs);
  // What a step adds may leave little of a state: the rounding is of what was there before, too.
  const Rows stepped =
      Larger(RowsOf(inputs.states, kStepped), SizesOf(scalar.stepped, scale.stepped));
  const Rows rates = SizesOf(scalar.rates, scale.rates);
  const Rows coefficients = SizesOf(scalar.coefficients, scale.coefficients);
  for (const Target target : simd::SupportedTargets()) {
    if (target == Target::kScalar) continue;
    const PlantRows rows = Fly(target, inputs);
    Compare(target, "the state after a step", rows.stepped, scalar.stepped, stepped, kStep);
    Compare(target, "rates", rows.rates, scalar.rates, rates, kPoint);
    Compare(target, "coefficients", rows.coefficients, scalar.coefficients, coefficients, kPoint);
  }
}

std::vector<std::string> NetworkSeeds() { return SeedsOf(kNetworkWords); }

std::string WholeNetworkRecords(std::string file) { return Whole(std::move(file), kNetworkWords); }

void CompareNetworks(const std::string& file) {
  // Of numbers of size one: sums of some dozen terms in other orders, through four layers.
  constexpr double kTolerance = 2e-5;
  static const std::vector<float> scale(kActions + kUnits, 1.0f);
  const Records records(file, kNetworkWords);
  const Rows scalar = Act(Target::kScalar, records);
  const Rows sizes = SizesOf(scalar, scale);
  for (const Target target : simd::SupportedTargets()) {
    if (target == Target::kScalar) continue;
    const Rows rows = Act(target, records);
    std::string disagreement = Disagreement(rows, scalar, sizes, kTolerance);
    if (!disagreement.empty()) {
      // Seldom: the networks' own rounding is as large as that of what they are given.
      const Rows rounded = SizesWhereRounded(records, scalar, sizes, kTolerance);
      disagreement = Disagreement(rows, scalar, rounded, kTolerance);
    }
    RequireNone(disagreement, target, "means and state");
  }
}

}  // namespace skein
