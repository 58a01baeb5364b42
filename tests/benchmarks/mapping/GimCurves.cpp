// SPDX-License-Identifier: BSD-3-Clause
/// The curves of Figures 3 to 8 of the method's paper, as rows of CSV: `./gimdem bench gim-figures` draws them.
///
///   figure        3 ... 8
///   curve         particle, cell, shared (3 to 5: densities); ratio, cap, cap_as_printed (6, 7: I / V_p); best, eq27,
///   trend (8) position      psi: the cell is at mu = r_c + psi r_p (3 to 6) volume_ratio  V_c / V_p phi coefficient x,
///   y          x: place [r_p] (3 to 5), V_c / V_p (6, 8), psi (7)
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "PaperFigures.hpp"

namespace
{

using namespace gimdem;
using namespace gimdem::test;

constexpr double ratios[] = {2, 4, 8, 16};
constexpr double positions[] = {-1, 0, 1};

void row(int figure, std::string_view curve, double psi, double ratio, double phi, double x, double y)
{
    fmt::print("{},{},{:g},{:g},{:g},{:.6g},{:.8g}\n", figure, curve, psi, ratio, phi, x, y);
}

double gaussian(double x, double deviation)
{
    return std::exp(-x * x / (2 * deviation * deviation)) / (deviation * std::sqrt(2 * M_PI));
}

// Densities along the line of centres, V_p = 1.
void print_gaussians()
{
    double const phi = 0.4;
    for (int f = 0; f < 3; ++f)
        for (double const ratio : ratios)
        {
            double const radius = std::cbrt(ratio), mu = radius + positions[f];
            double const low = -3.5 * phi, high = mu + 3.5 * phi * radius;
            for (int i = 0; i <= 300; ++i)
            {
                double const x = low + (high - low) * i / 300;
                double const particle = gaussian(x, phi), cell = ratio * gaussian(x - mu, phi * radius);
                row(3 + f, "particle", positions[f], ratio, phi, x, particle);
                row(3 + f, "cell", positions[f], ratio, phi, x, cell);
                row(3 + f, "shared", positions[f], ratio, phi, x, std::min(particle, cell));
            }
        }
}

void print_against_volume_ratio()
{
    for (double const psi : positions)
        for (int percent = 20; percent <= 80; percent += percent >= 30 && percent < 50 ? 2 : 10)
            for (double ratio = 1.25; ratio <= 32; ratio += 0.25)
                row(6, "ratio", psi, ratio, percent / 100.0, ratio, shared_volume(ratio, percent / 100.0, psi));
}

void print_against_distance()
{
    for (int i = 0; i <= 100; ++i)
    {
        double const psi = 0.02 * i - 1;
        row(7, "cap", 0, 0, 0, psi, cap_inside(psi));
        row(7, "cap_as_printed", 0, 0, 0, psi, cap_as_printed(psi));
        for (double const ratio : ratios)
            for (int percent = 20; percent <= 80; percent += percent >= 30 && percent < 50 ? 2 : 10)
                row(7, "ratio", 0, ratio, percent / 100.0, psi, shared_volume(ratio, percent / 100.0, psi));
    }
}

void print_coefficients()
{
    auto const [factor, exponent] = trend_line(32);
    for (int ratio = 2; ratio <= 32; ++ratio)
    {
        row(8, "best", 0, ratio, 0, ratio, best_coefficient(ratio));
        row(8, "eq27", 0, ratio, 0, ratio, tuned_coefficient(std::log(ratio)));
        row(8, "trend", 0, ratio, 0, ratio, factor * std::pow(ratio, -exponent));
    }
}

}  // namespace

int main()
{
    fmt::print("figure,curve,position,volume_ratio,phi,x,y\n");
    print_gaussians();
    print_against_volume_ratio();
    print_against_distance();
    print_coefficients();
}
