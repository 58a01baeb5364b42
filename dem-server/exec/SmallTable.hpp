// SPDX-License-Identifier: BSD-3-Clause
/// Tables of eight numbers that are looked up within a register, eight lanes at a time.
#pragma once

#include <cstdint>
#include <cstring>

#include "exec/Octet.hpp"

namespace gimdem::exec
{

/// The whole numbers nearest to eight numbers from 0 to 7, and what a table has at them. Of other numbers the lowest
/// three bits count.
class NearestWhole
{
public:
    explicit NearestWhole(Octet const& x) : shifted_(x + shift) {}

    Octet value() const { return shifted_ - shift; }

    /// table[value()] of each lane; `table` on a boundary of 64 bytes.
    Octet pick(double const* table) const
    {
#ifdef __AVX512F__
        return {_mm512_permutexvar_pd(_mm512_castpd_si512(shifted_.v), _mm512_load_pd(table))};
#else
        Octet out;
        for (int lane = 0; lane < octet; ++lane)
        {
            std::int64_t bits;
            double const number = shifted_[lane];
            std::memcpy(&bits, &number, sizeof bits);
            out[lane] = table[bits & (octet - 1)];
        }
        return out;
#endif
    }

private:
    /// 2^52 + 2^51: the sum's last bits are the number.
    static constexpr double shift = 6755399441055744.0;

    Octet shifted_;
};

}  // namespace gimdem::exec
