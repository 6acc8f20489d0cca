"""Principal planes of published and independent references, from the sensors and from the light."""
import math

import numpy
import pandas

import scenes
import settings
from chart import Chart
from scenes import light, principal, red_and_nir, sampling, simulate


words = {"red": "red", "nir": "near infrared"}


def chart_of(name, title, frame, forward):
    chart = Chart(title, "view zenith / degrees, negative on the sun's side", "BRF")
    chart.line("reference", frame.vza, frame.reference)
    chart.points("bpms, reverse", frame.vza, frame.value, frame.error)
    chart.points("bpms, forward", forward.vza, forward.value, forward.error)
    chart.write(settings.figures / name)


def residuals(name, title, reverse, forward):
    """The differences from the reference in standard errors of both; two of these either way."""
    chart = Chart(title, "view zenith / degrees, negative on the sun's side", "difference / error", height=220)
    ends = [min(reverse.vza), max(reverse.vza)]
    chart.line("2 standard errors", [*ends, math.nan, *ends], [2, 2, math.nan, -2, -2], dashed=True)
    for mode, frame in (("reverse", reverse), ("forward", forward)):
        chart.points(f"bpms, {mode}", frame.vza, (frame.value - frame.reference) / (frame.error**2 + frame.reference_error**2) ** 0.5)
    chart.write(settings.figures / name)


def from_the_light(text, vza, bands, samples, runs=6):
    """BRF, errors (views x bands) and covariance (bands x views x views) by shared paths. Neighbouring views of one run have nearly the
    same errors, and a chi-square of them tells little: each run has every sixth view, and a seed of its own."""
    vza = list(vza)
    value, error, covariance = None, None, None
    for run in range(runs):
        rows = list(range(run, len(vza), runs))
        found = simulate(text + light(20) + principal(vza[i] for i in rows) + bands + sampling(samples, 'mode = "forward"'), seed=settings.seed + 1 + run)
        if value is None:
            count = found.sizes["band"]
            value, error, covariance = (numpy.zeros(shape) for shape in ((len(vza), count), (len(vza), count), (count, len(vza), len(vza))))
        value[rows], error[rows] = found.brf.values, found.brf_se.values
        # The light is "brf": radiance is the reflectance factor.
        covariance[numpy.ix_(range(count), rows, rows)] = found.covariance.values
    return value, error, covariance


def compare(section, what, text, reference, band, chart_name, title, bands, samples, forward_samples):
    """reference: vza, value, error. In both modes against it, and the modes against each other."""
    run = simulate(text + light(20) + principal(reference.vza) + bands + sampling(samples))
    shared, shared_error, shared_covariance = from_the_light(text, reference.vza, bands, forward_samples)
    for number, name in enumerate(band):
        of_reference = {"reference": reference[f"{name}_value"], "reference_error": reference[f"{name}_error"]}
        reverse = pandas.DataFrame({"vza": reference.vza, "value": run.brf[:, number], "error": run.brf_se[:, number], **of_reference})
        forward = pandas.DataFrame({"vza": reference.vza, "value": shared[:, number], "error": shared_error[:, number], **of_reference})
        covariance = shared_covariance[number]
        section.plane(f"{what}, {words[name]}, reverse - reference", reverse)
        section.plane(f"{what}, {words[name]}, forward - reference", forward, covariance)
        both = forward.assign(reference=reverse.value, reference_error=reverse.error)
        section.plane(f"{what}, {words[name]}, forward - reverse", both, covariance)
        band_title = title.format(words[name])
        chart_of(chart_name.format(name), band_title, reverse, forward)
        section.figure(chart_name.format(name), band_title)
        residuals(chart_name.format(name + "_z"), band_title + ": off by", reverse, forward)
        section.figure(chart_name.format(name + "_z"), band_title + ": differences in standard errors")


def validate(page):
    section = page.section("Principal planes", "Chi-square takes both errors in; 1 % is the value that chance exceeds once in a hundred times. Views of the forward mode "
                           "share paths: their covariance is in that value.")  # fmt: skip
    table = pandas.read_csv(settings.data / "bench_hom/reference_brf.csv", comment="#")
    reference = pandas.DataFrame({"vza": table.vza_deg, **{f"{n}_value": table[f"{n}_brf"] for n in ("red", "nir")},
                                  **{f"{n}_error": table[f"{n}_se"] for n in ("red", "nir")}})  # fmt: skip
    compare(section, "homogeneous canopy of discs (bench_hom)", scenes.bench_hom(scenes.bench_hom_leaf, scenes.bench_hom_soil), reference, ("red", "nir"),
            "homogeneous_{}.svg", "Homogeneous canopy of discs, LAI 3, {}, sun at 20 degrees", red_and_nir, 65536, 262144)  # fmt: skip
    table = pandas.read_csv(settings.data / "rami/het01/het01_brfpp_ref.csv", comment="#")
    reference = pandas.DataFrame({"vza": table.vza_deg, "nir_value": table.brf, "nir_error": table.radiance_var**0.5 * table.brf / table.radiance})
    compare(section, "RAMI HET01", scenes.het01(), reference, ("nir",), "het01_{}.svg", "RAMI HET01 floating spheres, {}, sun at 20 degrees", "",
            16384, 131072)  # fmt: skip
