"""The page in a real headless Chromium that can reach this machine only."""

from __future__ import annotations

import json
import re
import runpy
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs

import pytest

import ucrit
from ucrit import load
from ucrit.catalogue import vehicle_names
from ucrit.web.downloads import KINDS

from .conftest import Page

Open = Callable[..., Page]


def eigenvalues(page: Page) -> list[complex]:
    """Return the eigenvalues in the page's table, as it got them."""
    cells = page.page.locator("#modes td[data-value]").evaluate_all("list => list.map(cell => cell.dataset.value)")
    return [complex(*map(float, cell.split())) for cell in cells]


def expected(vehicle: Any) -> list[complex]:
    return [mode.eigenvalue for mode in ucrit.modes(vehicle)]


def stored(page: Page) -> dict[str, float]:
    """Return the values in the page's link."""
    found = parse_qs(page.page.evaluate("location.hash.slice(1)"), strict_parsing=True)
    return {key[2:]: float(value[0]) for key, value in found.items() if key.startswith("p.")}


def slider(page: Page, name: str) -> Any:
    return page.page.locator(f"input[type=range][data-name={name}]")


def field(page: Page, name: str) -> Any:
    return page.page.locator(f".row[aria-label={name}] .exact")


def locus_path(page: Page) -> str:
    found: str = page.page.locator("#locus .line.b0").first.get_attribute("d")
    return found


def test_every_vehicle_opens_and_shows_the_numbers_of_python(open_page: Open) -> None:
    page = open_page("#v=caravan-kinematic")
    for name in sorted(vehicle_names(), key=lambda n: n == "caravan-kinematic"):
        page.visit(f"#v={name}")
        vehicle = load(name)
        assert page.text("#name") == vehicle.info.name
        assert page.page.locator("#problem").is_hidden(), page.text("#problem")
        assert eigenvalues(page) == expected(vehicle), name
        assert stored(page) == dict(vehicle.values), name
        assert page.page.locator("#rows .row").count() == len(vehicle.values)
        drawn = page.page.locator("#locus .line").count()
        assert drawn or "there is no locus to draw" in page.text("#locus .readout").lower()


def test_a_slider_moves_the_locus_and_the_numbers(open_page: Open) -> None:
    page = open_page()
    before = locus_path(page)
    slider(page, "a").focus()
    page.change(lambda: page.page.keyboard.press("PageUp"))
    now = stored(page)["a"]
    assert now > 3.7
    assert locus_path(page) != before
    assert field(page, "a").input_value() == f"{now:.9g}"
    assert eigenvalues(page) == expected(load("caravan").with_(a=now))
    assert page.text("#sentence") == sentence(load("caravan").with_(a=now))


def sentence(vehicle: Any) -> str:
    said = ucrit.analyze(vehicle).sentence
    return said[:1].upper() + said[1:] + "."


def test_the_keyboard_reaches_all_of_a_slider(open_page: Open) -> None:
    page = open_page()
    slider(page, "b").focus()
    found = {}
    for key in ("End", "ArrowLeft", "PageDown", "Home", "ArrowRight"):
        page.change(lambda key=key: page.page.keyboard.press(key))
        found[key] = stored(page)["b"]
    assert found["Home"] < found["ArrowRight"] < found["PageDown"] < found["ArrowLeft"] < found["End"]
    page.change(lambda: page.page.get_by_role("button", name="Reset centre of mass to axle").click())
    assert stored(page)["b"] == 0.3


def test_a_fast_drag_ends_at_its_last_value(open_page: Open) -> None:
    page = open_page()
    page.change(
        lambda: slider(page, "m").evaluate(
            """slider => { for (let k = 0; k < 80; k++) { slider.value = 200 + k;
            slider.dispatchEvent(new Event("input", { bubbles: true })); } }"""
        )
    )
    asked = [url for url in page.asked if url.endswith("/api/state")]
    assert len(asked) <= 5  # the first and the last of 80, beside what opened the page
    assert stored(page)["m"] == 279 * 5
    assert eigenvalues(page) == expected(load("caravan").with_(m=stored(page)["m"]))


