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

    /// Of the pairs pair[0] ... pair[7], which touch; slot: of each pair of the list.
    SpringsOfOctet(SpringPool& pool, SpringPool::Slot const* slot, std::int32_t const* pair) : pool_(pool)
    {
        for (int n = 0; n < exec::octet; ++n)
            slot_[n] = slot[pair[n]];
    }

    Vector3<Octet> tangential() const { return load(pool_.tangential()); }
    Vector3<Octet> rolling() const { return load(pool_.rolling()); }
    void set_tangential(Vector3<Octet> const& springs) const { store(springs, pool_.tangential()); }
    void set_rolling(Vector3<Octet> const& springs) const { store(springs, pool_.rolling()); }

private:
    static constexpr std::int32_t in_order[exec::octet] = {0, 1, 2, 3, 4, 5, 6, 7};

    Vector3<Octet> load(Spring const* springs) const
    {
        // The fourth number is one of the spring behind, or none: nobody looks at it.
        Quad quads[exec::octet];
        for (int n = 0; n < exec::octet; ++n)
            std::memcpy(&quads[n], springs + slot_[n], sizeof(Quad));
        auto const eight = exec::load(quads, in_order);
        return {eight.x, eight.y, eight.z};
    }

    void store(Vector3<Octet> const& from, Spring* springs) const
    {
        Quad quads[exec::octet];
        exec::store({from.x, from.y, from.z, Octet::Zero()}, quads);
        for (int n = 0; n < exec::octet; ++n)
            springs[slot_[n]] = {quads[n].x, quads[n].y, quads[n].z};
    }

    SpringPool& pool_;
    std::int32_t slot_[exec::octet];
};

}  // namespace gimdem
