# SPDX-License-Identifier: Apache-2.0
"""Means and shares with their 95 % intervals, as docs/reference/metrics.md defines them and
src/evaluation/estimate.cpp has them."""
import math
import statistics

NORMAL_QUANTILE = statistics.NormalDist().inv_cdf(0.975)


def student_quantile(degrees_of_freedom):
    """The 97.5 % quantile of Student's t: exact of one and two degrees of freedom, Abramowitz and Stegun 26.7.5 from
    there on, to 0.2 %."""
    z, n = NORMAL_QUANTILE, degrees_of_freedom
    if n == 1:
        return math.tan(math.pi * 0.475)
    if n == 2:
        return 0.95 * math.sqrt(2 / (1 - 0.95**2))
    terms = [(z**3 + z) / 4, (5 * z**5 + 16 * z**3 + 3 * z) / 96, (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / 384,
             (79 * z**9 + 776 * z**7 + 1482 * z**5 - 1920 * z**3 - 945 * z) / 92160]
    return z + sum(term / n**(k + 1) for k, term in enumerate(terms))


def mean_and_interval(values):
    """Mean and half width; the latter is None for less than two values, both for none."""
    if not values:
        return {"mean": None, "half_width": None, "count": 0}
    half_width = None
    if len(values) > 1:
        half_width = student_quantile(len(values) - 1) * statistics.stdev(values) / math.sqrt(len(values))
    return {"mean": statistics.fmean(values), "half_width": half_width, "count": len(values)}


def share_and_interval(successes, count):
    """Percent, with Wilson's score interval; None of nothing."""
    if count == 0:
        return {"percent": None, "low": None, "high": None, "count": 0}
    z, p = NORMAL_QUANTILE, successes / count
    centre = (p + z * z / (2 * count)) / (1 + z * z / count)
    reach = z / (1 + z * z / count) * math.sqrt(p * (1 - p) / count + z * z / (4 * count * count))
    return {"percent": 100 * p, "low": 100 * max(centre - reach, 0), "high": 100 * min(centre + reach, 1),
            "count": count}
