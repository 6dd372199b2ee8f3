// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace skein {

/// Part of the exploration that stays the same for some policy steps. What acts slowly, as a
/// throttle does on the airspeed, shows little of noise that is drawn anew every step: it averages
/// out. Each step's deviates are standard normal all the same, and a policy's probabilities are
/// those of the step alone, as in gSDE (Raffin et al. 2021).
struct HeldNoise {
  double share = 0;  ///< of the variance; 0: none
  int steps = 10;    ///< for which it is held
  int actions = 1;   ///< of the first so many, or of all (envs/interface_names.h)
};

/// What the deviates of one policy step of an environment's aircraft are drawn with.
struct ActionNoiseKey {
  std::uint64_t seed = 0;
  std::uint32_t first_aircraft = 0;
  std::uint64_t policy_step = 0;  ///< since training began
  HeldNoise held;
};

/// Memory that calls share.
struct ActionNoiseScratch {
  std::vector<std::uint32_t> step_low, step_high;
  std::vector<float> held;
};

/// Standard normal deviates, noise[i * size + j], for the actions of `count` aircraft in one policy
/// step. Held ones change at another step for each aircraft, and depend on nothing but the key.
void FillActionNoise(const ActionNoiseKey& key, int count, int size, ActionNoiseScratch& scratch,
                     float* noise);

}  // namespace skein
