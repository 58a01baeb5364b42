// SPDX-License-Identifier: BSD-3-Clause
#include "walls/WallMotion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gimdem
{

WallMotion::WallMotion(WallItemSettings const& settings) : velocity_(vec3(settings.velocity))
{
    if (auto const& rotation = settings.rotation)
    {
        axis_ = vec3(rotation->axis).normalized();
        origin_ = vec3(rotation->origin);
        speed_ = rotation->speed;
    }
    if (auto const& vibration = settings.vibration)
    {
        stroke_ = vibration->amplitude * vec3(vibration->direction).normalized();
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
    pose.shift = constant3(moved + origin_ - pose.turn(origin_));
    pose.velocity = constant3(velocity_ + angular_frequency_ * std::cos(wave) * stroke_);
    pose.spin = constant3(speed_ * axis_);
    pose.centre = constant3(origin_ + moved);
    return pose;
}

// A turning body sees the translation from all sides.
template <class Part>
double WallMotion::step(Vec3 const& y, double dt, Part part) const
{
    auto const seen = [&](Vec3 const& d) { return speed_ != 0 ? d.norm() : part(d); };
    double const turning = std::abs(speed_) * part(axis_.cross(y - origin_));
    return (seen(velocity_) + turning) * dt + std::min(2.0, std::abs(angular_frequency_) * dt) * seen(stroke_);
}

double WallMotion::step_along(Vec3 const& n, Vec3 const& y, double dt) const
{
    return step(y, dt, [&](Vec3 const& d) { return std::abs(d.dot(n)); });
}

double WallMotion::step_across(Vec3 const& axis, Vec3 const& y, double dt) const
{
    return step(y, dt, [&](Vec3 const& d) { return (d - d.dot(axis) * axis).norm(); });
}

std::array<double, 2> WallMotion::span_of_point(int axis, Vec3 const& y) const
{
    constexpr double endless = std::numeric_limits<double>::infinity();
    if (velocity_[axis] != 0) return {-endless, endless};
    auto const [low, high] = span_of_direction(axis, y - origin_);
    double const stroke = std::abs(stroke_[axis]);
    return {origin_[axis] + low - stroke, origin_[axis] + high + stroke};
}

// What turns about an axis moves on a circle.
std::array<double, 2> WallMotion::span_of_direction(int axis, Vec3 const& d) const
{
    if (speed_ == 0) return {d[axis], d[axis]};
    double const along = axis_.dot(d);
    double const centre = along * axis_[axis];
    double const radius = (d - along * axis_).norm() * std::sqrt(std::max(0.0, 1 - axis_[axis] * axis_[axis]));
    return {centre - radius, centre + radius};
}

}  // namespace gimdem
