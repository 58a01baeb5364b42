// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string_view>

#include "core/CaseChecks.hpp"
#include "core/CaseText.hpp"
#include "core/Error.hpp"

namespace gimdem::case_file
{

namespace
{

/// A value of [[contacts]] and the laws that use it.
struct PairValue
{
    std::string_view key;
    std::string DemSettings::*choice;
    std::string_view choice_key;
    std::vector<std::string> laws;
    std::string_view purpose;
    std::string_view example;  ///< empty: has a default
};

std::vector<PairValue> const pair_values = {
    {"normal_stiffness",
     &DemSettings::contact_law,
     "contact_law",
     {"linear"},
     "stiffness of the spring [N/m]",
     "1000.0"},
    {"tangential_stiffness_ratio", &DemSettings::contact_law, "contact_law", {"linear"}, "", ""},
    {"rolling_friction",
     &DemSettings::rolling_friction,
     "rolling_friction",
     {"cdt", "epsd"},
     "coefficient of rolling friction",
     "0.05"},
    {"rolling_damping",
     &DemSettings::rolling_friction,
     "rolling_friction",
     {"epsd"},
     "share of critical damping of rolling",
     "0.3"},
    {"cohesion_energy_density",
     &DemSettings::cohesion,
     "cohesion",
     {"sjkr"},
     "attraction per area of contact [J/m^3]",
     "5e4"},
};

}  // namespace

void check_contact_laws(Case const& input, Document const& document)
{
    for (std::size_t i = 0; i < input.contacts.size(); ++i)
        for (PairValue const& value : pair_values)
        {
            std::string const key(value.key), path = entry("contacts", i, key);
            std::string const& law = input.dem.*value.choice;
            std::string const choice = std::string(value.choice_key) + " = " + to_text(law);
            bool const is_used = std::find(value.laws.begin(), value.laws.end(), law) != value.laws.end();
            if (is_used && !value.example.empty() && !document.has(path))
                throw UserError(document.at(path) + ": \"" + key + "\" is missing in [[contacts]] for " +
                                to_text(input.contacts[i].pair) + " (" + std::string(value.purpose) + ", needed for " +
                                choice + " in [dem]); add e.g. " + key + " = " + std::string(value.example));
            if (!is_used && document.has(path))
                throw UserError(document.at(path) + ": \"" + key + "\" in [[contacts]] has no effect (" + choice +
                                " in [dem]); remove it or choose " + std::string(value.choice_key) + " = " +
                                to_text(value.laws.front()));
        }
}

}  // namespace gimdem::case_file
