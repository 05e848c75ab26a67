"""Sources: of everything that is shipped, none made up, each work once."""

import inspect
import re
from pathlib import Path

import pytest

import ucrit
from ucrit import UcritError, cite, find_model, load
from ucrit.analyses.about.bibliography import KINDS, _content, works, works_in
from ucrit.catalogue import HERE, controller_names, model_names, tire_names, vehicle_names

ROOT = Path(__file__).parents[2]
PRINTED = "\n".join(
    " ".join(path.read_text(encoding="utf-8").split())
    for pattern in ("*.py", "*.toml", "*.tir")
    for path in sorted(HERE.rglob(pattern))
    if path.name != "bibliography.toml"
)


@pytest.mark.parametrize("name", [*vehicle_names(), *controller_names(), *tire_names()])
def test_everything_shipped_has_a_source_that_its_file_states(name):
    found = cite(name)
    assert found.citations
    assert found.citations[0].source != "its description names none"
    for citation in found:
        assert citation.source.replace("\n", " ")[:60].split("; ")[0] in PRINTED, citation
    assert {key for c in found for key in c.works} | {"ucrit"} == {work.key for work in found.works}


def test_a_vehicle_cites_its_file_its_model_and_what_it_is_checked_against():
    found = cite("caravan")
    assert found.citations[0].of == "vehicle caravan"
    assert found.citations[0].source == load("caravan").info.source
    told = {c.of: c.source for c in found}
    assert told["model trailer"] == "Karnopp 2004, sections 5.III and 5.IV"
    assert "published matrices of trailer" in told
    assert cite(load("caravan")) == found
    assert cite(find_model("trailer")).citations == found.citations[1:]


def test_a_controlled_vehicle_cites_the_law_and_a_fitted_one_its_tires():
    assert "controller lean-by-front-steering" in {c.of for c in cite("motorcycle-steered-to-lean")}
    assert "law linear" in {c.of for c in cite("four-wheel-car")}


def test_an_analysis_cites_its_methods():
    keys = {work.key for work in cite("critical").works}
    assert {"routh-1877", "hurwitz-1895", "collins-akritas-1976"} <= keys
    assert cite(ucrit.critical) == cite("critical")
    assert [work.key for work in cite("steady_turn").works] == ["karnopp-2004", "ucrit"]
    assert not any("routh" in work.key for work in cite("modes").works)


def test_nothing_used_leaves_the_package_to_be_cited():
    (work,) = cite().works
    assert work.fields["version"] == ucrit.__version__
    cff = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert f"version: {ucrit.__version__}\n" in cff
    assert f'title: "{work.title}"' in cff
    assert all(f'name: "{author}"' in cff for author in work.author)


def test_each_work_of_the_bibliography_is_named_by_some_source():
    assert {entry["type"] for entry in _content().values()} <= set(KINDS)
    for key, entry in _content().items():
        named = any(all(word in PRINTED for word in words.split()) for words in entry.get("match", ()))
        assert named or key == "ucrit", f"no source names {key}"


def test_every_dated_source_of_an_analysis_leads_to_a_work():
    functions = [name for name in ucrit._PUBLIC if inspect.isfunction(getattr(ucrit, name))]
    named = {c.source for name in functions for c in cite(name) if not c.works}
    assert {source for source in named if re.search(r"\b(18|19|20)\d\d\b", source)} <= {"K. Weierstrass 1891"}


def test_what_is_not_checked_says_so():
    known = works()
    assert known["hurwitz-1895"].checked
    assert "as commonly cited" not in str(known["hurwitz-1895"])
    assert str(known["osborne-1960"]).endswith("(as commonly cited)")
    assert sum(work.checked for work in known.values()) > 0.85 * len(known)
    assert all(re.fullmatch(r"10\.\d{4,}/\S+", w.fields["doi"]) for w in known.values() if "doi" in w.fields)


def test_sources_that_name_a_known_work_lead_to_it():
    assert works_in("Meijaard et al. 2007, table 2, v = 1 m/s") == ("meijaard-2007",)
    assert works_in("Assumed values; no particular cart was measured.") == ()


def test_bibtex_is_well_formed():
    text = cite(*vehicle_names(), *model_names(), "critical").bibtex()
    entries = re.findall(r"^@(\w+)\{([\w-]+),\n((?:  \w+ = \{.*\},\n)+)\}$", text, re.MULTILINE)
    assert len(entries) == text.count("@") > 15
    assert len({key for _, key, _ in entries}) == len(entries)
    for kind, key, body in entries:
        assert kind in KINDS.values()
        assert body.count("{") == body.count("}")
        assert re.search(r"author = \{\S", body), key
        assert not re.search(r"(?<!\\)[&%#_$]", body), body
    assert "The ucrit developers}" in works()["ucrit"].bibtex()


def test_what_is_not_there_is_told_in_a_sentence(tmp_path):
    with pytest.raises(UcritError, match="nothing called 'caravam' to cite; did you mean 'caravan'"):
        cite("caravam")
    with pytest.raises(UcritError, match="not of 3"):
        cite(3)
    with pytest.raises(UcritError, match="nowhere"):
        cite(tmp_path / "nowhere.toml")


def test_it_prints_and_shows():
    found = cite("bmw-320i")
    assert "    Karnopp 2004, eq. (6.17)" in str(found).splitlines()
    assert ">vehicle bmw-320i</th>" in found._repr_html_()
    assert found.to_dict()["sources"][0]["works"] == ["althoff-2017"]
