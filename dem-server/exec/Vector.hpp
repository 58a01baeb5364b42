// SPDX-License-Identifier: BSD-3-Clause
/// Small vectors. Arithmetic is Eigen's; storage is Quad, because an aligned quadruple loads in one go and, unlike
/// Eigen's types, is trivially copyable.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

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

/// Three components of any kind of number: of one vector (Real = double) or of eight (Real = exec::Octet). What laws
/// are written with that serve both.
template <class Real>
struct Vector3
{
    Real x, y, z;

    GIMDEM_HD friend Vector3 operator+(Vector3 const& a, Vector3 const& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    GIMDEM_HD friend Vector3 operator-(Vector3 const& a, Vector3 const& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    GIMDEM_HD friend Vector3 operator*(Real const& f, Vector3 const& a) { return {f * a.x, f * a.y, f * a.z}; }
    GIMDEM_HD Real dot(Vector3 const& b) const { return x * b.x + y * b.y + z * b.z; }
    GIMDEM_HD Vector3 cross(Vector3 const& b) const
    {
        return {y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x};
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

/// Three numbers, trivially copyable: how kernels hold constants such as gravity.
struct Constant3
{
    double x, y, z;
    GIMDEM_HD Vec3 vec() const { return {x, y, z}; }
};

}  // namespace gimdem
