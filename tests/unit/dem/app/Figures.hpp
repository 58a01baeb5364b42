// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>

#include "output/Summary.hpp"

namespace gimdem::test
{

/// The value of a figure; NaN if there is none of that name.
inline double value_of(output::Summary const& summary, std::string const& name)
{
    for (output::Figure const& figure : summary.figures())
        if (figure.name == name) return figure.value;
    return NAN;
}

}  // namespace gimdem::test
