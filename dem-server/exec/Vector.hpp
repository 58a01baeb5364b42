// SPDX-License-Identifier: BSD-3-Clause
/// Small vectors. Arithmetic is Eigen's; storage is Quad, because an aligned quadruple loads in one go and, unlike
/// Eigen's types, is trivially copyable.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <type_traits>

#include "exec/HostDevice.hpp"

namespace gimdem
{

using Vec3 = Eigen::Vector3d;

/// A vector and a scalar that is needed with it.
struct alignas(32) Quad
{
    double x, y, z, w;

    GIMDEM_HD Vec3 xyz() const { return {x, y, z}; }
    GIMDEM_HD void set_xyz(Vec3 const& v)
    {
        x = v.x();
        y = v.y();
        z = v.z();
    }
    GIMDEM_HD static Quad of(Vec3 const& v, double w) { return {v.x(), v.y(), v.z(), w}; }
};

// Component by component, w too.
GIMDEM_HD inline Quad operator+(Quad const& a, Quad const& b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
}
GIMDEM_HD inline Quad operator-(Quad const& a, Quad const& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w};
}
GIMDEM_HD inline Quad operator*(double f, Quad const& a)
{
    return {f * a.x, f * a.y, f * a.z, f * a.w};
}

namespace exec
{

/// Whether a kind of number, or of many, has single precision.
template <class Real>
inline constexpr bool is_single = std::is_same_v<Real, float>;

// Packs have their own, that round once (exec/PackMath.hpp).
/// c + a b.
template <class Real>
GIMDEM_HD Real plus_product(Real const& c, Real const& a, Real const& b)
{
    return c + a * b;
}
/// c - a b.
template <class Real>
GIMDEM_HD Real minus_product(Real const& c, Real const& a, Real const& b)
{
    return c - a * b;
}

}  // namespace exec

/// Three components of any kind of number: of one vector (Real = double) or of eight (Real = exec::Octet). What laws
/// are written with that serve both.
template <class Real>
struct Vector3
{
    Real x, y, z;

    GIMDEM_HD friend Vector3 operator+(Vector3 const& a, Vector3 const& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    GIMDEM_HD friend Vector3 operator-(Vector3 const& a, Vector3 const& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    GIMDEM_HD friend Vector3 operator*(Real const& f, Vector3 const& a) { return {f * a.x, f * a.y, f * a.z}; }
    GIMDEM_HD Real dot(Vector3 const& b) const
    {
        using exec::plus_product;
        return plus_product(plus_product(Real(x * b.x), y, b.y), z, b.z);
    }
    GIMDEM_HD Vector3 cross(Vector3 const& b) const
    {
        using exec::minus_product;
        return {minus_product(Real(y * b.z), z, b.y), minus_product(Real(z * b.x), x, b.z),
                minus_product(Real(x * b.y), y, b.x)};
    }
    /// This + f a, and this - f a.
    GIMDEM_HD Vector3 plus(Real const& f, Vector3 const& a) const
    {
        using exec::plus_product;
        return {plus_product(x, f, a.x), plus_product(y, f, a.y), plus_product(z, f, a.z)};
    }
    GIMDEM_HD Vector3 minus(Real const& f, Vector3 const& a) const
    {
        using exec::minus_product;
        return {minus_product(x, f, a.x), minus_product(y, f, a.y), minus_product(z, f, a.z)};
    }
};

GIMDEM_HD inline Vector3<double> vector3(Vec3 const& v)
{
    return {v.x(), v.y(), v.z()};
}
GIMDEM_HD inline Vec3 vec3(Vector3<double> const& t)
{
    return {t.x, t.y, t.z};
}
/// Three numbers of a case file.
inline Vec3 vec3(std::array<double, 3> const& t)
{
    return {t[0], t[1], t[2]};
}

/// Three numbers, trivially copyable: how kernels hold constants such as gravity.
struct Constant3
{
    double x, y, z;
    GIMDEM_HD Vec3 vec() const { return {x, y, z}; }
};
GIMDEM_HD inline Constant3 constant3(Vec3 const& v)
{
    return {v.x(), v.y(), v.z()};
}

}  // namespace gimdem
