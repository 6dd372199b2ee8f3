# SPDX-License-Identifier: Apache-2.0
"""Skein's aircraft for Stable-Baselines3 and sb3-contrib (pip install "skein-flight[sb3]").

    from stable_baselines3 import PPO
    import skein.sb3
    envs = skein.sb3.VecEnv(skein.make_vec("heading", 256, preset="easy"))
    PPO("MlpPolicy", envs).learn(1_000_000)
"""
from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from stable_baselines3.common import vec_env
from stable_baselines3.common.monitor import Monitor

from skein._skein import ConfigurationError
from skein.environment import FlightVectorEnv


class VecEnv(vec_env.VecEnv):
    """A skein.FlightVectorEnv by the rules of Stable-Baselines3.

    When an episode ends, its info has "terminal_observation", "TimeLimit.truncated", "termination" (the reason's
    name), "is_success", and "episode" with its return "r" and length "l", policy steps, as Monitor writes them.
    """

    def __init__(self, envs: FlightVectorEnv) -> None:
        if not isinstance(envs, FlightVectorEnv):
            raise ConfigurationError(f"envs must be what skein.make_vec gives, not {type(envs).__name__}")
        self.envs = envs
        self._repeat = envs.config["env.action_repeat"]
        self._actions = np.zeros(0, np.float32)
        super().__init__(envs.num_envs, envs.single_observation_space, envs.single_action_space)

    def reset(self) -> vec_env.base_vec_env.VecEnvObs:
        """Begins episodes: those of the seed if seed() was called, else the next ones."""
        options = next((asked for asked in self._options if asked), None)
        observation, _ = self.envs.reset(seed=self._seeds[0], options=options)
        self._reset_seeds()
        self._reset_options()
        return observation

    def step_async(self, actions: Any) -> None:
        self._actions = actions

    def step_wait(self) -> vec_env.base_vec_env.VecEnvStepReturn:
        observation, reward, terminated, truncated, info = self.envs.step(self._actions)
        infos: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        over = terminated | truncated
        for i in np.flatnonzero(over):
            final = info["final_info"]
            infos[i] = {
                "terminal_observation": info["final_obs"][i],
                "TimeLimit.truncated": bool(truncated[i]),
                "termination": final["termination"][i],
                "is_success": final["termination"][i] == "target_reached",
                "episode": {
                    "r": float(final["episode_return"][i]),
                    "l": -(-int(final["episode_control_steps"][i]) // self._repeat),
                },
            }
        return observation, reward, over, infos

    def close(self) -> None:
        self.envs.close()

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        return [getattr(self.envs, attr_name)] * len(self._chosen(indices))

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        raise AttributeError(f"{attr_name}: the aircraft of a skein.FlightVectorEnv have no attributes of their own")

    def env_method(self, method_name: str, *args: Any, indices: Any = None, **kwargs: Any) -> list[Any]:
        raise AttributeError(f"{method_name}: the aircraft of a skein.FlightVectorEnv have no methods of their own")

    def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> list[bool]:
        # Its infos have what Monitor would add: evaluate_policy then takes the returns of whole episodes from there.
        return [wrapper_class is Monitor] * len(self._chosen(indices))

    def _chosen(self, indices: int | Iterable[int] | None) -> Sequence[int]:
        return list(self._get_indices(indices))
