"""predict, sample and characterize against the files of the program."""

import json
import os

import numpy as np
import pytest
import SurfaceTopography
import xarray
from conftest import REQUEST, ROOT, SCENE, SURFACE, assert_same, run, toml
from scipy.io import loadmat

import asperity


def rough(points=96, pixel=1e-6, seed=3):
    """A random map with a Gaussian spectrum, m."""
    rng = np.random.default_rng(seed)
    frequency = np.fft.fftfreq(points, pixel)
    radius = np.hypot(*np.meshgrid(frequency, frequency))
    waves = np.fft.fft2(rng.normal(size=(points, points))) * np.exp(-((radius * 8e-6) ** 2))
    heights = np.fft.ifft2(waves).real
    return 1e-8 * heights / heights.std()


def test_friction_is_that_of_the_program(folder):
    (folder / "surface.toml").write_text(SURFACE)
    run("roughsurface", "predict", "surface.toml", "--table", "copper", "-o", "program.nc", "--quiet")
    for number, surface in enumerate([SURFACE, "surface.toml"]):
        friction = asperity.predict(surface, "copper", threads=number + 1)
        friction.save(f"{number}.nc")
        assert_same(folder / f"{number}.nc", folder / "program.nc")
    cell = friction.summary["friction"][0]
    assert cell["mu_static"]["value"] == friction.dataset.mu_static.values[0, 0]
    of_table = asperity.predict(SURFACE, asperity.table("copper"))
    assert of_table.summary == friction.summary


def test_exports_are_read_by_numpy(folder):
    (folder / "surface.toml").write_text(SURFACE)
    query = ["--pressure", "1e5,1e6,1e7", "--slip-rate", "0.1..10:7"]
    friction = run("roughsurface", "predict", "surface.toml", "--table", "copper", *query, "-o", "f.nc", "--json")
    cells = [cell["mu"]["value"] for cell in json.loads(friction)["friction"]]
    for name in ("f.csv", "f.txt", "f.json"):
        run("roughsurface", "export", "f.nc", "-o", name)
    table = np.genfromtxt("f.csv", delimiter=",", names=True)
    assert np.array_equal(table["mu"], cells) and table["pressure_Pa"][0] == 1e5
    lines = [line for line in (folder / "f.txt").read_text().splitlines() if not line.startswith("%")]
    rates, pressures, *rows = [np.array(line.split(), float) for line in lines]
    assert np.allclose(np.ravel(rows), cells, rtol=1e-9) and (len(rates), len(pressures)) == (7, 3)
    laws = json.loads((folder / "f.json").read_text())["laws"]
    for law, row in zip(laws, rows):
        drop = law["mu_0"]["value"] - law["mu_inf"]["value"]
        fitted = law["mu_inf"]["value"] + drop / (1 + (rates / law["V_star"]["value"]) ** law["n"]["value"])
        assert np.allclose(fitted, row, atol=4 * law["rms"])


def test_a_mat_file_has_the_friction_and_its_law(folder):
    asperity.predict(SURFACE, "copper", pressure=[1e5, 1e6, 1e7], slip_rate="0.1..10:7").save("f.nc")
    asperity.export("f.nc", "f.MAT")
    found, dataset = loadmat("f.MAT"), xarray.load_dataset("f.nc")
    for name in ("mu", "mu_error"):
        assert np.array_equal(found[name][:, :, 0], dataset[name])
    assert np.array_equal(found["pressure"][:, 0], dataset.pressure) and (found["temperature"] == 298.0).all()
    assert np.array_equal(found["slip_rate"][0], dataset.slip_rate)
    drop = found["mu_0"] - found["mu_inf"]
    fitted = found["mu_inf"] + drop / (1 + (found["slip_rate"] / found["V_star"]) ** found["n"])
    assert np.allclose(fitted, dataset.mu, rtol=0, atol=4 * dataset.rate_rms.values.max())
    asperity.export(["f.nc"], "law.mat", law=True)
    law = loadmat("law.mat")["mu"]
    assert law.shape == (3, 21, 1) and np.allclose(law[:, [0, -1], 0], fitted[:, [0, -1]], rtol=1e-9)


def test_a_mat_file_has_an_axis_of_temperatures(folder):
    request = {**REQUEST, "table": {**REQUEST["table"], "temperature": [298.0, 500.0]}}
    table = asperity.tabulate(request, "table.nc")
    at = lambda kelvin: asperity.predict(
        SURFACE, table, pressure=[1e5, 1e6, 2e6], slip_rate=[0.5, 1.0], overrides={"query.temperature": kelvin}
    )
    cold, hot = at(298.0), at(500.0)
    asperity.export([hot, cold], "both.mat")
    found = loadmat("both.mat")
    assert found["temperature"].ravel().tolist() == [298.0, 500.0]
    for number, friction in enumerate([cold, hot]):
        assert np.array_equal(found["mu"][:, :, number], friction.dataset.mu)
    assert found["mu_0"].shape == (3, 2) and not np.array_equal(found["mu"][:, :, 0], found["mu"][:, :, 1])


