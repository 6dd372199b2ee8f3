// SPDX-License-Identifier: Apache-2.0
// Where the time of a tile goes: every part of what a network does with a tile of an update or of
// a rollout, on one core, with its share of the peak. Tiles of all precisions take turns with each
// other, with the network itself, and with the measurements of the peak. Times are lower quartiles
// over the turns (of fewer than four the least): other programs take the processor from a long part
// more often than from a short one. --json writes every turn's times, as skein bench does.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/denormals.h"
#include "base/error.h"
#include "bench/seconds_of.h"
#include "bench/tile_parts.h"
#include "simd/peak.h"
#include "simd/target.h"
#include "src/bench/figure.h"
#include "src/bench/machine.h"
#include "src/files/output_file.h"
#include "train/network/fused_network.h"

namespace skein::bench {
namespace {

using simd::Precision;

constexpr std::size_t kParts = static_cast<std::size_t>(TilePart::kCount);

double LowerQuartile(std::vector<double> values) {
  const auto quartile = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4);
  std::nth_element(values.begin(), quartile, values.end());
  return *quartile;
}

/// The best of the roofs of one core so far, FLOP/s.
struct Roofs {
  std::map<Precision, double> best;

  void Measure() {
    for (const Precision precision :
         {Precision::kFloat32, Precision::kBfloat16, Precision::kTiles, Precision::kSplitTiles}) {
      double& peak = best[precision];
      peak = std::max(peak, 1e9 * simd::MeasureProductPeak(precision, 1).gflops_per_core);
    }
  }
  double Of(Precision precision) const { return best.at(precision); }
};

bool IsBitEqual(const AlignedVector<float>& values, const float* others) {
  return std::memcmp(values.data(), others, values.size() * sizeof(float)) == 0;
}

/// "GRU: LayerNorm" as "gru_layernorm": a part of a figure's name.
std::string InFigureName(const std::string& text) {
  std::string name;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  return name;
}

bool IsForward(TilePart part) {
  return part == TilePart::kHiddenForward || part == TilePart::kGateInputForward ||
         part == TilePart::kGateStateForward;
}

/// Tiles of `steps` x `batch` samples in one precision.
class Tiles {
 public:
  Tiles(const char* name, const NetworkPrecision& precision, int steps, int batch, bool backward)
      : name_(name),
        precision_(precision),
        backward_(backward),
        replay_(precision, steps, batch),
        network_(replay_.layout(), precision),
        accumulator_(network_.accumulator_size()) {
    network_.SetParameters(replay_.parameters().data());
  }

  void Turn() {
    const TileReplay::Seconds seconds = replay_.Run(backward_);
    for (std::size_t i = 0; i < kParts; ++i) parts_[i].push_back(seconds[i]);
    whole_.push_back(SecondsOf([&] {
      if (backward_) {
        network_.AccumulateGradient(replay_.tile(), replay_.settings(), workspace_,
                                    accumulator_.data());
      } else {
        network_.Forward(replay_.tile().sequence, workspace_);
      }
    }));
  }

  /// After as many turns of both: throws Error unless the parts compute what the network does, bit
  /// for bit, and count its operations.
  void CheckParts() const {
    const auto require = [this](bool holds, const char* what) {
      if (holds) return;
      throw Error(std::string("bench_tile: ") + name_ + ": " + what +
                  " of the parts is not FusedNetwork's; make bench/tile_parts.cpp follow "
                  "train/network/fused_network.cpp");
    };
    const AlignedVector<float>&output = replay_.output(), &gradient = replay_.gradient();
    require(IsBitEqual(output, workspace_.output()), "the output");
    if (!backward_) return;
    require(gradient.size() == accumulator_.size() && IsBitEqual(gradient, accumulator_.data()),
            "the gradient");
    double flops = 0;
    for (std::size_t i = 0; i < kParts; ++i) flops += replay_.Flops(static_cast<TilePart>(i));
    const SequenceTile& tile = replay_.tile().sequence;
    const double of_sample =
        ForwardFlops(replay_.layout()) + BackwardFlops(replay_.layout(), tile.steps);
    require(flops == static_cast<double>(tile.rows()) * of_sample, "the number of operations");
  }

  /// Microseconds of every turn: "fp32_update_loss_us", and "fp32_update_us" of the network itself.
  void AddFigures(std::vector<Figure>* figures) const {
    const std::string tile = InFigureName(name_) + (backward_ ? "_update" : "_rollout");
    const auto add = [&](const std::string& name, std::vector<double> seconds) {
      for (double& each : seconds) each *= 1e6;
      figures->push_back({name + "_us", false, std::move(seconds)});
    };
    for (std::size_t i = 0; i < kParts; ++i) {
      if (LowerQuartile(parts_[i]) == 0) continue;
      add(tile + "_" + InFigureName(Name(static_cast<TilePart>(i))), parts_[i]);
    }
    add(tile, whole_);
  }

