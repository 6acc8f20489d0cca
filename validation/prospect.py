"""A homogeneous canopy of discs whose leaves are made by PROSPECT, 400-2500 nm: the leaf itself over black ground, the canopy against
the same canopy with the leaf's spectra given as files, and its red edge."""
import numpy
import pandas

import scenes
import settings
from chart import Chart
from scenes import domain, lambertian, leaf, light, prototype, sampling, simulate, soil, views

spectra = settings.data / "optics/jbferet-prosail"
material = (f'[materials.leaf]\ntype = "prospect"\ncoefficients = "{spectra}/dataSpec_PRO_v2.txt"\nn_layers = 1.5\ncab_ug_cm2 = 40\n'
            "car_ug_cm2 = 8\ncw_cm = 0.012\ncm_g_cm2 = 0.007\n")  # fmt: skip
wavelengths = sorted({*range(400, 2501, 10), *range(680, 761, 2)})


def soil_table():
    return pandas.read_csv(spectra / "dataSpec_SOIL_atbd_v2.txt", sep=r"\s+").set_index("lambda").soil_04


def soil_at(nm):
    return float(soil_table()[nm])


def files():
    """The soil's spectrum, nm and reflectance."""
    return {"soil.csv": "".join(f"{nm},{value}\n" for nm, value in soil_table().items())}


def canopy(leaf_text=material):
    return scenes.bench_hom(leaf_text, lambertian('"soil.csv"'))


def bands(which):
    return f"[bands]\nwavelengths_nm = {list(which)}\n"


def leaf_spectra():
    """Reflectance and transmittance: of one leaf that covers the cell over black ground, seen from above and from beneath."""
    sheet = "v -1 -1 0.5\nv 1 -1 0.5\nv 1 1 0.5\nv -1 1 0.5\nf 1 2 3\nf 1 3 4\n"
    run = simulate(domain(2) + material + prototype("mesh", "sheet.obj") .replace("material =", 'up = "z"\nmaterial =') + soil(lambertian(0)) + light(30)
                   + views([[20, 90]]) + '[[sensors]]\nname = "under"\ntype = "albedo"\nlooking = "up"\nheight_m = 0.1\n' + bands(wavelengths)
                   + "[sampling]\nsamples = 64\nroulette = false\n", {"sheet.obj": sheet})  # fmt: skip
    return run.views_brf[0].values, run.under_transmittance[0].values


def canopy_brf(leaf_text, more, seed):
    looks = views([[0, 0], [50, 180]])
    return simulate(canopy(leaf_text) + light(30) + looks + bands(wavelengths) + sampling(16384), {**files(), **more}, seed)


def red_edge(values):
    """The wavelength of the steepest rise between 680 and 760 nm, by the parabola through the three largest differences."""
    nm = numpy.array([w for w in wavelengths if 680 <= w <= 760], dtype=float)
    slope = numpy.diff([values[wavelengths.index(int(w))] for w in nm]) / numpy.diff(nm)
    middle = (nm[1:] + nm[:-1]) / 2
    at = min(max(int(slope.argmax()), 1), len(slope) - 2)
    a, b, _ = numpy.polyfit(middle[at - 1 : at + 2], slope[at - 1 : at + 2], 2)
    return float(-b / (2 * a))


def validate(page):
    section = page.section("PROSPECT canopy", f"The discs of bench_hom (LAI 3) with leaves by PROSPECT (N 1.5, 40 µg chlorophyll, 8 µg carotenoids, 12 mg water and 7 mg dry "
                           f"matter cm⁻²) over a measured soil, {len(wavelengths)} bands from 400 to 2500 nm in one run; sun at 30 degrees. Its energy is in the "
                           "section on energy.")  # fmt: skip
    rho, tau = leaf_spectra()
    given = leaf('"rho.csv"', '"tau.csv"')
    leaf_files = {name: "".join(f"{nm},{float(v)!r}\n" for nm, v in zip(wavelengths, values)) for name, values in (("rho.csv", rho), ("tau.csv", tau))}
    made = canopy_brf(material, {}, settings.seed)
    same = canopy_brf(given, leaf_files, settings.seed)
    other = canopy_brf(given, leaf_files, settings.seed + 1)
    section.equal_by("canopy of PROSPECT leaves and of its spectra as files, the same paths: BRF in all bands, two views",
                     float(abs(made.brf / same.brf - 1).max()), 1e-5)  # fmt: skip
    for nm in (450, 550, 680, 720, 850, 1450, 1650, 2200):
        band = wavelengths.index(nm)
        for view, vza in enumerate((0, 50)):
            section.compare(f"BRF of the PROSPECT canopy and of the files, other paths, {nm} nm, vza {vza}", float(made.brf[view, band]),
                            float(made.brf_se[view, band]), float(other.brf[view, band]), float(other.brf_se[view, band]))  # fmt: skip
    absorbed = 1 - rho - tau
    section.table(("nm", "leaf reflectance", "leaf transmittance", "leaf absorbs", "soil", "canopy BRF at nadir", "its error"),
                  [(nm, f"{rho[i]:.4f}", f"{tau[i]:.4f}", f"{absorbed[i]:.4f}", f"{soil_at(nm):.4f}", f"{float(made.brf[0, i]):.4f}", f"{float(made.brf_se[0, i]):.1e}")
                   for nm in (450, 550, 680, 720, 850, 1450, 1650, 2200) for i in (wavelengths.index(nm),)])  # fmt: skip
    section.text(f"The red edge (steepest rise) lies at {red_edge(rho):.1f} nm in the leaf's reflectance and at {red_edge(made.brf[0].values):.1f} nm in the canopy's BRF: "
                 "light scattered by leaf after leaf adds most where leaves absorb least, which moves the edge to longer wavelengths.")  # fmt: skip
    chart = Chart("PROSPECT canopy, LAI 3, sun at 30 degrees", "wavelength / nm", "BRF, reflectance")
    chart.line("canopy, nadir", wavelengths, made.brf[0].values)
    chart.line("canopy, 50 degrees on the far side", wavelengths, made.brf[1].values)
    chart.line("leaf reflectance", wavelengths, rho, dashed=True)
    chart.line("leaf transmittance", wavelengths, tau, dashed=True)
    chart.line("soil", wavelengths, [soil_at(nm) for nm in wavelengths], dashed=True)
    chart.write(settings.figures / "prospect.svg")
    section.figure("prospect.svg", "BRF of the PROSPECT canopy from 400 to 2500 nm, its leaves and its soil")
