"""simulate and tabulate against the files of the program."""

import _thread
import threading
import time

import numpy as np
import pytest
from conftest import REQUEST, SCENE, assert_same, run, toml

import asperity


def test_a_run_is_that_of_the_program(folder):
    (folder / "scene.toml").write_text(toml(SCENE))
    run("asperity", "run", "scene.toml", "-o", "program.nc", "--quiet")
    text = asperity.simulate(toml(SCENE), threads=1)
    for number, given in enumerate([SCENE, folder / "scene.toml"]):
        again = asperity.simulate(given)
        assert again.scalars == text.scalars
        again.save(f"{number}.nc")
        assert_same(folder / f"{number}.nc", folder / "program.nc")
    assert_same_scalars(text)


def assert_same_scalars(result):
    dataset = result.dataset
    for name in ("mu_static", "G"):
        assert dataset[name].item() == result[name].value
        assert dataset[f"{name}_error"].item() == result[name].error
        assert dataset[name].units == result[name].unit
    assert dataset["Q"].dims == ("step",) and dataset["Q"].values[-1] == result["Q"].value
    assert {"pressure", "temperature"} <= set(dataset) and dataset["pressure"].dims[1:] == ("theta", "r")


def test_overrides_fields_and_figures(folder):
    result = asperity.simulate(SCENE, overrides={"loading.slip_rate": 0.0}, fields_at=[0.01], body=True)
    slips = result.dataset.snapshot_slip.values / result["contact_radius"].value
    assert abs(slips - 0.01).min() < 1e-9
    assert "slip_rate = 0.0" in result.scene
    figure = result.plot("run.svg")
    assert figure.svg == (folder / "run.svg").read_text() == result._repr_svg_()
    assert figure.svg.lstrip().startswith("<svg") or "<svg" in figure.svg[:200]
    assert result.save_body("body").exists()
    assert result["mu"].value > 0.1 and "mu " in repr(result)


def test_dictionaries_lists_and_infinity_are_input(folder):
    """As values of overrides and of a dictionary; a path may have a ``=``."""
    scene = {
        **SCENE,
        "loading": {"interference": np.float64(5)},
        "counterface": {"preset": "copper", "elastic": False, "contact_conductance": float("inf")},
    }
    steps = [{"slip_rate": 1.0, "slip_distance": 0.02}, {"slip_rate": -1.0, "slip_distance": np.float64(0.01)}]
    changes = {"loading.steps": steps, "material.hardening": {"law": "linear", "modulus": 1e9}}
    result = asperity.simulate(scene, overrides=changes)
    assert all(text in result.scene for text in ('law = "linear"', "contact_conductance = inf", "slip_rate = -1.0"))
    (folder / "v=1").mkdir()
    (folder / "v=1" / "scene.toml").write_text(result.scene)
    assert asperity.simulate("v=1/scene.toml")["Q"] == result["Q"]


def test_progress_is_told_and_its_exceptions_stop_the_run():
    told = []
    asperity.simulate(SCENE, progress=lambda *told_now: told.append(told_now))
    assert all(stage and 0 <= done <= 1 for stage, done, _ in told) and told[-1][:2] == ("slide", 1.0)

    def stop(*_):
        raise ZeroDivisionError("by the user")

    with pytest.raises(ZeroDivisionError, match="by the user"):
        asperity.simulate(SCENE, progress=stop)


def test_an_interrupt_stops_a_run_at_once():
    fine = {"numerics.elements_per_radius": 24, "numerics.sectors": 16, "loading.slip_distance": 2.0}
    asked = []

    def interrupt():
        asked.append(time.process_time())
        _thread.interrupt_main()

    timer = threading.Timer(1.5, interrupt)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        asperity.simulate(SCENE, overrides=fine, threads=1)
    timer.join()
    # Of one processor, so that a busy machine does not matter.
    assert asked and time.process_time() - asked[0] < 1.0


def test_a_table_is_that_of_the_program_also_after_an_interrupt(folder):
    (folder / "request.toml").write_text(toml(REQUEST))
    run("asperity", "tabulate", "request.toml", "-o", "program.nc", "--quiet")

    def stop(*_):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt, match="resume=True"):
        asperity.tabulate(REQUEST, "table.nc", jobs=1, progress=stop)
    assert (folder / "table.nc.part").stat().st_size > 0 and not (folder / "table.nc").exists()
    with pytest.raises(asperity.InputError, match="table.nc.part") as refused:
        asperity.tabulate(REQUEST, "table.nc")
    assert refused.value.file == "table.nc"
    table = asperity.tabulate(REQUEST, "table.nc", resume=True)
    assert_same(folder / "table.nc", folder / "program.nc")
    assert not (folder / "table.nc.part").exists() and table.failures == []
    again = asperity.tabulate(REQUEST, "table.nc", resume=True, progress=stop)
    assert again.at("mu", 3.0, 0.5) == table.at("mu", 3.0, 0.5)
    in_memory = asperity.tabulate(folder / "request.toml", jobs=1)
    assert in_memory.name is None and in_memory.at("mu", 3.0, 0.5) == table.at("mu", 3.0, 0.5)


def test_errors_state_file_key_and_reason(folder):
    with pytest.raises(asperity.InputError, match="did you mean") as refused:
        asperity.simulate({**SCENE, "loading": {"interference": 5, "slip_rte": 1.0}})
    assert (refused.value.file, refused.value.key) == ("dict", "loading.slip_rte")
    with pytest.raises(asperity.InputError) as refused:
        asperity.simulate(SCENE, overrides={"asperity.radius": -1})
    assert refused.value.key == "asperity.radius" and "positive" in refused.value.reason
    with pytest.raises(asperity.InputError) as refused:
        asperity.simulate("none.toml")
    assert refused.value.file == "none.toml"
    with pytest.raises(asperity.InputError) as refused:
        asperity.simulate(SCENE, fields_at=[1.0])
    assert refused.value.key == "fields_at"
    with pytest.raises(asperity.InputError, match="folder"):
        asperity.tabulate(REQUEST, "no-such-folder/table.nc")
    assert isinstance(refused.value, ValueError)
