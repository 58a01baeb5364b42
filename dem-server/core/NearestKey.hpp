// SPDX-License-Identifier: BSD-3-Clause
/// What a misspelt word was meant to be.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gimdem
{

/// Number of single-letter insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word of `known` nearest to `word`, empty where none is near enough to be meant (a third of its letters).
std::string nearest_key(std::string_view word, std::vector<std::string> const& known);

/// `did you mean "..."?`, or `known are: a, b, c` where nothing is near.
std::string suggest_key(std::string_view word, std::vector<std::string> const& known);

}  // namespace gimdem