  void Print(const Roofs& roofs) const {
    const double whole = LowerQuartile(whole_);
    double sum = 0, at_peak = 0;
    std::printf("\n%s, %s of %d x %d samples\n%-38s %9s %9s %9s\n", name_,
                backward_ ? "an update's tile" : "a rollout's step", replay_.tile().sequence.steps,
                replay_.tile().sequence.batch, "", "us", "% of it", "% of peak");
    for (std::size_t i = 0; i < kParts; ++i) {
      const auto part = static_cast<TilePart>(i);
      const double seconds = LowerQuartile(parts_[i]);
      if (seconds == 0) continue;
      const double ideal = SecondsAtPeak(part, roofs);
      sum += seconds;
      at_peak += ideal;
      PrintRow(Name(part), seconds, whole, ideal);
    }
    PrintRow("all parts", sum, whole, at_peak);
    PrintRow("the network, without clocks", whole, whole, at_peak);
  }

 private:
  /// What the part's products would take there.
  double SecondsAtPeak(TilePart part, const Roofs& roofs) const {
    const double flops = replay_.Flops(part);
    const double forward = roofs.Of(precision_.forward), backward = roofs.Of(precision_.backward);
    if (part != TilePart::kHead) return flops / (IsForward(part) ? forward : backward);
    return flops / 3 * (1 / forward + (backward_ ? 2 / backward : 0));
  }

  static void PrintRow(const char* name, double seconds, double whole, double ideal) {
    std::printf("%-38s %9.1f %9.1f", name, 1e6 * seconds, 100 * seconds / whole);
    if (ideal > 0) std::printf(" %9.1f", 100 * ideal / seconds);
    std::printf("\n");
  }

  const char* name_;
  NetworkPrecision precision_;
  bool backward_;
  TileReplay replay_;
  FusedNetwork network_;
  NetworkWorkspace workspace_;
  AlignedVector<float> accumulator_;
  std::array<std::vector<double>, kParts> parts_;
  std::vector<double> whole_;
};

void WriteFigures(const std::string& path, int rounds, const Roofs& roofs,
                  const std::vector<Tiles>& tiles) {
  std::vector<Figure> figures;
  for (const Tiles& each : tiles) each.AddFigures(&figures);
  WriteJson(path, {{"benchmark", "tile"},
                   {"peak_gflops",
                    {{"float32", roofs.Of(Precision::kFloat32) / 1e9},
                     {"bfloat16", roofs.Of(Precision::kBfloat16) / 1e9},
                     {"tiles", roofs.Of(Precision::kTiles) / 1e9}}},
                   {"figures", ToJson(figures)},
                   {"settings", {{"rounds", rounds}}},
                   {"threads", 1},
                   {"machine", DescribeMachine()}});
}

void Run(int rounds, const std::string& json) {
  const DenormalsFlushed flushed;
  constexpr NetworkPrecision kFloat32, kMixed{Precision::kFloat32, Precision::kBfloat16},
      kBfloat16{Precision::kBfloat16, Precision::kBfloat16},
      kTiles{Precision::kTiles, Precision::kTiles},
      kSplit{Precision::kSplitTiles, Precision::kTiles};
  std::vector<Tiles> tiles;
  tiles.reserve(9);
  tiles.emplace_back("fp32", kFloat32, 8, 48, true);
  tiles.emplace_back("mixed", kMixed, 8, 48, true);
  tiles.emplace_back("bf16", kBfloat16, 8, 48, true);
  tiles.emplace_back("fp32", kFloat32, 1, 256, false);
  tiles.emplace_back("bf16", kBfloat16, 1, 256, false);
  if (simd::NativeTiles()) {
    tiles.emplace_back("amx, critic", kTiles, 8, 48, true);
    tiles.emplace_back("amx, actor", kSplit, 8, 48, true);
    tiles.emplace_back("amx, critic", kTiles, 1, 256, false);
    tiles.emplace_back("amx, actor", kSplit, 1, 256, false);
  }
  Roofs roofs;
  for (int round = 0; round < rounds; ++round) {
    if (round % 50 == 0) roofs.Measure();
    for (Tiles& each : tiles) {
      each.Turn();
      if (round == 0) each.CheckParts();
    }
  }
  std::printf(
      "SIMD target %s\npeak of a core: %.1f GFLOP/s in float32, %.1f in bfloat16, %.1f in tiles\n",
      simd::Name(simd::ActiveTarget()), roofs.Of(Precision::kFloat32) / 1e9,
      roofs.Of(Precision::kBfloat16) / 1e9, roofs.Of(Precision::kTiles) / 1e9);
  for (const Tiles& each : tiles) each.Print(roofs);
  if (!json.empty()) WriteFigures(json, rounds, roofs, tiles);
}

/// What the command line asks for; its exit code.
int RunCommand(int argc, char** argv) {
  CLI::App app("The time of a tile of the learner, part by part, beside the peak of a core");
  int rounds = 200;
  std::string json;
  app.add_option("ROUNDS", rounds, "turns of every tile")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--json", json, "write the times of every turn here")->type_name("FILE");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  CheckWritable(json);
  Run(rounds, json);
  return 0;
}

}  // namespace
}  // namespace skein::bench

int main(int argc, char** argv) {
  try {
    return skein::bench::RunCommand(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
