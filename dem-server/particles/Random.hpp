// SPDX-License-Identifier: BSD-3-Clause
/// Random numbers that are the same with any compiler and library, and whose whole state is one integer.
#pragma once

#include <cstdint>

namespace gimdem
{

/// SplitMix64 (Steele, Lea and Flood, 2014): a counter and a mixing function.
class RandomStream
{
public:
    explicit RandomStream(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits()
    {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    /// Uniform in [0, 1).
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

    /// Uniform in [low, high).
    double between(double low, double high) { return low + (high - low) * unit(); }

    std::uint64_t state() const { return state_; }  ///< RandomStream(state()) goes on where this one is

private:
    std::uint64_t state_;
};

}  // namespace gimdem
