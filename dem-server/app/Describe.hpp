// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/Case.hpp"

namespace gimdem::app
{

/// What a launcher must know of a case, as one JSON object.
std::string describe(Case const& settings);

}  // namespace gimdem::app
