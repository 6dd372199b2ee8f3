// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/container_readers.h"

#include <cstdint>
#include <stdexcept>

#include "base/error.h"
#include "base/fnv_hash.h"
#include "src/files/output_file.h"
#include "tests/fuzz/fuzzed_file.h"
#include "tests/scratch_directory.h"
#include "tests/train/small_config.h"
#include "train/policy/recurrent_policy.h"
#include "train/ppo/trainer.h"

namespace skein {
namespace {

constexpr std::size_t kLengthBytes = 8, kDigits = 16;

std::uint64_t HeaderLength(const std::string& file) {
  std::uint64_t length = 0;
  for (std::size_t i = 0; i < kLengthBytes; ++i) {
    length |= std::uint64_t{static_cast<unsigned char>(file[i])} << (8 * i);
  }
  return length;
}

TrainConfig FuzzedTraining() {
  TrainConfig config = SmallConfig();
  config.network.hidden_size = config.network.gru_size = 4;
  config.ppo.num_aircraft = 32;
  config.ppo.minibatches = 1;
  config.evaluation.interval_iterations = 0;
  config.env.plant.sensor_freeze_chance = 0.5;  // the sensor is an index in the checkpoint
  return config;
}

WorkerPool& OneWorker() {
  static WorkerPool pool(1);
  return pool;
}

/// Made once: to make one takes longer than to read a checkpoint.
struct KeptTraining {
  KeptTraining() { trainer.Save(beginning, ""); }

  /// Throws std::logic_error if what came before has left a trace.
  void BeginAgain() {
    trainer.Restore(beginning);
    if (trainer.Signature() != signature) {
      throw std::logic_error("a checkpoint that was taken is not undone by another one");
    }
  }

  const ScratchDirectory scratch;
  const std::string beginning = scratch / "beginning.skein";
  Trainer trainer{FuzzedTraining(), OneWorker()};
  const std::uint64_t signature = trainer.Signature();
};

/// Restores a training of signature `before` from `file`. Throws std::logic_error if that is
/// refused, and yet has changed the training.
void RestoreOrLeave(Trainer& trainer, std::uint64_t before, const std::string& file) {
  try {
    trainer.Restore(InFile(file, ".skein"));
  } catch (const Error&) {
    if (trainer.Signature() != before) {
      throw std::logic_error("a refused checkpoint has changed the training");
    }
    throw;
  }
}

}  // namespace

std::string RepairedContainer(std::string file) {
  if (file.size() < kLengthBytes) return file;
  std::uint64_t length = HeaderLength(file);
  if (length > file.size() - kLengthBytes || file[kLengthBytes + length - 1] == '}') {
    const std::size_t end = file.find("}}", kLengthBytes);
    if (end == std::string::npos) return file;
    length = end + 2 - kLengthBytes;
    for (std::size_t i = 0; i < kLengthBytes; ++i) file[i] = static_cast<char>(length >> (8 * i));
  }
  const std::string field = "\"checksum\":\"";
  const std::size_t place = file.find(field, kLengthBytes);
  if (place == std::string::npos || place + field.size() + kDigits > kLengthBytes + length) {
    return file;
  }
  file.replace(place + field.size(), kDigits, kDigits, '0');
  FnvHash hash;
  hash.Add(file.data() + kLengthBytes, file.size() - kLengthBytes);
  return file.replace(place + field.size(), kDigits, hash.Hex());
}

std::vector<std::string> PolicySeeds() {
  NetworkConfig network;
  network.hidden_size = network.gru_size = 4;
  const std::string path = InFile("", ".skein");
  RecurrentPolicy::Untrained(network, 22, 4, 1).Save(path);
  return {ReadFile(path)};
}

void ReadPolicy(const std::string& file) { RecurrentPolicy::Load(InFile(file, ".skein")); }

std::vector<std::string> CheckpointSeeds() {
  Trainer trainer(FuzzedTraining(), OneWorker());
  trainer.Iterate();
  const std::string path = InFile("", ".skein");
  trainer.Save(path, "100 0123456789abcdef");
  return {ReadFile(path)};
}

void ReadCheckpoint(const std::string& file) {
  static KeptTraining kept;
  RestoreOrLeave(kept.trainer, kept.signature, file);
  try {
    if (!kept.trainer.finished()) kept.trainer.Iterate();
  } catch (const Error&) {
    kept.BeginAgain();
    throw;
  }
  kept.BeginAgain();
}

}  // namespace skein
