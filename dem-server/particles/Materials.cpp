// SPDX-License-Identifier: BSD-3-Clause
#include "particles/Materials.hpp"

#include <cmath>
#include <numbers>

#include "contact/Restitution.hpp"
#include "core/Error.hpp"

namespace gimdem
{

ContactConstants contact_constants(MaterialSettings const& a, MaterialSettings const& b, ContactSettings const& contact)
{
    auto const compliance = [](MaterialSettings const& m)
    { return (1 - m.poisson_ratio * m.poisson_ratio) / m.young_modulus; };
    auto const shear_compliance = [](MaterialSettings const& m)
    { return 2 * (2 - m.poisson_ratio) * (1 + m.poisson_ratio) / m.young_modulus; };
    double const young_eff = 1 / (compliance(a) + compliance(b));
    double const shear_eff = 1 / (shear_compliance(a) + shear_compliance(b));
    double const beta = contact.limit_damping ? damping_ratio_without_attraction(contact.restitution, Stiffening::hertz)
                                              : damping_ratio(contact.restitution);
    return {.young_eff = young_eff,
            .shear_eff = shear_eff,
            .damping_ratio = beta,
            .friction = contact.friction,
            .damping = 2 * std::sqrt(5.0 / 6.0) * beta,
            .stiffness_ratio = 4 * shear_eff / young_eff,
            .tangential_share = contact.tangential_damping ? std::sqrt(4 * shear_eff / young_eff) : 0,
            .least_force = least_normal_force(contact)};
}

double least_normal_force(ContactSettings const& contact)
{
    return contact.limit_damping ? 0 : -1e30;
}

Materials::Materials(Case const& settings)
    : settings_(settings.materials), contacts_(settings.contacts), dem_(settings.dem)
{
    for (ContactSettings const& contact : contacts_)
        for (std::string const& name : contact.pair)
            number_of(name);
}

ContactSettings const* Materials::contact(int a, int b) const
{
    std::string const& first = (*this)[a].name;
    std::string const& second = (*this)[b].name;
    for (ContactSettings const& contact : contacts_)
        if ((contact.pair[0] == first && contact.pair[1] == second) ||
            (contact.pair[0] == second && contact.pair[1] == first))
            return &contact;
    return nullptr;
}

int Materials::number_of(std::string_view name) const
{
    for (int m = 0; m < count(); ++m)
        if ((*this)[m].name == name) return m;
    throw UserError("no material is called \"" + std::string(name) + "\"; add it to [[materials]]");
}

double Materials::rayleigh_time(int material, double radius) const
{
    MaterialSettings const& m = (*this)[material];
    double const shear_modulus = m.young_modulus / (2 * (1 + m.poisson_ratio));
    return std::numbers::pi * radius * std::sqrt(m.density / shear_modulus) / (0.1631 * m.poisson_ratio + 0.8766);
}

}  // namespace gimdem
