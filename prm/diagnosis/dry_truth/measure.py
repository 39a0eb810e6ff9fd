#!/usr/bin/env python3
"""measure.py DUMP...: dynamic angle of the bed, degrees, mean over the frames, spread and correlation time: straight line through the middle 70 % of the
upper contour of the spheres' picture along the axis; and of the line from the axis to the centre of mass, against the vertical."""
import math, sys
R, PIXEL = 0.030, 1e-4

def frames(name):
    for block in open(name).read().split("ITEM: TIMESTEP\n")[1:]:
        yield [[float(v) for v in line.split()] for line in block.split("omegaz \n" if "omegaz \n" in block else "omegaz\n")[1].splitlines()]

def line_slope(x, y):
    n, mx, my = len(x), sum(x) / len(x), sum(y) / len(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)

def contour_angle(atoms, r):
    n = round(2 * R / PIXEL)
    top = [-1.0] * n
    for a in atoms:
        for k in range(max(0, math.ceil((a[1] - r + R) / PIXEL - 0.5)), min(n, math.floor((a[1] + r + R) / PIXEL - 0.5) + 1)):
            top[k] = max(top[k], a[2] + math.sqrt(max(0.0, r * r - (-R + (k + 0.5) * PIXEL - a[1]) ** 2)))
    points = [(-R + (k + 0.5) * PIXEL, t) for k, t in enumerate(top) if t > -1 and math.hypot(-R + (k + 0.5) * PIXEL, t) < R - 0.5 * r]  # not the spheres at the shell
    middle, half = 0.5 * (points[0][0] + points[-1][0]), 0.5 * (points[-1][0] - points[0][0])
    points = [p for p in points if abs(p[0] - middle) < 0.7 * half]
    return math.degrees(math.atan(line_slope(*zip(*points))))

def angles(name, diameter):
    """Both angles of every frame."""
    both = [(contour_angle(atoms, diameter / 2), math.degrees(math.atan2(sum(a[1] for a in atoms), -sum(a[2] for a in atoms))))
            for atoms in frames(name)]
    return [list(v) for v in zip(*both)]

mean = lambda v: sum(v) / len(v)
spread = lambda v: math.sqrt(sum((a - mean(v)) ** 2 for a in v) / (len(v) - 1))
blocks = lambda v, n: [mean(v[i:i + n]) for i in range(0, len(v) - n + 1, n)]

def correlation_time(v, interval):
    """Integral of the autocorrelation up to its first zero, in units of the interval."""
    d = [a - mean(v) for a in v]
    total, k = 0.5, 1
    while k < len(d) // 2 and (c := sum(a * b for a, b in zip(d, d[k:])) / (len(d) - k)) > 0:
        total, k = total + c / (sum(a * a for a in d) / len(d)), k + 1
    return interval * total

if __name__ == "__main__":
    for name in sys.argv[1:]:
        for what, v in zip(("contour", "centre of mass"), angles(name, float(name.split("_")[-3]))):
            print(name, "%s %.2f (%.2f), correlation time %.2f s, %d frames" % (what, mean(v), spread(v), correlation_time(v, 0.04), len(v)))
