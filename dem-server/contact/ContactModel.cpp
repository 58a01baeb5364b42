// SPDX-License-Identifier: BSD-3-Clause
#include "contact/ContactModel.hpp"

#include "core/Error.hpp"

namespace gimdem
{

ContactModel::ContactModel(Materials const& materials)
    : force_(materials.laws().contact_law),
      rolling_(materials.laws().rolling_friction),
      cohesion_(materials.laws().cohesion)
{
    bool const found = select(force_, rolling_, cohesion_,
                              [&]<class Law>()
                              {
                                  table_ = std::make_shared<LawTable<Law> const>(materials);
                                  has_rolling_spring_ = Law::has_rolling_spring;
                              });
    if (!found)
        throw UserError("[dem] contact_law = \"" + force_ + "\", rolling_friction = \"" + rolling_ +
                        "\", cohesion = \"" + cohesion_ +
                        "\" (one of these laws does not exist); docs/case-file.md lists the laws");
}

}  // namespace gimdem