def test_exact_values_and_other_units_can_be_typed(open_page: Open) -> None:
    page = open_page()

    def enter(name: str, text: str) -> None:
        field(page, name).fill(text)
        field(page, name).press("Enter")

    page.change(lambda: enter("U", "110 km/h"))
    assert stored(page)["U"] == load("caravan", {"U": "110 km/h"}).values["U"]
    page.change(lambda: enter("k", "5432.10987654321"))
    assert stored(page)["k"] == 5432.10987654321
    page.change(lambda: enter("m", "9000"))  # beyond the slider, which is stretched
    assert stored(page)["m"] == 9000
    enter("m", "-5")
    page.page.wait_for_selector(".row[aria-label=m] .wrong:not(:empty)")
    assert page.text(".row[aria-label=m] .wrong") == "Trailer: mass m must be above 0 kg, got -5 kg."
    assert field(page, "m").get_attribute("aria-invalid") == "true"
    page.change(lambda: page.page.locator("#reset").click())
    assert stored(page) == dict(load("caravan").values)
    page.wrong.clear()  # Chromium itself reports answers of status 400


def test_shown_numbers_are_never_stored(open_page: Open) -> None:
    page = open_page("#v=shimmying-caster&p.C=6123.4567890123456")
    before = stored(page)
    for units in ("kmh", "mph", "si"):
        page.change(lambda units=units: page.page.select_option("#units", units))
        for name in before:
            field(page, name).focus()
            field(page, name).blur()
        assert stored(page) == before
    page.change(lambda: page.page.select_option("#units", "mph"))
    assert page.text(".row[aria-label=U] .unit") == "mph"
    assert page.text(".row[aria-label=C] .unit") == "N/deg"


def test_a_link_restores_the_state(open_page: Open) -> None:
    page = open_page("#v=car-and-caravan")
    page.change(lambda: page.page.select_option("#units", "kmh"))
    first = page.page.locator("#rows input[type=range]").first
    first.focus()
    page.change(lambda: page.page.keyboard.press("PageUp"))
    page.change(lambda: page.page.click("#pin"))
    first.focus()
    page.change(lambda: page.page.keyboard.press("PageUp"))
    page.change(lambda: page.page.select_option("#motion", index=1))
    link = page.page.evaluate("location.hash")
    again = open_page(link)
    assert again.page.evaluate("location.hash") == link
    assert eigenvalues(again) == eigenvalues(page)
    for selector in ("#units", "#along", "#map-x", "#map-y", "#motion"):
        assert again.page.input_value(selector) == page.page.input_value(selector), selector
    assert again.text("#compare") == page.text("#compare")
    assert again.page.locator("#locus .line.pinned").count() > 0


def test_the_present_vehicle_can_be_changed_as_a_file(open_page: Open) -> None:
    page = open_page("#v=caravan&p.a=3.9&units=mph")
    assert "standard deviation 60 kg" in page.text(".row[aria-label=m]").replace("\xa0", " ")
    page.page.click("#load")
    page.page.wait_for_selector("#dialog[open]")
    text = page.page.input_value("#text")
    assert "a = 3.9" in text
    page.page.fill("#text", text.replace("sd = 60.0", "sd = 45.0"))
    page.change(lambda: page.page.click("#dialog-open"))
    assert "standard deviation 45 kg" in page.text(".row[aria-label=m]").replace("\xa0", " ")
    assert page.text("#word").endswith("mph") or page.text("#word") == "Stable"
    assert stored(page)["a"] == 3.9


def test_a_range_that_is_shown_in_other_units_stays_as_it_is(open_page: Open) -> None:
    page = open_page("#v=caravan&units=mph&p.a=3.5")
    assert page.text("#word") == "Unstable at 62.14 mph"

    def low() -> str:
        return parse_qs(page.page.evaluate("location.hash.slice(1)"))["from"][0]

    before = low()
    page.page.fill("#to", "80")
    page.change(lambda: page.page.locator("#to").press("Enter"))
    assert low() == before


def test_the_table_of_modes_fits_a_tablet(open_page: Open) -> None:
    page = open_page()
    for width in (834, 1440):
        page.page.set_viewport_size({"width": width, "height": 900})
        wide = page.page.locator("#modes-card .table").evaluate("e => [e.scrollWidth, e.clientWidth]")
        assert wide[0] <= wide[1], width


