"""The page: whole, self-contained, accessible, safe, and right."""

import re
from functools import cache
from html.parser import HTMLParser
from itertools import pairwise
from xml.etree import ElementTree

import matplotlib
import numpy as np
import pytest

from ucrit import Model, analyze, load, param, speed, state, write_report
from ucrit.catalogue import vehicle_names
from ucrit.core import UcritError
from ucrit.report import choices, drawings, formulas, render, tables

VOID = {"meta", "br", "hr", "img", "input", "link", "source", "wbr", "base", "embed", "area", "col"}
FORBIDDEN = {"script", "link", "img", "iframe", "object", "embed", "video", "audio", "image", "base", "form", "input"}


class Page(HTMLParser):
    """Elements, ids, links and texts of a page; refuses elements that are not closed in order."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.tags, self.attributes, self.texts = [], [], [], []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.attributes.append((tag, dict(attrs)))
        assert len(attrs) == len(dict(attrs)), f"<{tag}> has an attribute twice"
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.append(tag)
        self.attributes.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.texts.append((self.open[-1] if self.open else "", data))

    def words(self):
        return re.sub(r"\s+", " ", "".join(text for tag, text in self.texts if tag != "style"))

    def values(self, *names):
        return [attrs[name] for _, attrs in self.attributes for name in names if name in attrs]


@pytest.fixture(autouse=True, scope="module")
def _small_grids():
    """Coarse drawings: the page's structure does not depend on the number of points."""
    patch = pytest.MonkeyPatch()
    patch.setattr(drawings, "LOCUS_POINTS", 40)
    patch.setattr(drawings, "MAP_POINTS", 24)
    yield
    patch.undo()


@cache
def page_of(name):
    return render(analyze(name))


@pytest.mark.parametrize("name", vehicle_names())
def test_every_vehicle_has_a_sound_page(name):
    text = page_of(name)
    page = Page(text)
    assert analyze(name).sentence[1:] in page.words()
    assert not FORBIDDEN & set(page.tags)
    assert len(text) < 1_000_000
    _check_references(text, page)
    _check_structure(text, page)


def _check_references(text, page):
    """Nothing is fetched from anywhere."""
    links = page.values("href", "src", "xlink:href", "srcset", "data", "action", "poster", "background")
    assert links
    assert all(link.startswith("#") for link in links)
    ids = page.values("id")
    assert len(ids) == len(set(ids))
    assert {link[1:] for link in links} <= set(ids)
    targets = re.findall(r"url\(([^)]*)\)", text)
    assert all(target.startswith("#") and target[1:] in ids for target in targets)
    assert "@import" not in text
    assert not [v for v in page.values(*{n for _, a in page.attributes for n in a}) if v and "http" in v]
    assert not [name for _, a in page.attributes for name in a if name.startswith("on")]


def _check_structure(text, page):
    """Language, headings in order, named drawings and tables, well-formed drawings and formulas."""
    assert text.startswith("<!DOCTYPE html>")
    assert dict(page.attributes)["html"] == {"lang": "en"}
    levels = [int(tag[1]) for tag in page.tags if re.fullmatch("h[1-6]", tag)]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(b - a <= 1 for a, b in pairwise(levels))
    assert page.tags.count("caption") == page.tags.count("table") >= 2
    assert all(attrs.get("scope") in ("row", "col") for tag, attrs in page.attributes if tag == "th")
    drawn = [attrs for tag, attrs in page.attributes if tag == "svg"]
    assert len(drawn) >= 2
    assert all(attrs["role"] == "img" and len(attrs["aria-label"]) > 20 for attrs in drawn)
    fragments = re.findall(r"<svg\b.*?</svg>|<math\b.*?</math>", text, re.DOTALL)
    assert len(fragments) > 10
    for fragment in fragments:
        ElementTree.fromstring(fragment)


