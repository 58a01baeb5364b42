// SPDX-License-Identifier: BSD-3-Clause
/// What the ways of mapping particles onto cells are called in a case file. The first is the default.
#pragma once

#include <string_view>

namespace gimdem
{

inline constexpr std::string_view mapping_method_names[] = {"gim",    "gim-fixed", "pcm",   "divided",      "fbsi",
                                                            "kernel", "diffusion", "exact", "power-diagram"};

}  // namespace gimdem
