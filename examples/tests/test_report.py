"""The HTML report of a prediction in Chromium without a screen: click, hover, zoom, copy, and read back.

Every number is compared with the file friction.nc of the same prediction. `roughsurface`, `chromium` and `chromedriver` are
in the path.
"""

import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest
import xarray
from selenium import webdriver
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select

SURFACE = Path(__file__).resolve().parents[2] / "examples/scenes/ground-steel-surface.toml"
OPTIONS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--window-size=1200,1000",
]
#: Requests, and messages of scripts.
LOGS = ["performance", "browser"]
#: Digits of a number in the report.
DIGITS = dict(rel=1e-4)


def predict(folder, *options):
    command = ["roughsurface", "predict", SURFACE, "--table", "steel-4340", "--quiet", *options]
    subprocess.run([*command, "-o", "friction.nc", "--report", "report.html"], cwd=folder, check=True)
    return folder / "report.html"


class Report:
    """The page, as its reader works with it."""

    def __init__(self, browser, friction):
        self.browser = browser
        self.friction = friction

    def chart(self, name):
        return self.browser.find_element(By.ID, name)

    def lines(self, name):
        """Labels of the lines of a chart."""
        return [label.text for label in self.chart(name).find_elements(By.CSS_SELECTOR, ".u-series .u-label")][1:]

    def at(self, name, share):
        """What the legend shows with the pointer at this share of the width of a chart: x, then y of each line."""
        plot = self.chart(name).find_element(By.CSS_SELECTOR, ".u-over")
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", plot)
        across = round((share - 0.5) * plot.size["width"])
        self.actions().move_to_element_with_offset(plot, across, 0).perform()
        cells = self.chart(name).find_elements(By.CSS_SELECTOR, ".u-series .u-value")
        return [float(cell.text) for cell in cells]

    def zoom(self, name, first, last):
        """Drags over the plot between shares of its width."""
        plot = self.chart(name).find_element(By.CSS_SELECTOR, ".u-over")
        offset = lambda share: round((share - 0.5) * plot.size["width"])
        drag = self.actions().move_to_element_with_offset(plot, offset(first), 0).click_and_hold()
        drag.move_by_offset(offset(last) - offset(first), 0).release().perform()

    def actions(self):
        return webdriver.ActionChains(self.browser, duration=50)

    def copied(self, name):
        """Rows of what the button below a chart puts on the clipboard, pasted into a field."""
        self.browser.find_element(By.CSS_SELECTOR, f"button[data-chart={name}]").click()
        shown = self.browser.find_element(By.ID, "numbers").get_property("value")
        script = "document.body.append(Object.assign(document.createElement('textarea'), {id: 'pasted'}))"
        self.browser.execute_script(script)
        field = self.browser.find_element(By.ID, "pasted")
        field.send_keys(Keys.CONTROL, "v")
        pasted = field.get_property("value")
        self.browser.execute_script("arguments[0].remove()", field)
        assert pasted == shown != ""
        return [row.split("\t") for row in pasted.split("\n")]


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for option in [*OPTIONS, f"--user-data-dir={tmp_path_factory.mktemp('profile')}"]:
        options.add_argument(option)
    options.set_capability("goog:loggingPrefs", dict.fromkeys(LOGS, "ALL"))
    browser = webdriver.Chrome(options, webdriver.ChromeService(shutil.which("chromedriver")))
    yield browser
    browser.quit()


@pytest.fixture
def report(browser, tmp_path):
    page = predict(tmp_path).as_uri()
    browser.get("about:blank")
    for log in LOGS:
        browser.get_log(log)
    browser.get(page)
    return Report(browser, xarray.load_dataset(tmp_path / "friction.nc"))


