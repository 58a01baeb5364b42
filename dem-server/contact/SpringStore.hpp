// SPDX-License-Identifier: BSD-3-Clause
/// How the springs of eight pairs come from the pool of their block and go back.
#pragma once

#include <cstdint>
#include <cstring>

#include "exec/Octet.hpp"
#include "search/SpringPool.hpp"

namespace gimdem
{

class SpringsOfOctet
{
public:
    using Octet = exec::Octet;

    /// Of eight pairs that touch, with their slots.
    SpringsOfOctet(SpringPool& pool, SpringPool::Slot const* slot) : pool_(pool), slot_(slot) {}

    Vector3<Octet> tangential() const { return load(pool_.tangential()); }
    Vector3<Octet> rolling() const { return load(pool_.rolling()); }
    void set_tangential(Vector3<Octet> const& springs) const { store(springs, pool_.tangential()); }
    void set_rolling(Vector3<Octet> const& springs) const { store(springs, pool_.rolling()); }

private:
    /// The fourth number is one of the spring behind, or none: nobody looks at it.
    static exec::detail::Eight two(Spring const& a, Spring const& b)
    {
        exec::detail::Four low, high;
        std::memcpy(&low, &a, sizeof low);
        std::memcpy(&high, &b, sizeof high);
        return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
    }

    Vector3<Octet> load(Spring const* s) const
    {
        using namespace exec::detail;
        Eight const q01 = two(s[slot_[0]], s[slot_[1]]), q23 = two(s[slot_[2]], s[slot_[3]]),
                    q45 = two(s[slot_[4]], s[slot_[5]]), q67 = two(s[slot_[6]], s[slot_[7]]);
        Eight const xy0 = __builtin_shufflevector(q01, q23, 0, 4, 8, 12, 1, 5, 9, 13),
                    xy4 = __builtin_shufflevector(q45, q67, 0, 4, 8, 12, 1, 5, 9, 13),
                    z0 = __builtin_shufflevector(q01, q23, 2, 6, 10, 14, 2, 6, 10, 14),
                    z4 = __builtin_shufflevector(q45, q67, 2, 6, 10, 14, 2, 6, 10, 14);
        return {octet_of(__builtin_shufflevector(xy0, xy4, 0, 1, 2, 3, 8, 9, 10, 11)),
                octet_of(__builtin_shufflevector(xy0, xy4, 4, 5, 6, 7, 12, 13, 14, 15)),
                octet_of(__builtin_shufflevector(z0, z4, 0, 1, 2, 3, 8, 9, 10, 11))};
    }

    void store(Vector3<Octet> const& from, Spring* springs) const
    {
        Quad quads[exec::octet];
        exec::store({from.x, from.y, from.z, Octet::Zero()}, quads);
        for (int n = 0; n < exec::octet; ++n)
            springs[slot_[n]] = {quads[n].x, quads[n].y, quads[n].z};
    }

    SpringPool& pool_;
    SpringPool::Slot const* slot_;
};

}  // namespace gimdem
