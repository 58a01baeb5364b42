// SPDX-License-Identifier: BSD-3-Clause
/// Touching pairs of one block side by side in columns, which the stages of PairKernel fill and work on one after the
/// other: a short loop at a time, so that the processor has several rows of lanes under way.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "exec/Hexadecad.hpp"
#include "exec/Vector.hpp"
#include "search/NeighborList.hpp"

namespace gimdem
{

/// One number of each pair. The law takes them by Packs of its precision; from and to the particles they go by octets
/// of doubles.
template <class Number, int room>
struct Column
{
    alignas(64) Number numbers[room];

    template <class Real>
    Real at(int n) const
    {
        Real out;
        std::memcpy(&out, numbers + n, sizeof out);
        return out;
    }
    template <class Real>
    void set(int n, Real const& values)
    {
        std::memcpy(numbers + n, &values, sizeof values);
    }
    void repeat_last(int count, int until)
    {
        for (int n = count; n < until; ++n)
            numbers[n] = numbers[count - 1];
    }
};

/// One vector of each pair.
template <class Number, int room>
struct VectorColumn
{
    Column<Number, room> x, y, z;

    template <class Real>
    Vector3<Real> at(int n) const
    {
        return {x.template at<Real>(n), y.template at<Real>(n), z.template at<Real>(n)};
    }
    template <class Real>
    void set(int n, Vector3<Real> const& values)
    {
        x.set(n, values.x);
        y.set(n, values.y);
        z.set(n, values.z);
    }
    exec::OctetOfQuads load_eight(int n) const
    {
        return {exec::load_eight(x.numbers + n), exec::load_eight(y.numbers + n), exec::load_eight(z.numbers + n),
                exec::Octet::Constant(0)};
    }
    void store_eight(int n, exec::OctetOfQuads const& values)
    {
        exec::store_eight(values.x, x.numbers + n);
        exec::store_eight(values.y, y.numbers + n);
        exec::store_eight(values.z, z.numbers + n);
    }
};

struct Absent
{
};

/// Real: exec::Octet, or exec::Hexadecad for a law in single precision.
template <class Law, bool one_size, class Real_>
struct ContactBatch
{
    using Real = Real_;
    static constexpr int most = 128;
    static constexpr int room = most + 2 * exec::octet;
    using Numbers = Column<typename Real::Number, room>;
    using Vectors = VectorColumn<typename Real::Number, room>;
    static constexpr bool is_single = sizeof(typename Real::Number) < sizeof(double);
    template <bool present, class Type>
    using Only = std::conditional_t<present, Type, Absent>;

    ContactBatch(NeighborListView const& list, std::int64_t block)
        : begin(static_cast<std::int32_t>(block * NeighborList::block)),
          springs(list.pools[block]),
          next_border(list.border_begin[block])
    {
    }

    std::int32_t const begin;  ///< first particle of the block
    SpringPool& springs;       ///< of the block
    std::int32_t next_border;  ///< slot of the next pair that crosses the border

    int count = 0;
    alignas(64) std::int32_t first[room], second[room];
    alignas(64) std::int32_t slot[room];    ///< of the springs
    alignas(64) std::int32_t border[room];  ///< slot of the force on the second, -1 where it is of the block

    // What look() finds.
    Vectors between;                                           ///< from the second to the first [m]
    Numbers square;                                            ///< of that [m^2]
    [[no_unique_address]] Only<is_single, Numbers> closeness;  ///< square of the reach less that [m^2]

    // What gather() brings.
    Vectors velocity;        ///< of the first relative to the second [m/s]; then the force on the first [N]
    Vectors spin_a, spin_b;  ///< [rad/s]; then the torques [N m]
    Vectors spring;          ///< tangential [m]
    [[no_unique_address]] Only<!one_size, Numbers> radius_a, radius_b;            ///< [m]
    [[no_unique_address]] Only<!one_size, Numbers> inverse_mass;                  ///< 1/m_i + 1/m_j [1/kg]
    [[no_unique_address]] Only<Law::rolls, Numbers> inverse_inertia;              ///< 1/I_i + 1/I_j [1/(kg m^2)]
    [[no_unique_address]] Only<Law::has_rolling_spring, Vectors> rolling_spring;  ///< [N m]

    bool is_full() const { return count >= most; }
    /// Fills the last lanes with copies of the last pair.
    void pad()
    {
        int const until = (count + Real::lanes - 1) / Real::lanes * Real::lanes;
        for (int n = count; n < until; ++n)
        {
            first[n] = first[count - 1];
            second[n] = second[count - 1];
            slot[n] = slot[count - 1];
        }
        for (Numbers* column : {&between.x, &between.y, &between.z, &square})
            column->repeat_last(count, until);
        if constexpr (is_single) closeness.repeat_last(count, until);
    }
};

}  // namespace gimdem
