// SPDX-License-Identifier: BSD-3-Clause
/// Eight numbers taken together: as many as one register of the widest kind holds. How a kernel on the processor works
/// on eight contacts or particles at a time; a law written for a type Real serves a number and an Octet alike.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <cstring>

#include "exec/Vector.hpp"

/// Inlines all calls of a function that works on octets. Not under a sanitizer, whose checks would multiply.
#ifdef __SANITIZE_ADDRESS__
#define GIMDEM_FLATTEN
#else
#define GIMDEM_FLATTEN [[gnu::flatten]]
#endif

namespace gimdem::exec
{

inline constexpr int octet = 8;
using Octet = Eigen::Array<double, octet, 1>;

/// Eight quadruples, transposed.
struct OctetOfQuads
{
    Octet x, y, z, w;
};

/// values[place[i]] for each lane.
inline Octet gather(double const* values, Eigen::Array<std::int32_t, octet, 1> const& place)
{
    return Octet{{values[place[0]], values[place[1]], values[place[2]], values[place[3]], values[place[4]],
                  values[place[5]], values[place[6]], values[place[7]]}};
}

namespace detail
{

// The compiler's own vectors, which it can permute; they become the registers of whatever processor it compiles for.
using Four = double __attribute__((vector_size(32)));
using Eight = double __attribute__((vector_size(64)));

inline Eight load_two(Quad const& a, Quad const& b)
{
    Four low, high;
    std::memcpy(&low, &a, sizeof(Four));
    std::memcpy(&high, &b, sizeof(Four));
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
inline void store_two(Eight const& both, Quad& a, Quad& b)
{
    Four const low = __builtin_shufflevector(both, both, 0, 1, 2, 3);
    Four const high = __builtin_shufflevector(both, both, 4, 5, 6, 7);
    std::memcpy(&a, &low, sizeof(Four));
    std::memcpy(&b, &high, sizeof(Four));
}
inline Octet octet_of(Eight const& v)
{
    Octet out;
    std::memcpy(out.data(), &v, sizeof(v));
    return out;
}
inline Eight eight_of(Octet const& v)
{
    Eight out;
    std::memcpy(&out, v.data(), sizeof(out));
    return out;
}

}  // namespace detail

/// Which lanes: every bit of a lane is set, or none.
struct OctetMask
{
    long long lanes __attribute__((vector_size(64)));
};
inline OctetMask greater(Octet const& a, Octet const& b)
{
    return {detail::eight_of(a) > detail::eight_of(b)};
}
inline Octet choose(OctetMask const& condition, Octet const& yes, Octet const& no)
{
    return detail::octet_of(condition.lanes ? detail::eight_of(yes) : detail::eight_of(no));
}

/// values[place[i]] for each lane.
inline OctetOfQuads load(Quad const* values, std::int32_t const* place)
{
    using namespace detail;
    Eight const q01 = load_two(values[place[0]], values[place[1]]), q23 = load_two(values[place[2]], values[place[3]]),
                q45 = load_two(values[place[4]], values[place[5]]), q67 = load_two(values[place[6]], values[place[7]]);
    Eight const xy0 = __builtin_shufflevector(q01, q23, 0, 4, 8, 12, 1, 5, 9, 13),
                xy4 = __builtin_shufflevector(q45, q67, 0, 4, 8, 12, 1, 5, 9, 13),
                zw0 = __builtin_shufflevector(q01, q23, 2, 6, 10, 14, 3, 7, 11, 15),
                zw4 = __builtin_shufflevector(q45, q67, 2, 6, 10, 14, 3, 7, 11, 15);
    return {octet_of(__builtin_shufflevector(xy0, xy4, 0, 1, 2, 3, 8, 9, 10, 11)),
            octet_of(__builtin_shufflevector(xy0, xy4, 4, 5, 6, 7, 12, 13, 14, 15)),
            octet_of(__builtin_shufflevector(zw0, zw4, 0, 1, 2, 3, 8, 9, 10, 11)),
            octet_of(__builtin_shufflevector(zw0, zw4, 4, 5, 6, 7, 12, 13, 14, 15))};
}

namespace detail
{

/// at(lane) <- the lane's quadruple, in rising order of lanes.
template <class At>
void store_each(OctetOfQuads const& from, At at)
{
    Eight const x = eight_of(from.x), y = eight_of(from.y), z = eight_of(from.z), w = eight_of(from.w);
    Eight const xy0 = __builtin_shufflevector(x, y, 0, 8, 1, 9, 2, 10, 3, 11),
                xy4 = __builtin_shufflevector(x, y, 4, 12, 5, 13, 6, 14, 7, 15),
                zw0 = __builtin_shufflevector(z, w, 0, 8, 1, 9, 2, 10, 3, 11),
                zw4 = __builtin_shufflevector(z, w, 4, 12, 5, 13, 6, 14, 7, 15);
    store_two(__builtin_shufflevector(xy0, zw0, 0, 1, 8, 9, 2, 3, 10, 11), at(0), at(1));
    store_two(__builtin_shufflevector(xy0, zw0, 4, 5, 12, 13, 6, 7, 14, 15), at(2), at(3));
    store_two(__builtin_shufflevector(xy4, zw4, 0, 1, 8, 9, 2, 3, 10, 11), at(4), at(5));
    store_two(__builtin_shufflevector(xy4, zw4, 4, 5, 12, 13, 6, 7, 14, 15), at(6), at(7));
}

}  // namespace detail

/// values[place[i]] <- lane i.
inline void store(OctetOfQuads const& from, Quad* values, std::int32_t const* place)
{
    detail::store_each(from, [=](int lane) -> Quad& { return values[place[lane]]; });
}
/// values[i] <- lane i.
inline void store(OctetOfQuads const& from, Quad* values)
{
    detail::store_each(from, [=](int lane) -> Quad& { return values[lane]; });
}

}  // namespace gimdem::exec
