"""Standard errors cover as Student's t says, results do not depend on threads, lobes draw what their densities say."""
import collections
import json
import math
import pathlib
import subprocess
import tempfile

import numpy

import settings
from scenes import domain, flux, lambertian, leaf, light, prototype, soil, simulate, views

two_discs = "0.4 0.1 0.0 0.5 0.3 0.2 0.93\n0.3 -0.2 0.1 0.3 0.0 0.7 0.71\n"
repeats = 1000


def scene(sensors, sampling):
    return (domain(1) + leaf(0.5, 0.4) + prototype("discs", "d.def") + soil(lambertian(0.3)) + light(40, 50)
            + 'sky = { type = "isotropic", radiance = 1.0 }\n' + sensors + f"[sampling]\n{sampling}\n")  # fmt: skip


def coverage(section):
    """Views are independent: one view a thousand times is as many repeats."""
    run = simulate(scene(views([[20, 100]] * repeats), "samples = 512"), {"d.def": two_discs})
    truth = simulate(scene(views([[20, 100]]), "samples = 4194304"), {"d.def": two_discs}, seed=999)
    t = abs(run.hdrf[:, 0] - float(truth.hdrf[0, 0])) / run.hdrf_se[:, 0]
    for part, quantile in ((0.68, 1.0105), (0.95, 2.0395)):  # Student's t with 31 degrees of freedom
        section.compare(f"part of {repeats} estimates (512 paths) within {quantile} standard errors of the value", float((t < quantile).mean()),
                        math.sqrt(part * (1 - part) / repeats), part)  # fmt: skip


def threads(section):
    sensors = views([[20, 100], [50, 210]]) + flux
    runs = [simulate(scene(sensors, "samples = 8192"), {"d.def": two_discs}, arguments=("--threads", str(n))) for n in (1, 2, 7)]
    off = 0
    for name, one in runs[0].data_vars.items():
        for other in runs[1:]:
            off += not numpy.array_equal(one.values, other[name].values, equal_nan=one.dtype.kind == "f")
    section.equal_by(f"1, 2 and 7 threads: bits of all {len(runs[0].data_vars)} variables of a result (differing ones)", off, 0)


def lobes(page):
    """What test_materials records of its chi-square tests: by lobe, that of each view."""
    section = page.section("Sampling of lobes", "Draws of every lobe against its own density (200 000 draws, up to 1024 bins, views at 0, 20, 50, 75 degrees), "
                           "as recorded by `test_materials`; all views of a lobe together; with the largest "
                           "directional albedo by quadrature, and the most that a BRDF changes when sun and view change places. A formula may give out "
                           "more than comes in: that is noted by the program, never clamped.")  # fmt: skip
    program = settings.tests / "materials/test_materials"
    if not program.exists():
        raise SystemExit(f"error: {program} is not there: build it with ninja -C build/release test_materials")
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder, "out.json")
        subprocess.run([program, "--gtest_output=json:" + str(out), "--gtest_brief=1"], check=True, capture_output=True)
        suites = json.loads(out.read_text())["testsuites"]
    sums = collections.OrderedDict()
    for suite in suites:
        for test in suite["testsuite"]:
            for key, value in test.items():
                if not key.startswith("lobe_"):
                    continue
                what, _, chi2, freedom, albedo, exchanged = value.split("|")
                name = " ".join(what.replace("type = ", "").replace('"', "").split())
                lobe = sums.setdefault(name, {"views": 0, "chi2": 0.0, "freedom": 0.0, "albedo": 0.0, "exchanged": []})
                lobe["views"] += 1
                lobe["chi2"] += float(chi2)
                lobe["freedom"] += float(freedom)
                lobe["albedo"] = max(lobe["albedo"], float(albedo))
                lobe["exchanged"] += [float(exchanged)] if exchanged else []
    rows = []
    for what, lobe in sums.items():
        spread = 2 / (9 * lobe["freedom"])
        z = ((lobe["chi2"] / lobe["freedom"]) ** (1 / 3) - (1 - spread)) / math.sqrt(spread)  # Wilson & Hilferty 1931
        page.count(z < 4)
        rows.append((what, f"{lobe['chi2']:.0f}", f"{lobe['freedom']:.0f}", f"{z:+.2f}" if z < 4 else f"**{z:+.2f}, beyond**", f"{lobe['albedo']:.4f}",
                     f"{max(lobe['exchanged']):.0e}" if lobe["exchanged"] else "not reciprocal"))  # fmt: skip
    section.table(("lobe", "chi-square", "degrees of freedom", "z", "largest albedo", "exchange of sun and view"), rows)


def validate(page):
    section = page.section("Standard errors and threads", "A small scene of two discs under sun and sky.")
    coverage(section)
    threads(section)
    lobes(page)
