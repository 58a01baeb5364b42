// SPDX-License-Identifier: BSD-3-Clause
#include "particles/Inlet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/Error.hpp"
#include "particles/OverlapGrid.hpp"

namespace gimdem
{

Inlet::Inlet(InletSettings const& settings, Materials const& materials, Domain const& domain)
    : settings_(settings),
      domain_(domain),
      material_(materials.number_of(settings.material)),
      density_(materials[material_].density),
      sizes_(settings.diameter, settings.sizes),
      low_(vec3(settings.box[0])),
      high_(vec3(settings.box[1]))
{
    double room = (high_ - low_).minCoeff();
    if (settings.radius > 0)
    {
        Vec3 const normal = vec3(settings.normal).normalized();
        int axis = 0;
        normal.cwiseAbs().minCoeff(&axis);
        across_ = normal.cross(Vec3::Unit(axis)).normalized();
        along_ = normal.cross(across_);
        low_ = vec3(settings.centre) - Vec3::Constant(settings.radius);
        high_ = vec3(settings.centre) + Vec3::Constant(settings.radius);
        room = 2 * settings.radius;
    }
    if (room < sizes_.largest())
        throw UserError(
            fmt::format("[[inlets]] region is {:.6g} m wide, its largest particle {:.6g} m; no such particle fits: "
                        "widen the region",
                        room, sizes_.largest()));
    RandomStream random(settings.seed);
    state_.next_diameter = sizes_.draw(random);
    state_.random = random.state();
}

bool Inlet::is_due(double time) const
{
    // A time that misses its lot by rounding is meant to be it.
    double const lot = settings_.start + (static_cast<double>(state_.lots) - 1e-6) * settings_.interval;
    return time >= lot && owed(time) >= next_mass() / 2;
}

double Inlet::owed(double time) const
{
    double const end = settings_.end > 0 ? std::min(time, settings_.end) : time;
    return settings_.mass_rate * std::max(0.0, end - settings_.start) - state_.mass;
}

std::vector<SphereSeed> Inlet::take(double time, ParticleState const& present)
{
    state_.lots = std::llround(std::floor((time - settings_.start) / settings_.interval + 1e-6)) + 1;
    double largest = largest_radius();
    for (Quad const& x : present.position.host())
        largest = std::max(largest, x.w);
    OverlapGrid grid(low_, high_, largest);
    Vec3 const reach = Vec3::Constant(largest + largest_radius());
    for (Quad const& x : present.position.host())
        visit_images(x.xyz(),
                     [&](Vec3 const& image)
                     {
                         if ((image - (low_ - reach)).minCoeff() > 0 && ((high_ + reach) - image).minCoeff() > 0)
                             grid.add(image, x.w);
                     });

    RandomStream random(state_.random);
    std::vector<SphereSeed> seeds;
    while (owed(time) >= next_mass() / 2)
    {
        double const radius = state_.next_diameter / 2;
        Vec3 x = random_place(radius, random);
        int attempt = 1;
        while (grid.overlaps(x, radius) && ++attempt <= most_attempts)
            x = random_place(radius, random);
        if (attempt > most_attempts) break;
        visit_images(x, [&](Vec3 const& image) { grid.add(image, radius); });
        seeds.push_back({x, radius, vec3(settings_.velocity)});
        ++state_.inserted;
        state_.mass += next_mass();
        state_.next_diameter = sizes_.draw(random);
    }
    state_.random = random.state();
    return seeds;
}

/// Calls visit with x and, along periodic axes, its images one period away.
template <class Visit>
void Inlet::visit_images(Vec3 const& x, Visit&& visit) const
{
    Vec3 const period = domain_.period.vec();
    Eigen::Vector3i const most = (period.array() > 0).cast<int>();
    for (int k = -most.z(); k <= most.z(); ++k)
        for (int j = -most.y(); j <= most.y(); ++j)
            for (int i = -most.x(); i <= most.x(); ++i)
                visit(Vec3(x + period.cwiseProduct(Vec3(i, j, k))));
}

Vec3 Inlet::random_place(double radius, RandomStream& random) const
{
    if (settings_.radius > 0)
    {
        double const distance = (settings_.radius - radius) * std::sqrt(random.unit());
        double const angle = 2 * std::numbers::pi * random.unit();
        return vec3(settings_.centre) + distance * (std::cos(angle) * across_ + std::sin(angle) * along_);
    }
    Vec3 x;
    for (int axis = 0; axis < 3; ++axis)
        x[axis] = random.between(low_[axis] + radius, high_[axis] - radius);
    return x;
}

}  // namespace gimdem