def test_the_parameters_never_cover_the_equations(open_page: Open) -> None:
    page = open_page()
    page.page.click("#equations summary")
    page.page.wait_for_selector("#derivation math")
    page.page.evaluate("scrollTo(0, document.documentElement.scrollHeight)")
    boxes = [page.page.locator(s).bounding_box() for s in ("#parameters", "#equations-card")]
    assert boxes[0]["y"] + boxes[0]["height"] <= boxes[1]["y"]


def test_the_keyboard_stays_where_a_remedy_was_chosen(open_page: Open) -> None:
    page = open_page()
    page.page.wait_for_selector("#remedies button")
    page.page.locator("#remedies button").first.focus()
    page.page.keyboard.press("Enter")
    page.page.wait_for_selector("#remedies:has-text('Nothing needs changing')")
    assert page.page.evaluate("document.activeElement.id") == "remedies"


WRONG_LINKS = {
    "#v=nothing": "There is no vehicle 'nothing'",
    "#v=caravan&p.m=heavy": "p.m must be a number, got 'heavy'",
    "#v=caravan&p.m=": "p.m must be a number",
    "#v=caravan&p.m=-1": "mass m must be above 0 kg, got -1 kg",
    "#v=caravan&p.mm=1": "no parameter 'mm'",
    "#v=caravan&along=Q": "no parameter 'Q'",
    "#v=caravan&units=furlongs": "no units 'furlongs'",
    "#v=caravan&mode=-1": "mode must be a whole number",
    "#v=caravan&colour=red": "an entry 'colour'",
    "#%%%=&v=1": "The link cannot be read",
    "#toml=model%3D%22evil.py%22%0A%5Bparameters%5D": "'evil.py' is a file",
    "#v=caravan&p.<img src%3Dx onerror%3Dalert(1)>=1": "no parameter '<img src=x",
}


def test_malformed_links_get_a_sentence(browser: Any, port: int) -> None:
    page = Page(browser, port)
    page.page.goto(page.home + "#v=caravan")
    page.settle("0")
    for link, said in WRONG_LINKS.items():
        page.page.evaluate("hash => { document.getElementById('problem').hidden = true; location.hash = hash; }", link)
        page.page.wait_for_selector("#problem:not([hidden])")
        assert said in page.text("#problem"), link
    assert page.page.locator("img").count() == 0
    assert all("status of 400" in text for text in page.wrong)
    page.context.close()


def test_a_remedy_that_is_clicked_makes_it_stable(open_page: Open) -> None:
    page = open_page()
    assert "unstable" in page.text("#word").lower()
    page.page.wait_for_selector("#remedies button[data-parameter=a]")
    page.change(lambda: page.page.click("#remedies button[data-parameter=a]"))
    assert page.text("#word") == "Stable"
    assert stored(page)["a"] == 3.802
    page.page.wait_for_selector("#remedies:has-text('Nothing needs changing')")


def test_a_click_on_the_map_moves_the_vehicle(open_page: Open) -> None:
    page = open_page()
    page.page.wait_for_selector("#map .design")
    page.page.locator("#map svg").scroll_into_view_if_needed()
    box = page.page.locator("#map svg").bounding_box()
    page.change(lambda: page.page.mouse.click(box["x"] + 0.5 * box["width"], box["y"] + 0.3 * box["height"]))
    values = stored(page)
    assert page.text("#map .readout") == ""
    assert 20 < values["U"] < 30
    assert values["a"] > 6
    assert eigenvalues(page) == expected(load("caravan").with_(**values))
    page.change(lambda: page.page.select_option("#map-y", "U"))  # the other axis takes what this one had
    assert page.page.input_value("#map-x") == "a"


def test_the_speed_range_and_the_parameter_along_can_be_chosen(open_page: Open) -> None:
    page = open_page()
    page.page.fill("#to", "80")
    page.change(lambda: page.page.locator("#to").press("Enter"))
    assert slider(page, "U").get_attribute("max") is not None
    page.change(lambda: page.page.select_option("#along", "c"))
    edges = ucrit.critical(load("caravan"), "c")
    shown = page.page.locator("#critical li").all_inner_texts()
    assert len(shown) == len([c for c in edges if c.value < float(page.page.input_value("#to"))])
    assert "c = 9045.08 N m s/rad" in shown[0].replace("\xa0", " ")