def test_boxes_switch_pressures_and_slip_rates(report):
    pressures = [f"{pressure:.0f} Pa" for pressure in report.friction.pressure.values]
    rates = [f"{rate:g} m/s" for rate in report.friction.slip_rate.values]
    assert report.lines("over-rate") == pressures and report.lines("over-load") == rates
    boxes = {kind: report.chart(kind).find_elements(By.TAG_NAME, "input") for kind in ("pressure", "rate")}
    boxes["pressure"][1].click()
    boxes["rate"][0].click()
    assert report.lines("over-rate") == pressures[:1] + pressures[2:] and report.lines("over-load") == rates[1:]
    assert len(report.lines("over-slip")) == (len(pressures) - 1) * (len(rates) - 1)
    boxes["pressure"][1].click()
    assert report.lines("over-rate") == pressures
    # An entry of a legend does the same for its line.
    entry = report.chart("over-rate").find_elements(By.CSS_SELECTOR, ".u-series .u-label")[1]
    entry.click()
    classes = report.chart("over-rate").find_elements(By.CSS_SELECTOR, ".u-series")[1].get_attribute("class")
    assert "u-off" in classes


def test_values_under_the_pointer_are_those_of_the_file(report):
    for quantity in ("mu", "temperature_max"):
        choice = Select(report.browser.find_element(By.ID, "quantity"))
        choice.select_by_value(quantity)
        seen = set()
        for share in (0.02, 0.5, 0.98):
            rate, *values = report.at("over-rate", share)
            seen.add(rate)
            assert values == pytest.approx(report.friction[quantity].sel(slip_rate=rate).values, **DIGITS)
        assert seen == {0.1, 1.0, 10.0}
    slip, *values = report.at("over-slip", 0.5)
    of_file = report.friction.mu_history.sel(slip=slip, method="nearest")
    assert of_file.slip.item() == pytest.approx(slip, **DIGITS)
    assert values == pytest.approx(of_file.values.ravel(), **DIGITS)


def test_dragging_zooms_and_a_double_click_shows_all_again(report):
    assert report.at("over-rate", 0.02)[0] == 0.1 and report.at("over-rate", 0.98)[0] == 10.0
    report.zoom("over-rate", 0.27, 0.8)
    # Of the slip rates, 1 and 3 m/s are in the range from 0.35 to 4 m/s.
    assert report.at("over-rate", 0.02)[0] == 1.0 and report.at("over-rate", 0.98)[0] == 3.0
    plot = report.chart("over-rate").find_element(By.CSS_SELECTOR, ".u-over")
    report.actions().double_click(plot).perform()
    assert report.at("over-rate", 0.02)[0] == 0.1 and report.at("over-rate", 0.98)[0] == 10.0


def test_numbers_are_copied(report):
    Select(report.browser.find_element(By.ID, "quantity")).select_by_value("mu_static")
    report.chart("pressure").find_elements(By.TAG_NAME, "input")[0].click()
    head, *rows = report.copied("over-rate")
    friction = report.friction.mu_static.isel(pressure=slice(1, None))
    assert head == ["slip rate [m/s]", *(f"{pressure:.0f} Pa" for pressure in friction.pressure.values)]
    for row, rate in zip(rows, friction.slip_rate.values, strict=True):
        assert float(row[0]) == rate
        assert [float(mu) for mu in row[1:]] == pytest.approx(friction.sel(slip_rate=rate).values, **DIGITS)


def test_the_page_loads_nothing_and_reports_no_error(report):
    asked = []
    for entry in report.browser.get_log("performance"):
        message = json.loads(entry["message"])["message"]
        if message["method"] == "Network.requestWillBeSent":
            asked.append(message["params"]["request"]["url"])
    assert asked and all(url == report.browser.current_url for url in asked), asked
    assert report.browser.get_log("browser") == []
    assert "@font-face" not in report.browser.page_source


def test_material_and_works_to_cite_are_named(report):
    text = report.browser.find_element(By.TAG_NAME, "body").text
    assert "steel-4340" in text and "yield_strength = 792000000" in text
    cited = text.split("To cite")[1]
    assert "Thermomechanical modeling and transient analysis of sliding contacts" in cited
    assert "Greenwood & J. B. P. Williamson" in cited and len(re.findall(r"doi 10\.", cited)) >= 4


def test_a_report_has_less_than_two_megabytes(tmp_path):
    many = ["--pressure", "1e6..1e8:40", "--slip-rate", "0.1..10:40"]
    page = predict(tmp_path, *many)
    size = page.stat().st_size
    assert 100_000 < size < 2_000_000, size
    assert "400 of 1600 rows" in page.read_text(encoding="utf-8")
