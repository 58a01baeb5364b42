// SPDX-License-Identifier: BSD-3-Clause
/// The laws that a scene has chosen, with the constants of all its pairs of materials.
#pragma once

#include <cstring>
#include <memory>
#include <string>

#include "contact/ContactLaws.hpp"
#include "exec/Buffer.hpp"
#include "exec/Octet.hpp"
#include "particles/Materials.hpp"

namespace gimdem
{

/// Constants of one choice of laws: a square table that kernels index by [material of i * count + material of j].
template <class Law>
struct LawTable
{
    exec::Buffer<typename Law::template Constants<double>> constants;

    explicit LawTable(Materials const& materials)
    {
        int const n = materials.count();
        constants.resize(n * n);
        constants.fill({});
        for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b)
                if (ContactSettings const* pair = materials.contact(a, b))
                    constants[a * n + b] = Law::constants(materials[a], materials[b], *pair);
    }
};

/// Constants of contacts of whatever materials, one in each lane of a Real: row[n] is the place in the table of contact
/// n.
template <class Law, class Real>
typename Law::template Constants<Real> lanes_of(typename Law::template Constants<double> const* table,
                                                std::int32_t const* row)
{
    using One = typename Law::template Constants<double>;
    using All = typename Law::template Constants<Real>;
    using Number = typename Real::Number;
    constexpr int count = sizeof(One) / sizeof(double);
    static_assert(sizeof(All) == count * sizeof(Real), "constants of a law are Reals, one after the other");
    double one[count];
    alignas(Real) Number lanes[count][Real::lanes];
    for (int n = 0; n < Real::lanes; ++n)
    {
        std::memcpy(one, &table[row[n]], sizeof one);
        for (int k = 0; k < count; ++k)
            lanes[k][n] = static_cast<Number>(one[k]);
    }
    All out;
    std::memcpy(static_cast<void*>(&out), lanes, sizeof out);
    return out;
}

class ContactModel
{
public:
    /// Throws UserError for a law that does not exist.
    explicit ContactModel(Materials const& materials);

    bool has_rolling_spring() const { return has_rolling_spring_; }

    /// Calls work(table) with the LawTable<ContactLaw<...>> of the scene's laws.
    template <class Work>
    void visit(Work const& work) const
    {
        select(force_, rolling_, cohesion_,
               [&]<class Law>() { work(*static_cast<LawTable<Law> const*>(table_.get())); });
    }

private:
    template <class Work>
    static bool select(std::string_view force, std::string_view rolling, std::string_view cohesion, Work const& work)
    {
        bool found = false;
        ForceLaws::select(force,
                          [&]<class Force>()
                          {
                              RollingLaws::select(
                                  rolling,
                                  [&]<class Rolling>()
                                  {
                                      found = CohesionLaws::select(
                                          cohesion, [&]<class Cohesion>()
                                          { work.template operator()<ContactLaw<Force, Rolling, Cohesion>>(); });
                                  });
                          });
        return found;
    }

    std::string force_, rolling_, cohesion_;
    bool has_rolling_spring_ = false;
    std::shared_ptr<void const> table_;  ///< of the type that the three names say
};

}  // namespace gimdem
