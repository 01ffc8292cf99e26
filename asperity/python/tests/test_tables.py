"""Interpolation against the cells of the table and against scaling."""

import numpy as np
import pytest
import xarray

import asperity


@pytest.fixture(scope="module")
def steel():
    return asperity.table("steel-4340")


def test_cells_are_met(steel):
    cells = steel.to_xarray()
    found = steel.at("mu", cells.interference.values[:, None], cells.slip_rate.values[None, :])
    assert found.value.shape == cells.mu.shape and found.unit == "1"
    np.testing.assert_allclose(found.value, cells.mu.values, rtol=1e-12)
    assert (found.error >= 0.999 * cells.mu_error.values).all()
    one = steel.at("P", 10.0, 1.0)
    assert isinstance(one.value, float) and one.unit == cells.P.units


def test_states_after_a_slip_and_at_other_radii(steel):
    slip = np.array([0.0, 1e-7, 1e-5])
    friction, load = (steel.at(name, 10.0, 1.0, slip) for name in ("Q", "P"))
    mu = steel.at("mu", 10.0, 1.0, slip)
    np.testing.assert_array_equal(mu.value, friction.value / load.value)
    assert friction.value[0] < friction.value[1] < friction.value[2]
    radius = steel.constants["asperity_radius"]
    small = steel.at("P", 10.0, 10.0, radius=radius / 10)
    np.testing.assert_allclose(small.value, steel.at("P", 10.0, 1.0).value / 100, rtol=1e-12)
    assert steel.at("mu", 10.0, 1.0, temperature=298.0) == steel.at("mu", 10.0, 1.0)


def test_what_is_outside_is_refused_or_nan(steel):
    fastest = steel.range["slip_rate"][1]
    for key, state in {"slip_rate": (10.0, 2 * fastest), "interference": (2 * steel.contact_limit(), 1.0)}.items():
        with pytest.raises(asperity.InputError) as refused:
            steel.at("mu", *state)
        assert refused.value.key == key
        assert np.isnan(steel.at("mu", *state, outside="nan").value)
    for arguments, key in [(("friction", 1.0, 1.0), "quantity"), (("G", 1.0, 1.0, 1e-6), "quantity")]:
        with pytest.raises(asperity.InputError) as refused:
            steel.at(*arguments)
        assert refused.value.key == key
    with pytest.raises(asperity.InputError) as refused:
        steel.at("mu", 1.0, 1.0, temperature=500.0)
    assert refused.value.key == "temperature"
    with pytest.raises(asperity.InputError, match="steel-4340"):
        asperity.table("unobtainium")


def test_a_table_says_what_it_is(steel, folder):
    assert set(asperity.SHIPPED) >= {"steel-4340", "copper"} and "mu_static" in asperity.QUANTITIES
    assert steel.provenance["source"].startswith("asperity ") and "steel-4340" in steel.provenance["history"]
    assert "interference" in repr(steel)
    steel.save("copy.nc")
    copy = asperity.table("copy.nc")
    assert copy.at("G", 3.0, 0.3) == steel.at("G", 3.0, 0.3)
    xarray.testing.assert_identical(copy.to_xarray(), steel.to_xarray())
    assert steel.plot("table.svg").svg == (folder / "table.svg").read_text() == steel._repr_svg_()
