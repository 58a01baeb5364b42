// SPDX-License-Identifier: BSD-3-Clause
/// Eight numbers taken together: as many as one register of the widest kind holds. How a kernel on the processor works
/// on eight contacts or particles at a time.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <cstring>
#include <utility>

#include "exec/PackMath.hpp"
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
using Octet = Pack<double, octet>;
using OctetMask = Mask<double, octet>;
/// Eight numbers with all the functions of Eigen.
using OctetArray = Eigen::Array<double, octet, 1>;
inline OctetMask greater(OctetArray const& a, OctetArray const& b)
{
    Octet left, right;
    std::memcpy(&left, a.data(), sizeof left);
    std::memcpy(&right, b.data(), sizeof right);
    return greater(left, right);
}
inline OctetArray choose(OctetMask const& condition, OctetArray const& yes, OctetArray const& no)
{
    Octet left, right;
    std::memcpy(&left, yes.data(), sizeof left);
    std::memcpy(&right, no.data(), sizeof right);
    left = choose(condition, left, right);
    OctetArray out;
    std::memcpy(out.data(), &left, sizeof left);
    return out;
}
inline Octet exponential(Octet const& x)
{
    OctetArray all;
    std::memcpy(all.data(), &x, sizeof x);
    all = all.exp();
    Octet out;
    std::memcpy(&out, all.data(), sizeof out);
    return out;
}

/// Eight quadruples, transposed.
struct OctetOfQuads
{
    Octet x, y, z, w;
};

/// values[place[i]] for each lane.
inline Octet gather(double const* values, std::int32_t const* place)
{
#ifdef __AVX512F__
    __m256i at;
    std::memcpy(&at, place, sizeof at);
    return {_mm512_i32gather_pd(at, values, sizeof *values)};
#else
    Octet out;
    for (int lane = 0; lane < octet; ++lane)
        out[lane] = values[place[lane]];
    return out;
#endif
}
/// Rounds numbers >= 0 down, and writes them as integers.
inline Octet whole_part(Octet const& x, std::int32_t* whole)
{
#ifdef __AVX512F__
    __m256i const cut = _mm512_cvttpd_epi32(x.v);
    std::memcpy(whole, &cut, sizeof cut);
    return {_mm512_cvtepi32_pd(cut)};
#else
    Octet out;
    for (int lane = 0; lane < octet; ++lane)
        out[lane] = whole[lane] = static_cast<std::int32_t>(x[lane]);
    return out;
#endif
}

namespace detail
{

// The compiler's own vectors, which it can permute.
using Four = double __attribute__((vector_size(32)));
using Eight = Octet::Vector;

inline Four four_at(double const* from)
{
    Four out;
    std::memcpy(&out, from, sizeof out);
    return out;
}
inline Eight load_two(double const* a, double const* b)
{
#ifdef __AVX512F__
    // Straight from memory into the upper half: the unit that permutes has enough to do.
    return _mm512_insertf64x4(_mm512_castpd256_pd512(four_at(a)), four_at(b), 1);
#else
    return __builtin_shufflevector(four_at(a), four_at(b), 0, 1, 2, 3, 4, 5, 6, 7);
#endif
}
/// The sign of x, y and z of two quadruples turned round.
inline Eight all_but_w_negative(Eight const& v)
{
    using Bits = long long __attribute__((vector_size(64)));
    constexpr long long sign = 1ll << 63;
    Bits bits;
    std::memcpy(&bits, &v, sizeof bits);
    bits ^= Bits{sign, sign, sign, 0, sign, sign, sign, 0};
    Eight out;
    std::memcpy(&out, &bits, sizeof out);
    return out;
}
inline Four low_half(Eight const& both)
{
    return __builtin_shufflevector(both, both, 0, 1, 2, 3);
}
inline Four high_half(Eight const& both)
{
#ifdef __AVX512F__
    return _mm512_extractf64x4_pd(both, 1);  // goes straight to memory where it is stored
#else
    return __builtin_shufflevector(both, both, 4, 5, 6, 7);
#endif
}

}  // namespace detail