def drawn(plot: Any) -> str:
    """Return what a plot shows, without the point that is read."""
    content: str = plot.inner_html()
    return content.partition('<g class="cursor">')[0]


def test_plots_are_read_and_zoomed_by_keyboard(open_page: Open) -> None:
    page = open_page()
    plot = page.page.locator("#locus svg")
    assert "sway at 0.1173 plus or minus 4.741 i" in plot.get_attribute("aria-label")
    plot.focus()
    page.page.keyboard.press("ArrowRight")
    assert re.search(r"(sway|oscillation): .* 1/s at U = .* m/s", page.text("#locus .readout").replace("\xa0", " "))
    whole = drawn(plot)
    page.page.keyboard.press("+")
    assert drawn(plot) != whole
    page.page.keyboard.press("0")
    assert drawn(plot) == whole
    page.page.keyboard.press("Shift+ArrowLeft")
    assert drawn(plot) != whole
    page.page.keyboard.press("Escape")
    box = plot.bounding_box()
    page.page.mouse.move(box["x"] + 200, box["y"] + 100)
    page.page.keyboard.down("Control")
    page.page.mouse.wheel(0, -300)
    page.page.keyboard.up("Control")
    page.page.wait_for_function("old => !document.querySelector('#locus svg').innerHTML.startsWith(old)", arg=whole)
    page.page.locator("#locus svg").dblclick(position={"x": 200, "y": 100})
    assert drawn(plot) == whole


def test_the_motion_is_played_when_asked(open_page: Open) -> None:
    page = open_page()
    page.page.wait_for_selector("#film .body")
    assert page.text("#film .play") == "Play"  # reduced motion is asked for
    start = page.page.locator("#film .body").first.get_attribute("points")
    page.page.click("#film .play")
    page.page.wait_for_selector(f"#film .body:not([points='{start}'])")
    page.page.click("#film .play")
    page.change(lambda: page.page.select_option("#motion", "disturb theta"))
    page.page.wait_for_selector("#film .caption:has-text('non-linear motion after theta')")
    assert "undefined" not in page.text("#film")


def test_equations_are_typeset(open_page: Open) -> None:
    page = open_page("#v=caravan-undamped-hitch")
    page.page.click("#equations summary")
    page.page.wait_for_selector("#derivation math")
    assert page.page.locator("#derivation math").first.bounding_box()["height"] > 10
    assert "fails for this vehicle" in page.text("#derivation")


def test_downloads_open(open_page: Open, tmp_path: Path) -> None:
    page = open_page("#v=caravan&p.m=1234.5")
    for kind in KINDS:
        page.page.click("#downloads summary")
        with page.page.expect_download() as caught:
            page.page.click(f"#downloads button[data-kind={kind}]")
        path = tmp_path / caught.value.suggested_filename
        caught.value.save_as(path)
        assert path.stat().st_size > 300
    report = page.context.new_page()
    report.goto(next(tmp_path.glob("*.html")).as_uri())
    assert report.locator("h1").inner_text() == load("caravan").info.name
    for picture in (*tmp_path.glob("*.png"), *tmp_path.glob("*.svg")):
        report.goto(picture.as_uri())
    report.close()
    assert json.loads(next(tmp_path.glob("*.json")).read_text())["vehicle"]["parameters"]["m"] == 1234.5
    again = open_page()
    again.page.click("#load")
    again.page.set_input_files("#file", next(tmp_path.glob("*.toml")))
    again.page.locator("#text").filter(has_text="").wait_for()
    again.change(lambda: again.page.click("#dialog-open"))
    assert stored(again) == stored(page)


def test_a_file_that_is_wrong_gets_a_sentence(open_page: Open) -> None:
    page = open_page()
    page.page.click("#load")
    page.page.fill("#text", 'model = "trailer"\n[parameters]\nm = -1\n')
    page.page.click("#dialog-open")
    page.page.wait_for_selector("#dialog-problem:not(:empty)")
    assert "must be above 0 kg, got -1 kg" in page.text("#dialog-problem")
    assert page.page.locator("#dialog").evaluate("dialog => dialog.open")
    page.wrong.clear()