def test_colours_follow_light_and_dark():
    text = page_of("caravan")
    style, body = text.split("</style>", 1)
    assert not re.findall(r"#[0-9a-fA-F]{6}\b", body)
    used = set(re.findall(r"var\((--[a-z0-9]+)\)", body))
    assert {"--ink", "--stable", "--unstable", "--c0", "--c1"} <= used
    for medium in ("light dark", "prefers-color-scheme: dark", "@media print"):
        assert medium in style
    for name in used:
        assert style.count(f"{name}:") == 3


class TestNumbers:
    def test_critical_speed_with_its_kind(self):
        row = "23.2353 83.65 flutter: an oscillation grows 0.7691 sway below"
        assert row.replace(" ", "") in Page(page_of("caravan")).words().replace(" ", "")

    def test_verdict_in_a_word_and_a_sentence(self):
        assert "✕ Unstable at 27.78 m/s (100 km/h) Stable up to 23.24 m/s" in Page(page_of("caravan")).words()
        assert "✓ Stable Stable at every speed up to 10 m/s" in Page(page_of("bmw-320i")).words()
        assert "○ Neutral" in Page(page_of("wheelset-1-in-20")).words()

    def test_a_speed_below_which_it_is_unstable_is_told_apart(self):
        def stable_above(found):
            return type(found)(**{**vars(found), "stable": False})

        calm = analyze("bmw-320i")
        word = tables.judgement(stable_above(calm)).word
        assert word == "Not stable at every speed up to 10 m/s (36 km/h)"

    def test_eigenvalues(self):
        words = Page(page_of("caravan")).words()
        row = "sway0.1173 ± 4.741 i0.7545\N{MINUS SIGN}0.0247doubles in 5.91 s"
        assert row in words

    def test_remedies_as_printed_suffice(self):
        found = analyze("caravan")
        for remedy, row in zip(found.remedies, tables.remedies(found), strict=True):
            value = float(row["value"])
            assert value == pytest.approx(remedy.value, rel=1e-3)
            assert analyze(found.vehicle.with_(**{remedy.parameter: value})).stable

    def test_closed_form(self):
        assert "In closed form, the critical speed of 34.7851 m/s is" in Page(page_of("oversteering-car")).words()
        assert "In closed form" not in Page(page_of("caravan")).words()

    def test_criterion_fails_or_holds(self):
        assert "✕ Fails for this vehicle" in Page(page_of("caravan")).words()
        assert "✓ Holds for this vehicle" in Page(page_of("oversteering-car")).words()

    def test_captions_of_the_map(self):
        assert "Stability over U and a, all other parameters as they are." in Page(page_of("caravan")).words()


class TestMapParameters:
    def test_chosen_ones_are_drawn(self):
        words = Page(render(analyze("caravan"), map_parameters=("b", "k"))).words()
        assert "Stability over b and k, all other parameters as they are. Speed: 27.78 m/s." in words

    def test_speed_and_the_best_remedy_by_default(self):
        assert choices.map_parameters(analyze("caravan"), None) == ("U", "a")

    def test_a_stable_vehicle_gets_its_most_effective_parameter(self):
        speed_name, other = choices.map_parameters(analyze("oversteering-car"), None)
        assert speed_name == "U"
        assert other in ("C_f", "C_r", "a", "b")

    def test_ranges_hold_design_and_remedy_and_keep_the_bounds(self):
        found = analyze("caravan")
        for remedy in found.remedies:
            values = choices.map_range(found, remedy.parameter, 50)
            assert values[0] < remedy.present < values[-1]
            assert values[0] < remedy.value < values[-1]
            assert type(found.vehicle).declaration.parameters[remedy.parameter].allows(values).all()
            assert (np.diff(values) > 0).all()

    @pytest.mark.parametrize(
        ("asked", "message"),
        [
            (("b", "q"), "there is no parameter 'q'"),
            (("b", "b"), "two different parameters"),
            (("b",), "two different parameters"),
            ("bk", "two different parameters"),
        ],
    )
    def test_wrong_ones_are_refused(self, asked, message):
        with pytest.raises(UcritError, match=message):
            render(analyze("caravan"), map_parameters=asked)


