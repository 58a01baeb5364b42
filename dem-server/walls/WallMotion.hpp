// SPDX-License-Identifier: BSD-3-Clause
/// Prescribed motion of a rigid wall, theory.md (D.50), (D.51).
#pragma once

#include <array>

#include "core/Case.hpp"
#include "exec/Vector.hpp"

namespace gimdem
{

/// Where a wall is and how it moves at one instant. The body frame is that of the case file: a wall's shape never
/// changes there, particles are looked at from there.
struct WallPose
{
    Constant3 row[3]{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< of the rotation R from body to space
    Constant3 shift{0, 0, 0};                           ///< x = R y + shift [m]
    Constant3 velocity{0, 0, 0};                        ///< of the point `centre` [m/s]
    Constant3 spin{0, 0, 0};                            ///< angular velocity [rad/s]
    Constant3 centre{0, 0, 0};                          ///< in space [m]

    GIMDEM_HD Vec3 turn(Vec3 const& y) const { return {row[0].vec().dot(y), row[1].vec().dot(y), row[2].vec().dot(y)}; }
    GIMDEM_HD Vec3 turn_back(Vec3 const& d) const
    {
        return d.x() * row[0].vec() + d.y() * row[1].vec() + d.z() * row[2].vec();
    }
    GIMDEM_HD Vec3 to_space(Vec3 const& y) const { return turn(y) + shift.vec(); }
    GIMDEM_HD Vec3 to_body(Vec3 const& x) const { return turn_back(x - shift.vec()); }

    /// Velocity of the wall at x in space, (D.51) [m/s].
    GIMDEM_HD Vec3 velocity_at(Vec3 const& x) const { return velocity.vec() + spin.vec().cross(x - centre.vec()); }
};

/// A closed form of time, so that a wall is at the same place whatever the steps that led there.
class WallMotion
{
public:
    WallMotion() = default;
    explicit WallMotion(WallItemSettings const& settings);

    bool moves() const { return moves_; }
    WallPose at(double time) const;  ///< [s]

    /// How far, at most, the point y of the body goes along the unit vector n of the body within dt [s], (D.58) [m].
    double step_along(Vec3 const& n, Vec3 const& y, double dt) const;
    /// The same across the unit vector `axis` of the body, whatever the direction.
    double step_across(Vec3 const& axis, Vec3 const& y, double dt) const;

    /// Smallest and largest coordinate along `axis` (0, 1, 2) that the point y of the body ever has [m]; infinite where
    /// the wall goes on and on.
    std::array<double, 2> span_of_point(int axis, Vec3 const& y) const;
    /// The same of a direction of the body.
    std::array<double, 2> span_of_direction(int axis, Vec3 const& d) const;

private:
    template <class Part>
    double step(Vec3 const& y, double dt, Part part) const;

    bool moves_ = false;
    Vec3 velocity_ = Vec3::Zero();                       ///< [m/s]
    Vec3 axis_ = Vec3::UnitZ(), origin_ = Vec3::Zero();  ///< of the rotation
    double speed_ = 0;                                   ///< [rad/s]
    Vec3 stroke_ = Vec3::Zero();                         ///< amplitude times direction [m]
    double angular_frequency_ = 0, phase_ = 0;           ///< [rad/s], [rad]
};

}  // namespace gimdem
