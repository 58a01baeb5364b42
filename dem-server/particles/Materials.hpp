// SPDX-License-Identifier: BSD-3-Clause
/// Materials and what they make of a contact: every constant of a pair of materials, computed once.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/Case.hpp"

namespace gimdem
{

/// Constants of a pair of materials in contact, theory.md (D.3), (D.4), (D.8). Real is double, or exec::Octet for eight
/// contacts of different materials.
template <class Real>
struct ContactConstantsOf
{
    Real young_eff;      ///< E*, (D.3) [Pa]
    Real shear_eff;      ///< G*, (D.4) [Pa]
    Real damping_ratio;  ///< |beta|, (D.8) or (D.90) [1]
    Real friction;       ///< Coulomb coefficient [1]

    // What the law needs of the four above, so that no contact computes it again.
    Real damping;           ///< 2 sqrt(5/6) |beta| [1]
    Real stiffness_ratio;   ///< S_t / S_n = 4 G* / E* [1]
    Real tangential_share;  ///< eta_t / eta_n: the root of that, 0 without a tangential dashpot [1]
    Real least_force;       ///< below which the normal force does not fall [N]: 0, or far below any
};
using ContactConstants = ContactConstantsOf<double>;

/// (D.3), (D.4), (D.8) for two materials and their contact. A wall is a material like any other.
ContactConstants contact_constants(MaterialSettings const& a, MaterialSettings const& b,
                                   ContactSettings const& contact);

/// Below which the normal force of spring and dashpot does not fall [N]: far below any, unless the damping is limited.
double least_normal_force(ContactSettings const& contact);

/// The materials of a case, and how they touch.
class Materials
{
public:
    explicit Materials(Case const& settings);

    int count() const { return static_cast<int>(settings_.size()); }
    MaterialSettings const& operator[](int material) const { return settings_[static_cast<std::size_t>(material)]; }
    int number_of(std::string_view name) const;  ///< throws UserError for a name that is not there
    /// What was said of two materials in contact; null where nothing was.
    ContactSettings const* contact(int a, int b) const;
    DemSettings const& laws() const { return dem_; }  ///< the choice of contact laws

    /// Rayleigh time [s] of a sphere of this material, theory.md (D.14): pi r sqrt(rho/G) / (0.1631 nu + 0.8766).
    double rayleigh_time(int material, double radius) const;

private:
    std::vector<MaterialSettings> settings_;
    std::vector<ContactSettings> contacts_;
    DemSettings dem_;
};

}  // namespace gimdem