class Hostile(Model):
    """A <b>bold</b> model & "more"."""

    m: float = param("kg", "mass <script>alert(1)</script> in $", above=0)
    c: float = param("N", "drag $x^{", above=0)
    U: float = speed("speed </svg>")

    v = state("m/s", "velocity <i>", motion='$\\frac{<img src="x">&')

    def equations(self, x, dx):
        return (self.m * dx.v + self.c * x.v / self.U,)


def test_hostile_names_stay_text():
    source = "see http://example.org/?a=1&b=<2>"
    vehicle = Hostile(m=1, c=2, U=3).with_info(
        name='<script src="http://example.org/x.js"></script>', source=source, note="<style>*{display:none}</style>"
    )
    text = render(analyze(vehicle), command='<a href="javascript:0">&')
    page = Page(text)
    assert not FORBIDDEN & set(page.tags)
    assert page.tags.count("style") == 1
    assert "i" not in page.tags
    assert all(link.startswith("#") for link in page.values("href", "src"))
    for shown in (vehicle.info.name, source, vehicle.info.note, "mass <script>alert(1)</script> in $", "</svg>"):
        assert shown in page.words()
    assert '$\\frac{<img src="x">& decay' in page.words()
    for fragment in re.findall(r"<svg\b.*?</svg>", text, re.DOTALL):
        ElementTree.fromstring(fragment)


class TestFormulas:
    def test_a_condition_too_long_is_left_out_with_a_note(self, monkeypatch):
        monkeypatch.setattr(formulas, "LONGEST", 30)
        words = Page(render(analyze("caravan"))).words()
        assert "Not printed: it has" in words
        assert "too long to print" in words

    def test_no_symbolic_condition_at_all(self):
        assert "The conditions in symbols are not shown" in Page(page_of("coach-truck")).words()


class TestWriting:
    def test_same_analysis_same_bytes(self, tmp_path):
        found = analyze("caravan")
        write_report(found, tmp_path / "a.html")
        with matplotlib.rc_context({"font.size": 20, "axes.facecolor": "red", "svg.fonttype": "none"}):
            write_report(analyze("caravan"), tmp_path / "b.html")
        first = (tmp_path / "a.html").read_bytes()
        assert first == (tmp_path / "b.html").read_bytes()
        assert first.decode() == render(found)

    def test_command_is_printed(self):
        found = analyze("caravan")
        assert "ucrit report caravan -o x.html" in Page(render(found, command="ucrit report caravan -o x.html")).words()
        assert "ucrit.analyze('caravan', upto=27.7" in Page(page_of("caravan")).words()
        changed = Page(render(analyze(found.vehicle.with_(c=9000)))).words()
        assert 'ucrit.write_report(ucrit.analyze(vehicle), "report.html")' in changed

    @pytest.mark.parametrize(
        ("target", "message"),
        [
            ("missing/folder/page.html", "cannot be written: No such"),
            ("folder.html", "cannot be written: it is a folder"),
            (".", "ending in .html"),
            ("page.txt", "ending in .html"),
        ],
    )
    def test_a_path_that_cannot_be_written(self, tmp_path, target, message):
        (tmp_path / "folder.html").mkdir()
        with pytest.raises(UcritError, match=message):
            write_report(analyze("wheelset-1-in-20"), tmp_path / target)
        assert [path.name for path in tmp_path.iterdir()] == ["folder.html"]

    def test_an_old_page_survives_a_failure(self, tmp_path):
        page = tmp_path / "page.html"
        page.write_text("old")
        with pytest.raises(UcritError, match="no parameter 'q'"):
            write_report(analyze("caravan"), page, map_parameters=("q", "b"))
        assert page.read_text() == "old"
        write_report(analyze("wheelset-1-in-20"), page)
        assert page.read_text().startswith("<!DOCTYPE html>")

    def test_backing_up(self):
        found = analyze(load("caravan").with_(U=-5.0))
        words = Page(render(found)).words()
        assert "backing up" in words
        assert found.vehicle.values["U"] == -5
