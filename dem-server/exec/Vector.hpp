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

/// Three numbers, trivially copyable: how kernels hold constants such as gravity.
struct Constant3
{
    double x, y, z;
    GIMDEM_HD Vec3 vec() const { return {x, y, z}; }
};

}  // namespace gimdem
