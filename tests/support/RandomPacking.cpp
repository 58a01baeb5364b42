// SPDX-License-Identifier: BSD-3-Clause
#include "RandomPacking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/Error.hpp"

namespace gimdem::test
{

RandomPacking::RandomPacking(std::int64_t count, Vec3 const& low, Vec3 const& high, double diameter, std::uint64_t seed)
    : low_(low.array() + diameter / 2), high_(high.array() - diameter / 2), diameter_(diameter), random_(seed)
{
    // As dense a lattice as the box holds, of which sites are left out at random.
    Vec3 const room = high_ - low_;
    Eigen::Vector3i const n = (room / diameter * (1 - 1e-9)).array().floor().cast<int>() + 1;
    std::int64_t left = room.minCoeff() < 0 ? 0 : std::int64_t{n[0]} * n[1] * n[2], wanted = count;
    if (wanted > left)
        throw UserError(fmt::format("{} spheres do not fit (a lattice in the box holds {}); take fewer", count, left));
    Vec3 const gap = room.cwiseQuotient((n.array() - 1).max(1).matrix().cast<double>());
    size_ = (room / diameter).array().floor().cast<int>() + 1;
    members_.assign(static_cast<std::size_t>(size_.prod()) * site_capacity, -1);
    for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j < n[1]; ++j)
            for (int i = 0; i < n[0]; ++i, --left)
            {
                if (random_.unit() * static_cast<double>(left) >= static_cast<double>(wanted)) continue;
                --wanted;
                centres_.push_back(low_ + gap.cwiseProduct(Vec3(i, j, k)));
                put(std::ssize(centres_) - 1);
            }
}

void RandomPacking::shake(int sweeps)
{
    for (int sweep = 0; sweep < sweeps; ++sweep)
        for (std::int64_t i = 0; i < std::ssize(centres_); ++i)
        {
            Vec3& x = centres_[static_cast<std::size_t>(i)];
            double const a = random_.unit(), b = random_.unit(), c = random_.unit();
            Vec3 const to = x + diameter_ / 2 * (Vec3(a, b, c).array() - 0.5).matrix();
            if ((to - low_).minCoeff() < 0 || (high_ - to).minCoeff() < 0 || !is_free(to, i)) continue;
            take(i);
            x = to;
            put(i);
        }
}

std::int64_t RandomPacking::site_of(Vec3 const& x) const
{
    Eigen::Vector3i const at = ((x - low_) / diameter_).cast<int>().cwiseMin((size_.array() - 1).matrix());
    return at[0] + std::int64_t{size_[0]} * (at[1] + std::int64_t{size_[1]} * at[2]);
}

bool RandomPacking::is_free(Vec3 const& x, std::int64_t but) const
{
    Eigen::Vector3i const at = ((x - low_) / diameter_).cast<int>();
    Eigen::Vector3i const from = (at.array() - 1).max(0), to = (at.array() + 1).min(size_.array() - 1);
    for (int k = from[2]; k <= to[2]; ++k)
        for (int j = from[1]; j <= to[1]; ++j)
        {
            std::int64_t const row = std::int64_t{size_[0]} * (j + std::int64_t{size_[1]} * k);
            for (std::int64_t s = (row + from[0]) * site_capacity; s < (row + to[0] + 1) * site_capacity; ++s)
            {
                std::int32_t const other = members_[static_cast<std::size_t>(s)];
                if (other >= 0 && other != but &&
                    (centres_[static_cast<std::size_t>(other)] - x).squaredNorm() < diameter_ * diameter_)
                    return false;
            }
        }
    return true;
}

void RandomPacking::put(std::int64_t sphere)
{
    auto const first = members_.begin() + site_of(centres_[static_cast<std::size_t>(sphere)]) * site_capacity;
    auto const place = std::find(first, first + site_capacity, -1);
    if (place == first + site_capacity) throw std::logic_error("more spheres in a site than can be");
    *place = static_cast<std::int32_t>(sphere);
}

void RandomPacking::take(std::int64_t sphere)
{
    auto const first = members_.begin() + site_of(centres_[static_cast<std::size_t>(sphere)]) * site_capacity;
    *std::find(first, first + site_capacity, static_cast<std::int32_t>(sphere)) = -1;
}

}  // namespace gimdem::test
