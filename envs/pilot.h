#pragma once

namespace skein {

/// Something that flies aircraft by what they observe: a trained policy, an autopilot. Immutable,
/// and safe to use from several threads: what it remembers of each aircraft lies with the caller.
class Pilot {
 public:
  virtual ~Pilot() = default;

  virtual int observation_size() const = 0;
  virtual int action_size() const = 0;
  virtual int state_size() const = 0;     ///< floats of memory per aircraft
  virtual int action_repeat() const = 0;  ///< control steps for which it means an action to be held

  /// One decision for `count` aircraft: reads observation [count][observation_size], updates state
  /// [count][state_size], in which a row of zeros is the beginning of an episode, and writes action
  /// [count][action_size]. Every aircraft's action depends on its own rows alone.
  virtual void Fly(int count, const float* observation, float* state, float* action) const = 0;
};

}  // namespace skein
