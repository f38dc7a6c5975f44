#!/usr/bin/python3
"""Heave of a floating sphere after its release from rest: the reference of grains_in_fluid.floating_sphere.

Linear potential flow with a free surface, round tank, axisymmetric linear finite elements between the wetted sphere and
the walls (numpy). The potential phi obeys, on the surface z = 0, phi_t = -g eta and eta_t = phi_z; on the body,
d phi/dn = w n_z; the body m w' = -rho g A z - rho int phi_t n_z dS, with phi_t = psi from the same boundary problem.
Checks: the added mass at high frequency of a half-submerged sphere is 0.498 of its mass in a tank of 16 diameters
(theory: 1/2). Prints the turns as (2 t / dry period, place / D). About 10 CPU seconds a line.
"""
import numpy as np


def immersion(s):
    low, high = 0.0, 1.0
    for _ in range(60):
        x = (low + high) / 2
        low, high = (x, high) if 3 * x * x - 2 * x**3 < s else (low, x)
    return low


def fan(radius, centre, tank_radius, depth, n, m):
    """Nodes [along the body from its lowest point to the waterline][from the body to the tank]."""
    angle = np.arccos(centre / radius) * np.linspace(0, 1, n + 1)
    body = np.stack([radius * np.sin(angle), centre - radius * np.cos(angle)], 1)
    corner = round(0.45 * n)
    outer = np.stack([np.concatenate([np.linspace(0, tank_radius, corner + 1), np.full(n - corner, tank_radius)]),
                      np.concatenate([np.full(corner + 1, -depth), np.linspace(-depth, 0, n - corner + 1)[1:]])], 1)
    t = (1.06 ** np.arange(m + 1) - 1) / (1.06**m - 1)
    return body[:, None, :] * (1 - t)[None, :, None] + outer[:, None, :] * t[None, :, None]


def stiffness(x, index):
    k = np.zeros((len(x), len(x)))
    for e in range(index.shape[0] - 1):
        for f in range(index.shape[1] - 1):
            a, b, c, d = index[e, f], index[e, f + 1], index[e + 1, f + 1], index[e + 1, f]
            for nodes in ((a, b, c), (a, c, d)):
                p = x[list(nodes)]
                matrix = np.column_stack([np.ones(3), p])
                gradient = np.linalg.inv(matrix)[1:]
                volume = np.pi * p[:, 0].mean() * abs(np.linalg.det(matrix))
                k[np.ix_(nodes, nodes)] += volume * gradient.T @ gradient
    return k


def release(s, tank=4 / np.sqrt(np.pi), depth=None, diameter=8.0, gravity=1e-4, n=24, m=44, start=0.1):
    """Lengths in cells of the entry; the tank's radius in diameters (default: the area of the entry's tank)."""
    radius = diameter / 2
    centre = radius - immersion(s) * diameter
    depth = depth or 2 * diameter + 0.4 + s * np.pi / 6 * diameter / 16
    places = fan(radius, centre, tank * diameter, depth, n, m)
    index = np.arange(places.shape[0] * places.shape[1]).reshape(places.shape[:2])
    x = places.reshape(-1, 2)
    k, push, area = stiffness(x, index), np.zeros(len(x)), np.zeros(m + 1)
    for e in range(n):  # int N n_z dS, n into the liquid
        p, q = x[index[e, 0]], x[index[e + 1, 0]]
        push[index[e, 0]] -= np.pi * (2 * p[0] + q[0]) / 3 * (q[0] - p[0])
        push[index[e + 1, 0]] -= np.pi * (p[0] + 2 * q[0]) / 3 * (q[0] - p[0])
    surface = index[n]
    for f in range(m):
        p, q = x[surface[f], 0], x[surface[f + 1], 0]
        area[f] += np.pi * (2 * p + q) / 3 * (q - p)
        area[f + 1] += np.pi * (p + 2 * q) / 3 * (q - p)
    inner = np.setdiff1d(np.arange(len(x)), surface)
    inverse = np.linalg.inv(k[np.ix_(inner, inner)])
    coupling = k[np.ix_(inner, surface)]
    from_surface, from_body = -inverse @ coupling, -inverse @ push[inner]
    added = -push[inner] @ from_body
    rise = coupling.T @ from_surface + k[np.ix_(surface, surface)]
    rise_body = coupling.T @ from_body + push[surface]
    force = push[inner] @ from_surface + push[surface]
    mass, spring = s * 4 / 3 * np.pi * radius**3, gravity * np.pi * (radius**2 - centre**2)
    dry = 2 * np.pi * np.sqrt(mass / spring)

    def rates(y):
        phi, eta, z, w = y[: m + 1], y[m + 1 : 2 * m + 2], y[-2], y[-1]
        fall = (-spring * z - gravity * force @ eta) / (mass + added)
        return np.concatenate([-gravity * eta, (rise @ phi + w * rise_body) / area, [w, fall]])

    y, dt, turns = np.zeros(2 * m + 4), dry / 400, []
    y[-2] = start * diameter
    for step in range(1600):
        a = rates(y)
        b = rates(y + dt / 2 * a)
        c = rates(y + dt / 2 * b)
        d = rates(y + dt * c)
        last, y = y[-1], y + dt / 6 * (a + 2 * b + 2 * c + d)
        if last * y[-1] < 0:
            turns.append((2 * (step + 1 - y[-1] / (y[-1] - last)) * dt / dry, y[-2] / diameter))
    print(f"density {s}: added mass at high frequency {added / mass:.3f} of its mass;",
          "turns", ", ".join(f"({t:.3f}, {place:+.3f})" for t, place in turns), flush=True)


for density in (0.25, 0.5, 0.75):
    release(density)
release(0.5, n=34, m=62)
release(0.5, tank=8, depth=64.0, m=70)
