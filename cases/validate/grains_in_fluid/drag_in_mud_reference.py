#!/usr/bin/python3
"""Drag of a sphere and of a long cylinder in creeping flow of a yield-stress fluid: the reference of
grains_in_fluid.sphere_in_mud, wires_in_fluid.wire_in_mud and coupling/yield_drag.h.

The velocity field of a steady creeping flow makes the least of J = integral of K g^(n+1)/(n+1) + yield g among all
fields without divergence that have the body's velocity on it (Prager 1954; g = sqrt(2 D_ab D_ab)), and the power of the
drag is the integral of K g^(n+1) + yield g. The stream function is a sum of modes in the angle (Legendre, Fourier) and
cubic Hermite elements in the radius (numpy, scipy); g is taken as sqrt(g^2 + e^2), e is brought down step by step with
Newton steps in between, and the drag is extrapolated to e = 0. Lengths in radii, speeds in the body's, K = 1.
Checks: Stokes' drag between concentric spheres (Haberman & Sayre 1958), printed first; as Bn -> infinity the limits of
a plastic body, Cs / Bn = 1/(6 0.143) (Beris et al. 1985) and 2 pi + 4 sqrt 2 (Randolph & Houlsby 1984).
Prints n, Bn = yield (D/U)^n / K and, of the sphere, Cs = F / (3 pi K D^2 (U/D)^n), of the cylinder, F per length /
(K D (U/D)^n). Some ten minutes of CPU time.
"""
import numpy as np
from scipy.sparse import bmat, csr_matrix, diags, kron
from scipy.sparse.linalg import spsolve


def graded(outer, elements, first):
    """Nodes from 1 to outer, the first element `first` long and each longer than the last by the same factor."""
    low, high = 1.0, 2.0
    for _ in range(200):
        ratio = (low + high) / 2
        length = first * (ratio**elements - 1) / (ratio - 1)
        low, high = (ratio, high) if length < outer - 1 else (low, ratio)
    nodes = 1 + first * (ratio ** np.arange(elements + 1) - 1) / (ratio - 1)
    nodes[-1] = outer
    return nodes


def hermite(nodes):
    """Radii and weights of the integration points; value, first and second derivative there of the elements."""
    x, w = np.polynomial.legendre.leggauss(4)
    t, h = (x + 1) / 2, np.diff(nodes)
    shapes = [(2 * t**3 - 3 * t**2 + 1, 6 * t**2 - 6 * t, 12 * t - 6),
              (t**3 - 2 * t**2 + t, 3 * t**2 - 4 * t + 1, 6 * t - 4),
              (3 * t**2 - 2 * t**3, 6 * t - 6 * t**2, 6 - 12 * t), (t**3 - t**2, 3 * t**2 - 2 * t, 6 * t - 2)]
    rows, columns, entries = [], [], [[], [], []]
    for e, size in enumerate(h):
        for b, shape in enumerate(shapes):
            rows.append(4 * e + np.arange(4))
            columns.append(np.full(4, 2 * e + b))
            for order in range(3):
                entries[order].append((size if b % 2 else 1.0) * shape[order] / size**order)
    at = (np.concatenate(rows), np.concatenate(columns))
    r = (nodes[:-1, None] + h[:, None] * t).ravel()
    derivatives = [csr_matrix((np.concatenate(e), at), (r.size, 2 * nodes.size)) for e in entries]
    return r, (h[:, None] * w / 2).ravel(), derivatives


def sphere_modes(modes, r, g):
    """Strain of u_r = g P_k / r^2, u_theta = g' dP_k/dtheta / (r k (k+1)), so that g^2 is the sum of squares."""
    c, w = np.polynomial.legendre.leggauss(6 * modes)
    c, w = c[c > 0], w[c > 0]
    s = np.sqrt(1 - c * c)
    over = lambda power, order: diags(r**-power) @ g[order]
    strain = [[], [], [], []]
    for k in range(1, 2 * modes, 2):
        kappa, leg = k * (k + 1), np.polynomial.legendre.Legendre.basis(k)
        p, dp, ddp = leg(c), -s * leg.deriv()(c), s * s * leg.deriv(2)(c) - c * leg.deriv()(c)
        at = lambda angle, radial: kron(csr_matrix(angle[:, None]), radial)
        root = np.sqrt(2)
        strain[0].append(at(root * p, over(2, 1) - 2 * over(3, 0)))
        strain[1].append(at(root * ddp / kappa, over(2, 1)) + at(root * p, over(3, 0)))
        strain[2].append(at(root * p, over(3, 0)) + at(root * dp * c / s / kappa, over(2, 1)))
        strain[3].append(at(dp / kappa, over(1, 2) - 2 * over(2, 1)) + at(dp, over(3, 0)))
    return strain, w, 4 * np.pi * r * r, (1.0, 2.0)


