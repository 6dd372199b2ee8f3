# SPDX-License-Identifier: Apache-2.0
import copy
import json
import pickle

import numpy as np
import pytest
from conftest import ROOT

import skein
from skein.flight_dynamics import CONTROL_NAMES, STATE_NAMES


def test_a_trim_is_steady():
    trim = skein.trim(15000, 500)
    assert trim.residual < 1e-6
    assert not trim.exceeded_limits
    flight = skein.simulate(trim, trim.controls, duration_s=1)
    assert len(flight.time_s) == len(flight.states) == 51
    np.testing.assert_allclose(flight["down_ft"], -15000, atol=1e-3)
    np.testing.assert_allclose(flight["north_ft"][-1], 500, rtol=1e-6)


def test_names_of_states_and_controls_are_the_packages():
    assert skein.STATE_NAMES == STATE_NAMES and skein.CONTROL_NAMES == CONTROL_NAMES
    trim = skein.trim(15000, 500)
    state, controls = dict(zip(skein.STATE_NAMES, trim.state)), dict(zip(skein.CONTROL_NAMES, trim.controls))
    assert trim.state.shape == (len(STATE_NAMES),) and trim.controls.shape == (len(CONTROL_NAMES),)
    assert state["down_ft"] == -15000 and np.hypot(state["u_fps"], state["w_fps"]) == pytest.approx(500)
    assert 0 < controls["thrust_lbf"] < trim.available_thrust_lbf
    flight = skein.simulate(trim, trim.controls + np.eye(5)[skein.CONTROL_NAMES.index("elevator_deg")], duration_s=0.1)
    assert flight["q_rad_s"][-1] < -1e-3  # trailing edge down: nose down


def test_a_trim_is_pickled_and_compared():
    trim = skein.trim(3000, 180, aircraft="cessna172", turn_rate_deg_s=3)
    for again in (pickle.loads(pickle.dumps(trim)), copy.copy(trim), copy.deepcopy(trim)):
        np.testing.assert_array_equal(again.state, trim.state)
        assert again.exceeded_limits == trim.exceeded_limits and repr(again) == repr(trim)
        np.testing.assert_array_equal(skein.linearise(again).A, skein.linearise(trim).A)
        models = skein.linear_models(again)
        np.testing.assert_array_equal(models["bare_airframe"]["A"], skein.linear_models(trim)["bare_airframe"]["A"])
        assert again != trim and trim == trim and len({again, trim}) == 2  # arrays are not compared


def test_a_turn_turns():
    turn = skein.trim(15000, 500, turn_rate_deg_s=6)
    assert turn.bank_deg > 40
    flight = skein.simulate(turn, turn.controls, duration_s=5)
    heading = np.degrees(np.arctan2(np.diff(flight["east_ft"]), np.diff(flight["north_ft"])))
    np.testing.assert_allclose(heading[-1] - heading[0], 6 * 0.02 * (len(heading) - 1), rtol=1e-3)


def test_the_linear_model_is_the_derivative():
    trim = skein.trim(15000, 500)
    model = skein.linearise(trim)
    assert model.A.shape == (13, 13) and model.B.shape == (13, 5)
    nudge = np.zeros(5)
    nudge[CONTROL_NAMES.index("elevator_deg")] = 1e-3
    dt = 1e-3
    moved, still = (skein.simulate(trim, (trim.controls + n)[None], dt=dt) for n in (nudge, 0))
    rate = (moved.states[-1] - still.states[-1]) / dt
    q = STATE_NAMES.index("q_rad_s")
    np.testing.assert_allclose(rate[q], (model.B @ nudge)[q], rtol=1e-2)
    assert (model.modes().real > -10).all()


