# SPDX-License-Identifier: Apache-2.0
# The public API: the only headers that are installed, under include/skein/. What one of them includes must be here, too.
set(SKEIN_PUBLIC_HEADERS
    # What all rooms share.
    base/error.h
    base/range.h
    base/worker_pool.h
    # Thousands of aircraft at once.
    envs/actions.h
    envs/control_step.h
    envs/env_config.h
    envs/flight_metrics.h
    envs/high_level_config.h
    envs/initial_config.h
    envs/plant/plant_config.h
    envs/policy.h
    envs/state/state.h
    envs/step_memory.h
    envs/step_output.h
    envs/tasks/control_config.h
    envs/tasks/episode_progress.h
    envs/tasks/handling_costs.h
    envs/tasks/heading_config.h
    envs/tasks/mission_config.h
    envs/tasks/task_errors.h
    envs/tasks/termination.h
    envs/tasks/termination_config.h
    envs/tasks/terms/term_task_config.h
    envs/tasks/terms/term_values.h
    envs/tasks/tracking_config.h
    envs/vec_env.h
    envs/wind/wind_config.h
    # Aircraft, autopilots and the air.
    envs/air/atmosphere.h
    envs/air/gravity.h
    envs/aircraft/aerodynamic_tables.h
    envs/aircraft/aircraft.h
    envs/aircraft/engine.h
    envs/aircraft/flight_control_gains.h
    envs/aircraft/registry.h
    envs/autopilot/autopilot.h
    envs/autopilot/gains.h
    envs/autopilot/level_throttle.h
    # One aircraft in float64.
    envs/reference/closed_loop.h
    envs/reference/flight_control.h
    envs/reference/linear_flight.h
    envs/reference/linearise.h
    envs/reference/plant.h
    envs/reference/trim.h
    envs/tuning/linear_modes.h)

if(SKEIN_BUILD_TRAIN)
  list(
    APPEND
    SKEIN_PUBLIC_HEADERS
    # Policies: load, fly, evaluate, record.
    train/measures/flight_measures.h
    train/network/backend.h
    train/network/network_config.h
    train/policy/agent.h
    train/policy/evaluate.h
    train/policy/record_flights.h
    train/policy/recurrent_policy.h
    train/policy/stored_policy.h
    train/policy/tile_agent.h
    # Training.
    train/ppo/learner_config.h
    train/ppo/ppo_config.h
    train/ppo/train_config.h
    train/ppo/trainer.h
    train/ranks/ranks.h)
endif()