def cylinder_modes(modes, r, g):
    """Strain of u_r = k f cos(k theta) / r, u_theta = -f' sin(k theta), so that g^2 is the sum of squares."""
    x, w = np.polynomial.legendre.leggauss(4 * modes)
    angle = (x + 1) * np.pi / 4
    over = lambda power, order: diags(r**-power) @ g[order]
    strain = [[], []]
    for k in range(1, 2 * modes, 2):
        strain[0].append(kron(csr_matrix(np.cos(k * angle)[:, None]), 2 * k * (over(1, 1) - over(2, 0))))
        strain[1].append(kron(csr_matrix(np.sin(k * angle)[:, None]), over(1, 1) - g[2] - k * k * over(2, 0)))
    return strain, w * np.pi / 4, 4 * r, (1.0, 1.0)


def power(body, n, yield_stress, least, outer, elements, first, modes):
    r, wr, g = hermite(graded(outer, elements, first))
    strain, w_angle, measure, on_body = body(modes, r, g)
    strain = [bmat([s]).tocsr() for s in strain]
    w = np.kron(w_angle, wr * measure)
    dofs = 2 * (elements + 1)
    u, fixed = np.zeros(modes * dofs), np.zeros(modes * dofs, bool)
    u[:2] = on_body
    for m in range(modes):
        fixed[m * dofs + np.array([0, 1, dofs - 2, dofs - 1])] = True
    free = np.where(~fixed)[0]
    of_free = [s[:, free] for s in strain]
    rate = lambda u, e: np.sqrt(sum((s @ u) ** 2 for s in strain) + e * e)
    value = lambda u, e: np.sum(w * (rate(u, e) ** (n + 1) / (n + 1) + yield_stress * rate(u, e)))
    e, newtonian = 1.0, True
    while True:
        for _ in range(60):
            along, g_now = [s @ u for s in strain], rate(u, e)
            eta = g_now ** (n - 1) + yield_stress / g_now
            bend = ((n - 1) * g_now ** (n - 2) - yield_stress / g_now**2) / g_now
            if newtonian:
                eta, bend = np.ones_like(g_now), np.zeros_like(g_now)
            slope = sum(s.T @ (w * eta * a) for s, a in zip(of_free, along))
            lean = sum(diags(a) @ s for s, a in zip(of_free, along))
            curve = sum(s.T @ diags(w * eta) @ s for s in of_free) + lean.T @ diags(w * bend) @ lean
            step, size, was = spsolve(curve.tocsc(), -slope), 1.0, value(u, e)
            while True:
                trial = u.copy()
                trial[free] += size * step
                if newtonian or value(trial, e) <= was + 1e-4 * size * (slope @ step) or size < 1e-6:
                    break
                size /= 2
            u, newtonian, gain = trial, False, 0 if newtonian else slope @ step
            if gain and -gain < 1e-9 * abs(was):
                break
        if e <= least:
            break
        e = max(e / 3, least)
    g_now = rate(u, 0)
    return np.sum(w * (g_now ** (n + 1) + yield_stress * g_now))


def drag(body, n, bingham, outer, elements=50, first=0.02, modes=10, least=2e-4):
    """Force over K (U/D)^n, per D^2 (sphere) or D (cylinder), extrapolated to e = 0."""
    size = 4 if body is sphere_modes else 2
    coarse, fine = (power(body, n, bingham / 2**n, e, outer, elements, first, modes) for e in (3 * least, least))
    return (fine + (fine - coarse) / 2) / (size * 0.5**n)


if __name__ == "__main__":
    l = 1 / 12
    known = (1 - l**5) / (1 - 9 / 4 * l + 5 / 2 * l**3 - 9 / 4 * l**5 + l**6)
    print("Newtonian sphere in a shell of 12 radii", drag(sphere_modes, 1, 0, 12) / (3 * np.pi), "known", known)
    for n, bn, outer in [(1, 1, 12), (1, 10, 6), (1, 100, 4), (0.5, 0, 60), (0.5, 1, 12)]:
        print("sphere", n, bn, round(drag(sphere_modes, n, bn, outer) / (3 * np.pi), 4), flush=True)
    for bn, outer in [(0.1, 100), (1, 30), (10, 12), (100, 6)]:
        print("cylinder", 1, bn, round(drag(cylinder_modes, 1, bn, outer, 60, 0.01, 12), 3), flush=True)
