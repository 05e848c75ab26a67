"""``ucrit cite``."""

import json


def test_it_lists_sources_and_works(run):
    done = run("cite", "caravan", "steady_turn")
    assert done.exit_code == 0
    assert done.stdout.startswith("Vehicle caravan\n  Assumed values")
    assert "  D. Karnopp, Vehicle Stability, 2004 (as commonly cited)\n" in done.stdout
    assert max(map(len, done.stdout.splitlines())) <= 80


def test_bibtex_and_json_are_nothing_but_that(run):
    assert run("cite", "--bibtex").stdout.startswith("@misc{ucrit,\n")
    assert run("cite", "caravan", "--bibtex").stdout.count("\n@") == 1
    content = json.loads(run("cite", "caravan", "--json").stdout)
    assert content["schema"] == 1
    assert content["works"][0]["key"] == "karnopp-2004"


def test_wrong_input_is_one_sentence(run):
    done = run("cite", "caravam")
    assert done.exit_code == 2
    assert done.stderr == "ucrit: there is nothing called 'caravam' to cite; did you mean 'caravan'?\n"
    assert run("cite", "--bibtex", "--json").exit_code == 2