/// Eight quadruples, two in each register: lanes 0 and 2, 1 and 3, 4 and 6, 5 and 7.
struct QuadsOfOctet
{
    detail::Eight q02, q13, q46, q57;

    static QuadsOfOctet load(Quad const* values, std::int32_t const* place)
    {
        using detail::load_two;
        auto const at = [=](int lane) { return &values[place[lane]].x; };
        return {load_two(at(0), at(2)), load_two(at(1), at(3)), load_two(at(4), at(6)), load_two(at(5), at(7))};
    }
    friend QuadsOfOctet operator+(QuadsOfOctet const& a, QuadsOfOctet const& b)
    {
        return {a.q02 + b.q02, a.q13 + b.q13, a.q46 + b.q46, a.q57 + b.q57};
    }
    /// x, y, z of the difference, w of the sum.
    static QuadsOfOctet difference(QuadsOfOctet const& a, QuadsOfOctet const& b)
    {
        using detail::all_but_w_negative;
        return {a.q02 + all_but_w_negative(b.q02), a.q13 + all_but_w_negative(b.q13), a.q46 + all_but_w_negative(b.q46),
                a.q57 + all_but_w_negative(b.q57)};
    }
    OctetOfQuads transposed() const
    {
        using detail::Eight;
        Eight const xz0 = __builtin_shufflevector(q02, q13, 0, 8, 2, 10, 4, 12, 6, 14),
                    yw0 = __builtin_shufflevector(q02, q13, 1, 9, 3, 11, 5, 13, 7, 15),
                    xz4 = __builtin_shufflevector(q46, q57, 0, 8, 2, 10, 4, 12, 6, 14),
                    yw4 = __builtin_shufflevector(q46, q57, 1, 9, 3, 11, 5, 13, 7, 15);
        return {{__builtin_shufflevector(xz0, xz4, 0, 1, 4, 5, 8, 9, 12, 13)},
                {__builtin_shufflevector(yw0, yw4, 0, 1, 4, 5, 8, 9, 12, 13)},
                {__builtin_shufflevector(xz0, xz4, 2, 3, 6, 7, 10, 11, 14, 15)},
                {__builtin_shufflevector(yw0, yw4, 2, 3, 6, 7, 10, 11, 14, 15)}};
    }
    static QuadsOfOctet of(OctetOfQuads const& from)
    {
        using detail::Eight;
        Eight const xy_even = __builtin_shufflevector(from.x.v, from.y.v, 0, 8, 2, 10, 4, 12, 6, 14),
                    xy_odd = __builtin_shufflevector(from.x.v, from.y.v, 1, 9, 3, 11, 5, 13, 7, 15),
                    zw_even = __builtin_shufflevector(from.z.v, from.w.v, 0, 8, 2, 10, 4, 12, 6, 14),
                    zw_odd = __builtin_shufflevector(from.z.v, from.w.v, 1, 9, 3, 11, 5, 13, 7, 15);
        return {__builtin_shufflevector(xy_even, zw_even, 0, 1, 8, 9, 2, 3, 10, 11),
                __builtin_shufflevector(xy_odd, zw_odd, 0, 1, 8, 9, 2, 3, 10, 11),
                __builtin_shufflevector(xy_even, zw_even, 4, 5, 12, 13, 6, 7, 14, 15),
                __builtin_shufflevector(xy_odd, zw_odd, 4, 5, 12, 13, 6, 7, 14, 15)};
    }
    /// The quadruple of a lane that is known when compiled.
    template <int lane>
    detail::Four get() const
    {
        detail::Eight const& both = lane < 4 ? (lane % 2 == 0 ? q02 : q13) : (lane % 2 == 0 ? q46 : q57);
        return lane % 4 < 2 ? detail::low_half(both) : detail::high_half(both);
    }
    /// Calls work.operator()<lane>(its quadruple) for the first `count` lanes, in rising order.
    template <class Work>
    void for_each(int count, Work const& work) const
    {
        [&]<int... lane>(std::integer_sequence<int, lane...>)
        {
            ((lane < count && (work.template operator()<lane>(get<lane>()), true)) && ...);
        }
        (std::make_integer_sequence<int, octet>{});
    }
};

