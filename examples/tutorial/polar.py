#!/usr/bin/python3
"""A polar map of the BRF of tree.nc in the near infrared, north at the top: polar.py tree.nc OUT.svg"""
import math
import sys

import xarray

run = xarray.open_dataset(sys.argv[1])
brf = run["brf"].sel(band=run["wavelength"].argmax("band"))
low, high = float(brf.min()), float(brf.max())
out = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="-250 -260 500 530" width="500" height="530" font-family="sans-serif" font-size="13">',
       '<rect x="-250" y="-260" width="500" height="530" fill="#fff"/>']  # fmt: skip
zeniths, azimuths = 7, 24
for vza, vaa, value in zip(run["vza"].values, run["vaa"].values, brf.values):
    shade = (value - low) / (high - low)
    colour = f"rgb({round(40 + 215 * shade)},{round(60 + 170 * shade)},{round(120 - 60 * shade)})"
    step = 70 / zeniths
    if vza == 0:
        out.append(f'<circle r="{step * 1.5}" fill="{colour}"/>')
        continue
    inner, outer = (vza - step / 2) * 3, (vza + step / 2) * 3
    corners = []
    for radius, turns in ((inner, (-0.5, 0.5)), (outer, (0.5, -0.5))):
        for turn in turns:
            a = math.radians(vaa + turn * 360 / azimuths)
            corners.append(f"{radius * math.sin(a):.1f} {-radius * math.cos(a):.1f}")
    out.append(f'<path d="M{"L".join(corners)}Z" fill="{colour}" stroke="{colour}"/>')
sun = 35 * 3
a = math.radians(150)
out.append(f'<circle cx="{sun * math.sin(a):.1f}" cy="{-sun * math.cos(a):.1f}" r="7" fill="none" stroke="#000" stroke-width="2"/>')
out.append('<text y="-240" text-anchor="middle">N</text>')
out.append(f'<text y="258" text-anchor="middle">BRF at {float(run["wavelength"].max()):.0f} nm: dark {low:.3f}, bright {high:.3f}; ring: the sun</text>')
out.append("</svg>\n")
open(sys.argv[2], "w").write("\n".join(out))
