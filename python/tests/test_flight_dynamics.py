# SPDX-License-Identifier: Apache-2.0
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


def test_a_coordinated_turn_turns():
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
