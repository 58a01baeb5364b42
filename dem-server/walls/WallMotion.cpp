// SPDX-License-Identifier: BSD-3-Clause
#include "walls/WallMotion.hpp"

#include <cmath>
#include <numbers>

namespace gimdem
{

namespace
{

Vec3 vector(Triple const& t)
{
    return {t[0], t[1], t[2]};
}

Constant3 constant(Vec3 const& v)
{
    return {v.x(), v.y(), v.z()};
}

}  // namespace

WallMotion::WallMotion(WallItemSettings const& settings) : velocity_(vector(settings.velocity))
{
    if (auto const& rotation = settings.rotation)
    {
        axis_ = vector(rotation->axis).normalized();
        origin_ = vector(rotation->origin);
        speed_ = rotation->speed;
    }
    if (auto const& vibration = settings.vibration)
    {
        stroke_ = vibration->amplitude * vector(vibration->direction).normalized();
        angular_frequency_ = 2 * std::numbers::pi * vibration->frequency;
        phase_ = vibration->phase;
    }
    moves_ = !velocity_.isZero(0) || speed_ != 0 || !stroke_.isZero(0);
}

WallPose WallMotion::at(double time) const
{
    double const wave = angular_frequency_ * time + phase_;
    Vec3 const moved = time * velocity_ + std::sin(wave) * stroke_;
    Eigen::Matrix3d const r = Eigen::AngleAxisd(speed_ * time, axis_).toRotationMatrix();
    WallPose pose;
    for (int i = 0; speed_ != 0 && i < 3; ++i)
        pose.row[i] = {r(i, 0), r(i, 1), r(i, 2)};
    pose.shift = constant(moved + origin_ - pose.turn(origin_));
    pose.velocity = constant(velocity_ + angular_frequency_ * std::cos(wave) * stroke_);
    pose.spin = constant(speed_ * axis_);
    pose.centre = constant(origin_ + moved);
    return pose;
}

}  // namespace gimdem
