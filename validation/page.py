"""What the page says: comparisons with both errors and z, tables, figures. Every number comes from a run.

A comparison is beyond what chance allows where |z| > 4, a chi-square where chance exceeds it less than once in a hundred
times, an equality where it is off by more than the limit stated beside it."""
import math

import pandas

most_z = 4.0


def mean_of(values):
    """Mean of independent draws and its standard error."""
    series = pandas.Series(list(values), dtype=float)
    return float(series.mean()), float(series.std() / math.sqrt(len(series)))


def chi_square_1_percent(freedom):
    """Exceeded by chance once in a hundred times (Wilson & Hilferty 1931)."""
    return freedom * (1 - 2 / (9 * freedom) + 2.326 * math.sqrt(2 / (9 * freedom))) ** 3


def table(head, rows):
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head), *("| " + " | ".join(str(c) for c in r) + " |" for r in rows), ""]


class Section:
    def __init__(self, page, title, words):
        self.page, self.title, self.words = page, title, words
        self.rows, self.equals, self.planes, self.rest = [], [], [], []

    def compare(self, what, value, error, reference, reference_error=0.0):
        z = (value - reference) / math.hypot(error, reference_error)
        self.page.z.append(z)
        within = abs(z) < most_z
        self.page.count(within)
        self.rows.append((what, f"{value:.6f}", f"{error:.1e}", f"{reference:.6f}", f"{reference_error:.1e}" if reference_error else "exact",
                          f"{z:+.2f}" if within else f"**{z:+.2f}, beyond**"))  # fmt: skip

    def equal(self, what, value, reference, limit):
        """Equal but for rounding: relative to the reference, or to 1 where that is 0."""
        off = abs(value - reference) / (abs(reference) or 1.0)
        self.equal_by(what, off, limit)

    def equal_by(self, what, off, limit):
        self.page.count(off <= limit)
        self.equals.append((what, "identical" if off == 0 else f"{off:.1e}", f"{limit:.0e}" if limit else "identical",
                            "yes" if off <= limit else "**no**"))  # fmt: skip

    def plane(self, what, frame, correlated=None):
        """Chi-square over views (value, error, reference, reference_error). Where ours are correlated (`correlated`: their
        covariance from 32 batches) the sum of squares is a scaled chi-square of fewer degrees of freedom (Satterthwaite 1946):
        n^2 / sum(r^2), r^2 less 1/31 of our part, which is its bias."""
        variance = frame.error**2 + frame.reference_error**2
        z = (frame.value - frame.reference) / variance**0.5
        n, chi2 = len(z), float((z**2).sum())
        squares = float(n)
        if correlated is not None:
            both = (correlated**2 / variance.values[:, None]) / variance.values[None, :]
            own = (correlated.diagonal()[:, None] * correlated.diagonal()[None, :]) / variance.values[:, None] / variance.values[None, :]
            r2 = both - own / 31
            squares = max(n, n + float(r2.sum() - r2.diagonal().sum()))  # the estimate may be lower
        freedom = n * n / squares
        limit = chi_square_1_percent(freedom) * n / freedom
        self.page.count(chi2 < limit)
        self.planes.append((what, n, f"{chi2:.1f}", f"{limit:.1f}", f"{z.abs().max():.2f}", "within" if chi2 < limit else "**beyond**"))

    def table(self, head, rows):
        self.rest += ["", *table(head, rows)]

    def text(self, words):
        self.rest += ["", words]

    def figure(self, name, words):
        self.rest += ["", f"![{words}](figures/validation/{name})"]

    def lines(self):
        out = [f"## {self.title}", "", self.words, ""]
        if self.rows:
            out += table(("what", "bpms", "error", "reference", "its error", "z"), self.rows)
        if self.equals:
            out += table(("equal but for rounding", "most off by, relative", "limit", "within"), self.equals)
        if self.planes:
            out += table(("chi-square of", "views", "chi-square", "1 %", "largest \\|z\\|", ""), self.planes)
        return [*out, *self.rest, ""]


class Page:
    def __init__(self):
        self.sections, self.z, self.within, self.all = [], [], 0, 0

    def section(self, title, words):
        self.sections.append(Section(self, title, words))
        return self.sections[-1]

    def count(self, within):
        self.all += 1
        self.within += bool(within)

    def good(self):
        return self.within == self.all

    def text(self, head):
        n, squares = len(self.z), sum(z * z for z in self.z)
        summary = f"{self.within} of {self.all} comparisons are within their limits."
        if n > 0:
            summary += (f" Of the {n} with a z, the sum of squares is {squares:.1f} "
                        f"({chi_square_1_percent(n):.1f} is exceeded once in a hundred times by as many independent ones), the mean {sum(self.z) / n:+.2f}, "
                        f"the largest {max(abs(z) for z in self.z):.2f}.")  # fmt: skip
        lines = ["# Validation", "", head, "", summary, ""]
        for section in self.sections:
            lines += section.lines()
        text = "\n".join(lines)
        while "\n\n\n" in text:
            text = text.replace("\n\n\n", "\n\n")
        return text.rstrip() + "\n"
