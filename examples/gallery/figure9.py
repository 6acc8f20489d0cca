#!/usr/bin/python3
"""Aspect ratio and field of view of the pictures of figure9.nc against their formulas: figure9.py figure9.nc OUT.svg"""
import math
import sys

import xarray


from chart import Chart

run = xarray.open_dataset(sys.argv[1])
area_m, distance_m = 2.0, 4.0
zeniths = range(0, 90, 10)


def ratio(kind, vza):  # height over width of a picture, in pixels
    return run.sizes[f"{kind}_{vza}_y"] / run.sizes[f"{kind}_{vza}_x"]


def edges(vza):  # of the perspective view, above and below the line to the point
    t, half = math.radians(vza), area_m / 2
    return [math.atan(half * math.cos(t) / (distance_m + s * half * math.sin(t))) for s in (1, -1)]


def field(vza):  # from the picture: its width is right at the depth of the point it looks about
    far, near = edges(vza)
    half_width = area_m / 2 / (distance_m * math.cos((near - far) / 2))
    return math.degrees(2 * math.atan(ratio("perspective", vza) * half_width))


chart = Chart("Boom: the same 2 x 2 m of ground seen from every angle", "view zenith / degrees",
              "aspect ratio; field of view / 10 degrees", height=380)
fine = [v for v in range(0, 81)]
chart.line("aspect ratio, 1 / cos", fine, [1 / math.cos(math.radians(v)) for v in fine])
chart.line("field of view from 4 m, near + far edge", fine, [math.degrees(sum(edges(v))) / 10 for v in fine])
chart.points("pictures, orthographic", zeniths, [1 / ratio("orthographic", v) for v in zeniths])
chart.points("pictures, perspective", zeniths, [field(v) / 10 for v in zeniths])
chart.write(sys.argv[2])
for v in zeniths:
    print(f"{v:3d} aspect {1 / ratio('orthographic', v):.3f} ({1 / math.cos(math.radians(v)):.3f})   "
          f"field {field(v):.2f} ({math.degrees(sum(edges(v))):.2f})")
