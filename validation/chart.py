"""One chart as SVG: lines, and points with error bars. Colours are apart for colour-blind readers (Okabe & Ito)."""
import math
from xml.sax.saxutils import escape

COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"]


def ticks(low, high, about=6):
    rough = (high - low) / about
    unit = 10 ** math.floor(math.log10(rough))
    step = next(unit * m for m in (1, 2, 2.5, 5, 10) if unit * m >= rough * 0.999)
    first = math.ceil(low / step - 1e-9)
    return [i * step for i in range(first, math.floor(high / step + 1e-9) + 1)]


def labels(values):
    """All with the decimals of their step."""
    step = min((abs(b - a) for a, b in zip(values, values[1:])), default=abs(values[0]) or 1) if values else 1
    decimals = next((d for d in range(9) if abs(round(step, d) - step) < 1e-6 * step), 9)
    return [f"{v if abs(v) > 1e-9 * step else 0:.{decimals}f}" for v in values]


class Chart:
    def __init__(self, title, x, y, width=640, height=360):
        self.title, self.x, self.y, self.width, self.height = title, x, y, width, height
        self.series = []

    def line(self, name, xs, ys, dashed=False):
        self.series.append((name, list(xs), list(ys), None, "dashed" if dashed else "line"))

    def points(self, name, xs, ys, errors=None):
        self.series.append((name, list(xs), list(ys), list(errors) if errors is not None else [0] * len(list(xs)), "points"))

    def write(self, path):
        left, right, top, bottom = 66, 14, 30 + 17 * ((len(self.series) + 1) // 2), 46
        xs = [v for s in self.series for v in s[1] if v == v]
        ys = [v + k * e for s in self.series for v, e in zip(s[2], s[3] or [0] * len(s[2])) if v == v for k in (-1, 1)]
        x0, x1, y0, y1 = min(xs), max(xs), min(ys), max(ys)
        margin = 0.05 * (y1 - y0 or abs(y1) or 1)
        y0, y1 = y0 - margin, y1 + margin
        x0, x1 = x0 - 0.02 * (x1 - x0), x1 + 0.02 * (x1 - x0)

        def px(v):
            return left + (v - x0) / (x1 - x0) * (self.width - left - right)

        def py(v):
            return self.height - bottom - (v - y0) / (y1 - y0) * (self.height - top - bottom)

        out = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {self.height}" width="{self.width}" '
            f'height="{self.height}" font-family="sans-serif" font-size="12">',
            f'<rect width="{self.width}" height="{self.height}" fill="#fff"/>',
            f'<text x="{left}" y="18" font-size="14">{escape(self.title)}</text>',
        ]
        for v, label in zip(ticks(x0, x1), labels(ticks(x0, x1))):
            out.append(f'<path d="M{px(v):.1f} {top}V{self.height - bottom}" stroke="#ddd"/>')
            out.append(f'<text x="{px(v):.1f}" y="{self.height - bottom + 16}" text-anchor="middle">{label}</text>')
        for v, label in zip(ticks(y0, y1), labels(ticks(y0, y1))):
            out.append(f'<path d="M{left} {py(v):.1f}H{self.width - right}" stroke="#ddd"/>')
            out.append(f'<text x="{left - 6}" y="{py(v) + 4:.1f}" text-anchor="end">{label}</text>')
        out.append(f'<text x="{(left + self.width - right) / 2}" y="{self.height - 10}" text-anchor="middle">{escape(self.x)}</text>')
        middle = (top + self.height - bottom) / 2
        out.append(f'<text transform="translate(14 {middle}) rotate(-90)" text-anchor="middle">{escape(self.y)}</text>')
        for i, (name, xv, yv, errors, kind) in enumerate(self.series):
            colour = COLOURS[i % len(COLOURS)]
            lx, ly = left + 8 + (i % 2) * (self.width - left) / 2, 38 + 17 * (i // 2)
            if kind == "points":
                for x, y, e in zip(xv, yv, errors):
                    if e:
                        out.append(f'<path d="M{px(x):.1f} {py(y - e):.1f}V{py(y + e):.1f}" stroke="{colour}"/>')
                    out.append(f'<circle cx="{px(x):.1f}" cy="{py(y):.1f}" r="2.6" fill="{colour}"/>')
                out.append(f'<circle cx="{lx}" cy="{ly - 4}" r="3" fill="{colour}"/>')
            else:
                dash = ' stroke-dasharray="5 4"' if kind == "dashed" else ""
                d, pen = "", "M"
                for x, y in zip(xv, yv):  # NaN lifts the pen
                    if x == x and y == y:
                        d += f"{pen}{px(x):.1f} {py(y):.1f}"
                    pen = "L" if x == x and y == y else "M"
                out.append(f'<path d="{d}" fill="none" stroke="{colour}" stroke-width="1.5"{dash}/>')
                out.append(f'<path d="M{lx - 8} {ly - 4}h16" stroke="{colour}" stroke-width="1.5"{dash}/>')
            out.append(f'<text x="{lx + 12}" y="{ly}">{escape(name)}</text>')
        out.append("</svg>\n")
        with open(path, "w") as file:
            file.write("\n".join(out))
