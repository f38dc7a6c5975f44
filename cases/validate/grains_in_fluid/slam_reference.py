#!/usr/bin/python3
"""Added mass of a sphere that dips into water by h: the reference of grains_in_fluid.slamming_sphere.

Potential flow of water that is set in motion at once: on the wetted cap d phi/dn = v n_z, on the level, which stays
plane, phi = 0. Rings of sources on the cap and of the opposite strength above the level, flux at the middle of each of
n panels that crowd at the waterline. Prints m / (rho R^3) at h / R = 0.3, 0.5, 1 with 20 and 40 panels. Check: at 1 it
is half that of a sphere, pi / 3. Two seconds.
"""
from math import acos, cos, pi, sin, sqrt

GAUSS = [(x * s, w) for s in (-1, 1) for x, w in (
    (0.1834346424956498, 0.3626837833783620), (0.5255324099163290, 0.3137066458778873),
    (0.7966664774136267, 0.2223810344533745), (0.9602898564975363, 0.1012285362903763))]


def elliptic(m, rest):
    """Complete integrals K and E of the parameter m = 1 - rest, by the arithmetic-geometric mean."""
    a, g, power, sum_of_squares = 1.0, sqrt(rest), 0.5, 0.5 * m
    while abs(a - g) > 1e-15 * a:
        a, g, c = 0.5 * (a + g), sqrt(a * g), 0.5 * (a - g)
        power *= 2
        sum_of_squares += power * c * c
    k = pi / (2 * a)
    return k, k * (1 - sum_of_squares)


def ring(r, z, r0, z0):
    """Potential of a ring of sources of radius r0 at z0, of strength 1 a length, and its gradient along r and z."""
    far, near = (r + r0) ** 2 + (z - z0) ** 2, (r - r0) ** 2 + (z - z0) ** 2
    k, e = elliptic(4 * r * r0 / far, near / far)
    scale = r0 / (pi * sqrt(far))
    along_r = scale / (2 * r) * ((r0 * r0 - r * r + (z - z0) ** 2) / near * e - k)
    return scale * k, along_r, -scale * (z - z0) * e / near


def pieces(low, high, own):
    """A panel for integration: its own, where the field is singular, in pieces that shrink towards its middle."""
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    if not own:
        return [(low + (high - low) * k / 4, low + (high - low) * (k + 1) / 4) for k in range(4)]
    steps = [(half * 0.5 ** (k + 1), half * 0.5**k) for k in range(20)]
    return [(middle + a, middle + b) for a, b in steps] + [(middle - b, middle - a) for a, b in steps]


def solve(matrix, right):
    rows = [row + [value] for row, value in zip(matrix, right)]
    n = len(rows)
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, n):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [x - factor * y for x, y in zip(rows[i], rows[k])]
    x = [0.0] * n
    for k in reversed(range(n)):
        x[k] = (rows[k][n] - sum(rows[k][j] * x[j] for j in range(k + 1, n))) / rows[k][k]
    return x


def added_mass(h, n):
    waterline = acos(1 - h)  # angle from the lowest point
    edges = [waterline * sin(0.5 * pi * k / n) for k in range(n + 1)]
    middles = [0.5 * (a + b) for a, b in zip(edges, edges[1:])]
    potential, flux = [[0.0] * n for _ in range(n)], [[0.0] * n for _ in range(n)]
    for i, t in enumerate(middles):
        r, z, normal_r, normal_z = sin(t), 1 - h - cos(t), sin(t), -cos(t)
        for j in range(n):
            for low, high in pieces(edges[j], edges[j + 1], i == j):
                for x, w in GAUSS:
                    s = 0.5 * (low + high + (high - low) * x)
                    p, along_r, along_z = ring(r, z, sin(s), 1 - h - cos(s))
                    image, image_r, image_z = ring(r, z, sin(s), cos(s) - 1 + h)
                    weight = 0.5 * (high - low) * w
                    potential[i][j] += weight * (p - image)
                    flux[i][j] += weight * ((along_r - image_r) * normal_r + (along_z - image_z) * normal_z)
        flux[i][i] -= 0.5  # on the side of the water
    strengths = solve(flux, [cos(t) for t in middles])  # the sphere moves down
    mass = 0.0
    for i, t in enumerate(middles):
        phi = sum(p * s for p, s in zip(potential[i], strengths))
        mass -= phi * cos(t) * 2 * pi * sin(t) * (edges[i + 1] - edges[i])
    return mass


if __name__ == "__main__":
    for panels in (20, 40):
        print(panels, " ".join(f"{added_mass(h, panels):.4f}" for h in (0.3, 0.5, 1.0)))