/// Lane i of rows[j] <- lane j of rows[i].
inline void transpose(Octet (&rows)[octet])
{
    using detail::Eight;
    Eight pairs[octet], fours[octet];
    for (int j = 0; j < octet; j += 2)
    {
        pairs[j] = __builtin_shufflevector(rows[j].v, rows[j + 1].v, 0, 8, 2, 10, 4, 12, 6, 14);
        pairs[j + 1] = __builtin_shufflevector(rows[j].v, rows[j + 1].v, 1, 9, 3, 11, 5, 13, 7, 15);
    }
    for (int j = 0; j < octet; j += 4)
        for (int k = j; k < j + 2; ++k)
        {
            fours[k] = __builtin_shufflevector(pairs[k], pairs[k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
            fours[k + 2] = __builtin_shufflevector(pairs[k], pairs[k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
        }
    for (int k = 0; k < octet / 2; ++k)
    {
        rows[k].v = __builtin_shufflevector(fours[k], fours[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
        rows[k + 4].v = __builtin_shufflevector(fours[k], fours[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
    }
}

/// values[place[i]] for each lane.
inline OctetOfQuads load(Quad const* values, std::int32_t const* place)
{
    return QuadsOfOctet::load(values, place).transposed();
}
/// values[3 place[i]] and the two behind it, for each lane; a fourth is read and must be there.
inline OctetOfQuads load_threes(double const* values, std::int32_t const* place)
{
    auto const at = [=](int lane) { return values + 3 * static_cast<std::int64_t>(place[lane]); };
    using detail::load_two;
    return QuadsOfOctet{load_two(at(0), at(2)), load_two(at(1), at(3)), load_two(at(4), at(6)), load_two(at(5), at(7))}
        .transposed();
}
/// values[4 place[i]] and the three behind it, for each lane.
inline OctetOfQuads load_fours(double const* values, std::int32_t const* place)
{
    auto const at = [=](int lane) { return values + 4 * static_cast<std::int64_t>(place[lane]); };
    using detail::load_two;
    return QuadsOfOctet{load_two(at(0), at(2)), load_two(at(1), at(3)), load_two(at(4), at(6)), load_two(at(5), at(7))}
        .transposed();
}
/// values[a[i]] - values[b[i]] for each lane, but w of the sum.
inline OctetOfQuads load_difference(Quad const* values, std::int32_t const* a, std::int32_t const* b)
{
    return QuadsOfOctet::difference(QuadsOfOctet::load(values, a), QuadsOfOctet::load(values, b)).transposed();
}
/// values[a[i]] + values[b[i]] for each lane.
inline OctetOfQuads load_sum(Quad const* values, std::int32_t const* a, std::int32_t const* b)
{
    return (QuadsOfOctet::load(values, a) + QuadsOfOctet::load(values, b)).transposed();
}

/// values[place[i]] <- lane i, in rising order of lanes.
inline void store(OctetOfQuads const& from, Quad* values, std::int32_t const* place)
{
    QuadsOfOctet::of(from).for_each(
        octet, [=]<int lane>(detail::Four const& value) { std::memcpy(&values[place[lane]], &value, sizeof value); });
}
/// Three numbers from `to` on <- the first three of four.
inline void store_three(detail::Four const& from, double* to)
{
#ifdef __AVX512VL__
    _mm256_mask_storeu_pd(to, 0b111, from);
#else
    std::memcpy(to, &from, 3 * sizeof *to);
#endif
}
/// values[3 place[i]] and the two behind it <- x, y, z of lane i, in rising order of lanes.
inline void store_threes(OctetOfQuads const& from, double* values, std::int32_t const* place)
{
    QuadsOfOctet::of(from).for_each(octet, [=]<int lane>(detail::Four const& value)
                                    { store_three(value, values + 3 * static_cast<std::int64_t>(place[lane])); });
}
/// values[i] <- lane i.
inline void store(OctetOfQuads const& from, Quad* values)
{
    QuadsOfOctet::of(from).for_each(
        octet, [=]<int lane>(detail::Four const& value) { std::memcpy(&values[lane], &value, sizeof value); });
}

}  // namespace gimdem::exec