def test_the_throttle_of_a_trim_keeps_it_in_an_environment():
    altitude_ft, speed_fps = 15000, 500
    trim = skein.trim(altitude_ft, speed_fps)
    start = {"altitude_min_ft": altitude_ft, "altitude_max_ft": altitude_ft,
             "true_airspeed_min_fps": speed_fps, "true_airspeed_max_fps": speed_fps}
    env = skein.make("heading", evaluation=True, env={"initial": start})
    env.reset(seed=1)
    action = [2 * trim.throttle - 1, 0, 0, 0]
    for _ in range(round(5 / env.policy_step_s)):
        env.step(action)
    state = {name: float(column[0]) for name, column in env.state().items()}
    assert state["power_percent"] == pytest.approx(trim.power, rel=1e-5)
    # A centred stick asks for 1 g, of which the trim's load factor falls short a little.
    assert state["down_ft"] == pytest.approx(-altitude_ft, abs=5)
    assert np.hypot(state["u_fps"], state["w_fps"]) == pytest.approx(speed_fps, abs=0.5)


def test_both_linear_models_are_one_in_the_units_that_they_say():
    trim = skein.trim(15000, 500)
    full, bare = skein.linearise(trim), skein.linear_models(trim)["bare_airframe"]
    names = [[quantity["name"] for quantity in bare[of]] for of in ("states", "inputs")]
    for name in CONTROL_NAMES[1:]:
        mine, theirs = full.B[:, CONTROL_NAMES.index(name)], bare["B"][:, names[1].index(name)]
        for rate in ("p_rad_s", "q_rad_s", "r_rad_s"):
            expected = theirs[names[0].index(rate)]
            assert mine[STATE_NAMES.index(rate)] == pytest.approx(expected, rel=1e-5, abs=1e-9)
    # Thrust, lbf, accelerates along u; power, %, does so by the thrust of a percent, here that between two trims.
    power = bare["B"][names[0].index("true_airspeed_fps"), names[1].index("power")]
    along_u = full.B[STATE_NAMES.index("u_fps"), CONTROL_NAMES.index("thrust_lbf")]
    lower, higher = (skein.trim(15000, 500, flight_path_deg=angle) for angle in (-0.01, 0.01))
    lbf_per_percent = (higher.controls[0] - lower.controls[0]) / (higher.power - lower.power)
    assert power == pytest.approx(along_u * np.cos(np.radians(trim.alpha_deg)) * lbf_per_percent, rel=1e-5)


@pytest.mark.parametrize("aircraft,speed_fps", [("f16", 500), ("cessna172", 180), ("aerosonde", 80)])
def test_five_eigenvalues_of_straight_flight_are_no_modes(aircraft, speed_fps):
    trim = skein.trim(5000, speed_fps, aircraft=aircraft)
    sizes = np.sort(np.abs(skein.linearise(trim).modes()))
    named = [np.hypot(*mode["eigenvalue_per_s"]) for mode in skein.linear_models(trim)["bare_airframe"]["modes"]]
    assert (sizes[:5] < 1e-6).all() and sizes[5] > 1e-3
    assert min(named) > 1e-3


def test_the_aircraft_can_be_another_one():
    aerosonde = skein.trim(3000, 80, aircraft="aerosonde")
    assert 0 < aerosonde.controls[0] < 50
    flight = skein.simulate(aerosonde, aerosonde.controls, duration_s=1)
    np.testing.assert_allclose(flight["down_ft"], -3000, atol=1e-3)


def test_what_cannot_be_flown_says_why():
    with pytest.raises(skein.Error, match="stall"):
        skein.trim(15000, 60)
    with pytest.raises(skein.ConfigurationError, match="stevens_lewis"):
        skein.trim(15000, 500, atmosphere="mars")
    with pytest.raises(skein.Error):
        skein.trim(15000, 500, aircraft="glider")
    with pytest.raises(skein.ConfigurationError, match="duration_s"):
        skein.simulate(skein.trim(15000, 500), np.zeros(5))
    for duration_s, dt in ((-1, 0.02), (0, 0.02), (0.005, 0.02), (1e9, 0.02), (1e300, 1e-300)):
        with pytest.raises(skein.ConfigurationError, match="duration_s must be 1 to"):
            skein.simulate(skein.trim(15000, 500), np.zeros(5), duration_s=duration_s, dt=dt)
    with pytest.raises(skein.Error, match=r"shape \(13,\)"):
        skein.simulate(skein.trim(15000, 500), np.zeros((1, 5)), state=np.zeros(12))