def test_exports_are_those_of_the_program_and_lose_no_error(folder):
    friction = asperity.predict(SURFACE, "copper", pressure=[1e6, 1e7], slip_rate="0.1..10:7")
    friction.save("f.nc")
    for name in ("f.inp", "f.txt", "f.csv", "f.json"):
        run("roughsurface", "export", "f.nc", "-o", name)
        asperity.export("f.nc", f"python-{name}")
        assert (folder / f"python-{name}").read_text() == (folder / name).read_text()
    for name in ("full.mat", "full.csv"):
        (folder / name).symlink_to("/dev/full")
        with pytest.raises(asperity.InputError, match="not a regular file"):
            asperity.export(friction, name)
    with pytest.raises(asperity.InputError, match="ends in .inp") as refused:
        asperity.export(friction, "friction.nc")
    assert (refused.value.file, refused.value.key) == ("friction.nc", "path")
    with pytest.raises(asperity.InputError, match="initial temperature") as refused:
        asperity.export([friction, friction], "friction.mat")
    with pytest.raises(asperity.InputError, match="no result to export"):
        asperity.export([], "friction.mat")


def test_query_comparison_and_report(folder):
    (folder / "surface.toml").write_text(SURFACE)
    query = ["--separation", "5e-7", "--slip-rate", "0.1..10:3", "--set", "query.hold=separation"]
    arguments = ["--table", "steel-4340", "--compare", "hertz", "-o", "program.nc", "--quiet"]
    run("roughsurface", "predict", "surface.toml", *query, *arguments)
    overrides = {"query.hold": "separation"}
    friction = asperity.predict(
        SURFACE, "steel-4340", separation=5e-7, slip_rate="0.1..10:3", overrides=overrides, compare="hertz"
    )
    friction.save("python.nc")
    assert_same(folder / "python.nc", folder / "program.nc")
    assert friction.plot("friction.svg").svg == (folder / "friction.svg").read_text()
    friction.report("report.html")
    assert "</html>" in (folder / "report.html").read_text()


def test_samples_are_those_of_the_program(folder):
    (folder / "surface.toml").write_text(SURFACE)
    count = ["--asperities", "200", "--realizations", "20", "--seed", "7"]
    run("roughsurface", "sample", "surface.toml", "--table", "copper", *count, "-o", "program.nc", "--quiet")
    asperity.sample(SURFACE, "copper", asperities=200, realizations=20, seed=7).save("python.nc")
    assert_same(folder / "python.nc", folder / "program.nc")


def test_a_map_in_memory_is_as_in_a_file(folder):
    heights = rough()
    np.save("map.npy", heights)
    options = ["--pixel", "1e-6", "--unit", "m"]
    shown = json.loads(run("roughsurface", "characterize", "map.npy", *options, "--json", "--quiet"))
    from_array = asperity.characterize(heights, pixel=1e-6)
    assert from_array.summary == shown
    assert asperity.characterize("map.npy", pixel=1e-6).summary["summits"] == shown["summits"]
    query = ["--pressure", "1e5", "--slip-rate", "1"]
    run("roughsurface", "predict", "map.npy", *options, *query, "--table", "copper", "-o", "program.nc", "--quiet")
    friction = asperity.predict(from_array, "copper", pressure=1e5, slip_rate=1.0)
    friction.save("python.nc")
    of_program = asperity._results.dataset(lambda path: path.write_bytes((folder / "program.nc").read_bytes()))
    for name in ("mu", "mu_static", "mu_error"):
        np.testing.assert_array_equal(friction.dataset[name].values, of_program[name].values)
    for _ in range(2):
        from_array.save("surface.toml", summits="found")
    assert (folder / "surface.heights.txt").exists()
    with (folder / "surface.toml").open("a") as edited:
        edited.write("# mine\n")
    with pytest.raises(asperity.AsperityError, match="was changed since"):
        from_array.save("surface.toml", summits="found")
    assert from_array.plot().svg == from_array._repr_svg_()


def test_two_rough_faces_are_as_with_the_option_of_the_program(folder):
    np.save("one.npy", rough())
    np.save("two.npy", rough().T)
    measured = ["--pixel", "1e-6", "--unit", "m", "--cutoff", "8e-6"]
    measured += ["--other-face", "two.npy", "--other-pixel", "1e-6", "--other-unit", "m"]
    query = ["--pressure", "1e5", "--slip-rate", "1", "--table", "copper", "-o", "program.nc", "--quiet"]
    run("roughsurface", "predict", "one.npy", *measured, *query)
    one, two = (asperity.characterize(name, pixel=1e-6, cutoff=8e-6) for name in ("one.npy", "two.npy"))
    both = one.on(two)
    assert both.surface.startswith("# Summits of one.npy on two.npy")
    asperity.predict(both, "copper", pressure=1e5, slip_rate=1.0).save("python.nc")
    of_program = asperity._results.dataset(lambda path: path.write_bytes((folder / "program.nc").read_bytes()))
    of_python = asperity._results.dataset(lambda path: path.write_bytes((folder / "python.nc").read_bytes()))
    np.testing.assert_array_equal(of_python["mu"].values, of_program["mu"].values)
    with pytest.raises(asperity.InputError, match="they are of one face"):
        both.save("surface.toml", summits="found")
    with pytest.raises(asperity.InputError, match="that of the other face"):
        one.on(asperity.characterize("two.npy", pixel=1e-6, cutoff=1.2e-5))


