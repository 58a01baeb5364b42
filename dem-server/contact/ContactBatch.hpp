// SPDX-License-Identifier: BSD-3-Clause
/// Touching pairs side by side in columns, which the stages of PairKernel fill and work on one after the other: a short
/// loop at a time, so that the processor has several rows of lanes under way.
#pragma once

#include <cstdint>
#include <cstring>

#include "exec/Octet.hpp"
#include "exec/Vector.hpp"

namespace gimdem
{

/// One number of each pair. Real: a Pack of them.
template <class Real, int room>
struct Column
{
    alignas(Real) typename Real::Number numbers[room];

    Real at(int n) const
    {
        Real out;
        std::memcpy(&out, numbers + n, sizeof out);
        return out;
    }
    void set(int n, Real const& values) { std::memcpy(numbers + n, &values, sizeof values); }
    void repeat_last(int count, int until)
    {
        for (int n = count; n < until; ++n)
            numbers[n] = numbers[count - 1];
    }
};

/// One vector of each pair.
template <class Real, int room>
struct VectorColumn
{
    Column<Real, room> x, y, z;

    Vector3<Real> at(int n) const { return {x.at(n), y.at(n), z.at(n)}; }
    void set(int n, Vector3<Real> const& values)
    {
        x.set(n, values.x);
        y.set(n, values.y);
        z.set(n, values.z);
    }
};

struct Absent
{
};

template <class Law, bool one_size, class Real_>
struct ContactBatch
{
    using Real = Real_;
    static constexpr int most = 64;
    static constexpr int room = most + 2 * exec::octet;
    using Numbers = Column<Real, room>;
    using Vectors = VectorColumn<Real, room>;
    template <bool present, class Type>
    using Only = std::conditional_t<present, Type, Absent>;

    int count = 0;
    alignas(64) std::int32_t pair[room], first[room], second[room];

    // What look() finds.
    Vectors between;  ///< from the second to the first [m]
    Numbers square;   ///< of that [m^2]

    // What gather() brings.
    Vectors velocity;         ///< of the first relative to the second [m/s]; then the force on the first [N]
    Vectors spin_a, spin_b;   ///< [rad/s]; then the torques [N m]
    Vectors spring;           ///< tangential [m]
    [[no_unique_address]] Only<!one_size, Numbers> radius_a, radius_b;  ///< [m]
    [[no_unique_address]] Only<!one_size, Numbers> inverse_mass;        ///< 1/m_i + 1/m_j [1/kg]
    [[no_unique_address]] Only<Law::rolls, Numbers> inverse_inertia;    ///< 1/I_i + 1/I_j [1/(kg m^2)]
    [[no_unique_address]] Only<Law::has_rolling_spring, Vectors> rolling_spring;  ///< [N m]

    bool is_full() const { return count >= most; }
    /// Fills the last lanes with copies of the last pair.
    void pad()
    {
        int const until = (count + exec::octet - 1) / exec::octet * exec::octet;
        for (int n = count; n < until; ++n)
        {
            pair[n] = pair[count - 1];
            first[n] = first[count - 1];
            second[n] = second[count - 1];
        }
        for (Numbers* column : {&between.x, &between.y, &between.z, &square})
            column->repeat_last(count, until);
    }
};

}  // namespace gimdem
