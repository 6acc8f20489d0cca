"""Runs of the program over scenes written as scene.toml; pieces of such scenes."""
import math
import pathlib
import random
import subprocess
import tempfile

import xarray

import settings

white_sky = "[illumination]\nsky = { type = \"isotropic\", radiance = 1.0 }\n"


def simulate(scene, files=None, seed=None, arguments=()):
    """The results of a scene.toml, as a dataset. `files`: by name, those that it names in its folder."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {**(files or {}), "scene.toml": scene}.items():
            pathlib.Path(folder, name).write_text(text)
        command = [settings.bpms, "simulate", "scene.toml", "-o", "out.nc", "--quiet", "--seed", str(seed or settings.seed)]
        done = subprocess.run([*command, *arguments], cwd=folder, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f"{done.stderr}\n{scene}")
        return xarray.load_dataset(pathlib.Path(folder, "out.nc"))


def domain(size_m, more=""):
    return f"[domain]\nsize_m = [{size_m}, {size_m}]\n{more}"


def light(sza, saa=0, irradiance='"brf"'):
    return f"[illumination]\nsun = {{ zenith_deg = {sza}, azimuth_deg = {saa}, irradiance = {irradiance} }}\n"


def soil(body):
    return f'[materials.soil]\n{body}\n[ground]\ntype = "plane"\nmaterial = "soil"\n'


def lambertian(reflectance):
    return f'type = "lambertian"\nreflectance = {reflectance}'


def leaf(rho, tau):
    return f'[materials.leaf]\ntype = "bilambertian"\nreflectance = {rho}\ntransmittance = {tau}\n'


def prototype(kind, file, positions="[[0, 0, 0]]"):
    return (f'[prototypes.canopy]\n{kind} = "{file}"\nmaterial = "leaf"\n'
            f'[[instances]]\nprototype = "canopy"\npositions = {positions}\n')  # fmt: skip


def principal(angles):
    return f'[[sensors]]\nname = "pp"\ntype = "brf"\nplane = "principal"\nvza_deg = {[float(a) for a in angles]}\n'


def views(directions):
    return f'[[sensors]]\nname = "views"\ntype = "brf"\nviews = {[[float(a) for a in d] for d in directions]}\n'


albedo = '[[sensors]]\nname = "albedo"\ntype = "albedo"\n'
flux = '[[sensors]]\nname = "flux"\ntype = "flux"\n'


def sampling(samples, more=""):
    return f"[sampling]\nsamples = {int(samples * settings.more)}\n{more}\n"


def discs(lai, radius_m, size_m, bottom_m, top_m, draw):
    """Rows of a disc list: positions uniform in the cell and the layer, normals uniform on the sphere."""
    numbers = random.Random(draw)
    out = []
    for _ in range(disc_count(lai, radius_m, size_m)):
        x, y = (numbers.uniform(-size_m / 2, size_m / 2) for _ in range(2))
        z, up, turn = numbers.uniform(bottom_m, top_m), numbers.random(), numbers.uniform(0, 2 * math.pi)
        across = math.sqrt(1 - up * up)
        out.append(f"{radius_m} {x:.6f} {y:.6f} {z:.6f} {across * math.cos(turn):.6f} {across * math.sin(turn):.6f} {up:.6f}\n")
    return "".join(out)


def disc_count(lai, radius_m, size_m):
    return round(lai * size_m**2 / (math.pi * radius_m**2))


def towards(zenith_deg, azimuth_deg):
    zenith, azimuth = math.radians(zenith_deg), math.radians(azimuth_deg)
    return (math.sin(zenith) * math.sin(azimuth), math.sin(zenith) * math.cos(azimuth), math.cos(zenith))


def bench_hom(leaf_text, soil_text, size=25):
    """The homogeneous canopy of bench_hom: LAI 3, discs of 5 cm."""
    return domain(size) + leaf_text + prototype("discs", settings.data / "bench_hom/hom_discs.def.gz") + soil(soil_text)


bench_hom_leaf = leaf("[[650, 0.0546], [850, 0.4957]]", "[[650, 0.0149], [850, 0.4409]]")
bench_hom_soil = lambertian("[[650, 0.127], [850, 0.159]]")
red_and_nir = "[bands]\nwavelengths_nm = [650, 850]\n"


def het01():
    """RAMI HET01, floating spheres, in the near infrared."""
    folder = settings.data / "rami/het01"
    return (domain(100, 'azimuth_convention = "east_counterclockwise"\n') + leaf(0.4957, 0.4409)
            + prototype("discs", folder / "het01_UNI_sphere.def", f'"{folder}/het01_UNI_instances.def"')
            + soil(lambertian(0.159)))  # fmt: skip
