"""Literal implementations: one equation of the paper or of docs/law.md, one line. Slow on purpose."""

import mpmath as mp
import numpy as np


def spectrum(modes=50, decades=6.0):
    """Eqs. (4), (5): ratios tau_j / tau_max and weights, fastest mode first."""
    j = np.arange(1, modes + 1)
    ratio = 10.0 ** (-(modes - j) * decades / max(modes - 1, 1))
    return ratio, np.sqrt(ratio) / np.sqrt(ratio).sum()


def hardening_strain(strain):
    """e_HT below eq. (3), as printed."""
    return np.exp(2 * strain) - np.exp(-strain)


def backward_rates(time, strain, fresh=()):
    """Three-point backward difference at the end of each step, the secant in a step that starts afresh.

    The derivative of Newton's interpolant: [n+1, n] + h [n+1, n, n-1].
    """
    h = np.diff(time)
    secant = np.diff(strain) / h
    rates = secant.copy()
    for n in range(1, len(h)):
        if n not in fresh:
            rates[n] += h[n] * (secant[n] - secant[n - 1]) / (h[n] + h[n - 1])
    return rates


def be2(time, strain, E_u, G, tau_max, *, modes=50, decades=6.0, fresh=(), rates=None):
    """Eqs. (8), (9) in the modal stresses themselves, on any grid; the paper's start, so too `fresh` steps.

    `tau_max` is a number or has one entry per step, at its end; so has `rates`.
    """
    ratio, p = spectrum(modes, decades)
    h = np.diff(time)
    tau_max = np.broadcast_to(tau_max, h.shape)
    rates = backward_rates(time, strain, fresh) if rates is None else rates
    e_ht = hardening_strain(strain)
    sigma = p * G * e_ht[0]
    before = sigma
    total = [sigma.sum()]
    for n in range(len(h)):
        tau = ratio * tau_max[n]
        drive = p * E_u * rates[n] + p * G * e_ht[n + 1] / tau
        if n == 0 or n in fresh:
            after = (sigma + h[n] * drive) / (1 + h[n] / tau)
        else:
            w = h[n] / h[n - 1]
            a0, a1, a2 = (1 + 2 * w) / (1 + w), -(1 + w), w * w / (1 + w)
            after = (h[n] * drive - a1 * sigma - a2 * before) / (a0 + h[n] / tau)
        before, sigma = sigma, after
        total.append(sigma.sum())
    return np.array(total)


def sa_coefficients(z):
    """k0, k1, k2 of docs/law.md in 40 digits, rounded."""
    with mp.workdps(40):
        z = mp.mpf(float(z))
        k0 = -mp.expm1(-z)
        k1 = 1 - k0 / z
        return float(k0), float(k1), float(1 - 2 * k1 / z)


def sa(time, strain, E_u, G, tau_max, *, order=3, modes=50, decades=6.0, fresh=()):
    """The q and s recursions of docs/law.md at constant tau_max, modal stresses p_j (E_u q_j + G s_j).

    q+ = e^-z q + [(de - c) k0 + 2 c k1] / z,  s+ = e^-z s + H k0 + (dH - c_H) k1 + c_H k2.
    """
    ratio, p = spectrum(modes, decades)
    h = np.diff(time)
    H = hardening_strain(strain)
    q, s = np.zeros(modes), np.full(modes, H[0])
    total = [(p * (E_u * q + G * s)).sum()]
    known = {}
    for n in range(len(h)):
        if h[n] not in known:
            z = h[n] / (ratio * tau_max)
            known[h[n]] = (z, *np.transpose([sa_coefficients(each) for each in z]))
        z, k0, k1, k2 = known[h[n]]
        de, dH = strain[n + 1] - strain[n], H[n + 1] - H[n]
        c = c_H = 0.0
        if order == 3 and n > 0 and n not in fresh:
            h0 = h[n - 1]
            c = h[n] ** 2 * (de / h[n] - (strain[n] - strain[n - 1]) / h0) / (h[n] + h0)
            c_H = h[n] ** 2 * (dH / h[n] - (H[n] - H[n - 1]) / h0) / (h[n] + h0)
        q = np.exp(-z) * q + ((de - c) * k0 + 2 * c * k1) / z
        s = np.exp(-z) * s + H[n] * k0 + (dH - c_H) * k1 + c_H * k2
        total.append((p * (E_u * q + G * s)).sum())
    return np.array(total)