def test_two_visitors_each_have_their_own_vehicle(open_page: Open) -> None:
    one, other = open_page("#v=caravan"), open_page("#v=caravan&p.m=2000")
    slider(one, "a").focus()
    one.change(lambda: one.page.keyboard.press("End"))
    slider(other, "b").focus()
    other.change(lambda: other.page.keyboard.press("End"))
    for page in (one, other):
        assert eigenvalues(page) == expected(load("caravan").with_(**stored(page)))
    assert stored(one)["m"] == 1200
    assert stored(other)["a"] == 3.7


def test_turns_and_limit_cycles_are_asked_where_they_are_looked_at(open_page: Open) -> None:
    page = open_page("#v=spinning-car")
    assert page.page.locator("#cycles-card").is_hidden()
    assert not any(url.endswith(("/api/handling", "/api/cycles")) for url in page.asked)
    page.page.click("#handling > summary")
    page.page.wait_for_selector("#handling-key li")
    assert "the car spins: the rear axle saturates first." in page.text("#handling-said")
    assert page.page.locator("#axles .line, #curve .line, #steer .line").count() == 6
    before = page.page.locator("#axles .line").first.get_attribute("d")
    field(page, "rear_mu").fill("0.5")
    page.change(lambda: field(page, "rear_mu").press("Enter"))
    page.page.wait_for_function("old => document.querySelector('#axles .line').getAttribute('d') !== old", arg=before)
    again = open_page(page.page.evaluate("location.hash"))
    again.page.wait_for_selector("#handling-key li")
    assert again.text("#handling-facts") == page.text("#handling-facts")
    page.visit("#v=caravan-with-stabiliser&open=cycles")
    page.page.wait_for_selector("#cycles-key li", timeout=60_000)
    assert page.page.locator("#handling-card").is_hidden()
    assert page.page.locator("#amplitude .line").count() >= 4
    assert "A disturbed vehicle may keep oscillating from 22.62 m/s" in page.text("#cycles-facts")


def test_the_picture_of_the_page_in_its_description_is_current(open_page: Open) -> None:
    drawn = runpy.run_path(str(Path(__file__).parents[2] / "docs" / "images" / "app.py"))
    page = open_page(drawn["LINK"])
    page.page.set_viewport_size(drawn["SIZE"])
    drawn["wait"](page.page)
    page.page.wait_for_function(
        "(m => m.clientWidth == m.querySelector('svg').clientWidth)(document.getElementById('map'))"
    )
    assert drawn["words"](page.page) == drawn["kept"](), "draw it again: python docs/images/app.py"


def test_everything_has_a_name_for_those_who_do_not_see_it(open_page: Open) -> None:
    page = open_page()
    page.page.wait_for_selector("#remedies button")
    page.page.click("#equations summary")
    page.page.wait_for_selector("#derivation math")
    tree = page.context.new_cdp_session(page.page).send("Accessibility.getFullAXTree")["nodes"]
    nameless = [
        node["role"]["value"]
        for node in tree
        if not node.get("ignored")
        and any(p["name"] == "focusable" and p["value"].get("value") for p in node.get("properties", []))
        and node["role"]["value"] not in ("RootWebArea", "generic")
        and not node.get("name", {}).get("value")
    ]
    assert nameless == []
    ids = page.page.locator("[id]").evaluate_all("list => list.map(e => e.id)")
    assert len(ids) == len(set(ids))
    levels = page.page.locator("h1, h2, h3").evaluate_all("list => list.map(e => Number(e.tagName[1]))")
    assert levels[0] == 1
    assert all(b - a <= 1 for a, b in pairwise(levels))
    assert page.page.locator("html").get_attribute("lang") == "en"


@pytest.mark.parametrize("name", ["caravan", "navion-from-geometry"])
def test_a_telephone_shows_all_without_scrolling_sideways(open_page: Open, name: str) -> None:
    page = open_page(f"#v={name}")
    page.page.set_viewport_size({"width": 360, "height": 740})
    page.page.click("#equations summary")
    page.page.wait_for_selector("#derivation math")
    assert page.page.evaluate("document.documentElement.scrollWidth") <= 360
    small = page.page.locator("button:visible, select:visible, input[type=range]:visible").evaluate_all(
        "list => list.filter(e => e.getBoundingClientRect().height < 24).map(e => e.outerHTML)"
    )
    assert small == []
