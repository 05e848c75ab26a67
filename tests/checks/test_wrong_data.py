"""Published data with one wrong entry is noticed, by the check that reads it and no other."""

import pytest

from ucrit.catalogue import PUBLISHED, find_model
from ucrit.checks import check_model

CHANGES = [
    ("car", "(C_f + C_r)*(a**2*C_f", "(C_f - C_r)*(a**2*C_f", "published polynomial"),
    ("car", '"m*U + (a*C_f - b*C_r)/U"', '"m*U - (a*C_f - b*C_r)/U"', "published equations"),
    ("car", 'Q = [["C_f", "C_r"]', 'Q = [["C_f", "-C_r"]', "published equations"),
    ("car", 'numerator = ["(a + b)*C_f*C_r/U", "m*a*C_f"]', 'numerator = ["(a + b)*C_f*C_r/U", "m*b*C_f"]',
     "published transfer functions"),
    ("car", "m*b*(dx.V + x.r*U)", "m*b*(dx.V - x.r*U)", "published motion"),
    ("car", 'Y_f = "-C_f*front*cos(u.delta_f)"', 'Y_f = "-C_f*front"', "published motion"),
    ("car", 'beta = "atan2(x.V, U)"', 'beta = "x.V/U"', "published motion"),
    ("car", "beta =", "bta =", "published motion"),
    ("car", "-C_f*C_r*(a + b)**2/(m*", "-C_f*C_r*(a - b)**2/(m*", "published critical values"),
    ("car", "-C_f*C_r*(a + b)**2/(m*", "C_f*C_r*(a + b)**2/(m*", "published critical values"),
    ("car", 'parameter = "U"', 'parameter = "V"', "published critical values"),
    ("car", '"(a + b)**2*C_f*C_r/U**2 + m*(b*C_r - a*C_f)"', '"m*(b*C_r - a*C_f)"', "published criteria"),
    ("car", '"(a + b)**2*C_f*C_r/U**2 + m*(b*C_r - a*C_f)"', '"C_f"', "published criteria"),
    ("car", "[-21.5851948688, 0]", "[-21.5851948689, 0]", "published numbers"),
    ("car", "[-21.5851948688, 0]", "[-21.50352, 0]", "published numbers"),
    ("car", "[-21.5851948688, 0]", "[-21.5851948688, 0], [0, 0]", "published numbers"),
    ("trailer", 'P_2 = [["m", "m*a"]', 'P_2 = [["m", "m*b"]', "published equations"),
    ("trailer", "-m*C*b + k*(I_c + m*a**2)", "m*C*b + k*(I_c + m*a**2)", "published polynomial"),
    ("trailer", 'k*x.x"', '2*k*x.x"', "published motion"),
    ("trailer-rigid-tire", '"(a + b)*k/I_axle"', '"-(a + b)*k/I_axle"', "published state matrix"),
    ("trailer-rigid-tire", 'expression = ["U", ', 'expression = ["m", ', "published criteria"),
    ("trailer-rigid-tire", '["0", "0", "1"],', "", "published state matrix"),
    ("trailer-rigid-tire", "c*(a + b)/(I_c - m*a*b)", "-c*(a + b)/m", "published critical values"),
    ("wheelset-kinematic", 'expression = "Psi"', 'expression = "-Psi"', "published criteria"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "old", "new", "check"), CHANGES)
def test_one_wrong_entry(tmp_path, name, old, new, check):
    text = (PUBLISHED / f"{name.replace('-', '_')}.toml").read_text()
    assert old in text
    path = tmp_path / "changed.toml"
    path.write_text(text.replace(old, new, 1))
    assert [failed.name for failed in check_model(find_model(name), published=path).failed] == [check]


MALFORMED = [
    ("[[polynomal]]", "there is no table 'polynomal'; did you mean 'polynomial'?"),
    ("[polynomial]", "write the table as [[polynomial]]"),
    ("[[polynomial]]\nsource = 'a'", "the key 'coefficients' is missing"),
    ("[[polynomial]]\ncoefficients = []", "the key 'source' is missing"),
    (
        "[[polynomial]]\nsource = 'a'\ncoeficients = []",
        "there is no key 'coeficients'; did you mean 'coefficients'?",
    ),
    (
        "[[polynomial]]\nsource = 'a'\ncoefficients = []\ndirection = 2",
        "direction must be 1, -1 or 0 for either, got 2",
    ),
    ("[[polynomial]]\nsource = 'a'\ncoefficients = ['q', 1]", "uses 'q'; allowed"),
    ("[[polynomial]]\nsource = 'a'\ncoefficients = ['a +', 1]", "the formula 'a +' cannot be read"),
    (
        "[[polynomial]]\nsource = 'a'\ncoefficients = ['sn(a)', 1]",
        "uses the function 'sn'; did you mean 'sin'?",
    ),
    ("[[polynomial]]\nsource = 'a'\ncoefficients = ['[a][0]', 1]", "holds '[a][0]', which is no formula"),
    ("[[polynomial]]\nsource = 'a'\ncoefficients = ['a if a else b', 1]", "which is no formula"),
    (
        "[[polynomial]]\nsource = 'a'\ncoefficients = [true, 1]",
        "a formula must be a number or a text, got True",
    ),
    ("polynomial", "not valid TOML"),
]


@pytest.mark.parametrize(("text", "message"), MALFORMED)
def test_malformed_file(tmp_path, text, message):
    path = tmp_path / "malformed.toml"
    path.write_text(text)
    failed = check_model(find_model("trailer-kinematic"), published=path).failed
    assert failed
    assert all(message in check.detail for check in failed)


def test_file_that_is_not_there(tmp_path):
    report = check_model(find_model("trailer-kinematic"), published=tmp_path / "none.toml")
    assert "there is no file" in report.failed[0].detail