def _mp_growth(k, tau, h):
    """int_0^h e^(k s) e^(-(h - s) / tau) ds / tau, the limit where k = -1 / tau."""
    gap = k + 1 / tau
    if gap == 0:
        return h / tau * mp.exp(-h / tau)
    return (mp.exp(k * h) - mp.exp(-h / tau)) / (gap * tau)


def mp_segments(time, strain, E_u, G, tau_max, *, modes=50, decades=6.0, digits=40, tau=None):
    """Eq. (6) for piecewise-linear strain in closed form with 40 digits; relaxed start. Floats.

    `tau` replaces the relaxation times of all modes (for the limits of eq. (7)).
    """
    with mp.workdps(digits):
        weights = [
            mp.mpf(10) ** (-mp.mpf(modes - j) * mp.mpf(decades) / max(modes - 1, 1)) for j in range(1, modes + 1)
        ]
        taus = [mp.mpf(tau_max) * w for w in weights] if tau is None else [mp.mpf(each) for each in tau]
        roots = [mp.sqrt(w) for w in weights]
        p = [root / mp.fsum(roots) for root in roots]
        E_u, G = mp.mpf(E_u), mp.mpf(G)
        t, e = [mp.mpf(float(x)) for x in time], [mp.mpf(float(x)) for x in strain]
        sigma = [pj * G * (mp.exp(2 * e[0]) - mp.exp(-e[0])) for pj in p]
        total = [mp.fsum(sigma)]
        for n in range(len(t) - 1):
            h = t[n + 1] - t[n]
            rate = (e[n + 1] - e[n]) / h
            up, down = mp.exp(2 * e[n]), mp.exp(-e[n])
            for j, tj in enumerate(taus):
                sigma[j] = (
                    sigma[j] * mp.exp(-h / tj)
                    - p[j] * E_u * rate * tj * mp.expm1(-h / tj)
                    + p[j] * G * (up * _mp_growth(2 * rate, tj, h) - down * _mp_growth(-rate, tj, h))
                )
            total.append(mp.fsum(sigma))
        return np.array([float(x) for x in total])


def mp_ramp(rate, time, E_u, G, tau_max, **options):
    """Eq. (7) with 40 digits, at one time. The end strain is rate * time in 40 digits, not rounded first."""
    with mp.workdps(options.get("digits", 40)):
        duration = mp.mpf(float(time))
        taus = options.get("tau")
        modes, decades = options.get("modes", 50), options.get("decades", 6.0)
        ratios = [mp.mpf(10) ** (-mp.mpf(modes - j) * mp.mpf(decades) / max(modes - 1, 1)) for j in range(1, modes + 1)]
        taus = [mp.mpf(tau_max) * r for r in ratios] if taus is None else [mp.mpf(x) for x in taus]
        whole = mp.fsum([mp.sqrt(r) for r in ratios])
        r = mp.mpf(float(rate))
        return float(
            mp.fsum(
                mp.sqrt(ratio)
                / whole
                * (
                    -mp.mpf(E_u) * r * tj * mp.expm1(-duration / tj)
                    + mp.mpf(G) * (_mp_growth(2 * r, tj, duration) - _mp_growth(-r, tj, duration))
                )
                for ratio, tj in zip(ratios, taus, strict=True)
            )
        )


def memory_integral(strain, rate, reduced_time, at, E_u, G, *, modes=50, decades=6.0, longest=None):
    """Eq. (6) as an integral over the past, for a smooth history that starts at 0 from e(0) = 0:

    sigma(T) = G e_HT(T) + sum_j p_j int_0^T (E_u - G e_HT') e'(s) exp(-(xi(T) - xi(s)) / r_j) ds,

    by Gauss-Legendre quadrature on panels that shrink geometrically towards T. `reduced_time` is xi(s).
    """
    ratio, p = spectrum(modes, decades)
    nodes, weights = np.polynomial.legendre.leggauss(20)
    edges = at * np.concatenate([[0.0], 1.0 - np.geomspace(1.0, 1e-13, 140)[1:], [1.0]])
    middle, half = 0.5 * (edges[1:] + edges[:-1]), 0.5 * np.diff(edges)
    s = (middle[:, None] + half[:, None] * nodes).ravel()
    w = (half[:, None] * weights).ravel()
    e = strain(s)
    drive = (E_u - G * (2 * np.exp(2 * e) + np.exp(-e))) * rate(s) * w
    past = reduced_time(at) - reduced_time(s)
    kernel = np.exp(-past[:, None] / ratio)
    return G * hardening_strain(strain(at)) + drive @ kernel @ p
