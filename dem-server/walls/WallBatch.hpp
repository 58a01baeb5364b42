// SPDX-License-Identifier: BSD-3-Clause
/// Contacts with walls that wait to be worked on, eight at a time.
#pragma once

#include <cstdint>

#include "exec/Octet.hpp"
#include "exec/Vector.hpp"

namespace gimdem
{

/// Contacts that were found, until there are enough to be worth a visit.
struct WallBatch
{
    static constexpr int most = 64;

    static constexpr int room = most + exec::octet;

    int count = 0;
    std::int32_t particle[room], pair[room], row[room];
    Quad normal[room];    ///< towards the particle; w: overlap [m]
    Quad velocity[room];  ///< of the wall at the contact [m/s]
    Quad spin[room];      ///< angular velocity of the wall [rad/s]
    bool moves = false;   ///< whether any wall of the batch does

    /// There is always room for one octet more.
    bool is_full() const { return count >= most; }
    int add(std::int32_t i, std::int32_t k, std::int32_t r, Quad const& at)
    {
        particle[count] = i;
        pair[count] = k;
        row[count] = r;
        normal[count] = at;
        velocity[count] = spin[count] = {0, 0, 0, 0};
        return count++;
    }
    /// Fills the last octet with copies of the last contact.
    void pad()
    {
        for (int n = count; n % exec::octet != 0; ++n)
        {
            particle[n] = particle[count - 1];
            pair[n] = pair[count - 1];
            row[n] = row[count - 1];
            normal[n] = normal[count - 1];
            velocity[n] = velocity[count - 1];
            spin[n] = spin[count - 1];
        }
    }
};

}  // namespace gimdem
