// SPDX-License-Identifier: BSD-3-Clause
/// What the contact laws are called in a case file, in the order of contact/ContactLaws.hpp. The first is the default.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gimdem
{

inline constexpr std::string_view force_law_names[] = {"hertz-mindlin", "linear"};
inline constexpr std::string_view rolling_law_names[] = {"none", "cdt", "epsd"};
inline constexpr std::string_view cohesion_law_names[] = {"none", "sjkr"};

/// The same as the reader of case files wants them.
template <std::size_t count>
std::vector<std::string> words(std::string_view const (&names)[count])
{
    return {std::begin(names), std::end(names)};
}

}  // namespace gimdem
