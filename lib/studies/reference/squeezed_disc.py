"""A disc of liquid squeezed between plates by a constant force, by lubrication, for any viscosity law.

    squeezed_disc.py > squeezed_disc.csv

Between plates h apart a stress tau at the walls drives the flux h^2/(2 tau^2) times the integral of rate times stress over the stress
up to tau, per width. Plates that close at V have the flux V r/2 at the radius r, and press with the integral of pi r^2 2 tau/h. Lengths
are over the first height, the radius of the first disc is ASPECT of them; times in s; closing at FASTEST first heights a second at most."""

from bisect import bisect
from functools import reduce
from math import exp, log, pi
from operator import add

ASPECT, HEIGHT, FASTEST = 8, 60e-6, 2 / 60e-6
YIELD = 1000.0  # Pa
LAWS = {
    "power0.04": lambda rate: YIELD * min(max(rate, 1e-2), 1e8) ** -0.96,
    "carreau0.04": lambda rate: 1e-3 + (YIELD - 1e-3) * (1 + rate**2) ** -0.48,
    "flat": lambda rate: YIELD / min(max(rate, 0.1), 1e4),
}


class Film:
    """Stress at the walls (Pa) over the flux over h^2 (1/s), tabulated over the rate at the walls."""

    def __init__(self, viscosity, first=1e-9, per_unit=100, units=46):
        rates = [first * exp(i / per_unit) for i in range(units * per_unit)]
        stresses = [viscosity(rate) * rate for rate in rates]
        integral = stresses[0] ** 2 * rates[0] / 3  # Newtonian below
        self.fluxes, self.stresses = [], [log(stress) for stress in stresses]
        for i, (rate, stress) in enumerate(zip(rates, stresses)):
            if i:
                mean = 0.5 * (stress * rate + stresses[i - 1] * rates[i - 1])
                integral += mean * (stress - stresses[i - 1])
            self.fluxes.append(log(integral / (2 * stress**2)))

    def stress(self, flux):
        i = min(max(bisect(self.fluxes, log(flux)), 1), len(self.fluxes) - 1)
        part = (log(flux) - self.fluxes[i - 1]) / (self.fluxes[i] - self.fluxes[i - 1])
        return exp(self.stresses[i - 1] + part * (self.stresses[i] - self.stresses[i - 1]))

    def force(self, speed, height, parts=100):
        """Over the square of the first height, Pa."""
        edge = ASPECT * height**-0.5
        radii = [(i + 0.5) / parts * edge for i in range(parts)]
        terms = (2 * pi * r * r * self.stress(speed * r / (2 * height**2)) / height for r in radii)
        return reduce(add, terms) * edge / parts

    def speed(self, force, height):
        """At which a force closes the film, first heights a second."""
        low, high = log(1e-12), log(FASTEST)
        if self.force(FASTEST, height) < force:
            return FASTEST
        for _ in range(45):
            middle = 0.5 * (low + high)
            low, high = (low, middle) if self.force(exp(middle), height) > force else (middle, high)
        return exp(high)


def times(film, force, last, steps=100):
    """Times and heights on the way to the last height."""
    heights = [last ** (i / steps) for i in range(steps + 1)]
    slowness = [1 / film.speed(force, height) for height in heights]
    time, way = 0.0, [(0.0, 1.0)]
    for i in range(steps):
        a, b = slowness[i : i + 2]
        mean = (b - a) / log(b / a) if abs(b / a - 1) > 1e-6 else 0.5 * (a + b)
        time += mean * (heights[i] - heights[i + 1])
        way.append((time, heights[i + 1]))
    return way


def check():
    """Against Stefan's film, and against closed power-law films (Scott 1931)."""
    newton = Film(lambda rate: 1.0).force(1.0, 0.1) / (1.5 * pi * (ASPECT * 0.1**-0.5) ** 4 / 0.1**3)
    n = 0.3
    scott = 2 * pi / (n + 3) * ((2 * n + 1) / n) ** n * (ASPECT * 0.1**-0.5) ** (n + 3) / 0.1 ** (2 * n + 1)
    assert abs(newton - 1) < 1e-3 and abs(Film(lambda rate: rate ** (n - 1)).force(1.0, 0.1) / scott - 1) < 1e-3


check()
print("law,time_s,radius")
for name, viscosity in LAWS.items():
    film = Film(viscosity)
    # Eight times the force at which a liquid of the yield stress stands still at first.
    for time, height in times(film, 8 * 2 * pi / 3 * YIELD * ASPECT**3, 0.45):
        print(f"{name},{time!r},{height**-0.5!r}")