def test_an_own_aircraft_is_trimmed_about_its_own_centre_of_gravity(tmp_path):
    file = tmp_path / "mine.json"
    text = (ROOT / "data" / "cessna172" / "aircraft.json").read_text()
    file.write_text(text.replace('"cg_chord_fraction": 0.3', '"cg_chord_fraction": 0.25'))
    assert file.read_text() != text
    own = skein.trim(3000, 180, aircraft=file)
    np.testing.assert_array_equal(own.controls, skein.trim(3000, 180, aircraft=file, cg=0.25).controls)
    aft = skein.trim(3000, 180, aircraft=file, cg=0.30)
    assert own.controls[1] < aft.controls[1]  # the nose is heavier: elevator further up
    assert abs(own.load_factor_g - 1) < 0.01 and abs(own.beta_deg) < 1e-6
    with pytest.raises(skein.ConfigurationError, match="cg must be a finite number"):
        skein.trim(3000, 180, aircraft=file, cg=float("nan"))


def test_a_pull_up_turns_as_its_load_factor_says():
    pull_up = skein.trim(15000, 600, pull_up_g=3)
    np.testing.assert_allclose(np.linalg.norm(pull_up.state[3:6]), 32.17 * (3 - 1) / 600, rtol=1e-6)
    assert pull_up.load_factor_g > 2.9
    with pytest.raises(skein.ConfigurationError, match="pull-up has level wings"):
        skein.trim(15000, 600, pull_up_g=3, turn_rate_deg_s=4)


def test_gravity_and_drag_rise_are_the_aircrafts_world():
    usual = skein.trim(40000, 800)
    assert skein.trim(40000, 800, gravity_ft_s2=16.085).alpha_deg < 0.6 * usual.alpha_deg
    assert skein.trim(40000, 800, gravity_falls_with_altitude=True).alpha_deg < usual.alpha_deg
    assert skein.trim(40000, 1000, drag_rise=True).drag_coefficient > skein.trim(40000, 1000).drag_coefficient
    light = skein.trim(40000, 800, gravity_ft_s2=16.085)
    flight = skein.simulate(light, light.controls, duration_s=1)
    np.testing.assert_allclose(flight["down_ft"], -40000, atol=1e-3)
    with pytest.raises(skein.ConfigurationError, match="above 0"):
        skein.trim(15000, 500, gravity_ft_s2=0)
    with pytest.raises(skein.ConfigurationError, match="no data of drag rise"):
        skein.trim(3000, 80, aircraft="aerosonde", drag_rise=True)


def test_a_grid_without_a_flight_has_the_figures_of_one_with_flights():
    none, flown = skein.trim_grid([15000], [50]), skein.trim_grid([15000], [500])
    figures = {name for name, value in flown.points[0][0].items() if type(value) in (int, float)}
    for name in sorted(figures - {"altitude_ft", "speed_fps"}):
        assert np.isnan(none[name]).all() and np.isfinite(flown[name]).all()
    with pytest.raises(skein.ConfigurationError, match=", ".join(sorted(figures))):
        none["speed"]


def test_the_arrays_of_a_trim_stay_those_of_the_flight():
    trim = skein.trim(15000, 500)
    for array in (trim.state, trim.controls, pickle.loads(pickle.dumps(trim)).controls):
        with pytest.raises(ValueError, match="read-only"):
            array[1] += 5
    trim.controls.copy()[1] += 5