def test_objects_of_surface_topography():
    heights = 1e6 * rough()
    topography = SurfaceTopography.Topography(heights, (96.0, 96.0), unit="um", periodic=True)
    found = asperity.characterize(topography).summary
    expected = asperity.characterize(rough().T, pixel=1e-6, periodic=True).summary
    assert found["periodic"] and found["points"] == expected["points"]
    assert found["summits"]["radius"] == pytest.approx(expected["summits"]["radius"], rel=1e-9)
    undefined = np.ma.masked_array(heights, mask=np.indices(heights.shape).sum(axis=0) < 3)
    masked = asperity.characterize(SurfaceTopography.Topography(undefined, (96.0, 96.0), unit="um"))
    assert "no height" in " ".join(masked.warnings)
    line = asperity.characterize(SurfaceTopography.UniformLineScan(heights[0], 96.0, unit="um", periodic=True))
    assert line.summary["points"] == [1, 96]
    uneven = SurfaceTopography.NonuniformLineScan([0.0, 1.0, 3.0], [0.0, 1.0, 0.0], unit="um")
    with pytest.raises(asperity.InputError) as refused:
        asperity.characterize(uneven)
    assert refused.value.key == "topography"


@pytest.mark.parametrize("name", ["map.nc", "map.x3p", "periodic.nc"])
def test_an_object_of_surface_topography_is_as_its_file(name):
    path = ROOT / "roughsurface/tests/data" / name
    (found, expected) = (asperity.characterize(one).summary for one in (SurfaceTopography.read_topography(path), path))
    assert found["periodic"] == expected["periodic"] and found["points"] == expected["points"]
    for key, value in expected["summits"].items():
        if isinstance(value, float):
            assert found["summits"][key] == pytest.approx(value, rel=1e-5), key


def test_errors_state_key_and_reason():
    for arguments, key in [
        (dict(surface=SURFACE.replace("1e-3", "-1e-3"), table="copper"), "surface.asperity_radius"),
        (dict(surface=SURFACE, table="model:hertz"), "material"),
        (dict(surface=SURFACE, table="unobtainium"), "table"),
        (dict(surface=SURFACE, table="copper", slip_rate=1e6), "slip_rate"),
        (dict(surface=SURFACE, table="copper", slip_rate="fast"), "query.slip_rate"),
        (dict(surface=SURFACE, table="copper", compare="herz"), "compare"),
    ]:
        with pytest.raises(asperity.InputError) as refused:
            asperity.predict(**arguments)
        assert refused.value.key == key, refused.value
    with pytest.raises(asperity.InputError) as refused:
        asperity.characterize(rough())
    assert refused.value.key == "pixel"
    with pytest.raises(asperity.InputError, match="array: "):
        asperity.characterize(np.zeros((16, 16)), pixel=1e-6)


def test_no_result_replaces_what_it_was_made_from(folder):
    for name, file in (("copper", "table.nc"), ("copper-rigid", "up.nc")):
        asperity.table(name).save(file)
    os.link("table.nc", "hard.nc")
    np.savetxt("heights.txt", [0.0, 1e-7, 2e-7, 3e-7])
    np.save("map.npy", rough())
    named = SURFACE.replace('"gaussian", std = 0.4e-6', '"sample", file = "heights.txt"')
    (folder / "surface.toml").write_text(named + '[uncertainty]\ntables = { conductivity = "up.nc" }\n')
    (folder / "scene.svg").write_text(toml(SCENE))
    (folder / "request.toml").write_text(toml(REQUEST))
    before = {path: path.read_bytes() for path in folder.iterdir()}
    friction = asperity.predict("surface.toml", "table.nc")
    samples = asperity.sample("surface.toml", "table.nc", asperities=9, realizations=2)
    found = asperity.characterize("map.npy", pixel=1e-6)
    replacing = [(friction.save, "hard.nc"), (friction.report, "surface.toml"), (friction.save, "heights.txt")]
    replacing += [(friction.save, "up.nc"), (samples.save, "table.nc"), (found.save, "map.npy")]
    replacing += [(asperity.simulate(str(folder / "scene.svg")).plot, "scene.svg")]
    replacing += [(lambda path: asperity.tabulate("request.toml", path), "request.toml")]
    for write, path in replacing:
        with pytest.raises(asperity.InputError, match="are the same file"):
            write(path)
    assert {path: path.read_bytes() for path in folder.iterdir()} == before