def test_a_grid_has_the_points_trimmed_alone():
    grid = skein.trim_grid([5000, 15000], np.array([100.0, 500, 700]))
    assert grid.flown.tolist() == [[False, True, True]] * 2
    assert grid.limit[0] == ["below stall speed", "", ""]
    alone = skein.trim(15000, 700)
    for name in ("alpha_deg", "excess_power_fps", "lift_coefficient", "throttle"):
        assert grid[name][1, 2] == getattr(alone, name)
        assert np.isnan(grid[name][0, 0])
    for named, says in ((grid, "no figure"), (skein.simulate(alone, alone.controls, duration_s=0.1), "no state")):
        with pytest.raises(KeyError, match=f"^'speed': {says}; there are ") as raised:
            named["speed"]
        assert isinstance(raised.value, skein.ConfigurationError)
    with pytest.raises(skein.ConfigurationError, match="finite numbers"):
        skein.trim_grid([np.nan], [500])
    with pytest.raises(skein.ConfigurationError, match="altitude_ft"):
        skein.trim_grid("high", [500])
    with pytest.raises(skein.ConfigurationError, match="altitude_ft must hold"):
        skein.trim_grid([], [500])
    with pytest.raises(skein.ConfigurationError, match="true_airspeed_fps must hold finite numbers above 0"):
        skein.trim_grid([5000], [500, 0])


def test_linear_models_have_modes_with_names():
    point = skein.trim(15000, 500)
    models = skein.linear_models(point)
    bare = models["bare_airframe"]
    assert bare["A"].shape == (9, 9) and bare["B"].shape[0] == 9
    names = [mode["name"] for mode in bare["modes"]]
    assert names == ["short period", "phugoid", "Dutch roll", "roll", "spiral"]
    # The airframe's modes are those of its matrix with altitude held.
    eigenvalues = np.linalg.eigvals(bare["A"][:8, :8])
    for mode in bare["modes"]:
        assert np.abs(eigenvalues - complex(*mode["eigenvalue_per_s"])).min() < 1e-9
    scheduled = skein.linear_models(point, flap="scheduled")["bare_airframe"]
    assert scheduled["B"].shape[1] == bare["B"].shape[1] - 1
    with pytest.raises(skein.ConfigurationError, match="flap"):
        skein.linear_models(point, flap="loose")


def test_models_with_flight_control_are_of_flight_with_level_wings():
    climb = skein.linear_models(skein.trim(15000, 600, flight_path_deg=10))
    assert set(climb["with_flight_control"]) == {"longitudinal", "lateral"}
    for manoeuvre in ({"turn_rate_deg_s": 8}, {"pull_up_g": 3}):
        models = skein.linear_models(skein.trim(15000, 600, **manoeuvre))
        assert "with_flight_control" not in models
        assert models["bare_airframe"]["A"].shape == (9, 9)


def test_an_unstable_closed_loop_has_no_margins(tmp_path):
    hot = json.loads((ROOT / "data" / "f16" / "aircraft.json").read_text())
    hot["flight_control"]["pitch_proportional_deg_per_g"] *= 6
    (tmp_path / "hot.json").write_text(json.dumps(hot))
    found = skein.flying_qualities(skein.trim(5000, 1000, aircraft=tmp_path / "hot.json"))
    assert found["unstable_mode"]["time_to_double_s"] < 1
    assert found["loops"] == [] and found["equivalent_short_period"]["damping_ratio"] is None
    assert skein.flying_qualities(skein.trim(5000, 1000))["unstable_mode"] is None


def test_flying_qualities_are_of_a_class_and_category():
    point = skein.trim(3000, 180, aircraft="cessna172")
    cruise, fighter = skein.flying_qualities(point, airplane_class="I", category="B"), skein.flying_qualities(point)
    assert cruise["bank_deg"] == 60 and fighter["bank_deg"] == 90
    assert cruise["equivalent_short_period"] == fighter["equivalent_short_period"]
    assert {requirement["level"] for requirement in cruise["requirements"]} <= {1, 2, 3, 4}
    assert len(cruise["loops"]) == len(fighter["loops"]) > 0
    with pytest.raises(skein.ConfigurationError, match="I, II, III, IV are known"):
        skein.flying_qualities(point, airplane_class="V")
    with pytest.raises(skein.ConfigurationError, match="Trim"):
        skein.flying_qualities((3000, 180))
    with pytest.raises(skein.ConfigurationError, match="level wings"):
        skein.flying_qualities(skein.trim(15000, 600, pull_up_g=3))
